/// The cycles that latency and credits prescribe for a unit of one packet in, one packet out:
///
///     start(n)   = max(arrive(n), start(n-1) + 1, leave(n - capacity) + 1)
///     visible(n) = max(start(n) + latency, leave(n-1) + 1)
///
/// kept as the pins that follow from it, cycle by cycle, so that a unit that is late or early by one is found
/// there.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include <fmt/format.h>

#include "failure.hpp"

namespace halfspace::tb {

class CreditTiming {
 public:
  CreditTiming(int latency, int capacity) : latency_(latency), capacity_(capacity) { clear(); }

  /// Compares the pins of this cycle, and takes note of what moves in it.
  std::optional<Failure> cycle(std::uint64_t cycle, bool in_valid, bool in_ready, bool out_valid,
                               bool out_ready) {
    const bool visible = !visible_at_.empty() && visible_at_.front() <= cycle;
    if (in_ready != ready_) {
      return Failure{FailureKind::kTiming, cycle,
                     fmt::format("input ready is {:d}, with {} of {} credits it should be {:d}", in_ready,
                                 credits_, capacity_, ready_)};
    }
    if (out_valid != visible) {
      return Failure{
          FailureKind::kTiming, cycle,
          visible ? fmt::format("packet {} should be valid since cycle {}", left_, visible_at_.front())
          : visible_at_.empty() ? fmt::format("output valid with nothing under way after packet {}", left_)
                                : fmt::format("packet {} valid before cycle {}", left_, visible_at_.front())};
    }
    if (in_valid && in_ready) {
      visible_at_.push_back(cycle + static_cast<std::uint64_t>(latency_));
      --credits_;
    }
    if (out_valid && out_ready) {
      visible_at_.pop_front();
      ++credits_;
      ++left_;
    }
    ready_ = credits_ > 0;
    return std::nullopt;
  }

  /// After reset ready comes from a register that has yet to see the credits.
  void clear() {
    visible_at_.clear();
    credits_ = capacity_;
    ready_ = false;
  }

 private:
  int latency_;
  int capacity_;
  int credits_ = 0;
  bool ready_ = false;
  std::deque<std::uint64_t> visible_at_;
  std::uint64_t left_ = 0;
};

}  // namespace halfspace::tb
