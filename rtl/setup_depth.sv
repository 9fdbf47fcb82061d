// What the depths of a triangle are together: the range of its stored codes, the power of two above them all, and its
// polygon offset; bit for bit those of model/halfspace/units/depth_interpolator.cpp.
//
// Seven registers, one triangle a cycle: the extremes; the power of two; the extremes and the offset as words; sums with
// the offset; normalized; where to round; codes.

module setup_depth
  import raster_pkg::*;
  import depth_pkg::*;
(
  input  logic                  clk_i,
  input  logic                  rst_ni,

  input  logic                  valid_i,
  input  vertex_depth_t [2:0]   z_i,
  input  vertex_depth_t         offset_i,
  input  logic [FormatBits-1:0] format_i,
  input  logic [CodeBits-1:0]   least_code_i,
  input  logic [CodeBits-1:0]   most_code_i,

  // Three cycles later: the vertices' depths as words, unorm depths in [0, 1] as they are but for a place 32 bits higher.
  output word_t [2:0]           words_o,
  output logic                  short_o,

  // Seven cycles later; 0 where there is no depth surface. `word_o` is that of vertex 0, as it is.
  output logic                  valid_o,
  output word_t                 word_o,
  output logic                  beyond_o,
  output exponent_t             exponent_o,
  output word_t                 offset_o,
  output logic [CodeBits-1:0]   min_code_o,
  output logic [CodeBits-1:0]   max_code_o
);

  localparam logic [FormatBits-1:0] Unorm16 = 1;
  localparam logic [FormatBits-1:0] Float32 = 4;
  localparam int unsigned UnitBits = 31; // bits of a unorm vertex depth below 1

  // What goes all the way.
  typedef struct packed {
    logic                has_depth;
    logic                is_float;
    logic                is_unorm16;
    logic [CodeBits-1:0] least_code;
    logic [CodeBits-1:0] most_code;
  } draw_t;

  // First register: the least and the greatest depth.
  typedef struct packed {
    draw_t               draw;
    vertex_depth_t [2:0] z;
    vertex_depth_t       z_min;
    vertex_depth_t       z_max;
    vertex_depth_t       offset;
    logic [7:0]          field; // the largest exponent field
  } extremes_t;

  extremes_t extremes_d, extremes_q;
  logic      extremes_valid;

  // Orders depths: float32 are a sign and a magnitude.
  function automatic vertex_depth_t order(vertex_depth_t z, logic is_float);
    vertex_depth_t magnitude;
    magnitude = vertex_depth_t'({1'b0, z[30:0]});
    return !is_float ? z : z[31] ? -magnitude : magnitude;
  endfunction

  logic is_float;
  assign is_float = format_i == Float32;

  always_comb begin
    extremes_d.draw = '{
      has_depth:  format_i != '0,
      is_float:   is_float,
      is_unorm16: format_i == Unorm16,
      least_code: least_code_i,
      most_code:  most_code_i
    };
    extremes_d.z      = z_i;
    extremes_d.z_min  = z_i[0];
    extremes_d.z_max  = z_i[0];
    extremes_d.offset = offset_i;
    extremes_d.field  = exponent_of(offset_i[30:23]);
    for (int unsigned i = 1; i < 3; i++) begin
      if (order(z_i[i], is_float) < order(extremes_d.z_min, is_float)) begin
        extremes_d.z_min = z_i[i];
      end
      if (order(z_i[i], is_float) > order(extremes_d.z_max, is_float)) begin
        extremes_d.z_max = z_i[i];
      end
    end
    for (int unsigned i = 0; i < 3; i++) begin
      if (exponent_of(z_i[i][30:23]) > extremes_d.field) begin
        extremes_d.field = exponent_of(z_i[i][30:23]);
      end
    end
  end

  pipe_register #(
    .Width ($bits(extremes_t))
  ) u_extremes (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (valid_i),
    .data_i  (extremes_d),
    .valid_o (extremes_valid),
    .data_o  (extremes_q)
  );

  // Second register: the power of two above all of them, which is 1 in their words.
  typedef struct packed {
    extremes_t extremes;
    logic      beyond;
    exponent_t exponent;
  } scale_t;

  scale_t scale_d, scale_q;
  logic   scale_valid;

  function automatic logic [VertexDepthBits-1:0] magnitude_of(vertex_depth_t z);
    return z[VertexDepthBits-1] ? -z : z;
  endfunction

  always_comb begin
    automatic logic [VertexDepthBits-1:0] magnitude;
    magnitude = magnitude_of(extremes_q.z_min) | magnitude_of(extremes_q.z_max)
                | magnitude_of(extremes_q.offset);
    scale_d   = '{
      extremes: extremes_q,
      beyond:   extremes_q.z_min[VertexDepthBits-1] || extremes_q.z_max >>> UnitBits != '0,
      exponent: '0
    };
    for (int unsigned i = UnitBits; i < VertexDepthBits; i++) begin
      if (magnitude[i]) begin
        scale_d.exponent = exponent_t'(i + 1 - UnitBits);
      end
    end
    if (extremes_q.draw.is_float) begin
      scale_d.beyond   = 1'b0;
      scale_d.exponent = exponent_t'({1'b0, extremes_q.field}) - exponent_t'(126);
    end
  end

  pipe_register #(
    .Width ($bits(scale_t))
  ) u_scale (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (extremes_valid),
    .data_i  (scale_d),
    .valid_o (scale_valid),
    .data_o  (scale_q)
  );

  // Third register: as words. On unorm surfaces all but `z` are the depths as they are.
  typedef struct packed {
    draw_t               draw;
    word_t [2:0]         z;
    word_t               z_min;
    word_t               z_max;
    word_t               offset;
    logic [CodeBits-1:0] min_code; // float32 without an offset: a word may have to cut the depth
    logic [CodeBits-1:0] max_code;
    logic                beyond;
    exponent_t           exponent;
  } words_t;

  extremes_t from;
  words_t    words_d, words_q;
  logic      words_valid;

  assign from = scale_q.extremes;

  logic unused_field;
  assign unused_field = ^from.field;

  always_comb begin
    words_d = '{
      draw:     from.draw,
      z:        '0,
      z_min:    word_t'(from.z_min),
      z_max:    word_t'(from.z_max),
      offset:   word_t'(from.offset),
      min_code: from.z_min[31] ? '0 : from.z_min[CodeBits-1:0],
      max_code: from.z_max[31] ? '0 : from.z_max[CodeBits-1:0],
      beyond:   scale_q.beyond,
      exponent: scale_q.exponent
    };
    if (from.draw.is_float) begin
      words_d.z_min  = word_of_float(from.z_min[CodeBits-1:0], scale_q.exponent);
      words_d.z_max  = word_of_float(from.z_max[CodeBits-1:0], scale_q.exponent);
      words_d.offset = word_of_float(from.offset[CodeBits-1:0], scale_q.exponent);
    end
    for (int unsigned i = 0; i < 3; i++) begin
      if (!from.draw.has_depth) begin
        words_d.z[i] = '0;
      end else if (from.draw.is_float) begin
        words_d.z[i] = word_of_float(from.z[i][CodeBits-1:0], scale_q.exponent);
      end else begin
        words_d.z[i] = word_t'(from.z[i])
                       <<< (6'd32 - (scale_q.beyond ? 6'(scale_q.exponent) : 6'd0));
      end
    end
  end

  assign words_o = words_q.z;
  assign short_o = !words_q.draw.is_float && !words_q.beyond;

  pipe_register #(
    .Width ($bits(words_t))
  ) u_words (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (scale_valid),
    .data_i  (words_d),
    .valid_o (words_valid),
    .data_o  (words_q)
  );

  // Fourth register: with the offset. What is negative is 0; unorm sums are far below the word's range.
  typedef struct packed {
    draw_t               draw;
    logic [WordBits-1:0] low;
    logic [WordBits-1:0] high;
    logic                moved; // else there is no offset, and the codes stand as they are
    logic [CodeBits-1:0] min_code;
    logic [CodeBits-1:0] max_code;
    word_t               word;
    word_t               offset;
    logic                beyond;
    exponent_t           exponent;
  } sums_t;

  sums_t sums_d, sums_q;
  logic  sums_valid;

  function automatic logic [WordBits-1:0] sum_of(word_t z, word_t offset);
    logic signed [WordBits:0] sum;
    sum = (WordBits + 1)'(z) + (WordBits + 1)'(offset);
    return sum[WordBits] ? '0 : sum[WordBits-1:0];
  endfunction

  assign sums_d = '{
    draw:     words_q.draw,
    low:      sum_of(words_q.z_min, words_q.offset),
    high:     sum_of(words_q.z_max, words_q.offset),
    moved:    !words_q.draw.is_float || words_q.offset != '0,
    min_code: words_q.min_code,
    max_code: words_q.max_code,
    word:     short_o ? words_q.z[0] >>> ShortBits : words_q.z[0],
    offset:   words_q.offset,
    beyond:   words_q.beyond,
    exponent: words_q.exponent
  };

  pipe_register #(
    .Width ($bits(sums_t))
  ) u_sums (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (words_valid),
    .data_i  (sums_d),
    .valid_o (sums_valid),
    .data_o  (sums_q)
  );

  // Fifth register: float32 sums with their top bit at bit 63; unorm codes, which a large sum is beyond.
  typedef struct packed {
    draw_t               draw;
    normalized_t         low;
    normalized_t         high;
    logic                moved;
    logic [CodeBits-1:0] min_code;
    logic [CodeBits-1:0] max_code;
    word_t               word;
    word_t               offset;
    logic                beyond;
    exponent_t           exponent;
  } codes_t;

  codes_t codes_d, codes_q;

  function automatic logic [CodeBits-1:0] unorm_code(logic [WordBits-1:0] sum, logic unorm16);
    logic [WordBits-1:0] code;
    code = unorm16 ? (sum + WordBits'(1 << 14)) >> 15 : (sum + WordBits'(1 << 6)) >> 7;
    return code >> CodeBits != '0 ? '1 : code[CodeBits-1:0];
  endfunction

  always_comb begin
    codes_d = '{
      draw:     sums_q.draw,
      low:      normalize(sums_q.low),
      high:     normalize(sums_q.high),
      moved:    sums_q.moved,
      min_code: sums_q.min_code,
      max_code: sums_q.max_code,
      word:     sums_q.word,
      offset:   sums_q.offset,
      beyond:   sums_q.beyond,
      exponent: sums_q.exponent
    };
    if (!sums_q.draw.is_float) begin
      codes_d.min_code = unorm_code(sums_q.low, sums_q.draw.is_unorm16);
      codes_d.max_code = unorm_code(sums_q.high, sums_q.draw.is_unorm16);
    end
  end

  logic codes_valid;

  pipe_register #(
    .Width ($bits(codes_t))
  ) u_codes (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (sums_valid),
    .data_i  (codes_d),
    .valid_o (codes_valid),
    .data_o  (codes_q)
  );

  // Sixth register: where float32 sums are rounded.
  typedef struct packed {
    codes_t    codes;
    rounding_t low;
    rounding_t high;
  } rounding_step_t;

  rounding_step_t rounding_d, rounding_q;
  logic           rounding_valid;

  function automatic rounding_t float_rounding(logic [5:0] zeros, exponent_t exponent);
    return rounding_of(place_t'(exponent) - place_t'(63) - place_t'($signed({1'b0, zeros})));
  endfunction

  assign rounding_d = '{
    codes: codes_q,
    low:   float_rounding(codes_q.low.zeros, codes_q.exponent),
    high:  float_rounding(codes_q.high.zeros, codes_q.exponent)
  };

  pipe_register #(
    .Width ($bits(rounding_step_t))
  ) u_rounding (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (codes_valid),
    .data_i  (rounding_d),
    .valid_o (rounding_valid),
    .data_o  (rounding_q)
  );

  // Seventh register: float32 codes, and both kept within the limits.
  typedef struct packed {
    word_t               word;
    logic                beyond;
    exponent_t           exponent;
    word_t               offset;
    logic [CodeBits-1:0] min_code;
    logic [CodeBits-1:0] max_code;
  } range_t;

  range_t range_d, range_q;

  function automatic logic [CodeBits-1:0] limited(logic [CodeBits-1:0] code,
                                                  logic [CodeBits-1:0] least,
                                                  logic [CodeBits-1:0] most);
    return code < least ? least : code > most ? most : code;
  endfunction

  codes_t last;
  assign last = rounding_q.codes;

  always_comb begin
    automatic logic from_sum;
    from_sum = last.draw.is_float && last.moved;
    range_d  = '0;
    if (last.draw.has_depth) begin
      range_d.word     = last.word;
      range_d.beyond   = last.beyond;
      range_d.exponent = last.exponent;
      range_d.offset   = last.offset;
      range_d.min_code = limited(
          from_sum ? rounded_float(last.low.value, rounding_q.low) : last.min_code,
          last.draw.least_code, last.draw.most_code);
      range_d.max_code = limited(
          from_sum ? rounded_float(last.high.value, rounding_q.high) : last.max_code,
          last.draw.least_code, last.draw.most_code);
    end
  end

  pipe_register #(
    .Width ($bits(range_t))
  ) u_range (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (rounding_valid),
    .data_i  (range_d),
    .valid_o (valid_o),
    .data_o  (range_q)
  );

  assign word_o     = range_q.word;
  assign beyond_o   = range_q.beyond;
  assign exponent_o = range_q.exponent;
  assign offset_o   = range_q.offset;
  assign min_code_o = range_q.min_code;
  assign max_code_o = range_q.max_code;

endmodule
