/// A mesh that was read must be consistent and become a valid frame, or be refused as an InputError.
#pragma once

#include <cstdlib>

#include "fuzz_input.hpp"
#include "halfspace/scene/camera.hpp"
#include "halfspace/scene/mesh_attributes.hpp"
#include "halfspace/scene/mesh_formats.hpp"
#include "halfspace/scene/validate.hpp"

namespace halfspace::fuzz {

/// What the shader looks up by corner, vertex or part is there.
inline void check_attributes(const Mesh& mesh, const MeshAttributes& attributes) {
  const auto is_of_all = [](const auto& values, std::size_t all) {
    return values.empty() || values.size() == all;
  };
  if (attributes.vertex_of.size() != mesh.indices.size() ||
      attributes.material_of.size() != mesh.parts.size() ||
      !is_of_all(attributes.uv_of, mesh.indices.size()) ||
      !is_of_all(attributes.normal_of, mesh.indices.size()) ||
      !is_of_all(attributes.colors, mesh.positions.size())) {
    std::abort();
  }
  for (const std::uint32_t material : attributes.material_of) {
    if (material != kNoAttribute && material >= attributes.materials.size()) std::abort();
  }
  for (const Material& material : attributes.materials) {
    if (material.texture && material.texture->image >= attributes.images.size()) std::abort();
  }
}

inline void check_mesh(const Mesh& mesh) {
  std::uint64_t end = 0;
  for (const MeshPart& part : mesh.parts) {
    if (part.first_index != end || part.index_count == 0 ||
        part.index_count % indices_each(part.primitive) != 0)
      std::abort();
    end += part.index_count;
  }
  if (end != mesh.indices.size() || end == 0) std::abort();
  for (const std::uint32_t index : mesh.indices) {
    if (index >= mesh.positions.size()) std::abort();
  }
  if (mesh.attributes != nullptr) check_attributes(mesh, *mesh.attributes);
  const auto frame = read_or_reject([&] { return frame_from_mesh(mesh, Camera{}, "fuzz"); });
  if (frame) validate(*frame);
}

}  // namespace halfspace::fuzz
