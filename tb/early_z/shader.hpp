/// What stands behind early_z as the shader of late bursts: answers for those of which something passed, in
/// order.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <vector>

#include "common/random.hpp"
#include "early_z/early_z_run.hpp"
#include "early_z/models.hpp"
#include "early_z/workload.hpp"

namespace halfspace::tb {

class Shader {
 public:
  Shader(const ZRunOptions& options, const EarlyZShape& shape, std::uint64_t seed)
      : options_(options), mask_bits_(shape.widths.MaskBits), random_(seed) {}

  void clear() { answers_.clear(); }

  /// The last beat of a late burst is taken in this cycle.
  void take(const LateWrite& late, std::uint64_t cycle) {
    if (late.out) {
      const std::uint64_t latency =
          options_.late_varies ? 1 + random_.below(options_.late_latency) : options_.late_latency;
      const std::uint64_t after = answers_.empty() ? 0 : answers_.back().cycle + 1;
      answers_.push_back({std::max(cycle + latency, after), &late});
    }
  }

  /// Its wires in this cycle, the `given` answers before; without one they hold anything. `last`: no burst is
  /// to come. Whether it answers.
  bool drive(EarlyZInputs& in, std::uint64_t cycle, std::size_t given, bool last) {
    in.late_valid = false;
    for (std::uint32_t& word : in.late_keep) {
      word = static_cast<std::uint32_t>(random_.bits());
    }
    if (mask_bits_ % 32 != 0) {  // Verilator wants the bits above a port's width to be 0
      in.late_keep.back() &= (1u << (mask_bits_ % 32)) - 1;
    }
    const bool from_here = given >= options_.fault_packet;
    if (options_.fault == ZFault::kExtraAnswer && from_here && answers_.empty() && last) {
      in.late_valid = true;
      return false;
    }
    if (answers_.empty() || cycle < answers_.front().cycle ||
        (from_here && options_.fault == ZFault::kLoseAnswer)) {
      return false;
    }
    const LateWrite& late = *answers_.front().late;
    in.late_valid = true;
    in.late_keep = late.keep;
    if (options_.fault == ZFault::kFlipKeep && given == options_.fault_packet) {
      in.late_keep[late.passed_word] ^= late.passed_bit;
    }
    answers_.pop_front();
    return true;
  }

 private:
  struct Answer {
    std::uint64_t cycle = 0;
    const LateWrite* late = nullptr;
  };
  const ZRunOptions& options_;
  int mask_bits_;
  Random random_;
  std::deque<Answer> answers_;
};

}  // namespace halfspace::tb
