// Every adder of edge_evaluator, while it takes any job at all in every cycle.

module edge_evaluator_adders
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

  logic                     job_ready_o, coverage_valid_o, idle_o;
  coverage_t                coverage_o;
  edge_evaluator_activity_e activity_o;
  edge_evaluator #(
    .PipeStages (PipeStages)
  ) u_dut (.*);

  always_comb begin
    Busy: assume (rst_ni && u_dut.job_accepted);

    Saturated: cover (u_dut.gen_edge[0].u_half_plane.row_d[0]
                      == (LocalEdgeBits'(TileSize) <<< StepBits) - 1);
  end

endmodule
