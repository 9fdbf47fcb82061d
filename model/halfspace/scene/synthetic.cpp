#include "halfspace/scene/synthetic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <vector>

#include "halfspace/config/did_you_mean.hpp"
#include "halfspace/numerics/error.hpp"
#include "halfspace/numerics/split_mix.hpp"
#include "halfspace/scene/quote.hpp"
#include "halfspace/scene/validate.hpp"

namespace halfspace {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr std::string_view kFull = "full";
constexpr std::int64_t kGrid = 256;  ///< positions a pixel

struct Size {
  std::int64_t width = 0;  ///< pixels
  std::int64_t height = 0;
};
constexpr Size kSquare{512, 512};
constexpr Size kFullHd{1920, 1080};

struct Corner {
  std::int64_t x = 0;  ///< in steps of the grid
  std::int64_t y = 0;
  double z = 0;
};
using Triangle = std::array<Corner, 3>;
using Triangles = std::vector<Triangle>;

struct Range {
  double low = 0;
  double high = 0;
};

struct Point {
  double x = 0;
  double y = 0;
};
using Shape = std::array<Point, 3>;
using Axes = std::array<glm::dvec3, 3>;

double area(const Shape& s) {
  return std::abs((s[1].x - s[0].x) * (s[2].y - s[0].y) - (s[2].x - s[0].x) * (s[1].y - s[0].y)) / 2;
}

/// In pixels.
double area(const Triangle& t) {
  const std::int64_t twice = (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y);
  return static_cast<double>(std::abs(twice)) / (2.0 * kGrid * kGrid);
}

std::int64_t to_grid(double pixels) { return std::llround(pixels * kGrid); }

class Generator {
 public:
  explicit Generator(Size size) : size_(size) {}

  double real(Range range) { return random_.real(range.low, range.high); }

  /// Three uniform points of the unit square.
  Shape shape() {
    Shape shape;
    for (Point& point : shape) {
      point.x = random_.real(0, 1);
      point.y = random_.real(0, 1);
    }
    return shape;
  }

  /// A random direction, of length 1.
  Point direction() {
    while (true) {
      const Point p{random_.real(-1, 1), random_.real(-1, 1)};
      const double length = std::sqrt(p.x * p.x + p.y * p.y);
      if (length > 0.1 && length <= 1) {
        return {p.x / length, p.y / length};
      }
    }
  }

  /// Three axes at right angles, of length 1.
  Axes axes() {
    while (true) {
      const glm::dvec3 u(real({-1, 1}), real({-1, 1}), real({-1, 1}));
      const glm::dvec3 v(real({-1, 1}), real({-1, 1}), real({-1, 1}));
      const glm::dvec3 w = glm::cross(u, v);
      if (glm::dot(u, u) > 0.1 && glm::dot(w, w) > 0.1) {
        return {glm::normalize(u), glm::normalize(w), glm::normalize(glm::cross(u, w))};
      }
    }
  }

  /// The shape, its points times `scale`, at a uniform place inside the screen, its corners' depths uniform
  /// in `z`.
  Triangle place(const Shape& shape, double scale, Range z) {
    Triangle triangle;
    for (std::size_t i = 0; i < 3; ++i) {
      triangle[i] = {to_grid(scale * shape[i].x), to_grid(scale * shape[i].y), real(z)};
    }
    const auto [left, right] = std::minmax({triangle[0].x, triangle[1].x, triangle[2].x});
    const auto [top, bottom] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
    const std::int64_t x = random_.integer(-left, size_.width * kGrid - right);
    const std::int64_t y = random_.integer(-top, size_.height * kGrid - bottom);
    for (Corner& corner : triangle) {
      corner.x += x;
      corner.y += y;
    }
    return triangle;
  }

