#include "halfspace/timing/record/z_trace.hpp"

#include <array>

#include "halfspace/machine/surfaces.hpp"

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

}  // namespace

ZTrace trace_z_cache(const FrameRecord& record, const ZCacheShape& shape) {
  ZTrace trace;
  const int tile_size = record.config.tile_walker.tile_size;
  const std::vector<ZSurface> places = place_surfaces(record.surfaces, tile_size, shape.parts);
  trace.memory_lines = memory_lines(places, shape);
  ZCache cache(shape, trace.memory_lines);
  const int bands = stream_bands(tile_size);
  std::array<std::uint8_t, 16> folded{};
  for (std::size_t i = 0; i < folded.size(); ++i) {
    folded[i] = fold(static_cast<std::uint8_t>(i), bands, shape.parts);
  }
  const PacketStream& packets = record.packets;
  const StreamTriangle* triangle = packets.triangles.data();
  const StreamJob* job = packets.jobs.data();
  std::uint32_t access = 0;
  for (const StreamSegment& segment : packets.segments) {
    if (segment.kind == StreamSegment::Kind::kFastClear) {
      cache.clear(places[segment.surface]);
      continue;
    }
    for (std::uint32_t i = 0; i < segment.triangles; ++i, ++triangle) {
      const StreamJob* const end = job + triangle->jobs;
      if (segment.touches_depth == 0) {
        job = end;
        continue;
      }
      for (; job != end; ++job) {
        if (job->quads() == 0) {
          continue;
        }
        const StreamAccess& a = packets.accesses[access];
        const ZMisses misses = cache.access(places[segment.surface], a.tile_x(), a.tile_y(),
                                            folded[a.touched()], folded[a.written()]);
        for (const ZMiss& miss : misses.parts()) {
          trace.z.misses.push_back(miss);
          trace.z.burst.push_back(access);
        }
        ++access;
      }
    }
  }
  trace.z.burst.push_back(kNoBurst);
  cache.flush([&](std::uint32_t slot, std::uint32_t /*line*/, std::uint32_t bytes) {
    trace.flush.push_back({.slot = slot, .bytes = bytes});
  });
  return trace;
}

StreamView whole_stream(const FrameRecord& record, const ZTrace& trace) {
  return {.segments = record.packets.segments,
          .triangles = record.packets.triangles,
          .jobs = record.packets.jobs,
          .accesses = record.packets.accesses,
          .misses = trace.z.misses,
          .miss_burst = trace.z.burst,
          .tiles = {}};
}

}  // namespace halfspace
