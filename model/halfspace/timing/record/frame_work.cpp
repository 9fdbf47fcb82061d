#include "halfspace/timing/record/frame_work.hpp"

#include <algorithm>
#include <bit>

#include "halfspace/timing/contract.hpp"
#include "halfspace/timing/recurrence/machine.hpp"

namespace halfspace {

FrameWork frame_work(const StreamView& stream, std::span<const StreamSurface> surfaces,
                     std::span<const ZFlush> dirty) {
  FrameWork work;
  for (const StreamSegment& segment : stream.segments) {
    if (segment.kind == StreamSegment::Kind::kFastClear) {
      work.fast_clears.push_back(surfaces[segment.surface].tiles);
    }
    work.triangles += segment.dropped_after;
  }
  for (const StreamTriangle& triangle : stream.triangles) {
    work.triangles += triangle.dropped_before + 1;
    work.blocks += triangle.empty_after;
    work.most_empty = std::max(work.most_empty, triangle.empty_after);
  }
  for (const StreamBlock& block : stream.blocks) {
    work.blocks += block.empty_before() + 1;
    work.most_empty = std::max(work.most_empty, block.empty_before());
  }
  for (const StreamJob& job : stream.jobs) {
    ++work.jobs[job];
  }
  for (const ZMiss& miss : stream.misses) {
    if (miss.fetch) {
      ++work.fetched[static_cast<std::size_t>(std::countr_zero(miss.bytes))];
    }
    if (miss.write_back) {
      ++work.written_back[static_cast<std::size_t>(std::countr_zero(miss.victim_bytes))];
    }
  }
  work.flushed = dirty.size();
  return work;
}

std::uint64_t longest_time(const FrameWork& work, const Config& config) {
  const Machine<std::uint64_t> m = machine(config);
  std::uint64_t time = static_cast<std::uint64_t>(config.z_cache.lines) + 64;
  for (const std::uint32_t tiles : work.fast_clears) {
    time += static_cast<std::uint64_t>(fast_clear_cycles(tiles, config));
  }
  // 16 and 4: the cycles in which credits travel, and more than that
  const auto through = static_cast<std::uint64_t>(sum_of_latencies(config));
  // a late write waits for the shader, and then for those before it
  const std::uint64_t late = config.late_z.mode == LateZ::kLate ? m.late_latency + m.test_beats.back() : 0;
  const std::uint64_t each_job = through + 16 + late;
  for (std::size_t quads = 0; quads < work.jobs.size(); ++quads) {
    time += work.jobs[quads] * (each_job + m.quad_beats[quads] + m.test_beats[quads]);
  }
  const std::uint64_t each_triangle = through + m.setup_interval + 4;
  time += work.triangles * each_triangle + work.blocks;
  for (std::size_t i = 0; i < work.fetched.size(); ++i) {
    time += work.fetched[i] * (m.memory_latency + m.read_cycles[i] + m.decode_latency + 4) +
            work.written_back[i] * (m.write_cycles[i] + m.encode_latency + 4);
  }
  return time + work.flushed * (m.write_cycles.back() + m.encode_latency + 4);
}

}  // namespace halfspace
