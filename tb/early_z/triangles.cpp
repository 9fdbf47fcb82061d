#include "early_z/triangles.hpp"

#include <algorithm>
#include <cmath>

#include "halfspace/units/edge_evaluator.hpp"
#include "halfspace/units/quad_generator.hpp"
#include "halfspace/units/setup.hpp"
#include "halfspace/units/square_edges.hpp"

namespace halfspace::tb {
namespace {

double random_fraction(Random& random) {
  return static_cast<double>(random.bits() >> 11) / static_cast<double>(std::uint64_t{1} << 53);
}

double random_depth(Random& random) {
  const double fraction = random_fraction(random);
  switch (random.below(8)) {
    case 0:
      return 0;
    case 1:
      return 1;
    case 2:
      return std::ldexp(fraction, -static_cast<int>(random.below(150)));  // down to subnormal floats
    default:
      return fraction;
  }
}

ScreenTriangle random_screen_triangle(const Widths& widths, DepthFormat format, int width, int height,
                                      Random& random) {
  const std::int64_t one = std::int64_t{1} << widths.SubPixelBits;
  const std::int64_t limit = (std::int64_t{1} << (widths.CoordBits - 1)) - 1;
  const std::int64_t centre_x = random.range(0, width * one - 1);
  const std::int64_t centre_y = random.range(0, height * one - 1);
  static constexpr std::int64_t kReach[] = {1, 3, 8, 8, 40, 40, 200, 16000};
  const std::int64_t reach = kReach[random.below(8)] * one;
  ScreenTriangle triangle{};
  for (ScreenVertex& v : triangle.v) {
    v.x = static_cast<std::int32_t>(std::clamp(centre_x + random.range(-reach, reach), -limit, limit));
    v.y = static_cast<std::int32_t>(std::clamp(centre_y + random.range(-reach, reach), -limit, limit));
  }
  const std::uint64_t shape = random.below(16);
  if (shape == 0) {  // half of the guard band, or nearly
    const std::uint64_t turn = random.bits();
    for (std::uint64_t i = 0; i < 3; ++i) {
      const std::uint64_t corner = (turn + i) & 3;
      triangle.v[i].x = static_cast<std::int32_t>(corner == 1 || corner == 2 ? limit : -limit);
      triangle.v[i].y = static_cast<std::int32_t>((corner & 2) != 0 ? limit : -limit);
    }
  } else if (shape <= 4) {  // sliver: the third vertex next to the line between the others
    triangle.v[2].x =
        (triangle.v[0].x + triangle.v[1].x) / 2 + static_cast<std::int32_t>(random.range(-3, 3));
    triangle.v[2].y =
        (triangle.v[0].y + triangle.v[1].y) / 2 + static_cast<std::int32_t>(random.range(-3, 3));
  } else if (shape <= 6) {  // vertices on pixel centres, so that samples have the depth of a vertex
    for (ScreenVertex& v : triangle.v) {
      v.x = static_cast<std::int32_t>((v.x & -one) + one / 2);
      v.y = static_cast<std::int32_t>((v.y & -one) + one / 2);
    }
  }
  const double depth = random_depth(random);
  const bool flat = random.below(4) == 0;
  // Depth clamp lets vertices leave [0, 1], to either side.
  const bool beyond = !flat && random.below(4) == 0;
  const auto any_depth = [&] {
    const double inside = random_depth(random);
    return !beyond || random.below(3) == 0
               ? inside
               : std::ldexp(inside * (random.below(2) == 0 ? 1 : -1), static_cast<int>(random.below(16)));
  };
  for (ScreenVertex& v : triangle.v) {
    v.z = format == DepthFormat::kNone ? 0 : vertex_depth_code(format, flat ? depth : any_depth());
    if (flat && random.below(2) == 0) {
      v.z = std::clamp<std::int64_t>(v.z + random.range(-2, 2), 0, vertex_depth_code(format, 1));
    }
  }
  if (beyond && (format == DepthFormat::kUnorm16 || format == DepthFormat::kUnorm24) &&
      random.below(4) == 0) {
    for (ScreenVertex& v : triangle.v) {  // about the end of short words, where sums have no room
      v.z = random.below(3) == 0 ? v.z : kShortWordEnd + random.range(-64, 127);
    }
  }
  if (format != DepthFormat::kNone && random.below(3) == 0) {
    const double sign = random.below(2) == 0 ? 1 : -1;
    triangle.offset = vertex_depth_code(
        format, std::ldexp(sign * random_fraction(random), -static_cast<int>(random.below(40))));
  }
  return triangle;
}

DepthLimits random_limits(DepthFormat format, Random& random) {
  const std::uint32_t one = largest_code(format);
  if (random.below(4) != 0) {
    return {.least = 0, .most = one};
  }
  const auto code = [&] { return static_cast<std::uint32_t>(random.below(std::uint64_t{one} + 1)); };
  const auto [least, most] = std::minmax({code(), code()});
  return {.least = least, .most = most};
}

template <int TileSize>
std::vector<QuadBurst> tile_bursts(const Widths& widths, const SetupTriangle& triangle, std::size_t most,
                                   Random& random) {
  std::vector<QuadBurst> bursts;
  const PixelRect& bounds = triangle.bounds;
  const int columns = bounds.x_last / TileSize - bounds.x_first / TileSize + 1;
  const int rows = bounds.y_last / TileSize - bounds.y_first / TileSize + 1;
  const int tiles = columns * rows;
  const auto first = static_cast<int>(random.below(static_cast<std::uint64_t>(tiles)));
  for (int i = 0; i < tiles && bursts.size() < most; ++i) {
    const int at = (first + i) % tiles;
    const int x = (bounds.x_first / TileSize + at % columns) * TileSize;
    const int y = (bounds.y_first / TileSize + at / columns) * TileSize;
    // One of its samples.
    const SamplePattern samples = standard_samples(widths.PixelSamples);
    const std::uint64_t sample =
        samples.count == 1 ? 0 : random.below(static_cast<std::uint64_t>(samples.count));
    TileJob job{.tile_x = static_cast<std::uint16_t>(x / TileSize * samples.count + static_cast<int>(sample)),
                .tile_y = static_cast<std::uint16_t>(y / TileSize)};
    for (std::size_t e = 0; e < 3; ++e) {
      const Edge& edge = triangle.edge[e];
      job.a[e] = edge.a;
      job.b[e] = edge.b;
      job.e[e] = edge.c + ((std::int64_t{edge.a} * x + std::int64_t{edge.b} * y) << widths.SubPixelBits) +
                 to_sample(edge.a, edge.b, samples.at[sample], widths.SubPixelBits);
    }
    job.x_first = static_cast<std::uint8_t>(std::max(bounds.x_first - x, 0));
    job.x_last = static_cast<std::uint8_t>(std::min(bounds.x_last - x, TileSize - 1));
    job.y_first = static_cast<std::uint8_t>(std::max(bounds.y_first - y, 0));
    job.y_last = static_cast<std::uint8_t>(std::min(bounds.y_last - y, TileSize - 1));
    const Coverage coverage = edge_evaluator<TileSize>(job, widths.SubPixelBits);
    if (any(coverage.mask)) {
      bursts.push_back(quad_generator<TileSize>(coverage));
    }
  }
  return bursts;
}

}  // namespace

SetupTriangle random_triangle(const Widths& widths, DepthFormat format, DepthInterpolator interpolator,
                              int width, int height, Random& random, const Squares& squares) {
  const SetupState state{.sub_pixel_bits = widths.SubPixelBits,
                         .fill_rule = kFillRules[random.below(kFillRules.size())],
                         .conservative = squares.mode,
                         .square_reach = squares.reach(widths),
                         .bounds = {0, 0, width - 1, height - 1},
                         .depth_format = format,
                         .limits = random_limits(format, random),
                         .interpolator = interpolator,
                         .hi_z = widths.PixelSamples == 1,
                         .samples = standard_samples(widths.PixelSamples).box()};
  SetupTriangle triangle;
  while (setup(random_screen_triangle(widths, format, width, height, random), state, triangle) !=
         SetupVerdict::kDrawn) {
  }
  return triangle;
}

std::vector<QuadBurst> bursts_of(const Widths& widths, const SetupTriangle& triangle, std::size_t most,
                                 Random& random) {
  return with_tile(widths.TileSize,
                   [&](auto size) { return tile_bursts<size()>(widths, triangle, most, random); });
}

}  // namespace halfspace::tb
