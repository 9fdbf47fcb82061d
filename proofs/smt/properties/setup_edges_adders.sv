// Every adder of setup_edges, while it works on any triangle in every cycle.

module setup_edges_adders
  import raster_pkg::*;
  import setup_pkg::*;
(
  input logic                    clk_i,
  input logic                    rst_ni,
  input logic                    valid_i,
  input logic [2:0] [CoordBits-1:0] x_i,
  input logic [2:0] [CoordBits-1:0] y_i,
  input area_t                   area2_i,
  input logic [PixelBits-1:0]    x_first_i,
  input logic [PixelBits-1:0]    y_first_i,
  input logic [FillRuleBits-1:0] fill_rule_i
);

  logic        by_square_i;
  assign by_square_i = 1'b0;

  logic        valid_o;
  edge_t [2:0] e_o;
  step_t [2:0] a_o, b_o;
  logic [2:0]  bias_o;
  setup_edges u_dut (.*);

  // proofs/coq/widths.v, edge_fits_closely.
  localparam int unsigned CloseBits = 2 * CoordBits + 1;

  for (genvar i = 0; i < 2; i++) begin : gen_edge
    localparam edge_t Product = edge_t'(1) <<< (2 * StepBits - 2);
    localparam edge_t Close = edge_t'(1) <<< (CloseBits - 1);
    always_comb begin
      // Of two numbers of StepBits: lemmas/corner.smt2.
      AcrossFits: assume (u_dut.products_q.across[i] >= -Product
                          && u_dut.products_q.across[i] <= Product);
      DownFits: assume (u_dut.products_q.down[i] >= -Product
                        && u_dut.products_q.down[i] <= Product);
      EdgeFits: assume (u_dut.sums_q.e[i] >= -Close && u_dut.sums_q.e[i] < Close);
    end
  end

  always_comb begin
    Busy: assume (rst_ni && valid_i);

    FarApart: cover (u_dut.steps_q.a[0] == {1'b1, {(StepBits-2){1'b0}}, 1'b1});
  end

endmodule
