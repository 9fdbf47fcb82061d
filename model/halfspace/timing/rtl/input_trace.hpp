/// What a driver has given to a verilated pipeline, cycle by cycle, and the same again without the driver:
/// the speed of the simulation alone.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "halfspace/timing/rtl/verilated_pipeline.hpp"

namespace halfspace::rtl {

/// The inputs of a run. Payloads are kept for the cycles in which they are valid, one after the other.
class InputTrace {
 public:
  /// A cycle, and what the pipeline did in it.
  void add(const PipelineInputs& in, const PipelineOutputs& out);
  [[nodiscard]] std::uint64_t cycles() const { return flags_.size(); }
  /// Of what all stages did in all cycles.
  [[nodiscard]] std::uint64_t digest() const { return digest_; }

  /// Gives all of it to `pipeline`, from its reset on, and returns the digest of what that does.
  std::uint64_t play(VerilatedPipeline& pipeline) const;

 private:
  static constexpr std::uint64_t kDigestStart = 0xcbf29ce484222325;

  std::uint64_t digest_ = kDigestStart;
  std::vector<std::uint8_t> flags_;      ///< of every cycle
  std::vector<std::uint32_t> payload_;   ///< triangle and state, or data of a fill
  std::vector<std::uint32_t> commands_;  ///< first and last tile of a clear, or the selection of a counter
};

/// `pipeline`, of which `trace` gets every input.
[[nodiscard]] std::unique_ptr<VerilatedPipeline> traced(std::unique_ptr<VerilatedPipeline> pipeline,
                                                        InputTrace& trace);

}  // namespace halfspace::rtl
