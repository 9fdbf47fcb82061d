// glTF 2 and GLB: the scene's nodes, and what they draw (docs/adr/0003-mesh-readers.md). Each kind of thing
// in a glTF file has a reader in the folder gltf.
#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "halfspace/scene/gltf/animation.hpp"
#include "halfspace/scene/gltf/attributes.hpp"
#include "halfspace/scene/gltf/buffers.hpp"
#include "halfspace/scene/gltf/cameras.hpp"
#include "halfspace/scene/gltf/document.hpp"
#include "halfspace/scene/gltf/extensions.hpp"
#include "halfspace/scene/gltf/instancing.hpp"
#include "halfspace/scene/gltf/morph.hpp"
#include "halfspace/scene/gltf/nodes.hpp"
#include "halfspace/scene/gltf/primitive.hpp"
#include "halfspace/scene/gltf/skin.hpp"
#include "halfspace/scene/mesh_builder.hpp"
#include "halfspace/scene/mesh_formats.hpp"

namespace halfspace {
namespace gltf {
namespace {

class SceneReader {
 public:
  SceneReader(const Document& document, Buffers& buffers, MeshBuilder& mesh, AttributeSource* attributes)
      : document_(document),
        source_{document, buffers, mesh, attributes, 0, {}},
        poses_(poses_at_start(document, buffers, mesh)),
        nodes_(document, poses_) {}

  void run() {
    for (const std::size_t node : nodes_.shown(source_.mesh)) {
      const Object object = document_.get(kNodes, node);
      if (const auto camera = document_.find_index(kCameras, object, "camera")) {
        source_.mesh.add_camera(read_camera(document_, *camera, object, nodes_.world(node)));
      }
      if (const auto mesh = document_.find_index(kMeshes, object, "mesh")) add_mesh(*mesh, node, object);
    }
  }

 private:
  void add_mesh(std::size_t index, std::size_t node, const Object& object) {
    const Object mesh = document_.get(kMeshes, index);
    const auto pose = poses_.find(node);
    const std::vector<double> weights =
        morph_weights(object, mesh, pose == poses_.end() ? Pose{} : pose->second);
    const auto skin = document_.find_index(kSkins, object, "skin");
    std::optional<Instances> instances;
    if (const auto instancing = object.extension("EXT_mesh_gpu_instancing")) {
      instances.emplace(document_, source_.buffers, *instancing);
      source_.add_bare(instances->bare(), 1);
    }
    for (std::size_t number = 0; number < mesh.count("primitives"); ++number) {
      const Object primitive = mesh.item("primitives", number);
      auto drawn = read_primitive(source_, primitive, instances ? instances->count() : 1);
      if (drawn) {
        morph_normals(*drawn, primitive, weights);
        const Morph morph(document_, source_.buffers, primitive, weights, drawn->positions.count());
        if (skin && !drawn->influences.empty()) {
          if (instances && instances->count() > 1) {
            source_.mesh.leave_out("instances of skinned meshes", instances->count() - 1);
          }
          add_skinned(*drawn, morph, *skin);
        } else {
          if (skin) source_.mesh.leave_out("skins of primitives without joints");
          add_placed(*drawn, morph, nodes_.world(node), instances);
        }
      }
      source_.mesh.end_part(part_name(mesh, index, primitive, number));
      if (source_.attributes != nullptr) {
        const std::uint32_t material = drawn ? drawn->attributes.material.number : kNoAttribute;
        source_.attributes->builder.end_parts(source_.mesh.part_count(), material);
      }
    }
  }

  void morph_normals(Primitive& drawn, const Object& primitive, const std::vector<double>& weights) {
    if (!drawn.attributes.normals) return;
    try {
      drawn.attributes.morphed_normals.emplace(document_, source_.buffers, primitive, weights,
                                               drawn.positions.count(), "NORMAL");
    } catch (const InputError&) {
      source_.mesh.leave_out("morph targets of normals that cannot be read");
    }
  }

  [[nodiscard]] std::string part_name(const Object& mesh, std::size_t index, const Object& primitive,
                                      std::size_t number) const {
    const std::string mesh_name = mesh.text_or("name", "");
    const std::string name = mesh_name.empty() ? fmt::format("mesh {}", index) : mesh_name;
    const auto material = document_.find_index(kMaterials, primitive, "material");
    if (!material) return fmt::format("{}, primitive {}", name, number);
    const std::string material_name = document_.get(kMaterials, *material).text_or("name", "");
    return fmt::format("{}, {}", name,
                       material_name.empty() ? fmt::format("material {}", *material) : material_name);
  }