  /// A triangle of an area uniform in `pixels`: three uniform points of a square a tenth of which they cover
  /// at least, scaled.
  Triangle of_area(Range pixels, Range z) {
    constexpr double kLeast = 0.1;
    while (true) {
      const double wanted = real(pixels);
      const Shape points = shape();
      if (area(points) < kLeast) {
        continue;
      }
      const Triangle triangle = place(points, std::sqrt(wanted / area(points)), z);
      if (area(triangle) >= pixels.low && area(triangle) <= pixels.high) {  // on the grid as well
        return triangle;
      }
    }
  }

 private:
  Size size_;
  SplitMix64 random_{kSeed};
};

/// A depth range for a triangle of a list without order.
Range random_depth(Generator& random) {
  constexpr double kSpan = 0.01;
  const double z = random.real({0, 1 - kSpan});
  return {z, z + kSpan};
}

/// The depth range of triangle i of n of a list from front to back: behind that of i - 1.
Range depth_slab(int i, int n) { return {(i + 0.05) / n, (i + 0.95) / n}; }

Triangles one_triangle(int /*divisor*/) {
  const std::int64_t side = kSquare.width * kGrid;
  return {{{{0, 0, 0.25}, {side, 0, 0.5}, {0, side, 0.75}}}};
}

Triangles random_122(int /*divisor*/) {
  constexpr std::size_t kCount = 1000;
  constexpr double kMeanArea = 122;
  Generator random(kSquare);
  std::vector<Shape> shapes(kCount);
  double sum = 0;
  for (Shape& shape : shapes) {
    shape = random.shape();
    sum += area(shape);
  }
  const double scale = std::sqrt(kMeanArea * kCount / sum);
  Triangles triangles;
  for (const Shape& shape : shapes) {
    triangles.push_back(random.place(shape, scale, random_depth(random)));
  }
  return triangles;
}

Triangles unordered(int count, Range pixels) {
  Generator random(kFullHd);
  Triangles triangles;
  for (int i = 0; i < count; ++i) {
    triangles.push_back(random.of_area(pixels, random_depth(random)));
  }
  return triangles;
}

Triangles tiny_rand(int divisor) { return unordered(1'000'000 / divisor, {1, 2}); }
Triangles medium(int divisor) { return unordered(100'000 / divisor, {50, 150}); }

/// Two triangles a cell. Corners are moved at random, those on the screen's border along it.
Triangles tiny_grid(int divisor) {
  constexpr int kColumns = 1000;
  constexpr int kAllRows = 500;
  constexpr Range kJitter{-0.3, 0.3};
  const int rows = kAllRows / divisor;
  Generator random(kFullHd);
  std::vector<Corner> corners;
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= kColumns; ++column) {
      const double dx = random.real(kJitter);
      const double dy = random.real(kJitter);
      const bool side = column == 0 || column == kColumns;
      const bool end = row == 0 || row == kAllRows;
      corners.push_back({to_grid(static_cast<double>(kFullHd.width) / kColumns * column + (side ? 0 : dx)),
                         to_grid(static_cast<double>(kFullHd.height) / kAllRows * row + (end ? 0 : dy)),
                         random.real({0, 1})});
    }
  }
  Triangles triangles;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const Corner* top =
          &corners[static_cast<std::size_t>(row) * (kColumns + 1) + static_cast<std::size_t>(column)];
      const Corner* bottom = top + kColumns + 1;
      triangles.push_back({top[0], top[1], bottom[0]});
      triangles.push_back({top[1], bottom[1], bottom[0]});
    }
  }
  return triangles;
}

Triangles large_ftb(int divisor) {
  const int count = 2000 / divisor;
  Generator random(kFullHd);
  Triangles triangles;
  for (int i = 0; i < count; ++i) {
    triangles.push_back(random.of_area({30'000, 70'000}, depth_slab(i, count)));
  }
  return triangles;
}

/// A base of 0.1 to 0.9 pixels and 1000 pixels from its first corner, at a right angle, the tip.
Triangles sliver(int divisor) {
  constexpr double kLength = 1000;
  Generator random(kFullHd);
  Triangles triangles;
  for (int i = 0; i < 20'000 / divisor; ++i) {
    const Point d = random.direction();
    const double width = random.real({0.1, 0.9});
    const Shape shape{{{0, 0}, {kLength * d.x, kLength * d.y}, {-width * d.y, width * d.x}}};
    triangles.push_back(random.place(shape, 1, random_depth(random)));
  }
  return triangles;
}

