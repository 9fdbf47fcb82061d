#include "halfspace/timing/analytic/draw_work.hpp"

#include <bit>

namespace halfspace {

DrawWork& DrawWork::operator+=(const DrawWork& other) {
  triangles += other.triangles;
  drawn += other.drawn;
  steps += other.steps;
  const auto add = [](auto& sums, const auto& more) {
    for (std::size_t i = 0; i < sums.size(); ++i) {
      sums[i] += more[i];
    }
  };
  add(tiles, other.tiles);
  add(fetched, other.fetched);
  add(written_back, other.written_back);
  return *this;
}

DrawWork FrameWork::sum() const {
  DrawWork sum = drawn_clears;
  for (const DrawWork& draw : draws) {
    sum += draw;
  }
  return sum;
}

void FrameWork::add(const StreamView& part, std::span<const StreamSurface> surfaces) {
  const StreamTriangle* triangle = part.triangles.data();
  const StreamJob* job = part.jobs.data();
  const std::uint32_t* miss_burst = part.miss_burst.data();
  const ZMiss* miss = part.misses.data();
  std::uint32_t access = 0;
  bool continues_triangle = part.continues_triangle;
  for (const StreamSegment& segment : part.segments) {
    if (segment.kind == StreamSegment::Kind::kFastClear) {
      fast_clears.push_back(surfaces[segment.surface].tiles);
      continue;
    }
    const bool is_draw = segment.kind == StreamSegment::Kind::kDraw;
    if (is_draw && !(part.continues_segment && &segment == &part.segments.front())) {
      draws.emplace_back();
    }
    DrawWork& work = is_draw ? draws.back() : drawn_clears;
    work.triangles += segment.dropped_after;
    for (std::uint32_t i = 0; i < segment.triangles; ++i, ++triangle) {
      work.triangles += triangle->dropped_before + (continues_triangle ? 0 : 1);
      work.drawn += continues_triangle ? 0 : 1;
      continues_triangle = false;
      work.steps += triangle->steps_after;
      for (const StreamJob* const end = job + triangle->jobs; job != end; ++job) {
        work.steps += job->steps();
        ++work.tiles[static_cast<std::size_t>(job->quads())];
        access += segment.touches_depth != 0 && job->quads() != 0 ? 1 : 0;
      }
    }
    for (; *miss_burst < access; ++miss_burst, ++miss) {
      work.fetched[static_cast<std::size_t>(std::countr_zero(miss->bytes))] += miss->fetch ? 1 : 0;
      if (miss->write_back) {
        ++work.written_back[static_cast<std::size_t>(std::countr_zero(miss->victim_bytes))];
      }
    }
  }
}

}  // namespace halfspace
