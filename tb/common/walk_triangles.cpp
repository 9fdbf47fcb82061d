#include "walk_triangles.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "halfspace/config/config.hpp"
#include "halfspace/machine/draw_state.hpp"
#include "halfspace/scene/front_end.hpp"
#include "halfspace/scene/load.hpp"
#include "halfspace/units/setup.hpp"

namespace halfspace::tb {
namespace {

constexpr std::int64_t kScreen = 16384;  // pixels on a side, at most
constexpr std::int64_t kFullScreen = 2048;
constexpr std::uint64_t kLargeEvery = 1000;  // random triangles for one of the full screen

struct Point {
  std::int64_t x = 0;  ///< in sub-pixels
  std::int64_t y = 0;
};
using Points = std::array<Point, 3>;

PixelRect screen() { return {0, 0, kScreen - 1, kScreen - 1}; }

std::optional<SetupTriangle> set_up(const Points& v, const PixelRect& bounds, FillRule rule,
                                    const WalkSizes& sizes) {
  const std::int64_t limit = std::int64_t{1} << (sizes.widths().CoordBits - 1);
  ScreenTriangle triangle;
  for (std::size_t i = 0; i < 3; ++i) {
    triangle.v[i] = {.x = static_cast<std::int32_t>(std::clamp(v[i].x, -limit, limit - 1)),
                     .y = static_cast<std::int32_t>(std::clamp(v[i].y, -limit, limit - 1))};
  }
  const SetupState state{.sub_pixel_bits = sizes.sub_pixel_bits,
                         .fill_rule = rule,
                         .bounds = bounds,
                         .samples = sizes.pattern().box()};
  SetupTriangle out;
  return setup(triangle, state, out) == SetupVerdict::kDrawn ? std::optional(out) : std::nullopt;
}

/// Collects what setup draws.
class Triangles {
 public:
  explicit Triangles(const WalkSizes& sizes) : sizes_(sizes), one_(std::int64_t{1} << sizes.sub_pixel_bits) {}

  /// Corners in pixels, from the top left corner of pixel (0, 0), and sub-pixels on top.
  void add(Points v, Point offset = {}, const PixelRect& bounds = screen(),
           FillRule rule = FillRule::kTopLeft) {
    for (Point& p : v) {
      p = {p.x * one_ + offset.x, p.y * one_ + offset.y};
    }
    if (const auto triangle = set_up(v, bounds, rule, sizes_)) {
      triangles_.push_back(*triangle);
    }
  }
  void add_square(std::int64_t x, std::int64_t y, std::int64_t size, const PixelRect& bounds = screen()) {
    const std::int64_t right = x + size;
    const std::int64_t bottom = y + size;
    add({{{x, y}, {right, y}, {x, bottom}}}, {}, bounds);
    add({{{right, y}, {right, bottom}, {x, bottom}}}, {}, bounds);
  }
  [[nodiscard]] std::int64_t one() const { return one_; }
  std::vector<SetupTriangle> take() { return std::exchange(triangles_, {}); }

