/// Fidelity `rtl`: the verilated SystemVerilog, with the front end before it and a memory behind it. Every
/// packet on every link is compared with that of the C++ units as it passes; image, quads, cycles and traffic
/// are the RTL's own.
#pragma once

#include "halfspace/config/config.hpp"
#include "halfspace/timing/engine.hpp"
#include "halfspace/timing/rtl/packet_check.hpp"
#include "halfspace/timing/rtl/rtl_error.hpp"
#include "halfspace/timing/rtl/verilated_pipeline.hpp"

namespace halfspace {

struct RtlResult {
  TimedResult timed;
  rtl::PacketReport report;  ///< where the RTL differs from the model
};

/// Runs `frame` on `pipeline`, which is that of `config`, both valid; call it once for a pipeline. Of the
/// stall plan only source and sink can be injected: other points throw InputError, as do depth surfaces of
/// more tiles than the pipeline has flags for. Counters of setup's verdicts and of the walker's decisions,
/// which no wire carries, are those of the C++ units for the same packets. Throws RtlError.
RtlResult run_rtl(const Frame& frame, const Config& config, const EngineOptions& options,
                  rtl::VerilatedPipeline& pipeline);

}  // namespace halfspace
