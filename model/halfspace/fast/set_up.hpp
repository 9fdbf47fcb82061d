/// Triangles between setup and the raster kernels: field by field in arrays, so that vectors take many at a
/// time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/machine/draw_context.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace::fast {

/// How the codes of a triangle come about.
enum class DepthKind : std::uint8_t {
  kNone,   ///< there is no depth test: all pass, and nothing is written
  kFlat,   ///< one code
  kShort,  ///< the plane in 32-bit words, its gradients in 64 bits
  kLong,   ///< the plane of a float32 surface: 64-bit words, gradients in 128 bits
  kUnits,  ///< as the units do it
};

/// The depth of a triangle, as the fast core makes codes of it.
struct Plane {
  DepthKind kind = DepthKind::kNone;
  std::uint32_t equation = 0;  ///< kUnits: the number of its equation
  std::int32_t low = 0;        ///< the range of its codes; the code of a flat one
  std::int32_t high = 0;
  std::int64_t add = 0;  ///< to every word: polygon offset and what rounds
  std::int32_t x = 0;    ///< vertex 0 in 1/2^SubPixelBits pixel
  std::int32_t y = 0;
  std::int64_t z = 0;    ///< word at vertex 0
  std::uint64_t dx = 0;  ///< of PlaneEquation, the low 64 bits; for kShort, as signed numbers, all of it
  std::uint64_t dy = 0;
  std::int64_t dx_high = 0;  ///< kLong: the others
  std::int64_t dy_high = 0;
  int exponent = 0;  ///< kLong: of DepthEquation
};

/// Triangles of a draw, in order.
struct SetUpTriangles {
  static constexpr std::size_t kMost = 256;
  static constexpr std::size_t kRoom = kMost + 16;  ///< vectors may write past the last

  template <class T>
  using Field = std::array<T, kRoom>;

  std::size_t count = 0;
  alignas(64) std::array<Field<std::int32_t>, 3> a;
  alignas(64) std::array<Field<std::int32_t>, 3> b;
  alignas(64) std::array<Field<std::int64_t>, 3> e;  ///< in pixel steps: floor(c / 2^SubPixelBits)
  alignas(64) Field<std::int32_t> x_first;
  alignas(64) Field<std::int32_t> y_first;
  alignas(64) Field<std::int32_t> x_last;
  alignas(64) Field<std::int32_t> y_last;
  alignas(64) Field<std::int32_t> number;  ///< of the triangle in the draw
  alignas(64) Field<std::int32_t> order;   ///< among those that setup has seen in the draw
  alignas(64) Field<std::int32_t> kind;    ///< DepthKind
  alignas(64) Field<std::int32_t> low;
  alignas(64) Field<std::int32_t> high;
  alignas(64) Field<std::int64_t> added;
  alignas(64) Field<std::int32_t> x;
  alignas(64) Field<std::int32_t> y;
  alignas(64) Field<std::int64_t> z;
  alignas(64) Field<std::uint64_t> dx;
  alignas(64) Field<std::uint64_t> dy;
  alignas(64) Field<std::int64_t> dx_high;
  alignas(64) Field<std::int64_t> dy_high;
  alignas(64) Field<std::int32_t> exponent;
  alignas(64) Field<std::int32_t> full;        ///< kUnits: index in `whole`
  std::vector<SetupTriangle> whole;            ///< of those that need the units
  const SetupTriangle* first_whole = nullptr;  ///< here, or where the triangles have been taken from

  /// Calls visit(field, same field of `other`) for each.
  template <class Visit>
  void for_fields(SetUpTriangles& other, Visit&& visit) const {
    for (std::size_t k = 0; k < 3; ++k) {
      visit(a[k], other.a[k]);
      visit(b[k], other.b[k]);
      visit(e[k], other.e[k]);
    }
    for (const auto member :
         {&SetUpTriangles::x_first, &SetUpTriangles::y_first, &SetUpTriangles::x_last,
          &SetUpTriangles::y_last, &SetUpTriangles::number, &SetUpTriangles::order, &SetUpTriangles::kind,
          &SetUpTriangles::low, &SetUpTriangles::high, &SetUpTriangles::x, &SetUpTriangles::y,
          &SetUpTriangles::exponent, &SetUpTriangles::full}) {
      visit(this->*member, other.*member);
    }
    for (const auto member :
         {&SetUpTriangles::added, &SetUpTriangles::z, &SetUpTriangles::dx_high, &SetUpTriangles::dy_high}) {
      visit(this->*member, other.*member);
    }
    for (const auto member : {&SetUpTriangles::dx, &SetUpTriangles::dy}) {
      visit(this->*member, other.*member);
    }
  }

  void clear() {
    count = 0;
    whole.clear();
  }

  /// Appends what the readable setup made of the last triangle that it counted in `draw`. `has_depth`: of the
  /// draw, there is a surface and a test.
  void append(const SetupTriangle& triangle, const DrawContext& draw, int sub_pixel_bits, bool has_depth);
};

}  // namespace halfspace::fast
