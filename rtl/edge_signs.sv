// Which pixels of a tile are inside one edge: one adder a pixel, of which only the sign is used.

module edge_signs
  import raster_pkg::LocalEdgeBits;
  import raster_pkg::MaskBits;
  import raster_pkg::TileSize;
(
  input  logic                            valid_i, // without it all pixels are outside
  input  logic signed [LocalEdgeBits-1:0] row_i [TileSize],
  input  logic signed [LocalEdgeBits-1:0] column_i [TileSize],
  output logic [MaskBits-1:0]             inside_o
);

  // A row at a time: less for a simulator than bit by bit.
  typedef logic signed [LocalEdgeBits-1:0] local_t;

  always_comb begin
    automatic local_t value = '0;
    automatic logic [TileSize-1:0] row = '0;
    inside_o = '0;
    if (valid_i) begin
      for (int unsigned y = 0; y < TileSize; y++) begin
        for (int unsigned x = 0; x < TileSize; x++) begin
          value  = row_i[y] + column_i[x];
          row[x] = ~value[LocalEdgeBits-1];
        end
        inside_o[y*TileSize+:TileSize] = row;
      end
    end
  end

endmodule
