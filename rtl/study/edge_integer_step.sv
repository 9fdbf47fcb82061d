// The same edge by increments: a register to which A is added for a pixel.

module edge_integer_step #(
  /// Bits of A, and of the sum.
  parameter int unsigned StepBits = 25,
  parameter int unsigned SumBits = 43
) (
  input  logic                       clk_i,
  input  logic                       first_i,
  input  logic signed [StepBits-1:0] a_i,
  input  logic signed [SumBits-1:0]  row_i,
  output logic                       inside_o
);

  typedef logic signed [SumBits-1:0] sum_t;

  logic signed [StepBits-1:0] a_q;
  sum_t                       sum_q;

  always_ff @(posedge clk_i) begin
    a_q      <= a_i;
    sum_q    <= first_i ? row_i : sum_q + sum_t'(a_q);
    inside_o <= !sum_q[SumBits-1];
  end

endmodule
