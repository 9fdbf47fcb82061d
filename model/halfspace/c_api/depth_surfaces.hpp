/// The depth surfaces that a user of the C API has defined.
#pragma once

#include <cstdint>
#include <map>

#include "halfspace/c_api/halfspace.h"

#include "halfspace/numerics/depth.hpp"
#include "halfspace/units/link_packets.hpp"
#include "halfspace/units/tiled_image.hpp"

namespace halfspace::c_api {

struct DepthSurface {
  DepthFormat format = DepthFormat::kNone;
  TiledImage<std::uint32_t> codes;
};

/// By first tile. All functions throw InputError for what is not legal.
class DepthSurfaces {
 public:
  void define(std::uint32_t first_tile, int format, int width, int height, std::uint32_t code, int tile_size);
  void clear(std::uint32_t first_tile, std::uint32_t code);
  [[nodiscard]] std::uint32_t read(std::uint32_t first_tile, int x, int y);
  void write(std::uint32_t first_tile, int x, int y, std::uint32_t code);

  /// The surface that a draw tests against: of the place, the format and the row length that its state says.
  [[nodiscard]] DepthSurface& of_draw(const DrawStatePacket& draw);

 private:
  [[nodiscard]] DepthSurface& at(std::uint32_t first_tile, const char* what);
  [[nodiscard]] DepthSurface& with_pixel(std::uint32_t first_tile, int x, int y);

  std::map<std::uint32_t, DepthSurface> surfaces_;
};

}  // namespace halfspace::c_api
