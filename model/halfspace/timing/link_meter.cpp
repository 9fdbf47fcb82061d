#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "halfspace/timing/link_meter.cpp"
#include <hwy/foreach_target.h>
// after foreach_target, as Highway asks
#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "halfspace/timing/link_meter.hpp"

// Plain loops: for each processor the compiler makes vectors of them that are as fast as those by hand.
HWY_BEFORE_NAMESPACE();
namespace halfspace::HWY_NAMESPACE {
namespace {

using Takes = std::span<const std::uint64_t, LinkMeter::kPackets>;
using Backs = std::span<const std::uint64_t, kMostCredits + LinkMeter::kPackets>;

/// Time must hold all times from `start` on. It may wrap in a sum for k, since the difference of two is again
/// a number of cycles from `start` on.
template <class Time>
void add_beyond(Takes take, Backs back, std::uint64_t start, std::span<std::uint64_t> beyond) {
  alignas(64) Time takes[Takes::extent];
  alignas(64) Time backs[Backs::extent];
  for (std::size_t n = 0; n < Takes::extent; ++n) {
    takes[n] = static_cast<Time>(take[n] - start);
  }
  for (std::size_t n = 0; n < kMostCredits; ++n) {
    backs[n] = static_cast<Time>(std::max(back[n], start) - start);
  }
  for (std::size_t n = kMostCredits; n < Backs::extent; ++n) {
    backs[n] = static_cast<Time>(back[n] - start);
  }
  Time sum_of_next = 0;
  for (std::size_t k = beyond.size(); k-- > 0;) {
    const Time* const until = backs + kMostCredits - k;
    Time sum = 0;
    for (std::size_t n = 0; n < Takes::extent; ++n) {
      sum += static_cast<Time>(std::max(until[n], takes[n]) - takes[n]);
    }
    beyond[k] += static_cast<Time>(sum - sum_of_next);
    sum_of_next = sum;
  }
}

/// Adds the cycles with more than k credits in use to `beyond`.
void sum_beyond(Takes take, Backs back, std::uint64_t start, std::span<std::uint64_t> beyond) {
  const bool narrow = back.back() - start <= std::numeric_limits<std::uint16_t>::max();
  (narrow ? add_beyond<std::uint16_t> : add_beyond<std::uint64_t>)(take, back, start, beyond);
}

std::uint64_t sum_of_differences(const std::uint64_t* from, const std::uint64_t* to, std::size_t count) {
  std::uint64_t sum = 0;
  for (std::size_t n = 0; n < count; ++n) {
    sum += to[n] - from[n];
  }
  return sum;
}

}  // namespace
}  // namespace halfspace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace halfspace {

HWY_EXPORT(sum_beyond);
HWY_EXPORT(sum_of_differences);

void LinkMeter::sum_held(std::size_t packets) {
  const std::size_t first = std::exchange(held_of_, packets);
  held_ += HWY_DYNAMIC_DISPATCH(sum_of_differences)(take_.data() + first, back_.data() + kMostCredits + first,
                                                    packets - first);
}

void LinkMeter::sum_up() {
  sum_held(kPackets);
  held_of_ = 0;
  HWY_DYNAMIC_DISPATCH(sum_beyond)(take_, back_, start_, beyond_);
  start_ = take_.back();
  std::copy_n(back_.begin() + kPackets, kMostCredits, back_.begin());
}

Occupancy LinkMeter::finish(std::uint64_t packets, std::uint64_t end) {
  while (packets % kPackets != 0) {
    add(packets++, end, end);  // takes no time
  }
  Occupancy cycles;
  std::uint64_t rest = end;
  for (const std::uint64_t beyond : beyond_) {
    cycles.push_back(rest - beyond);
    rest = beyond;
  }
  cycles.push_back(rest);
  return cycles;
}

}  // namespace halfspace
#endif
