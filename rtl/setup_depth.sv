// What the depths of a triangle are together: the range of its stored codes, the power of two above them all, and its
// polygon offset; bit for bit those of model/halfspace/units/depth_interpolator.cpp.
//
// Eight registers, one triangle a cycle: the extremes; the power of two; the depths and the offset as words; sums with
// the offset; normalized; where to round; codes; limits. What a register takes is a function of the one before, called where
// it loads: a simulator then computes nothing where nothing is valid.

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

  // Bit i: register i holds a triangle.
  logic [8:1] valid_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      valid_q <= '0;
    end else begin
      valid_q <= {valid_q[7:1], valid_i};
    end
  end

  assign valid_o = valid_q[8];

  // First register: which depths are the least and the greatest.
  typedef struct packed {
    draw_t               draw;
    vertex_depth_t [2:0] z;
    vertex_depth_t       offset;
    logic [1:0]          min_index;
    logic [1:0]          max_index;
    logic [7:0]          field; // the largest exponent field
  } extremes_t;

  extremes_t extremes_q;

  // Orders depths: float32 are a sign and a magnitude.
  function automatic vertex_depth_t order(vertex_depth_t z, logic is_float);
    vertex_depth_t magnitude;
    magnitude = vertex_depth_t'({1'b0, z[30:0]});
    return !is_float ? z : z[31] ? -magnitude : magnitude;
  endfunction

  function automatic extremes_t extremes_of(draw_t draw, vertex_depth_t [2:0] z,
                                            vertex_depth_t offset);
    vertex_depth_t [2:0] ordered;
    logic                less10, less20, less21;
    extremes_t           extremes;
    for (int unsigned i = 0; i < 3; i++) begin
      ordered[i] = order(z[i], draw.is_float);
    end
    less10   = $signed(ordered[1]) < $signed(ordered[0]);
    less20   = $signed(ordered[2]) < $signed(ordered[0]);
    less21   = $signed(ordered[2]) < $signed(ordered[1]);
    extremes = '{
      draw:      draw,
      z:         z,
      offset:    offset,
      min_index: less20 && less21 ? 2'd2 : less10 ? 2'd1 : 2'd0,
      max_index: !less20 && !less21 ? 2'd2 : !less10 ? 2'd1 : 2'd0,
      field:     exponent_of(offset[30:23])
    };
    for (int unsigned i = 0; i < 3; i++) begin
      if (exponent_of(z[i][30:23]) > extremes.field) begin
        extremes.field = exponent_of(z[i][30:23]);
      end
    end
    return extremes;
  endfunction

  draw_t draw;
  assign draw = '{
    has_depth:  format_i != '0,
    is_float:   format_i == Float32,
    is_unorm16: format_i == Unorm16,
    least_code: least_code_i,
    most_code:  most_code_i
  };

  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      extremes_q <= extremes_of(draw, z_i, offset_i);
    end
  end

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

  scale_t scale_q;

  function automatic logic [VertexDepthBits-1:0] magnitude_of(vertex_depth_t z);
    return z[VertexDepthBits-1] ? -z : z;
  endfunction
  function automatic down_t down_from(logic [7:0] most, logic [7:0] field);
    return most - exponent_of(field);
  endfunction

  function automatic scale_t scale_of(extremes_t from);
    logic [VertexDepthBits-1:0] magnitude;
    scale_t                     scale;
    magnitude = magnitude_of(from.offset);
    scale     = '{
      draw:        from.draw,
      z:           from.z,
      offset:      from.offset,
      min_index:   from.min_index,
      max_index:   from.max_index,
      beyond:      1'b0,
      exponent:    '0,
      down:        '0,
      offset_down: down_from(from.field, from.offset[30:23]),
      left:        6'd32
    };
    for (int unsigned i = 0; i < 3; i++) begin
      magnitude     |= magnitude_of(from.z[i]);
      scale.down[i]  = down_from(from.field, from.z[i][30:23]);
    end
    if (from.draw.is_float) begin
      scale.exponent = exponent_t'({1'b0, from.field}) - exponent_t'(126);
    end else begin
      for (int unsigned i = 0; i < 3; i++) begin
        scale.beyond |= from.z[i][VertexDepthBits-1:UnitBits] != '0 || &from.z[i][UnitBits-1:6];
      end
      for (int unsigned i = UnitBits; i < VertexDepthBits; i++) begin
        if (magnitude[i]) begin
          scale.exponent = exponent_t'(i + 1 - UnitBits);
          scale.left     = 6'(32 - (i + 1 - UnitBits));
        end
      end
      if (!scale.beyond) begin
        scale.left = 6'd32;
      end
    end
    return scale;
  endfunction

  always_ff @(posedge clk_i) begin
    if (valid_q[1]) begin
      scale_q <= scale_of(extremes_q);
    end
  end

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

  words_t words_q;

  function automatic words_t words_of(scale_t from);
    words_t words;
    words = '{
      draw:      from.draw,
      z:         '0,
      z_min:     from.z[from.min_index],
      z_max:     from.z[from.max_index],
      min_index: from.min_index,
      max_index: from.max_index,
      offset:    word_t'(from.offset),
      beyond:    from.beyond,
      exponent:  from.exponent
    };
    if (from.draw.is_float) begin
      words.offset = word_of_float(from.offset[CodeBits-1:0], from.offset_down);
    end
    for (int unsigned i = 0; i < 3; i++) begin
      if (!from.draw.has_depth) begin
        words.z[i] = '0;
      end else if (from.draw.is_float) begin
        words.z[i] = word_of_float(from.z[i][CodeBits-1:0], from.down[i]);
      end else begin
        words.z[i] = word_t'(from.z[i]) <<< from.left;
      end
    end
    return words;
  endfunction

  always_ff @(posedge clk_i) begin
    if (valid_q[2]) begin
      words_q <= words_of(scale_q);
    end
  end

  assign words_o = words_q.z;
  assign short_o = !words_q.draw.is_float && !words_q.beyond;

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

  sums_t sums_q;

  function automatic logic [CodeBits-1:0] code_of(logic [CodeBits-1:0] bits);
    return bits[31] ? '0 : bits;
  endfunction

  function automatic sums_t sums_of(words_t from);
    word_t least_word, most_word; // of unorm surfaces as they are
    least_word = from.draw.is_float ? from.z[from.min_index] : word_t'(from.z_min);
    most_word  = from.draw.is_float ? from.z[from.max_index] : word_t'(from.z_max);
    return '{
      draw:     from.draw,
      low:      sum_t'(least_word) + sum_t'(from.offset),
      high:     sum_t'(most_word) + sum_t'(from.offset),
      moved:    !from.draw.is_float || from.offset != '0,
      min_code: code_of(from.z_min[CodeBits-1:0]),
      max_code: code_of(from.z_max[CodeBits-1:0]),
      word:     !from.draw.is_float && !from.beyond ? from.z[0] >>> ShortBits : from.z[0],
      offset:   from.offset,
      beyond:   from.beyond,
      exponent: from.exponent
    };
  endfunction

  always_ff @(posedge clk_i) begin
    if (valid_q[3]) begin
      sums_q <= sums_of(words_q);
    end
  end

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

  codes_t codes_q;

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

  function automatic codes_t codes_of(sums_t from);
    codes_t codes;
    codes = '{
      draw:     from.draw,
      low:      normalize_sum(from.low),
      high:     normalize_sum(from.high),
      moved:    from.moved,
      min_code: from.min_code,
      max_code: from.max_code,
      word:     from.word,
      offset:   from.offset,
      beyond:   from.beyond,
      exponent: from.exponent
    };
    if (!from.draw.is_float) begin
      codes.min_code = unorm_code(from.low, from.draw.is_unorm16);
      codes.max_code = unorm_code(from.high, from.draw.is_unorm16);
    end
    return codes;
  endfunction

  always_ff @(posedge clk_i) begin
    if (valid_q[4]) begin
      codes_q <= codes_of(sums_q);
    end
  end

  // Sixth register: where float32 sums are rounded.
  typedef struct packed {
    codes_t    codes;
    rounding_t low;
    rounding_t high;
  } rounding_step_t;

  rounding_step_t rounding_q;

  function automatic rounding_t float_rounding(logic [5:0] zeros, exponent_t exponent);
    return rounding_of(place_t'(exponent) - place_t'(63) - place_t'($signed({1'b0, zeros})));
  endfunction

  always_ff @(posedge clk_i) begin
    if (valid_q[5]) begin
      rounding_q <= '{
        codes: codes_q,
        low:   float_rounding(codes_q.low.zeros, codes_q.exponent),
        high:  float_rounding(codes_q.high.zeros, codes_q.exponent)
      };
    end
  end

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

  range_t rounded_q;

  function automatic range_t rounded_of(rounding_step_t from);
    codes_t codes;
    range_t rounded;
    codes   = from.codes;
    rounded = '0;
    if (codes.draw.has_depth) begin
      rounded = '{
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
        rounded.min_code = rounded_float(codes.low.value, from.low);
        rounded.max_code = rounded_float(codes.high.value, from.high);
      end
    end
    return rounded;
  endfunction

  always_ff @(posedge clk_i) begin
    if (valid_q[6]) begin
      rounded_q <= rounded_of(rounding_q);
    end
  end

  // Eighth register: both codes within the limits.
  range_t range_q;

  function automatic logic [CodeBits-1:0] limited(logic [CodeBits-1:0] code,
                                                  logic [CodeBits-1:0] least,
                                                  logic [CodeBits-1:0] most);
    return code < least ? least : code > most ? most : code;
  endfunction

  always_ff @(posedge clk_i) begin
    if (valid_q[7]) begin
      range_q          <= rounded_q;
      range_q.min_code <= limited(rounded_q.min_code, rounded_q.least_code, rounded_q.most_code);
      range_q.max_code <= limited(rounded_q.max_code, rounded_q.least_code, rounded_q.most_code);
    end
  end

  assign word_o     = range_q.word;
  assign beyond_o   = range_q.beyond;
  assign exponent_o = range_q.exponent;
  assign offset_o   = range_q.offset;
  assign min_code_o = range_q.min_code;
  assign max_code_o = range_q.max_code;

  logic unused_limits;
  assign unused_limits = ^{range_q.least_code, range_q.most_code};

endmodule
