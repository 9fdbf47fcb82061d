/// The widths of every number that crosses a link, as formulas of two parameters.
///
/// This table is the one source for C++ and SystemVerilog: each formula is compiled here and printed, as the
/// same text, into rtl/raster_pkg.sv (see report/raster_pkg.hpp). The names are therefore SystemVerilog's.
#pragma once

namespace halfspace {

// clang-format off
/// W(name, formula, meaning). A formula may use SubPixelBits, TileSize and the names above it.
#define HALFSPACE_WIDTHS(W)                                                                                       \
  W(CoordBits,       16 + SubPixelBits,                                "window coordinate, signed, 1/2^SubPixelBits pixel") \
  W(StepBits,        CoordBits + 1,                                    "A or B of an edge: the difference of two coordinates") \
  W(EdgeBits,        2 * CoordBits + 3,                                "E at any sample inside the guard band")      \
  W(PixelEdgeBits,   EdgeBits - SubPixelBits,                          "floor(E / 2^SubPixelBits), which decides coverage at pixel centres") \
  W(PixelBits,       14,                                               "pixel coordinate on a screen of at most 16384") \
  W(TileLog2,        (TileSize == 4 ? 2 : TileSize == 8 ? 3 : 4),      "pixel coordinate inside a tile")             \
  W(TileCoordBits,   PixelBits - TileLog2,                             "coordinate of a tile on the screen")         \
  W(LocalEdgeBits,   StepBits + TileLog2 + 2,                          "edge value inside one tile, saturated at the tile origin") \
  W(MaskBits,        TileSize * TileSize,                              "coverage mask of a tile, bit y * TileSize + x") \
  W(EdgeCount,       3,                                                "edges of a triangle: one accept bit each")     \
  W(SlotBits,        8,                                                "where the units keep what all tiles of a triangle share")
// clang-format on

/// All widths for one choice of the two parameters.
struct Widths {
  int SubPixelBits = 8;  ///< 4 to 8
  int TileSize = 8;      ///< 4, 8 or 16 pixels
#define W(name, formula, meaning) int name = formula;
  HALFSPACE_WIDTHS(W)
#undef W
};

}  // namespace halfspace
