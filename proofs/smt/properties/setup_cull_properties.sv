// setup_cull: the verdict three cycles after a triangle. Twice its area, with its sign taken off; whether it is drawn;
// its bounds; and its vertices in positive order, the topmost, then leftmost first. By squares, bounds reach as far as these,
// and an outer triangle without area is drawn.

module setup_cull_properties
  import raster_pkg::*;
  import setup_pkg::*;
#(
  parameter int unsigned Conservative = 0,
  parameter int unsigned Uncertainty = 0
) (
  input logic             clk_i,
  input logic             rst_ni,
  input logic             valid_i,
  input screen_triangle_t triangle_i,
  input draw_state_t      state_i
);

  localparam int unsigned Latency = 3;
  typedef logic signed [AreaBits:0] area_sum_t;

  logic [Latency:0]             taken;
  screen_triangle_t [Latency:0] triangle;
  draw_state_t [Latency:0]      state;

  assign taken[0]    = valid_i;
  assign triangle[0] = triangle_i;
  assign state[0]    = state_i;

  always_ff @(posedge clk_i) begin
    taken[Latency:1]    <= rst_ni ? taken[Latency-1:0] : '0;
    triangle[Latency:1] <= triangle[Latency-1:0];
    state[Latency:1]    <= state[Latency-1:0];
  end

  logic     valid;
  verdict_t verdict;

  setup_cull #(
    .Conservative (Conservative),
    .Uncertainty  (Uncertainty)
  ) u_dut (
    .clk_i      (clk_i),
    .rst_ni     (rst_ni),
    .valid_i    (valid_i),
    .triangle_i (triangle_i),
    .state_i    (state_i),
    .valid_o    (valid),
    .verdict_o  (verdict)
  );

  screen_triangle_t t;
  draw_state_t      s;
  assign t = triangle[Latency];
  assign s = state[Latency];

  area_sum_t area;
  assign area = (area_sum_t'(t.x[1]) - area_sum_t'(t.x[0]))
                * (area_sum_t'(t.y[2]) - area_sum_t'(t.y[0]))
                - (area_sum_t'(t.x[2]) - area_sum_t'(t.x[0]))
                  * (area_sum_t'(t.y[1]) - area_sum_t'(t.y[0]));

  // Pixel centres are at half a pixel: the first one in the box, grown by what squares reach, is rounded up, the last one
  // down.
  typedef logic signed [CoordBits+1:0] pixel_t;

  localparam pixel_t Square = (pixel_t'(1) <<< (SubPixelBits - 1)) + pixel_t'(Uncertainty);

  logic   by_square, flat_drawn;
  pixel_t reach;
  assign by_square  = t.by_square && Conservative != 0;
  assign reach      = !by_square ? '0 : Conservative == 1 ? Square : -Square;
  assign flat_drawn = by_square && Conservative == 1 && area == 0;

  function automatic pixel_t least(coord_t [2:0] c);
    pixel_t found = pixel_t'(c[0]);
    for (int unsigned i = 1; i < 3; i++) if (pixel_t'(c[i]) < found) found = pixel_t'(c[i]);
    return found;
  endfunction

  function automatic pixel_t most(coord_t [2:0] c);
    pixel_t found = pixel_t'(c[0]);
    for (int unsigned i = 1; i < 3; i++) if (pixel_t'(c[i]) > found) found = pixel_t'(c[i]);
    return found;
  endfunction

  function automatic pixel_t first(coord_t [2:0] c, logic [PixelBits-1:0] limit);
    pixel_t pixel = (least(c) - reach - (pixel_t'(1) <<< (SubPixelBits - 1))
                     + (pixel_t'(1) <<< SubPixelBits) - 1) >>> SubPixelBits;
    return pixel > pixel_t'({1'b0, limit}) ? pixel : pixel_t'({1'b0, limit});
  endfunction

  function automatic pixel_t last(coord_t [2:0] c, logic [PixelBits-1:0] limit);
    pixel_t pixel = (most(c) + reach - (pixel_t'(1) <<< (SubPixelBits - 1))) >>> SubPixelBits;
    return pixel < pixel_t'({1'b0, limit}) ? pixel : pixel_t'({1'b0, limit});
  endfunction

  pixel_t x_first, x_last, y_first, y_last;
  assign x_first = first(t.x, s.x_first);
  assign x_last  = last(t.x, s.x_last);
  assign y_first = first(t.y, s.y_first);
  assign y_last  = last(t.y, s.y_last);

  logic front, culled, outside;
  assign front   = (area > 0) == s.front_positive_area && !flat_drawn;
  assign culled  = front ? s.cull_front : s.cull_back;
  assign outside = s.empty || x_first > x_last || y_first > y_last;

  // The verdict's vertices are those of the triangle from vertex k on, backwards if its area is negative.
  function automatic logic turned(int unsigned k);
    turned = 1'b1;
    for (int unsigned i = 0; i < 3; i++) begin
      automatic int unsigned from = area < 0 ? (k + 3 - i) % 3 : (k + i) % 3;
      turned &= verdict.triangle.x[i] == t.x[from] && verdict.triangle.y[i] == t.y[from]
                && verdict.triangle.z[i] == t.z[flat_drawn ? 0 : from];
    end
  endfunction

  logic comes_first;
  always_comb begin
    comes_first = 1'b1;
    for (int unsigned i = 1; i < 3; i++) begin
      comes_first &= verdict.triangle.y[0] < verdict.triangle.y[i]
                     || (verdict.triangle.y[0] == verdict.triangle.y[i]
                         && verdict.triangle.x[0] <= verdict.triangle.x[i]);
    end
  end

  always_comb begin
    ValidAfterLatency: assert (valid == taken[Latency]);
    if (valid) begin
      Drawn: assert (verdict.drawn == ((area != 0 || flat_drawn) && !culled && !outside));
      SquareStays: assert (verdict.triangle.by_square == by_square);
      Area: assert (verdict.area2 == area_t'(area < 0 ? -area : area));
      StateStays: assert (verdict.state == s && verdict.triangle.offset == t.offset);
      Turned: assert (turned(0) || turned(1) || turned(2));
      TopmostThenLeftmostFirst: assert (comes_first);
      if (verdict.drawn) begin
        BoundsX: assert (pixel_t'({1'b0, verdict.bounds.x_first}) == x_first
                         && pixel_t'({1'b0, verdict.bounds.x_last}) == x_last);
        BoundsY: assert (pixel_t'({1'b0, verdict.bounds.y_first}) == y_first
                         && pixel_t'({1'b0, verdict.bounds.y_last}) == y_last);
      end
    end

    DrawnTurned: cover (valid && verdict.drawn && area < 0);
    FlatOrNever: cover (valid && (Conservative != 1 || (verdict.drawn && area == 0)));
    OnePixel: cover (valid && verdict.drawn && x_first == x_last && y_first == y_last);
    Culled: cover (valid && !verdict.drawn && area != 0 && !outside);
    NoCentre: cover (valid && !verdict.drawn && area != 0 && !culled && !s.empty);
  end

endmodule
