/// Meshes packed by KHR_draco_mesh_compression.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "halfspace/scene/gltf/accessor.hpp"
#include "halfspace/scene/gltf/object.hpp"

namespace draco {
class Mesh;
}

namespace halfspace::gltf {

class DracoMesh {
 public:
  /// `packed`: the extension's object in the primitive, `bytes`: what its buffer view holds. Throws
  /// InputError when they are damaged, or announce more faces and vertices than such bytes plausibly hold.
  DracoMesh(const Object& packed, std::span<const std::byte> bytes);
  ~DracoMesh();
  DracoMesh(const DracoMesh&) = delete;
  DracoMesh& operator=(const DracoMesh&) = delete;

  /// Three vertices a triangle.
  [[nodiscard]] std::vector<std::uint32_t> corners() const;
  [[nodiscard]] std::size_t vertices() const;

  /// The attribute of this number in the Draco data, as `width` numbers of the type for each vertex.
  [[nodiscard]] std::vector<std::byte> attribute(std::uint64_t id, Component component, unsigned width) const;

 private:
  const Object packed_;
  std::unique_ptr<const draco::Mesh> mesh_;
};

}  // namespace halfspace::gltf
