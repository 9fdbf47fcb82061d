/// Writes a packet stream part by part.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "halfspace/machine/packet_stream.hpp"

namespace halfspace {

/// Gives `reader` a part whenever one is long enough, and the rest at the end.
class StreamWriter {
 public:
  explicit StreamWriter(StreamReader& reader);

  void begin_segment(StreamSegment::Kind kind, std::uint32_t surface, bool touches_depth);
  /// `triangles`: that setup has seen in the segment.
  void end_segment(std::uint64_t triangles);

  /// Setup gave a triangle to the walker, whose block jobs follow: the segment's triangle `number`, from 0.
  /// Those since the last one were dropped.
  void drawn(std::uint32_t number) {
    packets_.triangles.push_back({.dropped_before = number - seen_, .blocks = 0, .empty_after = 0});
    seen_ = number + 1;
    ++packets_.segments.back().triangles;
  }
  /// A block job, whose tile jobs follow.
  void block(std::uint32_t empty_before) {
    ++packets_.triangles.back().blocks;
    packets_.blocks.emplace_back(empty_before, 0);
  }
  void job(int quads) {
    packets_.blocks.back().add_job();
    packets_.jobs.push_back(static_cast<StreamJob>(quads));
  }
  /// So many bursts have to do with stored depth, in the order of their jobs; what they missed in the z cache
  /// has been said.
  void accessed(std::uint32_t bursts = 1) { accesses_ += bursts; }
  [[nodiscard]] bool wants_accesses() const { return wants_accesses_; }
  /// A burst has, and missed so much.
  void accessed(std::span<const ZMiss> misses) {
    for (const ZMiss& each : misses) {
      miss(each);
    }
    accessed();
  }
  /// A miss of the burst that has `before` between it and the last that was counted.
  void miss(const ZMiss& miss, std::uint32_t before = 0) {
    z_.misses.push_back(miss);
    z_.burst.push_back(accesses_ + before);
  }
  /// The burst that is counted next waits for the frame's first `done` late writes, and may leave one.
  void late(std::uint32_t done, bool leaves) {
    if (done != 0 || leaves) {
      z_.late.push_back({.access = accesses_, .done = done, .leaves = leaves});
    }
  }
  /// What that access was, for readers that want accesses.
  void access(const StreamAccess& access) { packets_.accesses.push_back(access); }
  /// Where the last job is, for readers that want tiles.
  void tile(const StreamTile& tile) { tiles_.push_back(tile); }
  /// Of the last burst, for readers that want them: see StreamView::live.
  void live(std::uint64_t quads) { live_.push_back(quads); }
  /// The triangle is done, with so many empty blocks after its last job.
  void walked(std::uint32_t empty) { packets_.triangles.back().empty_after = empty; }

  /// Whether the part is long enough to be given away.
  [[nodiscard]] bool full() const {
    return packets_.jobs.size() >= kPartJobs || packets_.triangles.size() >= kPartJobs;
  }
  /// Gives the part away. In a triangle: between two of its blocks.
  void give(bool in_triangle, std::vector<std::uint64_t>* burst_cycles);

 private:
  /// Enough to amortise the call, few enough to stay in the processor's first cache.
  static constexpr std::size_t kPartJobs = 1024;

  StreamReader& reader_;
  bool wants_accesses_;
  PacketStream packets_;
  ZMissStream z_;
  std::vector<StreamTile> tiles_;
  std::vector<std::uint64_t> live_;
  std::uint32_t accesses_ = 0;  ///< of the part
  std::uint32_t seen_ = 0;      ///< triangles of the segment, to the last that was drawn
  bool in_segment_ = false;
  bool continues_segment_ = false;
  bool continues_triangle_ = false;
};

}  // namespace halfspace
