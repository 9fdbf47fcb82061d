#include "halfspace/scene/depth_plane_rows.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

#include "halfspace/numerics/exact_sum.hpp"

namespace halfspace {
namespace {

std::int64_t floor_divide(std::int64_t value, std::int64_t by) {  // by > 0
  return value >= 0 ? value / by : -((-value + by - 1) / by);
}

}  // namespace

DepthPlaneRows::DepthPlaneRows(const std::array<ScreenVertex, 3>& v, const std::array<double, 3>& z,
                               int sub_pixel_bits)
    : z_(z), margin_(std::ldexp(std::max({std::abs(z[0]), std::abs(z[1]), std::abs(z[2])}), -48)) {
  const std::int64_t centre = std::int64_t{1} << (sub_pixel_bits - 1);
  const std::int64_t pixel = std::int64_t{1} << sub_pixel_bits;
  std::int64_t area2 = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const ScreenVertex& from = v[(i + 1) % 3];
    const ScreenVertex& to = v[(i + 2) % 3];
    const std::int64_t a = std::int64_t{from.y} - to.y;
    const std::int64_t b = std::int64_t{to.x} - from.x;
    edge_[i] = {a * (centre - from.x) + b * (centre - from.y), a * pixel, b * pixel};
    area2 += edge_[i].origin;
  }
  if (area2 < 0) {
    for (Edge& e : edge_) {
      e = {-e.origin, -e.dx, -e.dy};
    }
  }
  area2_ = static_cast<double>(std::abs(area2));
}

PixelRun DepthPlaneRows::covered(std::int32_t y, PixelRun run) const {
  for (const Edge& edge : edge_) {
    if (run.empty()) {
      break;
    }
    const std::int64_t start = edge.at(0, y);
    const auto near = [&](std::int64_t x) {
      return static_cast<std::int32_t>(std::clamp<std::int64_t>(x, run.first - 1, run.last + 1));
    };
    if (edge.dx == 0 && start < 0) {
      run.last = run.first - 1;
    } else if (edge.dx > 0) {
      run.first = std::max(run.first, near(-floor_divide(start, edge.dx)));
    } else if (edge.dx < 0) {
      run.last = std::min(run.last, near(floor_divide(start, -edge.dx)));
    }
  }
  return run;
}

PixelRun DepthPlaneRows::between(std::int32_t y, PixelRun covered, double low, double high) const {
  const double begin = rough_depth(covered.first, y);
  const double end = rough_depth(covered.last, y);
  low -= margin_ / 2;
  high += margin_ / 2;
  if (std::min(begin, end) >= high || std::max(begin, end) <= low) {
    return {covered.first, covered.first - 1};
  }
  const double steps = covered.last - covered.first;
  const double step = steps == 0 ? 0 : (end - begin) / steps;
  if (step == 0) {
    return covered;
  }
  const auto [from, to] = std::minmax({(low - begin) / step, (high - begin) / step});
  return {covered.first + static_cast<std::int32_t>(std::clamp(std::ceil(from), 0.0, steps + 1)),
          covered.first + static_cast<std::int32_t>(std::clamp(std::floor(to), -1.0, steps))};
}

double DepthPlaneRows::rough_depth(std::int32_t x, std::int32_t y) const {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    sum += z_[i] * static_cast<double>(edge_[i].at(x, y));
  }
  return sum / area2_;
}

double DepthPlaneRows::depth(std::int32_t x, std::int32_t y) const {
  // Halves of 26 or 27 bits, whose products are doubles.
  ExactSum<12> sum;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint64_t upper = std::bit_cast<std::uint64_t>(z_[i]) & ~((std::uint64_t{1} << 27) - 1);
    const double z_high = std::bit_cast<double>(upper);
    const double z_low = z_[i] - z_high;
    const std::int64_t e = edge_[i].at(x, y);
    const std::int64_t e_low = e & ((1 << 25) - 1);
    for (const double z : {z_high, z_low}) {
      sum.add(z * static_cast<double>(e_low));
      sum.add(z * static_cast<double>(e - e_low));
    }
  }
  return sum.rounded() / area2_;
}

}  // namespace halfspace
