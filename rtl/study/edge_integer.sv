// E = C + A x + B y of one edge at one pixel in integers, and whether its sign bit is clear: the arithmetic of the
// precision study that multiplies. The machine itself adds (edge_evaluator).

module edge_integer #(
  /// Bits of A and B, and of the sum.
  parameter int unsigned StepBits = 25,
  parameter int unsigned SumBits = 43
) (
  input  logic                       clk_i,
  input  logic signed [StepBits-1:0] a_i,
  input  logic signed [StepBits-1:0] b_i,
  input  logic signed [SumBits-1:0]  c_i,
  input  logic [13:0]                x_i,
  input  logic [13:0]                y_i,
  output logic                       inside_o
);

  typedef logic signed [SumBits-1:0] sum_t;

  logic signed [StepBits-1:0] a_q, b_q;
  logic signed [14:0]         x_q, y_q;
  sum_t                       c_q, sum;

  always_ff @(posedge clk_i) begin
    a_q <= a_i;
    b_q <= b_i;
    c_q <= c_i;
    x_q <= {1'b0, x_i};
    y_q <= {1'b0, y_i};
  end

  assign sum = c_q + sum_t'(a_q) * sum_t'(x_q) + sum_t'(b_q) * sum_t'(y_q);

  always_ff @(posedge clk_i) begin
    inside_o <= !sum[SumBits-1];
  end

endmodule
