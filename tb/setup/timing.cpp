#include "timing.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "halfspace/timing/contract.hpp"
#include "job.hpp"

namespace halfspace::tb {

std::uint64_t last_leave_at_full_rate(const SetupModel& model, const std::vector<bool>& drawn) {
  std::vector<std::int64_t> decide;
  std::vector<std::int64_t> leave;  // of the drawn ones; a sink that is always ready accepts what is visible
  std::int64_t cull = 0;
  std::int64_t drawn_before = -model.interval;
  for (std::size_t n = 0; n < drawn.size(); ++n) {
    const auto queue = static_cast<std::size_t>(model.queue);
    const auto fifo = static_cast<std::size_t>(model.fifo);
    cull = std::max(cull + 1, n >= queue ? decide[n - queue] + 1 : 0);
    std::int64_t d = std::max(cull + kSetupCullLatency, n > 0 ? decide[n - 1] + 1 : 0);
    if (drawn[n]) {
      const std::size_t m = leave.size();
      d = std::max({d, drawn_before + model.interval, m >= fifo ? leave[m - fifo] + 1 : 0});
      drawn_before = d;
      leave.push_back(std::max(d + model.divide_latency(), m > 0 ? leave[m - 1] + 1 : 0));
    }
    decide.push_back(d);
  }
  return static_cast<std::uint64_t>(leave.back());
}

void SetupTiming::clear() {
  queue_.clear();
  visible_at_.clear();
  divider_next_ = 0;
  ready_ = false;
  slot_usable_ = true;
}

std::optional<Failure> SetupTiming::compare(const UnitPins& pins) const {
  if (pins.in_ready != ready_) {
    return Failure{FailureKind::kTiming, pins.cycle,
                   fmt::format("input ready is {:d}, with {} of {} triangles in the queue it should be {:d}",
                               pins.in_ready, queue_.size(), model_.queue, ready_)};
  }
  const bool visible = !visible_at_.empty() && visible_at_.front() <= pins.cycle;
  if (pins.out_valid != visible) {
    return Failure{
        FailureKind::kTiming, pins.cycle,
        visible ? fmt::format("packet {} should be valid since cycle {}", left_, visible_at_.front())
        : visible_at_.empty() ? fmt::format("output valid with nothing under way after packet {}", left_)
                              : fmt::format("packet {} valid before cycle {}", left_, visible_at_.front())};
  }
  return std::nullopt;
}

void SetupTiming::decide(const UnitPins& pins) {
  const bool refused = pins.in_valid && !pins.in_ready;
  if (queue_.empty() || queue_.front().visible_at > pins.cycle) {
    coverage_.decision(Decision::kNoTriangle, refused);
    return;
  }
  if (!queue_.front().drawn) {
    coverage_.decision(Decision::kDropped, refused);
    queue_.pop_front();
    return;
  }
  if (pins.cycle < divider_next_) {
    coverage_.decision(Decision::kDivider, refused);
    return;
  }
  if (!slot_usable_) {
    coverage_.decision(Decision::kNoCredit, refused);
    return;
  }
  coverage_.decision(Decision::kDrawn, refused);
  queue_.pop_front();
  divider_next_ = pins.cycle + static_cast<std::uint64_t>(model_.interval);
  visible_at_.push_back(pins.cycle + static_cast<std::uint64_t>(model_.divide_latency()));
}

std::optional<Failure> SetupTiming::cycle(const UnitPins& pins) {
  if (std::optional<Failure> failure = compare(pins)) {
    return failure;
  }
  decide(pins);
  coverage_.output(pins.out_valid, pins.out_ready,
                   visible_at_.size() == static_cast<std::size_t>(model_.fifo));
  if (pins.in_valid && pins.in_ready) {
    const SetupJob job = unpack_job(pins.input, model_.widths());
    const SetupResult result = reference(job, model_);
    coverage_.triangle(job, result, model_);
    queue_.push_back({pins.cycle + kSetupCullLatency, result.verdict == SetupVerdict::kDrawn});
  }
  if (pins.out_valid && pins.out_ready) {
    visible_at_.pop_front();
    ++left_;
  }
  // What a packet gave back in this cycle counts in the next.
  ready_ = queue_.size() < static_cast<std::size_t>(model_.queue);
  slot_usable_ = visible_at_.size() < static_cast<std::size_t>(model_.fifo);
  return std::nullopt;
}

}  // namespace halfspace::tb
