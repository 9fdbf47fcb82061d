/// The fidelities, and what a run in any of them gives.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "halfspace/machine/frame_result.hpp"
#include "halfspace/machine/pixel_rate.hpp"
#include "halfspace/timing/cycle_stats.hpp"
#include "halfspace/timing/rtl/packet_check.hpp"
#include "halfspace/whatif/quad_merging.hpp"

namespace halfspace {

// clang-format off
/// F(Identifier, name, core, threads, packets, timeline, vcd, rtl): a timing engine, and what it supports:
///   core      it runs on the core that is asked for
///   threads   it uses more than one
///   packets   it knows when every packet moves, and stalls can be injected
///   timeline  it tells where the cycles go
///   vcd       it writes a waveform
///   rtl       it runs the verilated SystemVerilog
#define HALFSPACE_FIDELITIES(F)                                          \
  F(Functional, functional, true,  true,  false, false, false, false)    \
  F(Recurrence, recurrence, true,  true,  true,  true,  false, false)    \
  F(Systemc,    systemc,    false, false, true,  false, true,  false)    \
  F(Rtl,        rtl,        false, false, true,  false, false, true)
// clang-format on

#define HALFSPACE_FIDELITY(identifier, ...) k##identifier,
enum class Fidelity : std::uint8_t { HALFSPACE_FIDELITIES(HALFSPACE_FIDELITY) };
#undef HALFSPACE_FIDELITY

struct FidelityInfo {
  Fidelity fidelity;
  std::string_view name;
  bool core;
  bool threads;
  bool packets;
  bool timeline;
  bool vcd;
  bool rtl;
};

#define HALFSPACE_FIDELITY(identifier, name, ...) FidelityInfo{Fidelity::k##identifier, #name, __VA_ARGS__},
inline constexpr std::array kFidelityInfo{HALFSPACE_FIDELITIES(HALFSPACE_FIDELITY)};
#undef HALFSPACE_FIDELITY

constexpr const FidelityInfo& info(Fidelity fidelity) {
  return kFidelityInfo[static_cast<std::size_t>(fidelity)];
}

/// The reference rasterizer that made a result, and what it counts of the frame that no unit does.
struct ReferenceRun {
  std::string name;
  std::uint64_t degenerate = 0;  ///< triangles
  std::uint64_t culled = 0;
  std::uint64_t drawn = 0;
};

struct RunResult {
  FrameResult frame;
  std::optional<FrameCycles> cycles;              ///< where the fidelity has time
  PacketTimes times;                              ///< on request, where the fidelity has time
  std::optional<rtl::PacketReport> rtl;           ///< of `rtl`: where it differs from the model
  std::optional<QuadMergingResult> quad_merging;  ///< on request
  std::optional<PixelRateResult> pixel_rate;      ///< on request, where a pixel has several samples
  std::optional<ReferenceRun> reference;          ///< none: the machine made it
};

}  // namespace halfspace
