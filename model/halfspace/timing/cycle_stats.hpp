/// Where the cycles of a run went: for each stage busy or a stall reason, for each link its occupancy, for
/// memory its channels. Reasons are in order of priority; docs/units has their meaning.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace halfspace {

enum class Stage : std::uint8_t {
  kSetup,
  kTileWalker,
  kEdgeEvaluator,
  kQuadGenerator,
  kZLookup,
  kEarlyZ,
};
inline constexpr std::size_t kStages = 6;

inline constexpr std::size_t kMostStallReasons = 5;

struct StageInfo {
  std::string_view name;
  std::array<std::string_view, kMostStallReasons> stall;  ///< empty where there is no further reason
};

inline constexpr std::array<StageInfo, kStages> kStageInfo{{
    {"setup", {"no_triangle", "divider", "no_credit"}},
    {"tile_walker", {"no_triangle", "load", "no_credit"}},
    {"edge_evaluator", {"no_tile", "no_credit"}},
    {"quad_generator", {"no_coverage", "no_credit"}},
    {"z_lookup", {"no_burst", "pending_full", "write_back", "fill_buffers", "request"}},
    {"early_z", {"no_burst", "fill", "write_buffer", "no_credit"}},
}};

/// Positions in StageInfo::stall. The first of every stage is that it has nothing to do.
namespace stall {
inline constexpr std::size_t kNoInput = 0;
inline constexpr std::size_t kSetupDivider = 1;
inline constexpr std::size_t kSetupNoCredit = 2;
inline constexpr std::size_t kWalkerLoad = 1;
inline constexpr std::size_t kWalkerNoCredit = 2;
inline constexpr std::size_t kEdgeNoCredit = 1;
inline constexpr std::size_t kQuadNoCredit = 1;
inline constexpr std::size_t kLookupPendingFull = 1;
inline constexpr std::size_t kLookupWriteBack = 2;
inline constexpr std::size_t kLookupFillBuffers = 3;
inline constexpr std::size_t kLookupRequest = 4;
inline constexpr std::size_t kTestFill = 1;
inline constexpr std::size_t kTestWriteBuffer = 2;
inline constexpr std::size_t kTestNoCredit = 3;
}  // namespace stall

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

/// The FIFOs, by the unit that fills them; the queue and the pending store are inside setup and early_z.
enum class Link : std::uint8_t {
  kSetupQueue,
  kSetup,
  kTileWalker,
  kEdgeEvaluator,
  kQuadGenerator,
  kEarlyZPending,
  kEarlyZ,
};
inline constexpr std::size_t kLinks = 7;
inline constexpr std::array<std::string_view, kLinks> kLinkName{
    "setup_queue", "setup", "tile_walker", "edge_evaluator", "quad_generator", "early_z_pending", "early_z"};

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

  friend bool operator==(const CycleStats&, const CycleStats&) = default;
};

struct DrawCycles {
  std::uint64_t end =
      0;  ///< cycle in which its last burst has left the sink; that of the draw before, if none
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

/// When the stages took the packets of a run, one entry a packet, for comparison of engines.
struct PacketTimes {
  std::vector<std::uint64_t> decide;  ///< setup: every triangle, dropped or drawn
  std::vector<std::uint64_t> accept;  ///< tile_walker: every triangle that is drawn
  std::vector<std::uint64_t> emit;    ///< tile_walker: every tile job
  std::vector<std::uint64_t> e;       ///< edge_evaluator: every tile job
  std::vector<std::uint64_t> g;       ///< quad_generator: every coverage
  std::vector<std::uint64_t> f;       ///< early_z lookup: every burst
  std::vector<std::uint64_t> b;       ///< early_z test: every burst
  std::vector<std::uint64_t> y;       ///< sink: every burst

  friend bool operator==(const PacketTimes&, const PacketTimes&) = default;
};

}  // namespace halfspace
