#include "halfspace/stress/wrong_coverage.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

#include "halfspace/reference/float_edges.hpp"

namespace halfspace::stress::wrong {
namespace {

using FloatLine = reference::FloatLine<float>;
using FloatPoint = reference::FloatPoint<float>;
using reference::GridPoint;
using reference::GridTriangle;
using reference::Piece;
using reference::PixelRect;

struct Edge {
  std::int64_t a;
  std::int64_t b;
  GridPoint from;

  [[nodiscard]] std::int64_t at(const GridPoint& p) const { return a * (p.x - from.x) + b * (p.y - from.y); }
  [[nodiscard]] bool top_left() const { return a > 0 || (a == 0 && b > 0); }
};

std::array<Edge, 3> edges_of(const GridTriangle& t) {
  const auto edge = [](const GridPoint& from, const GridPoint& to) {
    return Edge{from.y - to.y, to.x - from.x, from};
  };
  return {edge(t[0], t[1]), edge(t[1], t[2]), edge(t[2], t[0])};
}

/// Appends the pixel, with the depth of the plane through the vertices on the grid.
void add(const Piece& piece, std::int64_t x, std::int64_t y, Fragments& fragments) {
  const GridTriangle& t = piece.grid;
  const auto area = static_cast<double>(reference::twice_area(t[0], t[1], t[2]));
  const GridPoint p = piece.centre(x, y);
  double depth = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    depth +=
        static_cast<double>(reference::twice_area(t[(i + 1) % 3], t[(i + 2) % 3], p)) / area * piece.depth[i];
  }
  const auto [least, most] = std::minmax({piece.depth[0], piece.depth[1], piece.depth[2]});
  fragments.push_back({x, y, std::clamp(depth, least, most), {}});
}

/// Covers the pixels of `box` for which inside(x, y).
template <class Inside>
void fill(const Piece& piece, const PixelRect& box, Fragments& fragments, const Inside& inside) {
  for (std::int64_t y = box.first_y; y < box.end_y; ++y) {
    for (std::int64_t x = box.first_x; x < box.end_x; ++x) {
      if (inside(x, y)) {
        add(piece, x, y, fragments);
      }
    }
  }
}

/// Right but for the ties: owns(edge) says which edges have the samples on them.
template <class Owns>
void with_ties(const Piece& piece, Fragments& fragments, const Owns& owns) {
  const std::array<Edge, 3> edges = edges_of(reference::clockwise(piece.grid));
  fill(piece, piece.bounds, fragments, [&](std::int64_t x, std::int64_t y) {
    return std::all_of(edges.begin(), edges.end(), [&](const Edge& edge) {
      const std::int64_t e = edge.at(piece.centre(x, y));
      return e > 0 || (e == 0 && owns(edge));
    });
  });
}

bool is_right(const Piece& piece, std::int64_t x, std::int64_t y) {
  return reference::covers(piece.grid, piece.centre(x, y), piece.rule);
}

/// Right, in another box.
void in_box(const Piece& piece, const PixelRect& box, Fragments& fragments) {
  fill(piece, box, fragments, [&](std::int64_t x, std::int64_t y) { return is_right(piece, x, y); });
}

constexpr std::int64_t kTile = 8;

}  // namespace

void owns_nothing(const Piece& piece, Fragments& fragments) {
  with_ties(piece, fragments, [](const Edge&) { return false; });
}

void owns_everything(const Piece& piece, Fragments& fragments) {
  with_ties(piece, fragments, [](const Edge&) { return true; });
}

void bottom_right(const Piece& piece, Fragments& fragments) {
  with_ties(piece, fragments, [](const Edge& edge) { return !edge.top_left(); });
}

void no_top(const Piece& piece, Fragments& fragments) {
  with_ties(piece, fragments, [](const Edge& edge) { return edge.a > 0; });
}

void every_horizontal(const Piece& piece, Fragments& fragments) {
  with_ties(piece, fragments, [](const Edge& edge) { return edge.a >= 0; });
}

void unturned_ties(const Piece& piece, Fragments& fragments) {
  const bool turned = reference::twice_area(piece.grid[0], piece.grid[1], piece.grid[2]) < 0;
  with_ties(piece, fragments, [turned](const Edge& edge) { return edge.top_left() != turned; });
}

