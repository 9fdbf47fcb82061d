// One edge on the walk over blocks: its value at the block, moved by shifted steps, and the tiles of the block that are
// outside it.
//
// E is the same modulo 2^SubPixelBits at all pixel centres, so those bits are kept once for the triangle, and what moves
// is floor(E / 2^SubPixelBits), which a pixel changes by a or b.
//
// An edge function is linear: over the samples of a tile it is largest at a corner, and the signs of a and b say at which.
// What lies between the block's top left sample and that corner of a tile is the same in every block: the sum of a number
// for the tile's row and one for its column. So a test is two adders, of which only the sign is used, and the first is
// that of the whole row.

module block_edge
  import raster_pkg::*;
#(
  /// 0: no tile is found to be outside.
  parameter bit TrivialReject = 1'b1
) (
  input  logic                  clk_i,

  // A triangle, at the first block of its walk.
  input  logic                  load_i,
  input  edge_t                 edge_i,
  input  step_t                 a_i,
  input  step_t                 b_i,

  input  logic                  advance_i, // to the next block, at the end of the cycle
  input  logic                  row_end_i, // the block is the last of its row

  output edge_t                 edge_o,    // at the block's top left sample
  output step_t                 a_o,
  output step_t                 b_o,
  output logic [BlockTiles-1:0] outside_o  // tiles all of whose samples are outside
);

  localparam int unsigned RowTiles = BlockSize / TileSize;
  localparam int unsigned RowBits = BlockLog2 - TileLog2;

  typedef logic signed [PixelEdgeBits-1:0] pixel_edge_t;

  step_t a_q, b_q;
  logic [SubPixelBits-1:0] sub_pixel_q;

  always_ff @(posedge clk_i) begin
    if (load_i) begin
      a_q         <= a_i;
      b_q         <= b_i;
      sub_pixel_q <= edge_i[SubPixelBits-1:0];
    end
  end

  // The value at the block, and at the first block of its row.
  pixel_edge_t here_q, row_q;
  pixel_edge_t loaded, along, down, next;

  assign loaded = edge_i[EdgeBits-1:SubPixelBits];
  assign along  = here_q + (pixel_edge_t'(a_q) <<< BlockLog2);
  assign down   = row_q + (pixel_edge_t'(b_q) <<< BlockLog2);
  assign next   = row_end_i ? down : along;

  always_ff @(posedge clk_i) begin
    if (load_i) begin
      here_q <= loaded;
      row_q  <= loaded;
    end else if (advance_i) begin
      here_q <= next;
      if (row_end_i) begin
        row_q <= next;
      end
    end
  end

  assign edge_o = {here_q, sub_pixel_q};
  assign a_o    = a_q;
  assign b_o    = b_q;

  if (TrivialReject) begin : gen_reject
    localparam int unsigned SumBits = StepBits + 1;
    localparam int unsigned AcrossBits = StepBits + RowBits;
    localparam int unsigned DownBits = StepBits + BlockLog2 + 1;

    typedef logic signed [SumBits-1:0] sum_t;
    typedef logic signed [AcrossBits-1:0] across_t;
    typedef logic signed [DownBits-1:0] down_t;

    // `count` steps, as a sum of shifted ones.
    function automatic across_t steps(step_t one, int unsigned count);
      steps = '0;
      for (int unsigned i = 0; i < RowBits; i++) begin
        if (((count >> i) & 1) == 1) begin
          steps = steps + (across_t'(one) <<< i);
        end
      end
    endfunction

    // To where E is largest in a tile: TileSize - 1 times the sum of the steps that go up.
    function automatic down_t to_largest(step_t a, step_t b);
      sum_t rising = (a[StepBits-1] ? '0 : sum_t'(a)) + (b[StepBits-1] ? '0 : sum_t'(b));
      return (down_t'(rising) <<< TileLog2) - down_t'(rising);
    endfunction

    // To a row of tiles, and there to where E is largest in its first tile; to a column, in steps of a tile.
    down_t   down_q   [RowTiles];
    across_t across_q [RowTiles];

    always_ff @(posedge clk_i) begin
      if (load_i) begin
        for (int unsigned i = 0; i < RowTiles; i++) begin
          down_q[i]   <= (down_t'(steps(b_i, i)) <<< TileLog2) + to_largest(a_i, b_i);
          across_q[i] <= steps(a_i, i);
        end
      end
    end

    for (genvar y = 0; y < RowTiles; y++) begin : gen_row
      pixel_edge_t first;
      assign first = here_q + pixel_edge_t'(down_q[y]);
      for (genvar x = 0; x < RowTiles; x++) begin : gen_tile
        assign outside_o[y*RowTiles+x] =
            first + (pixel_edge_t'(across_q[x]) <<< TileLog2) < $signed(PixelEdgeBits'(0));
      end
    end
  end else begin : gen_no_reject
    assign outside_o = '0;
  end

endmodule
