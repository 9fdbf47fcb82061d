// setup with the packets of each link side by side, as the bench's streams have them.

module setup_link
  import raster_pkg::*;
#(
  parameter int unsigned QueueDepth = 8,
  parameter int unsigned FifoDepth = 24,
  parameter int unsigned Interval = 1,
  parameter int unsigned Interpolator = 1,
  parameter bit HiZ = 1'b0,
  parameter int unsigned Conservative = 0,
  parameter int unsigned Uncertainty = 0,
  parameter bit ThinLines = 1'b0,
  // Bits of both links.
  localparam int unsigned InBits = $bits(screen_triangle_t) + $bits(draw_state_t),
  localparam int unsigned OutBits =
      $bits(setup_triangle_t) + $bits(depth_equation_t) + $bits(draw_state_t)
) (
  input  logic               clk_i,
  input  logic               rst_ni,

  input  logic               triangle_valid_i,
  output logic               triangle_ready_o,
  input  logic [InBits-1:0]  packet_i,

  output logic               triangle_valid_o,
  input  logic               triangle_ready_i,
  output logic [OutBits-1:0] packet_o
);

  screen_triangle_t triangle_in;
  draw_state_t      state_in, state_out;
  setup_triangle_t  triangle_out;
  depth_equation_t  equation_out;

  assign {triangle_in, state_in} = packet_i;
  assign packet_o = {triangle_out, equation_out, state_out};

  setup_activity_e unused_activity;
  logic            unused_idle;

  setup #(
    .QueueDepth   (QueueDepth),
    .FifoDepth    (FifoDepth),
    .Interval     (Interval),
    .Interpolator (Interpolator),
    .HiZ          (HiZ),
    .Conservative (Conservative),
    .Uncertainty  (Uncertainty),
    .ThinLines    (ThinLines)
  ) u_setup (
    .clk_i            (clk_i),
    .rst_ni           (rst_ni),
    .triangle_valid_i (triangle_valid_i),
    .triangle_ready_o (triangle_ready_o),
    .triangle_i       (triangle_in),
    .state_i          (state_in),
    .triangle_valid_o (triangle_valid_o),
    .triangle_ready_i (triangle_ready_i),
    .triangle_o       (triangle_out),
    .equation_o       (equation_out),
    .state_o          (state_out),
    .activity_o       (unused_activity),
    .idle_o           (unused_idle)
  );

endmodule
