// From a snapped triangle to edge and depth equations, or to nothing where it is not drawn.
//
// The cull stage finds each triangle's verdict, one a cycle; the verdicts wait in a queue. At its head a dropped
// triangle vanishes, and a drawn one enters the divider when that is free and a slot of the output FIFO is. The slot's
// parts come one after the other, last the quotients, which make it valid. So nothing stalls in mid-pipe, and nothing
// has to wait beside the divider.

module setup
  import raster_pkg::*;
  import setup_pkg::*;
  import depth_pkg::*;
  import square_pkg::*;
#(
  /// Pixels of triangles that are drawn by squares: 0 none are, 1 outer, 2 inner.
  parameter int unsigned Conservative = Centres,
  /// How much larger than the pixel its square is on each side, in sub-pixels.
  parameter int unsigned Uncertainty = 0,
  /// 1: the barycentric equation of a triangle that is drawn by squares has 2A, also without a depth surface.
  parameter bit InnerCoverage = 1'b0,
  /// Triangles in the cull stage and its queue, 2 or more, each as wide as verdict_t. With fewer than 5 the stage
  /// cannot take a triangle in every cycle.
  parameter int unsigned QueueDepth = 8,
  /// Slots of the output FIFO, 2 or more, each as wide as the three packets together. With fewer than 36 / Interval
  /// (plane) or 19 / Interval (barycentric) drawn triangles are further apart than Interval.
  parameter int unsigned FifoDepth = 40,
  /// Cycles from one drawn triangle to the next: 1, 2, 4, 8 or 16. The divider has 16 / Interval stages.
  parameter int unsigned Interval = 1,
  /// Interpolator of depth, 0 plane or 1 barycentric: which equation is made.
  parameter int unsigned Interpolator = Plane,
  /// 1: the plane for hi_z is made, where the interpolator is the plane. 0: it is 0.
  parameter bit HiZ = 1'b0,
  /// 1: thin lines are drawn too. 0: every triangle_i.line_rule is 0.
  parameter bit ThinLines = 1'b0
) (
  input  logic             clk_i,
  input  logic             rst_ni,

  // Front end
  input  logic             triangle_valid_i,
  output logic             triangle_ready_o,
  input  screen_triangle_t triangle_i,
  input  draw_state_t      state_i,

  // block_walker
  output logic             triangle_valid_o,
  input  logic             triangle_ready_i,
  output setup_triangle_t  triangle_o,
  output depth_equation_t  equation_o,
  output draw_state_t      state_o,

  // What the cycle is spent on; whether nothing is left to do.
  output setup_activity_e  activity_o,
  output logic             idle_o
);

  // Cull stage and queue.
  typedef struct packed {
    line_t    line;
    verdict_t verdict;
  } judged_t;

  logic             taken, judged, verdict_valid, decide, queue_empty;
  screen_triangle_t triangle_in, judged_triangle;
  verdict_t         culled_verdict, verdict;
  line_t            line;
  judged_t          judged_d, judged_q;

  // Without thin lines the queue has no room for what is known of one.
  localparam int unsigned QueueBits = ThinLines ? $bits(judged_t) : $bits(verdict_t);
  logic [QueueBits-1:0] queue_in, queue_out;
  assign queue_in = QueueBits'(judged_d);
  assign judged_q = judged_t'(queue_out);

  assign taken   = triangle_valid_i & triangle_ready_o;
  assign verdict = judged_q.verdict;
  assign line    = judged_q.line;

  always_comb begin
    triangle_in = triangle_i;
    if (!ThinLines) begin
      triangle_in.line_rule  = '0;
      triangle_in.line_width = '0;
    end
  end

  setup_cull #(
    .Conservative (Conservative),
    .Uncertainty  (Uncertainty)
  ) u_cull (
    .clk_i      (clk_i),
    .rst_ni     (rst_ni),
    .valid_i    (taken),
    .triangle_i (triangle_in),
    .state_i    (state_i),
    .valid_o    (judged),
    .verdict_o  (culled_verdict),
    .triangle_o (judged_triangle)
  );

  if (ThinLines) begin : gen_columns
    line_t                columns;
    logic                 drawn;
    logic [CoordBits-1:0] length;
    bounds_t              bounds, limits;

    assign limits = '{
      x_first: state_i.x_first,
      x_last:  state_i.x_last,
      y_first: state_i.y_first,
      y_last:  state_i.y_last
    };

    line_columns u_columns (
      .clk_i      (clk_i),
      .rst_ni     (rst_ni),
      .valid_i    (taken),
      .x_i        (triangle_in.x[1:0]),
      .y_i        (triangle_in.y[1:0]),
      .rule_i     (line_rule_e'(triangle_in.line_rule)),
      .width_i    (triangle_in.line_width),
      .limits_i   (limits),
      .line_o     (columns),
      .length_o   (length),
      .drawn_o    (drawn),
      .bounds_o   (bounds)
    );

    // The depth of a line: start and end, and a vertex beside the start, turned to positive area.
    coord_t     beside_x, beside_y;
    logic       turned;
    logic [1:0] beside, stop;
    assign turned   = line_is_turned(columns.x_major, columns.left, columns.up,
                                     judged_triangle.x[0][CoordBits-1],
                                     judged_triangle.y[0][CoordBits-1]);
    assign beside   = turned ? 2'd1 : 2'd2;
    assign stop     = turned ? 2'd2 : 2'd1;
    assign beside_x = columns.x_major ? judged_triangle.x[0] : towards_zero(judged_triangle.x[0]);
    assign beside_y = columns.x_major ? towards_zero(judged_triangle.y[0]) : judged_triangle.y[0];

    always_comb begin
      judged_d.line    = columns;
      judged_d.verdict = culled_verdict;
      if (judged_triangle.line_rule != '0) begin
        judged_d.verdict.drawn              = drawn & !culled_verdict.state.empty;
        judged_d.verdict.bounds             = bounds;
        judged_d.verdict.area2              = area_t'({length, {SubPixelBits{1'b0}}});
        judged_d.verdict.triangle           = judged_triangle;
        judged_d.verdict.triangle.x[stop]   = judged_triangle.x[1];
        judged_d.verdict.triangle.y[stop]   = judged_triangle.y[1];
        judged_d.verdict.triangle.z[stop]   = judged_triangle.z[1];
        judged_d.verdict.triangle.x[beside] = beside_x;
        judged_d.verdict.triangle.y[beside] = beside_y;
        judged_d.verdict.triangle.z[beside] = judged_triangle.z[0];
      end
    end
  end else begin : gen_no_columns
    assign judged_d = '{line: '0, verdict: culled_verdict};

    logic unused_triangle;
    assign unused_triangle = ^{triangle_i.line_rule, triangle_i.line_width, judged_triangle,
                               judged_d.line};

