// Depth at the samples of a beat by the plane modulo a power of two: products for the tile, additions for the samples.
//
// Stages: 1 the way from vertex 0; 2 products, and the steps for a pixel; 3 their sum; 4 the tile's origin, multiples of
// the steps; 5 all columns and rows of the tile; 6 to 9 plane_sample. Eight registers, and one at the end, so latency is 9
// cycles; a beat a cycle; nothing stalls.

module depth_plane
  import raster_pkg::*;
  import depth_pkg::*;
#(
  /// Quads of a beat, 1 or more.
  parameter int unsigned Quads = TestWidth
) (
  input  logic                                  clk_i,

  /// Without it the codes mean nothing, and next to nothing toggles.
  input  logic                                  valid_i,
  input  logic [FormatBits-1:0]                 format_i,
  input  depth_equation_t                       equation_i,
  input  logic [TileCoordBits-1:0]              tile_x_i,
  input  logic [TileCoordBits-1:0]              tile_y_i,
  input  logic [Quads-1:0] [QuadIndexBits-1:0]  index_i,
  /// Codes of other samples mean nothing.
  input  logic [Quads-1:0] [QuadMaskBits-1:0]   mask_i,

  /// Four samples a quad, in the order of its mask. 0 where the format is none.
  output logic [4*Quads-1:0] [CodeBits-1:0]     code_o
);

  localparam int unsigned Stages = 9;
  localparam int unsigned QuadLog2 = TileLog2 - 1;
  localparam logic [FormatBits-1:0] Unorm16 = 1;
  localparam logic [FormatBits-1:0] Float32 = 4;

  typedef logic [GradientBits-1:0] gradient_t;
  typedef logic [WordBits-1:0] modular_t;

  // What goes along; element i belongs to the beat in stage i + 1.
  typedef struct packed {
    logic                has_depth;
    logic                is_float;
    logic                is_unorm16;
    logic                beyond;
    exponent_t           exponent;
    word_t               offset;
    logic [CodeBits-1:0] min_code;
    logic [CodeBits-1:0] max_code;
  } along_t;

  logic [Stages-1:0]   valid;
  logic [Stages-2:0]   valid_q;
  along_t [Stages-1:0] along;
  along_t [Stages-2:0] along_q;

  assign valid = {valid_q, valid_i};
  assign along = {along_q, along_t'{
    has_depth:  format_i != '0,
    is_float:   format_i == Float32,
    is_unorm16: format_i == Unorm16,
    beyond:     equation_i.beyond,
    exponent:   equation_i.exponent,
    offset:     equation_i.offset,
    min_code:   equation_i.min_code,
    max_code:   equation_i.max_code
  }};

  always_ff @(posedge clk_i) begin
    valid_q <= valid[Stages-2:0];
    for (int unsigned i = 0; i < Stages - 1; i++) begin
      if (valid[i]) begin
        along_q[i] <= along[i];
      end
    end
  end

  // 1: from vertex 0 to the centre of the first pixel of the square that additions start from. It is the same for all
  // sizes of tiles; the tile's place in it follows in stage 4.
  localparam int unsigned AnchorLog2 = 4;

  typedef logic [AnchorLog2-1:0] place_in_anchor_t;

  step_t            right_q, down_q;
  place_in_anchor_t x1_q, y1_q, x2_q, y2_q, x3_q, y3_q;
  gradient_t dx1_q, dy1_q;
  word_t     word1_q, word2_q;

  function automatic logic [PixelBits-1:0] first_pixel(logic [TileCoordBits-1:0] tile);
    return {tile, {TileLog2{1'b0}}};
  endfunction
  function automatic step_t centre(logic [PixelBits-AnchorLog2-1:0] anchor);
    return step_t'({1'b0, anchor, {AnchorLog2{1'b0}}, 1'b1, {(SubPixelBits - 1) {1'b0}}});
  endfunction

  logic [PixelBits-1:0] x_first, y_first;
  assign x_first = first_pixel(tile_x_i);
  assign y_first = first_pixel(tile_y_i);

  always_ff @(posedge clk_i) begin
    if (valid[0]) begin
      right_q <= centre(x_first[PixelBits-1:AnchorLog2]) - step_t'(equation_i.x);
      down_q  <= centre(y_first[PixelBits-1:AnchorLog2]) - step_t'(equation_i.y);
      x1_q    <= x_first[AnchorLog2-1:0];
      y1_q    <= y_first[AnchorLog2-1:0];
      dx1_q   <= equation_i.dx;
      dy1_q   <= equation_i.dy;
      word1_q <= equation_i.word;
    end
  end

  // 2: products; the words nearest to the steps for a pixel, which leave the upper bits of gradients alone.
  gradient_t across_q, along_y_q;
  modular_t  dx2_q, dy2_q, dx3_q, dy3_q;

  localparam int unsigned StepFraction = GradientFraction - SubPixelBits;

  function automatic modular_t nearest_step(logic [WordBits+StepFraction-1:0] gradient);
    return modular_t'(gradient >> StepFraction) + modular_t'(gradient[StepFraction-1]);
  endfunction

  always_ff @(posedge clk_i) begin
    if (valid[1]) begin
      across_q  <= dx1_q * gradient_t'(right_q);
      along_y_q <= dy1_q * gradient_t'(down_q);
      dx2_q     <= nearest_step(dx1_q[WordBits+StepFraction-1:0]);
      dy2_q     <= nearest_step(dy1_q[WordBits+StepFraction-1:0]);
      word2_q   <= word1_q;
      x2_q      <= x1_q;
      y2_q      <= y1_q;
    end
  end

  // 3: the word nearest to it.
  modular_t origin_q;

  gradient_t origin;
  assign origin = {word2_q, {GradientFraction{1'b0}}} + across_q + along_y_q;

  always_ff @(posedge clk_i) begin
    if (valid[2]) begin
      origin_q <= modular_t'(origin >> GradientFraction) + modular_t'(origin[GradientFraction-1]);
      x3_q     <= x2_q;
      y3_q     <= y2_q;
      dx3_q    <= dx2_q;
      dy3_q    <= dy2_q;
    end
  end

  // 4 and 5: columns and rows of the tile; the origin is in the rows.
  modular_t [TileSize-1:0] column_q, row_q;
  modular_t                origin4_q, dx4_q;

  function automatic modular_t multiple(modular_t step, int unsigned times);
    modular_t sum;
    sum = '0;
    for (int unsigned bit_number = 0; bit_number < TileLog2; bit_number++) begin
      if (times[bit_number]) begin
        sum += step << bit_number;
      end
    end
    return sum;
  endfunction

  // Of a multiple of the tile's size.
  function automatic modular_t place_in_anchor(modular_t step, place_in_anchor_t times);
    modular_t sum;
    sum = '0;
    for (int unsigned bit_number = TileLog2; bit_number < AnchorLog2; bit_number++) begin
      if (times[bit_number]) begin
        sum += step << bit_number;
      end
    end
    return sum;
  endfunction

  modular_t [TileSize-1:0] down4_q;

  always_ff @(posedge clk_i) begin
    if (valid[3]) begin
      origin4_q <= origin_q + place_in_anchor(dx3_q, x3_q) + place_in_anchor(dy3_q, y3_q);
      dx4_q     <= dx3_q;
      for (int unsigned i = 0; i < TileSize; i++) begin
        down4_q[i] <= multiple(dy3_q, i);
      end
    end
    if (valid[4]) begin
      for (int unsigned i = 0; i < TileSize; i++) begin
        column_q[i] <= multiple(dx4_q, i);
        row_q[i]    <= origin4_q + down4_q[i];
      end
    end
  end

  // For stage 7: the offset, on unorm surfaces with half a code. For stage 8: where a unorm code begins.
  logic                     short_q;
  logic signed [WordBits:0] offset_q;
  logic [5:0]               place7_q, place8_q;

  // Places below a code: 15 or 7 of a vertex depth, and those that a long word has more.
  logic [5:0] more, place;
  assign more  = along[5].beyond ? 6'd32 - 6'(along[5].exponent) : '0;
  assign place = (along[5].is_unorm16 ? 6'd15 : 6'd7) + more;

  always_ff @(posedge clk_i) begin
    if (valid[5]) begin
      short_q  <= !along[5].is_float && !along[5].beyond;
      place7_q <= place;
      offset_q <= along[5].is_float
                  ? (WordBits + 1)'(along[5].offset)
                  : ((WordBits + 1)'(along[5].offset) <<< more) + (65'sd1 <<< (place - 6'd1));
    end
    if (valid[6]) begin
      place8_q <= place7_q;
    end
  end

  // The quads wait for their tile.
  logic [5:0] [Quads-1:0] [QuadIndexBits-1:0] index;
  logic [4:0] [Quads-1:0] [QuadIndexBits-1:0] index_q;
  logic [5:0] [Quads-1:0]                     any;
  logic [4:0] [Quads-1:0]                     any_q;
  logic [Quads-1:0]                           any_in;

  for (genvar q = 0; q < Quads; q++) begin : gen_any
    assign any_in[q] = |mask_i[q];
  end

  assign index = {index_q, index_i};
  assign any   = {any_q, any_in};

  always_ff @(posedge clk_i) begin
    for (int unsigned i = 0; i < 5; i++) begin
      if (valid[i]) begin
        index_q[i] <= index[i];
        any_q[i]   <= any[i];
      end
    end
  end

  logic [4*Quads-1:0] [CodeBits-1:0] code;

  for (genvar q = 0; q < Quads; q++) begin : gen_quad
    logic quad_valid;
    assign quad_valid = valid[5] & along[5].has_depth & any[5][q];
    for (genvar s = 0; s < 4; s++) begin : gen_sample
      plane_sample u_sample (
        .clk_i      (clk_i),
        .valid_i    (quad_valid),
        .column_i   (column_q[{index[5][q][QuadLog2-1:0], 1'(s % 2)}]),
        .row_i      (row_q[{index[5][q][QuadIndexBits-1:QuadLog2], 1'(s / 2)}]),
        .short_i    (short_q),
        .offset_i   (offset_q),
        .float8_i   (along[7].is_float),
        .place_i    (place8_q),
        .float9_i   (along[8].is_float),
        .exponent_i (along[8].exponent),
        .min_code_i (along[8].min_code),
        .max_code_i (along[8].max_code),
        .code_o     (code[4*q+s])
      );
    end
  end

  always_ff @(posedge clk_i) begin
    code_o <= along[8].has_depth ? code : '0;
  end

  logic unused;
  assign unused = ^{valid[8:7], equation_i.a, equation_i.b, equation_i.z, equation_i.bias, equation_i.area2,
                    equation_i.reciprocal, equation_i.shift};

endmodule
