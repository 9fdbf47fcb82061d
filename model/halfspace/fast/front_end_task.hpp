/// Front end and setup of the fast core: a triangle a lane.
#pragma once

#include <cstdint>
#include <glm/vec4.hpp>

#include "halfspace/fast/set_up.hpp"
#include "halfspace/fast/vertex_chunk.hpp"
#include "halfspace/units/counters.hpp"
#include "halfspace/units/setup.hpp"

namespace halfspace::fast {

/// What front end (scene/front_end.hpp) and setup know of a draw.
struct FrontEndTask {
  static constexpr double kGuardBand = 32767;

  const glm::vec4* vertices = nullptr;     ///< of the draw
  const std::uint32_t* indices = nullptr;  ///< of the draw
  double viewport_x = 0;
  double viewport_y = 0;
  double viewport_width = 0;
  double viewport_height = 0;
  double x_half = 0;  ///< of the viewport
  double y_half = 0;
  double x_centre = 0;
  double y_centre = 0;
  double sub_pixels = 0;
  bool clips_depth = false;  ///< against near and far
  bool symmetric = false;    ///< near is z = -w
  bool has_depth = false;    ///< a depth equation is made
  bool is_float = false;     ///< of float32
  double z_scale = 0;
  double z_bias = 0;
  double z_least = 0;
  double z_most = 0;
  double depth_one = 0;    ///< vertex depth of 1
  int fraction = 0;        ///< bits of a vertex depth below a code
  std::int32_t least = 0;  ///< vertex depths of the draw's limits
  std::int32_t most = 0;
  std::int32_t most_extent =
      0;  ///< width and height together of a triangle that the raster kernels take, in sub-pixels
  SetupState setup;
};

/// Takes triangles `first` to `end` - 1 of the draw as long as they are for vectors and there is room.
/// Returns the first that it has not taken. `chunk` is empty before the first call for a draw.
std::uint32_t set_up(const FrontEndTask& task, std::uint32_t first, std::uint32_t end, VertexChunk& chunk,
                     SetUpTriangles& out, FrontEndCounters& front_end, SetupCounters& setup);

}  // namespace halfspace::fast
