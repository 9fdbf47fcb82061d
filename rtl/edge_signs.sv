// Which pixels of a tile are inside one edge: one adder a pixel, of which only the sign is used.

module edge_signs
  import raster_pkg::LocalEdgeBits;
  import raster_pkg::MaskBits;
  import raster_pkg::TileSize;
(
  input  logic signed [LocalEdgeBits-1:0] row_i [TileSize],
  input  logic signed [LocalEdgeBits-1:0] column_i [TileSize],
  output logic [MaskBits-1:0]             inside_o
);

  always_comb begin
    inside_o = '0;
    for (int unsigned y = 0; y < TileSize; y++) begin
      for (int unsigned x = 0; x < TileSize; x++) begin
        inside_o[y*TileSize+x] = row_i[y] + column_i[x] >= $signed(LocalEdgeBits'(0));
      end
    end
  end

endmodule
