#include "halfspace/run/run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/config/did_you_mean.hpp"
#include "halfspace/core/functional.hpp"
#include "halfspace/machine/observer_pair.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/timing/recurrence/run_recurrence.hpp"
#include "halfspace/timing/rtl/pipeline_library.hpp"
#include "halfspace/timing/rtl/rest_skipper.hpp"
#include "halfspace/timing/rtl/run_rtl.hpp"
#include "halfspace/timing/systemc/run_systemc.hpp"

namespace halfspace {
namespace {

void check_options(Fidelity fidelity, const RunOptions& options) {
  if (options.watch.threads < 1 || options.watch.threads > kMostThreads) {
    throw OptionError(fmt::format("threads is {}; legal: 1 to {}", options.watch.threads, kMostThreads));
  }
  require(fidelity, options.watch.core != Core::kAuto, "a core of its own", &FidelityInfo::core);
  require(fidelity, options.watch.threads > 1, "more threads than one", &FidelityInfo::threads);
  require(fidelity, options.stalls.any(), "a stall", &FidelityInfo::packets);
  require(fidelity, options.packet_times, "the time of every packet", &FidelityInfo::packets);
  require(fidelity, options.cycle_observer != nullptr, "a timeline", &FidelityInfo::timeline);
  require(fidelity, !options.vcd.empty(), "a VCD file", &FidelityInfo::vcd);
  require(fidelity, !options.wave.empty(), "an FST file", &FidelityInfo::rtl);
  require(fidelity, options.rtl_every_cycle, "every cycle of the RTL", &FidelityInfo::rtl);
}

/// Names of the fidelities that `support` something, or of all.
std::string fidelity_names(bool FidelityInfo::*support = nullptr) {
  std::vector<std::string_view> names;
  for (const FidelityInfo& each : kFidelityInfo) {
    if (support == nullptr || each.*support) {
      names.push_back(each.name);
    }
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

RunResult timed(TimedResult result) {
  return {.frame = std::move(result.frame),
          .cycles = std::move(result.cycles),
          .times = std::move(result.times),
          .rtl = {},
          .quad_merging = {},
          .pixel_rate = {},
          .reference = {}};
}

RunResult verilated(const Frame& frame, const Config& config, const EngineOptions& engine,
                    const RunOptions& options) {
  const std::unique_ptr<rtl::VerilatedPipeline> pipeline = verilated_pipeline(config, options);
  RtlResult result = run_rtl(frame, config, engine, *pipeline);
  RunResult run = timed(std::move(result.timed));
  run.rtl = std::move(result.report);
  return run;
}

RunResult run_engine(Fidelity fidelity, const Frame& frame, const Config& config, const RunOptions& options) {
  const EngineOptions engine{.watch = options.watch,
                             .stalls = options.stalls,
                             .packet_times = options.packet_times,
                             .observer = options.cycle_observer};
  switch (fidelity) {
    case Fidelity::kFunctional:
      return {.frame = run_functional(frame, config, options.watch),
              .cycles = {},
              .times = {},
              .rtl = {},
              .quad_merging = {},
              .pixel_rate = {},
              .reference = {}};
    case Fidelity::kRecurrence:
      return timed(run_recurrence(frame, config, engine));
    case Fidelity::kSystemc:
      return timed(run_systemc(frame, config, engine, {.vcd = options.vcd, .activations = nullptr}));
    case Fidelity::kRtl:
      return verilated(frame, config, engine, options);
  }
  throw std::logic_error("a fidelity that is not in HALFSPACE_FIDELITIES");
}

std::size_t draw_count(const Frame& frame) {
  return static_cast<std::size_t>(std::ranges::count(frame.commands, CommandKind::kDraw, &Command::kind));
}

}  // namespace

Fidelity fidelity_of(std::string_view name) {
  const auto* const found = std::ranges::find(kFidelityInfo, name, &FidelityInfo::name);
  if (found == kFidelityInfo.end()) {
    throw OptionError(fmt::format("fidelity is '{}'{}; legal: {}", name,
                                  did_you_mean(name, kFidelityInfo, &FidelityInfo::name), fidelity_names()));
  }
  return found->fidelity;
}

void require(Fidelity fidelity, bool given, std::string_view option, bool FidelityInfo::*support) {
  if (given && !(info(fidelity).*support)) {
    throw OptionError(fmt::format("fidelity is '{}', which does not support {}; legal with it: {}",
                                  info(fidelity).name, option, fidelity_names(support)));
  }
}

std::unique_ptr<rtl::VerilatedPipeline> verilated_pipeline(const Config& config, const RunOptions& options) {
  std::unique_ptr<rtl::VerilatedPipeline> pipeline =
      rtl::load_pipeline(config, options.rtl_folder, options.rtl_seed);
  if (!options.wave.empty()) {
    pipeline->trace_to(options.wave);
    return pipeline;
  }
  return options.rtl_every_cycle ? std::move(pipeline) : rtl::skipping_rests(std::move(pipeline));
}

RunResult run(Fidelity fidelity, const Frame& frame, const Config& config, const RunOptions& options) {
  check_options(fidelity, options);
  const SamplePattern samples = sample_pattern(config);
  if (options.quad_merging && !samples.is_centre()) {
    throw OptionError(
        fmt::format("configuration key 'raster.samples' is {}; legal with quad merging: 1, at the "
                    "pixel centre",
                    config.raster.samples));
  }
  RunOptions watched = options;
  std::optional<ObserverPair> both;
  const auto watch = [&](PacketObserver& stage) {
    if (options.watch.observer != nullptr) {
      both.emplace(*options.watch.observer, stage);
    }
    watched.watch.observer = both ? static_cast<PacketObserver*>(&*both) : &stage;
  };
  std::optional<QuadMerging> merging;
  std::optional<PixelRate> pixel_rate;
  if (options.quad_merging) {
    watch(merging.emplace(frame, *options.quad_merging));
  } else if (options.pixel_rate && samples.count > 1) {
    watch(pixel_rate.emplace(draw_count(frame), config.tile_walker.tile_size, samples, options.pixel_quad));
  }
  RunResult result = run_engine(fidelity, frame, config, watched);
  if (merging) {
    result.quad_merging = merging->finish();
  }
  if (pixel_rate) {
    result.pixel_rate = pixel_rate->finish();
  }
  return result;
}

}  // namespace halfspace
