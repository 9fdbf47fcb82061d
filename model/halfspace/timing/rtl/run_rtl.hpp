/// Fidelity `rtl`: the verilated SystemVerilog, with the front end before it and a memory behind it. Every
/// packet on every link is compared with that of the C++ units as it passes; image, quads, cycles and traffic
/// are the RTL's own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>

#include "halfspace/timing/recurrence/run_recurrence.hpp"
#include "halfspace/timing/rtl/packet_check.hpp"
#include "halfspace/timing/rtl/verilated_pipeline.hpp"

namespace halfspace {

/// The RTL came to rest with work left, or one of its assertions failed.
class RtlError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Runs `frame` on `pipeline`, which is that of `config`, both valid; call it once for a pipeline. Of the
/// stall plan only source and sink can be injected: other points throw InputError, as do depth surfaces of
/// more tiles than the pipeline has flags for. Counters of setup's verdicts and of the walker's decisions,
/// which no wire carries, are those of the C++ units for the same packets. `report` says where the RTL
/// differs from the model; `observer` may be null.
FrameResult run_rtl(const Frame& frame, const Config& config, bool keep_visible, PacketObserver* observer,
                    TimedRun& run, rtl::VerilatedPipeline& pipeline, rtl::PacketReport& report);

}  // namespace halfspace
