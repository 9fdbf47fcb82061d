// glTF 2 and GLB by tinygltf, behind the checks of gltf_check.cpp (docs/adr/0003-mesh-readers.md). tinygltf
// reads the tables; that they fit each other and the buffers is checked here, where they are used.
#define TINYGLTF_IMPLEMENTATION
#include "halfspace/scene/tiny_gltf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <glm/ext/quaternion_double.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/byte_source.hpp"
#include "halfspace/scene/gltf_check.hpp"
#include "halfspace/scene/mesh_builder.hpp"
#include "halfspace/scene/mesh_formats.hpp"
#include "halfspace/scene/quote.hpp"

namespace halfspace {
namespace {

constexpr std::size_t kPositionSize = 3 * sizeof(float);
constexpr std::size_t kMaxStride = 252;  // glTF 2.0, 5.11.4

/// Where buffers are read from: the folder of the file and those below it, up to a number of bytes in all.
struct Folder {
  std::filesystem::path path;
  std::uint64_t bytes_left = kMaxInputBytes;

  [[nodiscard]] bool holds(const std::filesystem::path& file) const {
    const std::filesystem::path below = file.lexically_normal().lexically_relative(path.lexically_normal());
    return !below.empty() && *below.begin() != "..";
  }
};

tinygltf::FsCallbacks file_callbacks(Folder& folder) {
  tinygltf::FsCallbacks callbacks{};
  callbacks.user_data = &folder;
  callbacks.FileExists = [](const std::string& file, void* user) {
    std::error_code error;
    return static_cast<Folder*>(user)->holds(file) && std::filesystem::is_regular_file(file, error);
  };
  callbacks.ExpandFilePath = [](const std::string& file, void*) { return file; };
  callbacks.ReadWholeFile = [](std::vector<unsigned char>* out, std::string*, const std::string& file,
                               void* user) {
    auto& from = *static_cast<Folder*>(user);
    const std::vector<std::byte> bytes = read_raw_bytes(file, from.bytes_left);
    from.bytes_left -= bytes.size();
    out->resize(bytes.size());
    std::transform(bytes.begin(), bytes.end(), out->begin(),
                   [](std::byte b) { return std::to_integer<unsigned char>(b); });
    return true;
  };
  return callbacks;
}

tinygltf::Model load_model(std::span<const std::byte> bytes, std::string_view name,
                           const std::filesystem::path& path) {
  Folder folder{path.empty() ? "." : path};
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks(file_callbacks(folder));
  loader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*,
                           int, void*) { return true; },
                        nullptr);
  tinygltf::Model model;
  std::string error;
  std::string warning;
  bool loaded = false;
  const auto size = static_cast<unsigned int>(bytes.size());
  try {
    loaded = is_glb(bytes) ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                                         reinterpret_cast<const unsigned char*>(bytes.data()),
                                                         size, folder.path.string())
                           : loader.LoadASCIIFromString(&model, &error, &warning,
                                                        reinterpret_cast<const char*>(bytes.data()), size,
                                                        folder.path.string());
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& exception) {
    error = exception.what();
  }
  if (!loaded || !error.empty()) {
    throw InputError(fmt::format("{}: not read as glTF ({}); legal: a sound glTF 2 file", name,
                                 quote(error.empty() ? "no reason given" : error)));
  }
  return model;
}

/// Elements of `size` bytes, `stride` apart, all within their buffer.
struct View {
  const unsigned char* data = nullptr;
  std::size_t count = 0;
  std::size_t stride = 0;
};

class SceneReader {
 public:
  SceneReader(const tinygltf::Model& model, std::string_view name)
      : model_(model), name_(name), builder_(name) {}

