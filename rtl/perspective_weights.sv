// The weights of vertices 1 and 2 at one pixel, b_i = E_i q_i / (E_0 q_0 + E_1 q_1 + E_2 q_2) with q = 1/w: bit for bit
// perspective_weights() of model/halfspace/units/interpolator.cpp. A pixel a cycle; nothing stalls.
//
// E at the pixel; its magnitude as a mantissa and an exponent; the product with q; all three on the scale of the largest;
// their sum; its reciprocal by long division; the terms times the reciprocal.

module perspective_weights
  import raster_pkg::*;
#(
  /// Bits of the mantissas that are multiplied, and of a weight below the point: even, 8 to 24.
  parameter int unsigned Bits = 24,
  /// Bits of a weight: 4 above the point, and its sign. Follows.
  localparam int unsigned WeightBits = Bits + 5
) (
  input  logic                        clk_i,
  input  logic                        rst_ni,

  // Unbiased E of edges 1 and 2 at the first pixel of the quad, and how much more they are at this one; their sum with that
  // of edge 0; 1/w of the vertices as float32, positive and normal.
  input  logic                        valid_i,
  input  edge_t [1:0]                 corner_i,
  input  edge_t [1:0]                 step_i,
  input  edge_t                       area2_i,
  input  logic [2:0] [FloatBits-1:0]  q_i,

  // Bits / 2 + 13 cycles later.
  output logic                        valid_o,
  output logic signed [WeightBits-1:0] weight1_o,
  output logic signed [WeightBits-1:0] weight2_o
);

  localparam int unsigned FloatMantissa = 24;
  localparam int unsigned TermBits = Bits + 3;
  localparam int unsigned SumBits = TermBits + 2;    // of a positive sum
  localparam int unsigned DivisorBits = Bits + 4;
  localparam int unsigned PowerBits = 10;            // of the power of two of a product
  localparam int unsigned DivisionCycles = DivisorBits / 2 + 1;
  localparam int unsigned CutBits = $clog2(2 * DivisorBits + 1);

  typedef logic [Bits-1:0] mantissa_t;
  typedef logic [TermBits-1:0] magnitude_t;
  typedef logic signed [TermBits:0] term_t;
  typedef logic signed [PowerBits-1:0] power_t;

  if (Bits % 2 != 0 || Bits < 8 || Bits > FloatMantissa) begin : gen_illegal_bits
    $error("Bits must be even, 8 to 24");
  end

  // 1: E at the pixel.
  logic [6:0]                 valid_q;
  edge_t [1:0]                at_pixel_q;
  edge_t                      area2_q;
  logic [2:0] [FloatBits-1:0] q1_q, q2_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      valid_q <= '0;
    end else begin
      valid_q <= {valid_q[5:0], valid_i};
    end
  end

  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      for (int unsigned i = 0; i < 2; i++) begin
        at_pixel_q[i] <= corner_i[i] + step_i[i];
      end
      area2_q <= area2_i;
      q1_q    <= q_i;
    end
  end

  // 2: of all three edges, as sign and magnitude.
  typedef logic [EdgeBits-2:0] size_t;

  edge_t      at_pixel [EdgeCount];
  logic [2:0] negative2_q;
  size_t      size2_q [EdgeCount];

  assign at_pixel[0] = area2_q - at_pixel_q[0] - at_pixel_q[1];
  assign at_pixel[1] = at_pixel_q[0];
  assign at_pixel[2] = at_pixel_q[1];

  always_ff @(posedge clk_i) begin
    if (valid_q[0]) begin
      for (int unsigned i = 0; i < EdgeCount; i++) begin
        negative2_q[i] <= at_pixel[i][EdgeBits-1];
        size2_q[i]     <= size_t'(at_pixel[i][EdgeBits-1] ? -at_pixel[i] : at_pixel[i]);
      end
      q2_q <= q1_q;
    end
  end

  // 3: mantissas with their top bit set, or 0; exponents of the products.
  localparam int unsigned SizeBits = EdgeBits - 1;

  logic [2:0] negative3_q;
  mantissa_t  edge3_q [EdgeCount];
  mantissa_t  q3_q [EdgeCount];
  power_t  exponent3_q [EdgeCount];

  typedef struct packed {
    logic [5:0] zeros;
    mantissa_t  mantissa;
  } normal_t;

  function automatic normal_t normal_of(size_t size);
    size_t      moved;
    logic [5:0] zeros;
    moved = size;
    zeros = '0;
    for (int k = 5; k >= 0; k--) begin
      if (moved >> (SizeBits - (1 << k)) == '0) begin
        moved    = moved << (1 << k);
        zeros[k] = 1'b1;
      end
    end
    return '{zeros: zeros, mantissa: moved[SizeBits-1-:Bits]};
  endfunction

  always_ff @(posedge clk_i) begin
    if (valid_q[1]) begin
      for (int unsigned i = 0; i < EdgeCount; i++) begin
        automatic normal_t normal = normal_of(size2_q[i]);
        edge3_q[i]     <= normal.mantissa;
        q3_q[i]        <= {1'b1, q2_q[i][FloatMantissa-2-:Bits-1]};
        exponent3_q[i] <= power_t'({1'b0, q2_q[i][FloatMantissa-1+:8]})
                          - power_t'({1'b0, normal.zeros});
      end
      negative3_q <= negative2_q;
    end
  end

  // 4: products, cut to what is added.
  logic [2:0] negative4_q;
  magnitude_t product4_q [EdgeCount];
  power_t  exponent4_q [EdgeCount];

  function automatic magnitude_t product_of(mantissa_t a, mantissa_t b);
    return TermBits'(((2 * Bits)'(a) * (2 * Bits)'(b)) >> (2 * Bits - TermBits));
  endfunction

  always_ff @(posedge clk_i) begin
    if (valid_q[2]) begin
      for (int unsigned i = 0; i < EdgeCount; i++) begin
        product4_q[i]  <= product_of(edge3_q[i], q3_q[i]);
        exponent4_q[i] <= exponent3_q[i];
      end
      negative4_q <= negative3_q;
    end
  end

  // 5: how far each is below the largest exponent. Those of products that are 0 have no say.
  typedef logic [PowerBits-1:0] distance_t;

  logic [2:0] negative5_q;
  magnitude_t product5_q [EdgeCount];
  distance_t  distance_q [EdgeCount];

  function automatic power_t larger(power_t top, magnitude_t product, power_t exponent);
    return product != '0 && exponent > top ? exponent : top;
  endfunction

  localparam power_t Least = {1'b1, {(PowerBits - 1) {1'b0}}};

  power_t top;
  always_comb begin
    top = Least;
    for (int unsigned i = 0; i < EdgeCount; i++) begin
      top = larger(top, product4_q[i], exponent4_q[i]);
    end
  end

  always_ff @(posedge clk_i) begin
    if (valid_q[3]) begin
      for (int unsigned i = 0; i < EdgeCount; i++) begin
        distance_q[i] <= top - exponent4_q[i];
        product5_q[i] <= product4_q[i];
      end
      negative5_q <= negative4_q;
    end
  end

  // 6: all on its scale.
  term_t term6_q [EdgeCount];

  function automatic term_t aligned(magnitude_t product, logic negative, distance_t distance);
    magnitude_t moved;
    moved = distance < distance_t'(TermBits) ? product >> distance : '0;
    return negative ? -term_t'({1'b0, moved}) : term_t'({1'b0, moved});
  endfunction

  always_ff @(posedge clk_i) begin
    if (valid_q[4]) begin
      for (int unsigned i = 0; i < EdgeCount; i++) begin
        term6_q[i] <= aligned(product5_q[i], negative5_q[i], distance_q[i]);
      end
    end
  end

  // 7: the sum. What is not above 0 is divided as 1, and its weights are 0.
  logic [SumBits-1:0] sum7_q;
  term_t              term1_q, term2_q;

  logic signed [SumBits:0] sum;
  logic                    positive;
  assign sum      = (SumBits + 1)'(term6_q[0]) + (SumBits + 1)'(term6_q[1])
                    + (SumBits + 1)'(term6_q[2]);
  assign positive = sum > 0;

  always_ff @(posedge clk_i) begin
    if (valid_q[5]) begin
      sum7_q  <= positive ? sum[SumBits-1:0] : SumBits'(1);
      term1_q <= positive ? term6_q[1] : '0;
      term2_q <= positive ? term6_q[2] : '0;
    end
  end

  // 8 and on: the division, with the terms and the scale of the sum beside it.
  logic signed [5:0]      shift;
  logic                   divided, unused_tag;
  logic [DivisorBits-1:0] quotient;

  reciprocal #(
    .ValueBits (SumBits),
    .Width     (DivisorBits)
  ) u_reciprocal (
    .clk_i      (clk_i),
    .rst_ni     (rst_ni),
    .valid_i    (valid_q[6]),
    .value_i    (sum7_q),
    .tag_i      (1'b0),
    .shift_o    (shift),
    .valid_o    (divided),
    .tag_o      (unused_tag),
    .quotient_o (quotient)
  );

  typedef struct packed {
    logic              negative1;
    logic              negative2;
    magnitude_t        magnitude1;
    magnitude_t        magnitude2;
    logic signed [5:0] shift;
  } waiting_t;

  function automatic magnitude_t magnitude_of(term_t term);
    return magnitude_t'(term[TermBits] ? -term : term);
  endfunction

  waiting_t waiting, done;
  assign waiting = '{
    negative1:  term1_q[TermBits],
    negative2:  term2_q[TermBits],
    magnitude1: magnitude_of(term1_q),
    magnitude2: magnitude_of(term2_q),
    shift:      shift
  };

  delay_memory #(
    .Width  ($bits(waiting_t)),
    .Cycles (DivisionCycles + 1)
  ) u_waiting (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (valid_q[6]),
    .data_i  (waiting),
    .data_o  (done)
  );

  logic                   quotient_valid_q;
  logic [DivisorBits-1:0] quotient_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      quotient_valid_q <= 1'b0;
    end else begin
      quotient_valid_q <= divided;
    end
  end

  always_ff @(posedge clk_i) begin
    if (divided) begin
      quotient_q <= quotient;
    end
  end

  // Terms times the reciprocal.
  typedef logic [TermBits+DivisorBits-1:0] scaled_t;
  typedef logic [CutBits-1:0] cut_t;

  logic    scaled_valid_q;
  scaled_t scaled1_q, scaled2_q;
  logic    negative1_q, negative2_last_q;
  cut_t    cut_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      scaled_valid_q <= 1'b0;
    end else begin
      scaled_valid_q <= quotient_valid_q;
    end
  end

  always_ff @(posedge clk_i) begin
    if (quotient_valid_q) begin
      scaled1_q        <= done.magnitude1 * quotient_q;
      scaled2_q        <= done.magnitude2 * quotient_q;
      negative1_q      <= done.negative1;
      negative2_last_q <= done.negative2;
      cut_q            <= cut_t'(2 * DivisorBits - 1 - Bits) + cut_t'(done.shift);
    end
  end

  // Their scale, saturated.
  typedef logic signed [WeightBits-1:0] weight_t;

  function automatic weight_t weight_of(scaled_t scaled, logic negative, cut_t cut);
    localparam logic [WeightBits-2:0] Most = '1;
    scaled_t moved;
    weight_t weight;
    moved  = scaled >> cut;
    weight = {1'b0, moved > scaled_t'(Most) ? Most : moved[WeightBits-2:0]};
    return negative ? -weight : weight;
  endfunction

  logic    valid_out_q;
  weight_t weight1_q, weight2_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      valid_out_q <= 1'b0;
    end else begin
      valid_out_q <= scaled_valid_q;
    end
  end

  always_ff @(posedge clk_i) begin
    if (scaled_valid_q) begin
      weight1_q <= weight_of(scaled1_q, negative1_q, cut_q);
      weight2_q <= weight_of(scaled2_q, negative2_last_q, cut_q);
    end
  end

  assign valid_o   = valid_out_q;
  assign weight1_o = weight1_q;
  assign weight2_o = weight2_q;

endmodule
