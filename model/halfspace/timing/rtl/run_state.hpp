/// What the parts of a run of the verilated pipeline share.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <deque>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/machine/draw_context.hpp"
#include "halfspace/machine/frame_result.hpp"
#include "halfspace/machine/surfaces.hpp"
#include "halfspace/timing/engine.hpp"
#include "halfspace/timing/rtl/cycle_meter.hpp"
#include "halfspace/timing/rtl/packet_check.hpp"
#include "halfspace/timing/rtl/pipeline_arguments.hpp"
#include "halfspace/timing/rtl/verilated_pipeline.hpp"

namespace halfspace::rtl {

struct RunState {
  using Cycle = std::uint64_t;

  RunState(const Frame& frame, const Config& machine, const EngineOptions& run_options,
           VerilatedPipeline& verilated, PacketReport& packet_report)
      : config(machine),
        options(run_options),
        widths(halfspace::widths(machine)),
        pipeline(verilated),
        report(packet_report),
        meter(machine, packet_report) {
    result.surfaces = make_surfaces(frame, machine, run_options.watch);
    places = place_surfaces(result.surfaces, machine);
    blocks = place_blocks(result.surfaces, machine);
    clear_code.resize(places.size());
  }

  const Config& config;
  const EngineOptions& options;
  Widths widths;
  VerilatedPipeline& pipeline;
  PacketReport& report;
  CycleMeter meter;

  PipelineInputs in;
  PipelineOutputs out;
  Cycle cycle = 0;
  Cycle rest = 0;         ///< cycles since something moved
  bool flushing = false;  ///< at the end of the frame

  FrameResult result;                     ///< its codes are the model's, until the end
  std::vector<ZSurface> places;           ///< by depth surface
  std::vector<HiZSurface> blocks;         ///< the same for hi_z
  std::vector<std::uint32_t> clear_code;  ///< of each surface's last clear by the z cache
  std::deque<DrawContext> draws;          ///< tokens point into it
  PacketTimes times;

  [[nodiscard]] bool happens(Event event) const { return (out.events & bit(event)) != 0; }

  /// What a draw is drawn on.
  [[nodiscard]] Surface& surface(const DrawContext& draw) { return result.surfaces[draw.drawn_on]; }

  void note(std::vector<Cycle> PacketTimes::*stream) {
    if (options.packet_times) {
      (times.*stream).push_back(cycle);
    }
  }

  /// False, and a difference, where the RTL has a packet that the model has not.
  template <class Queue>
  bool expected(const Queue& queue, const char* link) {
    if (!queue.empty()) {
      return true;
    }
    report.differ(fmt::format("{}: a packet in cycle {} where the model has none", link, cycle));
    return false;
  }

  /// A difference, where packets of the model are left over.
  template <class Queue>
  void expect_no_more(const Queue& queue, const char* link) {
    if (!queue.empty()) {
      report.differ(fmt::format("{}: {} packets of the model never came", link, queue.size()));
    }
  }
};

}  // namespace halfspace::rtl