Triangles fill_ftb(int divisor) {
  const int layers = 64 / divisor;
  const std::int64_t right = kFullHd.width * kGrid;
  const std::int64_t bottom = kFullHd.height * kGrid;
  Triangles triangles;
  for (int i = 0; i < layers; ++i) {
    const double z = (i + 0.5) / layers;
    triangles.push_back({{{0, 0, z}, {right, 0, z}, {0, bottom, z}}});
    triangles.push_back({{{right, 0, z}, {right, bottom, z}, {0, bottom, z}}});
  }
  return triangles;
}

/// A point of the circle. It goes round once while `turn` goes from 0 to 1, at a speed that varies by 2; by
/// square roots alone, which are the same on every machine, as sines are not.
Point on_circle(double turn) {
  const double quarters = 4 * (turn - std::floor(turn));
  const double x = quarters < 2 ? 1 - quarters : quarters - 3;
  const double y = quarters < 2 ? 1 - std::abs(x) : std::abs(x) - 1;
  const double length = std::sqrt(x * x + y * y);
  return {x / length, y / length};
}

/// How far the surface of the animal is from its middle, in this direction: 0.8 to 1.2.
double animal_radius(const glm::dvec3& d) {
  const double along = d.x * (d.x * d.x * 4 - 3);  // Chebyshev polynomials: -1 to 1
  const double across = d.y * d.y * (d.y * d.y * 8 - 8) + 1;
  const double up = d.z * (d.z * d.z * 4 - 3);
  return 1 + 0.12 * along * across + 0.08 * up * across;
}

/// What an animal is made of: from pole to pole, and around.
struct Net {
  int bands = 0;
  int columns = 0;
};

/// Appends a closed surface, seen from afar, band by band along axes[2]. `middle`: in pixels, and its
/// depth. In x and y the surface reaches at most 1.2 times `pixels` from it, in depth 1.2 times `depth`.
void add_animal(const Net& net, const glm::dvec3& middle, double pixels, double depth, const Axes& axes,
                Triangles& triangles) {
  const auto corner = [&](int band, int column) {
    const Point polar = on_circle(0.5 * band / net.bands);
    const Point around = on_circle(static_cast<double>(column % net.columns) / net.columns);
    const glm::dvec3 direction(polar.y * around.x, polar.y * around.y, polar.x);
    const glm::dvec3 p =
        animal_radius(direction) * (direction.x * axes[0] + direction.y * axes[1] + direction.z * axes[2]);
    return Corner{to_grid(middle.x + pixels * p.x), to_grid(middle.y + pixels * p.y), middle.z + depth * p.z};
  };
  std::vector<Corner> above;
  std::vector<Corner> below;
  for (int band = 0; band <= net.bands; ++band) {
    above.swap(below);
    below.clear();
    for (int column = 0; column <= net.columns; ++column) {
      below.push_back(corner(band, column));
    }
    for (std::size_t i = 1; band > 0 && i < below.size(); ++i) {
      if (band > 1) {
        triangles.push_back({above[i - 1], above[i], below[i - 1]});
      }
      if (band < net.bands) {
        triangles.push_back({above[i], below[i], below[i - 1]});
      }
    }
  }
}

/// One animal as high as the screen. Its bands run across the screen, so that its far side is not drawn
/// first.
Triangles mesh_bunny(int divisor) {
  const Axes axes{{{0, 0, 1}, {-0.8, 0.6, 0}, {0.6, 0.8, 0}}};
  Triangles triangles;
  add_animal({.bands = 86, .columns = 110}, {960, 540, 0.5}, 440, 0.4, axes, triangles);
  triangles.resize(triangles.size() / static_cast<std::size_t>(divisor));
  return triangles;
}