namespace {

/// Three edges in float32, each made of two vertices.
template <class EdgeType, class Make>
std::array<EdgeType, 3> float_edges_of(const Piece& piece, const Make& make) {
  const GridTriangle t = reference::clockwise(piece.grid);
  std::array<EdgeType, 3> edges;
  for (std::size_t i = 0; i < 3; ++i) {
    edges[i] = make(reference::float_point(t[i], piece.subpixel_bits),
                    reference::float_point(t[(i + 1) % 3], piece.subpixel_bits));
  }
  return edges;
}

template <class Edges>
void fill_by_floats(const Piece& piece, const Edges& edges, Fragments& fragments) {
  fill(piece, piece.bounds, fragments, [&](std::int64_t x, std::int64_t y) {
    return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
      return reference::on_inside(edge, edge.at(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F));
    });
  });
}

}  // namespace

void float_edges(const Piece& piece, Fragments& fragments) {
  using Edge = reference::VertexLine<float>;
  const auto relative = [](const FloatPoint& from, const FloatPoint& to) { return Edge(from, to); };
  fill_by_floats(piece, float_edges_of<Edge>(piece, relative), fragments);
}

void float_difference(const Piece& piece, Fragments& fragments) {
  fill_by_floats(piece, float_edges_of<FloatLine>(piece, reference::line_by_difference<float>), fragments);
}

void float_increments(const Piece& piece, Fragments& fragments) {
  const auto edges = float_edges_of<FloatLine>(piece, reference::line_by_difference<float>);
  const PixelRect& box = piece.bounds;
  std::array<float, 3> row{};
  for (std::size_t i = 0; i < 3; ++i) {
    row[i] = edges[i].at(static_cast<float>(box.first_x) + 0.5F, static_cast<float>(box.first_y) + 0.5F);
  }
  for (std::int64_t y = box.first_y; y < box.end_y; ++y) {
    std::array<float, 3> e = row;
    for (std::int64_t x = box.first_x; x < box.end_x; ++x) {
      if (reference::on_inside(edges[0], e[0]) && reference::on_inside(edges[1], e[1]) &&
          reference::on_inside(edges[2], e[2])) {
        add(piece, x, y, fragments);
      }
      for (std::size_t i = 0; i < 3; ++i) e[i] += edges[i].a;
    }
    for (std::size_t i = 0; i < 3; ++i) row[i] += edges[i].b;
  }
}

void coarse_grid(const Piece& piece, Fragments& fragments) {
  GridTriangle t = piece.grid;
  const std::int64_t step = std::int64_t{1} << (piece.subpixel_bits - 3);
  for (GridPoint& p : t) {
    p = {(p.x + step / 2) & -step, (p.y + step / 2) & -step};
  }
  fill(piece, piece.bounds, fragments,
       [&](std::int64_t x, std::int64_t y) { return reference::covers(t, piece.centre(x, y), piece.rule); });
}

void edges_of_32_bits(const Piece& piece, Fragments& fragments) {
  const std::array<Edge, 3> edges = edges_of(reference::clockwise(piece.grid));
  fill(piece, piece.bounds, fragments, [&](std::int64_t x, std::int64_t y) {
    return std::all_of(edges.begin(), edges.end(), [&](const Edge& edge) {
      const auto e = static_cast<std::int32_t>(edge.at(piece.centre(x, y)));
      return e > 0 || (e == 0 && edge.top_left());
    });
  });
}

void drops_tiny(const Piece& piece, Fragments& fragments) {
  const reference::Int128 area = reference::twice_area(piece.grid[0], piece.grid[1], piece.grid[2]);
  if (area >= 16 || area <= -16) {
    in_box(piece, piece.bounds, fragments);
  }
}

void one_winding(const Piece& piece, Fragments& fragments) {
  if (reference::twice_area(piece.grid[0], piece.grid[1], piece.grid[2]) > 0) {
    in_box(piece, piece.bounds, fragments);
  }
}

void short_box(const Piece& piece, Fragments& fragments) {
  PixelRect box = piece.bounds;
  --box.end_x;
  in_box(piece, box, fragments);
}

void late_box(const Piece& piece, Fragments& fragments) {
  PixelRect box = piece.bounds;
  ++box.first_y;
  in_box(piece, box, fragments);
}

void corner_samples(const Piece& piece, Fragments& fragments) {
  fill(piece, piece.bounds, fragments, [&](std::int64_t x, std::int64_t y) {
    const GridPoint centre = piece.centre(x, y);
    const std::int64_t half = (std::int64_t{1} << piece.subpixel_bits) / 2;
    return reference::covers(piece.grid, {centre.x - half, centre.y - half}, piece.rule);
  });
}

void swapped_reject(const Piece& piece, Fragments& fragments) {
  const std::array<Edge, 3> edges = edges_of(reference::clockwise(piece.grid));
  fill(piece, piece.bounds, fragments, [&](std::int64_t x, std::int64_t y) {
    const std::int64_t left = x / kTile * kTile;
    const std::int64_t top = y / kTile * kTile;
    const bool rejected = std::any_of(edges.begin(), edges.end(), [&](const Edge& edge) {
      // Where the edge is largest in x, but least in y.
      return edge.at(piece.centre(edge.a > 0 ? left + kTile - 1 : left, edge.b > 0 ? top : top + kTile - 1)) <
             0;
    });
    return !rejected && is_right(piece, x, y);
  });
}

