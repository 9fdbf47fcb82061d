// Every adder of tile_walker, while it makes a tile job in every cycle.

module tile_walker_adders
  import raster_pkg::*;
(
  input logic       clk_i,
  input logic       rst_ni,
  input logic       block_valid_i,
  input block_job_t block_i,
  input logic       job_ready_i
);

  logic                  block_ready_o, job_valid_o, idle_o;
  tile_job_t             job_o;
  tile_walker_activity_e activity_o;
  tile_walker u_dut (.*);

  // proofs/coq/widths.v, edge_fits_closely: E at a sample of the guard band.
  localparam edge_t Close = edge_t'(1) <<< (2 * CoordBits);

  for (genvar i = 0; i < EdgeCount; i++) begin : gen_edge
    always_comb begin
      EdgeFits: assume (block_i.e[i] >= -Close && block_i.e[i] < Close);
    end
  end

  always_comb begin
    Busy: assume (rst_ni && u_dut.emit);

    LargestEdge: cover (u_dut.gen_edge[0].u_edge.block_q.e
                        == PixelEdgeBits'((Close - 1) >>> SubPixelBits));
  end

endmodule
