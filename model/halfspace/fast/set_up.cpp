#include "halfspace/fast/set_up.hpp"

#include <algorithm>
#include <array>

#include "halfspace/units/depth_plane.hpp"
#include "halfspace/units/float_parts.hpp"

namespace halfspace::fast {
namespace {

bool fits(Modular gradient) {
  const auto narrow = static_cast<std::int64_t>(gradient);
  return static_cast<Int128>(gradient) == narrow;
}

/// Whether sums of words between `low` and `high`, and a little more, and `offset` fit a word whose end is
/// `end`.
bool sum_fits(std::int64_t low, std::int64_t high, std::int64_t offset, Int128 end) {
  const Int128 slack = end >> 10;
  return offset == 0 || (Int128{low} + offset >= slack - end && Int128{high} + offset <= end - slack);
}

/// Whether codes are within those of [0, 1], which vectors of float32 make.
bool in_unit_range(const DepthEquation& eq) {
  return code_order(eq.min_code) >= 0 &&
         code_order(eq.max_code) <= code_order(largest_code(DepthFormat::kFloat32));
}

DepthKind kind_of(const DepthEquation& eq, const EarlyZState& state) {
  if (eq.min_code == eq.max_code) {
    return DepthKind::kFlat;
  }
  if (state.interpolator != DepthInterpolator::kPlane || eq.beyond || !in_unit_range(eq)) {
    return DepthKind::kUnits;
  }
  if (state.format == DepthFormat::kFloat32) {
    constexpr int kLeastExponent = -63;  // the least word is a normal float
    std::array<std::int64_t, 3> word{};
    for (std::size_t i = 0; i < 3; ++i) {
      word[i] = word_of_float(static_cast<std::uint32_t>(eq.z[i]), eq.exponent);
    }
    const auto [low, high] = std::minmax({word[0], word[1], word[2]});
    return eq.exponent >= kLeastExponent && sum_fits(low, high, eq.offset, Int128{1} << 63)
               ? DepthKind::kLong
               : DepthKind::kUnits;
  }
  const auto [low, high] = std::minmax({eq.z[0], eq.z[1], eq.z[2]});
  return fits(eq.plane.dx) && fits(eq.plane.dy) && sum_fits(low, high, eq.offset, Int128{1} << 31)
             ? DepthKind::kShort
             : DepthKind::kUnits;
}

}  // namespace

void SetUpTriangles::append(const SetupTriangle& in, const DrawContext& draw, int sub_pixel_bits,
                            bool has_depth) {
  const std::size_t i = count++;
  for (std::size_t k = 0; k < 3; ++k) {
    a[k][i] = in.edge[k].a;
    b[k][i] = in.edge[k].b;
    e[k][i] = in.edge[k].c >> sub_pixel_bits;
  }
  x_first[i] = in.bounds.x_first;
  y_first[i] = in.bounds.y_first;
  x_last[i] = in.bounds.x_last;
  y_last[i] = in.bounds.y_last;
  number[i] = static_cast<std::int32_t>(in.triangle);
  order[i] = static_cast<std::int32_t>(draw.counters.setup.triangles - 1);
  const DepthEquation& eq = in.depth;
  const DepthKind how = has_depth ? kind_of(eq, draw.early_z) : DepthKind::kNone;
  kind[i] = static_cast<std::int32_t>(how);
  low[i] = static_cast<std::int32_t>(eq.min_code);
  high[i] = static_cast<std::int32_t>(eq.max_code);
  if (how == DepthKind::kUnits) {
    full[i] = static_cast<std::int32_t>(whole.size());
    whole.push_back(in);
    first_whole = whole.data();
  }
  const bool is_float = draw.early_z.format == DepthFormat::kFloat32;
  added[i] = eq.offset + (is_float ? 0 : std::int64_t{1} << (vertex_depth_fraction(draw.early_z.format) - 1));
  x[i] = eq.plane.x;
  y[i] = eq.plane.y;
  z[i] = eq.plane.z;
  dx[i] = static_cast<std::uint64_t>(eq.plane.dx);
  dy[i] = static_cast<std::uint64_t>(eq.plane.dy);
  dx_high[i] = static_cast<std::int64_t>(eq.plane.dx >> 64);
  dy_high[i] = static_cast<std::int64_t>(eq.plane.dy >> 64);
  exponent[i] = eq.exponent;
}

}  // namespace halfspace::fast
