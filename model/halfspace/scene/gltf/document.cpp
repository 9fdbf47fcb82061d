#include "halfspace/scene/gltf/document.hpp"

#include <cstring>

#include "halfspace/scene/quote.hpp"

namespace halfspace::gltf {
namespace {

using nlohmann::json;

constexpr std::uint64_t kGlbHeaderSize = 12;
constexpr std::uint64_t kChunkHeaderSize = 8;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;
constexpr std::uint32_t kGlbVersion = 2;

std::uint32_t word_at(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof(word));
  return word;
}

std::string_view view_as_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Counts brackets and commas outside strings: cheap, and enough to bound what a parser will build.
void check_extent(std::string_view text, std::string_view name) {
  std::uint64_t depth = 0;
  std::uint64_t values = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
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
      throw InputError(fmt::format("{}: JSON is nested {} deep at byte {}; legal: at most {}", name, depth, i,
                                   kMaxJsonDepth));
    }
    if (values > kMaxJsonValues) {
      throw InputError(fmt::format("{}: JSON has {} values or more at byte {}; legal: at most {}", name,
                                   values, i, kMaxJsonValues));
    }
  }
}

}  // namespace

Document::Document(std::span<const std::byte> bytes, std::string_view name) : name_(name) {
  std::string_view text = open_container(bytes);
  // A GLB's JSON should be padded with spaces; some writers take zeros, as for the binary chunk.
  text = text.substr(0, text.find_last_not_of('\0') + 1);
  check_extent(text, name_);
  if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos) {
    fail("JSON byte {} is zero; legal: text", zero);  // the parser would take it for the end
  }
  json_ = json::parse(text, nullptr, false);  // it skips a byte order mark
  if (!json_.is_object()) fail("JSON is malformed or not an object; legal: a glTF 2 file");

  const auto asset = json_.find("asset");
  if (asset == json_.end() || !asset->is_object()) {
    fail("glTF has no asset; legal: an object with a version");
  }
  const auto version = asset->find("version");
  if (version == asset->end() || !version->is_string()) fail("asset.version is missing; legal: \"2.0\"");
  const auto& value = version->get_ref<const std::string&>();
  if (value != "2" && !value.starts_with("2.")) {
    fail("asset.version is {}; legal: \"2.0\"", quote(value));
  }
}

/// The JSON's text; notes the chunk behind it.
std::string_view Document::open_container(std::span<const std::byte> bytes) {
  if (!view_as_text(bytes).starts_with("glTF")) return view_as_text(bytes);
  if (bytes.size() < kGlbHeaderSize + kChunkHeaderSize) {
    fail("GLB has {} bytes; legal: {} or more", bytes.size(), kGlbHeaderSize + kChunkHeaderSize);
  }
  if (word_at(bytes, 4) != kGlbVersion) {
    fail("GLB version is {}; legal: {}", word_at(bytes, 4), kGlbVersion);
  }
  const std::uint32_t length = word_at(bytes, 8);
  if (length < kGlbHeaderSize + kChunkHeaderSize || length > bytes.size()) {
    fail("GLB length is {}; legal: {} to {}, the size of the file", length, kGlbHeaderSize + kChunkHeaderSize,
         bytes.size());
  }
  bytes_behind_ = bytes.size() - length;
  bytes = bytes.first(length);

  const std::uint32_t type = word_at(bytes, kGlbHeaderSize + 4);
  if (type != kJsonChunk) {
    fail("GLB's first chunk is of type {:#x}; legal: {:#x} (JSON)", type, kJsonChunk);
  }
  const std::uint32_t size = word_at(bytes, kGlbHeaderSize);
  const auto chunk = bytes.subspan(kGlbHeaderSize + kChunkHeaderSize);
  if (size > chunk.size()) fail("GLB JSON chunk has {} bytes; legal: at most {}", size, chunk.size());

  // The binary chunk is the second one; chunks of other types are an extension's.
  const auto rest = chunk.subspan(size);
  if (rest.size() >= kChunkHeaderSize && word_at(rest, 4) == kBinaryChunk) {
    const auto data = rest.subspan(kChunkHeaderSize);
    if (word_at(rest, 0) > data.size()) {
      fail("GLB binary chunk has {} bytes; legal: at most {}", word_at(rest, 0), data.size());
    }
    chunk_ = data.first(word_at(rest, 0));
  } else if (!rest.empty() && rest.size() < kChunkHeaderSize) {
    fail("GLB's second chunk has {} bytes; legal: {} or more", rest.size(), kChunkHeaderSize);
  }
  return view_as_text(chunk.first(size));
}

std::size_t Document::size(const Table& table) const {
  const auto list = json_.find(table.list);
  if (list == json_.end()) return 0;
  if (!list->is_array()) fail("{} is not a list; legal: a list of objects", table.list);
  return list->size();
}

Object Document::get(const Table& table, std::uint64_t index) const {
  const std::size_t at = check_index(table, json(index));
  return {(*json_.find(table.list))[at], name_, table.kind, at};
}

std::size_t Document::check_index(const Table& table, const json& index) const {
  const auto number = as_number(index);
  if (!number || *number >= size(table)) {
    fail("{} is {}; legal: 0 or more and below {}", table.kind, to_text(index), size(table));
  }
  return static_cast<std::size_t>(*number);
}

std::optional<std::size_t> Document::find_index(const Table& table, const Object& from,
                                                const char* key) const {
  const json* const value = from.find(key);
  if (value == nullptr) return std::nullopt;
  return check_index(table, *value);
}

std::optional<Object> Document::find(const Table& table, const Object& from, const char* key) const {
  const auto index = find_index(table, from, key);
  if (!index) return std::nullopt;
  return get(table, *index);
}

std::vector<std::size_t> Document::indices(const Table& table, const Object& from, const char* key) const {
  std::vector<std::size_t> indices;
  const json* const list = from.find(key);
  if (list == nullptr) return indices;
  if (!list->is_array())
    from.fail("{} is {}; legal: a list of whole numbers, 0 or more", key, to_text(*list));
  indices.reserve(list->size());
  for (const json& index : *list) indices.push_back(check_index(table, index));
  return indices;
}

}  // namespace halfspace::gltf
