// Depth at the samples of a beat, by the interpolator that the machine has, and where it is asked for which of its pixels the
// triangle fills. A beat a cycle; nothing stalls.

module depth_interpolator
  import raster_pkg::*;
  import depth_pkg::*;
  import square_pkg::*;
#(
  /// Quads of a beat, 1 or more.
  parameter int unsigned Quads = TestWidth,
  /// 0 plane, 1 barycentric.
  parameter int unsigned Interpolator = Plane,
  /// Cycles to the codes, 12 or more. Those above are registers at the end.
  parameter int unsigned Latency = 12,
  /// Pixels of triangles that are drawn by squares: 0 none are, 1 outer, 2 inner. Outer ones need barycentric weights.
  parameter int unsigned Conservative = Centres,
  /// How much larger than the pixel its square is on each side, in sub-pixels.
  parameter int unsigned Uncertainty = 0,
  /// 1: says which pixels of outer triangles these fill; needs barycentric weights. 0: inner_o is 0.
  parameter bit InnerCoverage = 1'b0
) (
  input  logic                                  clk_i,

  /// Without it the codes mean nothing, and next to nothing toggles.
  input  logic                                  valid_i,
  input  logic [FormatBits-1:0]                 format_i,
  input  depth_equation_t                       equation_i,
  input  logic [TileColumnBits-1:0]             tile_x_i,
  input  logic [TileCoordBits-1:0]              tile_y_i,
  input  edge_t [1:0]                           e_i,
  input  logic [Quads-1:0] [QuadIndexBits-1:0]  index_i,
  /// Codes of other samples mean nothing.
  input  logic [Quads-1:0] [QuadMaskBits-1:0]   mask_i,

  /// Four samples a quad, in the order of its mask. 0 where the format is none.
  output logic [4*Quads-1:0] [CodeBits-1:0]     code_o,
  output logic [Quads-1:0] [QuadMaskBits-1:0]   inner_o
);

  localparam int unsigned Least = 12;
  localparam int unsigned Extra = Latency - Least;

  logic [4*Quads-1:0] [CodeBits-1:0] code;

  if (Interpolator == Plane) begin : gen_plane
    depth_plane #(
      .Quads (Quads)
    ) u_plane (
      .clk_i      (clk_i),
      .valid_i    (valid_i),
      .format_i   (format_i),
      .equation_i (equation_i),
      .tile_x_i   (tile_x_i),
      .tile_y_i   (tile_y_i),
      .index_i    (index_i),
      .mask_i     (mask_i),
      .code_o     (code)
    );

    logic unused_edges;
    assign unused_edges = ^e_i;
  end else begin : gen_barycentric
    depth_barycentric #(
      .Quads        (Quads),
      .Conservative (Conservative),
      .Uncertainty  (Uncertainty)
    ) u_barycentric (
      .clk_i      (clk_i),
      .valid_i    (valid_i),
      .format_i   (format_i),
      .equation_i (equation_i),
      .e_i        (e_i),
      .index_i    (index_i),
      .mask_i     (mask_i),
      .code_o     (code)
    );

    logic unused_tile;
    assign unused_tile = ^{tile_x_i, tile_y_i};
  end

  if (InnerCoverage) begin : gen_inner
    inner_coverage #(
      .Quads       (Quads),
      .Latency     (Latency),
      .Uncertainty (Uncertainty)
    ) u_inner (
      .clk_i      (clk_i),
      .valid_i    (valid_i),
      .equation_i (equation_i),
      .e_i        (e_i),
      .index_i    (index_i),
      .mask_i     (mask_i),
      .inner_o    (inner_o)
    );
  end else begin : gen_no_inner
    assign inner_o = '0;
  end

  if (Extra == 0) begin : gen_at_once
    assign code_o = code;
  end else begin : gen_late
    logic [Extra-1:0] [4*Quads-1:0] [CodeBits-1:0] late_q;

    always_ff @(posedge clk_i) begin
      late_q[0] <= code;
      for (int unsigned i = 1; i < Extra; i++) begin
        late_q[i] <= late_q[i-1];
      end
    end

    assign code_o = late_q[Extra-1];
  end

endmodule
