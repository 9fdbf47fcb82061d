#include "halfspace/reference/barycentric.hpp"

#include <utility>

namespace halfspace::reference {
namespace {

/// 64 bits are enough: window coordinates are below 2^24 on the grid, so a product is below 2^50.
std::int64_t area_of(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

}  // namespace

void cover_barycentrically(const Piece& piece, std::vector<Fragment>& fragments) {
  std::array<std::size_t, 3> order = {0, 1, 2};
  if (area_of(piece.grid[0], piece.grid[1], piece.grid[2]) < 0) std::swap(order[1], order[2]);
  const auto corner = [&](std::size_t i) { return piece.grid[order[i % 3]]; };
  const auto area = static_cast<double>(area_of(corner(0), corner(1), corner(2)));

  const PixelRect& box = piece.bounds;
  for (std::int64_t y = box.first_y; y < box.end_y; ++y) {
    for (std::int64_t x = box.first_x; x < box.end_x; ++x) {
      bool covered = true;
      Fragment fragment{x, y, 0, {}};
      for (std::size_t i = 0; i < 3; ++i) {
        // The weight of a corner is the share of the area that the sample spans with the opposite edge.
        const GridPoint from = corner(i + 1);
        const GridPoint to = corner(i + 2);
        const std::int64_t part = area_of(from, to, piece.centre(x, y));
        covered =
            covered && (part > 0 || (part == 0 && owns_samples(from.y - to.y, to.x - from.x, piece.rule)));
        const double weight = static_cast<double>(part) / area;
        fragment.depth += weight * piece.depth[order[i]];
        for (std::size_t k = 0; k < 3; ++k) fragment.color[k] += weight * piece.color[order[i]][k];
      }
      if (covered) fragments.push_back(fragment);
    }
  }
}

}  // namespace halfspace::reference
