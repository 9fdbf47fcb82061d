// What the bench sees of the links inside the pipeline: which packets move in the cycle, and their bits.

module raster_pipeline_probe
  import raster_pkg::*;
(
  input logic            decide_i,
  input logic            accept_i,
  input logic            block_i,
  input logic            hi_z_i,
  input logic            block_done_i,
  input logic            emit_i,
  input logic            job_i,
  input logic            coverage_i,
  input logic            beat_i,
  input logic            first_beat_i,
  input logic            last_beat_i,
  input logic            test_first_i,
  input logic            test_last_i,
  input logic [2:0]      writes_i,
  input setup_triangle_t triangle_i,
  input depth_equation_t equation_i,
  input draw_state_t     state_i,
  input block_job_t      walked_job_i,
  input block_job_t      block_job_i,
  input tile_job_t       tile_job_i,
  input coverage_t       tile_coverage_i,
  input quad_beat_t      quad_beat_i
);

  // Above the events: how many lines enter the write buffer.
  logic [EventCount+2:0] events  /*verilator public_flat_rd*/;
  always_comb begin
    events = '0;
    events[EventDecide] = decide_i;
    events[EventAccept] = accept_i;
    events[EventBlock] = block_i;
    events[EventHiZ] = hi_z_i;
    events[EventBlockDone] = block_done_i;
    events[EventEmit] = emit_i;
    events[EventJob] = job_i;
    events[EventCoverage] = coverage_i;
    events[EventBeat] = beat_i;
    events[EventFirstBeat] = first_beat_i & beat_i;
    events[EventLastBeat] = last_beat_i & beat_i;
    events[EventTestFirst] = test_first_i;
    events[EventTestLast] = test_last_i;
    events[EventCount+:3] = writes_i;
  end

  logic [$bits(setup_triangle_t)-1:0] triangle  /*verilator public_flat_rd*/;
  logic [$bits(depth_equation_t)-1:0] equation  /*verilator public_flat_rd*/;
  logic [$bits(draw_state_t)-1:0]     state     /*verilator public_flat_rd*/;
  logic [$bits(block_job_t)-1:0]      walked_job /*verilator public_flat_rd*/;
  logic [$bits(block_job_t)-1:0]      block_job /*verilator public_flat_rd*/;
  logic [$bits(tile_job_t)-1:0]       tile_job  /*verilator public_flat_rd*/;
  logic [$bits(coverage_t)-1:0]       coverage  /*verilator public_flat_rd*/;
  logic [$bits(quad_beat_t)-1:0]      quad_beat /*verilator public_flat_rd*/;
  assign triangle  = triangle_i;
  assign equation  = equation_i;
  assign state     = state_i;
  assign walked_job = walked_job_i;
  assign block_job = block_job_i;
  assign tile_job  = tile_job_i;
  assign coverage  = tile_coverage_i;
  assign quad_beat = quad_beat_i;

endmodule

bind raster_pipeline raster_pipeline_probe u_probe (
  .decide_i        (setup_activity == raster_pkg::SetupBusy),
  .accept_i        (triangle_valid & triangle_ready),
  .block_i         (u_block_walker.emit),
  .hi_z_i          (HiZ & walked_valid & walked_ready),
  .block_done_i    (block_valid & block_ready),
  .emit_i          (u_tile_walker.emit),
  .job_i           (job_valid & job_ready),
  .coverage_i      (coverage_valid & coverage_ready),
  .beat_i          (beat_valid & beat_ready),
  .first_beat_i    (u_early_z.first),
  .last_beat_i     (beat.last),
  .test_first_i    (u_early_z.u_test.swap),
  .test_last_i     (u_early_z.burst_done),
  .writes_i        (3'(u_early_z.u_test.u_write_buffer.pushed)),
  .triangle_i      (triangle),
  .equation_i      (equation),
  .state_i         (state),
  .walked_job_i    (walked_job),
  .block_job_i     (block_job),
  .tile_job_i      (job),
  .tile_coverage_i (coverage),
  .quad_beat_i     (beat)
);
