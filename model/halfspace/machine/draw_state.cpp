#include "halfspace/machine/draw_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "halfspace/numerics/error.hpp"

namespace halfspace {
namespace {

/// A draw whose fragments only the shader can judge, so that hardware tests them after it.
bool tests_late(const Command& draw) {
  return !draw.has(Flag::kEarlyTestsForced) &&
         (draw.has(Flag::kShaderDiscards) || draw.has(Flag::kShaderWritesDepth) ||
          draw.has(Flag::kShaderSideEffects) || draw.has(Flag::kAlphaToCoverage));
}

}  // namespace

PixelRect drawable_rect(const Scissor& scissor, const Target& target) {
  const auto last = [](std::int32_t first, std::int32_t extent, std::uint32_t size) {
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(std::int64_t{first} + extent, 0, size)) - 1;
  };
  return {.x_first = std::max(scissor.x, 0),
          .y_first = std::max(scissor.y, 0),
          .x_last = last(scissor.x, scissor.width, target.width),
          .y_last = last(scissor.y, scissor.height, target.height)};
}

PixelRect viewport_rect(const glm::vec4& viewport, FillRule rule, const SamplePosition& sample) {
  // Sums of two floats less a sample's way: exact in double wherever a target can be.
  const auto side = [](double position, double extent, int way, bool low_is_in, std::int32_t& first,
                       std::int32_t& last) {
    const double in_pixel = static_cast<double>(way) / kSampleGrid;
    const double low = std::min(position, position + extent) - in_pixel;
    const double high = std::max(position, position + extent) - in_pixel;
    // A sample on the border belongs to the side that the tie rule gives it to, as a clipped edge would.
    const auto pixel = [](double value) {
      return static_cast<std::int32_t>(std::clamp(value, -1.0, 65536.0));
    };
    first = pixel(low_is_in ? std::ceil(low) : std::floor(low) + 1);
    last = pixel(low_is_in ? std::ceil(high) - 1 : std::floor(high));
  };
  PixelRect rect;
  side(viewport.x, viewport.z, sample.x, !owns_right(rule), rect.x_first, rect.x_last);
  side(viewport.y, viewport.w, sample.y, !owns_bottom(rule), rect.y_first, rect.y_last);
  return rect;
}

Conservative conservative(const Command& draw, const Config& config) {
  return draw.fills_triangles() ? config.raster.conservative : Conservative::kOff;
}

int square_reach(const Command& draw, const Config& config) {
  return square_reach(conservative(draw, config), config.raster.uncertainty, config.raster.sub_pixel_bits);
}

bool has_inner_coverage(const Command& draw, const Config& config) {
  return config.raster.inner_coverage && conservative(draw, config) == Conservative::kOuter;
}

WalkerConfig walker_config(const Config& config) {
  return {.sub_pixel_bits = config.raster.sub_pixel_bits,
          .block_size = config.block_walker.block_size,
          .trivial_reject = config.block_walker.trivial_reject,
          .trivial_accept = config.tile_walker.trivial_accept,
          .sample_reject = config.block_walker.sample_reject,
          .levels = config.block_walker.levels,
          .order = config.block_walker.order,
          .tile_order = config.tile_walker.order,
          .samples = sample_pattern(config)};
}

DepthLimits depth_limits(const Command& draw, DepthFormat format) {
  if (format != DepthFormat::kNone && !draw.has(Flag::kDepthClamp) && draw.is_unrestricted(format)) {
    constexpr float kLargest = std::numeric_limits<float>::max();
    return {.least = code_of_depth(format, -kLargest), .most = code_of_depth(format, kLargest)};
  }
  if (format == DepthFormat::kNone || !draw.has(Flag::kDepthClamp)) {
    return {.least = 0, .most = largest_code(format)};
  }
  const auto [least, most] = std::minmax(draw.depth_range.x, draw.depth_range.y);
  return {.least = code_of_depth(format, least), .most = code_of_depth(format, most)};
}

