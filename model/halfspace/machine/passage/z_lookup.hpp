/// A burst's passage through the lookup of early_z: the parts of its tile that have to do with stored depth,
/// and what the z cache says to them.
#pragma once

#include <bit>
#include <cstdint>

#include "halfspace/config/config.hpp"
#include "halfspace/machine/draw_context.hpp"
#include "halfspace/machine/passage/z_test.hpp"
#include "halfspace/machine/surfaces.hpp"
#include "halfspace/units/z_cache.hpp"

namespace halfspace::passage {

/// Bit i: part i of the tile, of `parts`, has to do with stored depth.
template <int TileSize>
std::uint8_t touched_parts(const Coverage& coverage, const DrawContext& draw, int parts) {
  return touches_depth(draw.early_z) ? parts_of_mask<TileSize>(coverage.mask, parts) : std::uint8_t{0};
}

/// Bit i: some fragment writes to part i. `kept`: those that passed and that the shader keeps.
template <int TileSize>
std::uint8_t written_parts(const TileMask& kept, const DrawContext& draw, int parts) {
  return draw.early_z.write ? parts_of_mask<TileSize>(kept, parts) : std::uint8_t{0};
}

/// By how much the parts that a burst wrote to are coded, given the tile's codes (TileSize^2, row order); 0
/// where lines are not coded.
template <int TileSize>
ZShifts coded_parts(const std::uint32_t* codes, std::uint8_t written, const ZSurface& surface,
                    const Config& config) {
  ZShifts shifts;
  if (config.z_cache.compression) {
    const ZCodecShape shape = z_codec_shape(surface, config);
    for (int part = 0; part < config.z_cache.parts; ++part) {
      if ((written >> part & 1) != 0) {
        const auto samples = static_cast<std::size_t>(shape.samples());
        shifts.set(part, z_coded_shift({codes + static_cast<std::size_t>(part) * samples, samples}, shape));
      }
    }
  }
  return shifts;
}

/// What a burst wants of the z cache. `codes`: the tile's, after all that it writes (TileSize^2, row order).
template <int TileSize>
ZAccess z_access(const Coverage& coverage, const Tested& tested, const std::uint32_t* codes,
                 const DrawContext& draw, const ZSurface& surface, const Config& config) {
  const int parts = config.z_cache.parts;
  const std::uint8_t written = written_parts<TileSize>(tested.kept, draw, parts);
  return {.touched = touched_parts<TileSize>(coverage, draw, parts),
          .written = written,
          .sure = sure_parts<TileSize>(coverage, parts),
          .shifts = coded_parts<TileSize>(codes, written, surface, config),
          .late = draw.early_z.late,
          .late_write = draw.early_z.late && any(tested.passed)};
}

/// Counts a burst that touched `touched` parts, and the lines that moved for it.
inline void count_z_cache(EarlyZCounters& counters, std::uint8_t touched, const ZMisses& misses) {
  ++counters.z_bursts;
  counters.z_hits += static_cast<std::uint64_t>(std::popcount(touched)) - misses.count;
  counters.z_misses += misses.count;
  for (const ZMiss& part : misses.parts()) {
    counters.z_overwritten += part.overwritten ? 1 : 0;
    counters.z_cleared += part.fetch || part.overwritten ? 0 : 1;
    counters.bytes_read += part.fetch ? part.bytes : 0;
    counters.z_evicted += part.write_back ? 1 : 0;
    counters.bytes_written += part.write_back ? part.victim_bytes : 0;
  }
}

/// Both halves of the z cache at once, for engines that take one burst after the other through lookup and
/// test. The burst must touch a part.
inline ZMisses z_cache(ZCache& cache, const ZSurface& surface, const Coverage& coverage,
                       const ZAccess& access, DrawContext& draw) {
  const ZMisses misses = cache.access(surface, coverage.tile_x, coverage.tile_y, access);
  count_z_cache(draw.counters.early_z, access.touched, misses);
  return misses;
}

}  // namespace halfspace::passage
