/// Families that are hard on depth.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "halfspace/reference/depth_code.hpp"
#include "halfspace/stress/draw_list.hpp"
#include "halfspace/stress/family.hpp"

namespace halfspace::stress {
namespace {

/// A triangle near the target: any, about a pixel, a sliver, or as large as the guard band.
GridTriangle any_triangle(DrawList& list) {
  const std::int64_t far = 32766 * list.one();
  const std::int64_t reach = list.extent() / 4;
  GridTriangle triangle;
  switch (list.between(0, 3)) {
    case 0:
      for (GridPoint& p : triangle) p = list.point(-reach, list.extent() + reach);
      break;
    case 1: {
      const GridPoint middle = list.point_on_target();
      for (GridPoint& p : triangle) {
        p = {middle.x + list.between(-list.one(), list.one()),
             middle.y + list.between(-list.one(), list.one())};
      }
      break;
    }
    case 2:  // the third vertex beside the line through the others
      triangle[0] = list.point(-reach, list.extent() + reach);
      triangle[1] = list.point(-reach, list.extent() + reach);
      triangle[2] = {(triangle[0].x + triangle[1].x) / 2 + list.between(-3, 3),
                     (triangle[0].y + triangle[1].y) / 2 + list.between(-3, 3)};
      break;
    default:
      for (GridPoint& p : triangle) p = list.point(-far, far);
  }
  return list.shuffled(triangle);
}

/// 0, 1, or of any exponent.
float steep(DrawList& list) {
  const auto kind = list.between(0, 5);
  const float unit = list.depth();
  return kind == 0   ? 0.0F
         : kind == 1 ? 1.0F
         : kind == 2 ? std::ldexp(unit, -static_cast<int>(list.between(0, 149)))
                     : unit;
}

/// Depths that fit the word of a unorm depth, but leave its sums no room.
float just_above_one(DrawList& list) { return 1 + static_cast<float>(list.between(0, 64)) * 0x1p-23F; }

}  // namespace

Case grid_depth(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, 32, seed);
  list.draw();
  const std::int64_t step = list.one() / 16;
  for (std::int64_t y = 0; y < list.size(); y += 2) {
    for (std::int64_t x = 0; x < list.size(); x += 2) {
      GridTriangle triangle;
      for (GridPoint& p : triangle) {
        p = {x * list.one() + step * list.between(0, 31), y * list.one() + step * list.between(0, 31)};
      }
      list.add(triangle, {steep(list), steep(list), steep(list)});
    }
  }
  Case made = list.take_defined();
  made.depth = true;
  return made;
}

Case steep_depth(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, 64, seed);
  list.draw();
  for (int n = 0; n < 40; ++n) {
    list.add(any_triangle(list), {steep(list), steep(list), steep(list)});
  }
  Case made = list.take_defined();
  made.depth = true;
  return made;
}

Case clamp_and_offset(const Precision& precision, std::uint64_t seed) {
  DrawList list(precision, 64, seed);
  // Depths so large that they are resolved sample by sample, and such offsets, are for samples at the
  // centres.
  const bool centres = precision.samples.is_centre();
  for (int n = 0; n < 12; ++n) {
    Command& draw = list.draw();
    const bool clamp = list.one_in(2);
    const auto any = [&](int least, int most) {
      return std::ldexp(2 * list.depth() - 1, static_cast<int>(list.between(least, most)));
    };
    if (clamp) {
      draw.flags |= bits({Flag::kDepthClamp});
    }
    if (!clamp || list.one_in(2)) {
      draw.flags |= bits({Flag::kPolygonOffset});
      draw.offset_factor = list.one_in(3) || !centres ? 0 : any(-10, 3);
      draw.offset_units = list.one_in(3) ? 0 : any(0, 20);
      draw.offset_clamp = list.one_in(2) ? 0 : any(-22, -1);
    }
    for (int k = 0; k < 4; ++k) {
      std::array<float, 3> z{};
      for (float& value : z) {
        value = !clamp ? steep(list) : list.one_in(3) ? just_above_one(list) : any(-24, centres ? 20 : 13);
      }
      list.add(any_triangle(list), z);
    }
  }
  Case made = list.take_defined();
  made.depth = true;
  return made;
}

namespace {

/// A depth whose code is known: near enough to the middle of the code, or the code itself.
float depth_of(std::uint32_t code, DepthFormat format) {
  if (format == DepthFormat::kFloat32) {
    return std::bit_cast<float>(code);
  }
  return static_cast<float>(static_cast<double>(code) / max_unorm_code(format));
}

}  // namespace

Case depth_stack(const Precision& precision, std::uint64_t seed) {
  constexpr std::uint32_t kSize = 16;
  DrawList list(precision, kSize, seed);
  const bool is_float = precision.format == DepthFormat::kFloat32;
  // Up to 2^23 the nearest float32 to a unorm24 code is within a quarter of a code of it, so it is that code.
  const std::int64_t most = is_float                                    ? std::bit_cast<std::uint32_t>(1.0F)
                            : precision.format == DepthFormat::kUnorm16 ? 0xffff
                                                                        : (1 << 23) - 1;
  const std::int64_t base = list.one_in(4) ? list.between(0, 2) : list.between(0, most);
  const auto code = [&] {
    return static_cast<std::uint32_t>(std::clamp<std::int64_t>(base + list.between(-2, 2), 0, most));
  };
  std::vector<std::uint32_t> stored(kSize * kSize, 0);
  std::vector<std::int32_t> survivors(kSize * kSize, 0);
  const auto clear = [&] {
    const std::uint32_t value = code();
    list.clear(depth_of(value, precision.format));
    std::fill(stored.begin(), stored.end(), value);
  };
  clear();
  for (int n = 0; n < 24; ++n) {
    if (list.one_in(8)) {
      clear();
    }
    Command& draw = list.draw();
    const auto func = static_cast<DepthFunc>(list.between(0, 7));
    const bool writes = !list.one_in(4);
    draw.depth_func = func;
    draw.flags &= writes ? ~0U : ~bits({Flag::kDepthWrite});
    for (auto k = list.between(1, 4); k > 0; --k) {
      GridTriangle triangle = any_triangle(list);
      if (list.one_in(3)) {  // all of the target
        triangle = {GridPoint{0, 0}, GridPoint{2 * list.extent(), 0}, GridPoint{0, 2 * list.extent()}};
      }
      const std::uint32_t layer = code();
      const float z = depth_of(layer, precision.format);
      list.add(triangle, {z, z, z});
      for (std::uint32_t y = 0; y < kSize; ++y) {
        for (std::uint32_t x = 0; x < kSize; ++x) {
          const std::size_t pixel = y * kSize + x;
          if (reference::covers(triangle, list.sample_of(x, y), precision.rule) &&
              reference::depth_test(static_cast<std::uint32_t>(func), layer, stored[pixel])) {
            ++survivors[pixel];
            stored[pixel] = writes ? layer : stored[pixel];
          }
        }
      }
    }
  }
  Case made = list.take_defined();
  made.survivors = std::move(survivors);
  return made;
}

}  // namespace halfspace::stress
