// Edge equations of a drawn triangle at the first pixel of the first block of its bounds, where the walk starts.
//
// Four registers, one triangle a cycle: steps and the start relative to vertex 0; products; E of edges 1 and 2; E of edge
// 0, and the fill rule. The three unbiased E add up to 2A everywhere. Four multipliers of StepBits. What a register takes is
// written where it loads: a simulator then computes nothing where nothing is valid.
//
// An edge of a triangle that is drawn by squares owns what ends on it, and has E at the corner of a square that decides in
// place of its centre: a multiple of |A| + |B| more.

module setup_edges
  import raster_pkg::*;
  import setup_pkg::*;
  import square_pkg::*;
#(
  /// Bits of a coordinate, signed. With StepBits differences from a vertex must fit them as well.
  parameter int unsigned VertexBits = CoordBits,
  /// Pixels of triangles that are drawn by squares: 0 none are, 1 outer, 2 inner.
  parameter int unsigned Conservative = Centres,
  /// How much larger than the pixel its square is on each side, in sub-pixels.
  parameter int unsigned Uncertainty = 0
) (
  input  logic                    clk_i,
  input  logic                    rst_ni,

  input  logic                    valid_i,
  input  logic [2:0] [VertexBits-1:0] x_i,
  input  logic [2:0] [VertexBits-1:0] y_i,
  input  area_t                   area2_i,
  input  logic [PixelBits-1:0]    x_first_i, // of the bounds
  input  logic [PixelBits-1:0]    y_first_i,
  input  logic [FillRuleBits-1:0] fill_rule_i,
  input  logic                    by_square_i, // 0 where Conservative is

  // Four cycles later.
  output logic                    valid_o,
  output edge_t [2:0]             e_o,
  output step_t [2:0]             a_o,
  output step_t [2:0]             b_o,
  output logic [2:0]              bias_o
);

  typedef logic [PixelBits-1:0] pixel_t;

  // Bits of a pixel's number that say where in its block it is.
  localparam pixel_t InBlock = pixel_t'(BlockSize - 1);

  // The centre of the first pixel of its block.
  function automatic step_t start(pixel_t pixel);
    return step_t'({1'b0, pixel & ~InBlock, 1'b1, {(SubPixelBits - 1){1'b0}}});
  endfunction

  function automatic step_t widened(logic [VertexBits-1:0] c);
    return step_t'($signed(c));
  endfunction

  // Bit i: register i holds a triangle.
  logic [4:1] valid_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      valid_q <= '0;
    end else begin
      valid_q <= {valid_q[3:1], valid_i};
    end
  end

  assign valid_o = valid_q[4];

  // First register. Vertex 0 lies on edge 1 and on edge 2, so both take the start relative to it.
  typedef struct packed {
    step_t [2:0] a;
    step_t [2:0] b;
    step_t       x;
    step_t       y;
    area_t       area2;
    logic [FillRuleBits-1:0] fill_rule;
    logic        by_square;
  } steps_t;

  steps_t steps_q;

  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      for (int unsigned i = 0; i < 3; i++) begin
        steps_q.a[i] <= widened(y_i[(i+1)%3]) - widened(y_i[(i+2)%3]);
        steps_q.b[i] <= widened(x_i[(i+2)%3]) - widened(x_i[(i+1)%3]);
      end
      steps_q.x         <= start(x_first_i) - widened(x_i[0]);
      steps_q.y         <= start(y_first_i) - widened(y_i[0]);
      steps_q.area2     <= area2_i;
      steps_q.fill_rule <= fill_rule_i;
      steps_q.by_square <= by_square_i & (Conservative != Centres);
    end
  end

  // An edge that does not own the samples on it is lowered by 1. Left edges own theirs, or right ones
  // (bit 1 of the rule); of the horizontal ones the top ones do, or the bottom ones (bit 0). A and B
  // are not both 0.
  function automatic logic lowered(step_t a, step_t b, logic [FillRuleBits-1:0] rule);
    return a == '0 ? b[StepBits-1] != rule[0] : a[StepBits-1] != rule[1];
  endfunction

  // Second register.
  typedef struct packed {
    step_t [2:0] a;
    step_t [2:0] b;
    edge_t [1:0] across;
    edge_t [1:0] down;
    area_t       area2;
    logic [2:0]  bias;
    span_t [2:0] span; // 0 where centres decide
  } products_t;

  products_t products_q;

  always_ff @(posedge clk_i) begin
    if (valid_q[1]) begin
      products_q.a     <= steps_q.a;
      products_q.b     <= steps_q.b;
      products_q.area2 <= steps_q.area2;
      for (int unsigned i = 0; i < 2; i++) begin
        products_q.across[i] <= edge_t'(steps_q.a[i+1]) * edge_t'(steps_q.x);
        products_q.down[i]   <= edge_t'(steps_q.b[i+1]) * edge_t'(steps_q.y);
      end
      for (int unsigned i = 0; i < 3; i++) begin
        products_q.bias[i] <= lowered(steps_q.a[i], steps_q.b[i], steps_q.fill_rule)
                              & !steps_q.by_square;
        products_q.span[i] <= steps_q.by_square ? span_of(steps_q.a[i], steps_q.b[i]) : '0;
      end
    end
  end

  // Third register.
  typedef struct packed {
    step_t [2:0] a;
    step_t [2:0] b;
    edge_t [1:0] e;
    area_t       area2;
    logic [2:0]  bias;
    edge_t [2:0] square;
  } sums_t;

  sums_t sums_q;

  always_ff @(posedge clk_i) begin
    if (valid_q[2]) begin
      sums_q.a     <= products_q.a;
      sums_q.b     <= products_q.b;
      sums_q.area2 <= products_q.area2;
      sums_q.bias  <= products_q.bias;
      for (int unsigned i = 0; i < 2; i++) begin
        sums_q.e[i] <= edge_t'(products_q.across[i]) + edge_t'(products_q.down[i]);
      end
      for (int unsigned i = 0; i < 3; i++) begin
        sums_q.square[i] <= to_square(products_q.span[i], Conservative, Uncertainty);
      end
    end
  end

  // Fourth register.
  typedef struct packed {
    step_t [2:0] a;
    step_t [2:0] b;
    edge_t [2:0] e;
    logic [2:0]  bias;
  } edges_t;

  edges_t edges_q;

  always_ff @(posedge clk_i) begin
    if (valid_q[3]) begin
      edges_q.a    <= sums_q.a;
      edges_q.b    <= sums_q.b;
      edges_q.bias <= sums_q.bias;
      edges_q.e[0] <= edge_t'({1'b0, sums_q.area2}) - sums_q.e[0] - sums_q.e[1]
                      - edge_t'({1'b0, sums_q.bias[0]}) + sums_q.square[0];
      edges_q.e[1] <= sums_q.e[0] - edge_t'({1'b0, sums_q.bias[1]}) + sums_q.square[1];
      edges_q.e[2] <= sums_q.e[1] - edge_t'({1'b0, sums_q.bias[2]}) + sums_q.square[2];
    end
  end

  assign e_o    = edges_q.e;
  assign a_o    = edges_q.a;
  assign b_o    = edges_q.b;
  assign bias_o = edges_q.bias;

endmodule
