/// A mesh that was read must be consistent and become a valid frame, or be refused as an InputError.
#pragma once

#include <cstdlib>

#include "fuzz_input.hpp"
#include "halfspace/scene/camera.hpp"
#include "halfspace/scene/mesh_formats.hpp"
#include "halfspace/scene/validate.hpp"

namespace halfspace::fuzz {

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
  const auto frame = read_or_reject([&] { return frame_from_mesh(mesh, Camera{}, "fuzz"); });
  if (frame) validate(*frame);
}

}  // namespace halfspace::fuzz
