#include "halfspace/speed/scalar_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <deque>
#include <utility>

#include "halfspace/machine/frame_source.hpp"
#include "halfspace/machine/surfaces.hpp"
#include "halfspace/numerics/error.hpp"

namespace halfspace {
namespace {

float depth_of_vertex(DepthFormat format, std::int64_t z) {
  if (format == DepthFormat::kFloat32) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(z));
  }
  const double one = std::ldexp(max_unorm_code(format), vertex_depth_fraction(format));
  return format == DepthFormat::kNone ? 0 : static_cast<float>(static_cast<double>(z) / one);
}

ScalarTriangle scalar_triangle(const ScreenTriangle& in, DepthFormat format, const PixelRect& bounds) {
  ScalarTriangle out{.within = intersect(bounds, in.within)};
  for (std::size_t i = 0; i < 3; ++i) {
    out.x[i] = in.v[i].x;
    out.y[i] = in.v[i].y;
    out.z[i] = depth_of_vertex(format, in.v[i].z) + depth_of_vertex(format, in.offset);
  }
  return out;
}

ScalarDraw scalar_draw(const DrawContext& draw) {
  return {.surface = draw.surface,
          .counts = !draw.is_clear(),
          .test = draw.early_z.test,
          .write = draw.early_z.write,
          .func = draw.early_z.func,
          .least = depth_of_code(draw.early_z.format, draw.setup.limits.least),
          .most = depth_of_code(draw.early_z.format, draw.setup.limits.most),
          .front_positive_area = draw.setup.front_positive_area,
          .cull_front = draw.setup.cull_front,
          .cull_back = draw.setup.cull_back,
          .fill_rule = draw.setup.fill_rule,
          .triangles = {}};
}

/// An edge function: inside is value >= 0.
struct EdgeFunction {
  std::int64_t value = 0;  ///< at the first pixel of the bounding box
  std::int64_t dx = 0;     ///< change for a pixel
  std::int64_t dy = 0;
};

/// From `from` to `to`, going round with positive area.
EdgeFunction edge_function(const ScalarTriangle& t, std::size_t from, std::size_t to, std::int64_t x,
                           std::int64_t y, int sub_pixel_bits, FillRule rule) {
  const std::int64_t a = t.y[from] - t.y[to];
  const std::int64_t b = t.x[to] - t.x[from];
  const bool owns = a != 0 ? (a > 0) != owns_right(rule) : (b > 0) != owns_bottom(rule);
  return {.value = a * (x - t.x[from]) + b * (y - t.y[from]) - (owns ? 0 : 1),
          .dx = a << sub_pixel_bits,
          .dy = b << sub_pixel_bits};
}

/// z(x, y) = z + dx * x + dy * y, in pixels from the first of the bounding box.
struct Plane {
  float z = 0;
  float dx = 0;
  float dy = 0;
};

Plane plane(const ScalarTriangle& t, std::int64_t area2, std::int64_t x, std::int64_t y, int sub_pixel_bits) {
  const auto x1 = static_cast<float>(t.x[1] - t.x[0]);
  const auto y1 = static_cast<float>(t.y[1] - t.y[0]);
  const auto x2 = static_cast<float>(t.x[2] - t.x[0]);
  const auto y2 = static_cast<float>(t.y[2] - t.y[0]);
  const float z1 = t.z[1] - t.z[0];
  const float z2 = t.z[2] - t.z[0];
  const float reciprocal = 1 / static_cast<float>(area2);
  const float dx = (z1 * y2 - z2 * y1) * reciprocal;
  const float dy = (z2 * x1 - z1 * x2) * reciprocal;
  const auto pixel = static_cast<float>(1 << sub_pixel_bits);
  return {.z = t.z[0] + dx * static_cast<float>(x - t.x[0]) + dy * static_cast<float>(y - t.y[0]),
          .dx = dx * pixel,
          .dy = dy * pixel};
}

