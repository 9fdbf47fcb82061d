// Product of two floating-point numbers, rounded to nearest even. Numbers are those of IEEE 754 with these widths, but
// subnormal numbers are taken for zero and a result that would be one is zero. Infinities and NaN must not come in; a
// product that is too large is infinity.

module fp_mul
#(
  parameter int unsigned ExponentBits = 8,
  parameter int unsigned FractionBits = 23
) (
  input  logic [ExponentBits+FractionBits:0] a_i,
  input  logic [ExponentBits+FractionBits:0] b_i,
  output logic [ExponentBits+FractionBits:0] product_o
);

  localparam int unsigned SignificandBits = FractionBits + 1;
  localparam int unsigned ProductBits = 2 * SignificandBits;
  localparam int unsigned Bias = (1 << (ExponentBits - 1)) - 1;

  typedef logic [SignificandBits-1:0] significand_t;
  typedef logic signed [ExponentBits+1:0] exponent_t;

  logic                    sign, any;
  logic [ExponentBits-1:0] a_field, b_field;
  significand_t            a, b;

  assign sign    = a_i[ExponentBits+FractionBits] ^ b_i[ExponentBits+FractionBits];
  assign a_field = a_i[FractionBits+:ExponentBits];
  assign b_field = b_i[FractionBits+:ExponentBits];
  assign a       = {1'b1, a_i[FractionBits-1:0]};
  assign b       = {1'b1, b_i[FractionBits-1:0]};
  assign any     = a_field != '0 && b_field != '0;

  // 1 to 4, with the binary point below the two top bits; below 2 it moves up by one.
  logic [ProductBits-1:0] product, normal;
  exponent_t              exponent;

  assign product = ProductBits'(a) * ProductBits'(b);

  always_comb begin
    exponent = exponent_t'({2'b0, a_field}) + exponent_t'({2'b0, b_field}) - exponent_t'(Bias);
    normal   = product << 1;
    if (product[ProductBits-1]) begin
      exponent = exponent + 1'b1;
      normal   = product;
    end
  end

  // The fraction, whose carry goes into the exponent.
  logic                                round_up;
  logic signed [ExponentBits+FractionBits+1:0] rounded;

  assign round_up = normal[FractionBits] & (|normal[FractionBits-1:0] | normal[FractionBits+1]);
  assign rounded  = {exponent, normal[ProductBits-2-:FractionBits]}
                    + $bits(rounded)'($unsigned({1'b0, round_up}));

  logic signed [ExponentBits+1:0] result_exponent;
  assign result_exponent = rounded[FractionBits+:ExponentBits+2];

  always_comb begin
    product_o = {sign, rounded[ExponentBits+FractionBits-1:0]};
    if (!any || result_exponent <= 0) begin
      product_o = {sign, {(ExponentBits + FractionBits) {1'b0}}};
    end else if (result_exponent >= exponent_t'((1 << ExponentBits) - 1)) begin
      product_o = {sign, {ExponentBits{1'b1}}, {FractionBits{1'b0}}};
    end
  end

endmodule