`ifndef SYNTHESIS
    NoLines: assert property (@(posedge clk_i) disable iff (!rst_ni)
        taken |-> triangle_i.line_rule == '0)
    else $error("a thin line");
`endif
  end

  credit_fifo #(
    .Width (QueueBits),
    .Depth (QueueDepth)
  ) u_queue (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .reserve_ready_o (triangle_ready_o),
    .reserve_i       (taken),
    .push_i          (judged),
    .data_i          (queue_in),
    .pop_valid_o     (verdict_valid),
    .pop_ready_i     (decide),
    .data_o          (queue_out),
    .empty_o         (queue_empty)
  );

  // Decision.
  logic draw, divider_free, slot_free;
  assign draw   = verdict_valid & verdict.drawn & divider_free & slot_free;
  assign decide = verdict_valid & (~verdict.drawn | (divider_free & slot_free));

  if (Interval == 1) begin : gen_always_free
    assign divider_free = 1'b1;
  end else begin : gen_interval
    // Cycles in which the first stage still cannot be entered.
    typedef logic [$clog2(Interval)-1:0] wait_t;
    wait_t wait_q;

    always_ff @(posedge clk_i) begin
      if (!rst_ni) begin
        wait_q <= '0;
      end else if (draw) begin
        wait_q <= wait_t'(Interval - 1);
      end else if (wait_q != '0) begin
        wait_q <= wait_q - wait_t'(1);
      end
    end

    assign divider_free = wait_q == '0;
  end

  // What depth is divided by: not 0, where a triangle without area is drawn. It has one depth.
  area_t depth_area2;
  assign depth_area2 = Conservative == Outer && verdict.area2 == '0 ? area_t'(1) : verdict.area2;

  // Depth of a surface that is not there: zeros.
  logic has_depth;
  assign has_depth = verdict.state.format != '0;

  // The parts of a slot: at the decision, 4 (with ThinLines 16) and 8 cycles later, and last the reciprocal or the gradients, 17 or 34 cycles
  // later.
  typedef struct packed {
    vertex_depth_t [2:0] z;
    area_t               area2;
    shift_t              shift;
    coord_t              x;
    coord_t              y;
    bounds_t             bounds;
    draw_state_t         state;
  } known_t;

  typedef struct packed {
    edge_t [2:0] e;
    step_t [2:0] a;
    step_t [2:0] b;
    logic [2:0]  bias;
  } edges_t;

  typedef struct packed {
    word_t               word;
    logic                beyond;
    exponent_t           exponent;
    word_t               offset;
    logic [CodeBits-1:0] min_code;
    logic [CodeBits-1:0] max_code;
  } depth_t;

  typedef struct packed {
    logic [ReciprocalBits-1:0]          reciprocal;
    logic [1:0] [HalfGradientBits-1:0]  dx;
    logic [1:0] [HalfGradientBits-1:0]  dy;
  } divided_t;

  typedef struct packed {
    hi_z_word_t z;
    hi_z_step_t dx;
    hi_z_step_t dy;
    logic       known;
  } hi_z_plane_t;

  known_t known_d, known;
  edges_t edges_d, edges;
  depth_t depth_d, depth;
  shift_t shift;
  word_t [2:0] words;
  logic   edges_valid, depth_valid, is_short;
  logic   reciprocal_valid, reciprocal_kept, divided_valid, leave;
  logic [ReciprocalBits-1:0] quotient;
  divided_t divided_d, divided;
  hi_z_plane_t hi_z_plane;

  // What only the other equation has stays 0.
  logic with_weights, with_plane, with_area;
  assign with_weights = has_depth & (Interpolator == Barycentric);
  assign with_area    = with_weights | (InnerCoverage & verdict.triangle.by_square
                                        & (Interpolator == Barycentric));
  assign with_plane   = has_depth & (Interpolator == Plane);

  always_comb begin
    known_d.z      = with_weights ? verdict.triangle.z : '0;
    known_d.area2  = with_area ? depth_area2 : '0;
    known_d.shift  = with_weights ? shift : '0;
    known_d.x      = with_plane ? verdict.triangle.x[0] : '0;
    known_d.y      = with_plane ? verdict.triangle.y[0] : '0;
    known_d.bounds = verdict.bounds;
    known_d.state  = verdict.state;
  end

  if (ThinLines) begin : gen_line_edges
    line_edges #(
      .Conservative (Conservative),
      .Uncertainty  (Uncertainty)
    ) u_edges (
      .clk_i       (clk_i),
      .rst_ni      (rst_ni),
      .valid_i     (draw),
      .x_i         (verdict.triangle.x),
      .y_i         (verdict.triangle.y),
      .rule_i      (line_rule_e'(verdict.triangle.line_rule)),
      .width_i     (verdict.triangle.line_width),
      .line_i      (line),
      .area2_i     (verdict.area2),
      .x_first_i   (verdict.bounds.x_first),
      .y_first_i   (verdict.bounds.y_first),
      .fill_rule_i (verdict.state.fill_rule),
      .by_square_i (verdict.triangle.by_square),
      .valid_o     (edges_valid),
      .e_o         (edges_d.e),
      .a_o         (edges_d.a),
      .b_o         (edges_d.b),
      .bias_o      (edges_d.bias)
    );
  end else begin : gen_edges
    setup_edges #(
      .Conservative (Conservative),
      .Uncertainty  (Uncertainty)
    ) u_edges (
      .clk_i       (clk_i),
      .rst_ni      (rst_ni),
      .valid_i     (draw),
      .x_i         (verdict.triangle.x),
      .y_i         (verdict.triangle.y),
      .area2_i     (verdict.area2),
      .x_first_i   (verdict.bounds.x_first),
      .y_first_i   (verdict.bounds.y_first),
      .fill_rule_i (verdict.state.fill_rule),
      .by_square_i (verdict.triangle.by_square),
      .valid_o     (edges_valid),
      .e_o         (edges_d.e),
      .a_o         (edges_d.a),
      .b_o         (edges_d.b),
      .bias_o      (edges_d.bias)
    );

    logic unused_line;
    assign unused_line = ^{line, verdict.triangle.line_rule, verdict.triangle.line_width};
  end

  setup_depth u_depth (
    .clk_i        (clk_i),
    .rst_ni       (rst_ni),
    .valid_i      (draw),
    .z_i          (verdict.triangle.z),
    .offset_i     (verdict.triangle.offset),
    .format_i     (verdict.state.format),
    .least_code_i (verdict.state.least_code),
    .most_code_i  (verdict.state.most_code),
    .words_o      (words),
    .short_o      (is_short),
    .valid_o      (depth_valid),
    .word_o       (depth_d.word),
    .beyond_o     (depth_d.beyond),
    .exponent_o   (depth_d.exponent),
    .offset_o     (depth_d.offset),
    .min_code_o   (depth_d.min_code),
    .max_code_o   (depth_d.max_code)
  );

  reciprocal #(
    .ValueBits (AreaBits),
    .Interval  (Interval)
  ) u_reciprocal (
    .clk_i      (clk_i),
    .rst_ni     (rst_ni),
    .valid_i    (draw),
    .value_i    (depth_area2),
    .tag_i      (has_depth),
    .shift_o    (shift),
    .valid_o    (reciprocal_valid),
    .tag_o      (reciprocal_kept),
    .quotient_o (quotient)
  );

  if (Interpolator == Plane) begin : gen_plane
    // Depths that are 0 have gradients that are 0.
    logic [1:0] [HalfGradientBits-1:0] dx, dy;
    logic                              gradients_short, gradients_large;

    setup_plane #(
      .HiZ (HiZ)
    ) u_plane (
      .clk_i        (clk_i),
      .rst_ni       (rst_ni),
      .valid_i      (draw),
      .x_i          (verdict.triangle.x),
      .y_i          (verdict.triangle.y),
      .area2_i      (depth_area2),
      .shift_i      (shift),
      .words_i      (words),
      .short_i      (is_short),
      .reciprocal_i (quotient),
      .valid_o      (divided_valid),
      .dx_o         (dx),
      .dy_o         (dy),
      .short_o      (gradients_short),
      .large_o      (gradients_large)
    );

    assign divided_d = '{reciprocal: '0, dx: dx, dy: dy};

    if (HiZ) begin : gen_hi_z
      hi_z_plane_t hi_z_plane_d;
      logic        hi_z_plane_there;

      setup_hi_z #(
        .FifoDepth (FifoDepth)
      ) u_hi_z (
        .clk_i             (clk_i),
        .rst_ni            (rst_ni),
        .valid_i           (draw),
        .x_i               (verdict.triangle.x[0]),
        .y_i               (verdict.triangle.y[0]),
        .x_first_i         (verdict.bounds.x_first),
        .y_first_i         (verdict.bounds.y_first),
        .format_i          (verdict.state.format),
        .depth_valid_i     (depth_valid),
        .word_i            (depth_d.word),
        .beyond_i          (depth_d.beyond),
        .exponent_i        (depth_d.exponent),
        .offset_i          (depth_d.offset),
        .gradients_valid_i (divided_valid),
        .dx_i              (dx),
        .dy_i              (dy),
        .short_i           (gradients_short),
        .large_i           (gradients_large),
        .z_o               (hi_z_plane_d.z),
        .dx_o              (hi_z_plane_d.dx),
        .dy_o              (hi_z_plane_d.dy),
        .known_o           (hi_z_plane_d.known)
      );

      memory_fifo #(
        .Width ($bits(hi_z_plane_t)),
        .Slots (FifoDepth)
      ) u_hi_z_planes (
        .clk_i       (clk_i),
        .rst_ni      (rst_ni),
        .push_i      (divided_valid),
        .data_i      (hi_z_plane_d),
        .pop_valid_o (hi_z_plane_there),
        .pop_ready_i (leave),
        .data_o      (hi_z_plane)
      );

      logic unused_there;
      assign unused_there = hi_z_plane_there;
    end else begin : gen_no_hi_z
      assign hi_z_plane = '0;

      logic unused_gradients;
      assign unused_gradients = gradients_short ^ gradients_large;
    end

    logic unused_reciprocal;
    assign unused_reciprocal = reciprocal_valid ^ reciprocal_kept;
  end else begin : gen_barycentric
    assign divided_valid = reciprocal_valid;
    assign divided_d     = '{
      reciprocal: quotient & {ReciprocalBits{reciprocal_kept}},
      dx:         '0,
      dy:         '0
    };

    assign hi_z_plane = '0;

    logic unused_words;
    assign unused_words = ^{words, is_short};
  end

  // A slot is a word of four memories, the last of which is filled last. With HiZ a fifth is filled with it.
  logic fifo_empty, unused_ready_next;

  credits #(
    .Slots (FifoDepth)
  ) u_credits (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .reserve_ready_o (slot_free),
    .reserve_i       (draw),
    .return_i        (leave),
    .ready_next_o    (unused_ready_next),
    .empty_o         (fifo_empty)
  );

  logic known_valid, edges_are_there, depth_is_there;

  memory_fifo #(
    .Width ($bits(known_t)),
    .Slots (FifoDepth)
  ) u_known (
    .clk_i       (clk_i),
    .rst_ni      (rst_ni),
    .push_i      (draw),
    .data_i      (known_d),
    .pop_valid_o (known_valid),
    .pop_ready_i (leave),
    .data_o      (known)
  );

  memory_fifo #(
    .Width ($bits(edges_t)),
    .Slots (FifoDepth)
  ) u_edges_fifo (
    .clk_i       (clk_i),
    .rst_ni      (rst_ni),
    .push_i      (edges_valid),
    .data_i      (edges_d),
    .pop_valid_o (edges_are_there),
    .pop_ready_i (leave),
    .data_o      (edges)
  );

  memory_fifo #(
    .Width ($bits(depth_t)),
    .Slots (FifoDepth)
  ) u_depth_fifo (
    .clk_i       (clk_i),
    .rst_ni      (rst_ni),
    .push_i      (depth_valid),
    .data_i      (depth_d),
    .pop_valid_o (depth_is_there),
    .pop_ready_i (leave),
    .data_o      (depth)
  );

  memory_fifo #(
    .Width ($bits(divided_t)),
    .Slots (FifoDepth)
  ) u_divided (
    .clk_i       (clk_i),
    .rst_ni      (rst_ni),
    .push_i      (divided_valid),
    .data_i      (divided_d),
    .pop_valid_o (triangle_valid_o),
    .pop_ready_i (leave),
    .data_o      (divided)
  );

  assign leave = triangle_valid_o & triangle_ready_i;

  assign triangle_o = '{
    e:       edges.e,
    z:       hi_z_plane.z,
    z_dx:    hi_z_plane.dx,
    z_dy:    hi_z_plane.dy,
    z_known: hi_z_plane.known,
    a:       edges.a,
    b:       edges.b,
    x_first: known.bounds.x_first,
    x_last:  known.bounds.x_last,
    y_first: known.bounds.y_first,
    y_last:  known.bounds.y_last
  };
  always_comb begin
    equation_o          = '0;
    equation_o.beyond   = depth.beyond;
    equation_o.exponent = depth.exponent;
    equation_o.offset   = depth.offset;
    equation_o.min_code = depth.min_code;
    equation_o.max_code = depth.max_code;
    if (Interpolator == Plane) begin
      equation_o.dx   = divided.dx;
      equation_o.dy   = divided.dy;
      equation_o.word = depth.word;
      equation_o.x    = known.x;
      equation_o.y    = known.y;
    end else begin
      equation_o.a          = edges.a[2:1];
      equation_o.b          = edges.b[2:1];
      equation_o.z          = known.z;
      equation_o.bias       = edges.bias;
      equation_o.area2      = edge_t'({1'b0, known.area2});
      equation_o.reciprocal = divided.reciprocal;
      equation_o.shift      = known.shift;
    end
  end

  assign state_o = known.state;

  assign activity_o = decide         ? SetupBusy
                      : !verdict_valid ? SetupNoTriangle
                      : !divider_free  ? SetupDivider : SetupNoCredit;
  assign idle_o     = queue_empty & fifo_empty;

`ifdef SYNTHESIS
  logic unused_valid;
  assign unused_valid = ^{known_valid, edges_are_there, depth_is_there};
`else
  WholeSlot: assert property (@(posedge clk_i) disable iff (!rst_ni)
      triangle_valid_o |-> known_valid && edges_are_there && depth_is_there)
  else $error("a slot without all of its parts");
`endif

endmodule
