#include "burst_timing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "halfspace/timing/contract.hpp"
#include "halfspace/units/packing.hpp"

namespace halfspace::tb {
namespace {

/// Numbers of the quads that hold a covered sample, sample by sample.
std::vector<int> quads_of(const Coverage& coverage, const Widths& widths) {
  std::vector<int> quads;
  const int row = widths.TileSize / 2;
  for (int quad = 0; quad < widths.TileQuads; ++quad) {
    bool covered = false;
    for (int sample = 0; sample < 4; ++sample) {
      const int bit = (2 * (quad / row) + sample / 2) * widths.TileSize + 2 * (quad % row) + sample % 2;
      covered = covered || (coverage.mask.word[static_cast<std::size_t>(bit / 64)] >> (bit % 64) & 1) != 0;
    }
    if (covered) {
      quads.push_back(quad);
    }
  }
  return quads;
}

}  // namespace

std::optional<Failure> BurstTiming::cycle(const UnitPins& pins) {
  const bool free = !after_reset_ && pins.cycle >= free_from_;
  const bool visible = !bursts_.empty() && pins.cycle >= bursts_.front().visible +
                                                             static_cast<std::uint64_t>(bursts_.front().left);
  if (std::optional<Failure> failure = compare(pins, free && credits_ > 0, visible)) {
    return failure;
  }
  if (std::optional<Failure> failure = compare_job(pins)) {
    return failure;
  }
  taken_ = taken_burst_ = false;
  if (pins.in_valid && free && credits_ == 0) {
    coverage_.no_credit(quads_of(unpack<Coverage>(pins.input, widths_), widths_).empty());
  }
  bool returned = false;
  if (visible) {
    Burst& burst = bursts_.front();
    if (!pins.out_ready) {
      (burst.left == 0 ? burst.stalled_at_first : burst.stalled_later) = true;
    } else {
      ++packets_;
      ++burst.left;
      returned = burst.left == burst.beats;
    }
  }
  if (pins.in_valid && pins.in_ready) {
    take(pins, returned);
  }
  if (returned) {
    const Burst& burst = bursts_.front();
    coverage_.left(burst.quads, burst.stalled_at_first, burst.stalled_later);
    bursts_.pop_front();
    ++credits_;
  }
  after_reset_ = false;
  now_ = pins.cycle + 1;
  return std::nullopt;
}

std::optional<Failure> BurstTiming::compare(const UnitPins& pins, bool ready, bool visible) const {
  if (pins.in_ready != ready) {
    return Failure{
        FailureKind::kTiming, pins.cycle,
        fmt::format("input ready is {:d}, with {} of {} credits and work until cycle {} it should be {:d}",
                    pins.in_ready, credits_, capacity_, free_from_, ready)};
  }
  if (pins.out_valid == visible) {
    return std::nullopt;
  }
  if (bursts_.empty()) {
    return Failure{FailureKind::kTiming, pins.cycle,
                   fmt::format("output valid with nothing under way after packet {}", packets_)};
  }
  const std::uint64_t since = bursts_.front().visible + static_cast<std::uint64_t>(bursts_.front().left);
  return Failure{FailureKind::kTiming, pins.cycle,
                 fmt::format("packet {} {} cycle {}", packets_,
                             visible ? "should be valid since" : "valid before", since)};
}

std::optional<Failure> BurstTiming::compare_job(const UnitPins& pins) const {
  const bool taken = pins.side[0] != 0;
  const bool burst = pins.side[1] != 0;
  if (taken == taken_ && burst == taken_burst_) {
    return std::nullopt;
  }
  return Failure{FailureKind::kTiming, pins.cycle,
                 fmt::format("job taken is {:d} and its burst {:d}, they should be {:d} and {:d}", taken,
                             burst, taken_, taken_burst_)};
}

void BurstTiming::take(const UnitPins& pins, bool returned) {
  const auto coverage = unpack<Coverage>(pins.input, widths_);
  const std::vector<int> quads = quads_of(coverage, widths_);
  if (coverage.sure != 0) {
    unsigned whole = (1u << widths_.ZParts) - 1;
    for (int bit = 0; bit < widths_.MaskBits; ++bit) {
      if ((coverage.mask.word[static_cast<std::size_t>(bit / 64)] >> (bit % 64) & 1) == 0) {
        whole &= ~(1u << (bit * widths_.ZParts / widths_.MaskBits));
      }
    }
    coverage_.sure(whole);
  }
  const int count = beats(static_cast<int>(quads.size()), widths_.QuadWidth);
  coverage_.taken(quads, capacity_ - credits_, pins.cycle == free_from_, returned);
  taken_ = true;
  taken_burst_ = count > 0;
  free_from_ = pins.cycle + static_cast<std::uint64_t>(std::max(1, count));
  if (count > 0) {
    --credits_;
    made_until_ = free_from_;
    bursts_.push_back(
        {.visible = pins.cycle + kQuadLatency, .quads = static_cast<int>(quads.size()), .beats = count});
  }
}

void BurstTiming::clear() {
  if (was_reset_) {
    const bool making = now_ <= made_until_;
    const bool waiting = !bursts_.empty() && bursts_.front().visible <= now_;
    coverage_.reset(making, waiting);
  }
  was_reset_ = true;
  bursts_.clear();
  credits_ = capacity_;
  free_from_ = 0;
  made_until_ = 0;
  taken_ = taken_burst_ = false;
  after_reset_ = true;
}

}  // namespace halfspace::tb
