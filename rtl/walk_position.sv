// Where the walk of a triangle is: blocks in row order over the bounds, in each block that is entered its tiles in row
// order. Where the bounds fit one tile, or without blocks, there are only tiles.

module walk_position
  import raster_pkg::*;
#(
  /// Pixels on a side of a block, as a power of two; more than TileLog2.
  parameter int unsigned BlockLog2 = 5,
  /// 0: no blocks.
  parameter bit BlockLevel = 1'b1
) (
  input  logic                     clk_i,
  input  logic                     load_i,
  input  logic [PixelBits-1:0]     x_first_i,
  input  logic [PixelBits-1:0]     x_last_i,
  input  logic [PixelBits-1:0]     y_first_i,
  input  logic [PixelBits-1:0]     y_last_i,

  input  logic                     advance_i, // to the next square, at the end of the cycle
  input  logic                     enter_i,   // of a block: its tiles are next

  output logic                     at_block_o,
  output logic                     row_end_o,      // the square is the last of its size in the row
  output logic                     leave_o,        // the tile is the last of its block
  output logic                     first_column_o, // the block is in the first column of blocks
  output logic                     first_row_o,
  output logic                     last_block_o,   // no block comes after this one
  output logic                     last_tile_o,    // no tile of this block comes after this one

  // The tile, and the part of it in the bounds.
  output logic [TileCoordBits-1:0] tile_x_o,
  output logic [TileCoordBits-1:0] tile_y_o,
  output logic [TileLog2-1:0]      x_first_o,
  output logic [TileLog2-1:0]      x_last_o,
  output logic [TileLog2-1:0]      y_first_o,
  output logic [TileLog2-1:0]      y_last_o
);

  localparam int unsigned BlockCoordBits = PixelBits - BlockLog2;
  localparam int unsigned SkipBits = BlockLog2 - TileLog2;

  typedef logic [BlockCoordBits-1:0] block_coord_t;
  typedef logic [TileCoordBits-1:0] tile_coord_t;
  typedef logic [TileLog2-1:0] pixel_t;

  // A pixel coordinate, taken apart.
  typedef struct packed {
    tile_coord_t tile;
    pixel_t      pixel; // in the tile
  } in_tile_t;
  typedef struct packed {
    block_coord_t        block;
    logic [SkipBits-1:0] tile; // in the block
  } in_block_t;

  // Bounds, in tiles and in the pixels of the first and last tile.
  tile_coord_t x_first_q, x_last_q, y_first_q, y_last_q;
  pixel_t      x_first_pixel_q, x_last_pixel_q, y_first_pixel_q, y_last_pixel_q;
  logic        one_tile;

  assign one_tile = tile_of(x_first_i) == tile_of(x_last_i) &&
                    tile_of(y_first_i) == tile_of(y_last_i);

  logic         with_blocks_q, at_block_q;
  block_coord_t block_x_q, block_y_q;
  tile_coord_t  tile_x_q, tile_y_q;

  // The block's place among the blocks, and its tiles in the bounds.
  logic        block_row_end, last_column, last_row;
  tile_coord_t column_first, column_last, row_first, row_last;

  assign first_column_o = block_x_q == block_of(x_first_q);
  assign first_row_o    = block_y_q == block_of(y_first_q);
  assign last_column    = block_x_q == block_of(x_last_q);
  assign last_row       = block_y_q == block_of(y_last_q);
  assign block_row_end  = last_column;
  assign last_block_o   = ~with_blocks_q | (last_column & last_row);

  assign column_first = with_blocks_q && !first_column_o ? {block_x_q, SkipBits'(0)} : x_first_q;
  assign row_first    = with_blocks_q && !first_row_o ? {block_y_q, SkipBits'(0)} : y_first_q;
  assign column_last  = with_blocks_q && !last_column ? {block_x_q, {SkipBits{1'b1}}} : x_last_q;
  assign row_last     = with_blocks_q && !last_row ? {block_y_q, {SkipBits{1'b1}}} : y_last_q;

  logic tile_row_end;
  assign tile_row_end = tile_x_q == column_last;
  assign last_tile_o  = tile_row_end && tile_y_q == row_last;

  assign at_block_o = at_block_q;
  assign row_end_o  = at_block_q ? block_row_end : tile_row_end;
  assign leave_o    = with_blocks_q & last_tile_o;

  logic next_block;  // the square after this one is another block
  assign next_block = at_block_q ? ~enter_i : leave_o;

  always_ff @(posedge clk_i) begin
    if (load_i) begin
      x_first_q       <= tile_of(x_first_i);
      x_last_q        <= tile_of(x_last_i);
      y_first_q       <= tile_of(y_first_i);
      y_last_q        <= tile_of(y_last_i);
      x_first_pixel_q <= x_first_i[TileLog2-1:0];
      x_last_pixel_q  <= x_last_i[TileLog2-1:0];
      y_first_pixel_q <= y_first_i[TileLog2-1:0];
      y_last_pixel_q  <= y_last_i[TileLog2-1:0];
      with_blocks_q   <= BlockLevel & ~one_tile;
      at_block_q      <= BlockLevel & ~one_tile;
      block_x_q       <= block_of(tile_of(x_first_i));
      block_y_q       <= block_of(tile_of(y_first_i));
      tile_x_q        <= tile_of(x_first_i);
      tile_y_q        <= tile_of(y_first_i);
    end else if (advance_i && next_block) begin
      at_block_q <= 1'b1;
      block_x_q  <= block_row_end ? block_of(x_first_q) : block_x_q + block_coord_t'(1);
      if (block_row_end) begin
        block_y_q <= block_y_q + block_coord_t'(1);
      end
    end else if (advance_i && at_block_q) begin
      at_block_q <= 1'b0;
      tile_x_q   <= column_first;
      tile_y_q   <= row_first;
    end else if (advance_i) begin
      tile_x_q <= tile_row_end ? column_first : tile_x_q + tile_coord_t'(1);
      if (tile_row_end) begin
        tile_y_q <= tile_y_q + tile_coord_t'(1);
      end
    end
  end

  assign tile_x_o  = tile_x_q;
  assign tile_y_o  = tile_y_q;
  assign x_first_o = tile_x_q == x_first_q ? x_first_pixel_q : '0;
  assign x_last_o  = tile_x_q == x_last_q ? x_last_pixel_q : '1;
  assign y_first_o = tile_y_q == y_first_q ? y_first_pixel_q : '0;
  assign y_last_o  = tile_y_q == y_last_q ? y_last_pixel_q : '1;

endmodule