/// Four rows of seven, which overlap, each at a random depth.
Triangles mesh_crowd(int divisor) {
  constexpr double kRadius = 125;
  constexpr double kMargin = 1.2 * kRadius;
  Generator random(kFullHd);
  Triangles triangles;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 7; ++column) {
      const double x = kMargin + (static_cast<double>(kFullHd.width) - 2 * kMargin) / 6 * column;
      const double y = kMargin + (static_cast<double>(kFullHd.height) - 2 * kMargin) / 3 * row;
      const double z = random.real({0.1, 0.9});
      add_animal({.bands = 81, .columns = 181}, {x, y, z}, kRadius, 0.08, random.axes(), triangles);
    }
  }
  triangles.resize(triangles.size() / static_cast<std::size_t>(divisor));
  return triangles;
}

template <Triangles (*FrontToBack)(int)>
Triangles back_to_front(int divisor) {
  Triangles triangles = FrontToBack(divisor);
  std::ranges::reverse(triangles);
  return triangles;
}

struct Kind {
  Size size;
  Triangles (*make)(int divisor);
};

constexpr std::array kInfos{
    SyntheticInfo{"one_triangle", "512x512: one right triangle, half of the screen"},
    SyntheticInfo{
        "random_122",
        "512x512: 1,000 triangles of mean area 122 px, three uniform points of a square at a uniform place"},
    SyntheticInfo{"tiny_rand", "1920x1080: 20,000 (1 M / 50) of area 1 to 2 px, random place and depth", 50,
                  "1920x1080: 1,000,000 of area 1 to 2 px, random place and depth"},
    SyntheticInfo{"tiny_grid",
                  "1920x1080: 20,000 (1 M / 50), the first 10 rows of a jittered 1000x500 grid of cells", 50,
                  "1920x1080: 1,000,000, a jittered 1000x500 grid of cells, row by row"},
    SyntheticInfo{"medium", "1920x1080: 5,000 (100 k / 20) of area 50 to 150 px, random place and depth", 20,
                  "1920x1080: 100,000 of area 50 to 150 px, random place and depth"},
    SyntheticInfo{"large_ftb", "1920x1080: 100 (2 k / 20) of area 30 k to 70 k px, front to back", 20,
                  "1920x1080: 2,000 of area 30 k to 70 k px, front to back"},
    SyntheticInfo{"large_btf", "1920x1080: the same 100 (2 k / 20), back to front", 20,
                  "1920x1080: the same 2,000, back to front"},
    SyntheticInfo{"sliver", "1920x1080: 200 (20 k / 100), 1000 px long, 0.1 to 0.9 px wide, any direction",
                  100, "1920x1080: 20,000, 1000 px long, 0.1 to 0.9 px wide, any direction"},
    SyntheticInfo{"fill_ftb", "1920x1080: 4 (64 / 16) full-screen layers of 2 triangles, front to back", 16,
                  "1920x1080: 64 full-screen layers of 2 triangles, front to back"},
    SyntheticInfo{"fill_btf", "1920x1080: the same 4 (64 / 16), back to front", 16,
                  "1920x1080: the same 64, back to front"},
    SyntheticInfo{"mesh_bunny", "1920x1080: 1,870 (18.7 k / 10), the first of a closed surface seen close up",
                  10, "1920x1080: 18,700, a closed surface as high as the screen"},
    SyntheticInfo{"mesh_crowd", "1920x1080: 20,272 (811 k / 40), the first of 28 closed surfaces", 40,
                  "1920x1080: 810,880, 28 closed surfaces that overlap"},
};

constexpr std::array<Kind, kInfos.size()> kKinds{{
    {kSquare, one_triangle},
    {kSquare, random_122},
    {kFullHd, tiny_rand},
    {kFullHd, tiny_grid},
    {kFullHd, medium},
    {kFullHd, large_ftb},
    {kFullHd, back_to_front<large_ftb>},
    {kFullHd, sliver},
    {kFullHd, fill_ftb},
    {kFullHd, back_to_front<fill_ftb>},
    {kFullHd, mesh_bunny},
    {kFullHd, mesh_crowd},
}};

