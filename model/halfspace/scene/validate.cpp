#include "halfspace/scene/validate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "halfspace/numerics/error.hpp"

namespace halfspace {
namespace {

/// Throws with the place (frame and target or command) in front.
class Place {
 public:
  Place(const Frame& frame, std::string_view what, std::size_t index, std::string_view kind = "")
      : frame_(frame), what_(what), index_(index), kind_(kind) {}

  template <typename... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> text, Args&&... args) const {
    throw InputError(fmt::format("{}: {} {}{}: {}", frame_.name, what_, index_, kind_,
                                 fmt::format(text, std::forward<Args>(args)...)));
  }

 private:
  const Frame& frame_;
  std::string_view what_;
  std::size_t index_;
  std::string_view kind_;
};

void check_size(const Place& place, std::string_view field, std::uint32_t value) {
  if (value < 1 || value > kMaxTargetSize) {
    place.fail("{} is {}; legal: 1 to {}", field, value, kMaxTargetSize);
  }
}

void check_format(const Place& place, DepthFormat format) {
  switch (format) {
    case DepthFormat::kNone:
    case DepthFormat::kUnorm16:
    case DepthFormat::kUnorm24:
    case DepthFormat::kFloat32:
      return;
    case DepthFormat::kUnorm32:
      break;
  }
  place.fail("depth_format is {}{}; legal: 1 (unorm16), 2 (unorm24), 4 (float32), or 0 (none)",
             static_cast<std::uint32_t>(format), format == DepthFormat::kUnorm32 ? " (unorm32)" : "");
}

void check_surface_number(const Place& place, const Target& target) {
  if (target.depth_format == DepthFormat::kNone) {
    if (target.depth_surface != kNoSurface) {
      place.fail("depth_surface is {} without a depth format; legal: {} (none)", target.depth_surface,
                 kNoSurface);
    }
  } else if (target.depth_surface > kMaxDepthSurface) {
    place.fail("depth_surface is {}; legal: 0 to {} with a depth format", target.depth_surface,
               kMaxDepthSurface);
  }
}

void check_targets(const Frame& frame) {
  constexpr std::size_t kUnseen = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> owner(kMaxDepthSurface + 1, kUnseen);  // the first target of each surface
  std::uint64_t pixels = 0;
  for (std::size_t i = 0; i < frame.targets.size(); ++i) {
    const Target& target = frame.targets[i];
    const Place place(frame, "target", i);
    check_size(place, "width", target.width);
    check_size(place, "height", target.height);
    if (target.samples != 1) {
      place.fail("samples is {}; legal: 1 (multisampling is not modelled)", target.samples);
    }
    check_format(place, target.depth_format);
    check_surface_number(place, target);
    if (target.depth_surface == kNoSurface) continue;
    std::size_t& first = owner[target.depth_surface];
    if (first == kUnseen) {
      first = i;
      pixels += std::uint64_t{target.width} * target.height;
      if (pixels > kMaxDepthPixels) {
        place.fail("depth surfaces up to here have {} pixels; legal: at most {} in all", pixels,
                   kMaxDepthPixels);
      }
      continue;
    }
    const Target& other = frame.targets[first];
    if (target.depth_format != other.depth_format) {
      place.fail("depth_format is {} on depth surface {}; legal: {}, as in target {}",
                 static_cast<std::uint32_t>(target.depth_format), target.depth_surface,
                 static_cast<std::uint32_t>(other.depth_format), first);
    }
    if (target.width != other.width || target.height != other.height) {
      place.fail("size is {}x{} on depth surface {}; legal: {}x{}, as in target {}", target.width,
                 target.height, target.depth_surface, other.width, other.height, first);
    }
  }
}

void check_finite(const Place& place, std::string_view field, float value) {
  if (!std::isfinite(value)) place.fail("{} is {}; legal: a finite number", field, value);
}

void check_unit(const Place& place, std::string_view field, float value) {
  if (!(value >= 0 && value <= 1)) place.fail("{} is {}; legal on a unorm surface: 0 to 1", field, value);
}

void check_state(const Place& place, const Command& command, DepthFormat format) {
  check_finite(place, "viewport.x", command.viewport.x);
  check_finite(place, "viewport.y", command.viewport.y);
  check_finite(place, "viewport.width", command.viewport.z);
  check_finite(place, "viewport.height", command.viewport.w);
  const bool is_unorm = unorm_bits(format) != 0;
  const auto check_depth = is_unorm ? check_unit : check_finite;
  check_depth(place, "depth_range.near", command.depth_range.x);
  check_depth(place, "depth_range.far", command.depth_range.y);
  check_finite(place, "clear_depth", command.clear_depth);
  check_finite(place, "offset_factor", command.offset_factor);
  check_finite(place, "offset_units", command.offset_units);
  check_finite(place, "offset_clamp", command.offset_clamp);
  if (command.scissor.width < 0) {
    place.fail("scissor.width is {}; legal: 0 to {}", command.scissor.width,
               std::numeric_limits<std::int32_t>::max());
  }
  if (command.scissor.height < 0) {
    place.fail("scissor.height is {}; legal: 0 to {}", command.scissor.height,
               std::numeric_limits<std::int32_t>::max());
  }
}

/// first + count within size, in 64 bits.
void check_range(const Place& place, std::string_view first_field, std::uint32_t first,
                 std::string_view count_field, std::uint32_t count, std::size_t size) {
  const std::uint64_t end = std::uint64_t{first} + count;
  if (end > size) {
    place.fail("{} + {} is {} + {} = {}; legal: at most {}", first_field, count_field, first, count, end,
               size);
  }
}

/// `names`: a table with an entry for each value.
void check_name(const Place& place, std::string_view field, std::uint32_t value, std::size_t names) {
  if (value >= names) place.fail("{} is {}; legal: 0 to {}", field, value, names - 1);
}

void check_extent(const Place& place, std::string_view field, float value, int most) {
  if (!(value > 0 && value <= static_cast<float>(most))) {
    place.fail("{} is {}; legal: above 0, at most {}", field, value, most);
  }
}

/// How lines and points are drawn.
void check_lines(const Place& place, const Command& draw) {
  check_name(place, "primitive", static_cast<std::uint32_t>(draw.primitive), kPrimitiveName.size());
  check_name(place, "polygon_mode", static_cast<std::uint32_t>(draw.polygon_mode), kPolygonModeName.size());
  check_name(place, "line_rule", static_cast<std::uint32_t>(draw.line_rule), kLineRuleName.size());
  check_extent(place, "line_width", draw.line_width, kMaxLineWidth);
  check_extent(place, "point_size", draw.point_size, kMaxPointSize);
  if (draw.stipple.factor < 1 || draw.stipple.factor > kMaxStippleFactor) {
    place.fail("stipple factor is {}; legal: 1 to {}", draw.stipple.factor, kMaxStippleFactor);
  }
}

void check_draw(const Place& place, const Frame& frame, const Command& draw) {
  if (static_cast<std::uint32_t>(draw.depth_func) > static_cast<std::uint32_t>(DepthFunc::kAlways)) {
    place.fail("depth_func is {}; legal: 0 to 7", static_cast<std::uint32_t>(draw.depth_func));
  }
  if (draw.has(Flag::kDepthWrite) && !draw.has(Flag::kDepthTest)) {
    place.fail("flags are {:#x}, depth_write without depth_test; legal: depth_write only with depth_test",
               draw.flags);
  }
  check_lines(place, draw);
  if (draw.index_count % draw.indices_each() != 0) {
    place.fail("index_count is {}; legal: a multiple of {}", draw.index_count, draw.indices_each());
  }
  check_range(place, "first_index", draw.first_index, "index_count", draw.index_count, frame.indices.size());
  check_range(place, "first_vertex", draw.first_vertex, "vertex_count", draw.vertex_count,
              frame.vertices.size());

  const auto indices = std::span(frame.indices).subspan(draw.first_index, draw.index_count);
  std::uint32_t largest = 0;
  for (const std::uint32_t index : indices) largest = std::max(largest, index);
  if (indices.empty() || largest < draw.vertex_count) return;
  const auto bad = std::find_if(indices.begin(), indices.end(),
                                [&](std::uint32_t index) { return index >= draw.vertex_count; });
  const auto position = bad - indices.begin();
  if (draw.vertex_count == 0) place.fail("index {} is {}; legal: none, vertex_count is 0", position, *bad);
  place.fail("index {} is {}; legal: 0 to {}", position, *bad, draw.vertex_count - 1);
}

}  // namespace

