#include "halfspace/machine/stream_writer.hpp"

namespace halfspace {

StreamWriter::StreamWriter(StreamReader& reader)
    : reader_(reader), wants_accesses_(reader.wants_accesses()) {}

void StreamWriter::begin_segment(StreamSegment::Kind kind, std::uint32_t surface, bool touches_depth) {
  packets_.segments.push_back({.kind = kind, .surface = surface, .touches_depth = touches_depth ? 1u : 0u});
  in_segment_ = true;
  seen_ = 0;
}

void StreamWriter::end_segment(std::uint64_t triangles) {
  packets_.segments.back().dropped_after = static_cast<std::uint32_t>(triangles) - seen_;
  in_segment_ = false;
}

void StreamWriter::give(bool in_triangle, std::vector<std::uint64_t>* burst_cycles) {
  z_.burst.push_back(kNoBurst);
  z_.late.push_back({.access = kNoBurst});
  reader_.read({.segments = packets_.segments,
                .triangles = packets_.triangles,
                .blocks = packets_.blocks,
                .jobs = packets_.jobs,
                .accesses = packets_.accesses,
                .misses = z_.misses,
                .miss_burst = z_.burst,
                .late = z_.late,
                .tiles = tiles_,
                .live = live_,
                .continues_segment = continues_segment_,
                .continues_triangle = continues_triangle_,
                .open_segment = in_segment_,
                .open_triangle = in_triangle},
               burst_cycles);
  // What goes on begins the next part.
  const StreamSegment segment = packets_.segments.empty() ? StreamSegment{} : packets_.segments.back();
  packets_.segments.clear();
  packets_.triangles.clear();
  packets_.blocks.clear();
  packets_.jobs.clear();
  packets_.accesses.clear();
  z_.misses.clear();
  z_.burst.clear();
  z_.late.clear();
  tiles_.clear();
  live_.clear();
  accesses_ = 0;
  continues_segment_ = in_segment_;
  continues_triangle_ = in_triangle;
  if (in_segment_) {
    packets_.segments.push_back(
        {.kind = segment.kind, .surface = segment.surface, .touches_depth = segment.touches_depth});
  }
  if (in_triangle) {
    packets_.triangles.push_back({});
    ++packets_.segments.back().triangles;
  }
}

}  // namespace halfspace
