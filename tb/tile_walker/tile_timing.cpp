#include "tile_timing.hpp"

#include <fmt/format.h>

#include <bit>

#include "halfspace/units/packing.hpp"

namespace halfspace::tb {
namespace {

constexpr std::uint64_t kJobLatency = 3;  // from the job to visible

}  // namespace

std::optional<Failure> TileTiming::cycle(const UnitPins& pins) {
  const auto block = unpack<BlockJob>(pins.input, parameters_.sizes.widths());
  const std::uint64_t tiles = block.tiles & ~passed_;
  const bool last = std::popcount(tiles) <= 1 && is_last_sample();
  const bool made = pins.in_valid && usable_;
  if (std::optional<Failure> failure = compare(pins, usable_ && last)) {
    return failure;
  }
  if (pins.in_valid && !begun_ && !waited_) {
    coverage_.block(block, was_done_);
  }
  was_done_ = made && last;
  if (made) {
    if (waited_) {
      coverage_.waited(!begun_, last);
    }
    make_job(pins.cycle, tiles);
  }
  waited_ = pins.in_valid && !made;
  begun_ = pins.in_valid && (begun_ || made) && !was_done_;
  if (pins.out_valid && pins.out_ready) {
    visible_at_.pop_front();
    ++credits_;
    ++left_;
  }
  usable_ = credits_ > 0;
  return std::nullopt;
}

/// After reset the credits come from a register that has yet to see them.
void TileTiming::clear() {
  if (was_reset_) {
    coverage_.reset(begun_, waited_, sample_ != 0);
  }
  was_reset_ = true;
  credits_ = parameters_.fifo_depth;
  usable_ = false;
  begun_ = false;
  waited_ = false;
  was_done_ = false;
  passed_ = 0;
  sample_ = 0;
  visible_at_.clear();
}

void TileTiming::make_job(std::uint64_t cycle, std::uint64_t tiles) {
  --credits_;
  visible_at_.push_back(cycle + kJobLatency);
  passed_ = was_done_ ? 0 : is_last_sample() ? passed_ | (tiles & -tiles) : passed_;
  sample_ = is_last_sample() ? 0 : sample_ + 1;
}

std::optional<Failure> TileTiming::compare(const UnitPins& pins, bool ready) const {
  if (pins.in_ready != ready) {
    return Failure{
        FailureKind::kTiming, pins.cycle,
        fmt::format("input ready is {:d}, with {} of {} credits and {} passed tiles of the block it "
                    "should be {:d}",
                    pins.in_ready, credits_, parameters_.fifo_depth, std::popcount(passed_), ready)};
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

}  // namespace halfspace::tb