FillRule fill_rule(const Command& draw, const Config& config) {
  switch (config.setup.fill_rule) {
    case FillRuleKey::kDraw:
      break;
    case FillRuleKey::kTopLeft:
    case FillRuleKey::kNormalSign:
      return FillRule::kTopLeft;
    case FillRuleKey::kBottomLeft:
      return FillRule::kBottomLeft;
    case FillRuleKey::kTopRight:
      return FillRule::kTopRight;
    case FillRuleKey::kBottomRight:
      return FillRule::kBottomRight;
  }
  return draw.has(Flag::kBottomLeftRule) ? FillRule::kBottomLeft : FillRule::kTopLeft;
}

namespace {

/// The pixels that a draw may touch: one rectangle for all samples.
PixelRect draw_bounds(const Command& draw, const Target& target, FillRule rule, const Config& config) {
  const PixelRect drawable = drawable_rect(draw.scissor, target);
  const SamplePattern samples = sample_pattern(config);
  // A sample on its pixel's top or left side belongs to the viewport that holds the pixel, whatever the rule.
  const FillRule border = samples.is_centre() ? rule : FillRule::kTopLeft;
  const auto of_sample = [&](const SamplePosition& sample) {
    const PixelRect rect = intersect(drawable, viewport_rect(draw.viewport, border, sample));
    return rect.empty() ? PixelRect{} : rect;
  };
  const PixelRect bounds = of_sample(samples.at[0]);
  for (const SamplePosition& sample : samples.positions()) {
    if (!(of_sample(sample) == bounds)) {
      throw InputError(
          fmt::format("a draw's viewport of {} x {} pixels at ({}, {}) cuts through the samples of a pixel, "
                      "and raster.samples "
                      "is {}; legal: viewports of whole pixels, or raster.samples = 1",
                      draw.viewport.z, draw.viewport.w, draw.viewport.x, draw.viewport.y, samples.count));
    }
  }
  return bounds;
}

/// Throws InputError for lines and points where a pixel has other samples than its centre.
void require_samples_known(const Command& draw, const Config& config) {
  if (!draw.fills_triangles() && !sample_pattern(config).is_centre()) {
    throw InputError(
        fmt::format("a draw of {} indices from {} draws lines or points, and raster.samples is {}; legal for "
                    "such draws: raster.samples = 1, at the pixel centre",
                    draw.index_count, draw.first_index, config.raster.samples));
  }
}

}  // namespace

SetupState setup_state(const Command& draw, const Target& target, DepthFormat format, const Config& config) {
  require_samples_known(draw, config);
  const FillRule rule = fill_rule(draw, config);
  const bool has_faces = draw.primitive == Primitive::kTriangles;
  return {.sub_pixel_bits = config.raster.sub_pixel_bits,
          .front_positive_area = draw.has(Flag::kFrontPositiveArea),
          .cull_front = has_faces && draw.has(Flag::kCullFront),
          .cull_back = has_faces && draw.has(Flag::kCullBack),
          .fill_rule = rule,
          .conservative = conservative(draw, config),
          .square_reach = square_reach(draw, config),
          .inner_coverage = has_inner_coverage(draw, config),
          .bounds = draw_bounds(draw, target, rule, config),
          .depth_format = format,
          .limits = depth_limits(draw, format),
          .interpolator = config.depth.interpolator,
          .hi_z = config.hi_z.enabled,
          .line_rule = draw.line_rule,
          .line_width = thin_width(draw.line_width),
          .samples = sample_pattern(config).box()};
}

SetupState setup_state(const SetupState& draw, const ScreenTriangle& triangle) {
  SetupState state = draw;
  state.bounds = intersect(draw.bounds, triangle.within);
  return state;
}

EarlyZState early_z_state(const Command& draw, DepthFormat format, const Config& config) {
  const bool test = draw.has(Flag::kDepthTest) && format != DepthFormat::kNone;
  const bool to_write = test && draw.has(Flag::kDepthWrite);
  const LateZ mode = tests_late(draw) ? config.late_z.mode : LateZ::kOpaque;
  EarlyZState state{.test = test,
                    .write = to_write && mode != LateZ::kNoWrite,
                    .func = draw.depth_func,
                    .format = format,
                    .interpolator = config.depth.interpolator,
                    .sub_pixel_bits = config.raster.sub_pixel_bits,
                    .square_reach = square_reach(draw, config),
                    .inner_coverage = has_inner_coverage(draw, config),
                    .samples = sample_pattern(config)};
  state.late = state.write && mode == LateZ::kLate && touches_depth(state);
  return state;
}

