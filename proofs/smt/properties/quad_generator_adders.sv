// Every adder of quad_generator, on any coverage, in any state.

module quad_generator_adders
  import raster_pkg::*;
(
  input logic      clk_i,
  input logic      rst_ni,
  input logic      coverage_valid_i,
  input coverage_t coverage_i,
  input logic      beat_ready_i
);

  logic                     coverage_ready_o, beat_valid_o, job_taken_o, job_burst_o, idle_o;
  quad_beat_t               beat_o;
  quad_generator_activity_e activity_o;
  quad_generator u_dut (.*);

  always_comb begin
    AllQuads: cover (u_dut.quads_q == '1);
  end

endmodule
