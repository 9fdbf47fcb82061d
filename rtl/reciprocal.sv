// (2^63 - 1) / value, the value scaled to 32 bits with the top bit set: the reciprocal of an area. In general
// (2^(2 Width - 1) - 1) / value, the value scaled to Width bits.
//
// One cycle to scale, one to triple the divisor, 16 to divide by 2 bits a cycle: the quotient is there 17 cycles after
// the value, from logic; in general Width / 2 + 1. There are 16 / Interval stages; each works Interval cycles on a value,
// so values must be that far apart.

module reciprocal #(
  /// Bits of the value, Width to 63.
  parameter int unsigned ValueBits = 48,
  /// Bits of divisor and quotient, even.
  parameter int unsigned Width = 32,
  /// Cycles from value to value: 1, 2, 4, 8 or 16, a divisor of Width / 2. Each doubling halves the stages.
  parameter int unsigned Interval = 1
) (
  input  logic                 clk_i,
  input  logic                 rst_ni,

  // Not zero.
  input  logic                 valid_i,
  input  logic [ValueBits-1:0] value_i,
  // Goes along with the value.
  input  logic                 tag_i,
  // Of value_i, at once: value >> shift has Width bits.
  output logic signed [5:0]    shift_o,

  output logic                 valid_o,
  output logic                 tag_o,
  output logic [Width-1:0]     quotient_o
);

  localparam int unsigned Steps = Width / 2;
  localparam int unsigned Stages = Steps / Interval;

  // The value moved up until its top bit is set, in steps of powers of two; leading counts how far.
  logic [ValueBits-1:0] moved;
  logic [5:0]           leading;

  always_comb begin
    moved   = value_i;
    leading = '0;
    for (int k = $clog2(ValueBits) - 1; k >= 0; k--) begin
      if (moved >> (ValueBits - (1 << k)) == '0) begin
        moved      = moved << (1 << k);
        leading[k] = 1'b1;
      end
    end
  end

  assign shift_o = signed'(6'(ValueBits - Width)) - signed'(leading);

  logic             scaled_valid, scaled_tag;
  logic [Width-1:0] scaled;

  pipe_register #(
    .Width (1 + Width)
  ) u_scaled (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (valid_i),
    .data_i  ({tag_i, moved[ValueBits-1-:Width]}),
    .valid_o (scaled_valid),
    .data_o  ({scaled_tag, scaled})
  );

  // The first Width - 1 bits of the dividend are less than any divisor: they are the first remainder.
  logic             valid     [Stages+1];
  logic             tag       [Stages+1];
  logic [Width-1:0] divisor   [Stages+1];
  logic [Width+1:0] divisor3  [Stages+1];
  logic [Width-1:0] remainder [Stages+1];
  logic [Width-1:0] quotient  [Stages+1];

  assign valid[0]     = scaled_valid;
  assign tag[0]       = scaled_tag;
  assign divisor[0]   = scaled;
  assign divisor3[0]  = {1'b0, scaled, 1'b0} + {2'b0, scaled};
  assign remainder[0] = {1'b0, {(Width - 1){1'b1}}};
  assign quotient[0]  = '0;

  for (genvar i = 0; i < Stages; i++) begin : gen_stage
    reciprocal_stage #(
      .Width    (Width),
      .Interval (Interval),
      .Found    (2 * Interval * (i + 1))
    ) u_stage (
      .clk_i       (clk_i),
      .rst_ni      (rst_ni),
      .start_i     (valid[i]),
      .tag_i       (tag[i]),
      .divisor_i   (divisor[i]),
      .divisor3_i  (divisor3[i]),
      .remainder_i (remainder[i]),
      .quotient_i  (quotient[i]),
      .done_o      (valid[i+1]),
      .tag_o       (tag[i+1]),
      .divisor_o   (divisor[i+1]),
      .divisor3_o  (divisor3[i+1]),
      .remainder_o (remainder[i+1]),
      .quotient_o  (quotient[i+1])
    );
  end

  logic unused_rest;
  assign unused_rest = ^{divisor[Stages], divisor3[Stages], remainder[Stages]};

  assign valid_o    = valid[Stages];
  assign tag_o      = tag[Stages];
  assign quotient_o = quotient[Stages];

endmodule
