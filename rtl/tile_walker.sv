// From a triangle to the tiles that it may touch, by a walk over blocks and tiles: one decision in StepInterval
// cycles.
//
// A square is rejected when all its samples are outside one edge. A tile that is not rejected becomes a tile job; the
// edges that all its samples are inside have their accept bit. A block that is not rejected is entered. One that is
// accepted needs no memory of it: an edge that it is inside of is found again by the test of each of its tiles, whose
// samples are among its own.
//
// A step that gives out a job waits in its last cycle for a slot of the output FIFO, so nothing stalls behind it. The
// next triangle is loaded in the cycle of the last step of this one.

module tile_walker
  import raster_pkg::*;
#(
  /// Slots of the output FIFO, 2 or more. A job takes two cycles to the FIFO's output, so that with 2 the walker cannot
  /// give out a job in every cycle.
  parameter int unsigned FifoDepth = 16,
  /// Pixels on a side of a block: 8, 16, 32 or 64, more than TileSize. Sets the widths of a few adders only.
  parameter int unsigned BlockSize = 32,
  /// 0: no blocks, every tile of the bounds is decided. Saves a third of the gates.
  parameter bit BlockLevel = 1'b1,
  /// 0: nothing is rejected, so that every tile of the bounds becomes a job.
  parameter bit TrivialReject = 1'b1,
  /// 0: no accept bits.
  parameter bit TrivialAccept = 1'b1,
  /// Cycles of a step, 1 to 8. With more than 1 the test of a square has as many cycles (a multi-cycle path).
  parameter int unsigned StepInterval = 1
) (
  input  logic                clk_i,
  input  logic                rst_ni,

  // setup
  input  logic                triangle_valid_i,
  output logic                triangle_ready_o,
  input  setup_triangle_t     triangle_i,
  input  depth_equation_t     equation_i,
  input  draw_state_t         state_i,

  // What early_z keeps of each triangle: written in the cycle after it was taken.
  output logic                slot_write_o,
  output logic [SlotBits-1:0] slot_o,
  output depth_equation_t     slot_equation_o,
  output draw_state_t         slot_state_o,

  // edge_evaluator
  output logic                job_valid_o,
  input  logic                job_ready_i,
  output tile_job_t           job_o,

  // What the cycle is spent on; whether nothing is left to do.
  output tile_walker_activity_e activity_o,
  output logic                idle_o
);

  localparam int unsigned BlockLog2 = $clog2(BlockSize);
  localparam int unsigned PhaseBits = StepInterval > 1 ? $clog2(StepInterval) : 1;

  typedef logic [PhaseBits-1:0] phase_t;

  if (BlockSize <= TileSize || BlockSize != 1 << BlockLog2) begin : gen_illegal_block
    $error("BlockSize must be a power of two larger than TileSize");
  end

  logic load;
  assign load = triangle_valid_i & triangle_ready_o;

  // The walk.
  logic at_block, row_end, leave, first_column, first_row, last_block, last_tile;
  logic advance, enter;

  tile_job_t job_d;

  walk_position #(
    .BlockLog2  (BlockLog2),
    .BlockLevel (BlockLevel)
  ) u_position (
    .clk_i          (clk_i),
    .load_i         (load),
    .x_first_i      (triangle_i.x_first),
    .x_last_i       (triangle_i.x_last),
    .y_first_i      (triangle_i.y_first),
    .y_last_i       (triangle_i.y_last),
    .advance_i      (advance),
    .enter_i        (enter),
    .at_block_o     (at_block),
    .row_end_o      (row_end),
    .leave_o        (leave),
    .first_column_o (first_column),
    .first_row_o    (first_row),
    .last_block_o   (last_block),
    .last_tile_o    (last_tile),
    .tile_x_o       (job_d.tile_x),
    .tile_y_o       (job_d.tile_y),
    .x_first_o      (job_d.x_first),
    .x_last_o       (job_d.x_last),
    .y_first_o      (job_d.y_first),
    .y_last_o       (job_d.y_last)
  );

  logic [EdgeCount-1:0] outside;

  for (genvar i = 0; i < EdgeCount; i++) begin : gen_edge
    walk_edge #(
      .BlockLog2     (BlockLog2),
      .TrivialReject (TrivialReject),
      .TrivialAccept (TrivialAccept)
    ) u_edge (
      .clk_i          (clk_i),
      .load_i         (load),
      .edge_i         (triangle_i.e[i]),
      .a_i            (triangle_i.a[i]),
      .b_i            (triangle_i.b[i]),
      .skip_columns_i (triangle_i.x_first[BlockLog2-1:TileLog2]),
      .skip_rows_i    (triangle_i.y_first[BlockLog2-1:TileLog2]),
      .advance_i      (advance),
      .at_block_i     (at_block),
      .enter_i        (enter),
      .row_end_i      (row_end),
      .leave_i        (leave),
      .first_column_i (first_column),
      .first_row_i    (first_row),
      .edge_o         (job_d.e[i]),
      .a_o            (job_d.a[i]),
      .b_o            (job_d.b[i]),
      .reject_o       (outside[i]),
      .accept_o       (job_d.accept[i])
    );
  end

  // A step: decided in its last cycle, where it waits for a credit if it gives out a job.
  logic   busy_q, idle_q;  // neither in reset
  phase_t phase_q;
  logic   last_phase, reject, give_out, credit, emit, last_step, done, fifo_empty;

  assign last_phase = phase_q == phase_t'(StepInterval - 1);
  assign reject     = |outside;
  assign give_out   = ~at_block & ~reject;
  assign enter      = at_block & ~reject;
  assign advance    = busy_q & last_phase & (credit | ~give_out);
  assign emit       = advance & give_out;
  assign last_step  = last_block & (at_block ? reject : last_tile);
  assign done       = advance & last_step;

  assign triangle_ready_o = idle_q | done;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      busy_q  <= 1'b0;
      idle_q  <= 1'b0;
      phase_q <= '0;
    end else begin
      busy_q  <= load | (busy_q & ~done);
      idle_q  <= ~load & (~busy_q | done);
      phase_q <= load || advance ? '0 : last_phase ? phase_q : phase_q + phase_t'(1);
    end
  end

  // A triangle that has given out a job keeps its slot; the others leave theirs to the next.
  logic [SlotBits-1:0] slot_q;
  logic                slot_used_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      slot_q      <= '0;
      slot_used_q <= 1'b0;
    end else if (done) begin
      slot_q      <= slot_used_q || emit ? slot_q + SlotBits'(1) : slot_q;
      slot_used_q <= 1'b0;
    end else if (emit) begin
      slot_used_q <= 1'b1;
    end
  end

  assign job_d.slot = slot_q;

  pipe_register #(
    .Width ($bits(depth_equation_t) + $bits(draw_state_t))
  ) u_slot (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (load),
    .data_i  ({equation_i, state_i}),
    .valid_o (slot_write_o),
    .data_o  ({slot_equation_o, slot_state_o})
  );

  assign slot_o = slot_q;

  tile_job_t job_q;
  logic      job_valid;

  pipe_register #(
    .Width ($bits(tile_job_t))
  ) u_job (
    .clk_i   (clk_i),
    .rst_ni  (rst_ni),
    .valid_i (emit),
    .data_i  (job_d),
    .valid_o (job_valid),
    .data_o  (job_q)
  );

  credit_fifo #(
    .Width ($bits(tile_job_t)),
    .Depth (FifoDepth)
  ) u_fifo (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
    .reserve_ready_o (credit),
    .reserve_i       (emit),
    .push_i          (job_valid),
    .data_i          (job_q),
    .pop_valid_o     (job_valid_o),
    .pop_ready_i     (job_ready_i),
    .data_o          (job_o),
    .empty_o         (fifo_empty)
  );

  assign activity_o = advance || (busy_q && !last_phase) ? TileWalkerBusy
                      : busy_q ? TileWalkerNoCredit
                      : load   ? TileWalkerLoad : TileWalkerNoTriangle;
  assign idle_o     = ~busy_q & fifo_empty;

endmodule
