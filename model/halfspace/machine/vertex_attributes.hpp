/// Attributes of a mesh at the three vertices of a triangle.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "halfspace/scene/frame.hpp"

namespace halfspace {

/// None where one of the vertices has none.
using AtVertices = std::optional<std::array<glm::dvec4, 3>>;

inline glm::dvec4 widened(const glm::vec2& v) { return {v.x, v.y, 0, 0}; }
inline glm::dvec4 widened(const glm::vec3& v) { return {v.x, v.y, v.z, 0}; }
inline glm::dvec4 widened(const glm::vec4& v) { return v; }

/// The first corner of a primitive of a mesh's draw: its place in MeshAttributes::vertex_of.
inline std::size_t first_corner(const Command& draw, std::uint32_t primitive) {
  const bool strip = draw.primitive == Primitive::kLineStrip;
  return draw.first_index + std::size_t{strip ? 2 : draw.indices_each()} * primitive;
}

/// `which`: by corner, the value's number. None where the corner has none, or one that is not finite.
template <typename Value>
std::optional<glm::dvec4> at_corner(const std::vector<Value>& values, const std::vector<std::uint32_t>& which,
                                    std::size_t corner) {
  const std::uint32_t number = which[corner];
  if (number >= values.size()) {
    return std::nullopt;
  }
  const glm::dvec4 found = widened(values[number]);
  return std::isfinite(found.x + found.y + found.z + found.w) ? std::optional(found) : std::nullopt;
}

/// `corner`: the first of the triangle.
template <typename Value>
AtVertices at_vertices(const std::vector<Value>& values, const std::vector<std::uint32_t>& which,
                       std::size_t corner) {
  std::array<glm::dvec4, 3> found;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<glm::dvec4> value = at_corner(values, which, corner + i);
    if (!value) {
      return std::nullopt;
    }
    found[i] = *value;
  }
  return found;
}

}  // namespace halfspace
