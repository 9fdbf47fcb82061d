// The cull stage of setup: from a snapped triangle to its verdict, turned to positive area.
//
// Three registers, one triangle a cycle: differences of the vertices; products of the area and extremes of the
// coordinates; area of either sign and bounds. The verdict follows behind the third. Two multipliers of StepBits. What a
// register takes is written where it loads: a simulator then computes nothing where nothing is valid.
//
// A triangle without area is drawn where outer pixels are: it faces back, has the depth of its first vertex, and leaves
// with an area of 0.

module setup_cull
  import raster_pkg::*;
  import sample_pkg::*;
  import sample_box_pkg::*;
  import setup_pkg::*;
  import square_pkg::*;
#(
  /// Pixels of triangles that are drawn by squares: 0 none are, 1 outer, 2 inner.
  parameter int unsigned Conservative = Centres,
  /// How much larger than the pixel its square is on each side, in sub-pixels.
  parameter int unsigned Uncertainty = 0
) (
  input  logic             clk_i,
  input  logic             rst_ni,

  input  logic             valid_i,
  input  screen_triangle_t triangle_i,
  input  draw_state_t      state_i,

  // Three cycles later.
  output logic             valid_o,
  output verdict_t         verdict_o,
  output screen_triangle_t triangle_o // as it came
);

  // Of the vertex pairs (0, 1), (0, 2) and (1, 2): second less first.
  typedef struct packed {
    step_t d01;
    step_t d02;
    step_t d12;
  } differences_t;

  function automatic differences_t differences(coord_t [2:0] c);
    return '{
      d01: step_t'(c[1]) - step_t'(c[0]),
      d02: step_t'(c[2]) - step_t'(c[0]),
      d12: step_t'(c[2]) - step_t'(c[1])
    };
  endfunction

  // Which of three is the least, from "1 before 0", "2 before 0" and "2 before 1".
  function automatic logic [1:0] least(logic one_zero, logic two_zero, logic two_one);
    return !one_zero && !two_zero ? 2'd0 : two_one ? 2'd2 : 2'd1;
  endfunction

  function automatic coord_t pick(coord_t [2:0] c, logic [1:0] index);
    return index == 2'd0 ? c[0] : index == 2'd1 ? c[1] : c[2];
  endfunction

  function automatic coord_t smallest(coord_t [2:0] c, differences_t d);
    return pick(c, least(d.d01[StepBits-1], d.d02[StepBits-1], d.d12[StepBits-1]));
  endfunction

  function automatic coord_t largest(coord_t [2:0] c, differences_t d);
    return pick(c, least(!d.d01[StepBits-1], !d.d02[StepBits-1], !d.d12[StepBits-1]));
  endfunction

  // Whether the second vertex of a pair comes before the first: it is higher, or as high and further left.
  function automatic logic comes_before(step_t dx, step_t dy);
    return dy[StepBits-1] || (dy == '0 && dx[StepBits-1]);
  endfunction

  // by_square of a triangle, where the machine has squares.
  function automatic screen_triangle_t known(screen_triangle_t triangle);
    screen_triangle_t result;
    result           = triangle;
    result.by_square = triangle.by_square & (Conservative != Centres);
    return result;
  endfunction

  // Bit i: register i holds a triangle.
  logic [3:1] valid_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      valid_q <= '0;
    end else begin
      valid_q <= {valid_q[2:1], valid_i};
    end
  end

  assign valid_o = valid_q[3];

  // First register: differences.
  typedef struct packed {
    screen_triangle_t triangle;
    draw_state_t      state;
    differences_t     x;
    differences_t     y;
  } compared_t;

  compared_t compared_q;

  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      compared_q <= '{
        triangle: known(triangle_i),
        state:    state_i,
        x:        differences(triangle_i.x),
        y:        differences(triangle_i.y)
      };
    end
  end

  // Second register: the products, whose difference is twice the area, and the extremes. The area fits AreaBits and a
  // sign, so bits of the products above that cannot matter.
  typedef logic signed [AreaBits:0] signed_area_t;

  typedef struct packed {
    screen_triangle_t triangle;
    draw_state_t      state;
    logic [1:0]       first;
    signed_area_t     plus;
    signed_area_t     minus;
    coord_t           x_min;
    coord_t           x_max;
    coord_t           y_min;
    coord_t           y_max;
  } product_t;

  product_t product_q;

  always_ff @(posedge clk_i) begin
    if (valid_q[1]) begin
      product_q <= '{
        triangle: compared_q.triangle,
        state:    compared_q.state,
        first:    least(comes_before(compared_q.x.d01, compared_q.y.d01),
                        comes_before(compared_q.x.d02, compared_q.y.d02),
                        comes_before(compared_q.x.d12, compared_q.y.d12)),
        plus:     signed_area_t'(compared_q.x.d01) * signed_area_t'(compared_q.y.d02),
        minus:    signed_area_t'(compared_q.x.d02) * signed_area_t'(compared_q.y.d01),
        x_min:    smallest(compared_q.triangle.x, compared_q.x),
        x_max:    largest(compared_q.triangle.x, compared_q.x),
        y_min:    smallest(compared_q.triangle.y, compared_q.y),
        y_max:    largest(compared_q.triangle.y, compared_q.y)
      };
    end
  end

  // Third register: the area and its negative, side by side so that its size needs no second carry chain, and the
  // bounds, with a range beyond the screen.
  localparam int unsigned ReachBits = StepBits - SubPixelBits;
  localparam step_t Half = step_t'(1) <<< (SubPixelBits - 1);
  localparam step_t LastOfPixel = (step_t'(1) <<< SubPixelBits) - step_t'(1);

  typedef logic signed [ReachBits-1:0] reach_t;

  typedef struct packed {
    screen_triangle_t triangle;
    draw_state_t      state;
    logic [1:0]       first;
    signed_area_t     area;
    signed_area_t     negated;
    reach_t           x_first;
    reach_t           x_last;
    reach_t           y_first;
    reach_t           y_last;
  } sized_t;

  // How far the box grows, or shrinks, where squares decide and not centres.
  localparam step_t Square = Conservative == Outer   ? Half + step_t'(Uncertainty)
                             : Conservative == Inner ? -Half - step_t'(Uncertainty) : '0;

  // The samples of pixel p are at p 2^SubPixelBits + least to p 2^SubPixelBits + most: the first pixel rounds up, the
  // last rounds down. Of one sample at the centre both are half a pixel. Squares are about the centre.
  function automatic reach_t first_pixel(coord_t min, grid_t most_sample, logic by_square,
                                         logic [PixelBits-1:0] limit);
    step_t  moved = step_t'(min)
                    + (by_square ? Half - step_t'(1) - Square
                                 : LastOfPixel - step_t'({1'b0, sub_pixels(most_sample)}));
    reach_t pixel = reach_t'(moved >>> SubPixelBits);
    reach_t bound = reach_t'({1'b0, limit});
    return pixel > bound ? pixel : bound;
  endfunction

  function automatic reach_t last_pixel(coord_t max, grid_t least_sample, logic by_square,
                                        logic [PixelBits-1:0] limit);
    step_t  moved = step_t'(max)
                    + (by_square ? Square - Half : -step_t'({1'b0, sub_pixels(least_sample)}));
    reach_t pixel = reach_t'(moved >>> SubPixelBits);
    reach_t bound = reach_t'({1'b0, limit});
    return pixel < bound ? pixel : bound;
  endfunction

  sized_t sized_q;

  always_ff @(posedge clk_i) begin
    if (valid_q[2]) begin
      sized_q <= '{
        triangle: product_q.triangle,
        state:    product_q.state,
        first:    product_q.first,
        area:     product_q.plus - product_q.minus,
        negated:  product_q.minus - product_q.plus,
        x_first:  first_pixel(product_q.x_min, MostX, product_q.triangle.by_square,
                              product_q.state.x_first),
        x_last:   last_pixel(product_q.x_max, LeastX, product_q.triangle.by_square,
                             product_q.state.x_last),
        y_first:  first_pixel(product_q.y_min, MostY, product_q.triangle.by_square,
                              product_q.state.y_first),
        y_last:   last_pixel(product_q.y_max, LeastY, product_q.triangle.by_square,
                             product_q.state.y_last)
      };
    end
  end

  // The verdict. A bounding box without a sample has no pixel in common with the screen either.
  logic negative, flat, flat_drawn, front, culled, no_pixel;
  assign negative   = sized_q.area[AreaBits];
  assign flat       = sized_q.area == '0;
  assign flat_drawn = Conservative == Outer && flat && sized_q.triangle.by_square;
  assign front      = negative != sized_q.state.front_positive_area && !flat_drawn;
  assign culled     = front ? sized_q.state.cull_front : sized_q.state.cull_back;
  assign no_pixel   = sized_q.x_last < sized_q.x_first || sized_q.y_last < sized_q.y_first ||
                      sized_q.state.empty;

  // Vertex that comes i-th. Negative area is turned by going round the other way.
  function automatic logic [1:0] turned(logic [1:0] first, logic backwards, logic second);
    logic [1:0] next = first == 2'd2 ? 2'd0 : first + 2'd1;
    logic [1:0] previous = first == 2'd0 ? 2'd2 : first - 2'd1;
    return second == backwards ? next : previous;
  endfunction

  logic [2:0] [1:0] order;
  assign order[0] = sized_q.first;
  assign order[1] = turned(sized_q.first, negative, 1'b0);
  assign order[2] = turned(sized_q.first, negative, 1'b1);

  always_comb begin
    verdict_o.drawn  = (!flat || flat_drawn) && !culled && !no_pixel;
    verdict_o.area2  = area_t'(negative ? sized_q.negated : sized_q.area);
    verdict_o.state  = sized_q.state;
    verdict_o.bounds = '{
      x_first: sized_q.x_first[PixelBits-1:0],
      x_last:  sized_q.x_last[PixelBits-1:0],
      y_first: sized_q.y_first[PixelBits-1:0],
      y_last:  sized_q.y_last[PixelBits-1:0]
    };
    verdict_o.triangle.offset     = sized_q.triangle.offset;
    verdict_o.triangle.by_square  = sized_q.triangle.by_square;
    verdict_o.triangle.line_rule  = sized_q.triangle.line_rule;
    verdict_o.triangle.line_width = sized_q.triangle.line_width;
    for (int unsigned i = 0; i < 3; i++) begin
      verdict_o.triangle.x[i] = pick(sized_q.triangle.x, order[i]);
      verdict_o.triangle.y[i] = pick(sized_q.triangle.y, order[i]);
      verdict_o.triangle.z[i] = order[i] == 2'd0 || flat_drawn ? sized_q.triangle.z[0] :
                                order[i] == 2'd1 ? sized_q.triangle.z[1] : sized_q.triangle.z[2];
    end
  end

  assign triangle_o = sized_q.triangle;

endmodule
