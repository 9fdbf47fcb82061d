#include "halfspace/scene/gltf_check.hpp"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "halfspace/numerics/error.hpp"
#include "halfspace/scene/quote.hpp"

namespace halfspace {
namespace {

constexpr std::uint64_t kGlbHeaderSize = 12;
constexpr std::uint64_t kChunkHeaderSize = 8;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kGltfVersion = 2;

template <typename... Args>
[[noreturn]] void fail(std::string_view name, fmt::format_string<Args...> text, Args&&... args) {
  throw InputError(fmt::format("{}: {}", name, fmt::format(text, std::forward<Args>(args)...)));
}

std::uint32_t word_at(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof(word));
  return word;
}

std::string_view as_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The JSON chunk of a GLB file.
std::string_view glb_json(std::span<const std::byte> bytes, std::string_view name) {
  if (bytes.size() < kGlbHeaderSize + kChunkHeaderSize) {
    fail(name, "GLB has {} bytes; legal: {} or more", bytes.size(), kGlbHeaderSize + kChunkHeaderSize);
  }
  if (word_at(bytes, 4) != kGltfVersion) {
    fail(name, "GLB version is {}; legal: {}", word_at(bytes, 4), kGltfVersion);
  }
  if (word_at(bytes, 8) != bytes.size()) {
    fail(name, "GLB length is {}; legal: {}, the size of the file", word_at(bytes, 8), bytes.size());
  }
  if (word_at(bytes, kGlbHeaderSize + 4) != kJsonChunk) {
    fail(name, "GLB's first chunk is of type {:#x}; legal: {:#x} (JSON)", word_at(bytes, kGlbHeaderSize + 4),
         kJsonChunk);
  }
  const std::uint32_t size = word_at(bytes, kGlbHeaderSize);
  const auto chunk = bytes.subspan(kGlbHeaderSize + kChunkHeaderSize);
  if (size > chunk.size()) fail(name, "GLB JSON chunk has {} bytes; legal: at most {}", size, chunk.size());
  return as_text(chunk.first(size));
}

/// Counts brackets and commas outside strings: cheap, and enough to bound what a parser will build.
void check_extent(std::string_view json, std::string_view name) {
  std::uint64_t depth = 0;
  std::uint64_t values = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
      continue;
    }
    if (c == '"') in_string = true;
    if (c == ']' || c == '}') depth -= depth > 0 ? 1 : 0;
    if (c == '[' || c == '{') ++depth;
    if (c == '[' || c == '{' || c == ',') ++values;
    if (depth > kMaxJsonDepth) {
      fail(name, "JSON is nested {} deep at byte {}; legal: at most {}", depth, i, kMaxJsonDepth);
    }
    if (values > kMaxJsonValues) {
      fail(name, "JSON has {} values or more at byte {}; legal: at most {}", values, i, kMaxJsonValues);
    }
  }
}

void check_version(const nlohmann::json& root, std::string_view name) {
  const auto asset = root.find("asset");
  if (asset == root.end() || !asset->is_object())
    fail(name, "glTF has no asset; legal: an object with a version");
  const auto version = asset->find("version");
  if (version == asset->end() || !version->is_string())
    fail(name, "asset.version is missing; legal: \"2.0\"");
  const std::string value = version->get<std::string>();
  if (value != "2" && !value.starts_with("2."))
    fail(name, "asset.version is {}; legal: \"2.0\"", quote(value));
}

void check_buffers(const nlohmann::json& root, bool glb, std::string_view name) {
  const auto buffers = root.find("buffers");
  if (buffers == root.end()) return;
  if (!buffers->is_array()) fail(name, "buffers is not a list; legal: a list of objects");
  for (std::size_t i = 0; i < buffers->size(); ++i) {
    const nlohmann::json& buffer = (*buffers)[i];
    if (!buffer.is_object()) fail(name, "buffer {} is not an object; legal: a list of objects", i);
    if (!buffer.contains("uri") && !(glb && i == 0)) {
      fail(name, "buffer {} has no uri; legal: only buffer 0 of a GLB file has none", i);
    }
  }
}

/// The number under `key`, or `fallback` when it is missing; nothing when it is not an unsigned integer.
std::optional<std::uint64_t> number_at(const nlohmann::json& object, const char* key,
                                       std::uint64_t fallback) {
  const auto found = object.find(key);
  if (found == object.end()) return fallback;
  if (!found->is_number_unsigned()) return std::nullopt;
  return found->get<std::uint64_t>();
}

/// The object that `key` of `object` points to in the list `list` of the root; null when there is none.
const nlohmann::json* pointed_to(const nlohmann::json& root, const nlohmann::json& object, const char* key,
                                 const char* list) {
  const auto items = root.find(list);
  const auto index = number_at(object, key, std::numeric_limits<std::uint64_t>::max());
  if (items == root.end() || !items->is_array() || !index || *index >= items->size()) return nullptr;
  const nlohmann::json& item = (*items)[*index];
  return item.is_object() ? &item : nullptr;
}

/// Images are not loaded, but tinygltf takes the address of their first byte.
void check_images(const nlohmann::json& root, std::string_view name) {
  const auto images = root.find("images");
  if (images == root.end() || !images->is_array()) return;
  for (std::size_t i = 0; i < images->size(); ++i) {
    const nlohmann::json& image = (*images)[i];
    if (!image.is_object() || !image.contains("bufferView")) continue;
    const nlohmann::json* const view = pointed_to(root, image, "bufferView", "bufferViews");
    const nlohmann::json* const buffer =
        view != nullptr ? pointed_to(root, *view, "buffer", "buffers") : nullptr;
    const auto offset = view != nullptr ? number_at(*view, "byteOffset", 0) : std::nullopt;
    const auto length = buffer != nullptr ? number_at(*buffer, "byteLength", 0) : std::nullopt;
    if (!offset || !length || *offset >= *length) {
      fail(name, "image {} has bufferView {}; legal: one that starts within its buffer", i,
           quote(image["bufferView"].dump()));
    }
  }
}

}  // namespace

bool is_glb(std::span<const std::byte> bytes) { return as_text(bytes).starts_with("glTF"); }

void check_gltf(std::span<const std::byte> bytes, std::string_view name) {
  const bool glb = is_glb(bytes);
  const std::string_view json = glb ? glb_json(bytes, name) : as_text(bytes);
  check_extent(json, name);
  const nlohmann::json root = nlohmann::json::parse(json, nullptr, false);
  if (!root.is_object()) fail(name, "JSON is malformed or not an object; legal: a glTF 2 file");
  check_version(root, name);
  check_buffers(root, glb, name);
  check_images(root, name);
}

}  // namespace halfspace
