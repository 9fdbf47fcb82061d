#include "halfspace/fast/fast_core.hpp"

#include <barrier>
#include <exception>
#include <thread>
#include <utility>
#include <vector>

#include "halfspace/fast/frame_memory.hpp"
#include "halfspace/fast/frame_run.hpp"

namespace halfspace::fast {

class FastCore::Runner {
 public:
  /// The packets of a stream are in order, so one thread writes them.
  Runner(const Config& config, const Watch& watch, StreamReader* reader)
      : memory_(config, watch, reader != nullptr ? 1 : FrameMemory::useful_threads(config, watch)) {
    for (std::uint32_t thread = 0; thread < memory_.threads; ++thread) {
      runs_.emplace_back(memory_, thread, reader);
    }
  }

  void run(const Frame& frame) {
    memory_.begin(frame);
    std::vector<FrameResult> results(runs_.size());
    std::vector<std::exception_ptr> errors(runs_.size());
    FrameRun::Barrier all(static_cast<std::ptrdiff_t>(runs_.size()));
    const auto run = [&](std::size_t thread) {
      try {
        runs_[thread].run(frame, all, results[thread]);
      } catch (...) {
        errors[thread] = std::current_exception();
        all.arrive_and_drop();  // the others need not wait
      }
    };
    {
      std::vector<std::jthread> others;
      for (std::size_t thread = 1; thread < runs_.size(); ++thread) {
        try {
          others.emplace_back(run, thread);
        } catch (...) {  // it has not begun
          errors[thread] = std::current_exception();
          all.arrive_and_drop();
        }
      }
      run(0);
    }
    for (const std::exception_ptr& error : errors) {
      if (error) {
        std::rethrow_exception(error);
      }
    }
    result_ = std::move(results[0]);
    result_.core = Core::kFast;
    result_.surfaces = std::move(memory_.surfaces);
    collect_draws(add_up(), result_);
    memory_.surfaces = std::move(result_.surfaces);
  }

  [[nodiscard]] const Counters& counters() const { return result_.counters; }

  FrameResult take() {
    result_.surfaces = memory_.take();
    return std::move(result_);
  }

 private:
  /// The draws of the first thread, with what the others have counted; all have seen all triangles.
  const std::deque<DrawContext>& add_up() {
    std::deque<DrawContext>& draws = runs_[0].draws();
    for (std::size_t thread = 1; thread < runs_.size(); ++thread) {
      for (std::size_t i = 0; i < draws.size(); ++i) {
        Counters& counters = runs_[thread].draws()[i].counters;
        counters.front_end = {};
        counters.setup = {};
        draws[i].counters += counters;
      }
    }
    return draws;
  }

  FrameMemory memory_;
  std::deque<FrameRun> runs_;  ///< a thread each
  FrameResult result_;         ///< its surfaces are in memory_ until it is taken
};

FastCore::FastCore(const Config& config, const Watch& watch, StreamReader* reader)
    : runner_(std::make_unique<Runner>(config, watch, reader)) {}
FastCore::~FastCore() = default;
FastCore::FastCore(FastCore&&) noexcept = default;

void FastCore::run(const Frame& frame) { runner_->run(frame); }
const Counters& FastCore::counters() const { return runner_->counters(); }
FrameResult FastCore::take() { return runner_->take(); }

std::string_view gap(const Config& config, const Watch& watch, const StreamReader* reader) {
  if (reader != nullptr && reader->wants_tiles()) {
    return "a timeline";
  }
  if (config.raster.conservative != Conservative::kOff) {
    return config.raster.conservative == Conservative::kOuter ? "raster.conservative = outer"
                                                              : "raster.conservative = inner";
  }
  if (!sample_pattern(config).is_centre()) {
    return "raster.samples, or a sample that is not at the centre of its pixel";
  }
  if (config.hi_z.enabled) {
    return "hi_z.enabled = true";
  }
  if (config.interpolator.enabled) {
    return "interpolator.enabled = true";
  }
  if (config.late_z.mode == LateZ::kLate) {
    return "late_z.mode = late";
  }
  if (config.block_walker.sample_reject) {
    return "block_walker.sample_reject = true";
  }
  if (config.block_walker.levels != 2) {
    return "block_walker.levels other than 2";
  }
  if (config.block_walker.order != WalkOrder::kRaster || config.tile_walker.order != TileOrder::kRaster) {
    return "an order of walking other than raster";
  }
  if (config.z_cache.compression) {
    return "z_cache.compression = true";
  }
  if (config.tile_walker.tile_size > 8) {
    return "tile_walker.tile_size = 16";
  }
  const PacketObserver* const observer = watch.observer;
  const bool shows = observer != nullptr && (observer->wants_quads() || observer->wants_decisions() ||
                                             observer->wants_tile_jobs() || observer->wants_walk());
  return shows ? "a run whose packets are recorded or whose quads are merged" : "";
}

}  // namespace halfspace::fast
