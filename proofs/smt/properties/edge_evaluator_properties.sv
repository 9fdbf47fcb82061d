// edge_evaluator: after its registers the mask of a job is its bounds, and each edge where the job has no accept bit. What
// is inside an edge: half_plane.

module edge_evaluator_properties
  import raster_pkg::*;
#(
  parameter int unsigned PipeStages = 2
) (
  input logic      clk_i,
  input logic      rst_ni,
  input logic      job_valid_i,
  input tile_job_t job_i,
  input logic      coverage_ready_i
);

  logic                     job_ready, coverage_valid, idle;
  coverage_t                popped, coverage;
  edge_evaluator_activity_e activity;

  edge_evaluator #(
    .PipeStages (PipeStages)
  ) u_dut (
    .clk_i            (clk_i),
    .rst_ni           (rst_ni),
    .job_valid_i      (job_valid_i),
    .job_ready_o      (job_ready),
    .job_i            (job_i),
    .coverage_valid_o (coverage_valid),
    .coverage_ready_i (coverage_ready_i),
    .coverage_o       (popped),
    .activity_o       (activity),
    .idle_o           (idle)
  );

  // Before the register of the mask, where edges and tile meet.
  localparam int unsigned Latency = PipeStages < 2 ? PipeStages : 2;

  logic [Latency:0]      taken;
  tile_job_t [Latency:0] jobs;
  assign taken[0] = job_valid_i & job_ready;
  assign jobs[0]  = job_i;

  always_ff @(posedge clk_i) begin
    taken[Latency:1] <= rst_ni ? taken[Latency-1:0] : '0;
    jobs[Latency:1]  <= jobs[Latency-1:0];
  end

  tile_job_t j;
  assign j        = jobs[Latency];
  assign coverage = u_dut.coverage_d;

  for (genvar y = 0; y < TileSize; y++) begin : gen_row
    for (genvar x = 0; x < TileSize; x++) begin : gen_sample
      localparam int unsigned Sample = y * TileSize + x;
      logic covered;
      always_comb begin
        covered = x >= 32'(j.x_first) && x <= 32'(j.x_last)
                  && y >= 32'(j.y_first) && y <= 32'(j.y_last);
        for (int unsigned i = 0; i < EdgeCount; i++) begin
          covered &= j.accept[i] || u_dut.in_edge[i][Sample];
        end
        if (taken[Latency]) Mask: assert (coverage.mask[Sample] == covered);
      end
    end
  end

  always_comb begin
    ValidAfterLatency: assert (u_dut.steps_valid == taken[Latency]);
    if (taken[Latency]) begin
      Carried: assert (coverage.slot == j.slot && coverage.sure == j.sure
                       && coverage.tile_x == j.tile_x && coverage.tile_y == j.tile_y
                       && coverage.e == j.e[2:1]);
    end

    Whole: cover (taken[Latency] && coverage.mask == '1 && j.accept == '0);
    NoAccept: cover (taken[Latency] && coverage.mask == '0 && j.accept == 3'b011);
  end

endmodule
