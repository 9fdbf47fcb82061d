#include "halfspace/timing/rtl/rest_skipper.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "halfspace/timing/rtl/cycle_meter.hpp"
#include "halfspace/timing/rtl/pipeline_decorator.hpp"

namespace halfspace::rtl {
namespace {

/// A look at the state costs as much as some cycles. The first comes after so many cycles in which nothing
/// moved, each further one after twice as many.
constexpr std::uint64_t kFirstLook = 8;

class RestSkipper final : public PipelineDecorator {
 public:
  RestSkipper(std::unique_ptr<VerilatedPipeline> pipeline, RestCounts* counts)
      : PipelineDecorator(std::move(pipeline)), counts_(counts == nullptr ? own_counts_ : *counts) {}

  void settle(const PipelineInputs& in, PipelineOutputs& out) override {
    const bool same = still_ != 0 && in == in_;
    if (resting_ && same) {
      out = out_;
      out.counter = counter_ + uncounted_before_;
      return;
    }
    if (!same) {
      look_ = Look::kNone;
    } else if (look_ == Look::kNone && still_ >= next_look_) {
      look_ = Look::kHold;
      next_look_ = 2 * still_;
    }
    if (counts_cycles_ != (look_ == Look::kNone)) {
      counts_cycles_ = !counts_cycles_;
      pipeline().count_cycles(counts_cycles_);
    }
    pipeline().settle(in, out);
    counter_ = out.counter;
    out.counter += uncounted_before_;
    select_ = in.counter_select;
    const bool moves = out.events != 0 || in.fill_valid || in.late_valid || out.read_valid || out.write_valid;
    if (!same && !moves) {
      in_ = in;
    }
    still_ = moves ? 0 : same && out.activity == out_.activity ? still_ + 1 : 1;
    next_look_ = still_ <= 1 ? kFirstLook : next_look_;
    out_ = out;
    resting_ = look_ == Look::kCompare && pipeline().holds_kept_state();
  }

  void clock_edge() override {
    uncounted_before_ = uncounted_[select_];
    if (!counts_cycles_) {
      count();
    }
    if (resting_) {
      ++counts_.skipped;
      return;
    }
    ++counts_.evaluated;
    if (look_ == Look::kKeep) {
      pipeline().keep_state();
      ++counts_.looked;
    }
    look_ = next(look_);
    pipeline().clock_edge();
  }

 private:
  /// A look takes three cycles: in the first the counters come to a stand, the state of the second is kept,
  /// and that of the third compared.
  enum class Look : std::uint8_t { kNone, kHold, kKeep, kCompare };

  static Look next(Look look) {
    return look == Look::kHold ? Look::kKeep : look == Look::kKeep ? Look::kCompare : Look::kNone;
  }

  /// Counts the cycle in place of the counters of the pipeline.
  void count() {
    for (std::size_t stage = 0; stage < kStages; ++stage) {
      ++uncounted_[stage << kActivityBits | (out_.activity >> (stage * kActivityBits) & kActivityMask)];
    }
    // No data has come from memory: inputs are the same.
    uncounted_[kStages << kActivityBits | 1] += out_.write_valid ? 1 : 0;
  }

  RestCounts own_counts_;
  RestCounts& counts_;
  // Of the cycle that was settled last.
  PipelineInputs in_;  ///< where nothing moved
  PipelineOutputs out_;
  std::uint64_t counter_ = 0;  ///< as the pipeline has it
  std::uint32_t select_ = 0;
  Look look_ = Look::kNone;
  bool resting_ = false;  ///< those after it are like it

  std::uint64_t still_ = 0;  ///< cycles in which nothing moved on a link or a port, and all else stayed
  std::uint64_t next_look_ = kFirstLook;  ///< so many of them
  bool counts_cycles_ = true;
  std::array<std::uint64_t, (kStages + 1) << kActivityBits> uncounted_{};  ///< by counter_select
  std::uint64_t uncounted_before_ = 0;  ///< of the counter selected in the cycle before, up to that
};

}  // namespace

std::unique_ptr<VerilatedPipeline> skipping_rests(std::unique_ptr<VerilatedPipeline> pipeline,
                                                  RestCounts* counts) {
  return std::make_unique<RestSkipper>(std::move(pipeline), counts);
}

}  // namespace halfspace::rtl
