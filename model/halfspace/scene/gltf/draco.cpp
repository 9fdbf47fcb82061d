#include "halfspace/scene/gltf/draco.hpp"

#include <draco/compression/config/compression_shared.h>
#include <draco/compression/decode.h>
#include <draco/core/decoder_buffer.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/geometry_metadata.h>
#include <draco/metadata/metadata_decoder.h>

#include <cstring>
#include <limits>
#include <new>
#include <string>

#include "halfspace/scene/mesh.hpp"
#include "halfspace/scene/quote.hpp"

namespace halfspace::gltf {
namespace {

/// The library's encoder, at its slowest, puts 4 to 12 faces and vertices of a wavy grid into a byte, and 79
/// of a flat one of 195586: a file that announces more than these two together is not one of a mesh.
constexpr std::uint64_t kMostElementsInByte = 64;
constexpr std::uint64_t kElementsInAnySize = 1 << 18;

struct DracoSize {
  std::uint64_t faces = 0;
  std::uint64_t vertices = 0;
};

/// What the header announces (Draco bitstream 2.2, "Draco Decoder" and "Connectivity Decoder"), read by the
/// library's own means; zeros where it is not sound, which the decoder will say better.
DracoSize announced_size(draco::DecoderBuffer buffer) {
  char magic[5];
  std::uint8_t major = 0;
  std::uint8_t minor = 0;
  std::uint8_t type = 0;
  std::uint8_t method = 0;
  std::uint16_t flags = 0;
  if (!buffer.Decode(magic, sizeof(magic)) || !buffer.Decode(&major) || !buffer.Decode(&minor) ||
      !buffer.Decode(&type) || !buffer.Decode(&method) || !buffer.Decode(&flags)) {
    return {};
  }
  buffer.set_bitstream_version(DRACO_BITSTREAM_VERSION(major, minor));
  if ((flags & METADATA_FLAG_MASK) != 0) {
    draco::GeometryMetadata metadata;
    if (!draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata)) return {};
  }
  std::uint8_t traversal = 0;
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  const bool edgebreaker = method == draco::MESH_EDGEBREAKER_ENCODING;
  if ((edgebreaker && !buffer.Decode(&traversal)) || !draco::DecodeVarint(&first, &buffer) ||
      !draco::DecodeVarint(&second, &buffer)) {
    return {};
  }
  return edgebreaker ? DracoSize{second, first} : DracoSize{first, second};
}

void check_announced(const Object& packed, const draco::DecoderBuffer& buffer, std::uint64_t bytes) {
  // Older bitstreams have another header; the extension is for this one.
  constexpr std::uint8_t kMajor = 2;
  constexpr std::uint8_t kMinor = 2;
  if (bytes < 7) packed.fail("its Draco data has {} bytes; legal: 7 or more", bytes);
  const auto major = static_cast<std::uint8_t>(buffer.data_head()[5]);
  const auto minor = static_cast<std::uint8_t>(buffer.data_head()[6]);
  if (std::memcmp(buffer.data_head(), "DRACO", 5) != 0 || major != kMajor || minor != kMinor) {
    packed.fail("its Draco data begins with {} of version {}.{}; legal: \"DRACO\" of version {}.{}",
                quote(std::string_view(buffer.data_head(), 5)), major, minor, kMajor, kMinor);
  }
  const DracoSize size = announced_size(buffer);
  const std::uint64_t most = kElementsInAnySize + kMostElementsInByte * bytes;
  if (size.faces + size.vertices > most || size.faces > kMaxMeshTriangles ||
      size.vertices > kMaxMeshVertices) {
    packed.fail(
        "its Draco data of {} bytes announces {} faces and {} vertices; legal: at most {} together, {} "
        "faces and {} vertices",
        bytes, size.faces, size.vertices, most, kMaxMeshTriangles, kMaxMeshVertices);
  }
}

template <typename Number>
bool copy_values(const draco::PointAttribute& from, std::size_t vertices, unsigned width,
                 std::vector<std::byte>& out) {
  std::vector<Number> values(width);
  for (std::size_t i = 0; i < vertices; ++i) {
    const auto index = from.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(i)));
    if (index.value() >= from.size() ||
        !from.ConvertValue(index, static_cast<std::int8_t>(width), values.data())) {
      return false;
    }
    std::memcpy(out.data() + i * width * sizeof(Number), values.data(), width * sizeof(Number));
  }
  return true;
}

}  // namespace

DracoMesh::DracoMesh(const Object& packed, std::span<const std::byte> bytes) : packed_(packed) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  check_announced(packed, buffer, bytes.size());
  std::string reason;
  try {
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (decoded.ok()) {
      mesh_ = std::move(decoded).value();
    } else {
      reason = decoded.status().error_msg_string();
    }
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& exception) {
    reason = exception.what();
  }
  if (!mesh_) packed.fail("its Draco data is damaged ({}); legal: a mesh", quote(reason));
}

DracoMesh::~DracoMesh() = default;

std::size_t DracoMesh::vertices() const { return mesh_->num_points(); }

std::vector<std::uint32_t> DracoMesh::corners() const {
  std::vector<std::uint32_t> corners;
  corners.reserve(std::size_t{3} * mesh_->num_faces());
  for (std::uint32_t i = 0; i < mesh_->num_faces(); ++i) {
    for (const draco::PointIndex& corner : mesh_->face(draco::FaceIndex(i))) {
      if (corner.value() >= vertices()) {
        packed_.fail("face {} of its Draco data has vertex {}; legal: below {}", i, corner.value(),
                     vertices());
      }
      corners.push_back(corner.value());
    }
  }
  return corners;
}

std::vector<std::byte> DracoMesh::attribute(std::uint64_t id, Component component, unsigned width) const {
  const draco::PointAttribute* const from =
      id > std::numeric_limits<std::uint32_t>::max()
          ? nullptr
          : mesh_->GetAttributeByUniqueId(static_cast<std::uint32_t>(id));
  if (from == nullptr) packed_.fail("attribute {} is not in its Draco data; legal: one that is", id);
  if (from->num_components() != width) {
    packed_.fail("attribute {} of its Draco data has {} components; legal: {}", id, from->num_components(),
                 width);
  }
  const auto copy = [&]<typename Number>(Number) {
    std::vector<std::byte> out(vertices() * width * sizeof(Number));
    if (!copy_values<Number>(*from, vertices(), width, out)) {
      packed_.fail("attribute {} of its Draco data has values that do not fit component type {}", id,
                   static_cast<int>(component));
    }
    return out;
  };
  switch (component) {
    case Component::kByte:
      return copy(std::int8_t{});
    case Component::kUnsignedByte:
      return copy(std::uint8_t{});
    case Component::kShort:
      return copy(std::int16_t{});
    case Component::kUnsignedShort:
      return copy(std::uint16_t{});
    case Component::kUnsignedInt:
      return copy(std::uint32_t{});
    case Component::kFloat:
      return copy(float{});
    case Component::kDouble:
      break;
  }
  return copy(double{});
}

}  // namespace halfspace::gltf
