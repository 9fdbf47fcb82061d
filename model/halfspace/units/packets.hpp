/// The packets that cross the links between the units.
///
/// A packet that also exists in SystemVerilog lists its fields once, in fields(), most significant first: the
/// package, the bit packing of the benches and the first-difference reports are all derived from that list.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "halfspace/numerics/widths.hpp"

namespace halfspace {

enum class Sign : std::uint8_t { kUnsigned, kSigned };

/// A vertex as setup takes it. z is a fixed-point number or the bits of a float32, see numerics/depth.hpp.
struct ScreenVertex {
  std::int32_t x = 0;  ///< window coordinate in 1/2^SubPixelBits pixel, y down
  std::int32_t y = 0;
  std::int64_t z = 0;
};

/// Inclusive pixel rectangle; empty when a last is smaller than its first.
struct PixelRect {
  std::int32_t x_first = 0;
  std::int32_t y_first = 0;
  std::int32_t x_last = -1;
  std::int32_t y_last = -1;
  [[nodiscard]] bool empty() const { return x_last < x_first || y_last < y_first; }
  friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

constexpr PixelRect intersect(const PixelRect& l, const PixelRect& r) {
  return {.x_first = std::max(l.x_first, r.x_first),
          .y_first = std::max(l.y_first, r.y_first),
          .x_last = std::min(l.x_last, r.x_last),
          .y_last = std::min(l.y_last, r.y_last)};
}

/// Every pixel that a screen can have.
inline constexpr PixelRect kWholeScreen{.x_last = (1 << Widths{}.PixelBits) - 1,
                                        .y_last = (1 << Widths{}.PixelBits) - 1};

/// What the vertices of a ScreenTriangle are.
enum class ScreenShape : std::uint8_t {
  kTriangle,
  kThinLine,  ///< from vertex 0 to vertex 1, by the rule of its draw (units/line_setup.hpp)
};

/// front end -> setup: a triangle on the sub-pixel grid, in API vertex order, or a thin line.
struct ScreenTriangle {
  std::array<ScreenVertex, 3> v;
  std::uint32_t triangle = 0;       ///< index of the source triangle in its draw; clipping may repeat it
  std::int64_t offset = 0;          ///< added to the depth of each fragment; in the form of z
  PixelRect within = kWholeScreen;  ///< the pixels that are drawn
  ScreenShape shape = ScreenShape::kTriangle;
  std::uint8_t piece = 0;  ///< of the fan that clipping made of the source triangle; 0 for lines and points
};

/// One edge equation: inside is E >= 0, because the fill rule is folded into c.
struct Edge {
  std::int32_t a = 0;  ///< y_i - y_j: change of E for 1/2^SubPixelBits pixel in x
  std::int32_t b = 0;  ///< x_j - x_i: the same in y
  std::int64_t c = 0;  ///< E at the centre of pixel (0, 0), less 1 unless the edge owns its samples
};

/// Holds the widest gradient. Everything is modulo a power of two, so there is no sign.
__extension__ using Modular = unsigned __int128;

/// The plane of a triangle's depth, modulo powers of two; see units/depth_plane.hpp.
struct PlaneEquation {
  Modular dx = 0;  ///< change for 1/2^SubPixelBits pixel in x, kGradientFraction bits below a word
  Modular dy = 0;
  std::int64_t z = 0;  ///< word at vertex 0
  std::int32_t x = 0;  ///< where vertex 0 is, in 1/2^SubPixelBits pixel
  std::int32_t y = 0;
};

/// What early_z needs to know of a triangle to interpolate depth; see units/depth_interpolator.hpp. Vertex i
/// is opposite to edge i, so E_i / 2A is its weight.
struct DepthEquation {
  std::array<std::int64_t, 3> z{};     ///< vertex depths
  std::array<std::uint8_t, 3> bias{};  ///< 1 where the fill rule lowered c of the edge
  bool beyond = false;                 ///< unorm: a vertex depth is below 0, or at kShortWordEnd or above
  std::int16_t exponent = 0;           ///< 2^exponent is above every vertex depth and the offset
  std::int64_t area2 = 0;              ///< 2A, the sum of the three unbiased E
  std::int64_t offset = 0;     ///< unorm: as in ScreenTriangle; float32: a word, see units/depth_plane.hpp
  std::uint32_t min_code = 0;  ///< the range of the triangle's stored codes
  std::uint32_t max_code = 0;
  std::uint32_t reciprocal = 0;  ///< barycentric: (2^63 - 1) / (2A scaled to 32 bits)
  std::int8_t shift = 0;         ///< barycentric: E >> shift is on the scale of the 32-bit 2A
  PlaneEquation plane;           ///< plane
};

/// Depth as hi_z sees it; see units/hi_z_plane.hpp.
struct HiZPlane {
  std::int64_t z = 0;   ///< the polygon offset in it
  std::int64_t dx = 0;  ///< change for a pixel
  std::int64_t dy = 0;
  bool known = false;  ///< else the plane is too steep, or nobody asked for it
};

/// setup -> block_walker.
struct SetupTriangle {
  std::array<Edge, 3> edge;
  HiZPlane plane;    ///< at the centre of pixel (0, 0)
  PixelRect bounds;  ///< pixels that scissor and target hold, and of which the bounding box may hold a sample
  DepthEquation depth;
  std::uint32_t triangle = 0;
  bool front = false;      ///< faces front; only who looks at quads asks
  std::uint8_t piece = 0;  ///< as in ScreenTriangle; only the interpolator asks
};

/// block_walker -> tile_walker: a block that a triangle may touch.
struct BlockJob {
  std::uint8_t slot = 0;  ///< where the triangle's depth equation and draw state are kept: one more, modulo
                          ///< 256, for each triangle that has a block job; hi_z counts those of its own
  std::uint16_t block_x = 0;  ///< in blocks
  std::uint16_t block_y = 0;
  std::array<std::int64_t, 3> e{};  ///< E at the centre of the block's top left pixel, fill rule folded in
  std::array<std::int32_t, 3> a{};
  std::array<std::int32_t, 3> b{};
  std::uint8_t x_first = 0;  ///< columns and rows inside the bounds, inclusive, counted in the block
  std::uint8_t x_last = 0;
  std::uint8_t y_first = 0;
  std::uint8_t y_last = 0;
  std::uint64_t tiles = 0;  ///< bit y * (tiles in a row of the block) + x: the triangle may touch it
  std::uint64_t sure = 0;   ///< of these: every sample of the triangle in it passes, and writes
  std::int64_t z = 0;       ///< HiZPlane at the centre of the block's top left pixel
  std::int64_t z_dx = 0;
  std::int64_t z_dy = 0;
  std::uint8_t z_known = 0;

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    visit("slot", &BlockJob::slot, &Widths::SlotBits, Sign::kUnsigned);
    visit("block_x", &BlockJob::block_x, &Widths::BlockCoordBits, Sign::kUnsigned);
    visit("block_y", &BlockJob::block_y, &Widths::BlockCoordBits, Sign::kUnsigned);
    visit("e", &BlockJob::e, &Widths::EdgeBits, Sign::kSigned);
    visit("a", &BlockJob::a, &Widths::StepBits, Sign::kSigned);
    visit("b", &BlockJob::b, &Widths::StepBits, Sign::kSigned);
    visit("x_first", &BlockJob::x_first, &Widths::BlockLog2, Sign::kUnsigned);
    visit("x_last", &BlockJob::x_last, &Widths::BlockLog2, Sign::kUnsigned);
    visit("y_first", &BlockJob::y_first, &Widths::BlockLog2, Sign::kUnsigned);
    visit("y_last", &BlockJob::y_last, &Widths::BlockLog2, Sign::kUnsigned);
    visit("tiles", &BlockJob::tiles, &Widths::BlockTiles, Sign::kUnsigned);
    visit("sure", &BlockJob::sure, &Widths::BlockTiles, Sign::kUnsigned);
    visit("z", &BlockJob::z, &Widths::HiZWordBits, Sign::kSigned);
    visit("z_dx", &BlockJob::z_dx, &Widths::HiZStepBits, Sign::kSigned);
    visit("z_dy", &BlockJob::z_dy, &Widths::HiZStepBits, Sign::kSigned);
    visit("z_known", &BlockJob::z_known, &Widths::FlagBits, Sign::kUnsigned);
  }
};

/// tile_walker -> edge_evaluator: one sample of each pixel of a tile that a triangle may touch.
///
/// A surface of S samples a pixel is S planes of one. The S tiles of a place lie side by side: sample i of
/// the tile in column x of the screen has tile_x = S x + i, here and in all packets that follow. With one
/// sample that is the column.
struct TileJob {
  std::uint8_t slot = 0;     ///< as in BlockJob
  std::uint16_t tile_x = 0;  ///< in tiles
  std::uint16_t tile_y = 0;
  std::array<std::int64_t, 3> e{};  ///< E at the sample of the tile's top left pixel, fill rule folded in
  std::array<std::int32_t, 3> a{};
  std::array<std::int32_t, 3> b{};
  std::uint8_t sure = 0;     ///< 1: every sample of the triangle in it passes, and writes
  std::uint8_t accept = 0;   ///< bit i: every sample of the tile is inside edge i
  std::uint8_t x_first = 0;  ///< columns and rows inside the bounds, inclusive, counted in the tile
  std::uint8_t x_last = 0;
  std::uint8_t y_first = 0;
  std::uint8_t y_last = 0;

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    visit("slot", &TileJob::slot, &Widths::SlotBits, Sign::kUnsigned);
    visit("tile_x", &TileJob::tile_x, &Widths::TileCoordBits, Sign::kUnsigned);
    visit("tile_y", &TileJob::tile_y, &Widths::TileCoordBits, Sign::kUnsigned);
    visit("e", &TileJob::e, &Widths::EdgeBits, Sign::kSigned);
    visit("a", &TileJob::a, &Widths::StepBits, Sign::kSigned);
    visit("b", &TileJob::b, &Widths::StepBits, Sign::kSigned);
    visit("sure", &TileJob::sure, &Widths::FlagBits, Sign::kUnsigned);
    visit("accept", &TileJob::accept, &Widths::EdgeCount, Sign::kUnsigned);
    visit("x_first", &TileJob::x_first, &Widths::TileLog2, Sign::kUnsigned);
    visit("x_last", &TileJob::x_last, &Widths::TileLog2, Sign::kUnsigned);
    visit("y_first", &TileJob::y_first, &Widths::TileLog2, Sign::kUnsigned);
    visit("y_last", &TileJob::y_last, &Widths::TileLog2, Sign::kUnsigned);
  }
};

