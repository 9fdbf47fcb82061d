#include "halfspace/scene/magnify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include "halfspace/numerics/error.hpp"
#include "halfspace/numerics/line_rule.hpp"
#include "halfspace/scene/validate.hpp"

namespace halfspace {
namespace {

/// Throws InputError where `value` is above `most`.
void check_most(const Frame& frame, const std::string& what, double value, double most, int times) {
  if (value > most) {
    throw InputError(fmt::format("{}: {} is {} when {} times as large; legal: at most {}", frame.name, what,
                                 value, times, most));
  }
}

std::int32_t saturated(std::int64_t value) {
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(value, std::numeric_limits<std::int32_t>::min(),
                                                            std::numeric_limits<std::int32_t>::max()));
}

/// Lines and points of a draw.
void magnify_primitives(const Frame& frame, Command& draw, const std::string& name, int times) {
  const auto by = static_cast<float>(times);
  if (draw.draws_lines()) {
    draw.line_width *= by;
    check_most(frame, name + ".line_width", draw.line_width, kMaxLineWidth, times);
    if (!draw.stipple.draws_all()) {
      const int factor = draw.stipple.factor * times;
      check_most(frame, name + ".stipple.factor", factor, kMaxStippleFactor, times);
      draw.stipple.factor = static_cast<std::uint16_t>(factor);
    }
  }
  draw.point_size *= by;
  if (draw.primitive == Primitive::kPoints || draw.polygon_mode == PolygonMode::kPoint) {
    check_most(frame, name + ".point_size", draw.point_size, kMaxPointSize, times);
  }
}

}  // namespace

void magnify(Frame& frame, int times) {
  for (std::size_t i = 0; i < frame.targets.size(); ++i) {
    Target& target = frame.targets[i];
    for (std::uint32_t* side : {&target.width, &target.height}) {
      *side *= static_cast<std::uint32_t>(times);
      check_most(frame, fmt::format("a side of target {}", i), *side, kMaxTargetSize, times);
    }
  }
  const auto by = static_cast<float>(times);
  for (std::size_t i = 0; i < frame.commands.size(); ++i) {
    Command& command = frame.commands[i];
    command.viewport *= by;
    command.offset_factor *= by;
    for (std::int32_t* number :
         {&command.scissor.x, &command.scissor.y, &command.scissor.width, &command.scissor.height}) {
      *number = saturated(std::int64_t{*number} * times);
    }
    if (command.kind == CommandKind::kDraw) {
      magnify_primitives(frame, command, fmt::format("command {}", i), times);
    }
  }
  frame.magnified *= times;
  validate(frame);
}

}  // namespace halfspace
