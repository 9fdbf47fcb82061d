// An edge in floating point by increments: a register to which A is added for a pixel.

module edge_float_step #(
  parameter int unsigned ExponentBits = 8,
  parameter int unsigned FractionBits = 23
) (
  input  logic                               clk_i,
  input  logic                               first_i,
  input  logic [ExponentBits+FractionBits:0] a_i,
  input  logic [ExponentBits+FractionBits:0] row_i,
  input  logic                               owns_i,
  output logic                               inside_o
);

  localparam int unsigned Top = ExponentBits + FractionBits;

  logic [Top:0] a_q, value_q, next;
  logic         owns_q;

  fp_add #(.ExponentBits (ExponentBits), .FractionBits (FractionBits)) u_next (
    .a_i (value_q), .b_i (a_q), .sum_o (next)
  );

  always_ff @(posedge clk_i) begin
    a_q      <= a_i;
    owns_q   <= owns_i;
    value_q  <= first_i ? row_i : next;
    inside_o <= value_q[Top-1:0] == '0 ? owns_q : !value_q[Top];
  end

endmodule
