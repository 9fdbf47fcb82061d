/// Where the cycles of a run went: for each stage busy or a stall reason, for each link its occupancy, for
/// memory its channels. Stages, reasons and links are those of machine/shape.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "halfspace/machine/shape.hpp"

namespace halfspace {

struct StageCycles {
  std::uint64_t busy = 0;
  std::array<std::uint64_t, kMostStallReasons> stall{};

  [[nodiscard]] std::uint64_t total() const {
    std::uint64_t sum = busy;
    for (const std::uint64_t cycles : stall) {
      sum += cycles;
    }
    return sum;
  }
  StageCycles& operator+=(const StageCycles& other) {
    busy += other.busy;
    for (std::size_t i = 0; i < stall.size(); ++i) {
      stall[i] += other.stall[i];
    }
    return *this;
  }
  friend bool operator==(const StageCycles&, const StageCycles&) = default;
};

/// Cycles by the number of credits in use, 0 to the capacity.
using Occupancy = std::vector<std::uint64_t>;

/// Of a draw or a frame.
struct CycleStats {
  std::array<StageCycles, kStages> stage;
  std::array<Occupancy, kLinks> occupancy;   ///< of a frame; empty for a draw
  std::array<std::uint64_t, kLinks> held{};  ///< sum over packets of the cycles each held its credit
  std::array<std::uint64_t, kLinks> packets{};
  std::uint64_t read_busy = 0;  ///< cycles in which memory's read channel moves data
  std::uint64_t write_busy = 0;

  /// All but the occupancies, which do not add up.
  CycleStats& operator+=(const CycleStats& other) {
    for (std::size_t i = 0; i < kStages; ++i) {
      stage[i] += other.stage[i];
    }
    for (std::size_t i = 0; i < kLinks; ++i) {
      held[i] += other.held[i];
      packets[i] += other.packets[i];
    }
    read_busy += other.read_busy;
    write_busy += other.write_busy;
    return *this;
  }
  friend bool operator==(const CycleStats&, const CycleStats&) = default;
};

struct DrawCycles {
  /// Cycle in which its last burst has left the sink; that of the draw before, if it has none.
  std::uint64_t end = 0;
  CycleStats stats;

  friend bool operator==(const DrawCycles&, const DrawCycles&) = default;
};

/// Time of a frame.
struct FrameCycles {
  std::uint64_t cycles = 0;
  CycleStats stats;
  std::vector<DrawCycles> draws;

  friend bool operator==(const FrameCycles&, const FrameCycles&) = default;
};

// clang-format off
/// T(name, what): the packets whose cycles are noted one by one, for comparison of engines.
#define HALFSPACE_PACKET_TIMES(T)                            \
  T(decide, "setup: every triangle, dropped or drawn")       \
  T(accept, "block_walker: every triangle that is drawn")    \
  T(block,  "block_walker: every block job")                 \
  T(hi_z,   "hi_z: every block job")                         \
  T(emit,   "tile_walker: every tile job")                   \
  T(e,      "edge_evaluator: every tile job")                \
  T(g,      "quad_generator: every coverage")                \
  T(f,      "z_lookup: every burst")                         \
  T(b,      "z_test: every burst")                           \
  T(y,      "sink, or interpolator: every burst")            \
  T(s,      "sink: every quad of the interpolator")
// clang-format on

/// When the stages took the packets of a run, one entry a packet.
struct PacketTimes {
#define HALFSPACE_PACKET_TIME(name, what) std::vector<std::uint64_t> name;
  HALFSPACE_PACKET_TIMES(HALFSPACE_PACKET_TIME)
#undef HALFSPACE_PACKET_TIME

  /// Calls visit(name, member) for each list.
  template <class Visit>
  static void lists(Visit&& visit) {
#define HALFSPACE_PACKET_TIME(name, what) visit(#name, &PacketTimes::name);
    HALFSPACE_PACKET_TIMES(HALFSPACE_PACKET_TIME)
#undef HALFSPACE_PACKET_TIME
  }

  friend bool operator==(const PacketTimes&, const PacketTimes&) = default;
};

}  // namespace halfspace
