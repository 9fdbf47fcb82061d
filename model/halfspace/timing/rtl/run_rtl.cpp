#include "halfspace/timing/rtl/run_rtl.hpp"

#include <fmt/format.h>

#include <utility>

#include "halfspace/machine/tile_size.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/timing/rtl/driver.hpp"
#include "halfspace/timing/rtl/scoreboard.hpp"

namespace halfspace {
namespace {

using namespace rtl;

void check_options(const EngineOptions& options) {
  for (std::size_t i = 0; i < kStallPoints; ++i) {
    const auto point = static_cast<StallPoint>(i);
    if (options.stalls.rate[i].any() && point != StallPoint::kSource && point != StallPoint::kSink) {
      throw OptionError(fmt::format("stalls at '{}'; legal for the RTL: source, sink", kStallPointName[i]));
    }
  }
}

void check_size(const Frame& frame, const RunState& run) {
  const std::uint32_t tiles = run.places.empty() ? 0 : run.places.back().first_tile + run.places.back().tiles;
  const int size = run.config.tile_walker.tile_size;
  if (tiles > memory_tiles(run.config)) {
    throw InputError(
        fmt::format("{}: its depth surfaces have {} tiles of {}x{}; legal for the RTL: at most {}",
                    frame.name, tiles, size, size, memory_tiles(run.config)));
  }
  const std::uint32_t blocks =
      run.blocks.empty() ? 0 : run.blocks.back().first_block + run.blocks.back().blocks;
  if (run.config.hi_z.enabled && blocks > kMemoryBlocks) {
    throw InputError(
        fmt::format("{}: its depth surfaces have {} blocks; legal for hi_z of the RTL: at most {}",
                    frame.name, blocks, kMemoryBlocks));
  }
}

/// The codes of depths below 0 are negative numbers, which the RTL takes for large ones, and hi_z of the RTL
/// looks at every surface.
void check_depths(const Frame& frame) {
  for (std::size_t i = 0; i < frame.commands.size(); ++i) {
    const Command& command = frame.commands[i];
    if (!command.is_unrestricted(frame.targets[command.target].depth_format)) {
      continue;
    }
    const bool is_clear = command.kind == CommandKind::kClear;
    throw InputError(fmt::format(
        "{}: command {}: {}; legal for the RTL: 0 to 1", frame.name, i,
        is_clear ? fmt::format("clear_depth is {}", command.clear_depth)
                 : fmt::format("depth_range is {} to {}", command.depth_range.x, command.depth_range.y)));
  }
}

/// Driver, scoreboard, sink and memory of one run.
template <int TileSize>
class RtlRun final : public PortListener {
 public:
  RtlRun(const Frame& frame, RunState& run)
      : run_(run), memory_(run), sink_(run), scoreboard_(run, memory_, sink_), driver_(frame, run, *this) {}

  TimedResult run() {
    driver_.run();
    TimedResult result;
    result.cycles = run_.meter.finish(run_.cycle, run_.draws);
    driver_.check_counters();
    scoreboard_.expect_no_more();
    sink_.expect_no_more();
    memory_.expect_no_more();
    collect_draws(run_.draws, run_.result);
    for (std::size_t i = 0; i < run_.places.size(); ++i) {
      memory_.read_surface(i);
    }
    result.frame = std::move(run_.result);
    result.times = std::move(run_.times);
    return result;
  }

  void offer_fill() override { memory_.offer_fill(); }
  [[nodiscard]] bool sink_ready() override { return sink_.ready(); }
  void answer_late() override { sink_.answer_late(); }
  void begin_packets() override { scoreboard_.begin_packets(); }
  void take_triangle(const ScreenTriangle& triangle, DrawContext& draw,
                     const DrawStatePacket& state) override {
    scoreboard_.take_triangle(triangle, draw, state);
  }
  void clear(std::uint32_t surface, std::uint32_t code) override { scoreboard_.clear(surface, code); }
  void flush() override { scoreboard_.flush(); }
  void request() override { memory_.request(); }
  void links() override { scoreboard_.links(); }
  void take_tested_beat() override { sink_.take(); }
  void write() override { memory_.write(); }

 private:
  RunState& run_;
  MemoryPort memory_;
  TestedSink<TileSize> sink_;
  Scoreboard<TileSize> scoreboard_;
  Driver driver_;
};

}  // namespace

RtlResult run_rtl(const Frame& frame, const Config& config, const EngineOptions& options,
                  VerilatedPipeline& pipeline) {
  check_options(options);
  check_depths(frame);
  RtlResult result;
  RunState run(frame, config, options, pipeline, result.report);
  check_size(frame, run);
  result.timed = with_tile_size(config.tile_walker.tile_size,
                                [&](auto size) { return RtlRun<size()>(frame, run).run(); });
  return result;
}

}  // namespace halfspace
