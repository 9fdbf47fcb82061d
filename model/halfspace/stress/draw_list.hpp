/// What the families of the stress campaign draw with: triangles on the sub-pixel grid of a square target.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "halfspace/numerics/split_mix.hpp"
#include "halfspace/scene/frame_builder.hpp"
#include "halfspace/stress/case.hpp"

namespace halfspace::stress {

using reference::GridPoint;
using reference::GridTriangle;

/// A case under construction. Positions are integers, in 1/2^sub_pixel_bits pixel.
class DrawList {
 public:
  /// `size`: side of the target in pixels, a power of two of at most 256, so that the guard band's corners
  /// reach clip space unrounded.
  DrawList(const Precision& precision, std::uint32_t size, std::uint64_t seed)
      : random(seed),
        precision_(precision),
        size_(size),
        sample_(
            static_cast<int>(SplitMix64(~seed).next() % static_cast<std::uint64_t>(precision.samples.count))),
        builder_(size, precision.format) {}

  [[nodiscard]] std::int64_t one() const { return std::int64_t{1} << precision_.sub_pixel_bits; }
  [[nodiscard]] std::int64_t size() const { return size_; }
  [[nodiscard]] std::int64_t extent() const { return size_ * one(); }
  [[nodiscard]] const Precision& precision() const { return precision_; }
  /// The sample of each pixel that the case is about.
  [[nodiscard]] int sample() const { return sample_; }
  /// Of a pixel. Where it has one sample, at its centre, that.
  [[nodiscard]] GridPoint sample_of(std::int64_t x, std::int64_t y) const {
    return precision_.sample_of(x, y, sample_);
  }

  std::int64_t between(std::int64_t low, std::int64_t high) { return random.integer(low, high); }
  bool one_in(std::int64_t n) { return between(1, n) == 1; }
  GridPoint point(std::int64_t low, std::int64_t high) { return {between(low, high), between(low, high)}; }
  GridPoint point_on_target() { return point(0, extent()); }
  float depth() { return static_cast<float>(between(0, 1 << 24)) / (1 << 24); }

  /// A draw that always passes and writes; later triangles belong to it. The reference is good until the
  /// next.
  Command& draw() {
    Command& command = builder_.draw({});
    command.depth_func = DepthFunc::kAlways;
    ++draws_;
    return command;
  }

  Command& clear(float value) { return builder_.clear(value); }

  void add(const GridTriangle& triangle, const std::array<float, 3>& z) {
    Command& command = builder_.frame.commands.back();
    for (std::size_t i = 0; i < 3; ++i) {
      const double scale = 2.0 / static_cast<double>(extent());
      add_vertex({static_cast<double>(triangle[i].x) * scale - 1,
                  static_cast<double>(triangle[i].y) * scale - 1, z[i], 1});
    }
    triangles_.push_back({.grid = triangle,
                          .z = z,
                          .command = static_cast<std::uint32_t>(builder_.frame.commands.size() - 1),
                          .draw = draws_ - 1,
                          .index = command.index_count / 3});
    command.index_count += 3;
  }

  void add(const GridTriangle& triangle) { add(triangle, {depth(), depth(), depth()}); }

  /// In clip space: coverage is not known by definition.
  void add_clip(const std::array<glm::vec4, 3>& triangle) {
    for (const glm::vec4& vertex : triangle) {
      add_vertex(vertex);
    }
    builder_.frame.commands.back().index_count += 3;
  }

  /// The triangle with its vertices in one of six orders.
  GridTriangle shuffled(GridTriangle triangle) {
    shuffle(triangle);
    return triangle;
  }

  template <class List>
  void shuffle(List& list) {
    for (std::size_t left = list.size(); left > 1; --left) {
      std::swap(list[left - 1],
                list[static_cast<std::size_t>(between(0, static_cast<std::int64_t>(left) - 1))]);
    }
  }

  /// The frame alone, for laws of its own.
  Frame take_frame() { return std::move(builder_.frame); }

  /// The frame with its triangles, whose coverage the definition says.
  Case take_defined() {
    return {.frame = std::move(builder_.frame), .triangles = std::move(triangles_), .sample = sample_};
  }

  SplitMix64 random;

 private:
  void add_vertex(const glm::dvec4& vertex) {
    Frame& frame = builder_.frame;
    Command& command = frame.commands.back();
    frame.indices.push_back(command.vertex_count++);
    frame.vertices.emplace_back(vertex);
  }

  Precision precision_;
  std::int64_t size_;
  int sample_;
  FrameBuilder builder_;
  std::uint32_t draws_ = 0;
  std::vector<KnownTriangle> triangles_;
};

/// x and y with a x + b y = gcd(a, b), by Euclid's algorithm; the gcd is not negative.
struct Bezout {
  std::int64_t gcd;
  std::int64_t x;
  std::int64_t y;
};
constexpr Bezout bezout(std::int64_t a, std::int64_t b) {
  std::int64_t x0 = 1;
  std::int64_t y0 = 0;
  std::int64_t x1 = 0;
  std::int64_t y1 = 1;
  while (b != 0) {
    const std::int64_t quotient = a / b;
    a = std::exchange(b, a - quotient * b);
    x0 = std::exchange(x1, x0 - quotient * x1);
    y0 = std::exchange(y1, y0 - quotient * y1);
  }
  return a < 0 ? Bezout{-a, -x0, -y0} : Bezout{a, x0, y0};
}

}  // namespace halfspace::stress