/// One triangle, pixel by pixel. `pixel(x, y, z)` is called for every sample that is covered.
template <class Pixel>
void draw_triangle(const ScalarTriangle& t, const ScalarDraw& draw, int sub_pixel_bits, Pixel&& pixel) {
  const std::int64_t area2 =
      std::int64_t{t.x[1] - t.x[0]} * (t.y[2] - t.y[0]) - std::int64_t{t.x[2] - t.x[0]} * (t.y[1] - t.y[0]);
  if (area2 == 0) {
    return;
  }
  const bool front = (area2 > 0) == draw.front_positive_area;
  if (front ? draw.cull_front : draw.cull_back) {
    return;
  }
  // The pixels whose centres lie in the bounding box.
  const std::int32_t half = 1 << (sub_pixel_bits - 1);
  const auto [left, right] = std::minmax({t.x[0], t.x[1], t.x[2]});
  const auto [top, bottom] = std::minmax({t.y[0], t.y[1], t.y[2]});
  const std::int32_t x_first = std::max(t.within.x_first, (left + half - 1) >> sub_pixel_bits);
  const std::int32_t y_first = std::max(t.within.y_first, (top + half - 1) >> sub_pixel_bits);
  const std::int32_t x_last = std::min(t.within.x_last, (right - half) >> sub_pixel_bits);
  const std::int32_t y_last = std::min(t.within.y_last, (bottom - half) >> sub_pixel_bits);
  if (x_first > x_last || y_first > y_last) {
    return;
  }
  const std::int64_t x0 = (std::int64_t{x_first} << sub_pixel_bits) + half;
  const std::int64_t y0 = (std::int64_t{y_first} << sub_pixel_bits) + half;
  const Plane depth = plane(t, area2, x0, y0, sub_pixel_bits);
  const std::size_t second = area2 > 0 ? 1 : 2;
  const std::size_t third = 3 - second;
  EdgeFunction e0 = edge_function(t, second, third, x0, y0, sub_pixel_bits, draw.fill_rule);
  EdgeFunction e1 = edge_function(t, third, 0, x0, y0, sub_pixel_bits, draw.fill_rule);
  EdgeFunction e2 = edge_function(t, 0, second, x0, y0, sub_pixel_bits, draw.fill_rule);
  for (std::int32_t y = y_first; y <= y_last; ++y) {
    const float row = depth.z + depth.dy * static_cast<float>(y - y_first);
    std::int64_t w0 = e0.value;
    std::int64_t w1 = e1.value;
    std::int64_t w2 = e2.value;
    for (std::int32_t x = x_first; x <= x_last; ++x) {
      if ((w0 | w1 | w2) >= 0) {
        pixel(x, y, row + depth.dx * static_cast<float>(x - x_first));
      }
      w0 += e0.dx;
      w1 += e1.dx;
      w2 += e2.dx;
    }
    e0.value += e0.dy;
    e1.value += e1.dy;
    e2.value += e2.dy;
  }
}

bool passes(DepthFunc func, float incoming, float stored) {
  switch (func) {
    case DepthFunc::kNever:
      return false;
    case DepthFunc::kLess:
      return incoming < stored;
    case DepthFunc::kEqual:
      return incoming == stored;
    case DepthFunc::kLequal:
      return incoming <= stored;
    case DepthFunc::kGreater:
      return incoming > stored;
    case DepthFunc::kNotEqual:
      return incoming != stored;
    case DepthFunc::kGequal:
      return incoming >= stored;
    case DepthFunc::kAlways:
      return true;
  }
  return false;
}

