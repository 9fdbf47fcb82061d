#include "halfspace/timing/record/stretch.hpp"

#include <algorithm>

#include "halfspace/timing/contract.hpp"

namespace halfspace {
namespace {

/// Shows the packets of a record to `visitor`, in order; `job`: jobs before, `access`: accesses before.
template <class Visitor>
void walk(const PacketStream& packets, Visitor& visitor) {
  const StreamTriangle* triangle = packets.triangles.data();
  const StreamBlock* block = packets.blocks.data();
  std::uint32_t job = 0;
  std::uint32_t access = 0;
  for (const StreamSegment& segment : packets.segments) {
    if (segment.kind == StreamSegment::Kind::kFastClear) {
      continue;
    }
    visitor.segment(segment);
    for (const StreamTriangle* const last = triangle + segment.triangles; triangle != last; ++triangle) {
      visitor.triangle(*triangle, job, access);
      for (const StreamBlock* const end = block + triangle->blocks; block != end; ++block) {
        visitor.block(*block, job, access);
        for (const std::uint32_t jobs_end = job + static_cast<std::uint32_t>(block->jobs()); job != jobs_end;
             ++job) {
          const bool touches = segment.touches_depth != 0 && packets.jobs[job] != 0;
          visitor.job(packets.jobs[job], touches ? &packets.accesses[access] : nullptr);
          access += touches ? 1 : 0;
        }
      }
      visitor.walked(*triangle, job, access);
    }
    visitor.dropped(segment.dropped_after, job, access);
  }
}

/// Ends a stretch where it has its work: with a triangle, or in a triangle that is larger than that. The last
/// job is a burst, so that the sink sees all of the stretch's time.
class Cutter {
 public:
  explicit Cutter(std::uint64_t work) : work_(work) { begin(0, 0); }

  void segment(const StreamSegment& /*segment*/) {}
  void triangle(const StreamTriangle& triangle, std::uint32_t /*job*/, std::uint32_t /*access*/) {
    dropped(triangle.dropped_before, 0, 0);
    add(StretchCount::kDrawn, 1);
    stretches.back().work += 1;
    burst_ = false;
  }
  void block(const StreamBlock& packet, std::uint32_t job, std::uint32_t access) {
    if (burst_ && stretches.back().work >= 2 * work_) {
      begin(job, access);
    }
    visited(packet.empty_before() + 1);
  }
  void job(const StreamJob& quads, const StreamAccess* /*access*/) {
    add(StretchCount::kJobs, 1);
    add(StretchCount::kQuads, quads);
    add(StretchCount::kBeatsOf4, std::max(1, beats(quads, 4)));
    add(StretchCount::kBeatsOf16, std::max(1, beats(quads, 16)));
    add(StretchCount::kBursts, quads == 0 ? 0 : 1);
    stretches.back().work += static_cast<std::uint64_t>(std::max(1, beats(quads, 4)));
    burst_ = quads != 0;
  }
  void walked(const StreamTriangle& triangle, std::uint32_t job, std::uint32_t access) {
    visited(triangle.empty_after);
    if (burst_ && stretches.back().work >= work_) {
      begin(job, access);
    }
  }
  void dropped(std::uint32_t triangles, std::uint32_t /*job*/, std::uint32_t /*access*/) {
    add(StretchCount::kDropped, triangles);
    stretches.back().work += triangles;
  }
  void begin(std::uint32_t job, std::uint32_t access) {
    stretches.push_back({.first_job = job, .first_access = access});
    add(StretchCount::kStretches, 1);
    burst_ = false;
  }

  std::vector<Stretch> stretches;

 private:
  /// Blocks; those with jobs go on beside them.
  void visited(std::uint32_t blocks) {
    add(StretchCount::kBlocks, blocks);
    stretches.back().work += blocks;
  }
  void add(StretchCount which, double number) { count(stretches.back().counts, which) += number; }

  std::uint64_t work_;
  bool burst_ = false;  ///< the last packet of the stretch is one
};

class Copier {
 public:
  Copier(const std::vector<Stretch>& stretches, const std::vector<bool>& wanted)
      : stretches_(stretches), wanted_(wanted) {
    result.draws_end.resize(wanted.size(), 0);
  }

  void segment(const StreamSegment& segment) {
    close();
    segment_ = &segment;
  }
  void triangle(const StreamTriangle& triangle, std::uint32_t job, std::uint32_t /*access*/) {
    if (wants(job)) {
      open(triangle.dropped_before);
    }
  }
  void block(const StreamBlock& packet, std::uint32_t job, std::uint32_t /*access*/) {
    copies_ = wants(job);
    if (!copies_) {
      return;
    }
    if (!in_triangle_) {
      open(0);
    }
    result.packets.blocks.push_back(packet);
    ++result.packets.triangles.back().blocks;
  }
  void job(const StreamJob& packet, const StreamAccess* access) {
    if (!copies_) {
      return;
    }
    result.packets.jobs.push_back(packet);
    if (access != nullptr) {
      result.packets.accesses.push_back(*access);
    }
  }
  void walked(const StreamTriangle& triangle, std::uint32_t /*job*/, std::uint32_t /*access*/) {
    if (in_triangle_) {
      result.packets.triangles.back().empty_after = triangle.empty_after;
    }
    in_triangle_ = false;
  }
  void dropped(std::uint32_t triangles, std::uint32_t job, std::uint32_t /*access*/) {
    if (triangles != 0 && wants(job)) {
      open_segment();
      result.packets.segments.back().dropped_after = triangles;
    }
  }

  StretchCopy result;

 private:
  /// Whether what comes after `job` jobs is to be copied.
  bool wants(std::uint32_t job) {
    while (at_ + 1 < wanted_.size() && job >= stretches_[at_ + 1].first_job) {
      ++at_;
      close();
    }
    return wanted_[at_];
  }
  void open_segment() {
    if (!in_segment_) {
      result.packets.segments.push_back(
          {.surface = segment_->surface, .touches_depth = segment_->touches_depth});
      result.draws_end[at_] = result.packets.segments.size();
    }
    in_segment_ = true;
  }
  void open(std::uint32_t dropped_before) {
    open_segment();
    result.packets.triangles.push_back({.dropped_before = dropped_before});
    ++result.packets.segments.back().triangles;
    in_triangle_ = true;
  }
  void close() {
    in_segment_ = false;
    in_triangle_ = false;
  }

  const std::vector<Stretch>& stretches_;
  const std::vector<bool>& wanted_;
  std::size_t at_ = 0;
  const StreamSegment* segment_ = nullptr;
  bool in_segment_ = false;
  bool in_triangle_ = false;
  bool copies_ = false;  ///< the block at work
};

}  // namespace

std::vector<Stretch> cut(const FrameRecord& record, std::uint64_t work) {
  Cutter cutter(work);
  walk(record.packets, cutter);
  return std::move(cutter.stretches);
}

StretchCopy copy(const FrameRecord& record, const std::vector<Stretch>& stretches,
                 const std::vector<bool>& wanted) {
  Copier copier(stretches, wanted);
  walk(record.packets, copier);
  return std::move(copier.result);
}

}  // namespace halfspace
