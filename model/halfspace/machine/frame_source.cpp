#include "halfspace/machine/frame_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "halfspace/machine/attribute_source.hpp"
#include "halfspace/machine/surfaces.hpp"
#include "halfspace/numerics/error.hpp"

namespace halfspace {
namespace {

/// Triangles that the front end makes in one go: enough to amortise, few enough to stay in the processor's
/// cache.
constexpr std::uint32_t kFrontEndBatch = 256;

/// Edges of a thin line are no weights, which the barycentric interpolator wants.
void check_thin_lines(const Frame& frame, const Config& config) {
  for (std::size_t i = 0; i < frame.commands.size(); ++i) {
    const Command& command = frame.commands[i];
    if (command.kind == CommandKind::kDraw && command.draws_thin_lines() &&
        frame.targets[command.target].depth_surface != kNoSurface &&
        config.depth.interpolator != DepthInterpolator::kPlane) {
      throw InputError(
          fmt::format("{}: command {} draws lines by the rule {}, and depth.interpolator is barycentric; "
                      "legal with it: plane",
                      frame.name, i, kLineRuleName[static_cast<std::size_t>(command.line_rule)]));
    }
  }
}

}  // namespace

FrameSource::FrameSource(const Frame& frame, const Config& config, PacketObserver* observer,
                         std::vector<Surface>& surfaces, FrameResult& result, std::deque<DrawContext>& draws)
    : frame_(frame),
      config_(config),
      observer_(observer),
      surfaces_(surfaces),
      result_(result),
      draws_(draws) {
  surfaces_of_targets_ = surfaces_of_targets(frame, surfaces);
  depth_written_.assign(surfaces.size(), false);
  unrestricted_.assign(surfaces.size(), false);
  check_thin_lines(frame, config);
  for (const Command& command : frame.commands) {
    const bool is_draw = command.kind == CommandKind::kDraw;
    draws_in_frame_ += is_draw ? 1 : 0;
    const Target& target = frame.targets[command.target];
    if (target.depth_surface == kNoSurface) {
      continue;
    }
    if (is_draw && command.has(Flag::kDepthWrite)) {
      depth_written_[target.depth_surface] = true;
    }
    if (command.is_unrestricted(target.depth_format)) {
      unrestricted_[target.depth_surface] = true;
    }
  }
}

DrawContext* FrameSource::begin(std::uint32_t command) {
  draw_ = nullptr;
  batch_.clear();
  batch_given_ = true;
  front_end_.reset();
  fast_clear_.reset();
  const Command& begun = frame_.commands[command];
  if (begun.kind == CommandKind::kClear) {
    begin_clear(begun);
  } else {
    begin_draw(begun, command);
  }
  return draw_;
}

std::optional<SourceItem> FrameSource::next() {
  if (fast_clear_) {
    return std::exchange(fast_clear_, std::nullopt);
  }
  while (batch_given_ && front_end_ && next_triangle_ < triangle_count_) {
    fill_batch();
  }
  if (!std::exchange(batch_given_, true)) {
    return SourceItem{.draw = draw_, .triangles = batch_};
  }
  if (std::exchange(tell_done_, false)) {
    observer_->draw_done(draws_begun_, draws_in_frame_);
  }
  return std::nullopt;
}

std::optional<RawTriangles> FrameSource::take_raw() {
  if (!front_end_) {
    return std::nullopt;
  }
  next_triangle_ = triangle_count_;
  return RawTriangles{.front_end = &*front_end_, .count = triangle_count_};
}

void FrameSource::fill_batch() {
  batch_.clear();
  for (std::uint32_t i = 0; i < kFrontEndBatch && next_triangle_ < triangle_count_; ++i) {
    front_end_->process(next_triangle_++, batch_, draw_->counters.front_end);
  }
  batch_given_ = batch_.empty();
}

void FrameSource::begin_draw(const Command& command, std::uint32_t index) {
  const Target& target = frame_.targets[command.target];
  const std::uint32_t number = surfaces_of_targets_[command.target];
  Surface& surface = surfaces_[number];
  const DepthFormat format = surface.format;
  DrawContext& draw = draws_.emplace_back();
  draw.draw = draws_begun_++;
  draw.command = index;
  draw.surface = target.depth_surface;
  draw.drawn_on = number;
  draw.first_triangle = first_triangle_;
  draw.setup = setup_state(command, target, format, config_);
  draw.early_z = early_z_state(command, format, config_);
  draw.early_z.unrestricted = unrestricted_[number];
  draw.discard = shader_discard(config_);
  draw.attributes = config_.interpolator.enabled ? config_.interpolator.attributes : 0;
  draw.keeps_visible = !surface.visible.empty() && (draw.early_z.write || !depth_written_[number]);
  draw.sums = surface.sums.empty() ? nullptr : &surface.sums;
  if (observer_ != nullptr) {
    draw.observer = observer_;
    draw.record_quads = observer_->wants_quads();
    draw.record_decisions = observer_->wants_decisions();
    draw.record_jobs = observer_->wants_tile_jobs();
    draw.record_walk = observer_->wants_walk();
    if (draw.attributes != 0 && draw.record_quads) {
      draw.source = std::make_shared<AttributeSource>(frame_, command, config_);
    }
    tell_done_ = true;
  }
  draw_ = &draw;
  if (command.is_skipped()) {
    ++result_.draws_not_filled;
  } else {
    front_end_.emplace(frame_, command, format, config_.raster.sub_pixel_bits, fill_rule(command, config_),
                       square_reach(command, config_), sample_pattern(config_).is_centre());
    triangle_count_ = command.primitive_count();
    next_triangle_ = 0;
  }
  first_triangle_ += command.primitive_count();
}

void FrameSource::begin_clear(const Command& command) {
  const Target& target = frame_.targets[command.target];
  if (!command.has(Flag::kClearDepth) || target.depth_surface == kNoSurface) {
    return;
  }
  ++result_.clears;
  const Surface& surface = surfaces_[target.depth_surface];
  const PixelRect rect = drawable_rect(command.scissor, target);
  const std::uint32_t code = code_of_depth(surface.format, command.clear_depth);
  if (clears_fast(rect, surface, config_)) {
    fast_clear_ = SourceItem{.surface = target.depth_surface, .code = code};
    return;
  }
  if (rect.empty()) {
    return;
  }
  const DrawnClear clear = drawn_clear(rect, code, surface.format, config_);
  DrawContext& draw = draws_.emplace_back();
  draw.surface = target.depth_surface;
  draw.drawn_on = target.depth_surface;
  draw.setup = clear.setup;
  draw.early_z = clear.early_z;
  draw.early_z.unrestricted = unrestricted_[target.depth_surface];
  draw.keeps_visible = !surface.visible.empty();
  draw_ = &draw;
  batch_.assign(clear.triangle.begin(), clear.triangle.end());
  batch_given_ = false;
}

void clear_surface(Surface& surface, std::uint32_t code) {
  const PixelRect all{.x_last = surface.codes.width() - 1, .y_last = surface.codes.height() - 1};
  surface.codes.fill(all, code);
  if (!surface.visible.empty()) {
    surface.visible.fill(all, kNothingVisible);
  }
}

void collect_draws(const std::deque<DrawContext>& draws, FrameResult& result) {
  for (const DrawContext& draw : draws) {
    if (draw.is_clear()) {
      result.drawn_clears += draw.counters;
      result.surfaces[draw.surface].drawn_clears += draw.counters;
      continue;
    }
    result.draws.push_back({.command = draw.command, .surface = draw.surface, .counters = draw.counters});
    result.counters += draw.counters;
    result.surfaces[draw.drawn_on].counters += draw.counters;
  }
}

}  // namespace halfspace
