/// How lines, points and polygons of an INPUT are drawn.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "halfspace/scene/frame.hpp"

namespace halfspace {

/// --polygon-mode, --line-rule, --line-width, --line-stipple and --point-size. What is not given stays as the
/// draws have it.
struct DrawOptions {
  std::string polygon_mode;
  std::string line_rule;
  std::optional<float> line_width;
  std::string line_stipple;
  std::optional<float> point_size;

  void add_to(CLI::App& command);
  /// Changes all draws of the frame. Throws OptionError.
  void apply(Frame& frame) const;

 private:
  [[nodiscard]] std::optional<LineStipple> stipple() const;
};

}  // namespace halfspace