void validate(const Frame& frame) {
  check_targets(frame);
  std::uint64_t triangles = 0;
  std::vector<bool> drawn_to(frame.targets.size(), false);
  std::uint64_t bare_pixels = 0;
  for (std::size_t i = 0; i < frame.commands.size(); ++i) {
    const Command& command = frame.commands[i];
    const bool draw = command.kind == CommandKind::kDraw;
    const bool clear = command.kind == CommandKind::kClear;
    const Place place(frame, "command", i, draw ? " (draw)" : clear ? " (clear)" : "");
    if (!draw && !clear) {
      place.fail("kind is {}; legal: 1 (draw) or 2 (clear)", static_cast<std::uint32_t>(command.kind));
    }
    if (frame.targets.empty()) {
      place.fail("target is {}; legal: none, the frame has no target", command.target);
    }
    if (command.target >= frame.targets.size()) {
      place.fail("target is {}; legal: 0 to {}", command.target, frame.targets.size() - 1);
    }
    check_state(place, command, frame.targets[command.target].depth_format);
    if (!draw) continue;
    check_draw(place, frame, command);
    triangles += command.primitive_count();
    if (triangles > kMaxFrameTriangles) {
      place.fail("triangles up to here are {}; legal: at most {} in a frame", triangles, kMaxFrameTriangles);
    }
    const Target& target = frame.targets[command.target];
    if (target.depth_surface != kNoSurface || drawn_to[command.target]) continue;
    drawn_to[command.target] = true;
    bare_pixels += std::uint64_t{target.width} * target.height;
    if (bare_pixels > kMaxBarePixels) {
      place.fail(
          "targets without depth that are drawn to up to here have {} pixels; legal: at most {} in all",
          bare_pixels, kMaxBarePixels);
    }
  }
}

}  // namespace halfspace
