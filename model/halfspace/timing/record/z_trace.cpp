#include "halfspace/timing/record/z_trace.hpp"

namespace halfspace {
namespace {

/// Bands of a record as parts of a cache with fewer.
std::uint8_t fold(std::uint8_t bands, int band_count, int parts) {
  if (parts == band_count) {
    return bands;
  }
  std::uint8_t folded = 0;
  for (int band = 0; band < band_count; ++band) {
    folded |= static_cast<std::uint8_t>((bands >> band & 1) << (band * parts / band_count));
  }
  return folded;
}

std::vector<ZSurface> place(const FrameRecord& record, int parts) {
  std::vector<ZSurface> places;
  std::uint32_t first = 0;
  const auto samples = static_cast<std::uint32_t>(record.config.tile_walker.tile_size *
                                                  record.config.tile_walker.tile_size / parts);
  for (const RecordedSurface& surface : record.surfaces) {
    places.push_back({.first_tile = first,
                      .tiles_x = surface.tiles_x,
                      .tiles = surface.tiles,
                      .line_bytes = samples * surface.sample_bytes});
    first += surface.tiles;
  }
  return places;
}

}  // namespace

ZTrace trace_z_cache(const FrameRecord& record, const ZCacheShape& shape) {
  ZTrace trace;
  const std::vector<ZSurface> places = place(record, shape.parts);
  trace.memory_lines = memory_lines(places, shape);
  ZCache cache(shape, trace.memory_lines);
  const int bands = recorded_bands(record.config.tile_walker.tile_size);
  std::array<std::uint8_t, 16> folded{};
  for (std::size_t i = 0; i < folded.size(); ++i) {
    folded[i] = fold(static_cast<std::uint8_t>(i), bands, shape.parts);
  }
  const RecordedTriangle* triangle = record.triangles.data();
  const RecordedJob* job = record.jobs.data();
  std::uint32_t access = 0;
  for (const RecordedSegment& segment : record.segments) {
    if (segment.kind == RecordedSegment::Kind::kFastClear) {
      cache.clear(places[segment.surface]);
      continue;
    }
    for (std::uint32_t i = 0; i < segment.triangles; ++i, ++triangle) {
      const RecordedJob* const end = job + triangle->jobs;
      if (segment.touches_depth == 0) {
        job = end;
        continue;
      }
      for (; job != end; ++job) {
        if (job->quads() == 0) {
          continue;
        }
        const RecordedAccess& a = record.accesses[access];
        const ZMisses misses = cache.access(places[segment.surface], a.tile_x(), a.tile_y(),
                                            folded[a.touched()], folded[a.written()]);
        for (const ZMiss& miss : misses.parts()) {
          trace.misses.push_back(miss);
          trace.burst.push_back(access);
        }
        ++access;
      }
    }
  }
  trace.burst.push_back(0xFFFFFFFFu);
  cache.flush([&](std::uint32_t slot, std::uint32_t /*line*/, std::uint32_t bytes) {
    trace.flush.push_back({.slot = slot, .bytes = bytes});
  });
  return trace;
}

FrameWork record_work(const FrameRecord& record, const ZTrace& trace) {
  FrameWork work;
  const RecordedTriangle* triangle = record.triangles.data();
  const RecordedJob* job = record.jobs.data();
  std::uint32_t access = 0;
  std::size_t miss = 0;
  for (const RecordedSegment& segment : record.segments) {
    if (segment.kind == RecordedSegment::Kind::kFastClear) {
      work.fast_clears.push_back(record.surfaces[segment.surface].tiles);
      continue;
    }
    DrawWork draw;
    draw.triangles = segment.dropped_after;
    draw.drawn = segment.triangles;
    for (std::uint32_t i = 0; i < segment.triangles; ++i, ++triangle) {
      draw.triangles += triangle->dropped_before + 1;
      draw.steps += triangle->steps_after;
      for (const RecordedJob* const end = job + triangle->jobs; job != end; ++job) {
        draw.steps += job->steps();
        ++draw.tiles[static_cast<std::size_t>(job->quads())];
        access += segment.touches_depth != 0 && job->quads() != 0 ? 1 : 0;
      }
    }
    const std::size_t first = miss;
    while (trace.burst[miss] < access) {
      ++miss;
    }
    draw.count(std::span(trace.misses).subspan(first, miss - first));
    if (segment.kind == RecordedSegment::Kind::kDraw) {
      work.draws.push_back(draw);
    } else {
      work.drawn_clears += draw;
    }
  }
  work.flush = trace.flush;
  return work;
}

}  // namespace halfspace
