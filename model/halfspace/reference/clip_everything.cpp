#include "halfspace/reference/clip_everything.hpp"

#include "halfspace/reference/clipped_triangle.hpp"
#include "halfspace/reference/incremental.hpp"

namespace halfspace::reference {

DrawnTriangle draw_clipped_by_everything(const ClipTriangle& triangle, const DrawState& draw) {
  std::vector<Homogeneous> planes = {{1, 0, 0, 1}, {-1, 0, 0, 1}, {0, 1, 0, 1}, {0, -1, 0, 1}};
  if (!draw.command.has(Flag::kDepthClamp)) {
    for (const Homogeneous& plane : depth_planes(draw.command.has(Flag::kNdcZMinusOneToOne))) {
      planes.push_back(plane);
    }
  }
  return draw_clipped(triangle, draw, planes, cover_by_increments);
}

}  // namespace halfspace::reference
