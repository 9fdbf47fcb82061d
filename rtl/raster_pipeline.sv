// The pipeline: setup, block_walker, hi_z where the machine has it, tile_walker, edge_evaluator, quad_generator and early_z
// in a row, and the counters of their cycles. Triangles go in, tested quads come out; early_z has the memory port.
//
// A clear or a flush is taken in a cycle in which nothing is left to do anywhere. Whoever offers one offers no triangle
// until it is done.

module raster_pipeline
  import raster_pkg::*;
  import z_codec_pkg::*;
#(
  // Names in the configuration file and what each costs: docs/units/raster_pipeline.md.
  parameter int unsigned Conservative = 0,
  parameter int unsigned Uncertainty = 1,
  parameter bit InnerCoverage = 1'b0,
  parameter int unsigned SetupQueue = 8,
  parameter int unsigned SetupInterval = 1,
  parameter int unsigned SetupFifo = 40,
  /// 1: thin lines are drawn too.
  parameter bit          ThinLines = 1'b0,
  parameter bit          TrivialReject = 1'b1,
  parameter bit          SampleReject = 1'b0,
  parameter int unsigned WalkLevels = 2,
  parameter int unsigned WalkOrder = 0,
  parameter int unsigned BlockFifo = 4,
  parameter bit          HiZ = 1'b0,
  parameter bit          HiZAccept = 1'b1,
  parameter int unsigned HiZBits = 8,
  parameter int unsigned HiZLag = 128,
  parameter int unsigned HiZFifo = 12,
  parameter bit          TrivialAccept = 1'b1,
  parameter int unsigned TileOrder = 0,
  parameter int unsigned WalkerFifo = 16,
  parameter int unsigned PipeStages = 2,
  parameter int unsigned EdgeFifo = 4,
  parameter int unsigned QuadFifo = 4,
  parameter int unsigned PendingDepth = 32,
  parameter int unsigned EarlyZFifo = 16,
  /// 2: late draws write late. Else no state has late set, and late_valid_i is 0.
  parameter int unsigned LateZMode = 0,
  parameter int unsigned LateQueue = 16,
  parameter int unsigned Interpolator = 0,
  parameter int unsigned InterpolatorLatency = 12,
  parameter int unsigned Lines = 128,
  parameter int unsigned Ways = 4,
  parameter int unsigned MissesInFlight = 16,
  parameter int unsigned WriteBuffers = 4,
  parameter bit          Compression = 1'b0,
  parameter int unsigned ClearTiles = 64,
  parameter int unsigned ReadBytes = 64,
  parameter int unsigned WriteBytes = 64,
  /// Tiles of all surfaces, 2 or more.
  parameter int unsigned MemoryTiles = 65536,
  /// Blocks of all surfaces, 2 or more: a word each in hi_z.
  parameter int unsigned MemoryBlocks = 16384,
  /// Bits of a cycle counter.
  parameter int unsigned CounterBits = 50,
  localparam int unsigned TileBits = $clog2(MemoryTiles),
  localparam int unsigned BlockBits = $clog2(MemoryBlocks),
  localparam int unsigned FillBits = 8 * (ReadBytes < LineBytes ? ReadBytes : LineBytes),
  localparam int unsigned WriteBits = 8 * (WriteBytes < LineBytes ? WriteBytes : LineBytes)
) (
  input  logic                 clk_i,
  input  logic                 rst_ni,

  // Front end
  input  logic                 triangle_valid_i,
  output logic                 triangle_ready_o,
  input  screen_triangle_t     triangle_i,
  input  draw_state_t          state_i,

  // Fragment shader
  output logic                 beat_valid_o,
  input  logic                 beat_ready_i,
  output tested_beat_t         beat_o,
  input  logic                 late_valid_i,
  input  logic [TileQuads-1:0] [QuadMaskBits-1:0] late_keep_i,

  // Memory: see early_z
  output logic                 read_valid_o,
  input  logic                 read_ready_i,
  output logic [LineBits-1:0]  read_line_o,
  output logic                 read_half_o,
  output coded_shift_t         read_shift_o,
  input  logic                 fill_valid_i,
  input  logic [FillBits-1:0]  fill_data_i,
  output logic                 write_valid_o,
  input  logic                 write_ready_i,
  output logic [LineBits-1:0]  write_line_o,
  output logic                 write_half_o,
  output coded_shift_t         write_shift_o,
  output logic                 write_last_o,
  output logic [WriteBits-1:0] write_data_o,

  // Nothing is left to do. A clear or a flush is taken in such a cycle; done is high in the first cycle after it.
  output logic                 idle_o,
  input  logic                 clear_valid_i,
  input  logic [TileBits-1:0]  clear_first_i,
  input  logic [TileBits-1:0]  clear_last_i,
  input  logic [BlockBits-1:0] clear_first_block_i,
  input  logic [BlockBits-1:0] clear_last_block_i,
  output logic                 clear_done_o,
  input  logic                 flush_i,
  output logic                 flush_done_o,

  // What the stages spend the cycle on, by stage (raster_pkg), and the counters of it (cycle_counters), which stand
  // still in a cycle without count_i.
  output logic [StageCount-1:0] [ActivityBits-1:0]     activity_o,
  input  logic                                         count_i,
  input  logic [$clog2(StageCount+1)+ActivityBits-1:0] counter_select_i,
  output logic [CounterBits-1:0]                       counter_o
);

  logic setup_idle, block_idle, hi_z_idle, tile_idle, edge_idle, quad_idle, early_z_idle;
  logic walkers_idle, units_idle;
  setup_activity_e          setup_activity;
  block_walker_activity_e   block_activity;
  hi_z_activity_e           hi_z_activity;
  tile_walker_activity_e    tile_activity;
  edge_evaluator_activity_e edge_activity;
  quad_generator_activity_e quad_activity;
  z_lookup_activity_e       lookup_activity;
  z_test_activity_e         test_activity;
  interpolator_activity_e   interpolator_activity;

  logic            triangle_valid, triangle_ready;
  setup_triangle_t triangle;
  depth_equation_t equation;
  draw_state_t     state;

  setup #(
    .Conservative  (Conservative),
    .Uncertainty   (Uncertainty),
    .InnerCoverage (InnerCoverage),
    .QueueDepth    (SetupQueue),
    .FifoDepth     (SetupFifo),
    .Interval      (SetupInterval),
    .Interpolator  (Interpolator),
    .HiZ           (HiZ),
    .ThinLines     (ThinLines)
  ) u_setup (
    .clk_i            (clk_i),
    .rst_ni           (rst_ni),
    .triangle_valid_i (triangle_valid_i),
    .triangle_ready_o (triangle_ready_o),
    .triangle_i       (triangle_i),
    .state_i          (state_i),
    .triangle_valid_o (triangle_valid),
    .triangle_ready_i (triangle_ready),
    .triangle_o       (triangle),
    .equation_o       (equation),
    .state_o          (state),
    .activity_o       (setup_activity),
    .idle_o           (setup_idle)
  );

  logic                slot_write;
  logic [SlotBits-1:0] slot;
  depth_equation_t     slot_equation;
  draw_state_t         slot_state;
  logic                walked_valid, walked_ready;
  block_job_t          walked_job;

  block_walker #(
    .FifoDepth     (BlockFifo),
    .TrivialReject (TrivialReject),
    .SampleReject  (SampleReject),
    .Levels        (WalkLevels),
    .Order         (WalkOrder),
    .HiZ           (HiZ)
  ) u_block_walker (
    .clk_i            (clk_i),
    .rst_ni           (rst_ni),
    .triangle_valid_i (triangle_valid),
    .triangle_ready_o (triangle_ready),
    .triangle_i       (triangle),
    .equation_i       (equation),
    .state_i          (state),
    .slot_write_o     (slot_write),
    .slot_o           (slot),
    .slot_equation_o  (slot_equation),
    .slot_state_o     (slot_state),
    .block_valid_o    (walked_valid),
    .block_ready_i    (walked_ready),
    .block_o          (walked_job),
    .activity_o       (block_activity),
    .idle_o           (block_idle)
  );

  // What early_z keeps.
  logic                kept_write;
  logic [SlotBits-1:0] kept_slot;
  depth_equation_t     kept_equation;
  draw_state_t         kept_state;

  logic         block_valid, block_ready;
  block_job_t   block_job;
  logic         job_taken, job_burst, update_valid;
  hi_z_update_t update;

  if (HiZ) begin : gen_hi_z
    // A clear waits until hi_z has applied all jobs. Its part of it is done long before the next block: it takes no longer
    // than early_z's, since a surface has no more blocks than tiles, but for two cycles, and setup takes more.
    logic unused_clear_done;

    hi_z #(
      .FifoDepth    (HiZFifo),
      .Accept       (HiZAccept),
      .Bits         (HiZBits),
      .Lag          (HiZLag),
      .MemoryBlocks (MemoryBlocks),
      .ClearBlocks  (ClearTiles)
    ) u_hi_z (
      .clk_i           (clk_i),
      .rst_ni          (rst_ni),
      .slot_write_i    (slot_write),
      .slot_i          (slot),
      .slot_equation_i (slot_equation),
      .slot_state_i    (slot_state),
      .slot_write_o    (kept_write),
      .slot_o          (kept_slot),
      .slot_equation_o (kept_equation),
      .slot_state_o    (kept_state),
      .block_valid_i   (walked_valid),
      .block_ready_o   (walked_ready),
      .block_i         (walked_job),
      .block_valid_o   (block_valid),
      .block_ready_i   (block_ready),
      .block_o         (block_job),
      .job_valid_i     (job_taken),
      .job_burst_i     (job_burst),
      .update_valid_i  (update_valid),
      .update_i        (update),
      .drain_i         (clear_valid_i & walkers_idle & early_z_idle),
      .clear_i         (clear_valid_i & idle_o),
      .clear_first_i   (clear_first_block_i),
      .clear_last_i    (clear_last_block_i),
      .clear_done_o    (unused_clear_done),
      .forget_i        (flush_done_o),
      .activity_o      (hi_z_activity),
      .idle_o          (hi_z_idle)
    );
  end else begin : gen_no_hi_z
    assign kept_write    = slot_write;
    assign kept_slot     = slot;
    assign kept_equation = slot_equation;
    assign kept_state    = slot_state;
    assign block_valid   = walked_valid;
    assign walked_ready  = block_ready;
    assign block_job     = walked_job;
    assign hi_z_activity = HiZNoBlock;
    assign hi_z_idle     = 1'b1;

    logic unused_hi_z;
    assign unused_hi_z = ^{job_taken, job_burst, update_valid, update, clear_first_block_i,
                           clear_last_block_i};
  end

  logic      job_valid, job_ready;
  tile_job_t job;

  tile_walker #(
    .FifoDepth     (WalkerFifo),
    .TrivialAccept (TrivialAccept),
    .Order         (TileOrder)
  ) u_tile_walker (
    .clk_i         (clk_i),
    .rst_ni        (rst_ni),
    .block_valid_i (block_valid),
    .block_ready_o (block_ready),
    .block_i       (block_job),
    .job_valid_o   (job_valid),
    .job_ready_i   (job_ready),
    .job_o         (job),
    .activity_o    (tile_activity),
    .idle_o        (tile_idle)
  );

  logic      coverage_valid, coverage_ready;
  coverage_t coverage;

  edge_evaluator #(
    .PipeStages (PipeStages),
    .FifoDepth  (EdgeFifo)
  ) u_edge_evaluator (
    .clk_i            (clk_i),
    .rst_ni           (rst_ni),
    .job_valid_i      (job_valid),
    .job_ready_o      (job_ready),
    .job_i            (job),
    .coverage_valid_o (coverage_valid),
    .coverage_ready_i (coverage_ready),
    .coverage_o       (coverage),
    .activity_o       (edge_activity),
    .idle_o           (edge_idle)
  );

  logic       beat_valid, beat_ready;
  quad_beat_t beat;

  quad_generator #(
    .FifoDepth (QuadFifo)
  ) u_quad_generator (
    .clk_i            (clk_i),
    .rst_ni           (rst_ni),
    .coverage_valid_i (coverage_valid),
    .coverage_ready_o (coverage_ready),
    .coverage_i       (coverage),
    .beat_valid_o     (beat_valid),
    .beat_ready_i     (beat_ready),
    .beat_o           (beat),
    .job_taken_o      (job_taken),
    .job_burst_o      (job_burst),
    .activity_o       (quad_activity),
    .idle_o           (quad_idle)
  );

  assign walkers_idle = setup_idle & block_idle & tile_idle & edge_idle & quad_idle;
  assign units_idle   = walkers_idle & hi_z_idle;
  assign idle_o       = units_idle & early_z_idle;

  early_z #(
    .PendingDepth        (PendingDepth),
    .FifoDepth           (EarlyZFifo),
    .Interpolator        (Interpolator),
    .InterpolatorLatency (InterpolatorLatency),
    .Conservative        (Conservative),
    .Uncertainty         (Uncertainty),
    .InnerCoverage       (InnerCoverage),
    .Lines               (Lines),
    .Ways                (Ways),
    .MissesInFlight      (MissesInFlight),
    .WriteBuffers        (WriteBuffers),
    .ReadBytes           (ReadBytes),
    .WriteBytes          (WriteBytes),
    .ClearTiles          (ClearTiles),
    .MemoryTiles         (MemoryTiles),
    .HiZ                 (HiZ),
    .Compression         (Compression),
    .LateQueue           (LateZMode == 2 ? LateQueue : 0)
  ) u_early_z (
    .clk_i             (clk_i),
    .rst_ni            (rst_ni),
    .slot_write_i      (kept_write),
    .slot_i            (kept_slot),
    .slot_equation_i   (kept_equation),
    .slot_state_i      (kept_state),
    .beat_valid_i      (beat_valid),
    .beat_ready_o      (beat_ready),
    .beat_i            (beat),
    .beat_valid_o      (beat_valid_o),
    .beat_ready_i      (beat_ready_i),
    .beat_o            (beat_o),
    .late_valid_i      (late_valid_i),
    .late_keep_i       (late_keep_i),
    .update_valid_o    (update_valid),
    .update_o          (update),
    .read_valid_o      (read_valid_o),
    .read_ready_i      (read_ready_i),
    .read_line_o       (read_line_o),
    .read_half_o       (read_half_o),
    .read_shift_o      (read_shift_o),
    .fill_valid_i      (fill_valid_i),
    .fill_data_i       (fill_data_i),
    .write_valid_o     (write_valid_o),
    .write_ready_i     (write_ready_i),
    .write_line_o      (write_line_o),
    .write_half_o      (write_half_o),
    .write_shift_o     (write_shift_o),
    .write_last_o      (write_last_o),
    .write_data_o      (write_data_o),
    .idle_o            (early_z_idle),
    .clear_valid_i     (clear_valid_i & units_idle),
    .clear_first_i     (clear_first_i),
    .clear_last_i      (clear_last_i),
    .clear_done_o      (clear_done_o),
    .flush_i           (flush_i & units_idle),
    .flush_done_o      (flush_done_o),
    .lookup_activity_o (lookup_activity),
    .activity_o        (test_activity)
  );

  // No machine of the RTL has it yet.
  assign interpolator_activity = InterpolatorNoBurst;

  assign activity_o = {
    interpolator_activity, test_activity, lookup_activity, quad_activity, edge_activity,
    tile_activity, hi_z_activity, block_activity, setup_activity
  };

  cycle_counters #(
    .CounterBits (CounterBits)
  ) u_counters (
    .clk_i        (clk_i),
    .rst_ni       (rst_ni),
    .count_i      (count_i),
    .activity_i   (activity_o),
    .read_busy_i  (fill_valid_i),
    .write_busy_i (write_valid_o & write_ready_i),
    .select_i     (counter_select_i),
    .count_o      (counter_o)
  );

endmodule
