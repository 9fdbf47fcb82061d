// Edge equations of triangles and thin lines, in place of setup_edges where the RTL has thin lines.
//
// A thin line from a to b has two edges, that from a to b and the same the other way round, each moved out by half of the
// width. They are two edges of the triangle a, b, b, so setup_edges makes them; of a DDA line b is the point a long step
// away by its rounded slope. Which of both owns what is half-way is put into the fill rule.
//
// Sixteen registers, one packet a cycle: ten in which line_slope divides and everything else waits in a memory; the vertices;
// the four of setup_edges, beside which the width is multiplied by the length; the sum. A multiplier of CoordBits by
// LineWidthBits more than setup_edges has.

module line_edges
  import raster_pkg::*;
  import setup_pkg::*;
  import square_pkg::*;
#(
  /// Pixels of triangles that are drawn by squares: 0 none are, 1 outer, 2 inner.
  parameter int unsigned Conservative = Centres,
  /// How much larger than the pixel its square is on each side, in sub-pixels.
  parameter int unsigned Uncertainty = 0
) (
  input  logic                    clk_i,
  input  logic                    rst_ni,

  input  logic                    valid_i,
  input  coord_t [2:0]            x_i, // as setup turned them
  input  coord_t [2:0]            y_i,
  input  line_rule_e              rule_i,
  input  logic [LineWidthBits-1:0] width_i,
  input  line_t                   line_i,
  input  area_t                   area2_i,
  input  logic [PixelBits-1:0]    x_first_i, // of the bounds
  input  logic [PixelBits-1:0]    y_first_i,
  input  logic [FillRuleBits-1:0] fill_rule_i,
  input  logic                    by_square_i, // 0 of a line, and where Conservative is

  // Sixteen cycles later.
  output logic                    valid_o,
  output edge_t [2:0]             e_o,
  output step_t [2:0]             a_o,
  output step_t [2:0]             b_o,
  output logic [2:0]              bias_o
);

  localparam int unsigned SlopeLatency = 10;

  // The end of a line is vertex 1, unless its depth triangle was turned.
  logic   end_index;
  coord_t [1:0] end_x, end_y;
  assign end_index = line_is_turned(line_i.x_major, line_i.left, line_i.up, x_i[0][CoordBits-1],
                                    y_i[0][CoordBits-1]);
  assign end_x     = {end_index ? x_i[2] : x_i[1], x_i[0]};
  assign end_y     = {end_index ? y_i[2] : y_i[1], y_i[0]};

  logic [SlopeBits:0] slope;

  line_slope u_slope (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (valid_i),
    .x_i     (end_x),
    .y_i     (end_y),
    .line_i  (line_i),
    .slope_o (slope)
  );

  // What waits for the slope.
  typedef struct packed {
    coord_t [2:0]             x;
    coord_t [2:0]             y;
    line_rule_e               rule;
    logic [LineWidthBits-1:0] width;
    line_t                    line;
    area_t                    area2;
    logic [PixelBits-1:0]     x_first;
    logic [PixelBits-1:0]     y_first;
    logic [FillRuleBits-1:0]  fill_rule;
    logic                     by_square;
  } waiting_t;

  waiting_t waiting, waited;
  logic     is_line_i;
  assign is_line_i = rule_i != LineNone;

  always_comb begin
    waiting.rule      = rule_i;
    waiting.width     = width_i;
    waiting.line      = line_i;
    waiting.area2     = area2_i;
    waiting.x_first   = x_first_i;
    waiting.y_first   = y_first_i;
    waiting.fill_rule = fill_rule_i;
    waiting.by_square = by_square_i & (Conservative != Centres);
    waiting.x         = x_i;
    waiting.y         = y_i;
    if (is_line_i) begin
      waiting.x[1] = end_x[1];
      waiting.y[1] = end_y[1];
    end
  end

  logic [SlopeLatency:1] valid_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      valid_q <= '0;
    end else begin
      valid_q <= {valid_q[SlopeLatency-1:1], valid_i};
    end
  end

  delay_memory #(
    .Width  ($bits(waiting_t)),
    .Cycles (SlopeLatency)
  ) u_wait (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (valid_i),
    .data_i  (waiting),
    .data_o  (waited)
  );

  // The vertices: of a line a, b and b, of which midpoint and DDA take the centres of the pixels.
  typedef struct packed {
    step_t [2:0]              x;
    step_t [2:0]              y;
    logic                     is_line;
    logic                     swap;
    logic                     x_major;
    logic [LineWidthBits-1:0] width;
    area_t                    area2;
    logic [PixelBits-1:0]     x_first;
    logic [PixelBits-1:0]     y_first;
    logic [FillRuleBits-1:0]  fill_rule;
    logic                     by_square;
  } placed_t;

  placed_t placed_d, placed_q;
  logic    placed_valid_q;

  function automatic step_t on_grid(coord_t c, logic joined);
    return joined ? step_t'({c[CoordBits-1], c[CoordBits-1:SubPixelBits], 1'b1,
                             {(SubPixelBits - 1){1'b0}}})
                  : step_t'(c);
  endfunction

  // By one in u the line of a DDA goes by its slope in v; the edge is that from a to there, so it leads to larger u.
  localparam step_t DdaStep = step_t'({1'b0, 1'b1, {SlopeBits{1'b0}}});

  logic  is_line, is_dda, joined, slope_falls, lowered, swap;
  logic  edge_left, edge_up; // where the first edge leads to
  step_t slope_step, along_x, along_y, second_x, second_y;

  assign is_line     = waited.rule != LineNone;
  assign is_dda      = waited.rule == LineDda;
  assign joined      = joins_pixels(waited.rule);
  assign slope_falls = waited.line.left != waited.line.up;
  assign slope_step  = slope_falls ? -step_t'({1'b0, slope}) : step_t'({1'b0, slope});
  assign along_x     = waited.line.x_major ? DdaStep : slope_step;
  assign along_y     = waited.line.x_major ? slope_step : DdaStep;
  assign second_x    = is_dda ? on_grid(waited.x[0], joined) + along_x
                              : on_grid(waited.x[1], joined);
  assign second_y    = is_dda ? on_grid(waited.y[0], joined) + along_y
                              : on_grid(waited.y[1], joined);
  assign edge_left   = is_dda ? !waited.line.x_major && slope_falls : waited.line.left;
  assign edge_up     = is_dda ? waited.line.x_major && slope_falls : waited.line.up;

  // Of a line that is x-major and leads to the right the edge from a to b is the first. Edge 1 of the triangle leads from b
  // to a, as (A, B) have it from a to b; edge 2 the other way. The first edge of a line is lowered unless it has ties.
  assign swap    = waited.line.x_major ? edge_left : !edge_up;
  assign lowered = swap == waited.line.ties_up;

  always_comb begin
    placed_d.is_line   = is_line;
    placed_d.swap      = swap;
    placed_d.x_major   = waited.line.x_major;
    placed_d.width     = waited.width;
    placed_d.area2     = waited.area2;
    placed_d.x_first   = waited.x_first;
    placed_d.y_first   = waited.y_first;
    placed_d.by_square = waited.by_square;
    placed_d.fill_rule = is_line ? {edge_up ^ lowered, !edge_left ^ lowered} : waited.fill_rule;
    placed_d.x[0]      = on_grid(waited.x[0], joined);
    placed_d.y[0]      = on_grid(waited.y[0], joined);
    placed_d.x[1]      = second_x;
    placed_d.y[1]      = second_y;
    placed_d.x[2]      = is_line ? second_x : step_t'(waited.x[2]);
    placed_d.y[2]      = is_line ? second_y : step_t'(waited.y[2]);
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      placed_valid_q <= 1'b0;
    end else begin
      placed_valid_q <= valid_q[SlopeLatency];
    end
  end

  always_ff @(posedge clk_i) begin
    if (valid_q[SlopeLatency]) begin
      placed_q <= placed_d;
    end
  end

  logic        edges_valid;
  edge_t [2:0] e;
  step_t [2:0] a, b;
  logic [2:0]  bias;

  setup_edges #(
    .VertexBits   (StepBits),
    .Conservative (Conservative),
    .Uncertainty  (Uncertainty)
  ) u_edges (
    .clk_i       (clk_i),
    .rst_ni      (rst_ni),
    .valid_i     (placed_valid_q),
    .x_i         (placed_q.x),
    .y_i         (placed_q.y),
    .area2_i     (placed_q.area2),
    .x_first_i   (placed_q.x_first),
    .y_first_i   (placed_q.y_first),
    .fill_rule_i (placed_q.fill_rule),
    .by_square_i (placed_q.by_square),
    .valid_o     (edges_valid),
    .e_o         (e),
    .a_o         (a),
    .b_o         (b),
    .bias_o      (bias)
  );

  // Beside them: half of the width, times the length of the edge along the major axis.
  localparam int unsigned AcrossBits = CoordBits + LineWidthBits;

  typedef logic [CoordBits-1:0] length_t;
  typedef logic [AcrossBits-1:0] across_t;
  typedef struct packed {
    logic is_line;
    logic swap;
  } kind_t;

  logic [3:1]               beside_valid_q;
  kind_t [4:1]              kind_q;
  step_t                    run_q;
  length_t                  length_q;
  logic [LineWidthBits-1:0] width1_q, width2_q;
  across_t                  across3_q, across4_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      beside_valid_q <= '0;
    end else begin
      beside_valid_q <= {beside_valid_q[2:1], placed_valid_q};
    end
  end

  always_ff @(posedge clk_i) begin
    if (placed_valid_q) begin
      kind_q[1] <= '{is_line: placed_q.is_line, swap: placed_q.swap};
      width1_q  <= placed_q.width;
      run_q     <= placed_q.x_major ? placed_q.x[1] - placed_q.x[0] : placed_q.y[1] - placed_q.y[0];
    end
    if (beside_valid_q[1]) begin
      kind_q[2] <= kind_q[1];
      width2_q  <= width1_q;
      length_q  <= length_t'(run_q[StepBits-1] ? -run_q : run_q);
    end
    if (beside_valid_q[2]) begin
      kind_q[3] <= kind_q[2];
      across3_q <= across_t'(length_q) * across_t'(width2_q);
    end
    if (beside_valid_q[3]) begin
      kind_q[4] <= kind_q[3];
      across4_q <= across3_q;
    end
  end

  edge_t half;
  assign half = edge_t'({1'b0, across4_q, {(SubPixelBits - 1){1'b0}}});

  // Last: the edges of a line are apart, and the third has every sample inside.
  typedef struct packed {
    edge_t [2:0] e;
    step_t [2:0] a;
    step_t [2:0] b;
    logic [2:0]  bias;
  } edges_t;

  edges_t edges_q;
  logic   valid_last_q;
  logic [1:0] first, second;
  assign first  = kind_q[4].swap ? 2'd2 : 2'd1;
  assign second = kind_q[4].swap ? 2'd1 : 2'd2;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      valid_last_q <= 1'b0;
    end else begin
      valid_last_q <= edges_valid;
    end
  end

  always_ff @(posedge clk_i) begin
    if (edges_valid) begin
      if (kind_q[4].is_line) begin
        edges_q.e[0] <= e[first] + half;
        edges_q.e[1] <= e[second] + half;
        edges_q.e[2] <= '0;
        edges_q.a    <= {step_t'(0), a[second], a[first]};
        edges_q.b    <= {step_t'(0), b[second], b[first]};
        edges_q.bias <= '0;
      end else begin
        edges_q <= '{e: e, a: a, b: b, bias: bias};
      end
    end
  end

  assign valid_o = valid_last_q;
  assign e_o     = edges_q.e;
  assign a_o     = edges_q.a;
  assign b_o     = edges_q.b;
  assign bias_o  = edges_q.bias;

endmodule