 private:
  const WalkSizes& sizes_;
  std::int64_t one_;
  std::vector<SetupTriangle> triangles_;
};

/// All turns and mirror images of a triangle around (x, y), with vertices on pixel centres or corners: edges
/// that run through samples, along rows and columns, and of every sign.
void add_turns(Triangles& out, std::int64_t x, std::int64_t y, std::int64_t size) {
  static constexpr std::array<std::array<std::int64_t, 4>, 8> kTurns = {{{1, 0, 0, 1},
                                                                         {-1, 0, 0, 1},
                                                                         {1, 0, 0, -1},
                                                                         {-1, 0, 0, -1},
                                                                         {0, 1, 1, 0},
                                                                         {0, -1, 1, 0},
                                                                         {0, 1, -1, 0},
                                                                         {0, -1, -1, 0}}};
  const std::array<Points, 3> shapes = {Points{{{0, 0}, {size, 0}, {0, size}}},
                                        Points{{{0, 0}, {2 * size, size}, {size, 2 * size}}},
                                        Points{{{0, 0}, {2 * size, 0}, {size, 2 * size}}}};
  for (const Points& shape : shapes) {
    for (const auto& turn : kTurns) {
      Points v;
      for (std::size_t i = 0; i < 3; ++i) {
        v[i] = {x + turn[0] * shape[i].x + turn[1] * shape[i].y,
                y + turn[2] * shape[i].x + turn[3] * shape[i].y};
      }
      for (const FillRule rule : kFillRules) {
        out.add(v, {}, screen(), rule);
        out.add(v, {out.one() / 2, out.one() / 2}, screen(), rule);
      }
    }
  }
}

/// A triangle with a bounding box of samples none of which it covers.
void add_uncovered(Triangles& out, std::int64_t x, std::int64_t y, std::int64_t size) {
  out.add({{{x, y}, {x + size, y + size}, {x + size, y + size}}}, {});
  out.add({{{x, y}, {x + 2 * size, y + 2 * size - 1}, {x + 2 * size, y + 2 * size - 1}}});
  out.add({{{x, y + 1}, {x + size, y}, {x, y + 1}}});
  out.add({{{x, y}, {x + 1, y + size}, {x + 1, y + size - 1}}}, {out.one() / 2 + 1, out.one() / 2 + 1});
}

/// Edges from one end of the guard band to the other, in every direction, through windows on them: the
/// largest steps there are, where E is near 0.
void add_longest_edges(Triangles& out) {
  struct Line {
    Point from;
    Point to;
    std::int64_t y;  ///< of the window, where the line is on the screen
  };
  constexpr std::int64_t kFar = 2 * kScreen;
  constexpr std::int64_t kSkew = kScreen / 4;
  for (const auto& [from, to, y] : {Line{{kFar, -kFar}, {kSkew - kFar, kFar}, 512},
                                    Line{{-kFar, -kFar}, {kFar - kSkew, kFar}, kScreen / 2}}) {
    const std::int64_t x = from.x + (to.x - from.x) * (y + kFar) / (2 * kFar);
    const PixelRect window{static_cast<std::int32_t>(x - 50), static_cast<std::int32_t>(y - 50),
                           static_cast<std::int32_t>(x + 49), static_cast<std::int32_t>(y + 49)};
    const PixelRect turned{window.y_first, window.x_first, window.y_last, window.x_last};
    for (const Point& third :
         {Point{kFar, kFar}, Point{-kFar, -kFar}, Point{kFar, -kFar}, Point{-kFar, kFar}}) {
      out.add({{from, to, third}}, {}, window);
      out.add({{{from.y, from.x}, {to.y, to.x}, {third.y, third.x}}}, {}, turned);
    }
  }
}

/// Sliver, turned so that its long side has a slope of its own: much of its bounds is far from it.
Points sliver(Point from, std::int64_t length, std::int64_t one, Random& random) {
  const Point to{from.x + random.range(-length, length) * one, from.y + random.range(-length, length) * one};
  return {{from, to, {(from.x + to.x) / 2 + random.range(-2, 2), (from.y + to.y) / 2 + random.range(-2, 2)}}};
}

/// Of a sample in its pixel, in sub-pixels.
Point sample_in_pixel(const WalkSizes& sizes, Random& random) {
  const SamplePattern samples = sizes.pattern();
  const std::uint64_t which =
      samples.count == 1 ? 0 : random.below(static_cast<std::uint64_t>(samples.count));
  const SamplePosition& at = samples.at[which];
  return {sample_way(at.x, sizes.sub_pixel_bits), sample_way(at.y, sizes.sub_pixel_bits)};
}

/// Vertices of one of the kinds that matter.
Points random_points(const WalkSizes& sizes, Random& random) {
  const std::int64_t one = std::int64_t{1} << sizes.sub_pixel_bits;
  const std::int64_t tile = sizes.tile_size * one;
  const std::int64_t block = sizes.block_size * one;
  const auto around = [&](Point centre, std::int64_t reach) {
    return Point{centre.x + random.range(-reach, reach), centre.y + random.range(-reach, reach)};
  };
  const auto all_around = [&](Point centre, std::int64_t reach) {
    return Points{{around(centre, reach), around(centre, reach), around(centre, reach)}};
  };
  const auto coordinate = [&] {
    switch (random.below(4)) {
      case 0:  // edges of the screen
        return (random.below(2) == 0 ? 0 : kScreen) * one + random.range(-tile, tile);
      default:
        return random.range(0, kScreen * one);
    }
  };
  const Point centre{coordinate(), coordinate()};
  switch (random.below(11)) {
    case 0:
      return all_around(centre, one);
    case 9:  // few samples of the tiles around a corner
      return all_around({(centre.x + tile / 2) / tile * tile, (centre.y + tile / 2) / tile * tile}, 2 * one);
    case 1:
      return all_around(centre, tile / 2);
    case 2:
      return all_around(centre, 2 * tile);
    case 3:
      return all_around(centre, block);
    case 4:
      return all_around(centre, 3 * block);
    case 5:
      return sliver(centre, 4 * sizes.tile_size, one, random);
    case 6: {  // vertices on samples at the edges of tiles: edges along the samples of their borders
      const Point sample = sample_in_pixel(sizes, random);
      Points v;
      const std::int64_t x = centre.x / block * block;
      const std::int64_t y = centre.y / block * block;
      for (Point& p : v) {
        p = {x + random.range(-4, 4) * tile + random.range(-1, 1) * one + sample.x,
             y + random.range(-4, 4) * tile + random.range(-1, 1) * one + sample.y};
      }
      return v;
    }
    case 7: {  // a right angle there
      const Point sample = sample_in_pixel(sizes, random);
      const std::int64_t x = centre.x / tile * tile + random.range(-1, 0) * one + sample.x;
      const std::int64_t y = centre.y / tile * tile + random.range(-1, 0) * one + sample.y;
      return {{{x, y},
               {x + random.range(-4, 4) * tile + random.range(0, 2) * one, y},
               {x, y + random.range(-4, 4) * tile + random.range(0, 2) * one}}};
    }
    case 8:
      return all_around(centre, 40 * block);
    default: {  // corners of the guard band, or near them
      const std::int64_t limit = kScreen * 2 * one;
      const std::int64_t reach = random.below(2) == 0 ? one : limit / 2;
      Points v;
      for (Point& p : v) {
        p = {(random.below(2) == 0 ? -limit : limit) + random.range(-reach, reach),
             (random.below(2) == 0 ? -limit : limit) + random.range(-reach, reach)};
      }
      return v;
    }
  }
}

/// Of the bounds of a random triangle, unless it is as large as the screen: some blocks and a bit.
std::int64_t most_tiles(const WalkSizes& sizes) {
  const std::int64_t side = sizes.block_size / sizes.tile_size;
  return std::max<std::int64_t>(6 * side * side, 400);
}

/// A window on the triangle: a part of its bounds, long or as wide as two blocks. In half of them it begins
/// near a point of an edge: of a large triangle few windows have one.
PixelRect random_window(const Points& v, const PixelRect& bounds, const WalkSizes& sizes, Random& random) {
  const std::int64_t width = std::max(10, 2 * sizes.block_size / sizes.tile_size + 2);
  const std::int64_t length = std::max(width, most_tiles(sizes) / width);
  const bool tall = random.below(2) == 0;
  const bool at_edge = random.below(2) == 0;
  const std::size_t from = random.below(3);
  const std::int64_t weight = random.range(0, 1024);
  const auto on_edge = [&](std::int64_t Point::*axis) {
    const std::int64_t point = v[from].*axis + (v[(from + 1) % 3].*axis - v[from].*axis) * weight / 1024;
    return (point >> sizes.sub_pixel_bits) - random.range(0, sizes.block_size);
  };
  const auto cut = [&](std::int64_t Point::*axis, std::int32_t first, std::int32_t last, std::int64_t tiles,
                       std::int32_t& low, std::int32_t& high) {
    low = static_cast<std::int32_t>(at_edge ? std::clamp<std::int64_t>(on_edge(axis), first, last)
                                            : random.range(first, last));
    high =
        static_cast<std::int32_t>(std::min(low + random.range(0, tiles * sizes.tile_size - 1), kScreen - 1));
  };
  PixelRect window;
  cut(&Point::x, bounds.x_first, bounds.x_last, tall ? width : length, window.x_first, window.x_last);
  cut(&Point::y, bounds.y_first, bounds.y_last, tall ? length : width, window.y_first, window.y_last);
  return window;
}

std::int64_t tiles_of(const PixelRect& bounds, int tile_size) {
  return std::int64_t{bounds.x_last / tile_size - bounds.x_first / tile_size + 1} *
         (bounds.y_last / tile_size - bounds.y_first / tile_size + 1);
}

/// Setup starts with the topmost vertex, which leaves an edge few directions; the walk takes any.
void turn_edges(SetupTriangle& triangle, std::uint64_t places) {
  const auto first = triangle.edge.begin() + static_cast<std::ptrdiff_t>(places % 3);
  std::rotate(triangle.edge.begin(), first, triangle.edge.end());
}

/// A triangle as large as a large screen, somewhere on it.
std::optional<SetupTriangle> full_screen(const WalkSizes& sizes, Random& random) {
  const std::int64_t one = std::int64_t{1} << sizes.sub_pixel_bits;
  Points v;
  for (Point& p : v) {
    p = {random.range(-kFullScreen, 2 * kFullScreen) * one,
         random.range(-kFullScreen, 2 * kFullScreen) * one};
  }
  return set_up(v, {0, 0, kFullScreen - 1, kFullScreen - 1}, FillRule::kTopLeft, sizes);
}

}  // namespace

std::vector<SetupTriangle> directed_triangles(const WalkSizes& sizes) {
  Triangles out(sizes);
  const std::int64_t tile = sizes.tile_size;
  const std::int64_t block = sizes.block_size;
  const auto last = static_cast<std::int32_t>(kScreen - 1);
  // One pixel at every place of a block's first row, first column and diagonal.
  for (std::int64_t i = 0; i <= block; ++i) {
    out.add_square(block + i, 2 * block, 1);
    out.add_square(block, 2 * block + i, 1);
    out.add_square(block + i, 2 * block + i, 1);
  }
  // Bounds of every size around a block border, and aligned to it.
  for (std::int64_t size = 1; size <= block + tile; size += size < 4 ? 1 : tile / 2) {
    out.add_square(2 * block - 1, 2 * block - 1, size);
    out.add_square(2 * block, 2 * block, size);
    out.add_square(2 * block + tile, 2 * block - tile, size);
  }
  // Blocks inside all edges, outside one, and cut.
  out.add_square(block - tile, block + tile, 3 * block);
  // Edges of every sign, on samples and between them.
  for (const std::int64_t size : {std::int64_t{1}, tile - 1, 2 * tile + 1}) {
    add_turns(out, 4 * block, 4 * block, size);
    add_turns(out, 4 * block - 1, 4 * block - 1, size);
  }
  add_turns(out, 4 * block, 4 * block, block);
  for (const std::int64_t size : {std::int64_t{3}, tile, 2 * block}) {
    add_uncovered(out, 4 * block - 2, 4 * block - 2, size);
  }
  // The edges of the largest screen.
  for (const std::int64_t x : {std::int64_t{0}, kScreen - 3 * tile}) {
    for (const std::int64_t y : {std::int64_t{0}, kScreen - 3 * tile}) {
      out.add_square(x, y, 3 * tile);
    }
  }
  // The guard band, through windows at the corners and in the middle of the screen.
  const std::int64_t far = 2 * kScreen;
  for (const std::int32_t at : {0, 8191, last - 99}) {
    const PixelRect window{at, last - 99 - at / 2, at + 99, last - at / 2};
    out.add({{{-far, -far}, {far, -far}, {-far, far}}}, {}, window);
    out.add({{{far, -far}, {far, far}, {-far, far}}}, {}, window);
    out.add({{{-far, -far}, {far, -far}, {far, far}}}, {}, window);
    out.add({{{-far, -far}, {far, far}, {-far, far}}}, {}, window);
  }
  out.add({{{-far, -far}, {far, -far}, {-far, far}}}, {}, {last, last, last, last});
  out.add({{{-far, -far}, {far, -far}, {-far, far}}}, {}, {0, 0, last, 0});
  out.add({{{-far, -far}, {far, -far}, {-far, far}}}, {}, {0, 0, 0, last});
  std::vector<SetupTriangle> triangles = out.take();
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    turn_edges(triangles[i], i);
  }
  // Edges along the samples at the borders of tiles, blocks inside all edges, and the longest edges, by each
  // of the edges.
  add_turns(out, 4 * block, 4 * block, tile);
  add_turns(out, 4 * block - 1, 4 * block - 1, tile);
  out.add_square(block, block, 3 * block);
  add_longest_edges(out);
  for (SetupTriangle& triangle : out.take()) {
    for (int i = 0; i < 3; ++i) {
      turn_edges(triangle, 1);
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

SetupTriangle random_triangle(const WalkSizes& sizes, Random& random) {
  std::optional<SetupTriangle> triangle;
  while (!triangle) {
    if (random.below(kLargeEvery) == 0) {
      triangle = full_screen(sizes, random);
      continue;
    }
    const Points v = random_points(sizes, random);
    const FillRule rule = kFillRules[random.below(kFillRules.size())];
    triangle = set_up(v, screen(), rule, sizes);
    const bool cut = random.below(8) == 0;
    if (triangle && (cut || tiles_of(triangle->bounds, sizes.tile_size) > most_tiles(sizes))) {
      triangle = set_up(v, random_window(v, triangle->bounds, sizes, random), rule, sizes);
    }
  }
  turn_edges(*triangle, random.below(3));
  return *triangle;
}

std::vector<SetupTriangle> frame_triangles(const std::string& file, const WalkSizes& sizes) {
  const Frame frame = load(file);
  Config config;
  config.raster.sub_pixel_bits = sizes.sub_pixel_bits;
  config.raster.samples = sizes.samples;
  std::vector<SetupTriangle> triangles;
  std::vector<ScreenTriangle> batch;
  FrontEndCounters counters;
  for (const Command& command : frame.commands) {
    if (command.kind != CommandKind::kDraw || command.has(Flag::kNotFilled)) {
      continue;
    }
    const Target& target = frame.targets[command.target];
    const FrontEnd front_end(frame, command, DepthFormat::kNone, sizes.sub_pixel_bits);
    const SetupState state = setup_state(command, target, DepthFormat::kNone, config);
    for (std::uint32_t i = 0; i < command.index_count / 3; ++i) {
      batch.clear();
      front_end.process(i, batch, counters);
      for (const ScreenTriangle& triangle : batch) {
        SetupTriangle out;
        if (setup(triangle, state, out) == SetupVerdict::kDrawn) {
          triangles.push_back(out);
        }
      }
    }
  }
  return triangles;
}

std::vector<SetupTriangle> square_triangles(int x, int y, int size, const WalkSizes& sizes) {
  Triangles out(sizes);
  out.add_square(x, y, size);
  return out.take();
}

}  // namespace halfspace::tb
