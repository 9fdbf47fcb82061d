// block_position: the walk visits every block of the bounds, in row order, and says which of its pixels and tiles they touch.

module block_position_properties
  import raster_pkg::*;
(
  input logic                 clk_i,
  input logic                 rst_ni,
  input logic                 load_i,
  input logic [PixelBits-1:0] x_first_i,
  input logic [PixelBits-1:0] x_last_i,
  input logic [PixelBits-1:0] y_first_i,
  input logic [PixelBits-1:0] y_last_i,
  input logic                 advance_i
);

  localparam int unsigned RowTiles = BlockSize / TileSize;

  logic                      row_end, last;
  logic [BlockCoordBits-1:0] block_x, block_y;
  logic [BlockLog2-1:0]      x_first, x_last, y_first, y_last;
  logic [BlockTiles-1:0]     touched;

  block_position u_dut (
    .clk_i     (clk_i),
    .load_i    (load_i),
    .x_first_i (x_first_i),
    .x_last_i  (x_last_i),
    .y_first_i (y_first_i),
    .y_last_i  (y_last_i),
    .advance_i (advance_i),
    .row_end_o (row_end),
    .last_o    (last),
    .block_x_o (block_x),
    .block_y_o (block_y),
    .x_first_o (x_first),
    .x_last_o  (x_last),
    .y_first_o (y_first),
    .y_last_o  (y_last),
    .touched_o (touched)
  );

  // The bounds, and the block that the walk is at, in numbers with room.
  int signed left_q, right_q, top_q, bottom_q, x_q, y_q;
  logic      loaded_q;

  int signed block_left, block_right;
  assign block_left  = left_q / BlockSize;
  assign block_right = right_q / BlockSize;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      loaded_q <= 1'b0;
    end else if (load_i) begin
      loaded_q <= 1'b1;
      left_q   <= 32'(x_first_i);
      right_q  <= 32'(x_last_i);
      top_q    <= 32'(y_first_i);
      bottom_q <= 32'(y_last_i);
      x_q      <= 32'(x_first_i) / BlockSize;
      y_q      <= 32'(y_first_i) / BlockSize;
    end else if (advance_i) begin
      x_q <= x_q == block_right ? block_left : x_q + 1;
      y_q <= x_q == block_right ? y_q + 1 : y_q;
    end
  end

  // What lies in the block: from its first to its last pixel, and in the bounds.
  function automatic int signed most(int signed one, int signed other);
    return one > other ? one : other;
  endfunction
  function automatic int signed least(int signed one, int signed other);
    return one < other ? one : other;
  endfunction

  int signed x0, y0; // the block's first pixel
  assign x0 = x_q * BlockSize;
  assign y0 = y_q * BlockSize;

  for (genvar y = 0; y < RowTiles; y++) begin : gen_row
    for (genvar x = 0; x < RowTiles; x++) begin : gen_tile
      always_comb begin
        Touched: assert (!loaded_q || touched[y*RowTiles+x] ==
            (x0 + x * TileSize <= right_q && x0 + (x + 1) * TileSize > left_q
             && y0 + y * TileSize <= bottom_q && y0 + (y + 1) * TileSize > top_q));
      end
    end
  end

  always_comb begin
    // setup_cull: no triangle is drawn without a pixel; block_walker: it advances to the last block only.
    BoundsX: assume (!load_i || x_first_i <= x_last_i);
    BoundsY: assume (!load_i || y_first_i <= y_last_i);
    WalkEnds: assume (!advance_i || load_i || !last);

    if (loaded_q) begin
      BoundsKept: assert ({u_dut.x_first_q, u_dut.x_last_q, u_dut.y_first_q, u_dut.y_last_q}
                          == {left_q[PixelBits-1:0], right_q[PixelBits-1:0], top_q[PixelBits-1:0],
                              bottom_q[PixelBits-1:0]});
      InScreen: assert (left_q >= 0 && left_q <= right_q && right_q < 1 << PixelBits
                        && top_q >= 0 && top_q <= bottom_q && bottom_q < 1 << PixelBits);
      InBounds: assert (x_q >= block_left && x_q <= block_right && y_q >= top_q / BlockSize
                        && y_q <= bottom_q / BlockSize);
      Block: assert (32'(block_x) == x_q && 32'(block_y) == y_q);
      LastIsLast: assert (last == (x_q == block_right && y_q == bottom_q / BlockSize));
      RowEnd: assert (row_end == (x_q == block_right));
      Pixels: assert (32'(x_first) == most(left_q, x0) - x0
                      && 32'(x_last) == least(right_q, x0 + BlockSize - 1) - x0
                      && 32'(y_first) == most(top_q, y0) - y0
                      && 32'(y_last) == least(bottom_q, y0 + BlockSize - 1) - y0);
    end

    SecondRow: cover (loaded_q && y_q != top_q / BlockSize && last);
    Inner: cover (loaded_q && touched == '1);
  end

endmodule
