// One edge on the walk over blocks and tiles: its value at the square that is decided, moved by adders of shifted
// steps, and the test of that square.
//
// E is the same modulo 2^SubPixelBits at all pixel centres, so those bits are kept once for the triangle, and what
// moves is floor(E / 2^SubPixelBits), which a pixel changes by a or b.

module walk_edge
  import raster_pkg::*;
#(
  /// Pixels on a side of a block, as a power of two; more than TileLog2.
  parameter int unsigned BlockLog2 = 5,
  /// See corner_test.
  parameter bit TrivialReject = 1'b1,
  parameter bit TrivialAccept = 1'b1,
  /// Bits of a tile's column or row in its block. Follows from BlockLog2.
  localparam int unsigned SkipBits = BlockLog2 - TileLog2
) (
  input  logic                clk_i,

  // A triangle, at the first square of its walk.
  input  logic                load_i,
  input  edge_t               edge_i,
  input  step_t               a_i,
  input  step_t               b_i,
  input  logic [SkipBits-1:0] skip_columns_i, // tiles of the first block left of the bounds
  input  logic [SkipBits-1:0] skip_rows_i,    // and above them

  // Where the walk is, and where it goes. advance_i: at the end of the cycle.
  input  logic                advance_i,
  input  logic                at_block_i,     // the square is a block
  input  logic                enter_i,        // of a block: its tiles are next
  input  logic                row_end_i,      // the square is the last of its row
  input  logic                leave_i,        // of a tile: it is the last of its block
  input  logic                first_column_i, // the block is in the first column of blocks
  input  logic                first_row_i,

  output edge_t               edge_o,
  output step_t               a_o,
  output step_t               b_o,
  output logic                reject_o,
  output logic                accept_o
);

  localparam int unsigned SumBits = StepBits + 1;
  localparam int unsigned CornerBits = SumBits + BlockLog2;
  localparam int unsigned SkippedBits = StepBits + SkipBits;

  typedef logic signed [PixelEdgeBits-1:0] pixel_edge_t;
  typedef logic signed [SumBits-1:0] sum_t;
  typedef logic signed [CornerBits-1:0] corner_t;
  typedef logic signed [SkippedBits-1:0] skipped_t;

  step_t a_q, b_q;
  logic [SubPixelBits-1:0] sub_pixel_q;

  // From the top left sample of a square to the samples where E is largest and least: (size - 1) times the sum of
  // the steps that go up, or down.
  sum_t    rising, falling;
  corner_t largest_in_block_q, largest_in_tile_q, least_in_block_q, least_in_tile_q;

  logic a_falls, b_falls;
  assign a_falls = a_i[StepBits-1];
  assign b_falls = b_i[StepBits-1];
  assign rising  = (a_falls ? sum_t'(0) : sum_t'(a_i)) + (b_falls ? sum_t'(0) : sum_t'(b_i));
  assign falling = (a_falls ? sum_t'(a_i) : sum_t'(0)) + (b_falls ? sum_t'(b_i) : sum_t'(0));

  // What lies between the first block's top left sample and its first tile in the bounds, in steps of a tile.
  skipped_t skip_x_d, skip_y_d, skip_x_q, skip_y_q;

  always_comb begin
    skip_x_d = '0;
    skip_y_d = '0;
    for (int unsigned i = 0; i < SkipBits; i++) begin
      if (skip_columns_i[i]) begin
        skip_x_d = skip_x_d + (skipped_t'(a_i) <<< i);
      end
      if (skip_rows_i[i]) begin
        skip_y_d = skip_y_d + (skipped_t'(b_i) <<< i);
      end
    end
  end

  always_ff @(posedge clk_i) begin
    if (load_i) begin
      a_q                <= a_i;
      b_q                <= b_i;
      sub_pixel_q        <= edge_i[SubPixelBits-1:0];
      largest_in_block_q <= (corner_t'(rising) <<< BlockLog2) - corner_t'(rising);
      largest_in_tile_q  <= (corner_t'(rising) <<< TileLog2) - corner_t'(rising);
      least_in_block_q   <= (corner_t'(falling) <<< BlockLog2) - corner_t'(falling);
      least_in_tile_q    <= (corner_t'(falling) <<< TileLog2) - corner_t'(falling);
      skip_x_q           <= skip_x_d;
      skip_y_q           <= skip_y_d;
    end
  end

  // The value at the square that is decided, at the first tile of its row, at the first block of the row of blocks,
  // and at the block that comes after the tiles of this one.
  pixel_edge_t here_q, tile_row_q, block_row_q, resume_q;
  pixel_edge_t loaded, along, down, next, entry, skip_x, skip_y;

  assign loaded = edge_i[EdgeBits-1:SubPixelBits];
  assign along  = here_q + (at_block_i ? pixel_edge_t'(a_q) <<< BlockLog2
                                       : pixel_edge_t'(a_q) <<< TileLog2);
  assign down   = at_block_i ? block_row_q + (pixel_edge_t'(b_q) <<< BlockLog2)
                             : tile_row_q + (pixel_edge_t'(b_q) <<< TileLog2);
  assign next   = row_end_i ? down : along;
  assign skip_x = first_column_i ? pixel_edge_t'(skip_x_q) <<< TileLog2 : '0;
  assign skip_y = first_row_i ? pixel_edge_t'(skip_y_q) <<< TileLog2 : '0;
  assign entry  = here_q + skip_x + skip_y;

  always_ff @(posedge clk_i) begin
    if (load_i) begin
      here_q      <= loaded;
      tile_row_q  <= loaded;
      block_row_q <= loaded;
    end else if (advance_i && at_block_i) begin
      here_q   <= enter_i ? entry : next;
      resume_q <= next;
      if (enter_i) begin
        tile_row_q <= entry;
      end
      if (row_end_i) begin
        block_row_q <= next;
      end
    end else if (advance_i) begin
      here_q <= leave_i ? resume_q : next;
      if (row_end_i) begin
        tile_row_q <= next;
      end
    end
  end

  corner_test #(
    .CornerBits    (CornerBits),
    .TrivialReject (TrivialReject),
    .TrivialAccept (TrivialAccept)
  ) u_corner_test (
    .edge_i       (here_q),
    .to_largest_i (at_block_i ? largest_in_block_q : largest_in_tile_q),
    .to_least_i   (at_block_i ? least_in_block_q : least_in_tile_q),
    .reject_o     (reject_o),
    .accept_o     (accept_o)
  );

  assign edge_o = {here_q, sub_pixel_q};
  assign a_o    = a_q;
  assign b_o    = b_q;

endmodule
