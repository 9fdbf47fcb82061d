/// The buffers of a glTF file and the views into them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "halfspace/scene/byte_source.hpp"
#include "halfspace/scene/gltf/document.hpp"

namespace halfspace::gltf {

/// The bytes of a buffer view, and how far apart its elements are (0: they follow each other).
struct View {
  std::span<const std::byte> bytes;
  std::size_t stride = 0;
};

/// Reads each buffer when it is first used, from the file itself or from the file's own folder and those
/// below, and keeps it: views stay valid as long as this object.
class Buffers {
 public:
  Buffers(const Document& document, std::filesystem::path folder);
  Buffers(const Buffers&) = delete;
  Buffers& operator=(const Buffers&) = delete;

  /// Throws InputError when the view is not within its buffer, or the buffer cannot be had.
  [[nodiscard]] View view(std::uint64_t index);

  /// The bytes that the URI of `from` stands for: data, or a file. Throws InputError.
  [[nodiscard]] std::vector<std::byte> load(const Object& from, const std::string& uri);

 private:
  [[nodiscard]] std::span<const std::byte> buffer(std::uint64_t index);
  [[nodiscard]] std::optional<std::filesystem::path> file(const std::string& uri) const;
  [[nodiscard]] bool is_there(std::uint64_t index) const;
  /// The bytes that `slice`, a buffer view or its extension, names.
  [[nodiscard]] std::span<const std::byte> bytes_of(const Object& slice);

  const Document& document_;
  std::filesystem::path folder_;
  std::uint64_t file_bytes_left_ = kMaxInputBytes;
  std::unordered_map<std::uint64_t, std::vector<std::byte>> loaded_;
  std::unordered_map<std::uint64_t, std::vector<std::byte>> unpacked_;  // of views
};

}  // namespace halfspace::gltf
