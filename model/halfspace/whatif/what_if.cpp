#include "halfspace/whatif/what_if.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/validate.hpp"
#include "halfspace/whatif/depth_ahead.hpp"
#include "halfspace/whatif/lod.hpp"
#include "halfspace/whatif/sequence.hpp"

namespace halfspace::whatif {
namespace {

void check(const WhatIf& what_if, std::size_t frames) {
  if (what_if.lod_pixels && !(std::isfinite(*what_if.lod_pixels) && *what_if.lod_pixels > 0)) {
    throw OptionError(fmt::format("lod is {} pixels; legal: a finite number above 0", *what_if.lod_pixels));
  }
  if (what_if.delay && (*what_if.delay < 1 || *what_if.delay > kMaxFrameTriangles)) {
    throw OptionError(
        fmt::format("delay is {} triangles; legal: 1 to {}", *what_if.delay, kMaxFrameTriangles));
  }
  if (what_if.prepass && what_if.delay) {
    throw OptionError(
        fmt::format("prepass is given with delay {}; legal: one of them, for a prepass is the longest delay",
                    *what_if.delay));
  }
  if (what_if.order && what_if.alternate) {
    throw OptionError(
        fmt::format("sort is '{}' with order 'alternate'; legal: one of them, for both order the draws",
                    *what_if.order == SortOrder::kFrontToBack ? "front-to-back" : "back-to-front"));
  }
  if (what_if.alternate && frames < 2) {
    throw OptionError(fmt::format(
        "order is 'alternate' with {} frame; legal: with two or more, one after the other", frames));
  }
}

}  // namespace

Sequence apply(std::vector<Frame> frames, const WhatIf& what_if) {
  check(what_if, frames.size());
  std::vector<Applied> applied;
  for (Frame& frame : frames) {
    if (what_if.any()) frame.attributes.reset();  // their triangles are no longer those of the mesh, in order
  }
  const auto each = [&](const char* name, const auto& act) {
    Acted acted;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      acted += act(frames[i], i);
    }
    applied.push_back({.name = name, .acted = acted});
  };
  if (what_if.lod_pixels) {
    each("lod", [&](Frame& frame, std::size_t) { return simplify(frame, *what_if.lod_pixels); });
  }
  if (what_if.order) {
    each("sort", [&](Frame& frame, std::size_t) { return sort(frame, *what_if.order); });
  }
  if (what_if.alternate) {
    each("order", [&](Frame& frame, std::size_t i) { return i % 2 == 1 ? reverse(frame) : Acted{}; });
  }
  if (what_if.prepass) {
    each("prepass", [&](Frame& frame, std::size_t) { return prepass(frame); });
  }
  if (what_if.delay) {
    each("delay", [&](Frame& frame, std::size_t) { return delay(frame, *what_if.delay); });
  }
  Sequence sequence{.frame = join(std::move(frames)), .applied = std::move(applied)};
  validate(sequence.frame);
  return sequence;
}

}  // namespace halfspace::whatif
