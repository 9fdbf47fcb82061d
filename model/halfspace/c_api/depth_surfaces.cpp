#include "halfspace/c_api/depth_surfaces.hpp"

#include <fmt/format.h>

#include <utility>

#include "halfspace/numerics/error.hpp"

namespace halfspace::c_api {
namespace {

constexpr int kMostPixels = 16384;  // 2^PixelBits

std::uint64_t tile_count(const DepthSurface& surface) {
  return static_cast<std::uint64_t>(surface.codes.tiles_x()) *
         static_cast<std::uint64_t>(surface.codes.tiles_y());
}

void check_code(DepthFormat format, std::uint32_t code) {
  const std::uint32_t largest = largest_code(format);
  if (code > largest) {
    throw InputError(
        fmt::format("depth code is {:#x}; legal: at most {:#x}, which is depth 1", code, largest));
  }
}

}  // namespace

void DepthSurfaces::define(std::uint32_t first_tile, int format, int width, int height, std::uint32_t code,
                           int tile_size) {
  if (format != HALFSPACE_UNORM16 && format != HALFSPACE_UNORM24 && format != HALFSPACE_FLOAT32) {
    throw InputError(
        fmt::format("format of a depth surface is {}; legal: 1 (unorm16), 2 (unorm24), 4 (float32)", format));
  }
  for (const int size : {width, height}) {
    if (size < 1 || size > kMostPixels) {
      throw InputError(
          fmt::format("a depth surface of {} x {} pixels; legal: 1 to {}", width, height, kMostPixels));
    }
  }
  const auto depth_format = static_cast<DepthFormat>(format);
  check_code(depth_format, code);
  const auto tiles = [&](int pixels) {
    return static_cast<std::uint64_t>((pixels + tile_size - 1) / tile_size);
  };
  const std::uint64_t end = first_tile + tiles(width) * tiles(height);
  if (end > std::uint64_t{1} << 32) {
    throw InputError(
        fmt::format("tiles {} to {} of a depth surface; legal: at most {}", first_tile, end - 1, ~0u));
  }
  for (const auto& [first, other] : surfaces_) {
    if (first_tile < first + tile_count(other) && first < end) {
      throw InputError(fmt::format("tiles {} to {} of a depth surface; {} to {} are another's", first_tile,
                                   end - 1, first, first + tile_count(other) - 1));
    }
  }
  surfaces_.emplace(first_tile, DepthSurface{depth_format, {width, height, tile_size, code}});
}

void DepthSurfaces::clear(std::uint32_t first_tile, std::uint32_t code) {
  DepthSurface& surface = at(first_tile, "first_tile");
  check_code(surface.format, code);
  surface.codes.fill(
      {.x_first = 0, .y_first = 0, .x_last = surface.codes.width() - 1, .y_last = surface.codes.height() - 1},
      code);
}

std::uint32_t DepthSurfaces::read(std::uint32_t first_tile, int x, int y) {
  return std::as_const(with_pixel(first_tile, x, y).codes).at(x, y);
}

void DepthSurfaces::write(std::uint32_t first_tile, int x, int y, std::uint32_t code) {
  DepthSurface& surface = with_pixel(first_tile, x, y);
  check_code(surface.format, code);
  surface.codes.at(x, y) = code;
}

DepthSurface& DepthSurfaces::of_draw(const DrawStatePacket& draw) {
  DepthSurface& surface = at(draw.first_tile, "state.first_tile");
  if (static_cast<std::uint32_t>(surface.format) != draw.format) {
    throw InputError(fmt::format("state.format is {}; legal: {}, the format of the surface at tile {}",
                                 draw.format, static_cast<int>(surface.format), draw.first_tile));
  }
  if (surface.codes.tiles_x() != draw.tiles_x + 1) {
    throw InputError(
        fmt::format("state.tiles_x is {}; legal: {}, the tiles in a row of the surface at tile {}, less 1",
                    draw.tiles_x, surface.codes.tiles_x() - 1, draw.first_tile));
  }
  return surface;
}

DepthSurface& DepthSurfaces::at(std::uint32_t first_tile, const char* what) {
  const auto found = surfaces_.find(first_tile);
  if (found == surfaces_.end()) {
    std::string legal;
    for (const auto& [first, surface] : surfaces_) {
      legal += fmt::format("{}{}", legal.empty() ? "" : ", ", first);
    }
    throw InputError(fmt::format("{} is {}, where no depth surface begins; legal: {}", what, first_tile,
                                 legal.empty() ? "none is defined" : legal));
  }
  return found->second;
}

DepthSurface& DepthSurfaces::with_pixel(std::uint32_t first_tile, int x, int y) {
  DepthSurface& surface = at(first_tile, "first_tile");
  const int width = surface.codes.width();
  const int height = surface.codes.height();
  if (x < 0 || x >= width || y < 0 || y >= height) {
    throw InputError(fmt::format("pixel ({}, {}); legal: (0, 0) to ({}, {})", x, y, width - 1, height - 1));
  }
  return surface;
}

}  // namespace halfspace::c_api