  void add_skinned(const Primitive& primitive, const Morph& morph, std::size_t skin) {
    const auto found = skins_.find(skin);
    Skin& joints =
        found != skins_.end()
            ? found->second
            : skins_.try_emplace(skin, source_.document, source_.buffers, nodes_, skin).first->second;
    check_room(primitive, 1);
    add_copy(
        primitive,
        [&](std::uint32_t vertex) {
          const glm::dvec3 position = primitive.positions.vec3(vertex) + morph.displacement(vertex);
          return joints.place(primitive.influences, vertex, position);
        },
        [&](std::uint32_t vertex) { return normal_matrix(joints.blended(primitive.influences, vertex)); });
  }

  void add_placed(const Primitive& primitive, const Morph& morph, const glm::dmat4& world,
                  const std::optional<Instances>& instances) {
    const std::size_t count = instances ? instances->count() : 1;
    check_room(primitive, count);
    if (primitive.corners.empty()) return;
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dmat4 matrix = instances ? world * instances->transform(i) : world;
      const glm::dmat3 of_normals = normal_matrix(matrix);
      add_copy(
          primitive,
          [&](std::uint32_t vertex) {
            const glm::dvec3 position = primitive.positions.vec3(vertex) + morph.displacement(vertex);
            return glm::dvec3(matrix * glm::dvec4(position, 1));
          },
          [&](std::uint32_t) { return of_normals; });
    }
  }

  void check_room(const Primitive& primitive, std::uint64_t copies) {
    const auto times = [&](std::uint64_t n) {  // without overflow
      return n != 0 && copies > kMaxMeshVertices + kMaxMeshTriangles ? copies : n * copies;
    };
    const bool is_triangles = primitive.kind == halfspace::Primitive::kTriangles;
    source_.mesh.check_room(times(primitive.vertices.size()),
                            times(is_triangles ? primitive.corners.size() / 3 : primitive.corners.size()));
  }

  /// `matrix`: of a vertex's normal.
  template <typename Place, typename Matrix>
  void add_copy(const Primitive& primitive, const Place& place, const Matrix& matrix) {
    const std::uint32_t first = source_.mesh.vertex_count();
    for (const std::uint32_t vertex : primitive.vertices) source_.mesh.add_vertex(place(vertex));
    if (source_.attributes != nullptr) store_attributes(primitive, first, matrix);
    if (primitive.kind != halfspace::Primitive::kTriangles) return add_others(primitive, first);
    for (std::size_t i = 0; i < primitive.corners.size(); i += 3) {
      const std::uint32_t face[3] = {first + primitive.corners[i], first + primitive.corners[i + 1],
                                     first + primitive.corners[i + 2]};
      source_.mesh.add_face(face);
    }
  }

  void add_others(const Primitive& primitive, std::uint32_t first) {
    std::vector<std::uint32_t> corners = primitive.corners;
    for (std::uint32_t& corner : corners) corner += first;
    if (primitive.kind == halfspace::Primitive::kLineStrip) {
      return source_.mesh.add_line_strip(corners, primitive.closed);
    }
    const std::size_t each = indices_each(primitive.kind);
    for (std::size_t i = 0; i < corners.size(); i += each) {
      if (each == 2) {
        source_.mesh.add_line(corners[i], corners[i + 1]);
      } else {
        source_.mesh.add_point(corners[i]);
      }
    }
  }

  /// Of the vertices from `first` on, which are those of the primitive.
  template <typename Matrix>
  void store_attributes(const Primitive& primitive, std::uint32_t first, const Matrix& matrix) {
    AttributeBuilder& builder = source_.attributes->builder;
    std::uint32_t next = first;
    for (const std::uint32_t vertex : primitive.vertices) {
      primitive.attributes.store(vertex, next, builder);
      if (const auto normal = primitive.attributes.normal(vertex)) {
        builder.set_normal(next, glm::vec3(glm::normalize(matrix(vertex) * *normal)));
      }
      ++next;
    }
  }

  const Document& document_;
  Source source_;
  Poses poses_;
  Nodes nodes_;
  std::unordered_map<std::size_t, Skin> skins_;
};

}  // namespace
}  // namespace gltf

Mesh parse_gltf(std::span<const std::byte> bytes, std::string_view name, const std::filesystem::path& folder,
                MeshContent content) {
  const gltf::Document document(bytes, name);
  gltf::Buffers buffers(document, folder);
  MeshBuilder mesh(name);
  if (document.bytes_behind() > 0) mesh.leave_out("bytes behind the GLB's length", document.bytes_behind());
  gltf::check_extensions(document, mesh);
  gltf::AttributeSource attributes(document, buffers, mesh);
  const bool wanted = content == MeshContent::kAttributes;
  gltf::SceneReader(document, buffers, mesh, wanted ? &attributes : nullptr).run();
  Mesh out = std::move(mesh).finish();
  if (wanted) std::move(attributes.builder).finish(out);
  return out;
}

Mesh parse_gltf(std::span<const std::byte> bytes, std::string_view name,
                const std::filesystem::path& folder) {
  return parse_gltf(bytes, name, folder, MeshContent::kGeometry);
}

}  // namespace halfspace
