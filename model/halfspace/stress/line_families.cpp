#include "halfspace/stress/line_families.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "halfspace/numerics/line_rule.hpp"
#include "halfspace/numerics/split_mix.hpp"
#include "halfspace/reference/exact_line.hpp"
#include "halfspace/scene/frame_builder.hpp"

namespace halfspace::stress {
namespace {

using reference::GridPoint;
using reference::PixelPlace;

constexpr std::array kThinRules{LineRule::kBresenham, LineRule::kDiamondExit, LineRule::kMidpoint,
                                LineRule::kDda};

/// Ends in sub-pixels; the definitions of both diamond rules hold for as much as this in magnitude.
constexpr std::int64_t kMostForDiamonds = std::int64_t{1} << 18;

/// A case of lines under construction, and how often each pixel of its target must be covered.
class LineList {
 public:
  LineList(const Precision& precision, std::uint32_t size, std::uint64_t seed)
      : random(seed),
        bits_(precision.sub_pixel_bits),
        size_(size),
        builder_(size, precision.format),
        fragments_(std::size_t{size} * size, 0) {}

  [[nodiscard]] std::int64_t one() const { return std::int64_t{1} << bits_; }
  [[nodiscard]] std::int64_t extent() const { return size_ * one(); }

  std::int64_t between(std::int64_t low, std::int64_t high) { return random.integer(low, high); }
  bool one_in(std::int64_t n) { return between(1, n) == 1; }
  GridPoint point(std::int64_t low, std::int64_t high) { return {between(low, high), between(low, high)}; }
  /// Anywhere on the target and a little beside it, on a grid of `step` sub-pixels.
  GridPoint on_grid(std::int64_t step) {
    const GridPoint p = point(-2 * one() / step, (extent() + 2 * one()) / step);
    return {p.x * step, p.y * step};
  }

  /// A draw that always passes; later lines belong to it.
  void draw(LineRule rule, int width = 1, Primitive primitive = Primitive::kLines) {
    Command& command = builder_.draw({});
    command.depth_func = DepthFunc::kAlways;
    command.primitive = primitive;
    command.line_rule = rule;
    command.line_width = static_cast<float>(width);
  }

  /// `goes_on`: from the end of the line before, as the vertex of a strip.
  void add(const GridPoint& a, const GridPoint& b, bool goes_on = false) {
    Frame& frame = builder_.frame;
    Command& command = frame.commands.back();
    frame.indices.push_back(goes_on ? command.vertex_count - 1 : add_vertex(a));
    frame.indices.push_back(add_vertex(b));
    command.index_count += 2;
    cover(command.line_rule, static_cast<int>(command.line_width), a, b);
  }

  Case take() { return {.frame = std::move(builder_.frame), .fragments = std::move(fragments_)}; }

  SplitMix64 random;

 private:
  std::uint32_t add_vertex(const GridPoint& p) {
    const double scale = 2.0 / static_cast<double>(extent());
    builder_.frame.vertices.emplace_back(static_cast<double>(p.x) * scale - 1,
                                         static_cast<double>(p.y) * scale - 1, 0.5, 1);
    return builder_.frame.commands.back().vertex_count++;
  }

  void add_fragment(const PixelPlace& p) {
    if (p.x >= 0 && p.y >= 0 && p.x < size_ && p.y < size_) {
      ++fragments_[static_cast<std::size_t>(p.y * size_ + p.x)];
    }
  }

