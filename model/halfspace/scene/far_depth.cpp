#include "halfspace/scene/far_depth.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "halfspace/units/setup.hpp"

namespace halfspace {
namespace {

__extension__ using Int128 = __int128;

// z in units of 2^-44 takes 71 bits and a sign, E anywhere in the guard band 51, and the sum of three
// products two more.
constexpr int kFraction = 44;
constexpr double kMostFar = 1 << 27;

Int128 fixed(double z) {
  return static_cast<Int128>(std::nearbyint(std::ldexp(std::clamp(z, -kMostFar, kMostFar), kFraction)));
}

/// The plane of depth times the area of its triangle: a linear function with integers as coefficients.
struct Numerator {
  Int128 origin = 0;  ///< at the centre of pixel (0, 0)
  Int128 dx = 0;      ///< for a pixel
  Int128 dy = 0;
  Int128 area2 = 0;

  [[nodiscard]] Int128 at(std::int32_t x, std::int32_t y) const { return origin + dx * x + dy * y; }
};

Numerator numerator(const std::array<ScreenVertex, 3>& v, const std::array<double, 3>& z,
                    int sub_pixel_bits) {
  Numerator sum;
  const std::int64_t centre = std::int64_t{1} << (sub_pixel_bits - 1);
  for (std::size_t i = 0; i < 3; ++i) {
    const ScreenVertex& from = v[(i + 1) % 3];
    const ScreenVertex& to = v[(i + 2) % 3];
    const std::int64_t a = std::int64_t{from.y} - to.y;
    const std::int64_t b = std::int64_t{to.x} - from.x;
    const std::int64_t e = a * (centre - from.x) + b * (centre - from.y);
    sum.origin += fixed(z[i]) * e;
    sum.dx += fixed(z[i]) * (a << sub_pixel_bits);
    sum.dy += fixed(z[i]) * (b << sub_pixel_bits);
    sum.area2 += e;
  }
  return sum.area2 < 0 ? Numerator{-sum.origin, -sum.dx, -sum.dy, -sum.area2} : sum;
}

/// How many of `count` terms first, first + step, ... come before they reach `limit`, going up.
std::int32_t before(Int128 first, Int128 step, Int128 limit, std::int32_t count) {
  if (first >= limit) {
    return 0;
  }
  return static_cast<std::int32_t>(std::min<Int128>((limit - first + step - 1) / step, count));
}

}  // namespace

bool is_far(double depth) { return !(std::abs(depth) < (1 << kVertexDepthRange)); }

std::size_t emit_by_sample(const ScreenTriangle& triangle, const std::array<double, 3>& z,
                           const DepthRange& range, DepthFormat format, int sub_pixel_bits,
                           const PixelRect& screen, std::vector<ScreenTriangle>& out) {
  const std::size_t size_before = out.size();
  const Numerator depth = numerator(triangle.v, z, sub_pixel_bits);
  const PixelRect box = intersect(sample_bounds(triangle.v, sub_pixel_bits), screen);
  if (depth.area2 == 0 || box.empty()) {
    out.push_back(triangle);  // setup drops and counts it
    return 1;
  }
  const auto emit = [&](std::int32_t x_first, std::int32_t x_last, std::int32_t y, double flat) {
    const std::int64_t code = vertex_depth_code(format, flat);
    if (out.size() != size_before) {
      ScreenTriangle& last = out.back();
      if (last.v[0].z == code && last.within.x_first == x_first && last.within.x_last == x_last &&
          last.within.y_last == y - 1) {
        last.within.y_last = y;
        return;
      }
    }
    ScreenTriangle piece = triangle;
    for (ScreenVertex& vertex : piece.v) {
      vertex.z = code;
    }
    piece.within = {.x_first = x_first, .y_first = y, .x_last = x_last, .y_last = y};
    out.push_back(piece);
  };
  const Int128 least = fixed(range.least) * depth.area2;
  const Int128 most = fixed(range.most) * depth.area2;
  const std::int32_t count = box.x_last - box.x_first + 1;
  for (std::int32_t y = box.y_first; y <= box.y_last; ++y) {
    // Along a row depth is below the range, in it and above, or the other way round.
    const bool rises = depth.dx >= 0;
    const auto pixel = [&](std::int32_t i) { return rises ? box.x_first + i : box.x_last - i; };
    const auto run = [&](std::int32_t begin, std::int32_t end, double flat) {
      if (begin < end) {
        emit(std::min(pixel(begin), pixel(end - 1)), std::max(pixel(begin), pixel(end - 1)), y, flat);
      }
    };
    const Int128 step = rises ? depth.dx : -depth.dx;
    const Int128 first = depth.at(pixel(0), y);
    if (step == 0) {
      run(0, count,
          std::clamp(std::ldexp(static_cast<double>(first) / static_cast<double>(depth.area2), -kFraction),
                     range.least, range.most));
      continue;
    }
    const std::int32_t below = before(first, step, least, count);
    const std::int32_t within = before(first, step, most + 1, count);
    run(0, below, range.least);
    for (std::int32_t i = below; i < within; ++i) {
      run(i, i + 1,
          std::ldexp(static_cast<double>(first + step * i) / static_cast<double>(depth.area2), -kFraction));
    }
    run(within, count, range.most);
  }
  return out.size() - size_before;
}

}  // namespace halfspace
