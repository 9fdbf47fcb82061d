// Every adder of block_walker in the cycle after it took a triangle: at any block, because E there may be that of any.

module block_walker_adders
  import raster_pkg::*;
#(
  parameter bit SampleReject = 1'b0
) (
  input logic            clk_i,
  input logic            rst_ni,
  input logic            triangle_valid_i,
  input setup_triangle_t triangle_i,
  input depth_equation_t equation_i,
  input draw_state_t     state_i,
  input logic            block_ready_i
);

  logic                   triangle_ready_o, slot_write_o, block_valid_o, idle_o;
  logic [SlotBits-1:0]    slot_o;
  depth_equation_t        slot_equation_o;
  draw_state_t            slot_state_o;
  block_job_t             block_o;
  block_walker_activity_e activity_o;
  block_walker #(
    .SampleReject (SampleReject)
  ) u_dut (.*);

  // proofs/coq/widths.v, edge_fits_closely: E at a sample of the guard band.
  localparam edge_t Close = edge_t'(1) <<< (2 * CoordBits);

  for (genvar i = 0; i < EdgeCount; i++) begin : gen_edge
    always_comb begin
      EdgeFits: assume (triangle_i.e[i] >= -Close && triangle_i.e[i] < Close);
    end
  end

  always_comb begin
    Loaded: assume (rst_ni && u_dut.load);
    // setup_cull: no triangle is drawn without a pixel.
    BoundsX: assume (triangle_i.x_first <= triangle_i.x_last);
    BoundsY: assume (triangle_i.y_first <= triangle_i.y_last);

    LargestEdge: cover (u_dut.gen_edge[0].u_edge.gen_raster.here_q
                        == PixelEdgeBits'((Close - 1) >>> SubPixelBits));
  end

endmodule
