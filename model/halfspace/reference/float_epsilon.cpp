#include "halfspace/reference/float_epsilon.hpp"

#include <algorithm>
#include <array>

#include "halfspace/reference/float_edges.hpp"

namespace halfspace::reference {

void cover_with_epsilon(const Piece& piece, std::vector<Fragment>& fragments) {
  const GridTriangle t = clockwise(piece.grid);
  std::array<FloatLine<float>, 3> edges;
  for (std::size_t i = 0; i < 3; ++i) {
    edges[i] = line_from_vertex(float_point(t[i], piece.subpixel_bits),
                                float_point(t[(i + 1) % 3], piece.subpixel_bits));
  }
  const PixelRect& box = piece.bounds;
  for (std::int64_t y = box.first_y; y < box.end_y; ++y) {
    for (std::int64_t x = box.first_x; x < box.end_x; ++x) {
      const float centre_x = static_cast<float>(x) + 0.5F;
      const float centre_y = static_cast<float>(y) + 0.5F;
      if (std::all_of(edges.begin(), edges.end(), [&](const FloatLine<float>& edge) {
            return on_inside_but_for(kEdgeEpsilon, edge, edge.at(centre_x, centre_y), piece.rule);
          })) {
        fragments.push_back(piece.fragment(x, y));
      }
    }
  }
}

}  // namespace halfspace::reference
