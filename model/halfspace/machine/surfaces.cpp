#include "halfspace/machine/surfaces.hpp"

#include <algorithm>
#include <set>

namespace halfspace {

namespace {

/// The targets without depth that a draw draws to, in order.
std::set<std::uint32_t> bare_targets(const Frame& frame) {
  std::set<std::uint32_t> bare;
  for (const Command& command : frame.commands) {
    if (command.kind == CommandKind::kDraw && frame.targets[command.target].depth_surface == kNoSurface) {
      bare.insert(command.target);
    }
  }
  return bare;
}

}  // namespace

ZCacheShape z_cache_shape(const Config& config) {
  return {.lines = config.z_cache.lines,
          .ways = config.z_cache.ways,
          .parts = config.z_cache.parts,
          .late_writes = config.late_z.mode == LateZ::kLate ? config.late_z.queue : 0};
}

std::vector<SurfaceShape> surface_shapes(const Frame& frame) {
  std::vector<SurfaceShape> shapes;
  for (const Target& target : frame.targets) {
    if (target.depth_surface == kNoSurface) {
      continue;
    }
    if (target.depth_surface >= shapes.size()) {
      shapes.resize(target.depth_surface + 1);
    }
    SurfaceShape& shape = shapes[target.depth_surface];
    shape = {.format = target.depth_format,
             .width = std::max(shape.width, static_cast<int>(target.width)),
             .height = std::max(shape.height, static_cast<int>(target.height))};
  }
  for (const std::uint32_t bare : bare_targets(frame)) {
    const Target& target = frame.targets[bare];
    shapes.push_back(
        {.target = bare, .width = static_cast<int>(target.width), .height = static_cast<int>(target.height)});
  }
  return shapes;
}

std::vector<std::uint32_t> surfaces_of_targets(const Frame& frame, const std::vector<Surface>& surfaces) {
  std::vector<std::uint32_t> numbers;
  for (const Target& target : frame.targets) {
    numbers.push_back(target.depth_surface);
  }
  for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
    if (surfaces[i].target) {
      numbers[*surfaces[i].target] = i;
    }
  }
  return numbers;
}

std::span<const Surface> depth_surfaces(const std::vector<Surface>& surfaces) {
  const auto bare = std::ranges::find_if(surfaces, [](const Surface& s) { return s.target.has_value(); });
  return {surfaces.begin(), bare};
}

std::vector<Surface> make_surfaces(const Frame& frame, const Config& config, const Watch& watch) {
  const int tile_size = config.tile_walker.tile_size;
  const int samples = config.raster.samples;
  std::vector<Surface> surfaces;
  for (const SurfaceShape& shape : surface_shapes(frame)) {
    Surface& surface = surfaces.emplace_back();
    if (shape.width == 0) {
      continue;  // a number that no target has
    }
    surface.target = shape.target;
    surface.format = shape.format;
    surface.codes = {shape.width, shape.height, tile_size, largest_code(shape.format), samples};
    if (watch.count_pixels) {
      surface.fragments = {shape.width, shape.height, tile_size, 0, samples};
      surface.survivors = {shape.width, shape.height, tile_size, 0, samples};
    }
    if (watch.keep_visible) {
      surface.visible = {shape.width, shape.height, tile_size, kNothingVisible, samples};
    }
    if (watch.keep_sums) {
      surface.sums = {shape.width, shape.height, tile_size, config.block_walker.block_size};
    }
  }
  return surfaces;
}

std::vector<StreamSurface> stream_surfaces(const std::vector<Surface>& surfaces) {
  std::vector<StreamSurface> list;
  for (const Surface& surface : depth_surfaces(surfaces)) {
    const auto tiles_x = static_cast<std::uint32_t>(surface.codes.tiles_x());
    list.push_back({.tiles_x = tiles_x,
                    .tiles = tiles_x * static_cast<std::uint32_t>(surface.codes.tiles_y()),
                    .sample_bytes = static_cast<std::uint32_t>(sample_bytes(surface.format))});
  }
  return list;
}

std::vector<ZSurface> place_surfaces(const std::vector<StreamSurface>& surfaces, int tile_size, int parts) {
  std::vector<ZSurface> places;
  std::uint32_t first = 0;
  const auto samples = static_cast<std::uint32_t>(tile_size * tile_size / parts);
  for (const StreamSurface& surface : surfaces) {
    places.push_back({.first_tile = first,
                      .tiles_x = surface.tiles_x,
                      .tiles = surface.tiles,
                      .line_bytes = samples * surface.sample_bytes});
    first += surface.tiles;
  }
  return places;
}

std::vector<ZSurface> place_surfaces(const std::vector<Surface>& surfaces, const Config& config) {
  return place_surfaces(stream_surfaces(surfaces), config.tile_walker.tile_size, config.z_cache.parts);
}

ZCodecShape z_codec_shape(const ZSurface& surface, const Config& config) {
  const int tile = config.tile_walker.tile_size;
  const int height = tile / config.z_cache.parts;
  return {.width = tile,
          .height = height,
          .sample_bytes = static_cast<int>(surface.line_bytes) / (tile * height)};
}

HiZConfig hi_z_config(const Config& config) {
  return {.enabled = config.hi_z.enabled,
          .accept = config.hi_z.accept,
          .bits = config.hi_z.bits,
          .lag = config.hi_z.lag,
          .block_size = config.block_walker.block_size,
          .tile_size = config.tile_walker.tile_size,
          .parts = config.z_cache.parts};
}

std::vector<HiZSurface> place_blocks(const std::vector<Surface>& surfaces, const Config& config) {
  std::vector<HiZSurface> places;
  std::uint32_t first = 0;
  const int size = config.block_walker.block_size;
  const auto blocks = [size](int pixels) { return static_cast<std::uint32_t>((pixels + size - 1) / size); };
  for (const Surface& surface : depth_surfaces(surfaces)) {
    const std::uint32_t blocks_x = blocks(surface.codes.width());
    places.push_back(
        {.first_block = first, .blocks_x = blocks_x, .blocks = blocks_x * blocks(surface.codes.height())});
    first += places.back().blocks;
  }
  return places;
}

HiZ make_hi_z(const std::vector<HiZSurface>& surfaces, const Config& config) {
  return HiZ(hi_z_config(config),
             surfaces.empty() ? 0 : surfaces.back().first_block + surfaces.back().blocks);
}

std::uint32_t memory_lines(const std::vector<ZSurface>& surfaces, const ZCacheShape& shape) {
  return surfaces.empty()
             ? 0
             : (surfaces.back().first_tile + surfaces.back().tiles) * static_cast<std::uint32_t>(shape.parts);
}

}  // namespace halfspace
