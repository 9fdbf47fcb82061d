// Depth at one sample by barycentric weights, in 13 stages: the stored code of a unorm16, unorm24 or float32 surface,
// bit for bit that of model/halfspace/units/depth_barycentric.hpp. Twelve registers; the last stage is wires.
//
// unorm: z0 + w1 (z1 - z0) + w2 (z2 - z0), w_i = E_i / 2A by the reciprocal of 2A, and the offset, rounded and clamped.
// float32: the sum of the three E_i z_i, aligned to the largest; times the reciprocal; with the offset, if there is one,
// as a word; rounded to 24 bits and clamped. Both share the first multipliers.
//
// Registers are loaded only for a quad that has depth, and only those that its kind of format needs.

module barycentric_sample
  import raster_pkg::*;
  import depth_pkg::*;
  import square_pkg::*;
#(
  /// Pixels of triangles that are drawn by squares: 0 none are, 1 outer, 2 inner.
  parameter int unsigned Conservative = Centres
) (
  input  logic                      clk_i,

  // What all samples of a beat share comes from depth_barycentric; the number is that of the stage that it is for.
  // Bit i of float_i: the beat in stage i + 1 is float32.
  input  logic [12:0]               float_i,

  // Stage 1: this sample is to be computed; unbiased E of edges 1 and 2 at the first sample of its quad, and how much
  // more they are at this one.
  input  logic                      valid_i,
  input  edge_t                     corner1_i,
  input  edge_t                     corner2_i,
  input  edge_t                     step1_i,
  input  edge_t                     step2_i,

  // Stage 2: 2A; how much more E of edge 1, of edge 2 and their sum are than at the pixel's centre. Only with
  // Conservative.
  input  edge_t                     area2_i,
  input  edge_t                     square1_i,
  input  edge_t                     square2_i,
  input  edge_t                     squares_i,

  // Stage 3: exponent fields of the vertices' depths, 1 for subnormal numbers.
  input  shift_t                    shift3_i,
  input  logic [2:0] [7:0]          exponent_i,

  // Stage 4: the reciprocal of 2A, or the mantissas of the vertices' depths.
  input  logic [2:0] [31:0]         factor_i,

  // Stage 5: z1 - z0, z2 - z0; which of the vertices' depths are negative.
  input  logic signed [31:0]        difference1_i,
  input  logic signed [31:0]        difference2_i,
  input  logic [2:0]                negative_i,

  // Stage 6: z0 on the scale of the terms, with the offset and half a code for the rounding.
  input  logic signed [63:0]        base_i,

  // Stage 7: unorm16 and not unorm24; bits that the vertices' depths have lost.
  input  logic                      unorm16_i,
  input  logic [4:0]                cut_i,
  input  logic [CodeBits-1:0]       min_code7_i,
  input  logic [CodeBits-1:0]       max_code7_i,
  input  shift_t                    shift7_i,

  // Stage 8.
  input  logic [ReciprocalBits-1:0] reciprocal_i,

  // Stages 9 and 10: the offset as a word.
  input  exponent_t                 exponent9_i,
  input  word_t                     offset_i,

  // Stage 13.
  input  logic [CodeBits-1:0]       min_code13_i,
  input  logic [CodeBits-1:0]       max_code13_i,

  // Stage 13. Means nothing where valid_i was low.
  output logic [CodeBits-1:0]       code_o
);

  localparam int unsigned WeightBits = 30;   // fraction bits of a weight
  localparam place_t LeastPlace = {1'b1, {(PlaceBits - 1) {1'b0}}};

  // Stages whose registers are loaded.
  logic [12:0] valid, is_float, is_unorm;
  logic [11:0] valid_q;

  always_ff @(posedge clk_i) begin
    valid_q <= valid[11:0];
  end

  assign valid    = {valid_q, valid_i};
  assign is_float = valid & float_i;
  assign is_unorm = valid & ~float_i;

  // 1: unbiased E at the sample.
  edge_t edge1_q, edge2_q;

  always_ff @(posedge clk_i) begin
    if (valid[0]) begin
      edge1_q <= corner1_i + step1_i;
      edge2_q <= corner2_i + step2_i;
    end
  end

  // 2: the three weights' numerators.
  typedef struct packed {
    edge_t w0;
    edge_t w1;
    edge_t w2;
  } weights_t;

  weights_t weights_q;

  // The weight of vertex 1 cut to [0, 2A], that of vertex 2 to [0, what that leaves]. Vertex 0 has the rest.
  function automatic weights_t cut(edge_t area2, weights_t w);
    edge_t left1, left2; // what the weight of vertex 1, or of vertex 2, leaves
    left1 = area2 - w.w1;
    left2 = area2 - w.w2;
    if (w.w1[EdgeBits-1]) begin
      return w.w2[EdgeBits-1]    ? '{w0: area2, w1: '0, w2: '0}
             : left2[EdgeBits-1] ? '{w0: '0, w1: '0, w2: area2}
                                 : '{w0: left2, w1: '0, w2: w.w2};
    end
    if (left1[EdgeBits-1]) begin
      return '{w0: '0, w1: area2, w2: '0};
    end
    return w.w2[EdgeBits-1]   ? '{w0: left1, w1: w.w1, w2: '0}
           : w.w0[EdgeBits-1] ? '{w0: '0, w1: w.w1, w2: left1}
                              : w;
  endfunction

  if (Conservative == Centres) begin : gen_centres
    always_ff @(posedge clk_i) begin
      if (valid[1]) begin
        weights_q.w0 <= area2_i - edge1_q - edge2_q;
        weights_q.w1 <= edge1_q;
        weights_q.w2 <= edge2_q;
      end
    end

    logic unused_squares;
    assign unused_squares = ^{square1_i, square2_i, squares_i};
  end else begin : gen_squares
    always_ff @(posedge clk_i) begin
      if (valid[1]) begin
        automatic weights_t centre = '{
          w0: area2_i - edge1_q - edge2_q + squares_i,
          w1: edge1_q - square1_i,
          w2: edge2_q - square2_i
        };
        weights_q <= Conservative == Outer ? cut(area2_i, centre) : centre;
      end
    end
  end

  // 3: on the scale of the 32-bit 2A for unorm; with their top bit at bit 31 for float32. Exponents are of E_i z_i.
  logic [31:0] operand0_q, operand1_q, operand2_q;
  place_t      exponent3_0_q, exponent3_1_q, exponent3_2_q;

  function automatic logic [31:0] scaled(edge_t weight, shift_t shift);
    logic [63:0] value;
    logic [5:0]  left, right;
    value = 64'(weight);
    right = shift;
    left  = -shift;
    return shift[ShiftBits-1] ? 32'(value << left) : 32'(value >> right);
  endfunction
  function automatic place_t product_exponent(logic [5:0] zeros, logic [7:0] exponent);
    return place_t'(32 - 150) - place_t'($signed({1'b0, zeros}))
           + place_t'($signed({1'b0, exponent}));
  endfunction

  always_ff @(posedge clk_i) begin
    if (is_unorm[2]) begin
      // The first is not needed: z0 is added with weight 1.
      operand1_q <= scaled(weights_q.w1, shift3_i);
      operand2_q <= scaled(weights_q.w2, shift3_i);
    end
    if (is_float[2]) begin
      automatic normalized_t normal0 = normalize(64'(weights_q.w0));
      automatic normalized_t normal1 = normalize(64'(weights_q.w1));
      automatic normalized_t normal2 = normalize(64'(weights_q.w2));
      operand0_q    <= normal0.value[63:32];
      operand1_q    <= normal1.value[63:32];
      operand2_q    <= normal2.value[63:32];
      exponent3_0_q <= product_exponent(normal0.zeros, exponent_i[0]);
      exponent3_1_q <= product_exponent(normal1.zeros, exponent_i[1]);
      exponent3_2_q <= product_exponent(normal2.zeros, exponent_i[2]);
    end
  end

  // 4: weights, or products with the mantissas and the largest of their exponents.
  logic [63:0] product0_q, product1_q, product2_q;
  place_t      exponent4_0_q, exponent4_1_q, exponent4_2_q, top4_q;

  // Products that are 0 have no say in the scale.
  function automatic place_t larger(place_t top, logic [31:0] operand, logic [31:0] factor,
                                    place_t exponent);
    return operand != '0 && factor != '0 && exponent > top ? exponent : top;
  endfunction

  always_ff @(posedge clk_i) begin
    if (valid[3]) begin
      product1_q <= operand1_q * factor_i[1];
      product2_q <= operand2_q * factor_i[2];
    end
    if (is_float[3]) begin
      automatic place_t top0 = larger(LeastPlace, operand0_q, factor_i[0], exponent3_0_q);
      automatic place_t top1 = larger(top0, operand1_q, factor_i[1], exponent3_1_q);
      top4_q        <= larger(top1, operand2_q, factor_i[2], exponent3_2_q);
      product0_q    <= operand0_q * factor_i[0];
      exponent4_0_q <= exponent3_0_q;
      exponent4_1_q <= exponent3_1_q;
      exponent4_2_q <= exponent3_2_q;
    end
  end

  // 5: unorm terms; float32 products on the scale of the largest. 6: their sums.
  logic signed [63:0] term0_q, term1_q, term2_q;
  logic signed [63:0] sum_q;
  place_t             top5_q, top6_q;

  function automatic logic signed [63:0] term(logic [WeightBits:0] weight,
                                              logic signed [31:0] difference);
    return $signed({33'b0, weight}) * 64'(difference);
  endfunction
  function automatic logic signed [63:0] aligned(logic [63:0] product, logic negative,
                                                 place_t exponent, place_t top);
    logic [PlaceBits-1:0] shift;
    logic signed [63:0]   moved;
    shift = top - exponent;
    moved = shift < 64 ? product >> shift[5:0] : '0;
    return negative ? -moved : moved;
  endfunction

  always_ff @(posedge clk_i) begin
    if (is_unorm[4]) begin
      term1_q <= term(product1_q[63:63-WeightBits], difference1_i);
      term2_q <= term(product2_q[63:63-WeightBits], difference2_i);
    end
    if (is_float[4]) begin
      term0_q <= aligned(product0_q, negative_i[0], exponent4_0_q, top4_q);
      term1_q <= aligned(product1_q, negative_i[1], exponent4_1_q, top4_q);
      term2_q <= aligned(product2_q, negative_i[2], exponent4_2_q, top4_q);
      top5_q  <= top4_q;
    end
  end

  always_ff @(posedge clk_i) begin
    if (valid[5]) begin
      sum_q <= (is_float[5] ? term0_q : base_i) + term1_q + term2_q;
    end
    if (is_float[5]) begin
      top6_q <= top5_q;
    end
  end

  // 7: the unorm code; the magnitude of the float32 sum with its top bit at bit 31.
  logic [CodeBits-1:0] unorm7_q, unorm8_q, unorm9_q, unorm10_q, unorm11_q, code_q;
  logic [31:0]         mantissa_q;
  place_t              place7_q, place8_q, place9_q, place10_q, place11_q;
  logic                negative7_q, negative8_q;

  function automatic logic [CodeBits-1:0] clamped(logic signed [63:0] code,
                                                  logic [CodeBits-1:0] low,
                                                  logic [CodeBits-1:0] high);
    if (code < $signed({32'b0, low})) begin
      return low;
    end
    return code > $signed({32'b0, high}) ? high : code[31:0];
  endfunction

  always_ff @(posedge clk_i) begin
    if (is_unorm[6]) begin
      unorm7_q <= clamped(sum_q >>> ((unorm16_i ? 6'd45 : 6'd37) - 6'(cut_i)),
                          min_code7_i, max_code7_i);
    end
    if (is_float[6]) begin
      automatic normalized_t normal = normalize(sum_q[63] ? -sum_q : sum_q);
      mantissa_q  <= normal.value[63:32];
      negative7_q <= sum_q[63];
      place7_q    <= top6_q + place_t'(32 - 63) - place_t'($signed({1'b0, normal.zeros}))
                     - place_t'(shift7_i);
    end
  end

  // 8: divided by 2A. Both factors have their top bit set, or are 0.
  logic [63:0] quotient_q;

  always_ff @(posedge clk_i) begin
    if (is_unorm[7]) begin
      unorm8_q <= unorm7_q;
    end
    if (is_float[7]) begin
      quotient_q  <= mantissa_q * reciprocal_i;
      negative8_q <= negative7_q;
      place8_q    <= place7_q;
    end
  end

  // 9: as a word, and as it is, 0 if negative.
  logic [63:0] depth9_q;
  word_t       word_q;
  place_t      to_word, word_place, word_place_q;

  assign word_place = place_t'(exponent9_i) - place_t'(63);
  assign to_word    = word_place - place8_q;

  always_ff @(posedge clk_i) begin
    if (is_unorm[8]) begin
      unorm9_q <= unorm8_q;
    end
    if (is_float[8]) begin
      automatic word_t word = to_word < place_t'(64) ? word_t'(quotient_q >> to_word[5:0]) : '0;
      word_q       <= negative8_q ? -word : word;
      word_place_q <= word_place;
      depth9_q     <= negative8_q ? '0 : quotient_q;
      place9_q     <= place8_q;
    end
  end

  // 10: with the offset, if there is one.
  logic [63:0]              depth10_q;
  logic signed [WordBits:0] moved;
  assign moved = (WordBits + 1)'(word_q) + (WordBits + 1)'(offset_i);

  always_ff @(posedge clk_i) begin
    if (is_unorm[9]) begin
      unorm10_q <= unorm9_q;
    end
    if (is_float[9]) begin
      if (offset_i != '0) begin
        depth10_q <= moved[WordBits] ? '0 : moved[WordBits-1:0];
        place10_q <= word_place_q;
      end else begin
        depth10_q <= depth9_q;
        place10_q <= place9_q;
      end
    end
  end

  // 11: with its top bit at bit 63.
  logic [63:0] depth11_q;

  always_ff @(posedge clk_i) begin
    if (is_unorm[10]) begin
      unorm11_q <= unorm10_q;
    end
    if (is_float[10]) begin
      automatic normalized_t normal = normalize(depth10_q);
      depth11_q <= normal.value;
      place11_q <= place10_q - place_t'($signed({1'b0, normal.zeros}));
    end
  end

  // 12: the nearest float. 13: kept within the range.
  always_ff @(posedge clk_i) begin
    if (valid[11]) begin
      code_q <= is_float[11] ? rounded_float(depth11_q, rounding_of(place11_q)) : unorm11_q;
    end
  end

  assign code_o = code_q < min_code13_i ? min_code13_i
                  : code_q > max_code13_i ? max_code13_i : code_q;

  logic unused_valid;
  assign unused_valid = ^{is_float[12], is_float[1:0], is_unorm[12:11], is_unorm[5], is_unorm[3],
                          is_unorm[1:0]};

endmodule