Frame to_frame(const SyntheticInfo& info, Size size, const Triangles& triangles, DepthFormat depth) {
  const auto width = static_cast<float>(size.width);
  const auto height = static_cast<float>(size.height);
  Frame frame;
  frame.name = info.name;
  frame.targets.push_back({.width = static_cast<std::uint32_t>(size.width),
                           .height = static_cast<std::uint32_t>(size.height),
                           .samples = 1,
                           .depth_format = depth,
                           .color_count = 1,
                           .presented = true,
                           .depth_surface = 0});
  Command clear;
  clear.kind = CommandKind::kClear;
  clear.flags = bits({Flag::kClearDepth, Flag::kClearColor});
  frame.commands.push_back(clear);
  Command draw;
  draw.source_event = 1;
  draw.flags = bits({Flag::kDepthTest, Flag::kDepthWrite, Flag::kColorWrite});
  draw.depth_func = DepthFunc::kLess;
  draw.viewport = {0, 0, width, height};
  draw.index_count = static_cast<std::uint32_t>(3 * triangles.size());
  draw.vertex_count = draw.index_count;
  frame.commands.push_back(draw);
  frame.indices.reserve(draw.index_count);
  frame.vertices.reserve(draw.index_count);
  for (const Triangle& triangle : triangles) {
    for (const Corner& corner : triangle) {
      frame.indices.push_back(static_cast<std::uint32_t>(frame.vertices.size()));
      // Off by 2^-13 pixel at most, so that snapping finds the corner again.
      frame.vertices.emplace_back(
          2.0 * static_cast<double>(corner.x) / static_cast<double>(size.width * kGrid) - 1,
          2.0 * static_cast<double>(corner.y) / static_cast<double>(size.height * kGrid) - 1, corner.z, 1);
    }
  }
  frame.meta = nlohmann::ordered_json{
      {"synthetic", info.name},
      {"what", info.help},
      {"divisor", info.divisor},
      {"seed",
       kSeed}}.dump();
  validate(frame);
  return frame;
}

}  // namespace

std::span<const SyntheticInfo> synthetic_frames() { return kInfos; }

std::string synthetic_help() {
  std::string text;
  for (const SyntheticInfo& info : kInfos) {
    text += fmt::format("  {}{:<13} {}\n", kSyntheticPrefix, info.name, info.help);
  }
  return text +
         fmt::format("  {}NAME:{:<8} the list of NAME undivided: 1 M, not 20,000\n", kSyntheticPrefix, kFull);
}

Frame synthetic_frame(std::string_view name, DepthFormat depth) {
  const std::size_t colon = std::min(name.find(':'), name.size());
  const bool full = colon != name.size();
  const std::string_view kind = name.substr(0, colon);
  const auto info = std::ranges::find(kInfos, kind, &SyntheticInfo::name);
  if (info == kInfos.end()) {
    std::string names;
    for (const SyntheticInfo& each : kInfos) {
      names += fmt::format("{}{}", names.empty() ? "" : ", ", each.name);
    }
    throw InputError(fmt::format("{}{}: no such frame{}; legal names: {}", kSyntheticPrefix, printable(name),
                                 did_you_mean(kind, kInfos, &SyntheticInfo::name), names));
  }
  if (full && name.substr(colon + 1) != kFull) {
    throw InputError(fmt::format("{}{}: what follows the name is {}; legal: {}{} or {}{}:{}",
                                 kSyntheticPrefix, printable(name), quote(name.substr(colon + 1)),
                                 kSyntheticPrefix, kind, kSyntheticPrefix, kind, kFull));
  }
  SyntheticInfo list = *info;
  if (full) {
    list = {name, info->divisor == 1 ? info->help : info->full_help, 1, {}};
  }
  const Kind& maker = kKinds[static_cast<std::size_t>(info - kInfos.begin())];
  return to_frame(list, maker.size, maker.make(list.divisor), depth);
}

}  // namespace halfspace
