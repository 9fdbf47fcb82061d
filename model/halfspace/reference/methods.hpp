/// The reference rasterizers by name.
#pragma once

#include <array>
#include <string_view>

#include "halfspace/reference/triangle_method.hpp"

namespace halfspace::reference {

struct Method {
  std::string_view name;
  TriangleMethod draw;
  bool has_colors = false;  ///< its fragments have the colours of the vertices
};

/// All of them.
[[nodiscard]] const std::array<Method, 7>& methods();

/// The method of this name. Throws InputError, with the legal names.
[[nodiscard]] const Method& method_of(std::string_view name);

}  // namespace halfspace::reference