  Mesh run() {
    check_extensions();
    struct Visit {
      int node;
      glm::dmat4 parent;
    };
    std::vector<Visit> open;
    for (const int root : roots()) open.push_back({root, glm::dmat4(1)});
    std::reverse(open.begin(), open.end());
    std::vector<bool> seen(model_.nodes.size());
    while (!open.empty()) {
      const Visit visit = open.back();
      open.pop_back();
      check_index("node", visit.node, model_.nodes.size());
      const auto at = static_cast<std::size_t>(visit.node);
      if (seen[at]) fail("node {} is reached twice; legal: each node has one parent and is in no cycle", at);
      seen[at] = true;
      const tinygltf::Node& node = model_.nodes[at];
      const glm::dmat4 world = visit.parent * local_transform(node, at);
      if (node.mesh >= 0) add_mesh(node.mesh, world);
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
        open.push_back({*child, world});
      }
    }
    return std::move(builder_).finish();
  }

 private:
  template <typename... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> text, Args&&... args) const {
    throw InputError(fmt::format("{}: {}", name_, fmt::format(text, std::forward<Args>(args)...)));
  }

  void check_index(std::string_view what, int index, std::size_t size) const {
    if (index < 0 || static_cast<std::size_t>(index) >= size) {
      fail("{} is {}; legal: 0 or more and below {}", what, index, size);
    }
  }

  /// Extensions that must be understood may change the geometry; those about materials do not.
  void check_extensions() const {
    for (const std::string& extension : model_.extensionsRequired) {
      if (extension.starts_with("KHR_materials_") || extension.starts_with("KHR_texture_") ||
          extension.starts_with("EXT_texture_") || extension == "KHR_lights_punctual") {
        continue;
      }
      fail("extension {} is required; legal: only extensions of materials and textures", quote(extension));
    }
  }

  /// The roots of the default scene, of the first scene, or all nodes that are no node's child.
  [[nodiscard]] std::vector<int> roots() const {
    if (model_.defaultScene >= 0) check_index("scene", model_.defaultScene, model_.scenes.size());
    if (!model_.scenes.empty()) {
      return model_.scenes[static_cast<std::size_t>(std::max(model_.defaultScene, 0))].nodes;
    }
    std::vector<bool> is_child(model_.nodes.size());
    for (const tinygltf::Node& node : model_.nodes) {
      for (const int child : node.children) {
        check_index("child node", child, model_.nodes.size());
        is_child[static_cast<std::size_t>(child)] = true;
      }
    }
    std::vector<int> roots;
    for (std::size_t i = 0; i < is_child.size(); ++i) {
      if (!is_child[i]) roots.push_back(static_cast<int>(i));
    }
    return roots;
  }

  /// The numbers of a node's property: none, or as many as it has.
  void check_size(const std::vector<double>& values, std::size_t size, std::size_t node,
                  std::string_view property) const {
    if (!values.empty() && values.size() != size) {
      fail("node {}: {} has {} numbers; legal: {}", node, property, values.size(), size);
    }
  }

  [[nodiscard]] glm::dmat4 local_transform(const tinygltf::Node& node, std::size_t at) const {
    check_size(node.matrix, 16, at, "matrix");
    check_size(node.translation, 3, at, "translation");
    check_size(node.rotation, 4, at, "rotation");
    check_size(node.scale, 3, at, "scale");
    if (!node.matrix.empty()) return glm::make_mat4(node.matrix.data());
    glm::dmat4 transform(1);
    if (!node.rotation.empty()) {
      transform =
          glm::mat4_cast(glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]));
    }
    for (int i = 0; i < 3; ++i) {
      const auto axis = static_cast<std::size_t>(i);
      if (!node.scale.empty()) transform[i] *= node.scale[axis];
      if (!node.translation.empty()) transform[3][i] = node.translation[axis];
    }
    return transform;
  }

  void add_mesh(int index, const glm::dmat4& world) {
    check_index("mesh", index, model_.meshes.size());
    const tinygltf::Mesh& mesh = model_.meshes[static_cast<std::size_t>(index)];
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
      const tinygltf::Primitive& primitive = mesh.primitives[i];
      if (primitive.mode >= TINYGLTF_MODE_POINTS && primitive.mode <= TINYGLTF_MODE_LINE_STRIP) {
        builder_.leave_out("primitives of points or lines");
        continue;
      }
      add_primitive(primitive, world);
      builder_.end_part(part_name(mesh, primitive, index, i));
    }
  }

  [[nodiscard]] std::string part_name(const tinygltf::Mesh& mesh, const tinygltf::Primitive& primitive,
                                      int index, std::size_t number) const {
    const std::string mesh_name = mesh.name.empty() ? fmt::format("mesh {}", index) : mesh.name;
    if (primitive.material < 0) return fmt::format("{}, primitive {}", mesh_name, number);
    check_index("material", primitive.material, model_.materials.size());
    const std::string& material = model_.materials[static_cast<std::size_t>(primitive.material)].name;
    return fmt::format("{}, {}", mesh_name,
                       material.empty() ? fmt::format("material {}", primitive.material) : material);
  }

  void add_primitive(const tinygltf::Primitive& primitive, const glm::dmat4& world) {
    if (!primitive.extensions.empty() && primitive.extensions.count("KHR_draco_mesh_compression") != 0) {
      fail("extension \"KHR_draco_mesh_compression\" is used; legal: uncompressed primitives");
    }
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) fail("a primitive has no POSITION; legal: one in each");
    const View positions = position_view(position->second);
    const std::vector<std::uint32_t> corners = triangle_corners(primitive, positions.count);
    if (corners.empty()) return;

    // Buffers are often shared by many primitives: only the range this one uses is copied.
    const auto [low, high] = std::minmax_element(corners.begin(), corners.end());
    const std::uint32_t first = *low;
    const std::uint64_t used = std::uint64_t{*high} - first + 1;
    builder_.check_room(used, corners.size() / 3);
    const std::uint32_t base = builder_.vertex_count();
    for (std::uint64_t i = 0; i < used; ++i) {
      glm::vec3 local;
      std::memcpy(&local, positions.data + (first + i) * positions.stride, kPositionSize);
      builder_.add_vertex(glm::dvec3(world * glm::dvec4(local, 1)));
    }
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      std::array<std::uint32_t, 3> face{};
      for (std::size_t c = 0; c < 3; ++c) face[c] = base + (corners[i + c] - first);
      builder_.add_face(face);
    }
  }

  /// Three corners a triangle, each below `vertices`.
  [[nodiscard]] std::vector<std::uint32_t> triangle_corners(const tinygltf::Primitive& primitive,
                                                            std::size_t vertices) const {
    std::vector<std::uint32_t> order;
    if (primitive.indices >= 0) {
      order = read_indices(primitive.indices, vertices);
    } else {
      order.resize(vertices);
      for (std::size_t i = 0; i < vertices; ++i) order[i] = static_cast<std::uint32_t>(i);
    }
    switch (primitive.mode) {
      case -1:  // not given
      case TINYGLTF_MODE_TRIANGLES:
        if (order.size() % 3 != 0)
          fail("a triangle list has {} corners; legal: a multiple of 3", order.size());
        return order;
      case TINYGLTF_MODE_TRIANGLE_STRIP: {
        std::vector<std::uint32_t> out;
        for (std::size_t i = 0; i + 2 < order.size(); ++i) {
          const std::size_t odd = i % 2;
          out.insert(out.end(), {order[i + odd], order[i + 1 - odd], order[i + 2]});
        }
        return out;
      }
      case TINYGLTF_MODE_TRIANGLE_FAN: {
        std::vector<std::uint32_t> out;
        for (std::size_t i = 1; i + 1 < order.size(); ++i) {
          out.insert(out.end(), {order[0], order[i], order[i + 1]});
        }
        return out;
      }
      default:
        fail("primitive mode is {}; legal: 0 to 6", primitive.mode);
    }
  }

  [[nodiscard]] const tinygltf::Accessor& accessor(int index) const {
    check_index("accessor", index, model_.accessors.size());
    return model_.accessors[static_cast<std::size_t>(index)];
  }

  [[nodiscard]] View position_view(int index) const {
    const tinygltf::Accessor& positions = accessor(index);
    if (positions.type != TINYGLTF_TYPE_VEC3 || positions.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT) {
      fail("accessor {} of POSITION has type {} of component {}; legal: {} (VEC3) of {} (float)", index,
           positions.type, positions.componentType, TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT);
    }
    return view(positions, index, kPositionSize);
  }

  [[nodiscard]] std::vector<std::uint32_t> read_indices(int index, std::size_t vertices) const {
    const tinygltf::Accessor& indices = accessor(index);
    std::size_t size = 0;
    if (indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) size = 1;
    if (indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) size = 2;
    if (indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) size = 4;
    if (indices.type != TINYGLTF_TYPE_SCALAR || size == 0) {
      fail("accessor {} of indices has type {} of component {}; legal: {} (SCALAR) of 5121, 5123 or 5125",
           index, indices.type, indices.componentType, TINYGLTF_TYPE_SCALAR);
    }
    const View bytes = view(indices, index, size);
    builder_.check_room(0, bytes.count / 3);
    std::vector<std::uint32_t> out(bytes.count);
    for (std::size_t i = 0; i < out.size(); ++i) {
      std::memcpy(&out[i], bytes.data + i * bytes.stride, size);  // little-endian, as this machine
      if (out[i] >= vertices) {
        fail("accessor {}: index {} is {}; legal: below {}, the number of positions", index, i, out[i],
             vertices);
      }
    }
    return out;
  }

  /// The accessor's elements, each `size` bytes, after checking every step down to the buffer in 64 bits.
  [[nodiscard]] View view(const tinygltf::Accessor& from, int index, std::size_t size) const {
    if (from.sparse.isSparse) fail("accessor {} is sparse; legal: accessors without sparse", index);
    check_index("bufferView", from.bufferView, model_.bufferViews.size());
    const tinygltf::BufferView& slice = model_.bufferViews[static_cast<std::size_t>(from.bufferView)];
    if (slice.extensions.count("EXT_meshopt_compression") != 0) {
      fail("extension \"EXT_meshopt_compression\" is used; legal: uncompressed buffer views");
    }
    check_index("buffer", slice.buffer, model_.buffers.size());
    const std::vector<unsigned char>& buffer = model_.buffers[static_cast<std::size_t>(slice.buffer)].data;
    if (slice.byteOffset > buffer.size() || slice.byteLength > buffer.size() - slice.byteOffset) {
      fail("bufferView {} is {} bytes from {}; legal: within the {} bytes of buffer {}", from.bufferView,
           slice.byteLength, slice.byteOffset, buffer.size(), slice.buffer);
    }
    const std::size_t stride = slice.byteStride == 0 ? size : slice.byteStride;
    if (stride < size || stride > kMaxStride) {
      fail("bufferView {} has byteStride {}; legal: {} to {}", from.bufferView, stride, size, kMaxStride);
    }
    const bool starts_within = from.byteOffset <= slice.byteLength;
    const std::size_t room = starts_within ? slice.byteLength - from.byteOffset : 0;
    const std::size_t most = room < size ? 0 : (room - size) / stride + 1;
    if (!starts_within || from.count > most) {
      fail("accessor {} has {} elements from byte {}; legal: at most {} in bufferView {}", index, from.count,
           from.byteOffset, most, from.bufferView);
    }
    return {buffer.data() + slice.byteOffset + from.byteOffset, from.count, stride};
  }

  const tinygltf::Model& model_;
  std::string_view name_;
  MeshBuilder builder_;
};

}  // namespace

Mesh parse_gltf(std::span<const std::byte> bytes, std::string_view name,
                const std::filesystem::path& folder) {
  check_gltf(bytes, name);
  const tinygltf::Model model = load_model(bytes, name, folder);
  return SceneReader(model, name).run();
}

}  // namespace halfspace
