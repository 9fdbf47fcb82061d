// What hi_z needs of a triangle's depth: how much a pixel changes it, and its value at the first pixel of the first block
// of the bounds; bit for bit those of model/halfspace/units/hi_z_plane.hpp.
//
//     z = word + offset + ((dx X + dy Y) >> SubPixelBits)        X and Y from vertex 0 to the centre of that pixel
//
// One triangle a cycle. X, Y and word + offset are ready long before the gradients are, and wait for them in memories: a
// triangle has a slot of setup's output FIFO before it begins, so no more than FifoDepth of them wait. When the gradients
// come, two multipliers make z in the same cycle. All of it is 0 where the plane is not known.

module setup_hi_z
  import raster_pkg::*;
  import depth_pkg::*;
#(
  /// Triangles that can be under way: 2 or more.
  parameter int unsigned FifoDepth = 40
) (
  input  logic                  clk_i,
  input  logic                  rst_ni,

  // Vertex 0 and the first pixel of the bounds.
  input  logic                  valid_i,
  input  coord_t                x_i,
  input  coord_t                y_i,
  input  logic [PixelBits-1:0]  x_first_i,
  input  logic [PixelBits-1:0]  y_first_i,
  input  logic [FormatBits-1:0] format_i,

  // Eight cycles later, from setup_depth.
  input  logic                  depth_valid_i,
  input  word_t                 word_i,
  input  logic                  beyond_i,
  input  exponent_t             exponent_i,
  input  word_t                 offset_i,

  // 34 cycles later, from setup_plane.
  input  logic                        gradients_valid_i,
  input  logic [GradientBits-1:0]     dx_i,
  input  logic [GradientBits-1:0]     dy_i,
  input  logic                        short_i,
  input  logic                        large_i,

  // In the same cycle.
  output hi_z_word_t            z_o,
  output hi_z_step_t            dx_o,
  output hi_z_step_t            dy_o,
  output logic                  known_o
);

  localparam logic [FormatBits-1:0] Float32 = 4;
  localparam int unsigned Fraction = 16; // bits of z below a word of 32 bits

  // First register: the way to the pixel.
  typedef struct packed {
    step_t x;
    step_t y;
    logic  has_depth;
  } way_t;

  function automatic step_t way_of(logic [BlockCoordBits-1:0] block, coord_t vertex);
    coord_t centre;
    centre = coord_t'({2'b0, block, {BlockLog2{1'b0}}, 1'b1, {SubPixelBits-1{1'b0}}});
    return step_t'(centre) - step_t'(vertex);
  endfunction

  way_t       way_q, way;
  logic       way_valid_q, way_there;
  logic [8:1] is_float_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      way_valid_q <= 1'b0;
    end else begin
      way_valid_q <= valid_i;
    end
  end

  always_ff @(posedge clk_i) begin
    is_float_q <= {is_float_q[7:1], format_i == Float32};
    if (valid_i) begin
      way_q <= '{
        x:         way_of(x_first_i[PixelBits-1:BlockLog2], x_i),
        y:         way_of(y_first_i[PixelBits-1:BlockLog2], y_i),
        has_depth: format_i != '0
      };
    end
  end

  memory_fifo #(
    .Width ($bits(way_t)),
    .Slots (FifoDepth)
  ) u_way (
    .clk_i       (clk_i),
    .rst_ni      (rst_ni),
    .push_i      (way_valid_q),
    .data_i      (way_q),
    .pop_valid_o (way_there),
    .pop_ready_i (gradients_valid_i),
    .data_o      (way)
  );

  // Ninth register: the word of vertex 0 with the offset, which unorm surfaces have as it is.
  hi_z_word_t base_q, base;
  logic       base_valid_q, base_there;

  function automatic hi_z_word_t base_of(word_t word, word_t offset, logic [4:0] exponent,
                                         logic is_float, logic beyond);
    word_t word_part, offset_part;
    if (is_float) begin
      word_part   = word >>> (WordBits - 32 - Fraction);
      offset_part = offset >>> (WordBits - 32 - Fraction);
    end else begin
      word_part   = beyond ? word >>> (WordBits - 32 - Fraction) : word <<< Fraction;
      offset_part = (offset <<< Fraction) >>> (beyond ? exponent : 5'd0);
    end
    return hi_z_word_t'(word_part + offset_part);
  endfunction

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      base_valid_q <= 1'b0;
    end else begin
      base_valid_q <= depth_valid_i;
    end
  end

  always_ff @(posedge clk_i) begin
    if (depth_valid_i) begin
      base_q <= base_of(word_i, offset_i, exponent_i[4:0], is_float_q[8], beyond_i);
    end
  end

  memory_fifo #(
    .Width (HiZWordBits),
    .Slots (FifoDepth)
  ) u_base (
    .clk_i       (clk_i),
    .rst_ni      (rst_ni),
    .push_i      (base_valid_q),
    .data_i      (base_q),
    .pop_valid_o (base_there),
    .pop_ready_i (gradients_valid_i),
    .data_o      (base)
  );

  // A gradient for a pixel. It is not large, so one bit more than a step has holds it.
  typedef logic signed [HiZStepBits:0] pixel_step_t;

  function automatic pixel_step_t step_of(logic [GradientBits-1:0] gradient, logic is_short);
    localparam int unsigned Cut = GradientFraction - Fraction + ShortBits - SubPixelBits;
    localparam int unsigned Most = 8; // sub-pixel bits: then a short one has no bit to cut
    localparam int unsigned Filled = Most + Fraction - GradientFraction;
    return is_short ? pixel_step_t'({gradient, {Filled{1'b0}}} >> (Most - SubPixelBits))
                    : pixel_step_t'(gradient >> Cut);
  endfunction
  function automatic logic fits(pixel_step_t pixel_step);
    return pixel_step[HiZStepBits] == pixel_step[HiZStepBits-1];
  endfunction

  pixel_step_t dx, dy;
  assign dx      = step_of(dx_i, short_i);
  assign dy      = step_of(dy_i, short_i);
  assign known_o = way.has_depth & ~large_i & fits(dx) & fits(dy);

  // Only the bits of z and those below them count.
  typedef logic signed [HiZWordBits+SubPixelBits-1:0] product_t;

  hi_z_step_t step_x, step_y;
  product_t   moved;
  assign step_x = dx[HiZStepBits-1:0];
  assign step_y = dy[HiZStepBits-1:0];
  assign moved  = product_t'(step_x) * product_t'(way.x) + product_t'(step_y) * product_t'(way.y);

  hi_z_word_t z;
  assign z    = base + moved[HiZWordBits+SubPixelBits-1:SubPixelBits];
  assign z_o  = known_o ? z : '0;
  assign dx_o = known_o ? step_x : '0;
  assign dy_o = known_o ? step_y : '0;

  logic unused_bits;
  assign unused_bits = ^{moved[SubPixelBits-1:0], exponent_i[ExponentBits-1:5],
                         x_first_i[BlockLog2-1:0], y_first_i[BlockLog2-1:0]};

`ifdef SYNTHESIS
  logic unused_there;
  assign unused_there = way_there ^ base_there;
`else
  BothWait: assert property (@(posedge clk_i) disable iff (!rst_ni)
      gradients_valid_i |-> way_there && base_there)
  else $error("gradients without what waits for them");
`endif

endmodule
