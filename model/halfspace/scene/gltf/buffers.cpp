#include "halfspace/scene/gltf/buffers.hpp"

#include <utility>

#include "halfspace/scene/gltf/meshopt.hpp"
#include "halfspace/scene/gltf/uri.hpp"
#include "halfspace/scene/quote.hpp"

namespace halfspace::gltf {
namespace {

constexpr const char* kMeshopt = "EXT_meshopt_compression";

}  // namespace

Buffers::Buffers(const Document& document, std::filesystem::path folder)
    : document_(document), folder_(folder.empty() ? "." : std::move(folder)) {}

/// The file that the URI names, if it is a file in the folder or below.
std::optional<std::filesystem::path> Buffers::file(const std::string& uri) const {
  // Some writers leave a percent sign of the name as it is.
  for (const std::string& relative : {percent_decode(uri), uri}) {
    if (relative.find('\0') != std::string::npos) continue;
    const std::filesystem::path path = folder_ / relative;
    const std::filesystem::path below =
        path.lexically_normal().lexically_relative(folder_.lexically_normal());
    std::error_code error;
    if (!below.empty() && *below.begin() != ".." && std::filesystem::is_regular_file(path, error))
      return path;
  }
  return std::nullopt;
}

std::vector<std::byte> Buffers::load(const Object& buffer, const std::string& uri) {
  if (is_data_uri(uri)) {
    auto bytes = decode_data_uri(uri);
    if (!bytes) buffer.fail("its data URI is damaged; legal: a comma, and base64 behind it where it says so");
    return std::move(*bytes);
  }
  const auto path = file(uri);
  if (!path && has_scheme(uri)) {
    buffer.fail("uri is {}; legal: data, or a file in the glTF file's folder or below", quote(uri));
  }
  if (!path) {
    buffer.fail("its file {} is missing; legal: a file in the glTF file's folder or below",
                quote(percent_decode(uri)));
  }
  std::vector<std::byte> bytes = read_raw_bytes(*path, file_bytes_left_);
  file_bytes_left_ -= bytes.size();
  return bytes;
}

/// Whether the buffer's bytes can be had, as far as is known before it is read.
bool Buffers::is_there(std::uint64_t index) const {
  const Object buffer = document_.get(kBuffers, index);
  const std::string* const uri = buffer.find_text("uri");
  if (uri == nullptr) return index == 0 && document_.chunk();
  return is_data_uri(*uri) || file(*uri);
}

std::span<const std::byte> Buffers::buffer(std::uint64_t index) {
  const Object buffer = document_.get(kBuffers, index);
  std::span<const std::byte> bytes;
  const std::string* const uri = buffer.find_text("uri");
  if (uri == nullptr) {
    if (index != 0 || !document_.chunk()) {
      document_.fail("buffer {} has no uri; legal: only buffer 0 of a GLB file has none", index);
    }
    bytes = *document_.chunk();
  } else if (const auto loaded = loaded_.find(index); loaded != loaded_.end()) {
    bytes = loaded->second;
  } else {
    bytes = loaded_.emplace(index, load(buffer, *uri)).first->second;
  }
  const std::uint64_t length = buffer.number("byteLength");
  if (length > bytes.size()) {
    buffer.fail("byteLength is {}; legal: at most {}, the bytes that there are", length, bytes.size());
  }
  return bytes.first(static_cast<std::size_t>(length));
}

std::span<const std::byte> Buffers::bytes_of(const Object& slice) {
  const auto index = document_.find_index(kBuffers, slice, "buffer");
  if (!index) slice.fail("buffer is missing; legal: 0 or more and below {}", document_.size(kBuffers));
  const auto bytes = buffer(*index);
  const std::uint64_t offset = slice.number_or("byteOffset", 0);
  const std::uint64_t length = slice.number("byteLength");
  if (offset > bytes.size() || length > bytes.size() - offset) {
    document_.fail("{} is {} bytes from {}; legal: within the {} bytes of buffer {}", slice.name(), length,
                   offset, bytes.size(), *index);
  }
  return bytes.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
}

View Buffers::view(std::uint64_t index) {
  const Object view = document_.get(kBufferViews, index);
  const auto stride = static_cast<std::size_t>(view.number_or("byteStride", 0));
  const auto packed = view.extension(kMeshopt);
  const auto plain = document_.find_index(kBuffers, view, "buffer");
  if (!packed || (plain && is_there(*plain))) return {bytes_of(view), stride};
  auto unpacked = unpacked_.find(index);
  if (unpacked == unpacked_.end()) {
    unpacked = unpacked_.emplace(index, unpack_meshopt(*packed, bytes_of(*packed))).first;
  }
  return {unpacked->second, stride};
}

}  // namespace halfspace::gltf
