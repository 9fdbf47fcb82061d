/// Random frames that are hard on what works with bounds, vectors or windows.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "../timing/random_machine.hpp"

namespace halfspace::testing {

/// Triangles that are hard on vectors: within a few samples, on the borders of tiles and blocks, slivers, and
/// as large as the guard band.
inline std::vector<glm::dvec3> hard_triangles(Random& random, int size, int count) {
  const auto coordinate = [&](double low, double high) {
    const double grid = pick(random, {1.0, 2.0, 16.0, 256.0, 4096.0});
    return static_cast<double>(random.between(static_cast<std::int64_t>(low * grid),
                                              static_cast<std::int64_t>(high * grid))) /
           grid;
  };
  const auto depth = [&] {
    return pick(random, {0.0, 0.5, 1.0, coordinate(0, 1), coordinate(0, 1), coordinate(0, 1)});
  };
  std::vector<glm::dvec3> window;
  for (int n = 0; n < count; ++n) {
    const double reach = pick(random, {1.0, 2.0, 3.0, 4.0, 9.0, 40.0, 40.0, 3000.0});
    const double middle_x = coordinate(-4, size + 4);
    const double middle_y = coordinate(-4, size + 4);
    const bool flat = random.between(0, 5) == 0;
    const double z = depth();
    for (int i = 0; i < 3; ++i) {
      window.emplace_back(middle_x + coordinate(-reach, reach), middle_y + coordinate(-reach, reach),
                          flat ? z : depth());
    }
    if (random.between(0, 5) == 0) {  // a sliver
      window.back() = (window[window.size() - 2] + window[window.size() - 3]) / 2.0;
      window.back().x += coordinate(-1, 1) / 4;
    }
  }
  return window;
}

inline Frame hard_frame(Random& random) {
  Frame frame = random_frame(random);
  if (random.between(0, 1) == 0) {
    return frame;
  }
  const int size = pick(random, {16, 64, 100, 200});
  FrameBuilder builder(static_cast<std::uint32_t>(size),
                       pick(random, {DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kUnorm24,
                                     DepthFormat::kFloat32}));
  for (auto n = random.between(1, 3); n > 0; --n) {
    Command& draw = builder.draw(hard_triangles(random, size, static_cast<int>(random.between(1, 300))));
    draw.depth_func =
        random.between(0, 1) == 0 ? DepthFunc::kLess : static_cast<DepthFunc>(random.between(0, 7));
    draw.flags |= random.between(0, 7) == 0 ? bits({Flag::kDepthClamp}) : 0;
    draw.flags |= random.between(0, 7) == 0 ? bits({Flag::kNdcZMinusOneToOne}) : 0;
    draw.flags |= random.between(0, 7) == 0 ? bits({Flag::kCullBack}) : 0;
    draw.flags |= random.between(0, 7) == 0 ? bits({Flag::kBottomLeftRule}) : 0;
    draw.flags |= random.between(0, 3) == 0 ? bits({Flag::kShaderDiscards}) : 0;
    if (random.between(0, 7) == 0) {
      draw.flags |= bits({Flag::kPolygonOffset});
      draw.offset_units = static_cast<float>(random.between(-100, 100));
      draw.offset_factor = static_cast<float>(random.between(-4, 4));
    }
    if (random.between(0, 7) == 0) {
      draw.depth_range = {static_cast<float>(random.between(0, 4)) / 4,
                          static_cast<float>(random.between(0, 4)) / 4};
    }
    if (random.between(0, 5) == 0) {
      draw.scissor = random_scissor(random, size);
    }
  }
  return builder.frame;
}

/// Depth ranges and clears outside [0, 1] on a float32 surface, of any size and sign, among draws that keep
/// to [0, 1].
inline Frame unrestricted_frame(Random& random) {
  const int size = pick(random, {16, 64, 100});
  FrameBuilder builder(static_cast<std::uint32_t>(size), DepthFormat::kFloat32);
  const auto end = [&] {
    constexpr float kLargest = std::numeric_limits<float>::max();
    return pick(random, {0.0f, 1.0f, -1.0f, 0.25f, -65536.0f, 65536.0f, 1e-40f, -3e-39f, 1e30f, -1e30f,
                         kLargest, -kLargest});
  };
  for (auto n = random.between(1, 4); n > 0; --n) {
    if (random.between(0, 1) == 0) {
      Command& clear = builder.clear(end());
      if (random.between(0, 1) == 0) {
        clear.scissor = random_scissor(random, size);
      }
    }
    Command& draw = builder.draw(hard_triangles(random, size, static_cast<int>(random.between(1, 60))));
    draw.depth_func =
        random.between(0, 1) == 0 ? DepthFunc::kLess : static_cast<DepthFunc>(random.between(0, 7));
    draw.flags |= random.between(0, 3) == 0 ? bits({Flag::kDepthClamp}) : 0;
    draw.flags |= random.between(0, 3) == 0 ? bits({Flag::kNdcZMinusOneToOne}) : 0;
    draw.flags |= random.between(0, 3) == 0 ? bits({Flag::kShaderDiscards}) : 0;
    if (random.between(0, 3) == 0) {
      draw.flags |= bits({Flag::kPolygonOffset});
      draw.offset_units = static_cast<float>(random.between(-100, 100));
      draw.offset_factor = static_cast<float>(random.between(-4, 4));
    }
    if (random.between(0, 3) != 0) {
      draw.depth_range = {end(), end()};
    }
  }
  return builder.frame;
}

/// Two triangles that reach far beyond a small target. In a tile one has its largest depth, and the other its
/// least, at the same sample, up to some codes apart. The first vertex of each is far away and near 0, so it
/// says little of the depths that are seen.
inline Frame touching_planes(Random& random) {
  FrameBuilder builder(64, pick(random, {DepthFormat::kUnorm24, DepthFormat::kFloat32}));
  const double x = static_cast<double>(random.between(0, 7)) * 8 + 0.5;  // bottom left of a tile
  const double y = static_cast<double>(random.between(0, 7)) * 8 + 7.5;
  const double z = static_cast<double>(random.between(34000, 45000)) / 65536;
  for (const double side : {-1.0, 1.0}) {  // where the first vertex is
    const double size = static_cast<double>(random.between(100, 1000)) / 1000;
    const double there = z + static_cast<double>(random.between(-6, 6)) * 0x1p-25;
    const double first = static_cast<double>(random.between(1, 1000)) / 65536;
    const glm::dvec2 corner(side * 20000 * size, -10000 * size);
    const double down = side * 5e-6 / size;
    const double across = (first - there - down * (corner.y - y)) / (corner.x - x);
    const auto vertex = [&](const glm::dvec2& at) {
      return glm::dvec3(at, there + across * (at.x - x) + down * (at.y - y));
    };
    Command& draw = builder.draw({vertex(corner), vertex({side * -5000 * size, -5000 * size}),
                                  vertex({side * 2000 * size, 8000 * size})});
    draw.depth_func = side < 0 ? DepthFunc::kAlways
                               : pick(random, {DepthFunc::kLess, DepthFunc::kLequal, DepthFunc::kGreater,
                                               DepthFunc::kGequal, DepthFunc::kEqual, DepthFunc::kNotEqual});
  }
  return builder.frame;
}

/// Slivers of some square sub-pixels that cover a sample, so steep that the change of depth from pixel to
/// pixel passes 64 bits: around one that was found, in steps of 1/128 pixel.
inline Frame steep_slivers(Random& random) {
  FrameBuilder builder(64,
                       pick(random, {DepthFormat::kUnorm24, DepthFormat::kUnorm24, DepthFormat::kFloat32}));
  std::vector<glm::dvec3> window;
  for (int n = 0; n < 50; ++n) {
    const glm::dvec2 moved(static_cast<double>(random.between(-57, 2)),
                           static_cast<double>(random.between(-1, 49)));
    const auto vertex = [&](int x, int y, double z) {
      const auto near = [&](int at) { return static_cast<double>(at + random.between(-1, 1)) / 128; };
      window.emplace_back(near(x) + moved.x, near(y) + moved.y, z);
    };
    vertex(7440, 1794, 0);
    vertex(7822, 250, 1.0 / 64);
    vertex(7568, 1277, 1);
  }
  builder.draw(window).depth_func = DepthFunc::kLess;
  return builder.frame;
}

/// Triangles of which a scissor leaves a window of a few samples: a tile, a part of one or of several. Some
/// cover it whole.
inline Frame scissored(Random& random) {
  FrameBuilder builder(64, pick(random, {DepthFormat::kUnorm24, DepthFormat::kFloat32}));
  for (int n = 0; n < 8; ++n) {
    Command& draw = builder.draw(hard_triangles(random, 64, 40));
    const std::int32_t side = pick(random, {1, 2, 3, 4, 4, 4, 8, 9});
    draw.scissor = {static_cast<std::int32_t>(random.between(0, 15)) * 4,
                    static_cast<std::int32_t>(random.between(0, 15)) * 4, side, side};
  }
  return builder.frame;
}

/// Layers on a part of the screen, some codes apart and flat or nearly so, drawn in any order by any
/// function, with clears between them: what a bound of depth that is one code off gets wrong.
inline Frame depth_stack(Random& random) {
  const int size = pick(random, {64, 100, 128});
  FrameBuilder builder(static_cast<std::uint32_t>(size),
                       pick(random, {DepthFormat::kUnorm16, DepthFormat::kUnorm24, DepthFormat::kFloat32}));
  const auto one_of = [&](int low, int high) { return static_cast<double>(random.between(low, high)); };
  const double near = pick(random, {0.25, 0.5, 0.75, 0.99, 1.0 / 65536}) + one_of(0, 1 << 10) / (1 << 20);
  const double code = pick(random, {0x1p-24, 0x1p-16, 0x1p-25, 0x1p-23});
  DepthFunc func = DepthFunc::kLess;
  for (auto layers = random.between(2, 24); layers > 0; --layers) {
    if (random.between(0, 15) == 0) {
      Command& clear = builder.clear(static_cast<float>(near + code * one_of(-4, 4)));
      if (random.between(0, 1) == 0) {
        clear.scissor = random_scissor(random, size);
      }
    }
    const double z = near + code * one_of(-4, 4);
    const double slope_x = pick(random, {0.0, 0.0, code / 8, code, -code / 16, code * 64});
    const double slope_y = pick(random, {0.0, 0.0, code / 8, -code, code * 16});
    const double x = one_of(-40, size);
    const double y = one_of(-40, size);
    const double wide = pick(random, {3.0, 9.0, 33.0, 200.0});
    const auto vertex = [&](double dx, double dy) {
      return glm::dvec3{x + dx, y + dy, std::clamp(z + slope_x * dx + slope_y * dy, 0.0, 1.0)};
    };
    Command& draw = builder.draw({vertex(0, 0), vertex(wide, 0), vertex(0, wide), vertex(wide, 0),
                                  vertex(wide, wide), vertex(0, wide)});
    if (random.between(0, 2) == 0) {
      func = static_cast<DepthFunc>(random.between(0, 7));
    }
    draw.depth_func = func;
    if (random.between(0, 3) == 0) {
      draw.flags &= ~bits({Flag::kDepthWrite});
    }
    if (random.between(0, 3) == 0) {
      draw.flags |= bits({Flag::kShaderDiscards});
    }
    if (random.between(0, 7) == 0) {
      draw.flags |= bits({Flag::kPolygonOffset});
      draw.offset_units = static_cast<float>(random.between(-2, 2));
      draw.offset_factor = static_cast<float>(random.between(-2, 2));
    }
    if (random.between(0, 15) == 0) {
      draw.flags |= bits({Flag::kDepthClamp});
      draw.depth_range = {static_cast<float>(near), static_cast<float>(near + 4 * code)};
    }
  }
  return builder.frame;
}

}  // namespace halfspace::testing
