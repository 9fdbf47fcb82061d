/// The widths of every number that crosses a link, as formulas of the parameters of the machine.
///
/// This table is the one source for C++ and SystemVerilog: each formula is compiled here and printed, as the
/// same text, into rtl/raster_pkg.sv (see report/raster_pkg.hpp). The names are therefore SystemVerilog's.
#pragma once

#include "halfspace/config/keys.hpp"
#include "halfspace/numerics/sample_pattern.hpp"

namespace halfspace {

// clang-format off
/// W(name, formula, meaning). A formula may use the parameters (see Widths) and the names above it.
#define HALFSPACE_WIDTHS(W)                                                                                       \
  W(CoordBits,       16 + SubPixelBits,                                "window coordinate, signed, 1/2^SubPixelBits pixel") \
  W(StepBits,        CoordBits + 1,                                    "A or B of an edge: the difference of two coordinates") \
  W(EdgeBits,        2 * CoordBits + 3,                                "E at any sample inside the guard band")      \
  W(PixelEdgeBits,   EdgeBits - SubPixelBits,                          "floor(E / 2^SubPixelBits), which decides coverage at pixel centres") \
  W(PixelBits,       14,                                               "pixel coordinate on a screen of at most 16384") \
  W(TileLog2,        (TileSize == 4 ? 2 : TileSize == 8 ? 3 : 4),      "pixel coordinate inside a tile")             \
  W(TileCoordBits,   PixelBits - TileLog2,                             "coordinate of a tile on the screen")         \
  W(SampleLog2,      (PixelSamples == 1 ? 0 : PixelSamples == 2 ? 1 : PixelSamples == 4 ? 2 : PixelSamples == 8 ? 3 : 4), "sample of a pixel") \
  W(TileColumnBits,  TileCoordBits + SampleLog2,                       "column of a tile behind tile_walker, where the tiles of all samples lie side by side") \
  W(BlockTiles,      BlockSize * BlockSize / (TileSize * TileSize),    "tiles of a block: a mask, bit y * BlockSize / TileSize + x") \
  W(BlockLog2,       TileLog2 + (BlockTiles == 4 ? 1 : BlockTiles == 16 ? 2 : 3), "pixel coordinate inside a block") \
  W(BlockCoordBits,  PixelBits - BlockLog2,                            "coordinate of a block on the screen")        \
  W(LocalEdgeBits,   StepBits + TileLog2 + 2,                          "edge value inside one tile, saturated at the tile origin") \
  W(MaskBits,        TileSize * TileSize,                              "coverage mask of a tile, bit y * TileSize + x") \
  W(EdgeCount,       3,                                                "edges of a triangle: one accept bit each")     \
  W(SlotBits,        8,                                                "where the units keep what all tiles of a triangle share") \
  W(FlagBits,        1,                                                "yes or no")                                  \
  W(FillRuleBits,    2,                                                "bit 0: bottom edges own the samples on them, not top ones; bit 1: right edges, not left ones") \
  W(LineRuleBits,    3,                                                "0: a triangle; else a thin line, by its rule: 1 bresenham, 2 diamond exit, 3 midpoint, 4 DDA") \
  W(LineWidthBits,   7,                                                "pixels that a thin line has in a column, at most 64") \
  W(VertexDepthBits, 48,                                               "depth of a vertex, or polygon offset: a unorm code with a fraction below it, signed, or a float32 in the low bits") \
  W(WordBits,        64,                                               "depth with the binary point behind the sign, on a scale of the triangle") \
  W(HalfGradientBits, 43,                                              "half of a gradient of depth: a word and 22 bits below it, together 86") \
  W(ExponentBits,    9,                                                "power of two above all depths of a triangle, signed") \
  W(HiZWordBits,     50,                                               "depth as hi_z sees it: a word of 32 bits, 16 bits below it, and 2 above, signed") \
  W(HiZStepBits,     42,                                               "its change for a pixel, signed")             \
  W(CodeBits,        32,                                               "a stored depth code of any format")           \
  W(ReciprocalBits,  32,                                               "(2^63 - 1) / (2A scaled to 32 bits)")         \
  W(ShiftBits,       6,                                                "E >> shift is on the scale of the 32-bit 2A, signed") \
  W(FormatBits,      3,                                                "depth format: 0 none, 1 unorm16, 2 unorm24, 4 float32") \
  W(FuncBits,        3,                                                "depth comparison, numbered as in Vulkan")     \
  W(LineBits,        32,                                               "number of a tile, or of a line of depth in memory") \
  W(TileQuads,       TileSize * TileSize / 4,                          "quads of a tile")                            \
  W(QuadIndexBits,   2 * TileLog2 - 2,                                 "a quad of the tile, in row order")           \
  W(QuadMaskBits,    4,                                                "samples of a quad: (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)") \
  W(TestSamples,     4 * TestWidth,                                    "samples that are tested in a cycle") \
  W(FloatBits,       32,                                               "a float32") \
  W(AttributeBits,   32,                                               "a component of an attribute: fixed-point with 16 bits below the point, signed") \
  W(QuadPixels,      4,                                                "pixels of a quad") \
  W(Components,      4,                                                "components of an attribute") \
  W(VertexValues,    3 * Components,                                   "components at the three vertices") \
  W(QuadValues,      QuadPixels * Components,                          "components at the four pixels of a quad")
// clang-format on

/// All widths for one choice of the parameters, which are the PACKAGE rows of the configuration's keys.
struct Widths {
#define NOTHING(...)
#define PARAMETER(section, name, type, value, legal, unit, changes, help, Parameter, define) \
  type Parameter = value;
  HALFSPACE_KEYS(NOTHING, NOTHING, NOTHING, NOTHING, PARAMETER)
#undef NOTHING
#undef PARAMETER
#define W(name, formula, meaning) int name = formula;
  HALFSPACE_WIDTHS(W)
#undef W
};

}  // namespace halfspace
