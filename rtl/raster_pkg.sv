// Widths and packets of the links between the units, for every configuration.
//
// Printed by the target print_raster_pkg from model/numerics/widths.hpp and model/units/packets.hpp: change those
// and print this file again. A configuration is chosen by -DHALFSPACE_TILE_SIZE=4|8|16 and
// -DHALFSPACE_SUB_PIXEL_BITS=4..8.

`ifndef HALFSPACE_TILE_SIZE
`define HALFSPACE_TILE_SIZE 8
`endif
`ifndef HALFSPACE_SUB_PIXEL_BITS
`define HALFSPACE_SUB_PIXEL_BITS 8
`endif

package raster_pkg;

  parameter int unsigned SubPixelBits = `HALFSPACE_SUB_PIXEL_BITS;
  parameter int unsigned TileSize = `HALFSPACE_TILE_SIZE;

  // window coordinate, signed, 1/2^SubPixelBits pixel
  parameter int unsigned CoordBits = 16 + SubPixelBits;
  // A or B of an edge: the difference of two coordinates
  parameter int unsigned StepBits = CoordBits + 1;
  // E at any sample inside the guard band
  parameter int unsigned EdgeBits = 2 * CoordBits + 3;
  // floor(E / 2^SubPixelBits), which decides coverage at pixel centres
  parameter int unsigned PixelEdgeBits = EdgeBits - SubPixelBits;
  // pixel coordinate on a screen of at most 16384
  parameter int unsigned PixelBits = 14;
  // pixel coordinate inside a tile
  parameter int unsigned TileLog2 = (TileSize == 4 ? 2 : TileSize == 8 ? 3 : 4);
  // coordinate of a tile on the screen
  parameter int unsigned TileCoordBits = PixelBits - TileLog2;
  // edge value inside one tile, saturated at the tile origin
  parameter int unsigned LocalEdgeBits = StepBits + TileLog2 + 2;
  // coverage mask of a tile, bit y * TileSize + x
  parameter int unsigned MaskBits = TileSize * TileSize;
  // edges of a triangle: one accept bit each
  parameter int unsigned EdgeCount = 3;
  // where the units keep what all tiles of a triangle share
  parameter int unsigned SlotBits = 8;

  typedef logic signed [EdgeBits-1:0] edge_t;
  typedef logic signed [StepBits-1:0] step_t;

  // tile_walker -> edge_evaluator
  typedef struct packed {
    logic [SlotBits-1:0] slot;
    logic [TileCoordBits-1:0] tile_x;
    logic [TileCoordBits-1:0] tile_y;
    edge_t [2:0] e;
    step_t [2:0] a;
    step_t [2:0] b;
    logic [EdgeCount-1:0] accept;
    logic [TileLog2-1:0] x_first;
    logic [TileLog2-1:0] x_last;
    logic [TileLog2-1:0] y_first;
    logic [TileLog2-1:0] y_last;
  } tile_job_t;

  // edge_evaluator -> quad_generator
  typedef struct packed {
    logic [SlotBits-1:0] slot;
    logic [TileCoordBits-1:0] tile_x;
    logic [TileCoordBits-1:0] tile_y;
    edge_t [1:0] e;
    logic [MaskBits-1:0] mask;
  } coverage_t;

endpackage : raster_pkg

`undef HALFSPACE_TILE_SIZE
`undef HALFSPACE_SUB_PIXEL_BITS
