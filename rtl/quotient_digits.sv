// A step of a long division by a number whose reciprocal is known: 23 bits of the quotient.
//
// Three registers, one division a cycle. The top bits of the remainder times the reciprocal are the digits, or one more
// or less; their product with the divisor is taken away; what remains says which.

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
  input  logic [31:0]      reciprocal_i, // (2^63 - 1) / the divisor's top 32 bits
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

  // First: the estimate. Cutting the part and the reciprocal to 27 bits loses up to 1/8 of a digit each, leaving away the
  // product of lower halves 1/16, and the reciprocal is off by 1/128 at most: so the digits are right, or one more or
  // less.
  logic [PartBits-1:0] part;
  logic [26:0]         top, factor;
  logic [40:0]         estimate;
  assign part     = {remainder_i, dividend_i[Left-1-:Digits]};
  assign top      = part[PartBits-1-:27];
  assign factor   = reciprocal_i[31:5];
  assign estimate = 41'(top[26:13]) * 41'(factor) + 41'(top[12:0]) * 41'(factor[26:13]);

  // What remains is less than two divisors either way, so higher bits of part and product cannot matter.
  localparam int unsigned RestBits = Width + 2;

  typedef logic signed [RestBits-1:0] rest_t;
  typedef logic [Digits-1:0] digits_t;

  logic [Digits:0]     digits1_q; // 2^Digits is one too many
  digits_t             digits2_q;
  logic [RestBits-1:0] part1_q;
  rest_t               rest_q;
  logic [Width-1:0]    divisor1_q, divisor2_q;
  logic [Left-1:0]     dividend1_q, dividend2_q;
  logic [Kept-1:0]     quotient1_q, quotient2_q;

  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      digits1_q   <= estimate[40-:Digits+1];
      part1_q     <= part[RestBits-1:0];
      divisor1_q  <= divisor_i;
      dividend1_q <= dividend_i << Digits;
      quotient1_q <= quotient_i;
    end
  end

  // Second: what remains.
  always_ff @(posedge clk_i) begin
    if (valid_q[0]) begin
      digits2_q   <= digits_t'(digits1_q);
      rest_q      <= rest_t'(part1_q - RestBits'(digits1_q) * RestBits'(divisor1_q));
      divisor2_q  <= divisor1_q;
      dividend2_q <= dividend1_q;
      quotient2_q <= quotient1_q;
    end
  end

  // Third: one divisor more or less where the estimate was off. The right digits are below 2^Digits, so their carry is
  // left away.
  rest_t   less, more;
  digits_t digits;
  assign less = rest_q - rest_t'({1'b0, divisor2_q});
  assign more = rest_q + rest_t'({1'b0, divisor2_q});

  always_comb begin
    if (rest_q < 0) begin
      digits = digits2_q - digits_t'(1);
    end else if (less >= 0) begin
      digits = digits2_q + digits_t'(1);
    end else begin
      digits = digits2_q;
    end
  end

  always_ff @(posedge clk_i) begin
    if (valid_q[1]) begin
      dividend_o  <= dividend2_q;
      quotient_o  <= {quotient2_q[Kept-Digits-1:0], digits};
      remainder_o <= rest_q < 0 ? more[Width-1:0] : less >= 0 ? less[Width-1:0] : rest_q[Width-1:0];
    end
  end

  logic unused_rest;
  assign unused_rest = ^{less[RestBits-1:Width], more[RestBits-1:Width], estimate[40-Digits-1:0],
                         reciprocal_i[4:0], quotient2_q[Kept-1:Kept-Digits]};

endmodule
