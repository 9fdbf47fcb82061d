/// One primitive of a glTF mesh: its triangles, and what places its vertices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "halfspace/scene/gltf/accessor.hpp"
#include "halfspace/scene/gltf/attributes.hpp"
#include "halfspace/scene/gltf/draco.hpp"
#include "halfspace/scene/gltf/skin.hpp"
#include "halfspace/scene/mesh_builder.hpp"

namespace halfspace::gltf {

/// Most vertices, corners and instances, of all that is drawn, that no byte of the file stands for: a few
/// bytes can announce any number of them.
inline constexpr std::uint64_t kMaxBareElements = std::uint64_t{1} << 20;

/// What every part of the reader needs.
struct Source {
  const Document& document;
  Buffers& buffers;
  MeshBuilder& mesh;
  AttributeSource* attributes = nullptr;                                   ///< null where none are wanted
  std::uint64_t bare = 0;                                                  // elements so far
  std::unordered_map<std::uint64_t, std::unique_ptr<DracoMesh>> unpacked;  // by buffer view

  /// Counts elements that are drawn so many times. Throws InputError when there are too many in all.
  void add_bare(std::uint64_t elements, std::uint64_t copies);
};

struct Primitive {
  std::vector<std::uint32_t> vertices;  ///< those that are used, ascending
  std::vector<std::uint32_t> corners;   ///< three a triangle, two a line, one a point: indices of `vertices`
  Accessor positions;
  std::vector<Influences> influences;            ///< none when it has no joints
  std::vector<std::vector<std::byte>> unpacked;  ///< what accessors refer to, if not to buffers
  PrimitiveAttributes attributes;                ///< none where none are wanted
  halfspace::Primitive kind = halfspace::Primitive::kTriangles;  ///< of a strip or loop of lines, the strip
  bool closed = false;                                           ///< a loop: the corners are those of a strip
};

/// Nothing when it has no positions, which is said of the mesh. `copies`: how many times it
/// is drawn.
[[nodiscard]] std::optional<Primitive> read_primitive(Source& source, const Object& primitive,
                                                      std::size_t copies);

}  // namespace halfspace::gltf
