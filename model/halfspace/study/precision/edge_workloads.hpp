/// What the arithmetics of the edge function draw.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "halfspace/study/precision/float_triangle.hpp"

namespace halfspace::study {

struct PlacedTriangle {
  FloatTriangle triangle;
  PixelRect within;  ///< the pixels that may be drawn
};

/// Triangles on one target.
struct Drawing {
  PixelRect target;
  std::vector<PlacedTriangle> triangles;
};

/// Drawing `index` of a family.
struct EdgeFamily {
  std::string name;
  std::string looks;
  bool partition = false;  ///< each pixel of the target belongs to one triangle
  std::function<Drawing(std::uint64_t index)> draw;
};

/// Squares of `cell` pixels, each cut in two by either diagonal, from (first, first) on over `cells` x
/// `cells` squares; corners inside are moved by up to `jitter` of a cell each way.
[[nodiscard]] Drawing jittered_mesh(std::int64_t first, int cells, int cell, double jitter,
                                    std::uint64_t seed);

/// Those of the stress campaign whose triangles are defined, and meshes of floats.
[[nodiscard]] std::vector<EdgeFamily> edge_families(std::uint64_t seed);

/// The triangles of a frame that face the camera's way, by target, as the front end has them before it snaps:
/// to 1/65536 pixel, then rounded to float32. The tie rule is taken to be top-left. Throws InputError.
[[nodiscard]] std::vector<Drawing> frame_drawings(const std::filesystem::path& path);

}  // namespace halfspace::study
