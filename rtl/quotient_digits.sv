// A step of a long division by a number whose reciprocal is known: 23 bits of the quotient.
//
// Three registers, one division a cycle. The top bits of the remainder times the reciprocal are the digits, or one less;
// their product with the divisor is taken away; what remains says which.

module quotient_digits #(
  /// Bits of the divisor, 32 or more; its top bit is set.
  parameter int unsigned Width = 48,
  /// Bits of the dividend that are yet to come, 23 or more, and of the quotient that are kept.
  parameter int unsigned Left = 115,
  parameter int unsigned Kept = 86
) (
  input  logic             clk_i,

  input  logic             valid_i,
  input  logic [Width-1:0] divisor_i,
  input  logic [26:0]      factor_i,     // (2^58 - 1) / the divisor's top 32 bits, less 1
  input  logic [Width-1:0] remainder_i,  // less than the divisor
  input  logic [Left-1:0]  dividend_i,
  input  logic [Kept-1:0]  quotient_i,

  // Three cycles later.
  output logic [Width-1:0] remainder_o,
  output logic [Left-1:0]  dividend_o,
  output logic [Kept-1:0]  quotient_o
);

  localparam int unsigned Digits = 23;
  localparam int unsigned PartBits = Width + Digits;

  logic [1:0] valid_q;

  always_ff @(posedge clk_i) begin
    valid_q <= {valid_q[0], valid_i};
  end

  // First: the estimate. The factor is at most 2 less than 2^58 over the whole divisor, never more: its last 1 outweighs
  // what the divisor's lower bits lower the quotient by. It loses less than 1/4 of a digit, cutting the part to 27 bits
  // 1/8, and leaving away the product of lower halves 1/16: so the digits are right, or one less.
  logic [PartBits-1:0] part;
  logic [26:0]         top;
  logic [39:0]         estimate; // 17 bits below the digits
  assign part     = {remainder_i, dividend_i[Left-1-:Digits]};
  assign top      = part[PartBits-1-:27];
  assign estimate = 40'(top[26:13]) * 40'(factor_i) + 40'(top[12:0]) * 40'(factor_i[26:13]);

  // What remains is less than two divisors, so higher bits of part and product cannot matter.
  typedef logic [Width:0] rest_t;
  typedef logic [Digits-1:0] digits_t;

  digits_t             digits1_q, digits2_q;
  rest_t               part1_q, rest_q;
  logic [Width-1:0]    divisor1_q, divisor2_q;
  logic [Left-1:0]     dividend1_q, dividend2_q;
  logic [Kept-1:0]     quotient1_q, quotient2_q;

  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      digits1_q   <= estimate[39-:Digits];
      part1_q     <= part[Width:0];
      divisor1_q  <= divisor_i;
      dividend1_q <= dividend_i << Digits;
      quotient1_q <= quotient_i;
    end
  end

  // Second: what remains.
  always_ff @(posedge clk_i) begin
    if (valid_q[0]) begin
      digits2_q   <= digits1_q;
      rest_q      <= part1_q - rest_t'(digits1_q) * rest_t'(divisor1_q);
      divisor2_q  <= divisor1_q;
      dividend2_q <= dividend1_q;
      quotient2_q <= quotient1_q;
    end
  end

  // Third: one divisor less where the estimate was one less.
  rest_t   less;
  logic    right;
  digits_t digits;
  assign less   = rest_q - rest_t'(divisor2_q);
  assign right  = less[Width]; // the difference is negative
  assign digits = right ? digits2_q : digits2_q + digits_t'(1);

  always_ff @(posedge clk_i) begin
    if (valid_q[1]) begin
      dividend_o  <= dividend2_q;
      quotient_o  <= {quotient2_q[Kept-Digits-1:0], digits};
      remainder_o <= right ? rest_q[Width-1:0] : less[Width-1:0];
    end
  end

  logic unused_rest;
  assign unused_rest = ^{estimate[39-Digits:0], quotient2_q[Kept-1:Kept-Digits]};

endmodule
