/// Random packet streams for tests of time.
#pragma once

#include <cstdint>

#include "halfspace/timing/record/frame_record.hpp"
#include "halfspace/units/z_codec.hpp"
#include "random_machine.hpp"

namespace halfspace::testing {

/// What the parts of a tile may be coded by.
inline ZShifts random_shifts(Random& random, const Config& config, std::uint32_t sample_bytes) {
  const int tile = config.tile_walker.tile_size;
  const int bytes = tile * tile / config.z_cache.parts * static_cast<int>(sample_bytes);
  ZShifts shifts;
  for (int part = 0; config.z_cache.compression && part < config.z_cache.parts; ++part) {
    int shift = static_cast<int>(random.between(0, kMostCodedShift));
    while (shift > 0 && bytes >> shift < kLeastCodedBytes) {
      --shift;
    }
    shifts.set(part, shift);
  }
  return shifts;
}

/// Packets as no frame has them: walks, draws and gaps of all lengths.
inline FrameRecord random_record(Random& random, const Config& config) {
  FrameRecord record;
  record.config = config;
  record.surfaces.push_back({.tiles_x = 16, .tiles = 256, .sample_bytes = pick(random, {2u, 4u})});
  const int most_quads = config.tile_walker.tile_size * config.tile_walker.tile_size / 4;
  const int row_tiles = config.block_walker.block_size / config.tile_walker.tile_size;
  const int most_jobs = row_tiles * row_tiles * config.raster.samples;
  const std::uint32_t most_empty = pick(random, {0u, 3u, 40u, 500u});
  const auto count = [&](std::uint32_t few, std::uint32_t many) {
    return static_cast<std::uint32_t>(random.between(0, random.between(0, 3) == 0 ? many : few));
  };
  PacketStream& packets = record.packets;
  for (auto segments = random.between(1, 12); segments > 0; --segments) {
    StreamSegment segment{.surface = 0, .dropped_after = count(4, 300)};
    if (config.z_cache.fast_clear && random.between(0, 4) == 0) {
      packets.segments.push_back({.kind = StreamSegment::Kind::kFastClear, .surface = 0});
      continue;
    }
    segment.kind = random.between(0, 4) == 0 ? StreamSegment::Kind::kDrawnClear : StreamSegment::Kind::kDraw;
    segment.touches_depth = random.between(0, 4) != 0 ? 1 : 0;
    segment.triangles = count(10, 100);
    const bool late = config.late_z.mode == LateZ::kLate && random.between(0, 1) == 0;
    const std::int64_t local = random.between(0, 15);  // bursts stay in so many columns
    for (std::uint32_t i = 0; i < segment.triangles; ++i) {
      StreamTriangle triangle{
          .dropped_before = count(2, 50), .blocks = 0, .empty_after = count(0, most_empty)};
      for (std::uint32_t jobs = count(4, 60); jobs > 0; --jobs) {
        if (triangle.blocks == 0 || packets.blocks.back().jobs() == most_jobs || random.between(0, 2) == 0) {
          ++triangle.blocks;
          packets.blocks.emplace_back(count(1, most_empty), 0);
        }
        packets.blocks.back().add_job();
        const auto quads = static_cast<int>(random.between(0, 2) == 0 ? 0 : random.between(1, most_quads));
        packets.jobs.push_back(static_cast<StreamJob>(quads));
        if (quads != 0 && segment.touches_depth != 0) {
          const auto bands =
              static_cast<std::int64_t>((1u << stream_bands(config.tile_walker.tile_size)) - 1);
          const auto touched = static_cast<std::uint8_t>(random.between(1, bands));
          const auto written =
              static_cast<std::uint8_t>(touched & static_cast<std::uint8_t>(random.between(0, bands)));
          packets.accesses.emplace_back(
              static_cast<std::uint32_t>(random.between(0, local)), count(3, 15), touched, written,
              static_cast<std::uint8_t>(written & static_cast<std::uint8_t>(random.between(0, bands))),
              random_shifts(random, config, record.surfaces[0].sample_bytes), late,
              late && (written != 0 || random.between(0, 1) == 0));
        }
      }
      packets.triangles.push_back(triangle);
    }
    packets.segments.push_back(segment);
  }
  return record;
}

}  // namespace halfspace::testing
