/// A glTF file in memory: its JSON and, of a binary file, the chunk behind it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/scene/gltf/object.hpp"

namespace halfspace::gltf {

/// Most nested arrays and objects, and most values, of a glTF file's JSON.
inline constexpr std::uint64_t kMaxJsonDepth = 64;
inline constexpr std::uint64_t kMaxJsonValues = std::uint64_t{1} << 22;

/// A list of the root, and what errors call one object of it.
struct Table {
  const char* list;
  const char* kind;
};
inline constexpr Table kAccessors{"accessors", "accessor"};
inline constexpr Table kAnimations{"animations", "animation"};
inline constexpr Table kBuffers{"buffers", "buffer"};
inline constexpr Table kBufferViews{"bufferViews", "bufferView"};
inline constexpr Table kCameras{"cameras", "camera"};
inline constexpr Table kImages{"images", "image"};
inline constexpr Table kMaterials{"materials", "material"};
inline constexpr Table kMeshes{"meshes", "mesh"};
inline constexpr Table kNodes{"nodes", "node"};
inline constexpr Table kSamplers{"samplers", "sampler"};
inline constexpr Table kScenes{"scenes", "scene"};
inline constexpr Table kSkins{"skins", "skin"};
inline constexpr Table kTextures{"textures", "texture"};

class Document {
 public:
  /// Text or a GLB container of version 2. The bytes and the name stay the caller's. Throws InputError unless
  /// the container's sizes are sound and the JSON is well-formed, within the limits above and of glTF
  /// version 2: checked before it is built, so that a small file exhausts neither the stack nor memory.
  Document(std::span<const std::byte> bytes, std::string_view name);

  [[nodiscard]] std::string_view name() const { return name_; }
  [[nodiscard]] Object root() const { return {json_, name_, "glTF"}; }

  /// How many objects the list has.
  [[nodiscard]] std::size_t size(const Table& table) const;
  /// Throws InputError when the list does not have the object.
  [[nodiscard]] Object get(const Table& table, std::uint64_t index) const;
  /// The object that `from` names under `key` by its index.
  [[nodiscard]] std::optional<Object> find(const Table& table, const Object& from, const char* key) const;
  /// The index under `key`, checked to be in the list; errors call it `table.kind`.
  [[nodiscard]] std::optional<std::size_t> find_index(const Table& table, const Object& from,
                                                      const char* key) const;
  /// The list of indices under `key`, each checked.
  [[nodiscard]] std::vector<std::size_t> indices(const Table& table, const Object& from,
                                                 const char* key) const;

  /// The binary chunk of a GLB container, if it has one.
  [[nodiscard]] std::optional<std::span<const std::byte>> chunk() const { return chunk_; }
  /// How many bytes follow what the container says is its end.
  [[nodiscard]] std::size_t bytes_behind() const { return bytes_behind_; }

  template <typename... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> text, Args&&... args) const {
    throw InputError(fmt::format("{}: {}", name_, fmt::format(text, std::forward<Args>(args)...)));
  }

 private:
  [[nodiscard]] std::string_view open_container(std::span<const std::byte> bytes);
  [[nodiscard]] std::size_t check_index(const Table& table, const nlohmann::json& index) const;

  std::string_view name_;
  nlohmann::json json_;
  std::optional<std::span<const std::byte>> chunk_;
  std::size_t bytes_behind_ = 0;
};

}  // namespace halfspace::gltf
