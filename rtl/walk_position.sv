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

  // Bounds, as they come and as they are kept.
  in_tile_t x_first, x_last, y_first, y_last;
  in_tile_t x_first_q, x_last_q, y_first_q, y_last_q;
  logic     one_tile;

  assign x_first  = x_first_i;
  assign x_last   = x_last_i;
  assign y_first  = y_first_i;
  assign y_last   = y_last_i;
  assign one_tile = x_first.tile == x_last.tile && y_first.tile == y_last.tile;

  // The walk has blocks, and is at one; which block, which tile.
  logic         with_blocks_q, at_block_q;
  logic         with_blocks, at_block;
  block_coord_t block_x_q, block_y_q;
  tile_coord_t  tile_x_q, tile_y_q;

  // Without blocks these are constants, for synthesis to see.
  assign with_blocks = BlockLevel & with_blocks_q;
  assign at_block    = BlockLevel & at_block_q;

  // The block's place among the blocks of the bounds.
  in_block_t from_x, from_y, to_x, to_y;
  logic      last_column, last_row;

  assign from_x         = x_first_q.tile;
  assign from_y         = y_first_q.tile;
  assign to_x           = x_last_q.tile;
  assign to_y           = y_last_q.tile;
  assign first_column_o = block_x_q == from_x.block;
  assign first_row_o    = block_y_q == from_y.block;
  assign last_column    = block_x_q == to_x.block;
  assign last_row       = block_y_q == to_y.block;
  assign last_block_o   = ~with_blocks | (last_column & last_row);

  // Its tiles that are in the bounds.
  in_block_t column_first, column_last, row_first, row_last;

  assign column_first = '{
    block: with_blocks ? block_x_q : from_x.block,
    tile:  with_blocks && !first_column_o ? '0 : from_x.tile
  };
  assign row_first = '{
    block: with_blocks ? block_y_q : from_y.block,
    tile:  with_blocks && !first_row_o ? '0 : from_y.tile
  };
  assign column_last = '{
    block: with_blocks ? block_x_q : to_x.block,
    tile:  with_blocks && !last_column ? '1 : to_x.tile
  };
  assign row_last = '{
    block: with_blocks ? block_y_q : to_y.block,
    tile:  with_blocks && !last_row ? '1 : to_y.tile
  };

  logic tile_row_end;
  assign tile_row_end = tile_x_q == column_last;
  assign last_tile_o  = tile_row_end && tile_y_q == row_last;

  assign at_block_o = at_block;
  assign row_end_o  = at_block ? last_column : tile_row_end;
  assign leave_o    = with_blocks & last_tile_o;

  logic next_block;  // the square after this one is another block
  assign next_block = at_block ? ~enter_i : leave_o;

  always_ff @(posedge clk_i) begin
    if (load_i) begin
      x_first_q     <= x_first;
      x_last_q      <= x_last;
      y_first_q     <= y_first;
      y_last_q      <= y_last;
      with_blocks_q <= ~one_tile;
      at_block_q    <= ~one_tile;
      block_x_q     <= x_first_i[PixelBits-1:BlockLog2];
      block_y_q     <= y_first_i[PixelBits-1:BlockLog2];
      tile_x_q      <= x_first.tile;
      tile_y_q      <= y_first.tile;
    end else if (advance_i && next_block) begin
      at_block_q <= 1'b1;
      block_x_q  <= last_column ? from_x.block : block_x_q + block_coord_t'(1);
      if (last_column) begin
        block_y_q <= block_y_q + block_coord_t'(1);
      end
    end else if (advance_i && at_block) begin
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
  assign x_first_o = tile_x_q == x_first_q.tile ? x_first_q.pixel : '0;
  assign x_last_o  = tile_x_q == x_last_q.tile ? x_last_q.pixel : '1;
  assign y_first_o = tile_y_q == y_first_q.tile ? y_first_q.pixel : '0;
  assign y_last_o  = tile_y_q == y_last_q.tile ? y_last_q.pixel : '1;

endmodule
