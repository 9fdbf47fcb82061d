// From a snapped triangle to edge and depth equations, or to nothing where it is not drawn.
//
// The cull stage finds each triangle's verdict, one a cycle; the verdicts wait in a queue. At its head a dropped
// triangle vanishes, and a drawn one enters the divider when that is free and a slot of the output FIFO is. The slot's
// parts come one after the other: what is known already, then the edges, last the reciprocal, which makes it valid.
// So nothing stalls in mid-pipe, and nothing has to wait beside the divider.

module setup
  import raster_pkg::*;
  import setup_pkg::*;
#(
  /// Triangles in the cull stage and its queue, 2 or more, each as wide as verdict_t. With fewer than 5 the stage
  /// cannot take a triangle in every cycle.
  parameter int unsigned QueueDepth = 8,
  /// Slots of the output FIFO, 2 or more, each as wide as the three packets together. With fewer than 19 / Interval
  /// drawn triangles are further apart than Interval.
  parameter int unsigned FifoDepth = 24,
  /// Cycles from one drawn triangle to the next: 1, 2, 4, 8 or 16. The divider has 16 / Interval stages.
  parameter int unsigned Interval = 1,
  /// Pixels on a side of a block of tile_walker, 8, 16, 32 or 64, more than TileSize.
  parameter int unsigned BlockSize = 32,
  /// Whether tile_walker decides blocks: a walk whose bounds do not fit one tile then starts at a block.
  parameter bit BlockLevel = 1'b1
) (
  input  logic             clk_i,
  input  logic             rst_ni,

  // Front end
  input  logic             triangle_valid_i,
  output logic             triangle_ready_o,
  input  screen_triangle_t triangle_i,
  input  draw_state_t      state_i,

  // tile_walker
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
  logic     taken, judged, verdict_valid, decide, queue_empty;
  verdict_t judged_verdict, verdict;

  assign taken = triangle_valid_i & triangle_ready_o;

  setup_cull u_cull (
    .clk_i      (clk_i),
    .rst_ni     (rst_ni),
    .valid_i    (taken),
    .triangle_i (triangle_i),
    .state_i    (state_i),
    .valid_o    (judged),
    .verdict_o  (judged_verdict)
  );

  credit_fifo #(
    .Width ($bits(verdict_t)),
    .Depth (QueueDepth)
  ) u_queue (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .reserve_ready_o (triangle_ready_o),
    .reserve_i       (taken),
    .push_i          (judged),
    .data_i          (judged_verdict),
    .pop_valid_o     (verdict_valid),
    .pop_ready_i     (decide),
    .data_o          (verdict),
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

  // Depth of a surface that is not there: zeros.
  logic has_depth;
  assign has_depth = verdict.state.format != '0;

  // The parts of a slot: at the decision, 3, 5 and 17 cycles later. The last has the credits, and is valid last; the
  // others are taken with it.
  typedef struct packed {
    vertex_depth_t [2:0] z;
    area_t               area2;
    shift_t              shift;
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
    logic                beyond;
    exponent_t           exponent;
    word_t               offset;
    logic [CodeBits-1:0] min_code;
    logic [CodeBits-1:0] max_code;
  } depth_t;

  known_t known_d, known;
  edges_t edges_d, edges;
  depth_t depth_d, depth;
  shift_t shift;
  logic   edges_valid, depth_valid, reciprocal_valid, reciprocal_kept, leave;
  logic [ReciprocalBits-1:0] quotient;

  always_comb begin
    known_d.z      = has_depth ? verdict.triangle.z : '0;
    known_d.area2  = has_depth ? verdict.area2 : '0;
    known_d.shift  = has_depth ? shift : '0;
    known_d.bounds = verdict.bounds;
    known_d.state  = verdict.state;
  end

  setup_edges #(
    .BlockSize  (BlockSize),
    .BlockLevel (BlockLevel)
  ) u_edges (
    .clk_i              (clk_i),
    .rst_ni             (rst_ni),
    .valid_i            (draw),
    .x_i                (verdict.triangle.x),
    .y_i                (verdict.triangle.y),
    .area2_i            (verdict.area2),
    .bounds_i           (verdict.bounds),
    .bottom_left_rule_i (verdict.state.bottom_left_rule),
    .valid_o            (edges_valid),
    .e_o                (edges_d.e),
    .a_o                (edges_d.a),
    .b_o                (edges_d.b),
    .bias_o             (edges_d.bias)
  );

  setup_depth u_depth (
    .clk_i        (clk_i),
    .rst_ni       (rst_ni),
    .valid_i      (draw),
    .z_i          (verdict.triangle.z),
    .offset_i     (verdict.triangle.offset),
    .format_i     (verdict.state.format),
    .least_code_i (verdict.state.least_code),
    .most_code_i  (verdict.state.most_code),
    .valid_o      (depth_valid),
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
    .value_i    (verdict.area2),
    .tag_i      (has_depth),
    .shift_o    (shift),
    .valid_o    (reciprocal_valid),
    .tag_o      (reciprocal_kept),
    .quotient_o (quotient)
  );

  // All four count the same credits; one of them says so.
  logic fifo_empty;
  logic unused_known_ready, unused_known_valid, unused_known_empty;
  logic unused_edges_ready, unused_edges_valid, unused_edges_empty;
  logic unused_depth_ready, unused_depth_valid, unused_depth_empty;

  credit_fifo #(
    .Width ($bits(known_t)),
    .Depth (FifoDepth)
  ) u_known (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .reserve_ready_o (unused_known_ready),
    .reserve_i       (draw),
    .push_i          (draw),
    .data_i          (known_d),
    .pop_valid_o     (unused_known_valid),
    .pop_ready_i     (leave),
    .data_o          (known),
    .empty_o         (unused_known_empty)
  );

  credit_fifo #(
    .Width ($bits(edges_t)),
    .Depth (FifoDepth)
  ) u_edges_fifo (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .reserve_ready_o (unused_edges_ready),
    .reserve_i       (draw),
    .push_i          (edges_valid),
    .data_i          (edges_d),
    .pop_valid_o     (unused_edges_valid),
    .pop_ready_i     (leave),
    .data_o          (edges),
    .empty_o         (unused_edges_empty)
  );

  credit_fifo #(
    .Width ($bits(depth_t)),
    .Depth (FifoDepth)
  ) u_depth_fifo (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .reserve_ready_o (unused_depth_ready),
    .reserve_i       (draw),
    .push_i          (depth_valid),
    .data_i          (depth_d),
    .pop_valid_o     (unused_depth_valid),
    .pop_ready_i     (leave),
    .data_o          (depth),
    .empty_o         (unused_depth_empty)
  );

  credit_fifo #(
    .Width (ReciprocalBits),
    .Depth (FifoDepth)
  ) u_reciprocal_fifo (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .reserve_ready_o (slot_free),
    .reserve_i       (draw),
    .push_i          (reciprocal_valid),
    .data_i          (quotient & {ReciprocalBits{reciprocal_kept}}),
    .pop_valid_o     (triangle_valid_o),
    .pop_ready_i     (triangle_ready_i),
    .data_o          (equation_o.reciprocal),
    .empty_o         (fifo_empty)
  );

  assign leave = triangle_valid_o & triangle_ready_i;

  assign triangle_o = '{
    e:       edges.e,
    a:       edges.a,
    b:       edges.b,
    x_first: known.bounds.x_first,
    x_last:  known.bounds.x_last,
    y_first: known.bounds.y_first,
    y_last:  known.bounds.y_last
  };
  assign equation_o.a        = edges.a[2:1];
  assign equation_o.b        = edges.b[2:1];
  assign equation_o.z        = known.z;
  assign equation_o.bias     = edges.bias;
  assign equation_o.area2    = edge_t'({1'b0, known.area2});
  assign equation_o.shift    = known.shift;
  assign equation_o.beyond   = depth.beyond;
  assign equation_o.exponent = depth.exponent;
  assign equation_o.offset   = depth.offset;
  assign equation_o.min_code = depth.min_code;
  assign equation_o.max_code = depth.max_code;
  assign state_o             = known.state;

  assign activity_o = decide         ? SetupBusy
                      : !verdict_valid ? SetupNoTriangle
                      : !divider_free  ? SetupDivider : SetupNoCredit;
  assign idle_o     = queue_empty & fifo_empty;

endmodule
