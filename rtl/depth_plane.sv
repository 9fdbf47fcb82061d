// Depth at the samples of a beat by the plane modulo a power of two: products for the tile, additions for the samples.
//
// Stages: 1 the way from vertex 0; 2 products of its halves, and the steps for a pixel; 3 products; 4 their sum; 5 the
// word of the origin; 6 its place in the square, and multiples of the steps; 7 all columns and rows of the tile; 8 to 12
// plane_sample. Latency is 12 cycles; a beat a cycle; nothing stalls.

module depth_plane
  import raster_pkg::*;
  import depth_pkg::*;
  import sample_pkg::*;
  import sample_box_pkg::*;
#(
  /// Quads of a beat, 1 or more.
  parameter int unsigned Quads = TestWidth
) (
  input  logic                                  clk_i,

  /// Without it the codes mean nothing, and next to nothing toggles.
  input  logic                                  valid_i,
  input  logic [FormatBits-1:0]                 format_i,
  input  depth_equation_t                       equation_i,
  input  logic [TileColumnBits-1:0]             tile_x_i,
  input  logic [TileCoordBits-1:0]              tile_y_i,
  input  logic [Quads-1:0] [QuadIndexBits-1:0]  index_i,
  /// Codes of other samples mean nothing.
  input  logic [Quads-1:0] [QuadMaskBits-1:0]   mask_i,

  /// Four samples a quad, in the order of its mask. 0 where the format is none.
  output logic [4*Quads-1:0] [CodeBits-1:0]     code_o
);

  localparam int unsigned Stages = 12;
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
  along_t              along [Stages] /*verilator split_var*/;

  assign valid    = {valid_q, valid_i};
  assign along[0] = '{
    has_depth:  format_i != '0,
    is_float:   format_i == Float32,
    is_unorm16: format_i == Unorm16,
    beyond:     equation_i.beyond,
    exponent:   equation_i.exponent,
    offset:     equation_i.offset,
    min_code:   equation_i.min_code,
    max_code:   equation_i.max_code
  };

  always_ff @(posedge clk_i) begin
    valid_q <= valid[Stages-2:0];
  end

  for (genvar i = 1; i < Stages; i++) begin : gen_along
    always_ff @(posedge clk_i) begin
      if (valid[i-1]) begin
        along[i] <= along[i-1];
      end
    end
  end

  // 1: from vertex 0 to the sample of the first pixel of the square that additions start from. It is the same for all
  // sizes of tiles; the tile's place in it follows in stage 6.
  localparam int unsigned AnchorLog2 = 4;

  typedef logic [AnchorLog2-1:0] place_in_anchor_t;

  step_t     right_q, down_q;
  gradient_t dx1_q, dy1_q;

  // Registers of stages 1 to 5 of what only goes along.
  word_t [3:1]            word_q;
  place_in_anchor_t [5:1] x_q, y_q;

  function automatic logic [PixelBits-1:0] first_pixel(logic [TileCoordBits-1:0] tile);
    return {tile, {TileLog2{1'b0}}};
  endfunction
  function automatic step_t sample_at(logic [PixelBits-AnchorLog2-1:0] anchor, grid_t in_pixel);
    return step_t'({1'b0, anchor, {AnchorLog2{1'b0}}, sub_pixels(in_pixel)});
  endfunction

  logic [PixelBits-1:0] x_first, y_first;
  assign x_first = first_pixel(TileCoordBits'(tile_x_i >> SampleLog2));
  assign y_first = first_pixel(tile_y_i);

  // The sample of the tile.
  int unsigned sample;
  assign sample = 32'(tile_x_i) & (PixelSamples - 1);

  always_ff @(posedge clk_i) begin
    if (valid[0]) begin
      right_q <= sample_at(x_first[PixelBits-1:AnchorLog2], position(sample, 1'b0))
                 - step_t'(equation_i.x);
      down_q  <= sample_at(y_first[PixelBits-1:AnchorLog2], position(sample, 1'b1))
                 - step_t'(equation_i.y);
      dx1_q   <= equation_i.dx;
      dy1_q   <= equation_i.dy;
    end
  end

  always_ff @(posedge clk_i) begin
    if (valid[0]) begin
      word_q[1] <= equation_i.word;
      x_q[1]    <= x_first[AnchorLog2-1:0];
      y_q[1]    <= y_first[AnchorLog2-1:0];
    end
    for (int unsigned i = 2; i <= 5; i++) begin
      if (valid[i-1]) begin
        x_q[i] <= x_q[i-1];
        y_q[i] <= y_q[i-1];
      end
    end
    for (int unsigned i = 2; i <= 3; i++) begin
      if (valid[i-1]) begin
        word_q[i] <= word_q[i-1];
      end
    end
  end

  // 2: products with the halves of the way, the upper one with the sign; the words nearest to the steps for a pixel, which
  // leave the upper bits of gradients alone. 3: products.
  localparam int unsigned HalfBits = StepBits / 2;
  localparam int unsigned StepFraction = GradientFraction - SubPixelBits;

  gradient_t       x_low_q, x_high_q, y_low_q, y_high_q, across_q, along_y_q;
  modular_t [5:2]  dx_q, dy_q;

  function automatic modular_t nearest_step(logic [WordBits+StepFraction-1:0] gradient);
    return modular_t'(gradient >> StepFraction) + modular_t'(gradient[StepFraction-1]);
  endfunction
  typedef logic signed [StepBits-HalfBits-1:0] high_t;

  always_ff @(posedge clk_i) begin
    if (valid[1]) begin
      x_low_q  <= dx1_q * gradient_t'(right_q[HalfBits-1:0]);
      x_high_q <= dx1_q * gradient_t'(high_t'(right_q[StepBits-1:HalfBits]));
      y_low_q  <= dy1_q * gradient_t'(down_q[HalfBits-1:0]);
      y_high_q <= dy1_q * gradient_t'(high_t'(down_q[StepBits-1:HalfBits]));
      dx_q[2]  <= nearest_step(dx1_q[WordBits+StepFraction-1:0]);
      dy_q[2]  <= nearest_step(dy1_q[WordBits+StepFraction-1:0]);
    end
    for (int unsigned i = 3; i <= 5; i++) begin
      if (valid[i-1]) begin
        dx_q[i] <= dx_q[i-1];
        dy_q[i] <= dy_q[i-1];
      end
    end
    if (valid[2]) begin
      across_q  <= x_low_q + (x_high_q << HalfBits);
      along_y_q <= y_low_q + (y_high_q << HalfBits);
    end
  end

  // 4: their sum. 5: the word nearest to it.
  gradient_t origin4_q;
  modular_t  origin5_q;

  always_ff @(posedge clk_i) begin
    if (valid[3]) begin
      origin4_q <= {word_q[3], {GradientFraction{1'b0}}} + across_q + along_y_q;
    end
    if (valid[4]) begin
      origin5_q <= modular_t'(origin4_q >> GradientFraction)
                   + modular_t'(origin4_q[GradientFraction-1]);
    end
  end

  // 6 and 7: columns and rows of the tile; the origin is in the rows.
  modular_t column_q [TileSize], row_q [TileSize];
  modular_t origin6_q, dx6_q;

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

  modular_t down6_q [TileSize];

  always_ff @(posedge clk_i) begin
    if (valid[5]) begin
      origin6_q <= origin5_q + place_in_anchor(dx_q[5], x_q[5]) + place_in_anchor(dy_q[5], y_q[5]);
      dx6_q     <= dx_q[5];
      for (int unsigned i = 0; i < TileSize; i++) begin
        down6_q[i] <= multiple(dy_q[5], i);
      end
    end
    if (valid[6]) begin
      for (int unsigned i = 0; i < TileSize; i++) begin
        column_q[i] <= multiple(dx6_q, i);
        row_q[i]    <= origin6_q + down6_q[i];
      end
    end
  end

  // For stage 9: the offset, on unorm surfaces with half a code. For stage 10: where a unorm code begins.
  logic                     short_q;
  logic signed [WordBits:0] offset_q;
  logic [5:0]               place9_q, place10_q;

  // Places below a code: 15 or 7 of a vertex depth, and those that a long word has more.
  logic [5:0] more, place;
  assign more  = along[7].beyond ? 6'd32 - 6'(along[7].exponent) : '0;
  assign place = (along[7].is_unorm16 ? 6'd15 : 6'd7) + more;

  always_ff @(posedge clk_i) begin
    if (valid[7]) begin
      short_q  <= !along[7].is_float && !along[7].beyond;
      place9_q <= place;
      offset_q <= along[7].is_float
                  ? (WordBits + 1)'(along[7].offset)
                  : ((WordBits + 1)'(along[7].offset) <<< more) + (65'sd1 <<< (place - 6'd1));
    end
    if (valid[8]) begin
      place10_q <= place9_q;
    end
  end

  // The quads wait for their tile.
  logic [7:0] [Quads-1:0] [QuadIndexBits-1:0] index;
  logic [6:0] [Quads-1:0] [QuadIndexBits-1:0] index_q;
  logic [7:0] [Quads-1:0]                     any;
  logic [6:0] [Quads-1:0]                     any_q;
  logic [Quads-1:0]                           any_in;

  for (genvar q = 0; q < Quads; q++) begin : gen_any
    assign any_in[q] = |mask_i[q];
  end

  assign index = {index_q, index_i};
  assign any   = {any_q, any_in};

  always_ff @(posedge clk_i) begin
    for (int unsigned i = 0; i < 7; i++) begin
      if (valid[i]) begin
        index_q[i] <= index[i];
        any_q[i]   <= any[i];
      end
    end
  end

  // Of the beat in the last stage.
  along_t last_q;

  always_ff @(posedge clk_i) begin
    if (valid[11]) begin
      last_q <= along[11];
    end
  end

  logic [4*Quads-1:0] [CodeBits-1:0] code;

  for (genvar q = 0; q < Quads; q++) begin : gen_quad
    logic quad_valid;
    assign quad_valid = valid[7] & along[7].has_depth & any[7][q];
    for (genvar s = 0; s < 4; s++) begin : gen_sample
      plane_sample u_sample (
        .clk_i      (clk_i),
        .valid_i    (quad_valid),
        .column_i   (column_q[{index[7][q][QuadLog2-1:0], 1'(s % 2)}]),
        .row_i      (row_q[{index[7][q][QuadIndexBits-1:QuadLog2], 1'(s / 2)}]),
        .short_i    (short_q),
        .offset_i   (offset_q),
        .float10_i  (along[9].is_float),
        .place_i    (place10_q),
        .float11_i  (along[10].is_float),
        .exponent_i (along[10].exponent),
        .float12_i  (along[11].is_float),
        .min_code_i (last_q.min_code),
        .max_code_i (last_q.max_code),
        .code_o     (code[4*q+s])
      );
    end
  end

  assign code_o = last_q.has_depth ? code : '0;

  logic unused_fields;
  assign unused_fields = ^{valid[10:9], last_q.is_float, last_q.is_unorm16, last_q.beyond,
                           last_q.exponent, last_q.offset, equation_i.a, equation_i.b, equation_i.z,
                           equation_i.bias, equation_i.area2, equation_i.reciprocal,
                           equation_i.shift};

endmodule
