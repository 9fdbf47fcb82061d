/// study_bench: the arithmetic of the precision study in SystemVerilog, against the numbers of this processor
/// and the C++ of the study, bit for bit. Exit status 1 and a line on the first difference.
#include <Vstudy_units.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <type_traits>

#include "common/random.hpp"
#include "common/verilated_model.hpp"
#include "halfspace/reference/float_edges.hpp"
#include "halfspace/reference/float_epsilon.hpp"
#include "halfspace/study/precision/depth_arithmetic.hpp"
#include "halfspace/units/depth_plane.hpp"

namespace halfspace::tb {
namespace {

using Model = VerilatedModel<Vstudy_units>;

constexpr int kPlaneBits = 31;
constexpr int kWidth = 32;

template <class T>
using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;

template <class T>
T flushed(T value) {
  return std::abs(value) < std::numeric_limits<T>::min() ? std::copysign(T{0}, value) : value;
}

/// A subnormal product is 0. One that only its rounding makes normal is told by a factor of a power of two,
/// with which nothing is subnormal.
template <class T>
T product(T a, T b) {
  const T x = flushed(a);
  const T y = flushed(b);
  const T result = x * y;
  if (result == 0 || std::abs(result) > 2 * std::numeric_limits<T>::min()) {
    return flushed(result);
  }
  const T factor = std::ldexp(T{1}, std::numeric_limits<T>::max_exponent / 2);
  const T scaled = std::abs(x) < std::abs(y) ? (x * factor) * y : x * (y * factor);
  return std::abs(scaled) < std::numeric_limits<T>::min() * factor ? std::copysign(T{0}, scaled) : result;
}

template <class T>
T sum(T a, T b) {
  return flushed(flushed(a) + flushed(b));
}

/// Numbers of every exponent, near each other, and corners; none is infinite.
template <class T>
T number(Random& random, T near) {
  constexpr int kFraction = std::numeric_limits<T>::digits - 1;
  constexpr auto kFields = static_cast<std::uint64_t>(2 * std::numeric_limits<T>::max_exponent - 1);
  const std::uint64_t kind = random.below(8);
  std::uint64_t field = random.below(kFields);
  std::uint64_t fraction = random.bits();
  if (kind < 3) {  // as far from the other as a sum still sees both, or its neighbour
    const std::uint64_t spread = kind == 2 ? 2 * kFraction + 5 : 5;
    const std::uint64_t other = std::bit_cast<Bits<T>>(near);
    field = (other >> kFraction) % (kFields + 1) + random.below(spread);
    field = field < spread / 2 ? 0 : std::min(field - spread / 2, kFields - 1);
    fraction = kind == 0 ? other + random.below(3) : fraction;
  } else if (kind == 3) {  // ends
    field = random.below(2) == 0 ? random.below(3) : kFields - 1 - random.below(3);
  } else if (kind == 4) {  // products near the least normal number
    field = kFields / 4 + random.below(4);
  }
  if (random.below(4) == 0) {  // few bits: ties
    fraction &= ~std::uint64_t{0} << (kFraction - static_cast<int>(random.below(kFraction / 2)));
  } else if (random.below(8) == 0) {
    fraction = random.below(2) == 0 ? 0 : ~std::uint64_t{0};
  }
  const std::uint64_t mask = (std::uint64_t{1} << kFraction) - 1;
  const std::uint64_t sign = random.below(2) << (8 * sizeof(T) - 1);
  return std::bit_cast<T>(static_cast<Bits<T>>(sign | field << kFraction | (fraction & mask)));
}

void expect(std::uint64_t found, std::uint64_t wanted, const char* what, std::uint64_t a, std::uint64_t b) {
  if (found != wanted) {
    throw std::runtime_error(
        fmt::format("{} of 0x{:x} and 0x{:x}: expected 0x{:x}, found 0x{:x}", what, a, b, wanted, found));
  }
}

void check_numbers(Model& model, Random& random) {
  const auto fa = number<float>(random, 1);
  const auto fb = number<float>(random, fa);
  const auto da = number<double>(random, 1);
  const auto db = number<double>(random, da);
  model->float_a_i = std::bit_cast<std::uint32_t>(fa);
  model->float_b_i = std::bit_cast<std::uint32_t>(fb);
  model->double_a_i = std::bit_cast<std::uint64_t>(da);
  model->double_b_i = std::bit_cast<std::uint64_t>(db);
  model.settle();
  expect(model->float_product_o, std::bit_cast<std::uint32_t>(product(fa, fb)), "float32 product",
         model->float_a_i, model->float_b_i);
  expect(model->float_sum_o, std::bit_cast<std::uint32_t>(sum(fa, fb)), "float32 sum", model->float_a_i,
         model->float_b_i);
  expect(model->double_product_o, std::bit_cast<std::uint64_t>(product(da, db)), "double product",
         model->double_a_i, model->double_b_i);
  expect(model->double_sum_o, std::bit_cast<std::uint64_t>(sum(da, db)), "double sum", model->double_a_i,
         model->double_b_i);
}

void clock(Model& model, int times) {
  for (int i = 0; i < times; ++i) {
    model.settle();
    model.clock_edge();
  }
}

reference::GridTriangle triangle(Random& random) {
  const std::int64_t reach = std::int64_t{1} << random.range(8, 18);
  const reference::GridPoint middle{random.range(0, 1 << 18), random.range(0, 1 << 18)};
  reference::GridTriangle t;
  do {
    for (reference::GridPoint& p : t) {
      p = {middle.x + random.range(-reach, reach), middle.y + random.range(-reach, reach)};
    }
  } while (reference::twice_area(t[0], t[1], t[2]) == 0);
  return t;
}

/// Pixels about the first vertex, whose edges they are near.
void check_edges(Model& model, Random& random) {
  const reference::GridTriangle t = reference::clockwise(triangle(random));
  const std::int64_t x = std::clamp<std::int64_t>((t[0].x >> 8) + random.range(-2, 2), 0, 16383);
  const std::int64_t y = std::clamp<std::int64_t>((t[0].y >> 8) + random.range(-2, 2), 0, 16383);
  const reference::GridPoint centre = reference::pixel_centre(x, y, 8);
  const std::int64_t a = t[0].y - t[1].y;
  const std::int64_t b = t[1].x - t[0].x;
  const bool owns = reference::owns_samples(a, b, reference::TieRule::kTopLeft);
  const std::int64_t e = a * (centre.x - t[0].x) + b * (centre.y - t[0].y) - (owns ? 0 : 1);
  model->step_a_i = static_cast<std::uint32_t>(a) & 0x1FFFFFF;
  model->step_b_i = static_cast<std::uint32_t>(b) & 0x1FFFFFF;
  model->constant_i =
      static_cast<std::uint64_t>((e - ((a * x + b * y) << 8)) >> 8) & ((std::uint64_t{1} << 43) - 1);
  model->x_i = static_cast<std::uint16_t>(x);
  model->y_i = static_cast<std::uint16_t>(y);

  const auto from = reference::float_point(t[0], 8);
  const auto to = reference::float_point(t[1], 8);
  const auto line = reference::line_by_difference(from, to);
  const reference::VertexLine<float> vertex(from, to);
  const float px = static_cast<float>(x) + 0.5F;
  const float py = static_cast<float>(y) + 0.5F;
  const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
  model->line_a_i = bits(line.a);
  model->line_b_i = bits(line.b);
  model->line_c_i = bits(line.c);
  model->vertex_x_i = bits(from.x);
  model->vertex_y_i = bits(from.y);
  model->centre_x_i = bits(px);
  model->centre_y_i = bits(py);
  model->owns_i = owns ? 1 : 0;
  clock(model, 2);
  const auto at = static_cast<std::uint64_t>(y << 14 | x);
  const float value = line.at(px, py);
  expect(model->integer_o, e >= 0 ? 1 : 0, "integer edge", static_cast<std::uint64_t>(e), at);
  expect(model->line_o, reference::on_inside(line, value) ? 1 : 0, "float32 edge", bits(value), at);
  expect(model->vertex_o, reference::on_inside(vertex, vertex.at(px, py)) ? 1 : 0, "edge from a vertex",
         bits(vertex.at(px, py)), at);
  expect(model->epsilon_o, reference::on_inside_but_for(reference::kEdgeEpsilon, line, value) ? 1 : 0,
         "edge with an epsilon", bits(value), at);
  // The same lines as planes of depth.
  expect(model->depth_o, bits(line.c + line.a * (px - from.x) + line.b * (py - from.y)), "float32 depth", at,
         at);
}

/// Sixteen steps to the right of a value that is near 0 on the way.
void check_steps(Model& model, Random& random) {
  constexpr std::int64_t kSteps = 16;
  const std::int64_t a = random.range(-(1 << 20), 1 << 20);
  std::int64_t value = -a * random.range(0, kSteps) + random.range(-3, 3);
  const float step = std::ldexp(static_cast<float>(a), -8);
  float line = std::ldexp(static_cast<float>(value), -8);
  model->step_a_i = static_cast<std::uint32_t>(a) & 0x1FFFFFF;
  model->constant_i = static_cast<std::uint64_t>(value) & ((std::uint64_t{1} << 43) - 1);
  model->line_a_i = std::bit_cast<std::uint32_t>(step);
  model->line_c_i = std::bit_cast<std::uint32_t>(line);
  model->owns_i = a > 0 ? 1 : 0;
  model->first_i = 1;
  clock(model, 1);
  model->first_i = 0;
  for (std::int64_t i = 0; i < kSteps; ++i) {
    clock(model, 1);
    const auto at = static_cast<std::uint64_t>(i);
    expect(model->integer_step_o, value >= 0 ? 1 : 0, "step of an integer edge",
           static_cast<std::uint64_t>(value), at);
    const bool inside = line > 0 || (line == 0 && a > 0);
    expect(model->line_step_o, inside ? 1 : 0, "step of a float32 edge", std::bit_cast<std::uint32_t>(line),
           at);
    value += a;
    line += step;
  }
}

void check_depth(Model& model, Random& random) {
  using study::DepthTriangle;
  const auto depth = [&] { return static_cast<float>(random.below((1 << 24) + 1)) / (1 << 24); };
  const DepthTriangle t(triangle(random), {depth(), depth(), depth()});
  const study::WordPlane plane(t, DepthFormat::kUnorm24, kPlaneBits);
  const study::Barycentric weights(t, DepthFormat::kUnorm24, kWidth);
  // A sample inside, in the middle: the low bits are right wherever depth is between the vertices.
  const std::int64_t x = (t.v[0].x + t.v[1].x + t.v[2].x) / 3 >> 8;
  const std::int64_t y = (t.v[0].y + t.v[1].y + t.v[2].y) / 3 >> 8;
  const reference::GridPoint centre = reference::pixel_centre(x, y, 8);
  const std::array<std::int64_t, 3> e{t.edge(0, centre), t.edge(1, centre), t.edge(2, centre)};
  if (e[0] < 0 || e[1] < 0 || e[2] < 0 || x < 0 || y < 0) {
    return;
  }
  const study::WordPlane::Equation& eq = plane.equation();
  const auto way = [](std::int64_t pixel, std::int64_t vertex) {
    return static_cast<std::uint32_t>((pixel / kAnchorSize * kAnchorSize << 8) + 128 - vertex) & 0x1FFFFFF;
  };
  constexpr std::uint64_t kGradient = (std::uint64_t{1} << (kPlaneBits + 1 + kGradientFraction)) - 1;
  model->z_i = static_cast<std::uint32_t>(eq.z);
  model->dx_i = static_cast<std::uint64_t>(eq.dx) & kGradient;
  model->dy_i = static_cast<std::uint64_t>(eq.dy) & kGradient;
  model->right_i = way(x, eq.from[0]);
  model->down_i = way(y, eq.from[1]);
  model->column_i = static_cast<std::uint8_t>(x % kAnchorSize);
  model->row_i = static_cast<std::uint8_t>(y % kAnchorSize);
  model->least_i = eq.range.least;
  model->most_i = eq.range.most;
  model->e1_i = static_cast<std::uint32_t>(weights.scaled(e[1]));
  model->e2_i = static_cast<std::uint32_t>(weights.scaled(e[2]));
  model->reciprocal_i = static_cast<std::uint32_t>(weights.reciprocal());
  model->z0_i = static_cast<std::uint32_t>(weights.z()[0]);
  model->rise1_i = static_cast<std::uint32_t>(weights.z()[1] - weights.z()[0]);
  model->rise2_i = static_cast<std::uint32_t>(weights.z()[2] - weights.z()[0]);
  clock(model, 4);
  expect(model->plane_o, plane.code(x, y), "depth of the plane", static_cast<std::uint64_t>(x),
         static_cast<std::uint64_t>(y));
  expect(model->weights_o, weights.code(x, y), "depth by weights", static_cast<std::uint64_t>(x),
         static_cast<std::uint64_t>(y));
}

}  // namespace
}  // namespace halfspace::tb