ShaderDiscard shader_discard(const Config& config) {
  return {.seed = static_cast<std::uint64_t>(config.late_z.seed),
          .share = (static_cast<std::uint64_t>(config.late_z.discard) << 32) / kWholeShare};
}

DrawStatePacket draw_state_packet(const SetupState& setup, const EarlyZState& early_z, const ZSurface& place,
                                  const HiZSurface& blocks, std::uint32_t clear_code) {
  const auto flag = [](bool on) { return static_cast<std::uint8_t>(on ? 1 : 0); };
  DrawStatePacket packet{
      .front_positive_area = flag(setup.front_positive_area),
      .cull_front = flag(setup.cull_front),
      .cull_back = flag(setup.cull_back),
      .fill_rule = static_cast<std::uint8_t>(setup.fill_rule),
      .empty = flag(setup.bounds.empty()),
      .format = static_cast<std::uint8_t>(setup.depth_format),
      .least_code = setup.limits.least,
      .most_code = setup.limits.most,
      .test = flag(early_z.test),
      .write = flag(early_z.write),
      .late = flag(early_z.late),
      .func = static_cast<std::uint8_t>(early_z.func),
      .clear_code = clear_code,
      .first_tile = place.first_tile,
      .tiles_x = static_cast<std::uint16_t>(place.tiles_x == 0 ? 0 : place.tiles_x - 1),
      .first_block = blocks.first_block,
      .blocks_x = static_cast<std::uint16_t>(blocks.blocks_x == 0 ? 0 : blocks.blocks_x - 1)};
  if (!setup.bounds.empty()) {
    packet.x_first = static_cast<std::uint16_t>(setup.bounds.x_first);
    packet.x_last = static_cast<std::uint16_t>(setup.bounds.x_last);
    packet.y_first = static_cast<std::uint16_t>(setup.bounds.y_first);
    packet.y_last = static_cast<std::uint16_t>(setup.bounds.y_last);
  }
  return packet;
}

bool clears_fast(const PixelRect& rect, const Surface& surface, const Config& config) {
  return config.z_cache.fast_clear && rect.x_first == 0 && rect.y_first == 0 &&
         rect.x_last == surface.codes.width() - 1 && rect.y_last == surface.codes.height() - 1;
}

DrawnClear drawn_clear(const PixelRect& rect, std::uint32_t code, DepthFormat format, const Config& config) {
  const std::int64_t z = vertex_depth_of_code(format, code);
  const auto vertex = [&](int x, int y) {
    return ScreenVertex{
        .x = x << config.raster.sub_pixel_bits, .y = y << config.raster.sub_pixel_bits, .z = z};
  };
  const ScreenVertex top_left = vertex(rect.x_first, rect.y_first);
  const ScreenVertex top_right = vertex(rect.x_last + 1, rect.y_first);
  const ScreenVertex bottom_left = vertex(rect.x_first, rect.y_last + 1);
  const ScreenVertex bottom_right = vertex(rect.x_last + 1, rect.y_last + 1);
  return {.triangle = {ScreenTriangle{.v = {top_left, top_right, bottom_left}},
                       ScreenTriangle{.v = {top_right, bottom_right, bottom_left}, .triangle = 1}},
          .setup = {.sub_pixel_bits = config.raster.sub_pixel_bits,
                    .bounds = rect,
                    .depth_format = format,
                    .limits = {.least = code, .most = code},
                    .interpolator = config.depth.interpolator,
                    .hi_z = config.hi_z.enabled,
                    .samples = sample_pattern(config).box()},
          .early_z = {.test = true,
                      .write = true,
                      .func = DepthFunc::kAlways,
                      .format = format,
                      .interpolator = config.depth.interpolator,
                      .sub_pixel_bits = config.raster.sub_pixel_bits,
                      .samples = sample_pattern(config)}};
}

}  // namespace halfspace
