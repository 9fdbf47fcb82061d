/// Occupancy of a link, from the times of its packets.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "halfspace/timing/contract.hpp"
#include "halfspace/timing/cycle_stats.hpp"

namespace halfspace {

/// Occupancy of a link from the cycles in which its packets take and return their credits, in order.
class LinkMeter {
 public:
  LinkMeter() = default;
  explicit LinkMeter(int capacity) : cycles_(static_cast<std::size_t>(capacity) + 1) {}

  /// Credit in use from cycle `take` on, usable again in cycle `back`. Both never go back in time.
  void add(std::uint64_t take, std::uint64_t back) {
    return_up_to(take);
    pass(take);
    back_[taken_++ % kMostCredits] = back;
  }

  /// The cycles by occupancy, up to cycle `end`, by which all credits are back.
  Occupancy finish(std::uint64_t end) {
    return_up_to(end);
    pass(end);
    return cycles_;
  }

 private:
  void return_up_to(std::uint64_t cycle) {
    while (returned_ != taken_ && back_[returned_ % kMostCredits] <= cycle) {
      pass(back_[returned_ % kMostCredits]);
      ++returned_;
    }
  }

  void pass(std::uint64_t cycle) {
    cycles_[taken_ - returned_] += cycle - last_;
    last_ = cycle;
  }

  Occupancy cycles_;
  std::array<std::uint64_t, kMostCredits> back_{};
  std::size_t taken_ = 0;
  std::size_t returned_ = 0;
  std::uint64_t last_ = 0;
};

}  // namespace halfspace
