/// Where the results of two runs of a frame differ, in words; empty where they do not.
#pragma once

#include <string>
#include <type_traits>

#include "halfspace/machine/frame_result.hpp"
#include "timing/differences.hpp"

namespace halfspace::testing {

template <class Value>
std::string image_difference(const std::string& what, const TiledImage<Value>& ours,
                             const TiledImage<Value>& other) {
  if (ours.width() != other.width() || ours.height() != other.height() || ours.empty() != other.empty()) {
    return what + ": another size\n";
  }
  for (int y = 0; y < ours.height() && !ours.empty(); ++y) {
    for (int x = 0; x < ours.width(); ++x) {
      if (ours.at(x, y) != other.at(x, y)) {
        return what + " at (" + std::to_string(x) + ", " + std::to_string(y) +
               "): " + std::to_string(ours.at(x, y)) + " against " + std::to_string(other.at(x, y)) + "\n";
      }
    }
  }
  return "";
}

inline std::string counter_difference(const std::string& what, const Counters& ours, const Counters& other) {
  std::string text;
  Counters::units([&](const char* unit, auto member) {
    using Unit = std::remove_cvref_t<decltype(ours.*member)>;
    Unit::fields([&](const char* name, auto, auto field) {
      text += difference(what + unit + "." + name, ours.*member.*field, other.*member.*field);
    });
  });
  return text;
}

/// Of what nothing that a machine skips may change: the depth, what passed and is seen, what was written.
inline std::string picture_difference(const FrameResult& ours, const FrameResult& other) {
  std::string text = difference("surfaces", ours.surfaces.size(), other.surfaces.size()) +
                     difference("draws", ours.draws.size(), other.draws.size());
  for (std::size_t i = 0; text.empty() && i < ours.surfaces.size(); ++i) {
    const std::string name = "surface " + std::to_string(i) + " ";
    text += image_difference(name + "codes", ours.surfaces[i].codes, other.surfaces[i].codes);
    text += image_difference(name + "survivors", ours.surfaces[i].survivors, other.surfaces[i].survivors);
    text += image_difference(name + "visible", ours.surfaces[i].visible, other.surfaces[i].visible);
  }
  for (std::size_t i = 0; text.empty() && i < ours.draws.size(); ++i) {
    const EarlyZCounters& a = ours.draws[i].counters.early_z;
    const EarlyZCounters& b = other.draws[i].counters.early_z;
    text += difference("survivors", a.survivors, b.survivors) + difference("written", a.written, b.written);
  }
  return text;
}

inline std::string result_difference(const FrameResult& ours, const FrameResult& other) {
  std::string text = difference("surfaces", ours.surfaces.size(), other.surfaces.size()) +
                     difference("draws", ours.draws.size(), other.draws.size()) +
                     difference("clears", ours.clears, other.clears) +
                     difference("flushed_lines", ours.flushed_lines, other.flushed_lines) +
                     difference("flushed_bytes", ours.flushed_bytes, other.flushed_bytes) +
                     difference("draws_not_filled", ours.draws_not_filled, other.draws_not_filled);
  for (std::size_t i = 0; text.empty() && i < ours.surfaces.size(); ++i) {
    const std::string name = "surface " + std::to_string(i) + " ";
    text += image_difference(name + "codes", ours.surfaces[i].codes, other.surfaces[i].codes);
    text += image_difference(name + "fragments", ours.surfaces[i].fragments, other.surfaces[i].fragments);
    text += image_difference(name + "survivors", ours.surfaces[i].survivors, other.surfaces[i].survivors);
    text += image_difference(name + "visible", ours.surfaces[i].visible, other.surfaces[i].visible);
    text += difference(name + "sums", ours.surfaces[i].sums, other.surfaces[i].sums);
    text += counter_difference(name, ours.surfaces[i].counters, other.surfaces[i].counters);
  }
  for (std::size_t i = 0; text.empty() && i < ours.draws.size(); ++i) {
    text += counter_difference("draw " + std::to_string(i) + " ", ours.draws[i].counters,
                               other.draws[i].counters);
  }
  return text + counter_difference("drawn clears ", ours.drawn_clears, other.drawn_clears) +
         counter_difference("", ours.counters, other.counters);
}

}  // namespace halfspace::testing
