/// Edges and depth of a triangle at the centres of pixels, row by row: for the front end, where it has to
/// know depth itself.
#pragma once

#include <array>
#include <cstdint>

#include "halfspace/units/packets.hpp"

namespace halfspace {

/// Pixels of a row, first to last; none where last < first.
struct PixelRun {
  std::int32_t first;
  std::int32_t last;

  [[nodiscard]] bool empty() const { return last < first; }
};

class DepthPlaneRows {
 public:
  /// The triangle through `v`, in either order, within the guard band, with the depths `z`.
  DepthPlaneRows(const std::array<ScreenVertex, 3>& v, const std::array<double, 3>& z, int sub_pixel_bits);

  [[nodiscard]] bool has_area() const { return area2_ != 0; }

  /// Those of `run` whose centres are inside the triangle or on its edges.
  [[nodiscard]] PixelRun covered(std::int32_t y, PixelRun run) const;

  /// Those of covered pixels whose depth is above `low` and below `high`, and maybe some more whose depth is
  /// no farther from that than 2^-48 of the largest vertex. Depth is linear along a row: an empty run begins
  /// where depth passes from one side to the other, or else with the first pixel.
  [[nodiscard]] PixelRun between(std::int32_t y, PixelRun covered, double low, double high) const;

  /// Depth at a covered pixel, off by some 2^-51 of the largest vertex.
  [[nodiscard]] double rough_depth(std::int32_t x, std::int32_t y) const;

  /// Depth at any pixel, within 2^-51 of itself: the sum of z_i E_i, added without loss, by twice the area.
  [[nodiscard]] double depth(std::int32_t x, std::int32_t y) const;

 private:
  /// Twice the area between an edge and a pixel's centre: not negative inside the triangle, and less than
  /// 2^51 in magnitude.
  struct Edge {
    std::int64_t origin;  ///< at pixel (0, 0)
    std::int64_t dx;      ///< for a pixel
    std::int64_t dy;

    [[nodiscard]] std::int64_t at(std::int32_t x, std::int32_t y) const { return origin + dx * x + dy * y; }
  };

  std::array<Edge, 3> edge_;  ///< edge i is opposite to vertex i; all add up to twice the area
  std::array<double, 3> z_;
  double area2_ = 0;
  double margin_;  ///< 2^-48 of the largest vertex
};

}  // namespace halfspace
