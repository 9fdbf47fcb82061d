#include "halfspace/cli/draw_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <type_traits>

#include "halfspace/cli/known_words.hpp"
#include "halfspace/numerics/error.hpp"

namespace halfspace {
namespace {

/// Sets `field` to the value of that name, if one is given.
template <class Value, class Names>
void set(Value& field, const std::string& name, const Names& names) {
  if (!name.empty()) {
    field = static_cast<Value>(std::ranges::find(names, name) - names.begin());
  }
}

template <class Value>
void set(Value& field, const std::optional<std::type_identity_t<Value>>& value) {
  field = value.value_or(field);
}

bool parse(std::string_view text, int base, std::uint16_t& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  return !text.empty() && error == std::errc{} && end == text.data() + text.size();
}

void check_extent(const char* option, const std::optional<float>& value, int most) {
  if (value && !(*value > 0 && *value <= static_cast<float>(most))) {
    throw OptionError(fmt::format("{} is {}; legal: above 0, at most {}", option, *value, most));
  }
}

}  // namespace

void DrawOptions::add_to(CLI::App& command) {
  constexpr const char* kGroup = "Lines and points, of all draws of INPUT";
  command.add_option("--polygon-mode", polygon_mode, "how triangles are drawn")
      ->check(one_of_table(kPolygonModeName))
      ->group(kGroup);
  command.add_option("--line-rule", line_rule, "by which rule a line becomes pixels")
      ->check(one_of_table(kLineRuleName))
      ->group(kGroup);
  command.add_option("--line-width", line_width, "of lines; only rectangular ones have a fraction")
      ->type_name("PIXELS")
      ->group(kGroup);
  command
      .add_option(
          "--line-stipple", line_stipple,
          "draw a fragment of a line if its bit in the pattern is 1, each bit for FACTOR fragments, the "
          "lowest first")
      ->type_name("FACTOR:HEX_PATTERN")
      ->group(kGroup);
  command.add_option("--point-size", point_size, "side of the square that a point is")
      ->type_name("PIXELS")
      ->group(kGroup);
}

std::optional<LineStipple> DrawOptions::stipple() const {
  if (line_stipple.empty()) {
    return std::nullopt;
  }
  const std::string_view text = line_stipple;
  const std::size_t colon = text.find(':');
  LineStipple stipple;
  if (colon == std::string_view::npos || !parse(text.substr(0, colon), 10, stipple.factor) ||
      !parse(text.substr(colon + 1), 16, stipple.pattern) || stipple.factor < 1 ||
      stipple.factor > kMaxStippleFactor) {
    throw OptionError(fmt::format(
        "--line-stipple is '{}'; it must be FACTOR:PATTERN, FACTOR 1 to {}, PATTERN four hexadecimal "
        "digits",
        line_stipple, kMaxStippleFactor));
  }
  return stipple;
}

void DrawOptions::apply(Frame& frame) const {
  check_extent("--line-width", line_width, kMaxLineWidth);
  check_extent("--point-size", point_size, kMaxPointSize);
  const std::optional<LineStipple> given = stipple();
  for (Command& command : frame.commands) {
    if (command.kind != CommandKind::kDraw) {
      continue;
    }
    set(command.polygon_mode, polygon_mode, kPolygonModeName);
    if (!polygon_mode.empty()) {
      command.flags &= ~static_cast<std::uint32_t>(Flag::kNotFilled);
      command.flags |= command.polygon_mode == PolygonMode::kFill ? 0 : bits({Flag::kNotFilled});
    }
    set(command.line_rule, line_rule, kLineRuleName);
    set(command.line_width, line_width);
    set(command.stipple, given);
    set(command.point_size, point_size);
  }
}

}  // namespace halfspace
