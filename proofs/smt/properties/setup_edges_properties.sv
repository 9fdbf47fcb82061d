// setup_edges: what leaves four cycles after a triangle is its edge equations, as docs/numerics.md states them; by squares,
// as docs/guides/conservative.md does.
//
// Edges 1 and 2 are stated from vertex 0, edge 0 from the area, as in the RTL, so that products may be any function of
// their operands; lemmas/edges.smt2 says that the unit in C++ states the same.

module setup_edges_properties
  import raster_pkg::*;
  import setup_pkg::*;
#(
  // More than EdgeBits: nothing below overflows, whatever the RTL does.
  parameter int unsigned WideBits = EdgeBits,
  parameter int unsigned Conservative = 0,
  parameter int unsigned Uncertainty = 0
) (
  input logic                    clk_i,
  input logic                    rst_ni,
  input logic                    valid_i,
  input coord_t [2:0]            x_i,
  input coord_t [2:0]            y_i,
  input area_t                   area2_i,
  input logic [PixelBits-1:0]    x_first_i,
  input logic [PixelBits-1:0]    y_first_i,
  input logic [FillRuleBits-1:0] rule_i,
  input logic                    by_square_i
);

  localparam int unsigned Latency = 4;

  typedef logic signed [WideBits-1:0] wide_t;

  typedef struct packed {
    coord_t [2:0]            x;
    coord_t [2:0]            y;
    area_t                   area2;
    logic [PixelBits-1:0]    x_first;
    logic [PixelBits-1:0]    y_first;
    logic [FillRuleBits-1:0] rule;
    logic                    by_square;
  } triangle_t;

  logic [Latency:0]      taken;
  triangle_t [Latency:0] triangle;

  assign taken[0]    = valid_i;
  assign triangle[0] = '{x: x_i, y: y_i, area2: area2_i,
                         x_first: x_first_i, y_first: y_first_i, rule: rule_i,
                         by_square: by_square_i && Conservative != 0};

  always_ff @(posedge clk_i) begin
    taken[Latency:1]    <= rst_ni ? taken[Latency-1:0] : '0;
    triangle[Latency:1] <= triangle[Latency-1:0];
  end

  logic        valid;
  edge_t [2:0] e;
  step_t [2:0] a, b;
  logic [2:0]  bias;

  setup_edges #(
    .Conservative (Conservative),
    .Uncertainty  (Uncertainty)
  ) u_dut (
    .clk_i              (clk_i),
    .rst_ni             (rst_ni),
    .valid_i            (valid_i),
    .x_i                (x_i),
    .y_i                (y_i),
    .area2_i            (area2_i),
    .x_first_i          (x_first_i),
    .y_first_i          (y_first_i),
    .fill_rule_i        (rule_i),
    .by_square_i        (by_square_i),
    .valid_o            (valid),
    .e_o                (e),
    .a_o                (a),
    .b_o                (b),
    .bias_o             (bias)
  );

  // Whether an edge owns the samples on it: left edges or right ones, and of the horizontal ones those on top or at the
  // bottom.
  function automatic logic owns(wide_t dx, wide_t dy, logic bottom, logic right);
    return (right ? dx < 0 : dx > 0) || (dx == 0 && (bottom ? dy < 0 : dy > 0));
  endfunction

  // The centre of the first pixel of the block that holds a pixel, on the sub-pixel grid.
  function automatic wide_t start(logic [PixelBits-1:0] pixel);
    logic [PixelBits-1:0] first = pixel / PixelBits'(BlockSize) * PixelBits'(BlockSize);
    return (wide_t'({1'b0, first}) <<< SubPixelBits) + (wide_t'(1) <<< (SubPixelBits - 1));
  endfunction

  // Half a pixel and the uncertainty, times the change of E for a step in x and one in y.
  function automatic wide_t way_to_corner(wide_t dx, wide_t dy);
    wide_t change = (dx < 0 ? -dx : dx) + (dy < 0 ? -dy : dy);
    way_to_corner = change <<< (SubPixelBits - 1);
    for (int unsigned i = 0; i < Uncertainty; i++) way_to_corner += change;
  endfunction

  triangle_t   t;
  wide_t [2:0] wanted_a, wanted_b, wanted_e, square;
  logic [2:0]  owned;

  assign t = triangle[Latency];

  always_comb begin
    for (int unsigned i = 0; i < 3; i++) begin
      automatic int unsigned from = (i + 1) % 3;
      automatic int unsigned to = (i + 2) % 3;
      wanted_a[i] = wide_t'(t.y[from]) - wide_t'(t.y[to]);
      wanted_b[i] = wide_t'(t.x[to]) - wide_t'(t.x[from]);
      owned[i]    = owns(wanted_a[i], wanted_b[i], t.rule[0], t.rule[1]) || t.by_square;
      square[i]   = !t.by_square ? '0
                    : Conservative == 1 ? way_to_corner(wanted_a[i], wanted_b[i])
                                        : -way_to_corner(wanted_a[i], wanted_b[i]);
      wanted_e[i] = wanted_a[i] * (start(t.x_first) - wide_t'(t.x[0]))
                    + wanted_b[i] * (start(t.y_first) - wide_t'(t.y[0]));
    end
    wanted_e[0] = wide_t'({1'b0, t.area2}) - wanted_e[1] - wanted_e[2];
  end

  for (genvar i = 0; i < 3; i++) begin : gen_edge
    always_comb begin
      // A triangle with two equal vertices has no area: setup_cull lets none pass that is not drawn by squares.
      VerticesApart: assume (x_i[i] != x_i[(i+1)%3] || y_i[i] != y_i[(i+1)%3]
                             || (by_square_i && Conservative != 0));
      if (valid) begin
        StepA: assert (wide_t'(a[i]) == wanted_a[i]);
        StepB: assert (wide_t'(b[i]) == wanted_b[i]);
        BiasUnlessOwned: assert (bias[i] == !owned[i]);
        Edge: assert (wide_t'(e[i]) == wanted_e[i] - wide_t'({1'b0, !owned[i]}) + square[i]);
      end
    end
  end

  always_comb begin
    ValidAfterLatency: assert (valid == taken[Latency]);

    RightOwned: cover (valid && t.rule == 2'd3 && owned[1] && a[1] < 0 && !t.by_square);
    OwnedHorizontal: cover (valid && owned[1] && a[1] == 0 && !t.by_square);
    BySquareOrNever: cover (valid && (t.by_square || Conservative == 0));
    NotOwnedHorizontal: cover (valid && !owned[2] && a[2] == 0 && b[2] != 0);
    SampleOnEdge: cover (valid && wanted_e[1] == 0);
  end

endmodule
