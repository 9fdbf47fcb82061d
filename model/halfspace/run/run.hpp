/// Runs a frame in any fidelity: the library's front door.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

#include "halfspace/config/config.hpp"
#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/machine/pixel_rate.hpp"
#include "halfspace/run/run_result.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/timing/cycle_observer.hpp"
#include "halfspace/timing/rtl/verilated_pipeline.hpp"
#include "halfspace/timing/stall_plan.hpp"

namespace halfspace {

/// The fidelity of this name. Throws OptionError, with the legal names.
Fidelity fidelity_of(std::string_view name);

/// Throws OptionError, with the legal names, where `option` is given and the fidelity does not support it.
void require(Fidelity fidelity, bool given, std::string_view option, bool FidelityInfo::*support);

struct RunOptions {
  Watch watch;
  StallPlan stalls;                         ///< injected; needs packets
  bool packet_times = false;                ///< fill RunResult::times; needs packets
  CycleObserver* cycle_observer = nullptr;  ///< needs a timeline; must outlive the run
  std::optional<int> quad_merging;          ///< what merging would save, with a buffer of so many quads
  bool pixel_rate = false;      ///< what a shader once a pixel is given, where a pixel has several samples
  PixelRate::Shade pixel_quad;  ///< sees each quad of these pixels
  std::filesystem::path vcd;    ///< waveform of links and stages, with or without .vcd; needs vcd
  std::filesystem::path rtl_folder;  ///< where `make rtl` put the verilated pipelines
  std::uint64_t rtl_seed = 0;        ///< decides what the RTL's registers hold before reset
  bool rtl_every_cycle = false;      ///< evaluate the RTL also in cycles in which nothing can change
  std::filesystem::path wave;        ///< FST waveform, of every cycle; needs rtl
};

/// The verilated pipeline of `config`, as the options want it. Throws InputError where none fits.
std::unique_ptr<rtl::VerilatedPipeline> verilated_pipeline(const Config& config, const RunOptions& options);

/// Runs `frame` on the machine of `config`, both valid. Image, counters and events are the same in every
/// fidelity. Throws OptionError where an option is given that the fidelity does not support or whose value is
/// not legal, InputError where no verilated pipeline fits; RtlError and systemc::DeadlockError where a
/// machine comes to rest with work left. Not for several threads at a time in `systemc`. With
/// `options.watch.threads` above 1 the cycle observer is called in another thread than the packet observer.
RunResult run(Fidelity fidelity, const Frame& frame, const Config& config, const RunOptions& options = {});

}  // namespace halfspace
