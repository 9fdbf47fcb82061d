// Depth at the samples of a beat by barycentric weights: barycentric_sample for each, and what they share, each part of
// it computed in the cycle before the stage that needs it. Latency is 12 cycles; a beat a cycle; nothing stalls.
//
// Where triangles are drawn by squares, E is that at the corner of a square, and weights are those of its centre. Of three
// edges by centres at least one does not own its samples, so a triangle is drawn by squares where no bias is 1.

module depth_barycentric
  import raster_pkg::*;
  import depth_pkg::*;
  import square_pkg::*;
#(
  /// Quads of a beat, 1 or more. Each costs four samples, with 6 multipliers each.
  parameter int unsigned Quads = TestWidth,
  /// Pixels of triangles that are drawn by squares: 0 none are, 1 outer, 2 inner.
  parameter int unsigned Conservative = Centres,
  /// How much larger than the pixel its square is on each side, in sub-pixels.
  parameter int unsigned Uncertainty = 0
) (
  input  logic                                  clk_i,

  /// Without it the codes mean nothing, and next to nothing toggles.
  input  logic                                  valid_i,
  input  logic [FormatBits-1:0]                 format_i,
  input  depth_equation_t                       equation_i,
  input  edge_t [1:0]                           e_i,
  input  logic [Quads-1:0] [QuadIndexBits-1:0]  index_i,
  /// Codes of other samples mean nothing.
  input  logic [Quads-1:0] [QuadMaskBits-1:0]   mask_i,

  /// Four samples a quad, in the order of its mask. 0 where the format is none.
  output logic [4*Quads-1:0] [CodeBits-1:0]     code_o
);

  localparam int unsigned Stages = 13;
  localparam int unsigned WeightBits = 30; // as in barycentric_sample
  localparam logic [FormatBits-1:0] Unorm16 = 1;
  localparam logic [FormatBits-1:0] Float32 = 4;

  // Element i belongs to the beat in stage i + 1: what was registered i times.
  logic [Stages-1:0] valid, has_depth, is_float, is_unorm16;
  logic [Stages-2:0] valid_q, has_depth_q, is_float_q, is_unorm16_q;

  assign valid      = {valid_q, valid_i};
  assign has_depth  = {has_depth_q, format_i != '0};
  assign is_float   = {is_float_q, format_i == Float32};
  assign is_unorm16 = {is_unorm16_q, format_i == Unorm16};

  always_ff @(posedge clk_i) begin
    valid_q      <= valid[Stages-2:0];
    has_depth_q  <= has_depth[Stages-2:0];
    is_float_q   <= is_float[Stages-2:0];
    is_unorm16_q <= is_unorm16[Stages-2:0];
  end

  // 1: unbiased E at the first samples of the quads, and the steps to the others.
  edge_t [1:0] origin, a, b;
  for (genvar i = 0; i < 2; i++) begin : gen_edge
    assign origin[i] = e_i[i] + edge_t'($signed({1'b0, equation_i.bias[i+1]}));
    assign a[i]      = of_pixel(equation_i.a[i]);
    assign b[i]      = of_pixel(equation_i.b[i]);
  end

  // What is only handed on.
  logic [7:0] [ReciprocalBits-1:0]       reciprocal;
  logic [6:0] [ReciprocalBits-1:0]       reciprocal_q;
  logic [6:0] [ShiftBits-1:0]            shift;
  logic [5:0] [ShiftBits-1:0]            shift_q;
  logic [Stages-1:0] [CodeBits-1:0]      min_code, max_code;
  logic [Stages-2:0] [CodeBits-1:0]      min_code_q, max_code_q;
  word_t [9:0]                           offset;
  word_t [8:0]                           offset_q;
  exponent_t [8:0]                       exponent;
  exponent_t [7:0]                       exponent_q;
  logic [6:0] [4:0]                      cut;
  logic [5:0] [4:0]                      cut_q;
  logic [4:1] [2:0] [CodeBits-1:0]       z_q;

  // Depths beyond [0, 1] lose bits, so that the difference of two has 32 all the same.
  function automatic logic [CodeBits-1:0] kept(vertex_depth_t z, logic [4:0] lost);
    return CodeBits'(z >>> lost);
  endfunction

  assign reciprocal = {reciprocal_q, equation_i.reciprocal};
  assign shift      = {shift_q, equation_i.shift};
  assign min_code   = {min_code_q, equation_i.min_code};
  assign max_code   = {max_code_q, equation_i.max_code};
  assign offset     = {offset_q, equation_i.offset};
  assign exponent   = {exponent_q, equation_i.exponent};
  assign cut        = {cut_q, equation_i.beyond ? 5'(equation_i.exponent) + 5'd1 : 5'd0};

  always_ff @(posedge clk_i) begin
    for (int unsigned i = 0; i < Stages - 1; i++) begin
      if (valid[i]) begin
        min_code_q[i] <= min_code[i];
        max_code_q[i] <= max_code[i];
      end
    end
    for (int unsigned i = 0; i < 7; i++) begin
      if (valid[i]) begin
        reciprocal_q[i] <= reciprocal[i];
      end
    end
    for (int unsigned i = 0; i < 6; i++) begin
      if (valid[i]) begin
        shift_q[i] <= shift[i];
      end
    end
    for (int unsigned i = 0; i < 6; i++) begin
      if (valid[i]) begin
        cut_q[i] <= cut[i];
      end
    end
    for (int unsigned i = 0; i < 9; i++) begin
      if (valid[i]) begin
        offset_q[i] <= offset[i];
      end
    end
    for (int unsigned i = 0; i < 8; i++) begin
      if (valid[i]) begin
        exponent_q[i] <= exponent[i];
      end
    end
    for (int unsigned i = 0; i < 3; i++) begin
      if (valid[0]) begin
        z_q[1][i] <= kept(equation_i.z[i], cut[0]);
      end
    end
    for (int unsigned i = 1; i < 4; i++) begin
      if (valid[i]) begin
        z_q[i+1] <= z_q[i];
      end
    end
  end

  // For stages 2 to 6: 2A; exponents; reciprocal or mantissas; differences and signs; z0, offset and half a code.
  edge_t              area2_q;
  edge_t [1:0]        square_d, square_q; // E at the corner of a square less E at its centre
  edge_t              squares_q;
  logic [2:0] [7:0]   z_exponent_q;
  logic [2:0] [31:0]  factor_q;
  logic signed [31:0] difference1_q, difference2_q;
  logic [2:0]         negative_q;
  logic signed [63:0] base_q;

  for (genvar i = 0; i < 2; i++) begin : gen_square
    assign square_d[i] = equation_i.bias == '0
                         ? to_square(span_of(equation_i.a[i], equation_i.b[i]), Conservative,
                                     Uncertainty)
                         : '0;
  end

  always_ff @(posedge clk_i) begin
    if (valid[0]) begin
      area2_q   <= equation_i.area2;
      square_q  <= square_d;
      squares_q <= square_d[0] + square_d[1];
    end
    for (int unsigned i = 0; i < 3; i++) begin
      if (valid[1] && is_float[1]) begin
        z_exponent_q[i] <= exponent_of(z_q[1][i][30:23]);
      end
      if (valid[2]) begin
        factor_q[i] <= is_float[2] ? {8'b0, |z_q[2][i][30:23], z_q[2][i][22:0]} : reciprocal[2];
      end
    end
    if (valid[3]) begin
      difference1_q <= $signed(z_q[3][1]) - $signed(z_q[3][0]);
      difference2_q <= $signed(z_q[3][2]) - $signed(z_q[3][0]);
      negative_q    <= {z_q[3][2][31], z_q[3][1][31], z_q[3][0][31]};
    end
    if (valid[4]) begin
      base_q <= (64'($signed(z_q[4][0])) <<< WeightBits)
                + ((offset[4] + (is_unorm16[4] ? 64'sd16384 : 64'sd64))
                   <<< (6'(WeightBits) - 6'(cut[4])));
    end
  end

  logic [4*Quads-1:0] [CodeBits-1:0] code;

  for (genvar q = 0; q < Quads; q++) begin : gen_quad
    // One clock enable for the four samples of a quad.
    logic        quad_valid;
    edge_t [1:0] corner;
    assign quad_valid = valid[0] & has_depth[0] & |mask_i[q];
    for (genvar i = 0; i < 2; i++) begin : gen_corner
      assign corner[i] = at_quad(origin[i], a[i], b[i], index_i[q]);
    end
    for (genvar s = 0; s < 4; s++) begin : gen_sample
      barycentric_sample #(
        .Conservative (Conservative)
      ) u_sample (
        .clk_i         (clk_i),
        .float_i       (is_float),
        .valid_i       (quad_valid),
        .corner1_i     (corner[0]),
        .corner2_i     (corner[1]),
        .step1_i       ((s % 2 == 1 ? a[0] : '0) + (s / 2 == 1 ? b[0] : '0)),
        .step2_i       ((s % 2 == 1 ? a[1] : '0) + (s / 2 == 1 ? b[1] : '0)),
        .area2_i       (area2_q),
        .square1_i     (square_q[0]),
        .square2_i     (square_q[1]),
        .squares_i     (squares_q),
        .shift3_i      (shift[2]),
        .exponent_i    (z_exponent_q),
        .factor_i      (factor_q),
        .difference1_i (difference1_q),
        .difference2_i (difference2_q),
        .negative_i    (negative_q),
        .base_i        (base_q),
        .unorm16_i     (is_unorm16[6]),
        .cut_i         (cut[6]),
        .min_code7_i   (min_code[6]),
        .max_code7_i   (max_code[6]),
        .shift7_i      (shift[6]),
        .reciprocal_i  (reciprocal[7]),
        .exponent9_i   (exponent[8]),
        .offset_i      (offset[9]),
        .min_code13_i  (min_code[12]),
        .max_code13_i  (max_code[12]),
        .code_o        (code[4*q+s])
      );
    end
  end

  assign code_o = has_depth[Stages-1] ? code : '0;

  logic unused_valid;
  assign unused_valid = ^{valid[12], is_unorm16[12:7], equation_i.dx, equation_i.dy,
                          equation_i.word, equation_i.x, equation_i.y};

endmodule
