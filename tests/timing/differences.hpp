/// Where two engines differ, in words; empty where they do not.
#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "halfspace/machine/frame_result.hpp"
#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/timing/cycle_stats.hpp"

namespace halfspace::testing {

template <class Value>
std::string difference(const std::string& what, const std::vector<Value>& ours,
                       const std::vector<Value>& other) {
  const auto [mine, theirs] = std::mismatch(ours.begin(), ours.end(), other.begin(), other.end());
  if (mine == ours.end() && theirs == other.end()) {
    return "";
  }
  std::ostringstream text;
  text << what << "[" << mine - ours.begin() << "]: ";
  mine == ours.end() ? text << "ends" : text << +*mine;
  text << " against ";
  theirs == other.end() ? text << "ends" : text << +*theirs;
  text << "\n";
  return text.str();
}

inline std::string difference(const std::string& what, std::uint64_t ours, std::uint64_t other) {
  return ours == other ? "" : what + ": " + std::to_string(ours) + " against " + std::to_string(other) + "\n";
}

/// The first packet that moves in another cycle, stage by stage.
inline std::string difference(const PacketTimes& ours, const PacketTimes& other) {
  std::string text;
  PacketTimes::lists([&](const char* name, auto list) { text += difference(name, ours.*list, other.*list); });
  return text;
}

inline std::string difference(const std::string& what, const CycleStats& ours, const CycleStats& other) {
  std::string text;
  for (std::size_t i = 0; i < kStages; ++i) {
    const std::string stage = what + std::string(kStageInfo[i].name) + ".";
    text += difference(stage + "busy", ours.stage[i].busy, other.stage[i].busy);
    for (std::size_t reason = 0; reason < kMostStallReasons; ++reason) {
      text += difference(stage + std::string(kStageInfo[i].stall[reason]), ours.stage[i].stall[reason],
                         other.stage[i].stall[reason]);
    }
  }
  for (std::size_t i = 0; i < kLinks; ++i) {
    const std::string link = what + std::string(kLinkName[i]) + ".";
    text += difference(link + "occupancy", ours.occupancy[i], other.occupancy[i]);
    text += difference(link + "held", ours.held[i], other.held[i]);
    text += difference(link + "packets", ours.packets[i], other.packets[i]);
  }
  text += difference(what + "read_busy", ours.read_busy, other.read_busy);
  return text + difference(what + "write_busy", ours.write_busy, other.write_busy);
}

inline std::string difference(const FrameCycles& ours, const FrameCycles& other) {
  std::string text = difference("cycles", ours.cycles, other.cycles);
  text += difference("", ours.stats, other.stats);
  text += difference("draws", ours.draws.size(), other.draws.size());
  for (std::size_t i = 0; i < std::min(ours.draws.size(), other.draws.size()); ++i) {
    const std::string draw = "draw " + std::to_string(i) + " ";
    text += difference(draw + "end", ours.draws[i].end, other.draws[i].end);
    text += difference(draw, ours.draws[i].stats, other.draws[i].stats);
  }
  return text;
}

inline std::string difference(const std::string& what, const Counters& ours, const Counters& other) {
  std::string text;
  Counters::units([&](const char* unit, auto member) {
    std::decay_t<decltype(ours.*member)>::fields([&](const char* name, auto, auto field) {
      text += difference(what + unit + "." + name, (ours.*member).*field, (other.*member).*field);
    });
  });
  return text;
}

template <class Value>
std::string difference(const std::string& what, const TiledImage<Value>& ours,
                       const TiledImage<Value>& other) {
  const auto rows = [](const TiledImage<Value>& image) {
    std::vector<Value> values;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        values.push_back(image.at(x, y));
      }
    }
    return values;
  };
  return ours.empty() != other.empty() ? what + " is missing\n"
         : ours.empty()                ? ""
                                       : difference(what, rows(ours), rows(other));
}

inline std::string difference(const std::string& what, const PacketSums& ours, const PacketSums& other) {
  const auto numbers = [](const PacketSums& sums) {
    std::vector<std::uint32_t> values;
    for (int y = 0; y < sums.decisions.height(); ++y) {
      for (int x = 0; x < sums.decisions.width(); ++x) {
        const TileDecisions& tile = sums.decisions.at(x, y);
        values.insert(values.end(), {tile.rejected, tile.accepted, tile.partial});
      }
    }
    for (int y = 0; y < sums.quads.height(); ++y) {
      for (int x = 0; x < sums.quads.width(); ++x) {
        const QuadLanes& place = sums.quads.at(x, y);
        values.insert(values.end(), {place.quads, place.covered});
      }
    }
    return values;
  };
  return difference(what, numbers(ours), numbers(other));
}

