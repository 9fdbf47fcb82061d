/// Observers of the cycles of a run: when each stage works, and when and why it waits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "halfspace/timing/cycle_stats.hpp"

namespace halfspace {

/// Told packet by packet, each all the way through the machine before the next: a triangle begins with its
/// credit of Link::kSetupQueue, a tile job with that of kTileWalker, a burst with that of kQuadGenerator. The
/// slices of one stage follow each other without gap or overlap, from cycle 0 to the end of the frame. `from`
/// is the first cycle of what is told, `to` the first after it.
class CycleObserver {
 public:
  enum class Channel : std::uint8_t { kRead, kWrite };

  virtual ~CycleObserver() = default;

  /// What follows belongs to this draw, or with kNoDraw to a clear that is drawn.
  virtual void draw(std::uint32_t index) = 0;
  /// The tile job that comes next is the tile whose top left pixel this is.
  virtual void tile(std::uint32_t /*x*/, std::uint32_t /*y*/) {}
  /// What follows belongs to the end of the frame.
  virtual void drained() = 0;
  /// The next packet of `link` holds its credit.
  virtual void link(Link link, std::uint64_t from, std::uint64_t to) = 0;
  /// The stage is busy, or waits for reason `stall` of its StageInfo.
  virtual void slice(Stage stage, std::optional<std::size_t> stall, std::uint64_t from, std::uint64_t to) = 0;
  /// Memory moves the data of a line.
  virtual void transfer(Channel channel, std::uint64_t from, std::uint64_t to) = 0;
};

}  // namespace halfspace
