#include "halfspace/whatif/draw_mesh.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <glm/vec4.hpp>
#include <span>
#include <utility>

namespace halfspace {
namespace {

std::span<const std::uint32_t> indices_of(const Frame& frame, const Command& draw) {
  return std::span(frame.indices).subspan(draw.first_index, draw.index_count);
}

bool repeats_an_index(std::span<const std::uint32_t> indices, std::uint32_t vertex_count) {
  std::vector<bool> used(vertex_count);
  for (const std::uint32_t index : indices) {
    if (used[index]) {
      return true;
    }
    used[index] = true;
  }
  return false;
}

/// Equal where the positions are: 0 is the same number with either sign.
std::array<std::uint32_t, 4> position_key(const glm::vec4& v) {
  return {std::bit_cast<std::uint32_t>(v.x + 0.0F), std::bit_cast<std::uint32_t>(v.y + 0.0F),
          std::bit_cast<std::uint32_t>(v.z + 0.0F), std::bit_cast<std::uint32_t>(v.w + 0.0F)};
}

}  // namespace

DrawMesh::DrawMesh(const Frame& frame, const Command& draw) : frame_(frame), draw_(draw) {
  const std::span<const std::uint32_t> indices = indices_of(frame, draw);
  if (repeats_an_index(indices, draw.vertex_count)) {
    return;
  }
  const auto key = [&](std::uint32_t index) {
    return std::pair(position_key(frame.vertices[draw.first_vertex + index]), index);
  };
  std::vector<std::uint32_t> by_position(indices.begin(), indices.end());
  std::ranges::sort(by_position, {}, key);
  first_equal_.resize(draw.vertex_count);
  std::uint32_t first = 0;
  for (const std::uint32_t index : by_position) {
    first = key(first).first == key(index).first ? first : index;
    first_equal_[index] = first;
  }
}

std::array<std::uint32_t, 3> DrawMesh::vertices(std::uint32_t triangle) const {
  std::array<std::uint32_t, 3> v{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t index = frame_.indices[draw_.first_index + std::size_t{3} * triangle + i];
    v[i] = first_equal_.empty() ? index : first_equal_[index];
  }
  return v;
}

bool DrawMesh::share_edge(std::uint32_t a, std::uint32_t b) const {
  const std::array<std::uint32_t, 3> of_b = vertices(b);
  int common = 0;
  // A triangle that is drawn has three different vertices, so none is counted twice.
  for (const std::uint32_t vertex : vertices(a)) {
    common += std::ranges::find(of_b, vertex) != of_b.end() ? 1 : 0;
  }
  return common >= 2;
}

}  // namespace halfspace
