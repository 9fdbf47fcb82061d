/// Occupancy of a link, from the times of its packets.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "halfspace/timing/contract.hpp"
#include "halfspace/timing/cycle_stats.hpp"

namespace halfspace {

/// Occupancy of a link from the cycles in which its packets take and return their credits, in order.
///
/// From take[n] to back[n - k] packets n - k to n are all in use. A cycle in which `o` credits are in use is
/// in o - k of these times, if o > k. So if they are summed over n, the sum for k less the sum for k + 1 is
/// the number of cycles with more than k credits in use. Sums of many packets at a time cost less than to go
/// through what is taken and returned in its order: no processor foresees the branches of that.
class LinkMeter {
 public:
  /// Packets that are summed up at a time: enough to amortise what is done once for them, few enough that
  /// those of all links take some 30 KB.
  static constexpr std::size_t kPackets = 256;

  LinkMeter() = default;
  explicit LinkMeter(int capacity) : beyond_(static_cast<std::size_t>(capacity)) {}

  /// Packet n, from 0 on: its credit is in use from cycle `take` on, usable again in cycle `back`. Both never
  /// go back in time. The caller counts, because several links have the same packets.
  void add(std::uint64_t n, std::uint64_t take, std::uint64_t back) {
    const std::size_t at = n % kPackets;
    take_[at] = take;
    back_[kMostCredits + at] = back;
    if (at == kPackets - 1) {
      sum_up();
    }
  }

  /// Sum over the packets since the last call of the cycles that each held its credit; `packets`: in all.
  [[nodiscard]] std::uint64_t held(std::uint64_t packets) {
    sum_held(packets % kPackets);
    return std::exchange(held_, 0);
  }

  /// The cycles by occupancy, of so many packets, up to cycle `end`, by which all credits are back.
  [[nodiscard]] Occupancy finish(std::uint64_t packets, std::uint64_t end);

 private:
  void sum_held(std::size_t packets);
  void sum_up();

  std::vector<std::uint64_t> beyond_;  ///< by k: cycles with more than k credits in use
  std::uint64_t held_ = 0;
  std::size_t held_of_ = 0;  ///< of the packets below so many are in held_

  // packets that are not in beyond_ yet
  std::uint64_t start_ = 0;  ///< none takes its credit before
  std::array<std::uint64_t, kPackets> take_{};
  std::array<std::uint64_t, kMostCredits + kPackets> back_{};  ///< after those of the packets before
};

}  // namespace halfspace
