// Depth at one sample by the plane, from stage 8: the stored code of a unorm16, unorm24 or float32 surface, bit for bit
// that of model/halfspace/units/z_test.cpp. Five registers; the last stage is wires.
//
// A column and a row of the tile add up to the word; the offset is added; unorm sums are shifted to codes, float32 sums
// moved up to their top bit and rounded; both are clamped. What a stage computes is written where its register loads, so
// that a simulator skips it where nothing is valid.

module plane_sample
  import raster_pkg::*;
  import depth_pkg::*;
(
  input  logic                clk_i,

  // Stage 8.
  input  logic                valid_i,
  input  logic [WordBits-1:0] column_i,
  input  logic [WordBits-1:0] row_i,

  // Stage 9: short words; the offset with half a code of unorm.
  input  logic                short_i,
  input  logic signed [WordBits:0] offset_i,

  // Stage 10: float32; place of a unorm code's last bit in the sum.
  input  logic                float10_i,
  input  logic [5:0]          place_i,

  // Stage 11.
  input  logic                float11_i,
  input  exponent_t           exponent_i,

  // Stage 12.
  input  logic                float12_i,

  // Stage 13.
  input  logic [CodeBits-1:0] min_code_i,
  input  logic [CodeBits-1:0] max_code_i,

  // Stage 13. Means nothing where valid_i was low.
  output logic [CodeBits-1:0] code_o
);

  logic [3:0] valid_q;

  always_ff @(posedge clk_i) begin
    valid_q <= {valid_q[2:0], valid_i};
  end

  // 8: the word.
  logic [WordBits-1:0] word_q;

  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      word_q <= column_i + row_i;
    end
  end

  // 9: with the offset, 0 if negative.
  typedef logic [WordBits:0] sum_t;

  sum_t sum_q;

  function automatic sum_t offset_sum(logic is_short, logic [WordBits-1:0] modular,
                                      logic signed [WordBits:0] offset);
    logic signed [WordBits-1:0] word;
    logic signed [WordBits+1:0] sum;
    word = is_short ? word_t'($signed(modular[ShortBits-1:0])) : modular;
    sum  = (WordBits + 2)'(word) + (WordBits + 2)'(offset);
    return sum[WordBits+1] ? '0 : sum[WordBits:0];
  endfunction

  always_ff @(posedge clk_i) begin
    if (valid_q[0]) begin
      sum_q <= offset_sum(short_i, word_q, offset_i);
    end
  end

  // 10: a unorm code; a float32 sum with its top bit at bit 63.
  normalized_t         normal_q;
  logic [CodeBits-1:0] unorm_q;

  function automatic logic [CodeBits-1:0] unorm_code(sum_t sum, logic [5:0] place);
    sum_t code;
    code = sum >> place;
    return code[WordBits:CodeBits] != '0 ? '1 : code[CodeBits-1:0];
  endfunction

  always_ff @(posedge clk_i) begin
    if (valid_q[1] && float10_i) begin
      normal_q <= normalize(sum_q[WordBits-1:0]);
    end
    if (valid_q[1] && !float10_i) begin
      unorm_q <= unorm_code(sum_q, place_i);
    end
  end

  // 11: where to round. 12: rounded. 13: kept within the range.
  logic [WordBits-1:0] value_q;
  rounding_t           rounding_q;
  logic [CodeBits-1:0] unorm11_q, code_q;

  always_ff @(posedge clk_i) begin
    if (valid_q[2] && float11_i) begin
      value_q    <= normal_q.value;
      rounding_q <= rounding_of(place_t'(exponent_i) - place_t'(63)
                                - place_t'($signed({1'b0, normal_q.zeros})));
    end
    if (valid_q[2] && !float11_i) begin
      unorm11_q <= unorm_q;
    end
    if (valid_q[3]) begin
      code_q <= float12_i ? rounded_float(value_q, rounding_q) : unorm11_q;
    end
  end

  assign code_o = code_q < min_code_i ? min_code_i : code_q > max_code_i ? max_code_i : code_q;

endmodule