  /// So many pixels from each along the minor axis, the first (width - 1) / 2 before it.
  void cover(LineRule rule, int width, const GridPoint& a, const GridPoint& b) {
    if (rule == LineRule::kMidpoint || rule == LineRule::kDda) {
      const PixelPlace from{a.x >> bits_, a.y >> bits_};
      const PixelPlace to{b.x >> bits_, b.y >> bits_};
      const bool x_major = std::abs(to.y - from.y) <= std::abs(to.x - from.x);
      for (const PixelPlace& p : rule == LineRule::kMidpoint ? reference::midpoint_line(from, to)
                                                             : reference::dda_line(from, to, kDdaFraction)) {
        widen(p, -(width - 1) / 2, width, x_major);
      }
      return;
    }
    const bool x_major = std::abs(b.y - a.y) <= std::abs(b.x - a.x);
    const std::int64_t aside = (width - 1) * one() / 2;
    const reference::GridLine line{a.x - (x_major ? 0 : aside), a.y - (x_major ? aside : 0),
                                   b.x - (x_major ? 0 : aside), b.y - (x_major ? aside : 0)};
    const auto leaves = [&](const PixelPlace& p) {
      return rule == LineRule::kBresenham ? reference::leaves_vulkan_diamond(line, p, bits_)
                                          : reference::leaves_direct3d_diamond(line, p, bits_);
    };
    // Every pixel about the line, wherever in its column; those that the target cannot see may be wide.
    const std::int64_t seen_from = -width - 1;
    const auto of = [&](std::int64_t major, std::int64_t minor) {
      return x_major ? PixelPlace{major, minor} : PixelPlace{minor, major};
    };
    const auto [low, high] = std::minmax({x_major ? line.ax : line.ay, x_major ? line.bx : line.by});
    for (std::int64_t column = std::max((low >> bits_) - 1, std::int64_t{-1});
         column <= std::min((high >> bits_) + 1, size_); ++column) {
      const std::int64_t row = row_at(line, x_major, column);
      for (std::int64_t v = std::max(row - 3, seen_from); v <= std::min(row + 3, size_); ++v) {
        if (leaves(of(column, v))) {
          widen(of(column, v), 0, width, x_major);
        }
      }
    }
  }

  /// The row in which the line, or where it ends the end, is in the middle of the column: near enough.
  [[nodiscard]] std::int64_t row_at(const reference::GridLine& line, bool x_major,
                                    std::int64_t column) const {
    const auto ua = static_cast<double>(x_major ? line.ax : line.ay);
    const auto va = static_cast<double>(x_major ? line.ay : line.ax);
    const auto ub = static_cast<double>(x_major ? line.bx : line.by);
    const auto vb = static_cast<double>(x_major ? line.by : line.bx);
    const double u = (static_cast<double>(column) + 0.5) * static_cast<double>(one());
    const double way = ua == ub ? 0 : std::clamp((u - ua) / (ub - ua), 0.0, 1.0);
    return static_cast<std::int64_t>(std::floor((va + way * (vb - va)) / static_cast<double>(one())));
  }

  void widen(const PixelPlace& p, int first, int width, bool x_major) {
    for (int k = first; k < first + width; ++k) {
      add_fragment(x_major ? PixelPlace{p.x, p.y + k} : PixelPlace{p.x + k, p.y});
    }
  }

