/// The vertices of some triangles, as setup takes them: the work of the front end is done once for each,
/// however many triangles share it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>

namespace halfspace::fast {

struct VertexChunk {
  static constexpr std::uint32_t kMostTriangles = 256;
  static constexpr std::size_t kMostVertices = 3 * kMostTriangles;

  template <class T>
  using Field = std::array<T, kMostVertices + 64>;  ///< vectors may read and write past the last

  std::uint32_t first = 0;  ///< triangle of the draw
  std::uint32_t end = 0;
  std::uint32_t lowest = 0;           ///< number of the first vertex
  bool in_order = false;              ///< each triangle has the next three, else those that its indices say
  bool some_strange = false;          ///< a vertex is not for vectors, as it is
  alignas(64) Field<std::int32_t> x;  ///< in 1/2^SubPixelBits pixel
  alignas(64) Field<std::int32_t> y;
  alignas(64) Field<std::int32_t> z;        ///< vertex depth
  alignas(64) Field<std::int32_t> strange;  ///< bit i: outside the i-th plane of the front end; and these
  static constexpr std::int32_t kPlanes = 0x3F;
  static constexpr std::int32_t kNotFinite = 0x40;
  static constexpr std::int32_t kOdd = 0x80;         ///< else not for vectors
  std::array<glm::vec4, kMostVertices + 64> copied;  ///< where the draw has them far apart
};

}  // namespace halfspace::fast
