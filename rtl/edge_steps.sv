// The adders that all pixels of a tile share, for one edge: its value at the start of each row, and what a column
// adds to it. Both are trees of TileSize - 1 adders at most, TileLog2 deep; multiples are shifts.

module edge_steps
  import raster_pkg::LocalEdgeBits;
  import raster_pkg::StepBits;
  import raster_pkg::TileLog2;
  import raster_pkg::TileSize;
(
  input  logic signed [LocalEdgeBits-2:0] origin_i,           // saturated value at the tile origin
  input  logic signed [StepBits-1:0]      a_i,
  input  logic signed [StepBits-1:0]      b_i,
  output logic signed [LocalEdgeBits-1:0] row_o [TileSize],   // origin + y * b
  output logic signed [LocalEdgeBits-1:0] column_o [TileSize] // x * a
);

  typedef logic signed [LocalEdgeBits-1:0] local_t;

  local_t a, b;
  assign a = local_t'(a_i);
  assign b = local_t'(b_i);

  always_comb begin
    row_o[0]    = local_t'(origin_i);
    column_o[0] = '0;
    for (int unsigned level = 0; level < TileLog2; level++) begin
      for (int unsigned i = 0; i < (1 << level); i++) begin
        row_o[(1<<level)+i]    = row_o[i] + (b <<< level);
        column_o[(1<<level)+i] = column_o[i] + (a <<< level);
      end
    end
  end

endmodule
