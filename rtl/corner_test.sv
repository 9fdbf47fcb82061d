// What the corner samples of a square say about one edge.
//
// An edge function is linear: over the samples of a square it is largest and smallest at corners, and the signs of a
// and b say at which. The sums to those corners are the same for every square of a size, so a test is two adders of
// which only the signs are used.

module corner_test
  import raster_pkg::*;
#(
  /// Bits of the sums to the corners.
  parameter int unsigned CornerBits = StepBits + 6,
  /// 1: squares outside the edge are found; 0: no square is rejected.
  parameter bit TrivialReject = 1'b1,
  /// 1: squares inside the edge are found; 0: no square is accepted.
  parameter bit TrivialAccept = 1'b1
) (
  // The edge value at the top left sample of the square, and from there to where it is largest and
  // least.
  input  logic signed [PixelEdgeBits-1:0] edge_i,
  input  logic signed [CornerBits-1:0]    to_largest_i,
  input  logic signed [CornerBits-1:0]    to_least_i,
  output logic                            reject_o, // all samples are outside
  output logic                            accept_o  // all samples are inside
);

  typedef logic signed [PixelEdgeBits-1:0] pixel_edge_t;

  logic all_outside, all_inside;
  assign all_outside = edge_i + pixel_edge_t'(to_largest_i) < $signed(PixelEdgeBits'(0));
  assign all_inside  = edge_i + pixel_edge_t'(to_least_i) >= $signed(PixelEdgeBits'(0));

  assign reject_o = TrivialReject & all_outside;
  assign accept_o = TrivialAccept & all_inside;

endmodule
