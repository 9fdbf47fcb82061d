#include "halfspace/timing/analytic/analytic.hpp"

#include <algorithm>

#include "halfspace/core/run_core.hpp"
#include "halfspace/timing/contract.hpp"

namespace halfspace {
namespace {

/// Sums the stream of a frame while the units run.
class WorkReader final : public StreamReader {
 public:
  explicit WorkReader(FrameWork& work) : work_(work) {}

  void begin(std::span<const StreamSurface> surfaces, std::uint32_t /*memory_lines*/) override {
    surfaces_.assign(surfaces.begin(), surfaces.end());
  }
  void read(const StreamView& part, std::vector<std::uint64_t>* /*burst_cycles*/) override {
    work_.add(part, surfaces_);
  }
  void end(std::span<const ZFlush> dirty) override { work_.flush.assign(dirty.begin(), dirty.end()); }

 private:
  FrameWork& work_;
  std::vector<StreamSurface> surfaces_;
};

}  // namespace

std::uint64_t fill_cycles(const Config& config) {
  const int cycles = sum_of_latencies(config) + 1;
  return static_cast<std::uint64_t>(cycles);
}

AnalyticDraw analytic_draw(const DrawWork& work, const Config& config) {
  std::uint64_t jobs = 0;
  std::uint64_t quad = 0;
  std::uint64_t test = 0;
  for (std::size_t quads = 0; quads < work.tiles.size(); ++quads) {
    const std::uint64_t count = work.tiles[quads];
    const int q = static_cast<int>(quads);
    jobs += count;
    quad += count * static_cast<std::uint64_t>(std::max(1, beats(q, config.quad_generator.quads_per_cycle)));
    test += count * static_cast<std::uint64_t>(beats(q, config.early_z.quads_per_cycle));
  }
  std::uint64_t fetches = 0;
  std::uint64_t read = 0;
  std::uint64_t write = 0;
  for (std::size_t i = 0; i < work.fetched.size(); ++i) {
    fetches += work.fetched[i];
    read += work.fetched[i] * static_cast<std::uint64_t>(transfer_cycles(1 << i, config.memory.read_bytes));
    write +=
        work.written_back[i] * static_cast<std::uint64_t>(transfer_cycles(1 << i, config.memory.write_bytes));
  }
  // a fill buffer is taken from the request until the line goes into the cache
  const std::uint64_t a_fetch =
      static_cast<std::uint64_t>(config.memory.latency) + (fetches == 0 ? 0 : read / fetches);
  const std::array<std::uint64_t, kBounds> cycles{
      std::max(work.triangles, work.drawn * static_cast<std::uint64_t>(config.setup.interval)),
      work.steps * static_cast<std::uint64_t>(config.tile_walker.step_interval),
      jobs,
      quad,
      test,
      read,
      fetches * a_fetch / static_cast<std::uint64_t>(config.z_cache.misses_in_flight),
      write};
  const auto most = std::max_element(cycles.begin(), cycles.end());
  return {.cycles = *most, .bound = static_cast<Bound>(most - cycles.begin())};
}

AnalyticFrame analytic_frame(const FrameWork& work, const Config& config) {
  AnalyticFrame frame;
  frame.cycles = fill_cycles(config) + analytic_draw(work.drawn_clears, config).cycles;
  for (const DrawWork& draw : work.draws) {
    frame.draws.push_back(analytic_draw(draw, config));
    frame.cycles += frame.draws.back().cycles;
  }
  for (const std::uint32_t tiles : work.fast_clears) {
    frame.cycles += static_cast<std::uint64_t>(fast_clear_cycles(tiles, config)) + fill_cycles(config);
  }
  std::uint64_t flush = 0;
  for (const ZFlush& line : work.flush) {
    flush +=
        static_cast<std::uint64_t>(transfer_cycles(static_cast<int>(line.bytes), config.memory.write_bytes));
  }
  frame.cycles += std::max(flush, static_cast<std::uint64_t>(config.z_cache.lines));
  return frame;
}

AnalyticResult run_analytic(const Frame& frame, const Config& config, const Watch& watch) {
  FrameWork work;
  WorkReader reader(work);
  AnalyticResult result;
  result.frame = run_core(frame, config, watch, &reader);
  result.estimate = analytic_frame(work, config);
  return result;
}

}  // namespace halfspace
