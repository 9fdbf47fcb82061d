// Where the walk of a triangle is: blocks in row order over the bounds; and what of the block is in the bounds, in pixels
// and in tiles.

module block_position
  import raster_pkg::*;
(
  input  logic                      clk_i,
  input  logic                      load_i,
  input  logic [PixelBits-1:0]      x_first_i,
  input  logic [PixelBits-1:0]      x_last_i,
  input  logic [PixelBits-1:0]      y_first_i,
  input  logic [PixelBits-1:0]      y_last_i,

  input  logic                      advance_i, // to the next block, at the end of the cycle

  output logic                      row_end_o, // the block is the last of its row
  output logic                      last_o,    // the block is the last of the bounds

  // The block, its pixels in the bounds, and the tiles that these touch.
  output logic [BlockCoordBits-1:0] block_x_o,
  output logic [BlockCoordBits-1:0] block_y_o,
  output logic [BlockLog2-1:0]      x_first_o,
  output logic [BlockLog2-1:0]      x_last_o,
  output logic [BlockLog2-1:0]      y_first_o,
  output logic [BlockLog2-1:0]      y_last_o,
  output logic [BlockTiles-1:0]     touched_o
);

  typedef logic [BlockCoordBits-1:0] block_coord_t;

  // A pixel coordinate, taken apart.
  typedef struct packed {
    block_coord_t         block;
    logic [BlockLog2-1:0] pixel; // in the block
  } in_block_t;

  in_block_t    x_first_q, x_last_q, y_first_q, y_last_q;
  block_coord_t block_x_q, block_y_q;
  logic         last_row;

  assign row_end_o = block_x_q == x_last_q.block;
  assign last_row  = block_y_q == y_last_q.block;
  assign last_o    = row_end_o & last_row;

  always_ff @(posedge clk_i) begin
    if (load_i) begin
      x_first_q <= x_first_i;
      x_last_q  <= x_last_i;
      y_first_q <= y_first_i;
      y_last_q  <= y_last_i;
      block_x_q <= x_first_i[PixelBits-1:BlockLog2];
      block_y_q <= y_first_i[PixelBits-1:BlockLog2];
    end else if (advance_i) begin
      block_x_q <= row_end_o ? x_first_q.block : block_x_q + block_coord_t'(1);
      if (row_end_o) begin
        block_y_q <= block_y_q + block_coord_t'(1);
      end
    end
  end

  assign block_x_o = block_x_q;
  assign block_y_o = block_y_q;

  block_inside u_inside (
    .x_first_i  (x_first_q),
    .x_last_i   (x_last_q),
    .y_first_i  (y_first_q),
    .y_last_i   (y_last_q),
    .square_x_i (block_x_q),
    .square_y_i (block_y_q),
    .x_first_o  (x_first_o),
    .x_last_o   (x_last_o),
    .y_first_o  (y_first_o),
    .y_last_o   (y_last_o),
    .touched_o  (touched_o)
  );

endmodule
