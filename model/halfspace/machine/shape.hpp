/// The machine's shape: its stages with their reasons to wait, the FIFOs between them with their capacities,
/// and the places where stalls can be injected.
///
/// These tables are the one source of enumerations, names and array sizes in C++, of the activities and
/// probe events in rtl/raster_pkg.sv (report/raster_pkg.hpp), and of the names in reports. A new stage is a
/// row of HALFSPACE_STAGES, one of HALFSPACE_LINKS and its events. docs/units has the meaning of each reason.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "halfspace/config/config.hpp"

namespace halfspace {

// clang-format off
/// S(Identifier, name, what it works on, reasons to wait in order of priority). The first reason of every stage is
/// that it has nothing to do. In the order of the pipe.
#define HALFSPACE_STAGES(S)                                                                                    \
  S(Setup,         setup,          Triangle, "no_triangle", "divider", "no_credit")                            \
  S(BlockWalker,   block_walker,   Triangle, "no_triangle", "load", "no_credit")                               \
  S(HiZ,           hi_z,           Block,    "no_block", "no_update", "no_credit")                              \
  S(TileWalker,    tile_walker,    Block,    "no_block", "no_credit")                                          \
  S(EdgeEvaluator, edge_evaluator, Job,      "no_tile", "no_credit")                                           \
  S(QuadGenerator, quad_generator, Job,      "no_coverage", "no_credit")                                       \
  S(ZLookup,       z_lookup,       Burst,    "no_burst", "pending_full", "write_back", "fill_buffers", "request") \
  S(ZTest,         z_test,         Burst,    "no_burst", "late", "fill", "write_buffer", "no_credit")           \
  S(Interpolator,  interpolator,   Burst,    "no_burst", "no_credit")

/// L(Identifier, name, key of its capacity, latency, where its packets can be held back). The links, by the unit that
/// fills them; the queue and the pending store are inside setup and early_z. The latency is that of the unit: cycles
/// from the work on a packet to the cycle in which the next stage may take it.
#define HALFSPACE_LINKS(L)                                                                                     \
  L(SetupQueue,    setup_queue,     setup.queue,          4,                     std::nullopt)                 \
  L(Setup,         setup,           setup.fifo,                                                                \
    config.depth.interpolator == DepthInterpolator::kPlane ? 35 : 18 /* a division */, StallPoint::kSetup)     \
  L(BlockWalker,   block_walker,    block_walker.fifo,    2,                     StallPoint::kBlockWalker)     \
  L(HiZ,           hi_z,            hi_z.fifo,            6,                     StallPoint::kHiZ)             \
  L(TileWalker,    tile_walker,     tile_walker.fifo,     3,                     StallPoint::kTileWalker)      \
  L(EdgeEvaluator, edge_evaluator,  edge_evaluator.fifo,                                                       \
    config.edge_evaluator.pipe_stages + 1 /* and the output register */,         StallPoint::kEdgeEvaluator)   \
  L(QuadGenerator, quad_generator,  quad_generator.fifo,  2,                     StallPoint::kQuadGenerator)   \
  L(EarlyZPending, early_z_pending, early_z.pending,      config.depth.latency + 5 /* lookup and store */,     \
    std::nullopt)                                                                                            \
  L(EarlyZ,        early_z,         early_z.fifo,         2,                     StallPoint::kSink)            \
  L(Interpolator,  interpolator,    interpolator.fifo,    config.interpolator.bits / 2 + 22 /* E at the quad */, \
    StallPoint::kInterpolator)

/// The same for the buffers of the memory side: FIFOs with credits, but no links.
#define HALFSPACE_BUFFERS(B)                                                                                   \
  B(FillBuffers,   fill_buffers,    z_cache.misses_in_flight)                                                  \
  B(WriteBuffers,  write_buffers,   z_cache.write_buffers)

/// P(Identifier, name): packet n of a link counts as visible so many cycles later; triangle n of the source
/// arrives, and burst n is taken by what follows early_z, so many cycles later.
#define HALFSPACE_STALL_POINTS(P)                                                                            \
  P(Source,        source)                                                                                   \
  P(Setup,         setup)                                                                                    \
  P(BlockWalker,   block_walker)                                                                             \
  P(HiZ,           hi_z)                                                                                     \
  P(TileWalker,    tile_walker)                                                                              \
  P(EdgeEvaluator, edge_evaluator)                                                                           \
  P(QuadGenerator, quad_generator)                                                                           \
  P(Sink,          sink)                                                                                     \
  P(Interpolator,  interpolator)

/// E(Identifier, meaning): what can happen in a cycle of the RTL, a bit each in the probe of its bench.
#define HALFSPACE_EVENTS(E)                                                                                  \
  E(Decide,    "setup draws or drops a triangle")                                                            \
  E(Accept,    "block_walker takes a triangle")                                                              \
  E(Block,     "block_walker makes a block job")                                                             \
  E(HiZ,       "hi_z takes a block")                                                                         \
  E(BlockDone, "tile_walker makes the last tile job of a block job")                                         \
  E(Emit,      "tile_walker makes a tile job")                                                               \
  E(Job,       "edge_evaluator takes a tile job")                                                            \
  E(Coverage,  "quad_generator takes a coverage")                                                            \
  E(Beat,      "z_lookup takes a beat")                                                                      \
  E(FirstBeat, "it is the first of its burst")                                                               \
  E(LastBeat,  "it is the last of its burst")                                                                \
  E(TestFirst, "z_test tests the first beat of a burst")                                                     \
  E(TestLast,  "z_test tests the last beat of a burst")
// clang-format on

// Enumerators are k##Identifier, numbered by their row.
#define HALFSPACE_ENUMERATOR(identifier, ...) k##identifier,
#define HALFSPACE_NAME(identifier, name, ...) std::string_view{#name},
#define HALFSPACE_ONE(...) +1

enum class Stage : std::uint8_t { HALFSPACE_STAGES(HALFSPACE_ENUMERATOR) };
inline constexpr std::size_t kStages = HALFSPACE_STAGES(HALFSPACE_ONE);

inline constexpr std::size_t kMostStallReasons = 5;

/// A burst belongs to a tile job, that to a block job, and that to a triangle.
enum class PacketKind : std::uint8_t { kTriangle, kBlock, kJob, kBurst };

struct StageInfo {
  std::string_view name;
  PacketKind works_on;
  std::array<std::string_view, kMostStallReasons> stall;  ///< empty where there is no further reason
};

#define HALFSPACE_STAGE_INFO(identifier, name, kind, ...) \
  StageInfo{#name, PacketKind::k##kind, {__VA_ARGS__}},
inline constexpr std::array<StageInfo, kStages> kStageInfo{HALFSPACE_STAGES(HALFSPACE_STAGE_INFO)};
#undef HALFSPACE_STAGE_INFO

/// Position of a reason in StageInfo::stall. Does not compile for a name that is not in the table.
consteval std::size_t stall_reason(Stage stage, std::string_view name) {
  const auto& reasons = kStageInfo[static_cast<std::size_t>(stage)].stall;
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    if (reasons[i] == name) {
      return i;
    }
  }
  throw "no such reason";
}

namespace stall {
inline constexpr std::size_t kNoInput = 0;
inline constexpr std::size_t kSetupDivider = stall_reason(Stage::kSetup, "divider");
inline constexpr std::size_t kSetupNoCredit = stall_reason(Stage::kSetup, "no_credit");
inline constexpr std::size_t kBlockLoad = stall_reason(Stage::kBlockWalker, "load");
inline constexpr std::size_t kBlockNoCredit = stall_reason(Stage::kBlockWalker, "no_credit");
inline constexpr std::size_t kHiZNoUpdate = stall_reason(Stage::kHiZ, "no_update");
inline constexpr std::size_t kHiZNoCredit = stall_reason(Stage::kHiZ, "no_credit");
inline constexpr std::size_t kTileNoCredit = stall_reason(Stage::kTileWalker, "no_credit");
inline constexpr std::size_t kEdgeNoCredit = stall_reason(Stage::kEdgeEvaluator, "no_credit");
inline constexpr std::size_t kQuadNoCredit = stall_reason(Stage::kQuadGenerator, "no_credit");
inline constexpr std::size_t kLookupPendingFull = stall_reason(Stage::kZLookup, "pending_full");
inline constexpr std::size_t kLookupWriteBack = stall_reason(Stage::kZLookup, "write_back");
inline constexpr std::size_t kLookupFillBuffers = stall_reason(Stage::kZLookup, "fill_buffers");
inline constexpr std::size_t kLookupRequest = stall_reason(Stage::kZLookup, "request");
inline constexpr std::size_t kTestLate = stall_reason(Stage::kZTest, "late");
inline constexpr std::size_t kTestFill = stall_reason(Stage::kZTest, "fill");
inline constexpr std::size_t kTestWriteBuffer = stall_reason(Stage::kZTest, "write_buffer");
inline constexpr std::size_t kTestNoCredit = stall_reason(Stage::kZTest, "no_credit");
inline constexpr std::size_t kInterpolatorNoCredit = stall_reason(Stage::kInterpolator, "no_credit");
}  // namespace stall

enum class StallPoint : std::uint8_t { HALFSPACE_STALL_POINTS(HALFSPACE_ENUMERATOR) };
inline constexpr std::size_t kStallPoints = HALFSPACE_STALL_POINTS(HALFSPACE_ONE);
inline constexpr std::array<std::string_view, kStallPoints> kStallPointName{
    HALFSPACE_STALL_POINTS(HALFSPACE_NAME)};

enum class Link : std::uint8_t { HALFSPACE_LINKS(HALFSPACE_ENUMERATOR) };
inline constexpr std::size_t kLinks = HALFSPACE_LINKS(HALFSPACE_ONE);
inline constexpr std::array<std::string_view, kLinks> kLinkName{HALFSPACE_LINKS(HALFSPACE_NAME)};

/// Everything with credits: the links, in their order, then the buffers.
enum class Fifo : std::uint8_t {
  HALFSPACE_LINKS(HALFSPACE_ENUMERATOR) HALFSPACE_BUFFERS(HALFSPACE_ENUMERATOR)
};
inline constexpr std::size_t kFifos = kLinks HALFSPACE_BUFFERS(HALFSPACE_ONE);
inline constexpr std::array<std::string_view, kFifos> kFifoName{HALFSPACE_LINKS(HALFSPACE_NAME)
                                                                    HALFSPACE_BUFFERS(HALFSPACE_NAME)};

/// Of each FIFO, in packets.
inline std::array<int, kFifos> capacities(const Config& config) {
#define HALFSPACE_CAPACITY(identifier, name, key, ...) config.key,
  return {HALFSPACE_LINKS(HALFSPACE_CAPACITY) HALFSPACE_BUFFERS(HALFSPACE_CAPACITY)};
#undef HALFSPACE_CAPACITY
}

/// Cycles from the work on a packet of the link to the cycle in which the next stage may take it.
constexpr int latency(Link link, const Config& config) {
#define HALFSPACE_LATENCY(identifier, name, key, cycles, ...) (cycles),
  const std::array<int, kLinks> table{HALFSPACE_LINKS(HALFSPACE_LATENCY)};
#undef HALFSPACE_LATENCY
  return table[static_cast<std::size_t>(link)];
}

/// Of all links together.
constexpr int sum_of_latencies(const Config& config) {
  int sum = 0;
  for (std::size_t i = 0; i < kLinks; ++i) {
    sum += latency(static_cast<Link>(i), config);
  }
  return sum;
}

#define HALFSPACE_HELD_BACK(identifier, name, key, cycles, point) point,
/// Where the packets of a link can be held back.
inline constexpr std::array<std::optional<StallPoint>, kLinks> kHeldBackAt{
    HALFSPACE_LINKS(HALFSPACE_HELD_BACK)};
#undef HALFSPACE_HELD_BACK

enum class Event : std::uint8_t { HALFSPACE_EVENTS(HALFSPACE_ENUMERATOR) };
inline constexpr std::size_t kEvents = HALFSPACE_EVENTS(HALFSPACE_ONE);
struct EventInfo {
  std::string_view name;
  std::string_view meaning;
};
#define HALFSPACE_EVENT_INFO(identifier, meaning) EventInfo{#identifier, meaning},
inline constexpr std::array<EventInfo, kEvents> kEventInfo{HALFSPACE_EVENTS(HALFSPACE_EVENT_INFO)};
#undef HALFSPACE_EVENT_INFO

#undef HALFSPACE_ENUMERATOR
#undef HALFSPACE_NAME
#undef HALFSPACE_ONE

}  // namespace halfspace
