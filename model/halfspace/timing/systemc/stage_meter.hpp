/// Accounts for every cycle of a stage.
#pragma once

#include <algorithm>
#include <string>

#include "halfspace/timing/systemc/credit_link.hpp"
#include "halfspace/timing/systemc/run_state.hpp"
#include "halfspace/timing/systemc/timed_signal.hpp"

namespace halfspace::systemc {

/// A stage tells it, in order of time, until when it was stalled by what and until when it was busy. What is
/// past already is not counted again, so reasons are told in order of their priority.
class StageMeter {
 public:
  StageMeter(Stage stage, RunState& run) : stage_(stage), run_(run) {
    run.meters[static_cast<std::size_t>(stage)] = this;
  }
  StageMeter(const StageMeter&) = delete;
  StageMeter& operator=(const StageMeter&) = delete;
  ~StageMeter() = default;

  void begin_frame() {
    next_ = 0;
    draw_ = nullptr;
    waits_for(stall::kNoInput);
  }

  /// The cycles that are told from here on are the draw's.
  void work_on(const DrawContext* draw) { draw_ = draw; }

  /// The cycles up to but without `end`.
  void stalled(std::size_t reason, Cycle end) {
    count(
        end, [&](StageCycles& cycles) -> std::uint64_t& { return cycles.stall[reason]; },
        kFirstReason + static_cast<int>(reason));
  }
  void busy(Cycle end) {
    count(
        end, [](StageCycles& cycles) -> std::uint64_t& { return cycles.busy; }, kBusy);
  }

  /// A stage whose first free cycle is `next` waits for the packet at the head of `in`, and then for the
  /// credit that it needs: credit() gives the cycle from which on there is one, and without it the stage is
  /// stalled by `no_credit`. Suspends the calling thread until the cycle in which the work begins, and
  /// returns it. `next` is looked at when there is a packet: a frame may begin before that.
  template <class Token, class Credit>
  Cycle wait_to_begin(CreditIn<Token>& in, const Cycle& next, std::size_t no_credit, const Credit& credit) {
    waits_for(stall::kNoInput);
    const Cycle visible = in.visible();
    work_on(in.front().draw);
    stalled(stall::kNoInput, visible);
    waits_for(no_credit);
    const Cycle at = std::max({visible, next, credit()});
    stalled(no_credit, at);
    run_.clock.wait_until(at);
    return at;
  }

  /// The rest of the frame.
  void end_frame(Cycle end) {
    draw_ = nullptr;
    stalled(stall::kNoInput, end);
  }

  /// What the stage is about to wait for; only to look at.
  void waits_for(std::size_t reason) {
    waits_for_ = reason;
    if (signal_ != nullptr) {
      signal_->set(next_, kFirstReason + static_cast<int>(reason));
    }
  }

  /// First cycle that is not accounted for: when all packets have left the pipe, the first in which the stage
  /// has nothing left to do.
  [[nodiscard]] Cycle next() const { return next_; }

  [[nodiscard]] std::string describe() const {
    return "waits: " + std::string(kStageInfo[static_cast<std::size_t>(stage_)].stall[waits_for_]);
  }
  [[nodiscard]] std::string name() const {
    return std::string(kStageInfo[static_cast<std::size_t>(stage_)].name);
  }
  void trace_on(TimedSignal* signal) { signal_ = signal; }

  // Values in a trace, as the RTL's activity_o has them.
  static constexpr int kBusy = 0;
  static constexpr int kFirstReason = 1;

 private:
  template <class Member>
  void count(Cycle end, Member&& member, int state) {
    if (end <= next_) {
      return;
    }
    const auto stage = static_cast<std::size_t>(stage_);
    run_.book.count(draw_, [&](CycleStats& stats) { member(stats.stage[stage]) += end - next_; });
    if (signal_ != nullptr) {
      signal_->set(next_, state);
    }
    next_ = end;
  }

  Stage stage_;
  RunState& run_;
  Cycle next_ = 0;
  const DrawContext* draw_ = nullptr;
  std::size_t waits_for_ = 0;
  TimedSignal* signal_ = nullptr;  ///< null where not traced
};

}  // namespace halfspace::systemc