inline std::string difference(const FrameResult& ours, const FrameResult& other) {
  std::string text;
  text += difference("surfaces", ours.surfaces.size(), other.surfaces.size());
  for (std::size_t i = 0; i < std::min(ours.surfaces.size(), other.surfaces.size()); ++i) {
    const std::string surface = "surface " + std::to_string(i) + " ";
    text += difference(surface + "codes", ours.surfaces[i].codes, other.surfaces[i].codes);
    text += difference(surface + "fragments", ours.surfaces[i].fragments, other.surfaces[i].fragments);
    text += difference(surface + "survivors", ours.surfaces[i].survivors, other.surfaces[i].survivors);
    text += difference(surface + "visible", ours.surfaces[i].visible, other.surfaces[i].visible);
    text += difference(surface + "sums", ours.surfaces[i].sums, other.surfaces[i].sums);
    text += difference(surface, ours.surfaces[i].counters, other.surfaces[i].counters);
  }
  text += difference("draws", ours.draws.size(), other.draws.size());
  for (std::size_t i = 0; i < std::min(ours.draws.size(), other.draws.size()); ++i) {
    const std::string draw = "draw " + std::to_string(i) + " ";
    text += difference(draw + "command", ours.draws[i].command, other.draws[i].command);
    text += difference(draw + "surface", ours.draws[i].surface, other.draws[i].surface);
    text += difference(draw, ours.draws[i].counters, other.draws[i].counters);
  }
  text += difference("", ours.counters, other.counters);
  text += difference("drawn_clears ", ours.drawn_clears, other.drawn_clears);
  text += difference("clears", ours.clears, other.clears);
  text += difference("flushed_lines", ours.flushed_lines, other.flushed_lines);
  text += difference("flushed_bytes", ours.flushed_bytes, other.flushed_bytes);
  return text + difference("draws_not_filled", ours.draws_not_filled, other.draws_not_filled);
}

/// Everything that passes, as numbers.
class Events : public PacketObserver {
 public:
  std::vector<std::uint64_t> quads;
  std::vector<std::uint64_t> cycles;
  std::vector<std::uint64_t> decisions;
  std::vector<std::uint64_t> jobs;
  std::vector<std::uint64_t> done;

  [[nodiscard]] bool wants_quads() const override { return true; }
  [[nodiscard]] bool wants_decisions() const override { return true; }
  [[nodiscard]] bool wants_tile_jobs() const override { return true; }
  void quad(const QuadEvent& event) override {
    quads.insert(quads.end(),
                 {event.draw, event.triangle, event.surface, event.x, event.y, event.front, event.mask,
                  event.passed, event.depth[0], event.depth[1], event.depth[2], event.depth[3]});
    for (const QuadAttribute& attribute : event.attributes) {
      quads.insert(quads.end(), attribute.begin(), attribute.end());
    }
    cycles.push_back(event.cycle);
  }
  void decision(const DecisionEvent& event) override {
    decisions.insert(decisions.end(), {event.draw, event.triangle, event.surface, event.tile_x, event.tile_y,
                                       static_cast<std::uint64_t>(event.verdict)});
  }
  void tile_job(const TileJob& job) override {
    TileJob::fields([&](const char*, auto member, auto, auto) {
      if constexpr (std::is_integral_v<std::decay_t<decltype(job.*member)>>) {
        jobs.push_back(static_cast<std::uint64_t>(job.*member));
      } else {
        for (const auto value : job.*member) {
          jobs.push_back(static_cast<std::uint64_t>(value));
        }
      }
    });
  }
  void draw_done(std::size_t count, std::size_t of) override { done.insert(done.end(), {count, of}); }
};

inline std::string difference(const Events& ours, const Events& other) {
  return difference("quad events", ours.quads, other.quads) +
         difference("decisions", ours.decisions, other.decisions) +
         difference("jobs", ours.jobs, other.jobs) + difference("draws done", ours.done, other.done);
}

}  // namespace halfspace::testing
