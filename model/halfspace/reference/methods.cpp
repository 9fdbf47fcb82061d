#include "halfspace/reference/methods.hpp"

#include <string>

#include "halfspace/numerics/error.hpp"
#include "halfspace/reference/barycentric.hpp"
#include "halfspace/reference/clip_everything.hpp"
#include "halfspace/reference/clipped_triangle.hpp"
#include "halfspace/reference/exact.hpp"
#include "halfspace/reference/float_epsilon.hpp"
#include "halfspace/reference/homogeneous.hpp"
#include "halfspace/reference/incremental.hpp"
#include "halfspace/reference/scanline.hpp"

namespace halfspace::reference {
namespace {

template <CoverageMethod cover>
DrawnTriangle draw_in_guard_band(const ClipTriangle& triangle, const DrawState& draw) {
  return draw_clipped(triangle, draw, guard_band(draw), cover);
}

}  // namespace

const std::array<Method, 7>& methods() {
  static constexpr std::array<Method, 7> kMethods = {
      {{"exact", draw_in_guard_band<cover_exactly>},
       {"barycentric", draw_in_guard_band<cover_barycentrically>, true},
       {"scanline", draw_in_guard_band<cover_by_scanlines>},
       {"incremental", draw_in_guard_band<cover_by_increments>},
       {"float_epsilon", draw_in_guard_band<cover_with_epsilon>},
       {"homogeneous", draw_homogeneously},
       {"clip_everything", draw_clipped_by_everything}}};
  return kMethods;
}

const Method& method_of(std::string_view name) {
  std::string legal;
  for (const Method& method : methods()) {
    if (method.name == name) return method;
    legal += (legal.empty() ? "" : ", ") + std::string(method.name);
  }
  throw OptionError("reference '" + std::string(name) + "' does not exist; legal: " + legal);
}

}  // namespace halfspace::reference