void hasty_accept(const Piece& piece, Fragments& fragments) {
  const std::array<Edge, 3> edges = edges_of(reference::clockwise(piece.grid));
  fill(piece, piece.bounds, fragments, [&](std::int64_t x, std::int64_t y) {
    const GridPoint first = piece.centre(x / kTile * kTile, y / kTile * kTile);
    const GridPoint last = piece.centre(x / kTile * kTile + kTile - 1, y / kTile * kTile + kTile - 1);
    const bool accepted = std::all_of(edges.begin(), edges.end(), [&](const Edge& edge) {
      return edge.at(first) > 0 && edge.at(last) > 0;
    });
    return accepted || is_right(piece, x, y);
  });
}

void saturates_to_16_bits(const Piece& piece, Fragments& fragments) {
  const std::array<Edge, 3> edges = edges_of(reference::clockwise(piece.grid));
  fill(piece, piece.bounds, fragments, [&](std::int64_t x, std::int64_t y) {
    return std::all_of(edges.begin(), edges.end(), [&](const Edge& edge) {
      const std::int64_t left = x / kTile * kTile;
      const std::int64_t top = y / kTile * kTile;
      const std::int64_t origin =
          (edge.at(piece.centre(left, top)) - (edge.top_left() ? 0 : 1)) >> piece.subpixel_bits;
      return std::clamp<std::int64_t>(origin, -32768, 32767) + edge.a * (x - left) + edge.b * (y - top) >= 0;
    });
  });
}

void cuts_steps(const Piece& piece, Fragments& fragments) {
  const std::array<Edge, 3> edges = edges_of(reference::clockwise(piece.grid));
  fill(piece, piece.bounds, fragments, [&](std::int64_t x, std::int64_t y) {
    return std::all_of(edges.begin(), edges.end(), [&](const Edge& edge) {
      const std::int64_t a = edge.a & ~std::int64_t{1};  // the lowest bit is lost
      const std::int64_t b = edge.b & ~std::int64_t{1};
      const GridPoint p = piece.centre(x, y);
      const std::int64_t e = a * (p.x - edge.from.x) + b * (p.y - edge.from.y);
      return e > 0 || (e == 0 && edge.top_left());
    });
  });
}

void widens_slivers(const Piece& piece, Fragments& fragments) {
  const std::array<Edge, 3> edges = edges_of(reference::clockwise(piece.grid));
  fill(piece, piece.bounds, fragments, [&](std::int64_t x, std::int64_t y) {
    return std::all_of(edges.begin(), edges.end(), [&](const Edge& edge) {
      return edge.at(piece.centre(x, y)) >= -(std::abs(edge.a) + std::abs(edge.b)) / 2;  // half a sub-pixel
    });
  });
}

void no_prestep(const Piece& piece, Fragments& fragments) {
  const GridTriangle& t = piece.grid;
  for (std::int64_t y = piece.bounds.first_y; y < piece.bounds.end_y; ++y) {
    std::vector<double> crossings;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [top, bottom] =
          std::minmax(t[i], t[(i + 1) % 3], [](const GridPoint& a, const GridPoint& b) { return a.y < b.y; });
      const std::int64_t first = top.y >> piece.subpixel_bits;
      if (y >= first && y < bottom.y >> piece.subpixel_bits) {
        // At the whole row the edge is taken to be where its upper end is.
        const double slope = static_cast<double>(bottom.x - top.x) / static_cast<double>(bottom.y - top.y);
        crossings.push_back(reference::float_point(top, piece.subpixel_bits).x +
                            slope * static_cast<double>(y - first));
      }
    }
    if (crossings.size() == 2) {
      const auto [left, right] = std::minmax(crossings[0], crossings[1]);
      for (std::int64_t x = piece.bounds.first_x; x < piece.bounds.end_x; ++x) {
        const double centre = static_cast<double>(x) + 0.5;
        if (centre >= left && centre < right) {
          add(piece, x, y, fragments);
        }
      }
    }
  }
}

void unsigned_box(const Piece& piece, Fragments& fragments) {
  const GridTriangle& t = piece.grid;
  if (std::all_of(t.begin(), t.end(), [](const GridPoint& p) { return p.x >= 0 && p.y >= 0; })) {
    in_box(piece, piece.bounds, fragments);
  }
}

}  // namespace halfspace::stress::wrong
