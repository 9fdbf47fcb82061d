// The gradients of a triangle's depth, true quotients modulo 2^86, bit for bit those of
// model/halfspace/units/depth_plane.cpp.
//
//     dx = ((z1 - z0) a1 + (z2 - z0) a2) 2^22 / 2A        dy the same with b
//
// One triangle a cycle. Seven registers: steps of the edges, thrice; differences of depth; products; sums; magnitudes.
// They wait for the reciprocal of 2A. Then one register in which 2A has its top bit set and the numerators have moved
// along, five steps of the division of three each, and one for the sign. Four multipliers for the numerators, three in
// each step of each division.

module setup_plane
  import raster_pkg::*;
  import setup_pkg::*;
  import depth_pkg::*;
#(
  /// 0: short_o and large_o are 0.
  parameter bit HiZ = 1'b0
) (
  input  logic          clk_i,
  input  logic          rst_ni,

  input  logic          valid_i,
  input  coord_t [2:0]  x_i,
  input  coord_t [2:0]  y_i,
  input  area_t         area2_i,
  input  shift_t        shift_i,  // area2 >> shift has 32 bits

  // Three cycles later.
  input  word_t [2:0]   words_i,
  input  logic          short_i,

  // 17 cycles later.
  input  logic [31:0]   reciprocal_i,

  // 34 cycles later.
  output logic                                  valid_o,
  output logic [1:0] [HalfGradientBits-1:0]     dx_o,
  output logic [1:0] [HalfGradientBits-1:0]     dy_o,
  output logic                                  short_o,
  output logic                                  large_o  // a pixel changes depth by 2^-6 or more
);

  localparam int unsigned Divided = 17; // the cycle in which the reciprocal is there
  localparam int unsigned Steps = 5;
  localparam int unsigned Latency = Divided + 1 + 3 * Steps + 1;
  localparam int unsigned NumeratorBits = WordBits + StepBits;
  localparam int unsigned DividendBits = 23 * Steps; // a numerator and GradientFraction
  localparam int unsigned ShiftedBits = DividendBits + AreaBits - 1;

  typedef logic signed [WordBits:0] rise_t;
  typedef logic signed [NumeratorBits:0] numerator_t;
  typedef logic [NumeratorBits-1:0] magnitude_t;

  logic [Latency-1:0] valid;
  logic [Latency-1:1] valid_q;
  assign valid = {valid_q, valid_i};

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      valid_q <= '0;
      valid_o <= 1'b0;
    end else begin
      valid_q <= valid[Latency-2:0];
      valid_o <= valid[Latency-1];
    end
  end

  // Registers 1 to 4: the steps of edges 1 and 2, index 0 and 1, which wait for the depths.
  step_t [4:1] [1:0] a_q, b_q;

  function automatic step_t difference(coord_t plus, coord_t minus);
    return step_t'(plus) - step_t'(minus);
  endfunction

  always_ff @(posedge clk_i) begin
    if (valid[0]) begin
      a_q[1] <= {difference(y_i[0], y_i[1]), difference(y_i[2], y_i[0])};
      b_q[1] <= {difference(x_i[1], x_i[0]), difference(x_i[0], x_i[2])};
    end
    for (int unsigned i = 2; i <= 4; i++) begin
      if (valid[i-1]) begin
        a_q[i] <= a_q[i-1];
        b_q[i] <= b_q[i-1];
      end
    end
  end

  // Register 4: differences of depth. 5: products. 6: sums. 7: magnitudes.
  rise_t      rise1_q, rise2_q;
  numerator_t x1_q, x2_q, y1_q, y2_q, x_q, y_q;

  function automatic magnitude_t magnitude(numerator_t numerator);
    return magnitude_t'(numerator[NumeratorBits] ? -numerator : numerator);
  endfunction

  always_ff @(posedge clk_i) begin
    if (valid[3]) begin
      rise1_q <= rise_t'(words_i[1]) - rise_t'(words_i[0]);
      rise2_q <= rise_t'(words_i[2]) - rise_t'(words_i[0]);
    end
    if (valid[4]) begin
      x1_q <= numerator_t'(rise1_q) * numerator_t'(a_q[4][0]);
      x2_q <= numerator_t'(rise2_q) * numerator_t'(a_q[4][1]);
      y1_q <= numerator_t'(rise1_q) * numerator_t'(b_q[4][0]);
      y2_q <= numerator_t'(rise2_q) * numerator_t'(b_q[4][1]);
    end
    if (valid[5]) begin
      x_q <= x1_q + x2_q;
      y_q <= y1_q + y2_q;
    end
  end

  // What waits for the reciprocal: from register 7 on in element 7.
  typedef struct packed {
    magnitude_t x;
    magnitude_t y;
    logic       x_negative;
    logic       y_negative;
  } numerators_t;

  numerators_t                  wait_q [7:Divided] /*verilator split_var*/;
  area_t                        area_q [1:Divided] /*verilator split_var*/;
  shift_t                       shift_q [1:Divided] /*verilator split_var*/;
  logic [Latency-1:4]           short_q;
  logic [Latency-1:Divided+1]   x_negative_q, y_negative_q;

  always_ff @(posedge clk_i) begin
    if (valid[6]) begin
      wait_q[7] <= '{
        x:          magnitude(x_q),
        y:          magnitude(y_q),
        x_negative: x_q[NumeratorBits],
        y_negative: y_q[NumeratorBits]
      };
    end
    if (valid[0]) begin
      area_q[1]  <= area2_i;
      shift_q[1] <= shift_i;
    end
    if (valid[3]) begin
      short_q[4] <= short_i;
    end
    for (int unsigned i = 5; i < Latency; i++) begin
      if (valid[i-1]) begin
        short_q[i] <= short_q[i-1];
      end
    end
    if (valid[Divided]) begin
      x_negative_q[Divided+1] <= wait_q[Divided].x_negative;
      y_negative_q[Divided+1] <= wait_q[Divided].y_negative;
    end
    for (int unsigned i = Divided + 2; i < Latency; i++) begin
      if (valid[i-1]) begin
        x_negative_q[i] <= x_negative_q[i-1];
        y_negative_q[i] <= y_negative_q[i-1];
      end
    end
  end

  for (genvar i = 2; i <= Divided; i++) begin : gen_area
    always_ff @(posedge clk_i) begin
      if (valid[i-1]) begin
        area_q[i]  <= area_q[i-1];
        shift_q[i] <= shift_q[i-1];
      end
    end
  end

  for (genvar i = 8; i <= Divided; i++) begin : gen_wait
    always_ff @(posedge clk_i) begin
      if (valid[i-1]) begin
        wait_q[i] <= wait_q[i-1];
      end
    end
  end

  // The area's top bit goes to the top, and the numerators along. Their upper part is the first remainder.
  logic [5:0] zeros;
  assign zeros = 6'(AreaBits - 32) - shift_q[Divided];

  function automatic logic [ShiftedBits-1:0] shifted(magnitude_t numerator, logic [5:0] left);
    return (ShiftedBits'(numerator) << GradientFraction) << left;
  endfunction

  // Element i is at the beginning of step i.
  logic [26:0]             factor_q     [Steps] /*verilator split_var*/;
  logic [AreaBits-1:0]     divisor_q    [Steps] /*verilator split_var*/;
  logic [AreaBits-1:0]     x_remainder [Steps+1] /*verilator split_var*/;
  logic [AreaBits-1:0]     y_remainder [Steps+1] /*verilator split_var*/;
  logic [DividendBits-1:0] x_dividend [Steps+1] /*verilator split_var*/;
  logic [DividendBits-1:0] y_dividend [Steps+1] /*verilator split_var*/;
  logic [GradientBits-1:0] x_quotient [Steps+1] /*verilator split_var*/;
  logic [GradientBits-1:0] y_quotient [Steps+1] /*verilator split_var*/;

  assign x_quotient[0] = '0;
  assign y_quotient[0] = '0;

  always_ff @(posedge clk_i) begin
    if (valid[Divided]) begin
      factor_q[0]     <= reciprocal_i[31:5] - 27'd1;
      divisor_q[0]    <= area_q[Divided] << zeros;
      {x_remainder[0], x_dividend[0]} <= {1'b0, shifted(wait_q[Divided].x, zeros)};
      {y_remainder[0], y_dividend[0]} <= {1'b0, shifted(wait_q[Divided].y, zeros)};
    end
  end

  for (genvar i = 0; i < Steps; i++) begin : gen_step
    localparam int unsigned Begin = Divided + 1 + 3 * i;

    quotient_digits #(
      .Width (AreaBits),
      .Left  (DividendBits),
      .Kept  (GradientBits)
    ) u_x (
      .clk_i        (clk_i),
      .valid_i      (valid[Begin]),
      .divisor_i    (divisor_q[i]),
      .factor_i     (factor_q[i]),
      .remainder_i  (x_remainder[i]),
      .dividend_i   (x_dividend[i]),
      .quotient_i   (x_quotient[i]),
      .remainder_o  (x_remainder[i+1]),
      .dividend_o   (x_dividend[i+1]),
      .quotient_o   (x_quotient[i+1])
    );

    quotient_digits #(
      .Width (AreaBits),
      .Left  (DividendBits),
      .Kept  (GradientBits)
    ) u_y (
      .clk_i        (clk_i),
      .valid_i      (valid[Begin]),
      .divisor_i    (divisor_q[i]),
      .factor_i     (factor_q[i]),
      .remainder_i  (y_remainder[i]),
      .dividend_i   (y_dividend[i]),
      .quotient_i   (y_quotient[i]),
      .remainder_o  (y_remainder[i+1]),
      .dividend_o   (y_dividend[i+1]),
      .quotient_o   (y_quotient[i+1])
    );

    if (i + 1 < Steps) begin : gen_hand_on
      logic [26:0]         factor1_q, factor2_q;
      logic [AreaBits-1:0] divisor1_q, divisor2_q;

      always_ff @(posedge clk_i) begin
        if (valid[Begin]) begin
          factor1_q     <= factor_q[i];
          divisor1_q    <= divisor_q[i];
        end
        if (valid[Begin+1]) begin
          factor2_q     <= factor1_q;
          divisor2_q    <= divisor1_q;
        end
        if (valid[Begin+2]) begin
          factor_q[i+1]     <= factor2_q;
          divisor_q[i+1]    <= divisor2_q;
        end
      end
    end
  end

  // Last: short words need fewer bits, and the sign comes back.
  function automatic logic [GradientBits-1:0] signed_gradient(logic [GradientBits-1:0] quotient,
                                                              logic negative, logic is_short);
    logic [GradientBits-1:0] cut, gradient;
    cut      = is_short ? quotient >> ShortBits : quotient;
    gradient = negative ? -cut : cut;
    return is_short ? GradientBits'(gradient[ShortGradientBits-1:0]) : gradient;
  endfunction

  always_ff @(posedge clk_i) begin
    if (valid[Latency-1]) begin
      dx_o <= signed_gradient(x_quotient[Steps], x_negative_q[Latency-1], short_q[Latency-1]);
      dy_o <= signed_gradient(y_quotient[Steps], y_negative_q[Latency-1], short_q[Latency-1]);
    end
  end

  if (HiZ) begin : gen_large
    // What the modulus leaves of a large gradient may be small. So it is the digits of the first two steps that tell: the
    // last of them is worth 2^69.
    localparam int unsigned Known = Divided + 1 + 3 * 2;
    localparam int unsigned Digits = 23 * 2;
    localparam int unsigned Least = 26 + ShortBits + GradientFraction - SubPixelBits
                                    - (DividendBits - Digits);

    logic [Latency:Known+1] large_q;
    logic                   short_out_q;

    always_ff @(posedge clk_i) begin
      if (valid[Known]) begin
        large_q[Known+1] <= {x_quotient[2][Digits-1:Least], y_quotient[2][Digits-1:Least]} != '0;
      end
      for (int unsigned i = Known + 2; i <= Latency; i++) begin
        if (valid[i-1]) begin
          large_q[i] <= large_q[i-1];
        end
      end
      if (valid[Latency-1]) begin
        short_out_q <= short_q[Latency-1];
      end
    end

    assign short_o = short_out_q;
    assign large_o = large_q[Latency];
  end else begin : gen_no_large
    assign short_o = 1'b0;
    assign large_o = 1'b0;
  end

  logic unused_rest;
  assign unused_rest = ^{reciprocal_i[4:0], x_remainder[Steps], y_remainder[Steps],
                         x_dividend[Steps], y_dividend[Steps]};

endmodule
