/// Attributes over a triangle of a frame, by the unit interpolator.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "halfspace/numerics/sample_pattern.hpp"
#include "halfspace/scene/front_end.hpp"
#include "halfspace/units/link_packets.hpp"
#include "halfspace/units/packets.hpp"

namespace halfspace {

enum class Interpolation : std::uint8_t {
  kPerspective,  ///< linear in space
  kAffine,       ///< linear in the picture: 1/w counts for nothing
  kFlat,         ///< that of the triangle's first vertex everywhere
};

/// Bits of the interpolator's mantissas and weights in pictures: the most that it has.
inline constexpr int kShaderBits = 24;

/// What a quad of pixels has of one attribute: the unit's numbers, by pixel, in units of 2^-16.
using QuadValues = std::array<std::array<std::int32_t, 4>, 4>;

/// One triangle of a frame: the triangles on the sub-pixel grid that it became, at whose corners its
/// attributes are found by the weights that clipping gave them.
class AttributePlanes {
 public:
  /// Of nothing.
  AttributePlanes() = default;
  /// `index`: of the triangle in its draw.
  AttributePlanes(const FrontEnd& front_end, std::uint32_t index, int sub_pixel_bits);

  /// Pieces: none where nothing of the triangle reaches setup.
  [[nodiscard]] std::size_t size() const { return pieces_.size(); }

  /// The piece that has the pixel's centre inside or on its edge; where there is none, since rounding or
  /// another rasterizer put the pixel into the triangle, the one that is least far from it. size() is above
  /// 0.
  [[nodiscard]] std::size_t piece_at(int x, int y) const;

  /// Which pixels of the quad at (x, y), its upper left pixel, are in the piece or on its edge.
  [[nodiscard]] std::uint8_t mask(std::size_t piece, int x, int y) const;

  /// The packet for the interpolator. `mask`: pixels of the quad that are covered. `corners`: the attribute
  /// at the triangle's three vertices. `sample`: of each pixel, where it is wanted.
  [[nodiscard]] AttributeQuad packet(std::size_t piece, int x, int y, std::uint8_t mask,
                                     const std::array<glm::dvec4, 3>& corners, Interpolation how,
                                     const SamplePosition& sample = {}) const;

  /// The place, for the functions above, of triangle `number` of the fan that clipping made.
  [[nodiscard]] std::size_t place_of(std::uint8_t number) const;

  /// What the unit makes of that packet.
  [[nodiscard]] QuadValues values(std::size_t piece, int x, int y, std::uint8_t mask,
                                  const std::array<glm::dvec4, 3>& corners, Interpolation how) const;

 private:
  struct Edge {
    std::int64_t e = 0;  ///< unbiased, at the origin of the window
    std::int64_t a = 0;  ///< step of a sub-pixel to the right, and down
    std::int64_t b = 0;
  };
  struct Piece {
    std::array<Edge, 3> edges;  ///< edge i faces corner i; inside is above 0
    std::int64_t area2 = 0;
    std::array<FrontEnd::Corner, 3> corners;
    std::array<std::uint32_t, 3> q{};  ///< 1/w as float32, as parts of the largest
    std::uint8_t number = 0;           ///< in the fan, of which those without area are left out
  };

  void add(const ScreenTriangle& screen, const std::array<FrontEnd::Corner, 3>& corners);
  /// E of the edge at a sample of the pixel, its centre unless told.
  [[nodiscard]] std::int64_t edge_at(const Edge& edge, int x, int y, const SamplePosition& sample = {}) const;
  [[nodiscard]] bool covers(const Piece& piece, int x, int y) const;

  int sub_pixel_bits_ = 0;
  std::vector<Piece> pieces_;
};

/// To 16 bits below the point, to the nearest; saturates.
[[nodiscard]] std::int32_t to_attribute(double value);

}  // namespace halfspace
