/// Families that are hard on coverage: every triangle is on the sub-pixel grid, and the definition judges.
#include <array>

#include "halfspace/stress/draw_list.hpp"
#include "halfspace/stress/family.hpp"

namespace halfspace::stress {
namespace {

constexpr std::array<std::uint32_t, 4> kSizes{16, 16, 32, 64};

std::uint32_t any_size(std::uint64_t seed) { return kSizes[SplitMix64(seed ^ 1).next() % kSizes.size()]; }

}  // namespace

Case sliver(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, any_size(seed), seed);
  list.draw();
  const std::int64_t reach = list.extent() / 2;
  for (int n = 0; n < 100; ++n) {
    const GridPoint a = list.point(-reach, list.extent() + reach);
    const GridPoint b = list.point(-reach, list.extent() + reach);
    // c with (b - a) x (c - a) = k times the gcd of b - a, somewhere along the edge.
    const std::int64_t dx = b.x - a.x;
    const std::int64_t dy = b.y - a.y;
    const auto [gcd, u, v] = bezout(dx, dy);
    if (gcd == 0) {
      continue;
    }
    const std::int64_t k = list.between(1, 4) * (list.one_in(2) ? 1 : -1);
    const std::int64_t along = list.between(0, gcd);
    const GridPoint c{a.x - v * k + along * (dx / gcd), a.y + u * k + along * (dy / gcd)};
    list.add(list.shuffled({a, b, c}));
  }
  return list.take_defined();
}

Case sub_pixel(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, 16, seed);
  list.draw();
  for (int n = 0; n < 300; ++n) {
    const std::int64_t half = list.one() / 2;
    const std::int64_t reach = list.between(1, half);
    GridPoint middle = list.sample_of(list.between(0, list.size() - 1), list.between(0, list.size() - 1));
    if (list.one_in(3)) {
      middle = list.point_on_target();
    }
    GridTriangle triangle;
    for (GridPoint& p : triangle) {
      p = {middle.x + list.between(-reach, reach), middle.y + list.between(-reach, reach)};
    }
    list.add(triangle);
  }
  return list.take_defined();
}

Case on_samples(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, 16, seed);
  list.draw();
  const auto sample = [&] {
    return list.sample_of(list.between(-2, list.size() + 1), list.between(-2, list.size() + 1));
  };
  for (int n = 0; n < 100; ++n) {
    GridTriangle triangle{sample(), sample(), sample()};
    switch (list.between(0, 3)) {
      case 0:  // all on samples
        break;
      case 1:  // an edge along a row or a column of samples
        triangle[1] = list.one_in(2) ? GridPoint{triangle[1].x, triangle[0].y}
                                     : GridPoint{triangle[0].x, triangle[1].y};
        triangle[2] = list.point_on_target();
        break;
      case 2: {  // an edge through samples, its ends beside
        const std::int64_t dx = list.between(-4, 4);
        const std::int64_t dy = list.between(-4, 4);
        const std::int64_t back = list.between(1, 2 * list.one());
        const std::int64_t on = list.between(1, 6 * list.one());
        const GridPoint through = triangle[0];
        triangle = {GridPoint{through.x - back * dx, through.y - back * dy},
                    GridPoint{through.x + on * dx, through.y + on * dy}, list.point_on_target()};
        break;
      }
      default:  // one on a sample
        triangle[1] = list.point_on_target();
        triangle[2] = list.point_on_target();
    }
    list.add(list.shuffled(triangle));
  }
  return list.take_defined();
}

Case collinear(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, any_size(seed), seed);
  list.draw();
  for (int n = 0; n < 100; ++n) {
    const GridPoint a = list.point_on_target();
    const GridPoint step = list.point(-list.one(), list.one());
    const std::int64_t most = list.between(1, 32);
    GridPoint b{a.x + most * step.x, a.y + most * step.y};
    const std::int64_t part = list.between(0, most);
    GridPoint c{a.x + part * step.x, a.y + part * step.y};
    if (list.one_in(2)) {  // beside the line
      c.x += list.between(-1, 1);
      c.y += list.between(-1, 1);
    }
    if (list.one_in(8)) {
      b = a;
    }
    list.add(list.shuffled({a, b, c}));
  }
  return list.take_defined();
}

Case near_miss(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, any_size(seed), seed);
  list.draw();
  const std::int64_t far = 32766 * list.one();
  for (int n = 0; n < 60; ++n) {
    const GridPoint sample =
        list.sample_of(list.between(0, list.size() - 1), list.between(0, list.size() - 1));
    const std::int64_t reach = std::int64_t{1} << list.between(2, precision.sub_pixel_bits + 12);
    const std::int64_t dx = list.between(-reach, reach);
    const std::int64_t dy = list.between(-reach, reach);
    const auto [gcd, u, v] = bezout(dx, dy);
    if (gcd != 1) {
      continue;  // a line through more points of the grid passes the sample farther away
    }
    // The middle of the edge, from which the sample is as far as the nearest points beside the line, or on
    // it.
    const std::int64_t beside = list.between(-1, 1);
    const GridPoint middle{sample.x - v * beside, sample.y + u * beside};
    const GridPoint third{list.between(-far, far), list.between(-far, far)};
    list.add(list.shuffled(
        {GridPoint{middle.x - dx, middle.y - dy}, GridPoint{middle.x + dx, middle.y + dy}, third}));
  }
  return list.take_defined();
}

Case guard_band(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, any_size(seed), seed);
  list.draw();
  const std::int64_t far = 32766 * list.one();
  const auto extreme = [&] {
    switch (list.between(0, 4)) {
      case 0:
        return -far;
      case 1:
        return far;
      case 2:
        return list.between(-far, far);
      case 3:
        return (list.one_in(2) ? far : -far) + list.between(-2, 2);
      default:
        return list.between(-list.extent(), 2 * list.extent());
    }
  };
  for (int n = 0; n < 60; ++n) {
    list.add(
        {GridPoint{extreme(), extreme()}, GridPoint{extreme(), extreme()}, GridPoint{extreme(), extreme()}});
  }
  return list.take_defined();
}

}  // namespace halfspace::stress
