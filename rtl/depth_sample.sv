// Depth at one sample by barycentric weights, in eight stages: the stored code of a unorm16, unorm24 or float32
// surface, bit for bit that of model/units/depth_interpolator.hpp. Seven registers; the last stage is wires.
//
// unorm: z0 + w1 (z1 - z0) + w2 (z2 - z0), w_i = E_i / 2A by the reciprocal of 2A, rounded and clamped.
// float32: the sum of the three E_i z_i, none of which is negative, aligned to the largest; times the reciprocal,
// rounded to 24 bits and clamped. Both share the first multipliers.

module depth_sample
  import raster_pkg::*;
(
  input  logic                  clk_i,

  // Stage 1: pixel in the tile, E of edges 1 and 2 at the tile origin.
  input  logic [TileLog2-1:0]   x_i,
  input  logic [TileLog2-1:0]   y_i,
  input  edge_t [1:0]           e_i,

  // Element i belongs to the sample in stage i + 1.
  input  depth_equation_t       equation_i [8],
  input  logic [FormatBits-1:0] format_i   [8],

  // Stage 8. Of a sample that is not covered it means nothing.
  output logic [CodeBits-1:0]   code_o
);

  localparam int unsigned WeightBits = 30;   // fraction bits of a weight
  // Signed; holds every sum of exponents of covered samples.
  localparam int unsigned ExponentBits = 11;
  localparam logic [FormatBits-1:0] Unorm16 = 1;
  localparam logic [FormatBits-1:0] Float32 = 4;

  typedef logic signed [ExponentBits-1:0] exponent_t;
  typedef logic signed [StepBits+TileLog2-1:0] steps_t;

  // Left shift that brings the top bit of a number to bit 63; 63 for 0 and 1.
  function automatic logic [5:0] leading_zeros(logic [63:0] value);
    logic [5:0] count;
    count = 6'd63;
    for (int unsigned i = 0; i < 64; i++) begin
      if (value[i]) begin
        count = 6'(63 - i);
      end
    end
    return count;
  endfunction

  // A step, so many times: a shifted step for each bit of the count, which is too small for a multiplier.
  function automatic steps_t times(step_t step, logic [TileLog2-1:0] count);
    steps_t sum;
    sum = '0;
    for (int unsigned i = 0; i < TileLog2; i++) begin
      if (count[i]) begin
        sum = sum + (steps_t'(step) <<< i);
      end
    end
    return sum;
  endfunction

  // 1: unbiased E at the sample.
  function automatic edge_t edge_at(edge_t origin, logic bias, step_t a, step_t b,
                                    logic [TileLog2-1:0] x, logic [TileLog2-1:0] y);
    edge_t steps;
    steps = edge_t'(times(a, x)) + edge_t'(times(b, y));
    return origin + edge_t'($signed({1'b0, bias})) + (steps <<< SubPixelBits);
  endfunction

  edge_t [1:0] edge_q;
  always_ff @(posedge clk_i) begin
    for (int unsigned i = 0; i < 2; i++) begin
      edge_q[i] <= edge_at(e_i[i], equation_i[0].bias[i+1], equation_i[0].a[i],
                           equation_i[0].b[i], x_i, y_i);
    end
  end

  // 2: the three weights' numerators.
  edge_t [2:0] weight_q;
  always_ff @(posedge clk_i) begin
    weight_q[0] <= equation_i[1].area2 - edge_q[0] - edge_q[1];
    weight_q[1] <= edge_q[0];
    weight_q[2] <= edge_q[1];
  end

  // 3: on the scale of the 32-bit 2A for unorm; with their top bit at bit 31 for float32. Exponents are of E_i z_i.
  logic [2:0] [31:0] operand_d, operand_q;
  exponent_t [2:0]   exponent3_d, exponent3_q;

  always_comb begin
    for (int unsigned i = 0; i < 3; i++) begin
      automatic logic [63:0] value = 64'(weight_q[i]);
      automatic logic [5:0] zeros = leading_zeros(value);
      automatic logic [5:0] right = equation_i[2].shift;
      automatic logic [5:0] left = -equation_i[2].shift;
      automatic logic [31:0] scaled =
          equation_i[2].shift[ShiftBits-1] ? 32'(value << left) : 32'(value >> right);
      automatic logic [7:0] field = equation_i[2].z[i][30:23];
      operand_d[i] = format_i[2] == Float32 ? 32'((value << zeros) >> 32) : scaled;
      exponent3_d[i] = exponent_t'(32 - 150) - exponent_t'($signed({1'b0, zeros}))
                       + (field == '0 ? exponent_t'(1) : exponent_t'($signed({1'b0, field})));
    end
  end

  always_ff @(posedge clk_i) begin
    operand_q   <= operand_d;
    exponent3_q <= exponent3_d;
  end

  // 4: weights, or products with the mantissas.
  logic [2:0] [63:0] product_q;
  exponent_t [2:0]   exponent4_q;

  always_ff @(posedge clk_i) begin
    for (int unsigned i = 0; i < 3; i++) begin
      automatic logic [31:0] factor =
          format_i[3] == Float32 ? {8'b0, |equation_i[3].z[i][30:23], equation_i[3].z[i][22:0]}
                                 : equation_i[3].reciprocal;
      product_q[i] <= operand_q[i] * factor;
    end
    exponent4_q <= exponent3_q;
  end

  // 5: unorm terms; the float32 sum on the scale of its largest product.
  logic signed [63:0] term_q [3];
  logic [63:0]        sum_d, sum_q;
  exponent_t          top_d, top_q;

  always_comb begin
    top_d = {1'b1, {(ExponentBits - 1) {1'b0}}};
    for (int unsigned i = 0; i < 3; i++) begin
      if (product_q[i] != '0 && exponent4_q[i] > top_d) begin
        top_d = exponent4_q[i];
      end
    end
    sum_d = '0;
    for (int unsigned i = 0; i < 3; i++) begin
      automatic logic [ExponentBits-1:0] shift = top_d - exponent4_q[i];
      if (product_q[i] != '0 && shift < 64) begin
        sum_d += product_q[i] >> shift[5:0];
      end
    end
  end

  always_ff @(posedge clk_i) begin
    for (int unsigned i = 1; i < 3; i++) begin
      term_q[i] <= $signed({33'b0, product_q[i][63:63-WeightBits]})
                   * ($signed({33'b0, equation_i[4].z[i]}) - $signed({33'b0, equation_i[4].z[0]}));
    end
    term_q[0] <= $signed({33'b0, equation_i[4].z[0]}) <<< WeightBits;
    sum_q     <= sum_d;
    top_q     <= top_d;
  end

  // 6: the unorm code; the float32 sum with its top bit at bit 31.
  logic [CodeBits-1:0] unorm_d, unorm6_q, unorm7_q;
  logic [31:0]         mantissa_q;
  exponent_t           exponent6_q, exponent7_q;

  always_comb begin
    automatic logic signed [63:0] sum = term_q[0] + term_q[1] + term_q[2];
    automatic logic signed [63:0] code =
        format_i[5] == Unorm16 ? (sum + (64'sd1 <<< 44)) >>> 45 : (sum + (64'sd1 <<< 36)) >>> 37;
    if (code < $signed({32'b0, equation_i[5].min_code})) begin
      unorm_d = equation_i[5].min_code;
    end else if (code > $signed({32'b0, equation_i[5].max_code})) begin
      unorm_d = equation_i[5].max_code;
    end else begin
      unorm_d = code[31:0];
    end
  end

  always_ff @(posedge clk_i) begin
    automatic logic [5:0] zeros = leading_zeros(sum_q);
    unorm6_q    <= unorm_d;
    mantissa_q  <= 32'((sum_q << zeros) >> 32);
    exponent6_q <= top_q + exponent_t'(32 - 63) - exponent_t'($signed({1'b0, zeros}))
                   - exponent_t'(equation_i[5].shift);
  end

  // 7: divided by 2A.
  logic [63:0] quotient_q;
  always_ff @(posedge clk_i) begin
    quotient_q  <= mantissa_q * equation_i[6].reciprocal;
    exponent7_q <= exponent6_q;
    unorm7_q    <= unorm6_q;
  end

  // 8: the nearest float, halves upwards. Both factors have their top bit set, so the product has 63 or 64 bits.
  logic [31:0] float_bits;

  always_comb begin
    automatic exponent_t width = quotient_q[63] ? exponent_t'(64) : exponent_t'(63);
    automatic exponent_t normal = width - exponent_t'(24);
    automatic exponent_t subnormal = exponent_t'(-149) - exponent7_q;
    automatic exponent_t cut = normal > subnormal ? normal : subnormal;
    automatic logic [5:0] shift = 6'(cut - exponent_t'(1));
    automatic logic [31:0] rounded = 32'(((quotient_q >> shift) + 64'd1) >> 1);
    automatic logic [8:0] place = 9'(exponent7_q + cut + exponent_t'(149));
    float_bits = quotient_q == '0 || cut > width ? '0 : {place, 23'b0} + rounded;
    if (format_i[7] != Float32) begin
      code_o = unorm7_q;
    end else if (float_bits < equation_i[7].min_code) begin
      code_o = equation_i[7].min_code;
    end else if (float_bits > equation_i[7].max_code) begin
      code_o = equation_i[7].max_code;
    end else begin
      code_o = float_bits;
    end
    if (format_i[7] == '0) begin
      code_o = '0;
    end
  end

endmodule
