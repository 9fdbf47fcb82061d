/// What the shader of a draw gets of the interpolator: the attributes of the input at each quad.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "halfspace/config/config.hpp"
#include "halfspace/machine/attribute_planes.hpp"
#include "halfspace/machine/packet_observer.hpp"
#include "halfspace/scene/frame.hpp"
#include "halfspace/scene/front_end.hpp"

namespace halfspace {

/// The rows of a triangle, as many as the draw's shader reads (`interpolator.attributes`). Those of a mesh
/// come first: its colours, texture coordinates and normals, each where it has them, 0 at a triangle without.
/// All others are the coordinates of the pixel in the triangle: 1 at vertex i in component i.
///
/// Lines, points and outlines have the attributes of their first vertex everywhere.
class AttributeSource {
 public:
  /// Of a draw of the frame, which must outlive it.
  AttributeSource(const Frame& frame, const Command& draw, const Config& config);

  /// The attributes of the quad whose top left pixel is (x, y), in order, at one sample of its pixels.
  /// `triangle`, `piece`: as in SetupTriangle. `passed`: samples that the depth test left; the others are
  /// helpers.
  [[nodiscard]] std::vector<QuadAttribute> quad(std::uint32_t triangle, std::uint8_t piece, int x, int y,
                                                std::uint8_t sample, std::uint8_t passed) const;

 private:
  /// Of the triangle that was asked for last: quads of one come together.
  struct Rows {
    std::uint32_t triangle;
    AttributePlanes planes;                             ///< of nothing where the primitive is no triangle
    std::vector<std::array<glm::dvec4, 3>> attributes;  ///< at the vertices
  };
  const Rows& rows(std::uint32_t triangle) const;
  [[nodiscard]] std::vector<std::array<glm::dvec4, 3>> attributes(std::uint32_t triangle) const;

  const Frame& frame_;
  const Command& draw_;
  Config config_;
  SamplePattern samples_;
  FrontEnd front_end_;
  mutable std::optional<Rows> rows_;
};

}  // namespace halfspace
