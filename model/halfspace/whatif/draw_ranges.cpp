#include "halfspace/whatif/draw_ranges.hpp"

#include <algorithm>
#include <initializer_list>

namespace halfspace::whatif {
namespace {

bool has_any(const Command& command, std::initializer_list<Flag> flags) {
  return std::ranges::any_of(flags, [&](Flag flag) { return command.has(flag); });
}

bool keeps_largest(const Command& draw) {
  return draw.depth_func == DepthFunc::kGreater || draw.depth_func == DepthFunc::kGequal;
}

}  // namespace

bool keeps_least(const Command& draw) {
  return draw.depth_func == DepthFunc::kLess || draw.depth_func == DepthFunc::kLequal;
}

bool may_move(const Frame& frame, const Command& command) {
  return command.kind == CommandKind::kDraw && command.fills_triangles() &&
         frame.targets[command.target].depth_surface != kNoSurface && command.has(Flag::kDepthTest) &&
         command.has(Flag::kDepthWrite) && (keeps_least(command) || keeps_largest(command)) &&
         !has_any(command, {Flag::kBlend, Flag::kShaderDiscards, Flag::kShaderWritesDepth, Flag::kStencilTest,
                            Flag::kAlphaToCoverage, Flag::kNotFilled, Flag::kShaderSideEffects});
}

bool shades(const Command& draw) {
  return has_any(draw, {Flag::kColorWrite, Flag::kShaderDiscards, Flag::kShaderWritesDepth,
                        Flag::kAlphaToCoverage, Flag::kShaderSideEffects});
}

std::vector<DrawRange> draw_ranges(const Frame& frame) {
  std::vector<DrawRange> ranges;
  for (std::size_t i = 0; i < frame.commands.size(); ++i) {
    const Command& draw = frame.commands[i];
    if (!may_move(frame, draw)) {
      continue;
    }
    const bool goes_on = !ranges.empty() && ranges.back().last == i &&
                         draw.target == frame.commands[i - 1].target &&
                         keeps_least(draw) == keeps_least(frame.commands[i - 1]);
    if (goes_on) {
      ++ranges.back().last;
    } else {
      ranges.push_back({.first = i, .last = i + 1});
    }
  }
  return ranges;
}

}  // namespace halfspace::whatif
