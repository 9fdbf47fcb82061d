/// The attributes of a PLY file's vertices.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "halfspace/scene/mesh_attributes.hpp"
#include "halfspace/scene/ply_header.hpp"

namespace halfspace::ply {

/// Which properties of an element are attributes. Names as programs write them: nx, ny, nz; red, green, blue
/// and alpha; u and v, s and t, texture_u and texture_v.
class VertexAttributes {
 public:
  VertexAttributes(const Element& vertex, AttributeBuilder& builder);

  [[nodiscard]] bool wants(std::size_t property) const { return slots_[property] != kNone; }
  void take(std::size_t property, double value) { values_[slots_[property]] = value * scales_[property]; }
  /// What was taken belongs to this vertex.
  void store(std::uint32_t vertex);

 private:
  /// One value of a vertex.
  enum Slot : std::uint8_t { kNormal = 0, kColor = 3, kUv = 7, kSlots = 9, kNone = kSlots };

  void find(const Element& vertex, Slot first, const std::vector<const char*>& names);
  [[nodiscard]] bool has(Slot first, std::size_t count) const;

  AttributeBuilder& builder_;
  std::vector<std::uint8_t> slots_;  ///< of each property
  std::vector<double> scales_;       ///< of each property: whole numbers are parts of their type's largest
  std::array<double, kSlots> values_{};
  std::array<bool, kSlots> found_{};
};

}  // namespace halfspace::ply