int main(int argc, char** argv) {
  using namespace halfspace::tb;
  CLI::App app{"The arithmetic of the precision study in SystemVerilog against C++", "study_bench"};
  std::uint64_t seed = 1;
  std::uint64_t vectors = 200'000;
  bool flip = false;
  app.add_option("--seed", seed, "of the vectors")->capture_default_str();
  app.add_option("--vectors", vectors, "of each kind")->capture_default_str();
  app.add_flag("--flip", flip, "a bit of one expected product, to see that the bench fails");
  CLI11_PARSE(app, argc, argv);
  Model model(seed);
  Random random(seed);
  try {
    for (std::uint64_t i = 0; i < vectors; ++i) {
      check_numbers(model, random);
      check_edges(model, random);
      if (i % 8 == 0) {
        check_steps(model, random);
      }
      check_depth(model, random);
    }
    if (flip) {
      model->float_a_i = std::bit_cast<std::uint32_t>(3.0F);
      model->float_b_i = std::bit_cast<std::uint32_t>(5.0F);
      model.settle();
      expect(model->float_product_o, std::bit_cast<std::uint32_t>(15.0F) ^ 1, "float32 product",
             model->float_a_i, model->float_b_i);
    }
  } catch (const std::runtime_error& error) {
    fmt::print("study_bench: seed {}: {}\n", seed, error.what());
    return 1;
  }
  fmt::print("study_bench: {} vectors of each kind, no difference\n", vectors);
  return 0;
}