  int bits_;
  std::int64_t size_;
  FrameBuilder builder_;
  std::vector<std::int32_t> fragments_;
};

/// `count` lines in a draw of each rule, each made by `line`.
template <class Line>
Case by_every_rule(const Precision& precision, std::uint32_t size, std::uint64_t seed, int count,
                   const Line& line) {
  LineList list(precision, size, seed);
  for (const LineRule rule : kThinRules) {
    list.draw(rule);
    for (int n = 0; n < count; ++n) {
      const auto [a, b] = line(list);
      list.add(a, b);
    }
  }
  return list.take();
}

using Ends = std::pair<GridPoint, GridPoint>;

Case line_diamonds(const Precision& precision, std::uint64_t seed) {
  return by_every_rule(precision, 16, seed, 30, [](LineList& list) {
    const std::int64_t step = list.one() / (list.one_in(2) ? 2 : 4);
    const GridPoint a = list.on_grid(step);
    const GridPoint b = list.one_in(2)
                            ? list.on_grid(step)
                            : GridPoint{a.x + list.between(-6, 6) * step, a.y + list.between(-6, 6) * step};
    const auto beside = [&](const GridPoint& p) {
      return list.one_in(3) ? GridPoint{p.x + list.between(-1, 1), p.y + list.between(-1, 1)} : p;
    };
    return Ends{beside(a), beside(b)};
  });
}

Case line_centres(const Precision& precision, std::uint64_t seed) {
  return by_every_rule(precision, 32, seed, 30, [](LineList& list) {
    const std::int64_t half = list.one() / 2;
    const auto centre = [&] {
      const GridPoint p = list.on_grid(list.one());
      return GridPoint{p.x + half, p.y + half};
    };
    return Ends{centre(), centre()};
  });
}

Case line_octants(const Precision& precision, std::uint64_t seed) {
  return by_every_rule(precision, 32, seed, 30, [](LineList& list) {
    const GridPoint a = list.on_grid(list.one_in(2) ? 1 : list.one() / 4);
    const std::int64_t length = list.between(-list.extent(), list.extent());
    const std::int64_t aside = list.between(-1, 1);
    const std::array<GridPoint, 4> ways{GridPoint{length, length + aside}, GridPoint{length + aside, -length},
                                        GridPoint{length, aside}, GridPoint{aside, length}};
    const GridPoint& way = ways[static_cast<std::size_t>(list.between(0, 3))];
    return Ends{a, GridPoint{a.x + way.x, a.y + way.y}};
  });
}

Case line_tiny(const Precision& precision, std::uint64_t seed) {
  return by_every_rule(precision, 16, seed, 80, [](LineList& list) {
    const GridPoint a = list.on_grid(list.one_in(2) ? 1 : list.one() / 4);
    const std::int64_t reach = list.between(1, list.one());
    return Ends{a, GridPoint{a.x + list.between(-reach, reach), a.y + list.between(-reach, reach)}};
  });
}

Case line_strips(const Precision& precision, std::uint64_t seed) {
  LineList list(precision, 32, seed);
  for (const LineRule rule : kThinRules) {
    list.draw(rule, 1, Primitive::kLineStrip);
    GridPoint a = list.on_grid(1);
    const GridPoint way = list.point(-list.one(), list.one());
    const bool is_straight = list.one_in(3);
    for (int n = 0; n < 24; ++n) {
      const std::int64_t step = list.one_in(2) ? 1 : list.one() / 2;
      const std::int64_t times = list.between(0, 4);
      const GridPoint b =
          is_straight ? GridPoint{a.x + way.x * times, a.y + way.y * times} : list.on_grid(step);
      list.add(a, b, n > 0);
      a = b;
    }
  }
  return list.take();
}

Case line_far(const Precision& precision, std::uint64_t seed) {
  LineList list(precision, 32, seed);
  for (const LineRule rule : kThinRules) {
    list.draw(rule);
    const std::int64_t most = 32700 * list.one();
    const std::int64_t far = rule == LineRule::kBresenham ? std::min(most, kMostForDiamonds) : most;
    for (int n = 0; n < 8; ++n) {
      // through the target, both ends far off, or one
      const GridPoint through = list.point(0, list.extent());
      const std::int64_t reach = far - list.extent();
      const GridPoint way = list.point(-reach, reach);
      const GridPoint a{through.x - way.x, through.y - way.y};
      const GridPoint b =
          list.one_in(3) ? list.point(0, list.extent()) : GridPoint{through.x + way.x, through.y + way.y};
      list.add(a, b);
    }
  }
  return list.take();
}

Case line_wide(const Precision& precision, std::uint64_t seed) {
  LineList list(precision, 32, seed);
  for (const LineRule rule : kThinRules) {
    const bool is_odd = rule == LineRule::kMidpoint || rule == LineRule::kDda;
    for (int draws = 0; draws < 3; ++draws) {
      const auto width =
          static_cast<int>(list.one_in(4) ? list.between(1, kMaxLineWidth) : list.between(1, 6));
      list.draw(rule, is_odd ? (width - 1) / 2 * 2 + 1 : width);
      for (int n = 0; n < 6; ++n) {
        const std::int64_t step = list.one_in(2) ? 1 : list.one() / 2;
        list.add(list.on_grid(step), list.on_grid(step));
      }
    }
  }
  return list.take();
}

constexpr std::string_view kLaw = "each pixel as often as the definitions of the rules have it";

// clang-format off
constexpr std::array kLineFamilies{
    Family{"line_diamonds", "ends on corners, sides and centres of diamonds, or a sub-pixel beside", kLaw, line_diamonds},
    Family{"line_centres", "from pixel centre to pixel centre: half-way between two pixels", kLaw, line_centres},
    Family{"line_octants", "along an axis or a diagonal, or a sub-pixel off", kLaw, line_octants},
    Family{"line_tiny", "shorter than a pixel, or without length", kLaw, line_tiny},
    Family{"line_strips", "strips, some of them straight, their joins anywhere", kLaw, line_strips},
    Family{"line_far", "through the target, with ends up to the guard band", kLaw, line_far},
    Family{"line_wide", "1 to 64 pixels wide", kLaw, line_wide},
};
// clang-format on

}  // namespace

std::span<const Family> line_families() { return kLineFamilies; }

}  // namespace halfspace::stress
