// Depth at the samples of a beat: depth_sample for each, with the equation of the triangle kept in step with them.
// Latency is 7 cycles; a beat a cycle; nothing stalls.

module depth_interpolator
  import raster_pkg::*;
#(
  /// Quads of a beat, 1 or more. Each costs four samples, with 8 multipliers each.
  parameter int unsigned Quads = TestWidth
) (
  input  logic                                  clk_i,

  input  logic [FormatBits-1:0]                 format_i,
  input  depth_equation_t                       equation_i,
  input  edge_t [1:0]                           e_i,
  input  logic [Quads-1:0] [QuadIndexBits-1:0]  index_i,

  /// Four samples a quad, in the order of its mask.
  output logic [4*Quads-1:0] [CodeBits-1:0]     code_o
);

  localparam int unsigned Stages = 8;
  localparam int unsigned QuadLog2 = TileLog2 - 1;

  depth_equation_t       equation [Stages];
  logic [FormatBits-1:0] format   [Stages];
  depth_equation_t       equation_q [Stages-1];
  logic [FormatBits-1:0] format_q   [Stages-1];

  always_ff @(posedge clk_i) begin
    for (int unsigned i = 0; i < Stages - 1; i++) begin
      equation_q[i] <= equation[i];
      format_q[i]   <= format[i];
    end
  end

  assign equation[0] = equation_i;
  assign format[0]   = format_i;
  for (genvar i = 1; i < Stages; i++) begin : gen_stage
    assign equation[i] = equation_q[i-1];
    assign format[i]   = format_q[i-1];
  end

  for (genvar q = 0; q < Quads; q++) begin : gen_quad
    for (genvar s = 0; s < 4; s++) begin : gen_sample
      depth_sample u_sample (
        .clk_i      (clk_i),
        .x_i        ({index_i[q][QuadLog2-1:0], 1'(s % 2)}),
        .y_i        ({index_i[q][2*QuadLog2-1:QuadLog2], 1'(s / 2)}),
        .e_i        (e_i),
        .equation_i (equation),
        .format_i   (format),
        .code_o     (code_o[4*q+s])
      );
    end
  end

endmodule
