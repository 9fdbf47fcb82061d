// Edge equations of a drawn triangle at the pixel where its walk starts.
//
// Four registers, one triangle a cycle: steps and the start relative to vertex 0; products; E of edges 1 and 2; E of edge
// 0, and the fill rule. The three unbiased E add up to 2A everywhere. Four multipliers of StepBits.

module setup_edges
  import raster_pkg::*;
  import setup_pkg::*;
#(
  /// Pixels on a side of a block of the walk, 8, 16, 32 or 64, more than TileSize.
  parameter int unsigned BlockSize = 32,
  /// 1: a walk whose bounds do not fit one tile starts at a block; 0: at a tile.
  parameter bit BlockLevel = 1'b1
) (
  input  logic                  clk_i,
  input  logic                  rst_ni,

  input  logic                  valid_i,
  input  coord_t [2:0]          x_i,
  input  coord_t [2:0]          y_i,
  input  area_t                 area2_i,
  input  bounds_t               bounds_i,
  input  logic                  bottom_left_rule_i,

  // Four cycles later.
  output logic                  valid_o,
  output edge_t [2:0]           e_o,
  output step_t [2:0]           a_o,
  output step_t [2:0]           b_o,
  output logic [2:0]            bias_o
);

  typedef logic [PixelBits-1:0] pixel_t;

  // Where the walk starts.
  localparam pixel_t InTile = pixel_t'(TileSize - 1);
  localparam pixel_t InBlock = BlockLevel ? pixel_t'(BlockSize - 1) : InTile;

  function automatic logic same_tile(pixel_t first, pixel_t last);
    return ((first ^ last) & ~InTile) == '0;
  endfunction

  function automatic step_t centre(pixel_t pixel);
    return step_t'({1'b0, pixel, 1'b1, {(SubPixelBits - 1){1'b0}}});
  endfunction

  pixel_t below;
  assign below = same_tile(bounds_i.x_first, bounds_i.x_last) &&
                 same_tile(bounds_i.y_first, bounds_i.y_last) ? InTile : InBlock;

  // First register. Vertex 0 lies on edge 1 and on edge 2, so both take the start relative to it.
  typedef struct packed {
    step_t [2:0] a;
    step_t [2:0] b;
    step_t       x;
    step_t       y;
    area_t       area2;
    logic        bottom_left_rule;
  } steps_t;

  steps_t steps_d, steps_q;
  logic   steps_valid;

  always_comb begin
    for (int unsigned i = 0; i < 3; i++) begin
      steps_d.a[i] = step_t'(y_i[(i+1)%3]) - step_t'(y_i[(i+2)%3]);
      steps_d.b[i] = step_t'(x_i[(i+2)%3]) - step_t'(x_i[(i+1)%3]);
    end
    steps_d.x                = centre(bounds_i.x_first & ~below) - step_t'(x_i[0]);
    steps_d.y                = centre(bounds_i.y_first & ~below) - step_t'(y_i[0]);
    steps_d.area2            = area2_i;
    steps_d.bottom_left_rule = bottom_left_rule_i;
  end

  pipe_register #(
    .Width ($bits(steps_t))
  ) u_steps (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (valid_i),
    .data_i  (steps_d),
    .valid_o (steps_valid),
    .data_o  (steps_q)
  );

  // An edge that does not own the samples on it is lowered by 1.
  function automatic logic lowered(step_t a, step_t b, logic bottom_left_rule);
    logic left = !a[StepBits-1] && a != '0;
    logic horizontal = a == '0;
    logic owned_side = bottom_left_rule ? b[StepBits-1] : !b[StepBits-1] && b != '0;
    return !(left || (horizontal && owned_side));
  endfunction

  // Second register.
  typedef struct packed {
    step_t [2:0] a;
    step_t [2:0] b;
    edge_t [1:0] across;
    edge_t [1:0] down;
    area_t       area2;
    logic [2:0]  bias;
  } products_t;

  products_t products_d, products_q;
  logic      products_valid;

  always_comb begin
    products_d.a     = steps_q.a;
    products_d.b     = steps_q.b;
    products_d.area2 = steps_q.area2;
    for (int unsigned i = 0; i < 2; i++) begin
      products_d.across[i] = edge_t'(steps_q.a[i+1]) * edge_t'(steps_q.x);
      products_d.down[i]   = edge_t'(steps_q.b[i+1]) * edge_t'(steps_q.y);
    end
    for (int unsigned i = 0; i < 3; i++) begin
      products_d.bias[i] = lowered(steps_q.a[i], steps_q.b[i], steps_q.bottom_left_rule);
    end
  end

  pipe_register #(
    .Width ($bits(products_t))
  ) u_products (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (steps_valid),
    .data_i  (products_d),
    .valid_o (products_valid),
    .data_o  (products_q)
  );

  // Third register.
  typedef struct packed {
    step_t [2:0] a;
    step_t [2:0] b;
    edge_t [1:0] e;
    area_t       area2;
    logic [2:0]  bias;
  } sums_t;

  sums_t sums_d, sums_q;
  logic  sums_valid;

  always_comb begin
    sums_d.a     = products_q.a;
    sums_d.b     = products_q.b;
    sums_d.area2 = products_q.area2;
    sums_d.bias  = products_q.bias;
    for (int unsigned i = 0; i < 2; i++) begin
      sums_d.e[i] = edge_t'(products_q.across[i]) + edge_t'(products_q.down[i]);
    end
  end

  pipe_register #(
    .Width ($bits(sums_t))
  ) u_sums (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (products_valid),
    .data_i  (sums_d),
    .valid_o (sums_valid),
    .data_o  (sums_q)
  );

  // Fourth register.
  typedef struct packed {
    step_t [2:0] a;
    step_t [2:0] b;
    edge_t [2:0] e;
    logic [2:0]  bias;
  } edges_t;

  edges_t edges_d, edges_q;
  edge_t  e0;

  assign e0 = edge_t'({1'b0, sums_q.area2}) - sums_q.e[0] - sums_q.e[1];

  always_comb begin
    edges_d.a    = sums_q.a;
    edges_d.b    = sums_q.b;
    edges_d.bias = sums_q.bias;
    edges_d.e[0] = e0 - edge_t'({1'b0, sums_q.bias[0]});
    edges_d.e[1] = sums_q.e[0] - edge_t'({1'b0, sums_q.bias[1]});
    edges_d.e[2] = sums_q.e[1] - edge_t'({1'b0, sums_q.bias[2]});
  end

  pipe_register #(
    .Width ($bits(edges_t))
  ) u_edges (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (sums_valid),
    .data_i  (edges_d),
    .valid_o (valid_o),
    .data_o  (edges_q)
  );

  assign e_o    = edges_q.e;
  assign a_o    = edges_q.a;
  assign b_o    = edges_q.b;
  assign bias_o = edges_q.bias;

endmodule
