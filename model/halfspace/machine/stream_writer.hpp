/// Writes a packet stream part by part.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "halfspace/machine/packet_stream.hpp"

namespace halfspace {

/// Gives `reader` a part whenever one is long enough, and the rest at the end. `frame` is for errors.
class StreamWriter {
 public:
  StreamWriter(StreamReader& reader, std::string frame);

  void begin_segment(StreamSegment::Kind kind, std::uint32_t surface, bool touches_depth);
  void end_segment();

  /// Setup dropped a triangle.
  void dropped() { ++dropped_; }
  /// Setup gave a triangle to the walker, whose tile jobs follow.
  void drawn() {
    packets_.triangles.push_back({.dropped_before = dropped_, .jobs = 0, .steps_after = 0});
    dropped_ = 0;
    ++packets_.segments.back().triangles;
  }
  /// A tile job. Throws InputError where it took more than kMostSteps.
  void job(std::uint32_t steps, int quads) {
    if (steps > kMostSteps) [[unlikely]] {
      refuse_steps(steps);
    }
    ++packets_.triangles.back().jobs;
    packets_.jobs.emplace_back(steps, quads);
  }
  /// The burst of the last job has to do with stored depth, and missed so much in the z cache.
  void access(std::span<const ZMiss> misses) {
    for (const ZMiss& miss : misses) {
      z_.misses.push_back(miss);
      z_.burst.push_back(accesses_);
    }
    ++accesses_;
  }
  /// What that access was, for readers that want accesses.
  void access(const StreamAccess& access) { packets_.accesses.push_back(access); }
  /// Where the last job is, for readers that want tiles.
  void tile(const StreamTile& tile) { tiles_.push_back(tile); }
  /// The triangle is done, with so many steps after its last job.
  void walked(std::uint32_t steps) { packets_.triangles.back().steps_after = steps; }

  /// Whether the part is long enough to be given away.
  [[nodiscard]] bool full() const {
    return packets_.jobs.size() >= kPartJobs || packets_.triangles.size() >= kPartJobs;
  }
  /// Gives the part away. In a triangle: before walked().
  void give(bool in_triangle, std::vector<std::uint64_t>* burst_cycles);

 private:
  /// Enough to amortise the call, few enough to stay in the processor's first cache.
  static constexpr std::size_t kPartJobs = 1024;

  [[noreturn]] void refuse_steps(std::uint32_t steps) const;

  StreamReader& reader_;
  std::string frame_;
  PacketStream packets_;
  ZMissStream z_;
  std::vector<StreamTile> tiles_;
  std::uint32_t accesses_ = 0;  ///< of the part
  std::uint32_t dropped_ = 0;   ///< since the last triangle that was drawn
  bool in_segment_ = false;
  bool continues_segment_ = false;
  bool continues_triangle_ = false;
};

}  // namespace halfspace
