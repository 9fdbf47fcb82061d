// Sum of two floating-point numbers, rounded to nearest even. Numbers are as in fp_mul.

module fp_add
  import fp_pkg::leading_zeros;
#(
  parameter int unsigned ExponentBits = 8,
  parameter int unsigned FractionBits = 23
) (
  input  logic [ExponentBits+FractionBits:0] a_i,
  input  logic [ExponentBits+FractionBits:0] b_i,
  output logic [ExponentBits+FractionBits:0] sum_o
);

  // Below the significand: the bit that decides rounding, one for the subtraction, and whether there is more.
  localparam int unsigned Extra = 3;
  localparam int unsigned Significand = FractionBits + 1 + Extra;
  localparam int unsigned SumBits = Significand + 1;

  typedef logic [ExponentBits+FractionBits:0] number_t;
  typedef logic [ExponentBits-1:0] field_t;
  typedef logic [Significand-1:0] significand_t;
  typedef logic signed [ExponentBits+1:0] exponent_t;

  // The larger magnitude first. A subnormal number is zero.
  number_t major, minor;

  typedef logic [ExponentBits+FractionBits-1:0] magnitude_t;

  function automatic significand_t significand(magnitude_t number);
    return number[FractionBits+:ExponentBits] == '0
           ? '0 : {1'b1, number[FractionBits-1:0], {Extra{1'b0}}};
  endfunction

  always_comb begin
    major = a_i;
    minor = b_i;
    if (b_i[ExponentBits+FractionBits-1:0] > a_i[ExponentBits+FractionBits-1:0]) begin
      major = b_i;
      minor = a_i;
    end
  end

  logic         subtracts;
  field_t       major_field, distance;
  significand_t major_part, minor_part, aligned;
  logic         lost;

  assign subtracts   = major[ExponentBits+FractionBits] ^ minor[ExponentBits+FractionBits];
  assign major_field = major[FractionBits+:ExponentBits];
  assign distance    = major_field - minor[FractionBits+:ExponentBits];
  assign major_part  = significand(major[ExponentBits+FractionBits-1:0]);
  assign minor_part  = significand(minor[ExponentBits+FractionBits-1:0]);

  // Of what is shifted out one bit is left: whether there was any.
  assign aligned = minor_part >> distance;
  assign lost    = |(minor_part & ~({Significand{1'b1}} << distance));

  logic [SumBits-1:0] sum, normal;
  logic [7:0]         zeros;
  exponent_t          exponent;

  always_comb begin
    sum = {1'b0, major_part} + {1'b0, aligned[Significand-1:1], aligned[0] | lost};
    if (subtracts) begin
      sum = {1'b0, major_part} - {1'b0, aligned[Significand-1:1], aligned[0] | lost};
    end
    zeros    = leading_zeros(128'(sum), SumBits);
    normal   = sum << zeros;
    exponent = exponent_t'({2'b0, major_field}) + 1'b1 - exponent_t'(zeros);
  end

  logic                                round_up;
  logic signed [ExponentBits+FractionBits+1:0] rounded;
  logic signed [ExponentBits+1:0]      result_exponent;

  assign round_up = normal[Extra] & (|normal[Extra-1:0] | normal[Extra+1]);
  assign rounded  = {exponent, normal[SumBits-2-:FractionBits]}
                    + $bits(rounded)'($unsigned({1'b0, round_up}));
  assign result_exponent = rounded[FractionBits+:ExponentBits+2];

  logic sign;
  // A difference of equals is +0.
  assign sign = sum == '0 ? major[ExponentBits+FractionBits] & minor[ExponentBits+FractionBits]
                : major[ExponentBits+FractionBits];

  always_comb begin
    sum_o = {sign, rounded[ExponentBits+FractionBits-1:0]};
    if (sum == '0 || result_exponent <= 0) begin
      sum_o = {sign, {(ExponentBits + FractionBits) {1'b0}}};
    end else if (result_exponent >= exponent_t'((1 << ExponentBits) - 1)) begin
      sum_o = {sign, {ExponentBits{1'b1}}, {FractionBits{1'b0}}};
    end
  end

endmodule
