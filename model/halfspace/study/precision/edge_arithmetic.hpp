/// The arithmetics of the edge function that the study compares. Each is a type that is made of a triangle
/// before snapping and of a target, has a box of pixels, and says of a pixel of the box whether its centre is
/// inside by the top-left rule. All turn a triangle of negative area, which they find in their own
/// arithmetic.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "halfspace/reference/float_edges.hpp"
#include "halfspace/reference/float_epsilon.hpp"
#include "halfspace/study/precision/float_triangle.hpp"
#include "halfspace/units/setup.hpp"

namespace halfspace::study {

/// Calls visit(x, y) for the covered pixels. An arithmetic that goes by increments is told each step.
template <class Arithmetic, class Visit>
void cover(Arithmetic edges, const Visit& visit) {
  const PixelRect box = edges.box();
  for (std::int64_t y = box.first_y; y < box.end_y; ++y) {
    for (std::int64_t x = box.first_x; x < box.end_x; ++x) {
      if (edges.inside(x, y)) {
        visit(x, y);
      }
      if constexpr (requires { edges.step_right(); }) {
        edges.step_right();
      }
    }
    if constexpr (requires { edges.next_row(); }) {
      edges.next_row();
    }
  }
}

/// Lines of the number T by `make`; ties as `on_side(line, e)` has them.
template <class T, class Line, auto make, auto on_side>
class FloatArithmetic {
 public:
  FloatArithmetic(const FloatTriangle& t, const PixelRect& target) {
    std::array<reference::FloatPoint<T>, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = {t[i].x, t[i].y};
    }
    const T area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
    if (area == 0) {
      return;  // the box stays empty
    }
    if (area < 0) {
      std::swap(p[1], p[2]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      line_[i] = make(p[i], p[(i + 1) % 3]);
    }
    box_ = touched(t, target);
  }

  [[nodiscard]] const PixelRect& box() const { return box_; }
  [[nodiscard]] bool inside(std::int64_t x, std::int64_t y) const {
    const T px = static_cast<T>(x) + T{0.5};
    const T py = static_cast<T>(y) + T{0.5};
    return on_side(line_[0], line_[0].at(px, py)) && on_side(line_[1], line_[1].at(px, py)) &&
           on_side(line_[2], line_[2].at(px, py));
  }

 protected:
  [[nodiscard]] const std::array<Line, 3>& lines() const { return line_; }

 private:
  std::array<Line, 3> line_{};
  PixelRect box_{};
};

template <class Line, class T>
bool exact_ties(const Line& line, T e) {
  return reference::on_inside(line, e);
}

template <class Line, class T>
bool ties_within_epsilon(const Line& line, T e) {
  return reference::on_inside_but_for(T{reference::kEdgeEpsilon}, line, e);
}

template <class T>
reference::VertexLine<T> vertex_line(const reference::FloatPoint<T>& from,
                                     const reference::FloatPoint<T>& to) {
  return {from, to};
}

template <class T, auto make>
using ByLine = FloatArithmetic<T, reference::FloatLine<T>, make, exact_ties<reference::FloatLine<T>, T>>;

using FloatDifference = ByLine<float, reference::line_by_difference<float>>;
using FloatAverage = ByLine<float, reference::line_by_average<float>>;
using DoubleDifference = ByLine<double, reference::line_by_difference<double>>;
using FloatVertex = FloatArithmetic<float, reference::VertexLine<float>, vertex_line<float>,
                                    exact_ties<reference::VertexLine<float>, float>>;
using FloatEpsilon = FloatArithmetic<float, reference::FloatLine<float>, reference::line_from_vertex<float>,
                                     ties_within_epsilon<reference::FloatLine<float>, float>>;

/// The lines of FloatDifference at the first pixel, and then A for a pixel to the right, B for a row down.
class FloatIncrements : public FloatDifference {
 public:
  FloatIncrements(const FloatTriangle& t, const PixelRect& target) : FloatDifference(t, target) {
    for (std::size_t i = 0; i < 3; ++i) {
      row_[i] =
          lines()[i].at(static_cast<float>(box().first_x) + 0.5F, static_cast<float>(box().first_y) + 0.5F);
    }
    value_ = row_;
  }

  [[nodiscard]] bool inside(std::int64_t, std::int64_t) const {
    return reference::on_inside(lines()[0], value_[0]) && reference::on_inside(lines()[1], value_[1]) &&
           reference::on_inside(lines()[2], value_[2]);
  }
  void step_right() {
    for (std::size_t i = 0; i < 3; ++i) {
      value_[i] += lines()[i].a;
    }
  }
  void next_row() {
    for (std::size_t i = 0; i < 3; ++i) {
      row_[i] += lines()[i].b;
    }
    value_ = row_;
  }

 private:
  std::array<float, 3> row_{};
  std::array<float, 3> value_{};
};

/// Ours: the triangle on the grid of 1/2^Bits pixel, its edges as the unit `setup` makes them.
template <int Bits>
class Fixed {
 public:
  static constexpr int kBits = Bits;

