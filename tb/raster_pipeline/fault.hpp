/// Faults between the verilated pipeline and its driver: the bench must find each of them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "halfspace/timing/rtl/verilated_pipeline.hpp"

namespace halfspace::tb {

enum class PipelineFault : std::uint8_t {
  kNone,
  kFlipTriangle,  ///< a bit of a packet of setup; of the others likewise
  kFlipEquation,
  kFlipState,
  kFlipBlock,
  kFlipJob,
  kFlipCoverage,
  kFlipBeat,
  kFlipTested,
  kFlipFill,      ///< a bit of the data that memory gives
  kFlipWrite,     ///< or takes
  kDropTriangle,  ///< a triangle is taken and never seen
  kDropTested,    ///< a beat leaves unseen
  kLateTested,    ///< or one cycle late
  kLoseFill,      ///< data of a request never comes
  kActivity,      ///< a stage spends a cycle on something else
  kCounter,       ///< a counter is one off
  kRest,          ///< a cycle in which something moves is taken for the first of a rest
};

/// By the name of the bench's option.
[[nodiscard]] std::optional<PipelineFault> pipeline_fault(const std::string& name);
[[nodiscard]] std::vector<std::string> pipeline_fault_names();

/// `pipeline` with the fault at the packet `at` of its link, or in the cycle `at`.
[[nodiscard]] std::unique_ptr<rtl::VerilatedPipeline> with_fault(
    std::unique_ptr<rtl::VerilatedPipeline> pipeline, PipelineFault fault, std::uint64_t at);

}  // namespace halfspace::tb