/// Which samples of a tile are covered: bit y * TileSize + x, in as many words as the tile needs.
struct TileMask {
  std::array<std::uint64_t, 4> word{};
  friend bool operator==(const TileMask&, const TileMask&) = default;
};

/// edge_evaluator -> quad_generator.
struct Coverage {
  std::uint8_t slot = 0;
  std::uint16_t tile_x = 0;
  std::uint16_t tile_y = 0;
  std::uint8_t sure = 0;            ///< as in TileJob
  std::array<std::int64_t, 2> e{};  ///< E of edges 1 and 2 at the tile origin: the depth inputs
  TileMask mask;

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    visit("slot", &Coverage::slot, &Widths::SlotBits, Sign::kUnsigned);
    visit("tile_x", &Coverage::tile_x, &Widths::TileCoordBits, Sign::kUnsigned);
    visit("tile_y", &Coverage::tile_y, &Widths::TileCoordBits, Sign::kUnsigned);
    visit("sure", &Coverage::sure, &Widths::FlagBits, Sign::kUnsigned);
    visit("e", &Coverage::e, &Widths::EdgeBits, Sign::kSigned);
    visit("mask", &Coverage::mask, &Widths::MaskBits, Sign::kUnsigned);
  }
};

/// quad_generator -> early_z: the 2x2 quads of one tile that hold a covered sample, in row order.
struct QuadBurst {
  Coverage coverage;
  TileMask quads;  ///< the bit of the top left pixel of every quad that is not empty
};

}  // namespace halfspace
