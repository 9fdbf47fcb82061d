#include "halfspace/timing/record/frame_sample.hpp"

#include <algorithm>
#include <cmath>

#include "halfspace/timing/contract.hpp"
#include "halfspace/timing/record/calibrate.hpp"

namespace halfspace {
namespace {

/// A stretch with so many times the work of others stands for itself alone: a long run of dropped triangles,
/// which no cut divides.
constexpr std::uint64_t kLong = 4;

/// A sample pays if it is this much shorter than its record, in jobs.
constexpr std::size_t kShorter = 2;

}  // namespace

FrameSample::FrameSample(const FrameRecord& record, const SampleSize& size)
    : stretches_(cut(record, size.work)) {
  const std::vector<StreamSegment>& segments = record.packets.segments;
  for (const StreamSegment& segment : segments) {
    if (segment.kind == StreamSegment::Kind::kFastClear) {
      fast_clears_.push_back(record.surfaces[segment.surface].tiles);
    }
  }
  clears_first_ = !segments.empty() && segments.front().kind == StreamSegment::Kind::kFastClear;
  choose(size);
  StretchCopy copied = copy(record, stretches_, copied_);
  draws_end_ = std::move(copied.draws_end);
  packets_.name = record.name;
  packets_.config = record.config;
  packets_.surfaces = record.surfaces;
  packets_.packets = std::move(copied.packets);
  accesses_ = static_cast<std::uint32_t>(record.packets.accesses.size());
  pays_ = packets_.packets.jobs.size() * kShorter < record.packets.jobs.size();
}

void FrameSample::choose(const SampleSize& size) {
  share_.resize(stretches_.size(), 0);
  copied_.resize(stretches_.size(), false);
  std::vector<std::size_t> alike;  // those that may stand for others
  for (std::size_t i = 0; i < stretches_.size(); ++i) {
    if (stretches_[i].work > kLong * size.work) {
      share_[i] = 1;
    } else {
      alike.push_back(i);
    }
  }
  const std::size_t chosen = std::min(size.stretches, alike.size());
  for (std::size_t i = 0; i < chosen; ++i) {
    share_[alike[(2 * i + 1) * alike.size() / (2 * chosen)]] =
        static_cast<double>(alike.size()) / static_cast<double>(chosen);
  }
  std::uint32_t warm_from = 0;  // the first job that is wanted before the next stretch that counts
  for (std::size_t i = stretches_.size(); i-- > 0;) {
    if (share_[i] != 0) {
      const std::uint32_t first = stretches_[i].first_job;
      warm_from = first - std::min(first, size.warm_up_jobs);
      copied_[i] = true;
    } else {
      copied_[i] = i + 1 < stretches_.size() && stretches_[i + 1].first_job > warm_from && copied_[i + 1];
    }
  }
}

std::vector<StretchCounts> FrameSample::counts(const ZTrace& trace) const {
  std::vector<StretchCounts> counts(stretches_.size());
  std::size_t miss = 0;
  for (std::size_t i = 0; i < stretches_.size(); ++i) {
    counts[i] = stretches_[i].counts;
    const std::uint32_t end = i + 1 < stretches_.size() ? stretches_[i + 1].first_access : kNoBurst;
    for (; trace.z.burst[miss] < end; ++miss) {
      const ZMiss& part = trace.z.misses[miss];
      count(counts[i], StretchCount::kFetches) += part.fetch ? 1 : 0;
      count(counts[i], StretchCount::kWriteBacks) += part.write_back ? 1 : 0;
      count(counts[i], StretchCount::kMisses) += 1;
    }
  }
  return counts;
}

SampleTrace FrameSample::trace(const ZTrace& trace) const {
  SampleTrace result;
  result.trace.rows = trace.rows;
  result.trace.z.late = late(trace.z.late);
  // by row: the miss that noted its time is in the sample; others are not waited for
  std::vector<bool> timed(trace.rows, false);
  std::size_t miss = 0;
  std::uint32_t access = 0;
  for (std::size_t i = 0; i < stretches_.size(); ++i) {
    const std::uint32_t first = stretches_[i].first_access;
    const std::uint32_t end = i + 1 < stretches_.size() ? stretches_[i + 1].first_access : accesses_;
    for (; trace.z.burst[miss] < end; ++miss) {
      ZMiss part = trace.z.misses[miss];
      if (copied_[i]) {
        part.line = timed[part.line] ? part.line : 0;
        result.trace.z.misses.push_back(part);
        result.trace.z.burst.push_back(access + trace.z.burst[miss] - first);
      }
      if (part.victim != kNoZLine) {
        timed[part.victim] = copied_[i];
      }
    }
    access += copied_[i] ? end - first : 0;
  }
  result.trace.z.burst.push_back(kNoBurst);
  result.trace.flush = trace.flush;
  result.work = frame_work(whole_stream(packets_, result.trace), packets_.surfaces, trace.flush);

  StretchCounts totals{};
  std::vector<StretchCounts> sampled;
  std::vector<double> shares;
  const std::vector<StretchCounts> all = counts(trace);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = 0; k < kStretchCounts; ++k) {
      totals[k] += all[i][k];
    }
    if (share_[i] != 0) {
      sampled.push_back(all[i]);
      shares.push_back(share_[i]);
    }
  }
  result.weight = calibrate(shares, sampled, totals);
  return result;
}

std::vector<StreamLate> FrameSample::late(const std::vector<StreamLate>& all) const {
  std::vector<StreamLate> sampled;
  std::vector<std::uint32_t> before{
      0};  // by late write of the record: those before it that are in the sample
  std::size_t at = 0;
  std::uint32_t access = 0;
  for (std::size_t i = 0; i < stretches_.size(); ++i) {
    const std::uint32_t first = stretches_[i].first_access;
    const std::uint32_t end = i + 1 < stretches_.size() ? stretches_[i + 1].first_access : accesses_;
    for (; all[at].access < end; ++at) {
      if (copied_[i]) {
        sampled.push_back({.access = access + all[at].access - first,
                           .done = before[all[at].done],
                           .leaves = all[at].leaves});
      }
      if (all[at].leaves) {
        before.push_back(before.back() + (copied_[i] ? 1 : 0));
      }
    }
    access += copied_[i] ? end - first : 0;
  }
  sampled.push_back({.access = kNoBurst});
  return sampled;
}

std::uint64_t FrameSample::cycles(const Config& config, const RetimedFrame& retimed,
                                  const SampleTrace& trace) const {
  double cycles = 0;
  std::size_t counted = 0;
  std::uint64_t before = 0;
  for (std::size_t i = 0; i < stretches_.size(); ++i) {
    if (draws_end_[i] == 0) {  // not copied, or without packets
      counted += share_[i] != 0 ? 1 : 0;
      continue;
    }
    const std::uint64_t end = retimed.draw_end[draws_end_[i] - 1];
    if (share_[i] != 0) {
      cycles += trace.weight[counted++] * static_cast<double>(end - before);
    }
    before = end;
  }
  cycles += static_cast<double>(retimed.cycles - before);
  // a clear waits until everything has left the machine, which then fills again
  const std::uint64_t fill = 1 + static_cast<std::uint64_t>(sum_of_latencies(config));
  std::uint64_t between = clears_first_ ? 0 : fill;
  for (const std::uint32_t tiles : fast_clears_) {
    between += static_cast<std::uint64_t>(fast_clear_cycles(tiles, config)) + fill;
  }
  return static_cast<std::uint64_t>(std::llround(cycles)) + between;
}

}  // namespace halfspace
