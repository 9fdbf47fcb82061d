/// An image and its smaller copies, and how a shader reads them.
///
/// Levels and their filter follow the Vulkan 1.3 specification, section 16 (image operations): bilinear in a
/// level, linear between two, the level from the derivatives of the coordinates in texels.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "halfspace/scene/image.hpp"
#include "halfspace/scene/mesh_attributes.hpp"

namespace halfspace {

class MipMap {
 public:
  /// Each level has half the texels on a side of the one before, rounded down, but not below 1; a texel is
  /// the mean of the texels of the level before that it lies over, of light, not of stored values.
  explicit MipMap(const Image& image);

  [[nodiscard]] std::size_t levels() const { return levels_.size(); }
  [[nodiscard]] const Image& level(std::size_t number) const { return levels_[number]; }

  /// log2 of the texels of level 0 that one pixel spans, in the direction in which it spans most; below 0
  /// where texels are larger than pixels. Derivatives of the coordinates to the right and down.
  [[nodiscard]] float level_of(glm::vec2 right, glm::vec2 down) const;

  /// Light and alpha at the coordinates. A level that is not there is the nearest that is.
  [[nodiscard]] glm::vec4 sample(glm::vec2 uv, float level, const Texture& texture) const;

 private:
  std::vector<Image> levels_;
};

/// The squares that meshes with texture coordinates and no image are shown with: 8 to a unit.
[[nodiscard]] Image checker_image();

}  // namespace halfspace
