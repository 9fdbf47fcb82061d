// Depth at the samples of a beat: depth_sample for each, and what they share, each part of it computed in the cycle
// before the stage that needs it. Latency is 7 cycles; a beat a cycle; nothing stalls.

module depth_interpolator
  import raster_pkg::*;
#(
  /// Quads of a beat, 1 or more. Each costs four samples, with 6 multipliers each.
  parameter int unsigned Quads = TestWidth
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

  localparam int unsigned Stages = 8;
  localparam int unsigned QuadLog2 = TileLog2 - 1;
  localparam int unsigned WeightBits = 30; // as in depth_sample
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
  function automatic edge_t of_pixel(step_t step);
    return edge_t'(step) <<< SubPixelBits;
  endfunction

  edge_t [1:0] origin, a, b;
  for (genvar i = 0; i < 2; i++) begin : gen_edge
    assign origin[i] = e_i[i] + edge_t'($signed({1'b0, equation_i.bias[i+1]}));
    assign a[i]      = of_pixel(equation_i.a[i]);
    assign b[i]      = of_pixel(equation_i.b[i]);
  end

  // Multiples too small for multipliers: a shifted step for each bit of the quad's place.
  function automatic edge_t at_quad(edge_t from, edge_t x_step, edge_t y_step,
                                    logic [QuadIndexBits-1:0] index);
    edge_t sum;
    sum = from;
    for (int unsigned i = 0; i < QuadLog2; i++) begin
      if (index[i]) begin
        sum += x_step <<< (i + 1);
      end
      if (index[QuadLog2+i]) begin
        sum += y_step <<< (i + 1);
      end
    end
    return sum;
  endfunction

  // What is only handed on.
  logic [6:0] [ReciprocalBits-1:0]       reciprocal;
  logic [5:0] [ReciprocalBits-1:0]       reciprocal_q;
  logic [5:0] [ShiftBits-1:0]            shift;
  logic [4:0] [ShiftBits-1:0]            shift_q;
  logic [Stages-1:0] [CodeBits-1:0]      min_code, max_code;
  logic [Stages-2:0] [CodeBits-1:0]      min_code_q, max_code_q;
  logic [4:0] [2:0] [CodeBits-1:0]       z;
  logic [3:0] [2:0] [CodeBits-1:0]       z_q;

  assign reciprocal = {reciprocal_q, equation_i.reciprocal};
  assign shift      = {shift_q, equation_i.shift};
  assign min_code   = {min_code_q, equation_i.min_code};
  assign max_code   = {max_code_q, equation_i.max_code};
  assign z          = {z_q, CodeBits'(equation_i.z[2]), CodeBits'(equation_i.z[1]),
                       CodeBits'(equation_i.z[0])};

  always_ff @(posedge clk_i) begin
    for (int unsigned i = 0; i < Stages - 1; i++) begin
      if (valid[i]) begin
        min_code_q[i] <= min_code[i];
        max_code_q[i] <= max_code[i];
      end
    end
    for (int unsigned i = 0; i < 6; i++) begin
      if (valid[i]) begin
        reciprocal_q[i] <= reciprocal[i];
      end
    end
    for (int unsigned i = 0; i < 5; i++) begin
      if (valid[i]) begin
        shift_q[i] <= shift[i];
      end
    end
    for (int unsigned i = 0; i < 4; i++) begin
      if (valid[i]) begin
        z_q[i] <= z[i];
      end
    end
  end

  // For stages 2 to 6: 2A; exponents; reciprocal or mantissas; differences; z0 and half a code.
  edge_t              area2_q;
  logic [2:0] [7:0]   exponent_q;
  logic [2:0] [31:0]  factor_q;
  logic signed [31:0] difference1_q, difference2_q;
  logic signed [63:0] offset_q;

  always_ff @(posedge clk_i) begin
    if (valid[0]) begin
      area2_q <= equation_i.area2;
    end
    for (int unsigned i = 0; i < 3; i++) begin
      if (valid[1] && is_float[1]) begin
        exponent_q[i] <= z[1][i][30:23] == '0 ? 8'd1 : z[1][i][30:23];
      end
      if (valid[2]) begin
        factor_q[i] <= is_float[2] ? {8'b0, |z[2][i][30:23], z[2][i][22:0]} : reciprocal[2];
      end
    end
    if (valid[3]) begin
      difference1_q <= $signed(z[3][1]) - $signed(z[3][0]);
      difference2_q <= $signed(z[3][2]) - $signed(z[3][0]);
    end
    if (valid[4]) begin
      offset_q <= ($signed({32'b0, z[4][0]}) <<< WeightBits)
                  + (64'sd1 <<< (is_unorm16[4] ? 44 : 36));
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
      depth_sample u_sample (
        .clk_i         (clk_i),
        .float_i       (is_float),
        .valid_i       (quad_valid),
        .corner1_i     (corner[0]),
        .corner2_i     (corner[1]),
        .step1_i       ((s % 2 == 1 ? a[0] : '0) + (s / 2 == 1 ? b[0] : '0)),
        .step2_i       ((s % 2 == 1 ? a[1] : '0) + (s / 2 == 1 ? b[1] : '0)),
        .area2_i       (area2_q),
        .shift3_i      (shift[2]),
        .exponent_i    (exponent_q),
        .factor_i      (factor_q),
        .difference1_i (difference1_q),
        .difference2_i (difference2_q),
        .unorm16_i     (is_unorm16[5]),
        .offset_i      (offset_q),
        .min_code6_i   (min_code[5]),
        .max_code6_i   (max_code[5]),
        .shift6_i      (shift[5]),
        .reciprocal_i  (reciprocal[6]),
        .min_code8_i   (min_code[7]),
        .max_code8_i   (max_code[7]),
        .code_o        (code[4*q+s])
      );
    end
  end

  assign code_o = has_depth[7] ? code : '0;

  logic unused_valid;
  assign unused_valid = ^{valid[7:5], is_unorm16[7:6]};

endmodule
