#include "halfspace/scene/depth_by_sample.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "halfspace/scene/depth_plane_rows.hpp"
#include "halfspace/units/setup.hpp"

namespace halfspace {
namespace {

/// The plane is within a unit of the last place down to 2^-32 of the power of two above the largest vertex.
double tiny_limit(const std::array<double, 3>& z) {
  const double largest = std::max({std::abs(z[0]), std::abs(z[1]), std::abs(z[2])});
  return std::ldexp(1.0, std::ilogb(largest) + 1 - 32);
}

/// The depths between those of the vertices, as far as they are in `limits`.
DepthRange range_within(const std::array<double, 3>& z, const DepthRange& limits) {
  const auto [least, most] = std::minmax({z[0], z[1], z[2]});
  return {std::clamp(least, limits.least, limits.most), std::clamp(most, limits.least, limits.most)};
}

/// The pieces of one triangle.
class Pieces {
 public:
  Pieces(const ScreenTriangle& triangle, std::vector<ScreenTriangle>& out)
      : triangle_(triangle), out_(out), before_(out.size()) {}

  [[nodiscard]] std::size_t count() const { return out_.size() - before_; }

  /// With the depths of the triangle.
  void add(const PixelRect& within) {
    if (!within.empty()) {
      out_.push_back(triangle_);
      out_.back().within = within;
    }
  }

  /// With one depth. Equal ones of two rows become one piece.
  void add(PixelRun run, std::int32_t y, std::int64_t code) {
    if (run.empty()) {
      return;
    }
    if (count() != 0) {
      ScreenTriangle& last = out_.back();
      const bool flat = last.v[0].z == code && last.v[1].z == code && last.v[2].z == code;
      if (flat && last.within.x_first == run.first && last.within.x_last == run.last &&
          last.within.y_last == y - 1) {
        last.within.y_last = y;
        return;
      }
    }
    add(PixelRect{.x_first = run.first, .y_first = y, .x_last = run.last, .y_last = y});
    for (ScreenVertex& vertex : out_.back().v) {
      vertex.z = code;
    }
  }

 private:
  const ScreenTriangle& triangle_;
  std::vector<ScreenTriangle>& out_;
  std::size_t before_;
};

/// Pixels of a row each with its own depth; those that have the same become one piece.
template <class Code>
void add_samples(Pieces& pieces, PixelRun run, std::int32_t y, const Code& code) {
  if (run.empty()) {
    return;
  }
  PixelRun same{run.first, run.first};
  std::int64_t flat = code(run.first);
  for (std::int32_t x = run.first + 1; x <= run.last; ++x) {
    const std::int64_t next = code(x);
    if (next != flat) {
      pieces.add(same, y, flat);
      same.first = x;
      flat = next;
    }
    same.last = x;
  }
  pieces.add(same, y, flat);
}

}  // namespace

bool may_be_tiny(const std::array<double, 3>& z, const DepthRange& limits) {
  const auto [least, most] = std::minmax({z[0], z[1], z[2]});
  if ((most <= 0 && limits.least >= 0) || (least == 0 && most == 0)) {
    return false;
  }
  const double limit = tiny_limit(z);
  return least < limit && most > -limit;
}

void emit_far(const ScreenTriangle& triangle, const std::array<double, 3>& z, const DepthRange& limits,
              DepthFormat format, const SampleGrid& grid, std::vector<ScreenTriangle>& out) {
  const DepthPlaneRows plane(triangle.v, z, grid.sub_pixel_bits);
  const bool by_squares = grid.square_reach != 0;
  const PixelRect box =
      intersect(sample_bounds(triangle.v, grid.sub_pixel_bits, grid.square_reach), grid.screen);
  const DepthRange range = by_squares ? range_within(z, limits) : limits;
  Pieces pieces(triangle, out);
  const PixelRun row{box.x_first, box.x_last};
  for (std::int32_t y = box.y_first; by_squares && !plane.has_area() && y <= box.y_last; ++y) {
    pieces.add(row, y, vertex_depth_code(format, std::clamp(z[0], limits.least, limits.most)));
  }
  for (std::int32_t y = box.y_first; plane.has_area() && y <= box.y_last; ++y) {
    const PixelRun covered = by_squares ? row : plane.covered(y, row);
    if (covered.empty()) {
      continue;
    }
    const PixelRun within = plane.between(y, covered, range.least, range.most);
    const auto end = [&](std::int32_t x) {  // of the range, beyond which depth is at pixel x
      const bool is_least = plane.rough_depth(x, y) < (range.least + range.most) / 2;
      return vertex_depth_code(format, is_least ? range.least : range.most);
    };
    if (within.empty() && within.first == covered.first) {
      pieces.add(row, y, end(covered.first));
      continue;
    }
    if (covered.first < within.first) {
      pieces.add({row.first, within.first - 1}, y, end(covered.first));
    }
    // None where depth passes the range from one pixel to the next.
    add_samples(pieces, within, y, [&](std::int32_t x) {
      return vertex_depth_code(format, std::clamp(plane.depth(x, y), range.least, range.most));
    });
    if (within.last < covered.last) {
      pieces.add({within.last + 1, row.last}, y, end(covered.last));
    }
  }
  if (pieces.count() == 0) {
    pieces.add(triangle.within);  // setup drops and counts it
  }
}

bool emit_tiny(const ScreenTriangle& triangle, const std::array<double, 3>& z, const SampleGrid& grid,
               std::vector<ScreenTriangle>& out) {
  const DepthPlaneRows plane(triangle.v, z, grid.sub_pixel_bits);
  const PixelRect box = intersect(sample_bounds(triangle.v, grid.sub_pixel_bits), grid.screen);
  const double limit = tiny_limit(z);
  Pieces pieces(triangle, out);
  PixelRect whole = box;  // the rows since the last tiny sample
  for (std::int32_t y = box.y_first; plane.has_area() && y <= box.y_last; ++y) {
    const PixelRun covered = plane.covered(y, {box.x_first, box.x_last});
    const PixelRun tiny = covered.empty() ? covered : plane.between(y, covered, -limit, limit);
    if (tiny.empty()) {
      continue;
    }
    whole.y_last = y - 1;
    pieces.add(whole);
    whole.y_first = y + 1;
    pieces.add({.x_first = covered.first, .y_first = y, .x_last = tiny.first - 1, .y_last = y});
    add_samples(pieces, tiny, y,
                [&](std::int32_t x) { return vertex_depth_code(DepthFormat::kFloat32, plane.depth(x, y)); });
    pieces.add({.x_first = tiny.last + 1, .y_first = y, .x_last = covered.last, .y_last = y});
  }
  if (pieces.count() == 0) {
    pieces.add(triangle.within);
    return false;
  }
  whole.y_last = box.y_last;
  pieces.add(whole);
  return true;
}

}  // namespace halfspace
