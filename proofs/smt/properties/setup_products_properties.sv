// The six multipliers of setup, bit by bit: each product is that of the differences it is named for, over integers.

module setup_products_properties
  import raster_pkg::*;
  import setup_pkg::*;
(
  input logic                 clk_i,
  input logic                 rst_ni,
  input logic                 valid_i,
  input screen_triangle_t     triangle_i,
  input draw_state_t          state_i,
  input area_t                area2_i,
  input logic [PixelBits-1:0] x_first_i,
  input logic [PixelBits-1:0] y_first_i
);

  localparam int unsigned Latency = 2;
  typedef logic signed [2*StepBits-1:0] wide_t;  // holds every product of two steps

  localparam wide_t Side = (wide_t'(1) <<< CoordBits) - 1;

  typedef struct packed {
    coord_t [2:0]         x;
    coord_t [2:0]         y;
    logic [PixelBits-1:0] x_first;
    logic [PixelBits-1:0] y_first;
  } triangle_t;

  logic [Latency:0]      taken;
  triangle_t [Latency:0] triangle;

  assign taken[0]    = valid_i;
  assign triangle[0] = '{x: triangle_i.x, y: triangle_i.y, x_first: x_first_i, y_first: y_first_i};

  always_ff @(posedge clk_i) begin
    taken[Latency:1]    <= rst_ni ? taken[Latency-1:0] : '0;
    triangle[Latency:1] <= triangle[Latency-1:0];
  end

  logic        valid, judged;
  edge_t [2:0] e;
  step_t [2:0] a, b;
  logic [2:0]  bias;
  verdict_t    verdict;

  setup_edges u_edges (
    .clk_i              (clk_i),
    .rst_ni             (rst_ni),
    .valid_i            (valid_i),
    .x_i                (triangle_i.x),
    .y_i                (triangle_i.y),
    .area2_i            (area2_i),
    .x_first_i          (x_first_i),
    .y_first_i          (y_first_i),
    .fill_rule_i        ('0),
    .by_square_i        (1'b0),
    .valid_o            (valid),
    .e_o                (e),
    .a_o                (a),
    .b_o                (b),
    .bias_o             (bias)
  );

  setup_cull u_cull (
    .clk_i      (clk_i),
    .rst_ni     (rst_ni),
    .valid_i    (valid_i),
    .triangle_i (triangle_i),
    .state_i    (state_i),
    .valid_o    (judged),
    .verdict_o  (verdict)
  );

  triangle_t t;
  assign t = triangle[Latency];

  function automatic wide_t less(coord_t one, coord_t other);
    return wide_t'(one) - wide_t'(other);
  endfunction

  // From vertex 0 to the centre of the first pixel of the block.
  function automatic wide_t to_start(logic [PixelBits-1:0] pixel, coord_t vertex);
    logic [PixelBits-1:0] first = pixel / PixelBits'(BlockSize) * PixelBits'(BlockSize);
    return (wide_t'({1'b0, first}) <<< SubPixelBits) + (wide_t'(1) <<< (SubPixelBits - 1))
           - wide_t'(vertex);
  endfunction

  wide_t x, y;
  assign x = to_start(t.x_first, t.x[0]);
  assign y = to_start(t.y_first, t.y[0]);

  always_comb begin
    if (taken[Latency]) begin
      Across1: assert (wide_t'(u_edges.products_q.across[0]) == less(t.y[2], t.y[0]) * x);
      Across2: assert (wide_t'(u_edges.products_q.across[1]) == less(t.y[0], t.y[1]) * x);
      Down1: assert (wide_t'(u_edges.products_q.down[0]) == less(t.x[0], t.x[2]) * y);
      Down2: assert (wide_t'(u_edges.products_q.down[1]) == less(t.x[1], t.x[0]) * y);
      AreaPlus: assert (wide_t'(u_cull.product_q.plus)
                        == less(t.x[1], t.x[0]) * less(t.y[2], t.y[0]));
      AreaMinus: assert (wide_t'(u_cull.product_q.minus)
                         == less(t.x[2], t.x[0]) * less(t.y[1], t.y[0]));
    end

    Largest: cover (taken[Latency] && u_cull.product_q.plus == Side * Side);
  end

endmodule
