#include "halfspace/scene/gltf/meshopt.hpp"

#include <meshoptimizer.h>

#include <cstdint>

#include "halfspace/scene/quote.hpp"

namespace halfspace::gltf {
namespace {

enum class PackMode { kAttributes, kTriangles, kIndices };

/// Rules of the extension's section "JSON schema updates".
struct Packing {
  PackMode mode;
  std::string filter;
  std::size_t count;
  std::size_t stride;
};

PackMode read_mode(const Object& packed) {
  const std::string mode = packed.text_or("mode", "");
  if (mode == "ATTRIBUTES") return PackMode::kAttributes;
  if (mode == "TRIANGLES") return PackMode::kTriangles;
  if (mode == "INDICES") return PackMode::kIndices;
  packed.fail("mode is {}; legal: \"ATTRIBUTES\", \"TRIANGLES\", \"INDICES\"", quote(mode));
}

void check_filter(const Object& packed, const Packing& packing) {
  const std::string& filter = packing.filter;
  const bool is_known =
      filter == "NONE" || filter == "OCTAHEDRAL" || filter == "QUATERNION" || filter == "EXPONENTIAL";
  if (!is_known || (filter != "NONE" && packing.mode != PackMode::kAttributes)) {
    packed.fail(
        "filter is {}; legal: \"NONE\", and with \"ATTRIBUTES\" \"OCTAHEDRAL\", \"QUATERNION\", "
        "\"EXPONENTIAL\"",
        quote(filter));
  }
  if (filter == "OCTAHEDRAL" && packing.stride != 4 && packing.stride != 8) {
    packed.fail("byteStride is {}; legal with \"OCTAHEDRAL\": 4 or 8", packing.stride);
  }
  if (filter == "QUATERNION" && packing.stride != 8) {
    packed.fail("byteStride is {}; legal with \"QUATERNION\": 8", packing.stride);
  }
}

/// Throws unless the library's preconditions hold and no more comes out than the packed bytes can hold.
Packing read_packing(const Object& packed, std::uint64_t packed_size) {
  constexpr std::uint64_t kMostStride = 256;
  const std::uint64_t count = packed.number("count");
  const std::uint64_t stride = packed.number("byteStride");
  const PackMode mode = read_mode(packed);
  if (mode == PackMode::kAttributes ? stride % 4 != 0 || stride < 4 || stride > kMostStride
                                    : stride != 2 && stride != 4) {
    packed.fail("byteStride is {}; legal: {}", stride,
                mode == PackMode::kAttributes ? "4 to 256, a multiple of 4" : "2 or 4");
  }
  if (mode == PackMode::kTriangles && count % 3 != 0)
    packed.fail("count is {}; legal: a multiple of 3", count);

  // Appendix A of the extension: of an attribute's byte, 16 elements take two bits or more; a triangle and an
  // index take a byte or more.
  const std::uint64_t most = mode == PackMode::kAttributes  ? packed_size * 64 / stride
                             : mode == PackMode::kTriangles ? packed_size * 3
                                                            : packed_size;
  if (count > most) {
    packed.fail("count is {}; legal: at most {} in {} bytes", count, most, packed_size);
  }
  Packing packing{mode, packed.text_or("filter", "NONE"), static_cast<std::size_t>(count),
                  static_cast<std::size_t>(stride)};
  check_filter(packed, packing);
  return packing;
}

}  // namespace

std::vector<std::byte> unpack_meshopt(const Object& packed, std::span<const std::byte> bytes) {
  const Packing packing = read_packing(packed, bytes.size());
  std::vector<std::byte> out(packing.count * packing.stride);
  if (out.empty()) return out;
  const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
  int error = 0;
  switch (packing.mode) {
    case PackMode::kAttributes:
      error = meshopt_decodeVertexBuffer(out.data(), packing.count, packing.stride, data, bytes.size());
      break;
    case PackMode::kTriangles:
      error = meshopt_decodeIndexBuffer(out.data(), packing.count, packing.stride, data, bytes.size());
      break;
    case PackMode::kIndices:
      error = meshopt_decodeIndexSequence(out.data(), packing.count, packing.stride, data, bytes.size());
      break;
  }
  if (error != 0) {
    packed.fail("its {} bytes are damaged or too few for {} elements of {} bytes; legal: meshopt data",
                bytes.size(), packing.count, packing.stride);
  }
  if (packing.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), packing.count, packing.stride);
  if (packing.filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), packing.count, packing.stride);
  if (packing.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), packing.count, packing.stride);
  return out;
}

}  // namespace halfspace::gltf
