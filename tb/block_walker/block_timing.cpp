#include "block_timing.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace halfspace::tb {
namespace {

constexpr std::uint64_t kStepLatency = 2;  // from the step to visible

}  // namespace

std::optional<Failure> BlockTiming::cycle(const UnitPins& pins) {
  if (triangle_) {
    if (credits_ > 0) {
      step(pins.cycle);
    } else {
      triangle_->waited = true;
    }
  }
  const bool done = triangle_ && triangle_->done();
  const bool ready = !after_reset_ && (!triangle_ || done);
  after_reset_ = false;
  if (std::optional<Failure> failure = compare(pins, ready)) {
    return failure;
  }
  if (std::optional<Failure> failure = compare_slot(pins)) {
    return failure;
  }
  written_.clear();
  if (done) {
    coverage_.triangle_done(triangle_->steps.back(), pins.in_valid);
    slot_ = static_cast<std::uint8_t>(slot_ + (triangle_->drawn ? 1 : 0));
    triangle_.reset();
  } else if (ready && pins.in_valid) {
    coverage_.loaded_when_idle();
  }
  if (ready && pins.in_valid) {
    take(pins);
  }
  if (pins.out_valid && pins.out_ready) {
    visible_at_.pop_front();
    ++credits_;
    ++left_;
  }
  return std::nullopt;
}

void BlockTiming::clear() {
  if (was_reset_) {
    coverage_.reset(triangle_.has_value(), triangle_ && triangle_->waited);
  }
  was_reset_ = true;
  credits_ = parameters_.fifo_depth;
  after_reset_ = true;
  triangle_.reset();
  visible_at_.clear();
  slot_ = 0;
  written_.clear();
}

void BlockTiming::step(std::uint64_t cycle) {
  const BlockStep& step = triangle_->steps[triangle_->next];
  if (triangle_->waited) {
    coverage_.waited(triangle_->next == 0, triangle_->next + 1 == triangle_->steps.size(), step.leaves());
  }
  triangle_->waited = false;
  ++triangle_->next;
  if (step.leaves()) {
    triangle_->drawn = true;
    --credits_;
    visible_at_.push_back(cycle + kStepLatency);
  }
}

std::optional<Failure> BlockTiming::compare(const UnitPins& pins, bool ready) const {
  if (pins.in_ready != ready) {
    return Failure{FailureKind::kTiming, pins.cycle,
                   fmt::format("input ready is {:d}, with {} of {} credits and {} it should be {:d}",
                               pins.in_ready, credits_, parameters_.fifo_depth,
                               triangle_ ? "a triangle under way" : "no triangle", ready)};
  }
  const bool visible = !visible_at_.empty() && visible_at_.front() <= pins.cycle;
  if (pins.out_valid == visible) {
    return std::nullopt;
  }
  return Failure{FailureKind::kTiming, pins.cycle,
                 visible ? fmt::format("packet {} should be valid since cycle {}", left_, visible_at_.front())
                 : visible_at_.empty()
                     ? fmt::format("output valid with nothing under way after packet {}", left_)
                     : fmt::format("packet {} valid before cycle {}", left_, visible_at_.front())};
}

std::optional<Failure> BlockTiming::compare_slot(const UnitPins& pins) const {
  const bool write = pins.side[0] != 0;
  if (write == written_.empty()) {
    return Failure{FailureKind::kTiming, pins.cycle,
                   fmt::format("slot write is {:d}, it should be {:d}", write, !write)};
  }
  if (!write) {
    return std::nullopt;
  }
  if (pins.side[1] != slot_) {
    return Failure{FailureKind::kPayload, pins.cycle,
                   fmt::format("slot {} is written, it should be slot {}", pins.side[1], slot_)};
  }
  if (!std::ranges::equal(pins.side.subspan(2), written_)) {
    return Failure{FailureKind::kPayload, pins.cycle,
                   fmt::format("slot {}: not the equation and state of the triangle", slot_)};
  }
  return std::nullopt;
}

void BlockTiming::take(const UnitPins& pins) {
  triangle_ = Triangle{.steps = reference_walk(pins.input, slot_, parameters_)};
  coverage_.taken(triangle_->steps, slot_);
  const std::span<const std::uint32_t> passed_on = pins.input.subspan(words_.triangle);
  written_.assign(passed_on.begin(), passed_on.end());
}

}  // namespace halfspace::tb