  Fixed(const FloatTriangle& t, const PixelRect& target) {
    ScreenTriangle screen;
    for (std::size_t i = 0; i < 3; ++i) {
      const reference::GridPoint p = snapped(t[i], Bits);
      screen.v[i] = {.x = static_cast<std::int32_t>(p.x), .y = static_cast<std::int32_t>(p.y)};
    }
    const SetupState state{.sub_pixel_bits = Bits,
                           .bounds = {.x_first = static_cast<std::int32_t>(target.first_x),
                                      .y_first = static_cast<std::int32_t>(target.first_y),
                                      .x_last = static_cast<std::int32_t>(target.end_x) - 1,
                                      .y_last = static_cast<std::int32_t>(target.end_y) - 1}};
    SetupTriangle made;
    if (setup(screen, state, made) == SetupVerdict::kDrawn) {
      edge_ = made.edge;
      box_ = {made.bounds.x_first, made.bounds.y_first, std::int64_t{made.bounds.x_last} + 1,
              std::int64_t{made.bounds.y_last} + 1};
    }
  }

  [[nodiscard]] const PixelRect& box() const { return box_; }
  [[nodiscard]] bool inside(std::int64_t x, std::int64_t y) const {
    const auto e = [&](const Edge& edge) { return edge.c + ((edge.a * x + edge.b * y) << Bits); };
    return (e(edge_[0]) | e(edge_[1]) | e(edge_[2])) >= 0;  // no sign bit
  }

 private:
  std::array<Edge, 3> edge_{};
  PixelRect box_{};
};

/// The edge function in integers of 128 bits on a grid so fine that it holds every float32 position of half a
/// pixel or more as it is: nothing is snapped.
class ExactInteger {
 public:
  static constexpr int kBits = 24;

  ExactInteger(const FloatTriangle& t, const PixelRect& target) {
    reference::GridTriangle p = snapped(t, kBits);
    const reference::Int128 area = reference::twice_area(p[0], p[1], p[2]);
    if (area == 0) {
      return;
    }
    if (area < 0) {
      std::swap(p[1], p[2]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const reference::GridPoint& from = p[i];
      const reference::GridPoint& to = p[(i + 1) % 3];
      const std::int64_t a = from.y - to.y;
      const std::int64_t b = to.x - from.x;
      const bool owns = reference::owns_samples(a, b, reference::TieRule::kTopLeft);
      line_[i] = {a, b, -(reference::Int128{a} * from.x + reference::Int128{b} * from.y) - (owns ? 0 : 1)};
    }
    box_ = touched(t, target);
  }

  [[nodiscard]] const PixelRect& box() const { return box_; }
  [[nodiscard]] bool inside(std::int64_t x, std::int64_t y) const {
    const reference::GridPoint p = reference::pixel_centre(x, y, kBits);
    const auto e = [&](const Line& line) {
      return reference::Int128{line.a} * p.x + reference::Int128{line.b} * p.y + line.c;
    };
    return (e(line_[0]) | e(line_[1]) | e(line_[2])) >= 0;
  }

 private:
  struct Line {
    std::int64_t a;
    std::int64_t b;
    reference::Int128 c;
  };
  std::array<Line, 3> line_{};
  PixelRect box_{};
};

/// Vortex: float32 coefficients of all three edges, divided by the largest A or B of the triangle, cut to
/// 16.16 fixed point; a sample is inside where none is negative. So two triangles scale the edge that they
/// share by different numbers, and no rule decides ties.
///
/// vortexgpgpu/vortex at 09317e25ef3fe4f706a51fe745d780176a5e188f: sw/runtime/graphics.cpp (EdgeEquation,
/// EdgeToFixed, Binning), sw/common/vx_gfx_abi.h (fixed_t); and hw/rtl/raster/VX_raster_qe.sv at
/// 1085f7ec7265ea06fbee648dd359cd37f01fc72f. Here w is 1: vertices are in the window.
class Normalised {
 public:
  Normalised(const FloatTriangle& t, const PixelRect& target) {
    std::array<reference::FloatLine<float>, 3> line;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& from = t[(i + 1) % 3];
      const auto& to = t[(i + 2) % 3];
      line[i] = {from.y - to.y, to.x - from.x, from.x * to.y - to.x * from.y};
    }
    const float area = line[0].c + line[1].c + line[2].c;
    if (area == 0) {
      return;
    }
    float largest = 0;
    for (const auto& l : line) {
      largest = std::max({largest, std::abs(l.a), std::abs(l.b)});
    }
    const float scale = (largest != 0 ? 1.0F / largest : 1.0F) * (area < 0 ? -1.0F : 1.0F);
    for (std::size_t i = 0; i < 3; ++i) {
      const float c = line[i].c + (line[i].a * 0.5F + line[i].b * 0.5F);
      edge_[i] = {cut(line[i].a * scale), cut(line[i].b * scale), cut(c * scale)};
    }
    box_ = touched(t, target);
  }

  [[nodiscard]] const PixelRect& box() const { return box_; }
  [[nodiscard]] bool inside(std::int64_t x, std::int64_t y) const {
    const auto e = [&](const FixedLine& line) {
      return static_cast<std::int32_t>(line.a * static_cast<std::uint32_t>(x) +
                                       line.b * static_cast<std::uint32_t>(y) + line.c);
    };
    return (e(edge_[0]) | e(edge_[1]) | e(edge_[2])) >= 0;
  }

 private:
  /// Modulo 2^32, as the registers are.
  struct FixedLine {
    std::uint32_t a;
    std::uint32_t b;
    std::uint32_t c;
  };
  static std::uint32_t cut(float value) {
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(value * 65536.0F));
  }

  std::array<FixedLine, 3> edge_{};
  PixelRect box_{};
};

}  // namespace halfspace::study
