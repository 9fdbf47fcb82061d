/// Which triangles of a draw are neighbours in its mesh.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "halfspace/scene/frame.hpp"

namespace halfspace {

/// The vertices of a draw's triangles. A vertex is its index. Where no index of the draw occurs twice it is a
/// list without indices, and vertices of equal clip-space position are one.
class DrawMesh {
 public:
  /// `frame` must be valid and outlive the mesh.
  DrawMesh(const Frame& frame, const Command& draw);

  /// Whether two triangles have two vertices in common: an edge, or, where clipping cut one triangle into
  /// several, all three.
  [[nodiscard]] bool share_edge(std::uint32_t a, std::uint32_t b) const;

 private:
  [[nodiscard]] std::array<std::uint32_t, 3> vertices(std::uint32_t triangle) const;

  const Frame& frame_;
  const Command& draw_;
  std::vector<std::uint32_t>
      first_equal_;  ///< by index, the first of equal position; empty where indices tell
};

}  // namespace halfspace
