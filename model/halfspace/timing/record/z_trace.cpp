#include "halfspace/timing/record/z_trace.hpp"

#include <array>
#include <utility>

#include "halfspace/machine/surfaces.hpp"
#include "halfspace/timing/contract.hpp"

namespace halfspace {
namespace {

/// Bands of a record as parts of a cache with fewer: those of which any band is set.
std::uint8_t fold(std::uint8_t bands, int band_count, int parts) {
  std::uint8_t folded = 0;
  for (int band = 0; band < band_count; ++band) {
    folded |= static_cast<std::uint8_t>((bands >> band & 1) << (band * parts / band_count));
  }
  return folded;
}

/// An eviction of a line, as the next miss of the line sees it.
struct Eviction {
  std::uint32_t miss = kNoBurst;  ///< the miss that made it, in order
  std::uint32_t writes = 0;       ///< to memory up to it, its own included
};

/// For each miss that may have to wait until its line has left, the miss that made it leave; kNoBurst for
/// others. Most need not wait on any machine. Burst k is looked up when burst k - early_z.pending is through
/// z_test, so what that one replaced has left the cache. And it was not through before the write buffer had a
/// slot for each of its victims, so all dirty lines but the last z_cache.write_buffers had been written. No
/// FIFO has more than kMostCredits.
std::vector<std::uint32_t> waits(const ZMissStream& z, std::uint32_t memory_lines) {
  std::vector<std::uint32_t> waits_for(z.misses.size(), kNoBurst);
  std::vector<Eviction> evicted(memory_lines);
  std::vector<std::uint32_t> writes(z.misses.size() + 1);  // of the misses before
  std::uint32_t through = 0;  // misses of bursts that are through z_test when this one is looked up
  for (std::uint32_t i = 0; i < z.misses.size(); ++i) {
    const ZMiss& miss = z.misses[i];
    while (z.burst[through] + kMostCredits <= z.burst[i]) {
      ++through;
    }
    // once waited for, also where a clear drops the line and it is asked for again
    const Eviction last = std::exchange(evicted[miss.line], {});
    if (last.miss != kNoBurst) {
      const bool gone = z.misses[last.miss].write_back ? last.writes + kMostCredits <= writes[through]
                                                       : last.miss < through;
      waits_for[i] = gone ? kNoBurst : last.miss;
    }
    writes[i + 1] = writes[i] + (miss.write_back ? 1 : 0);
    if (miss.victim != kNoZLine) {
      evicted[miss.victim] = {.miss = i, .writes = writes[i + 1]};
    }
  }
  return waits_for;
}

/// Puts rows of a small table in the place of lines of memory: a time is noted only where it is asked for
/// again, and a row serves another line after that. Row 0 is never written. Returns the number of rows.
std::uint32_t replace_lines(ZMissStream& z, std::uint32_t memory_lines) {
  const std::vector<std::uint32_t> waits_for = waits(z, memory_lines);
  std::vector<bool> asked(z.misses.size(), false);
  for (const std::uint32_t miss : waits_for) {
    if (miss != kNoBurst) {
      asked[miss] = true;
    }
  }
  std::vector<std::uint32_t> free;
  std::uint32_t rows = 1;
  for (std::size_t i = 0; i < z.misses.size(); ++i) {
    ZMiss& miss = z.misses[i];
    miss.line = 0;
    if (waits_for[i] != kNoBurst) {
      miss.line = z.misses[waits_for[i]].victim;  // a row already
      free.push_back(miss.line);
    }
    miss.victim = kNoZLine;
    if (asked[i]) {
      if (free.empty()) {
        free.push_back(rows++);
      }
      miss.victim = free.back();
      free.pop_back();
    }
  }
  return rows;
}

}  // namespace

ZTrace trace_lines(const FrameRecord& record, const ZCacheShape& shape) {
  ZTrace trace;
  const int tile_size = record.config.tile_walker.tile_size;
  const std::vector<ZSurface> places = place_surfaces(record.surfaces, tile_size, shape.parts);
  trace.rows = memory_lines(places, shape);
  ZCache cache(shape, trace.rows);
  const int bands = stream_bands(tile_size);
  // By a set of bands, the parts of which any is in it, and those of which all are.
  std::array<std::uint8_t, 16> any{};
  std::array<std::uint8_t, 16> all{};
  const auto every_part = static_cast<std::uint8_t>((1 << shape.parts) - 1);
  for (std::size_t i = 0; i < any.size(); ++i) {
    any[i] = fold(static_cast<std::uint8_t>(i), bands, shape.parts);
    all[i] = static_cast<std::uint8_t>(every_part &
                                       ~fold(static_cast<std::uint8_t>(~i & 15u), bands, shape.parts));
  }
  const PacketStream& packets = record.packets;
  const StreamTriangle* triangle = packets.triangles.data();
  const StreamBlock* block = packets.blocks.data();
  const StreamJob* job = packets.jobs.data();
  std::uint32_t access = 0;
  for (const StreamSegment& segment : packets.segments) {
    if (segment.kind == StreamSegment::Kind::kFastClear) {
      cache.clear(places[segment.surface]);
      continue;
    }
    for (std::uint32_t i = 0; i < segment.triangles; ++i, ++triangle) {
      const StreamJob* end = job;
      for (const StreamBlock* const last = block + triangle->blocks; block != last; ++block) {
        end += block->jobs();
      }
      if (segment.touches_depth == 0) {
        job = end;
        continue;
      }
      for (; job != end; ++job) {
        if (*job == 0) {
          continue;
        }
        const StreamAccess& a = packets.accesses[access];
        const ZMisses misses = cache.access(places[segment.surface], a.tile_x(), a.tile_y(),
                                            {.touched = any[a.touched()],
                                             .written = any[a.written()],
                                             .sure = all[a.sure()],
                                             .shifts = a.shifts(),
                                             .late = a.late(),
                                             .late_write = a.late_write()});
        for (const ZMiss& miss : misses.parts()) {
          trace.z.misses.push_back(miss);
          trace.z.burst.push_back(access);
        }
        if (misses.late_done != 0 || a.late_write()) {
          trace.z.late.push_back({.access = access, .done = misses.late_done, .leaves = a.late_write()});
        }
        ++access;
      }
    }
  }
  trace.z.burst.push_back(kNoBurst);
  trace.z.late.push_back({.access = kNoBurst});
  cache.flush([&](std::uint32_t slot, std::uint32_t /*line*/, std::uint32_t bytes) {
    trace.flush.push_back({.slot = slot, .bytes = bytes});
  });
  return trace;
}

ZTrace trace_z_cache(const FrameRecord& record, const ZCacheShape& shape) {
  ZTrace trace = trace_lines(record, shape);
  trace.rows = replace_lines(trace.z, trace.rows);
  return trace;
}

StreamView whole_stream(const FrameRecord& record, const ZTrace& trace) {
  return {.segments = record.packets.segments,
          .triangles = record.packets.triangles,
          .blocks = record.packets.blocks,
          .jobs = record.packets.jobs,
          .accesses = record.packets.accesses,
          .misses = trace.z.misses,
          .miss_burst = trace.z.burst,
          .late = trace.z.late,
          .tiles = {},
          .live = {}};
}

}  // namespace halfspace
