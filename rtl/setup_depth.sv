// What the depths of a triangle are together: the range of its stored codes, the power of two above them all, and its
// polygon offset; bit for bit those of model/halfspace/units/depth_interpolator.cpp.
//
// Eight registers, one triangle a cycle: the extremes; the power of two; the depths and the offset as words; sums with
// the offset; normalized; where to round; codes; limits.

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

  // Eight cycles later; 0 where there is no depth surface. `word_o` is that of vertex 0, as it is.
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

  // First register: which depths are the least and the greatest.
  typedef struct packed {
    draw_t               draw;
    vertex_depth_t [2:0] z;
    vertex_depth_t       offset;
    logic [1:0]          min_index;
    logic [1:0]          max_index;
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

  vertex_depth_t [2:0] ordered;
  logic                is_float, less10, less20, less21;
  assign is_float = format_i == Float32;

  always_comb begin
    for (int unsigned i = 0; i < 3; i++) begin
      ordered[i] = order(z_i[i], is_float);
    end
    less10 = $signed(ordered[1]) < $signed(ordered[0]);
    less20 = $signed(ordered[2]) < $signed(ordered[0]);
    less21 = $signed(ordered[2]) < $signed(ordered[1]);
    extremes_d.draw = '{
      has_depth:  format_i != '0,
      is_float:   is_float,
      is_unorm16: format_i == Unorm16,
      least_code: least_code_i,
      most_code:  most_code_i
    };
    extremes_d.z         = z_i;
    extremes_d.offset    = offset_i;
    extremes_d.min_index = less20 && less21 ? 2'd2 : less10 ? 2'd1 : 2'd0;
    extremes_d.max_index = !less20 && !less21 ? 2'd2 : !less10 ? 2'd1 : 2'd0;
    extremes_d.field     = exponent_of(offset_i[30:23]);
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

  // Second register: the power of two above all of them, which is 1 in their words; how far each is below.
  typedef struct packed {
    draw_t               draw;
    vertex_depth_t [2:0] z;
    vertex_depth_t       offset;
    logic [1:0]          min_index;
    logic [1:0]          max_index;
    logic                beyond;
    exponent_t           exponent;
    down_t [2:0]         down;
    down_t               offset_down;
    logic [5:0]          left;  // unorm
  } scale_t;

  scale_t scale_d, scale_q;
  logic   scale_valid;

  function automatic logic [VertexDepthBits-1:0] magnitude_of(vertex_depth_t z);
    return z[VertexDepthBits-1] ? -z : z;
  endfunction
  function automatic down_t down_from(logic [7:0] most, logic [7:0] field);
    return most - exponent_of(field);
  endfunction

  always_comb begin
    automatic logic [VertexDepthBits-1:0] magnitude;
    magnitude = magnitude_of(extremes_q.offset);
    scale_d   = '{
      draw:        extremes_q.draw,
      z:           extremes_q.z,
      offset:      extremes_q.offset,
      min_index:   extremes_q.min_index,
      max_index:   extremes_q.max_index,
      beyond:      1'b0,
      exponent:    '0,
      down:        '0,
      offset_down: down_from(extremes_q.field, extremes_q.offset[30:23]),
      left:        6'd32
    };
    for (int unsigned i = 0; i < 3; i++) begin
      magnitude       |= magnitude_of(extremes_q.z[i]);
      scale_d.down[i]  = down_from(extremes_q.field, extremes_q.z[i][30:23]);
    end
    if (extremes_q.draw.is_float) begin
      scale_d.exponent = exponent_t'({1'b0, extremes_q.field}) - exponent_t'(126);
    end else begin
      for (int unsigned i = 0; i < 3; i++) begin
        scale_d.beyond |= extremes_q.z[i][VertexDepthBits-1:UnitBits] != '0;
      end
      for (int unsigned i = UnitBits; i < VertexDepthBits; i++) begin
        if (magnitude[i]) begin
          scale_d.exponent = exponent_t'(i + 1 - UnitBits);
          scale_d.left     = 6'(32 - (i + 1 - UnitBits));
        end
      end
      if (!scale_d.beyond) begin
        scale_d.left = 6'd32;
      end
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

  // Third register: as words; the extremes as they are.
  typedef struct packed {
    draw_t               draw;
    word_t [2:0]         z;
    vertex_depth_t       z_min;
    vertex_depth_t       z_max;
    logic [1:0]          min_index;
    logic [1:0]          max_index;
    word_t               offset;
    logic                beyond;
    exponent_t           exponent;
  } words_t;

  words_t words_d, words_q;
  logic   words_valid;

  always_comb begin
    words_d = '{
      draw:      scale_q.draw,
      z:         '0,
      z_min:     scale_q.z[scale_q.min_index],
      z_max:     scale_q.z[scale_q.max_index],
      min_index: scale_q.min_index,
      max_index: scale_q.max_index,
      offset:    word_t'(scale_q.offset),
      beyond:    scale_q.beyond,
      exponent:  scale_q.exponent
    };
    if (scale_q.draw.is_float) begin
      words_d.offset = word_of_float(scale_q.offset[CodeBits-1:0], scale_q.offset_down);
    end
    for (int unsigned i = 0; i < 3; i++) begin
      if (!scale_q.draw.has_depth) begin
        words_d.z[i] = '0;
      end else if (scale_q.draw.is_float) begin
        words_d.z[i] = word_of_float(scale_q.z[i][CodeBits-1:0], scale_q.down[i]);
      end else begin
        words_d.z[i] = word_t'(scale_q.z[i]) <<< scale_q.left;
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

  // Fourth register: with the offset. Unorm sums are far below the word's range.
  typedef logic signed [WordBits:0] sum_t;

  typedef struct packed {
    draw_t               draw;
    sum_t                low;
    sum_t                high;
    logic                moved; // else float32 codes stand as they are: a word may cut them
    logic [CodeBits-1:0] min_code;
    logic [CodeBits-1:0] max_code;
    word_t               word;
    word_t               offset;
    logic                beyond;
    exponent_t           exponent;
  } sums_t;

  sums_t sums_d, sums_q;
  logic  sums_valid;

  function automatic logic [CodeBits-1:0] code_of(logic [CodeBits-1:0] bits);
    return bits[31] ? '0 : bits;
  endfunction

  // Of unorm surfaces as they are.
  word_t least_word, most_word;
  assign least_word = words_q.draw.is_float ? words_q.z[words_q.min_index] : word_t'(words_q.z_min);
  assign most_word  = words_q.draw.is_float ? words_q.z[words_q.max_index] : word_t'(words_q.z_max);

  assign sums_d = '{
    draw:     words_q.draw,
    low:      sum_t'(least_word) + sum_t'(words_q.offset),
    high:     sum_t'(most_word) + sum_t'(words_q.offset),
    moved:    !words_q.draw.is_float || words_q.offset != '0,
    min_code: code_of(words_q.z_min[CodeBits-1:0]),
    max_code: code_of(words_q.z_max[CodeBits-1:0]),
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

  // Fifth register: 0 for what is negative; float32 sums with their top bit at bit 63; unorm codes, which a large sum
  // is beyond.
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

  function automatic logic [CodeBits-1:0] unorm_code(sum_t sum, logic unorm16);
    logic [WordBits-1:0] code;
    code = sum[WordBits-1:0] + (unorm16 ? WordBits'(1 << 14) : WordBits'(1 << 6));
    code = unorm16 ? code >> 15 : code >> 7;
    return sum[WordBits] ? '0 : code >> CodeBits != '0 ? '1 : code[CodeBits-1:0];
  endfunction
  function automatic normalized_t normalize_sum(sum_t sum);
    normalized_t result;
    result = normalize(sum[WordBits-1:0]);
    return sum[WordBits] ? '0 : result;
  endfunction

  always_comb begin
    codes_d = '{
      draw:     sums_q.draw,
      low:      normalize_sum(sums_q.low),
      high:     normalize_sum(sums_q.high),
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

  // Seventh register: the codes.
  typedef struct packed {
    logic [CodeBits-1:0] least_code;
    logic [CodeBits-1:0] most_code;
    word_t               word;
    logic                beyond;
    exponent_t           exponent;
    word_t               offset;
    logic [CodeBits-1:0] min_code;
    logic [CodeBits-1:0] max_code;
  } range_t;

  range_t rounded_d, rounded_q;
  logic   rounded_valid;

  codes_t codes;
  assign codes = rounding_q.codes;

  always_comb begin
    rounded_d = '0;
    if (codes.draw.has_depth) begin
      rounded_d = '{
        least_code: codes.draw.least_code,
        most_code:  codes.draw.most_code,
        word:       codes.word,
        beyond:     codes.beyond,
        exponent:   codes.exponent,
        offset:     codes.offset,
        min_code:   codes.min_code,
        max_code:   codes.max_code
      };
      if (codes.draw.is_float && codes.moved) begin
        rounded_d.min_code = rounded_float(codes.low.value, rounding_q.low);
        rounded_d.max_code = rounded_float(codes.high.value, rounding_q.high);
      end
    end
  end

  pipe_register #(
    .Width ($bits(range_t))
  ) u_rounded (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (rounding_valid),
    .data_i  (rounded_d),
    .valid_o (rounded_valid),
    .data_o  (rounded_q)
  );

  // Eighth register: both codes within the limits.
  range_t range_d, range_q;

  function automatic logic [CodeBits-1:0] limited(logic [CodeBits-1:0] code,
                                                  logic [CodeBits-1:0] least,
                                                  logic [CodeBits-1:0] most);
    return code < least ? least : code > most ? most : code;
  endfunction

  always_comb begin
    range_d          = rounded_q;
    range_d.min_code = limited(rounded_q.min_code, rounded_q.least_code, rounded_q.most_code);
    range_d.max_code = limited(rounded_q.max_code, rounded_q.least_code, rounded_q.most_code);
  end

  pipe_register #(
    .Width ($bits(range_t))
  ) u_range (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (rounded_valid),
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

  logic unused_limits;
  assign unused_limits = ^{range_q.least_code, range_q.most_code};

endmodule
