// Every adder of setup_cull, while it works on any triangle in every cycle.

module setup_cull_adders
  import raster_pkg::*;
  import setup_pkg::*;
(
  input logic             clk_i,
  input logic             rst_ni,
  input logic             valid_i,
  input screen_triangle_t triangle_i,
  input draw_state_t      state_i
);

  logic     valid_o;
  verdict_t verdict_o;
  screen_triangle_t triangle_o;
  setup_cull u_dut (.*);

  typedef logic signed [AreaBits+1:0] difference_t;
  difference_t area;
  assign area = difference_t'(u_dut.product_q.plus) - difference_t'(u_dut.product_q.minus);

  always_comb begin
    Busy: assume (rst_ni && valid_i);
    // proofs/coq/widths.v, edge_bound: the area is E of an edge at the third vertex.
    AreaFits: assume (area < difference_t'(1) <<< AreaBits
                      && area > -(difference_t'(1) <<< AreaBits));

    LargeArea: cover (area > (difference_t'(1) <<< AreaBits) - 4);
  end

endmodule