/// LESS and write. Counting fragments costs a twentieth of the time, so it is an option.
template <bool CountFragments>
ScalarCounts draw_less(const ScalarDraw& draw, int sub_pixel_bits, float* depth, std::int32_t width) {
  ScalarCounts counts;
  for (const ScalarTriangle& triangle : draw.triangles) {
    draw_triangle(triangle, draw, sub_pixel_bits, [&](std::int32_t x, std::int32_t y, float z) {
      float& stored =
          depth[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
      counts.fragments += CountFragments ? 1 : 0;
      if (z < stored) {
        stored = z;
        ++counts.survivors;
      }
    });
  }
  return counts;
}

/// Any other state. `depth` may be null where the test is off.
ScalarCounts draw_other(const ScalarDraw& draw, int sub_pixel_bits, float* depth, std::int32_t width) {
  ScalarCounts counts;
  for (const ScalarTriangle& triangle : draw.triangles) {
    draw_triangle(triangle, draw, sub_pixel_bits, [&](std::int32_t x, std::int32_t y, float z) {
      ++counts.fragments;
      if (!draw.test) {
        ++counts.survivors;
        return;
      }
      float& stored =
          depth[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
      const float kept = std::min(std::max(z, draw.least), draw.most);
      if (passes(draw.func, kept, stored)) {
        ++counts.survivors;
        stored = draw.write ? kept : stored;
      }
    });
  }
  return counts;
}

}  // namespace

ScalarLoop::ScalarLoop(const Frame& frame, const Config& config)
    : sub_pixel_bits_(config.raster.sub_pixel_bits) {
  for (std::size_t i = 0; i < frame.commands.size(); ++i) {
    const Command& command = frame.commands[i];
    if (command.kind == CommandKind::kDraw && command.draws_thin_lines()) {
      throw InputError(fmt::format("{}: command {}: it draws thin lines, and the scalar loop triangles alone",
                                   frame.name, i));
    }
  }
  FrameResult result;
  result.surfaces = make_surfaces(frame, config, Watch{.count_pixels = false});
  std::deque<DrawContext> contexts;
  FrameSource source(frame, config, nullptr, result.surfaces, result, contexts);
  for (std::uint32_t i = 0; i < frame.commands.size(); ++i) {
    if (const DrawContext* const draw = source.begin(i)) {
      draws_.push_back(scalar_draw(*draw));
    }
    while (const std::optional<SourceItem> item = source.next()) {
      if (item->draw == nullptr) {
        const DepthFormat format = result.surfaces[item->surface].format;
        draws_.push_back({.surface = item->surface,
                          .clears = true,
                          .least = depth_of_code(format, item->code),
                          .triangles = {}});
        continue;
      }
      const SetupState& state = item->draw->setup;
      for (const ScreenTriangle& triangle : item->triangles) {
        draws_.back().triangles.push_back(scalar_triangle(triangle, state.depth_format, state.bounds));
      }
    }
  }
  while (first_draw_ < draws_.size() && draws_[first_draw_].clears) {
    ++first_draw_;
  }
  for (const Surface& surface : depth_surfaces(result.surfaces)) {
    surfaces_.push_back({.width = surface.codes.width(), .height = surface.codes.height(), .depth = {}});
    surfaces_.back().depth.resize(static_cast<std::size_t>(surface.codes.width()) *
                                  static_cast<std::size_t>(surface.codes.height()));
  }
}

void ScalarLoop::clear() {
  for (Image& image : surfaces_) {
    std::ranges::fill(image.depth, 1.0f);
  }
  for (std::size_t i = 0; i < first_draw_; ++i) {
    std::ranges::fill(surfaces_[draws_[i].surface].depth, draws_[i].least);
  }
}

std::uint64_t ScalarLoop::draw() { return draw_all<false>().survivors; }

ScalarCounts ScalarLoop::count() {
  clear();
  return draw_all<true>();
}

template <bool CountFragments>
ScalarCounts ScalarLoop::draw_all() {
  ScalarCounts all;
  Image none;
  for (std::size_t i = first_draw_; i < draws_.size(); ++i) {
    const ScalarDraw& draw = draws_[i];
    Image& image = draw.surface == kNoSurface ? none : surfaces_[draw.surface];
    if (draw.clears) {
      std::ranges::fill(image.depth, draw.least);
      continue;
    }
    const bool plain = draw.test && draw.write && draw.func == DepthFunc::kLess;
    const ScalarCounts counts = (plain ? draw_less<CountFragments> : draw_other)(
        draw, sub_pixel_bits_, image.depth.data(), image.width);
    all.fragments += draw.counts ? counts.fragments : 0;
    all.survivors += draw.counts ? counts.survivors : 0;
  }
  return all;
}

}  // namespace halfspace
