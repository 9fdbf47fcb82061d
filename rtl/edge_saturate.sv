// The value of one edge at the tile origin: in pixel steps, and saturated so that narrow adders serve for the tile.
//
// Only signs matter inside a tile, and the steps across it add up to less than TileSize << StepBits. A value beyond
// that keeps its sign whatever is added, so it may be cut off there (docs/units/edge_evaluator.md).

module edge_saturate
  import raster_pkg::EdgeBits;
  import raster_pkg::LocalEdgeBits;
  import raster_pkg::PixelEdgeBits;
  import raster_pkg::SubPixelBits;
(
  input  logic signed [EdgeBits-1:0]      edge_i,
  output logic signed [LocalEdgeBits-2:0] origin_o
);

  // The limits are those of this many signed bits; LocalEdgeBits has one more for the sum.
  localparam int unsigned SaturatedBits = LocalEdgeBits - 1;
  // A value fits when these top bits are all its sign.
  localparam int unsigned SignBits = PixelEdgeBits - SaturatedBits + 1;

  logic [PixelEdgeBits-1:0] pixel_edge;
  logic                     sign, fits;

  assign pixel_edge = edge_i[EdgeBits-1:SubPixelBits];
  assign sign       = pixel_edge[PixelEdgeBits-1];
  assign fits       = pixel_edge[PixelEdgeBits-1:SaturatedBits-1] == {SignBits{sign}};
  assign origin_o    = fits ? pixel_edge[SaturatedBits-1:0] : {sign, {(SaturatedBits-1){~sign}}};

  // At pixel centres the sub-pixel bits are the same all along an edge and never decide coverage.
  logic unused_sub_pixel;
  assign unused_sub_pixel = ^edge_i[SubPixelBits-1:0];

endmodule
