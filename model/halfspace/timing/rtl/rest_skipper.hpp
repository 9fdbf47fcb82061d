/// A verilated pipeline that is not evaluated in cycles in which nothing in it can change.
///
/// The next state of the pipeline is a function of its state and its inputs. So where a cycle begins with the
/// state of the cycle before, all of it but the counters of cycles, and its inputs are the same, every later
/// cycle is like it until an input changes. The pipeline is looked at where nothing has moved on a link for
/// some cycles; what it shows in such a rest is what it showed in its first cycle.
#pragma once

#include <cstdint>
#include <memory>

#include "halfspace/timing/rtl/verilated_pipeline.hpp"

namespace halfspace::rtl {

/// Clock edges since the pipeline was made.
struct RestCounts {
  std::uint64_t evaluated = 0;
  std::uint64_t skipped = 0;
  std::uint64_t looked = 0;  ///< of those that were evaluated: state was kept before them
};

/// `pipeline`, and the counts of it in `counts`, which must outlive it; null: nobody wants them. A waveform
/// lacks the cycles of a rest.
[[nodiscard]] std::unique_ptr<VerilatedPipeline> skipping_rests(std::unique_ptr<VerilatedPipeline> pipeline,
                                                                RestCounts* counts = nullptr);

}  // namespace halfspace::rtl
