/// Where the cycles of the verilated pipeline went, draw by draw: from what its stages do in each cycle and
/// from when their packets come and go.
#pragma once

#include <array>
#include <cstdint>
#include <deque>

#include "halfspace/machine/draw_context.hpp"
#include "halfspace/timing/cycle_book.hpp"
#include "halfspace/timing/link_meter.hpp"
#include "halfspace/timing/rtl/packet_check.hpp"

namespace halfspace::rtl {

/// Values of activity_o: 0 is busy, then the stage's reasons to wait in the order of StageInfo.
inline constexpr std::uint32_t kActivityBits = 3;
inline constexpr std::uint32_t kActivityMask = (1u << kActivityBits) - 1;
inline constexpr std::size_t kActivities = kMostStallReasons + 1;

/// Cycles by stage and activity.
using ActivityCounts = std::array<std::array<std::uint64_t, kActivities>, kStages>;

class CycleMeter {
 public:
  using Cycle = std::uint64_t;

  CycleMeter(const Config& config, PacketReport& report);

  /// In the coming cycle the stage begins with a packet of `draw`.
  void begins(Stage stage, const DrawContext* draw);
  /// The activities of a cycle, as activity_o has them.
  void cycle(std::uint32_t activity) {
    for (std::size_t stage = 0; stage < kStages; ++stage) {
      ++counts_[stage][activity >> (stage * kActivityBits) & kActivityMask];
    }
  }
  /// All cycles so far.
  [[nodiscard]] const ActivityCounts& counts() const { return counts_; }

  /// A packet takes a credit of the link in this cycle. One more than there are is a difference.
  void take(Link link, const DrawContext* draw, Cycle cycle);
  /// The oldest packet that holds one leaves; the credit can be used again from this cycle on.
  void give_back(Link link, Cycle usable);

  /// Cycles in which memory moved data for the draw; null: for the flush.
  void transfer(std::uint64_t CycleStats::*channel, const DrawContext* draw, std::uint64_t cycles);

  /// The last beat of a burst of the draw is in the sink.
  void burst_left(const DrawContext& draw, Cycle cycle) { book_.burst_left(draw, cycle); }

  /// At the end of the frame, when all packets have left.
  FrameCycles finish(Cycle cycles, const std::deque<DrawContext>& draws);

 private:
  struct Held {
    const DrawContext* draw = nullptr;
    Cycle since = 0;
  };

  void flush(Stage stage, const DrawContext* next);
  void add(std::size_t stage, std::size_t activity, const DrawContext* draw);

  PacketReport& report_;
  std::array<std::size_t, kLinks> capacity_{};
  std::array<LinkMeter, kLinks> links_;
  std::array<std::deque<Held>, kLinks> held_;
  ActivityCounts counts_{};
  ActivityCounts before_{};  ///< before the stage's packet began
  std::array<const DrawContext*, kStages> current_{};
  CycleBook book_;
};

}  // namespace halfspace::rtl
