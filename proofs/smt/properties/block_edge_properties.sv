// block_edge: E moves from block to block by whole steps, exactly; and a tile is outside an edge exactly when its largest
// corner is.

module block_edge_properties
  import raster_pkg::*;
(
  input logic                 clk_i,
  input logic                 rst_ni,
  input logic                 load_i,
  input edge_t                edge_i,
  input step_t                a_i,
  input step_t                b_i,
  input logic                 advance_i,
  input logic                 row_end_i
);

  localparam int unsigned RowTiles = BlockSize / TileSize;
  typedef logic signed [EdgeBits+1:0] wide_t; // nothing below overflows

  edge_t                 e;
  step_t                 a, b;
  logic [BlockTiles-1:0] outside;

  block_edge u_dut (
    .clk_i     (clk_i),
    .load_i    (load_i),
    .edge_i    (edge_i),
    .a_i       (a_i),
    .b_i       (b_i),
    .samples_i (1'b0),
    .x_i       ('0),
    .y_i       ('0),
    .advance_i (advance_i),
    .row_end_i (row_end_i),
    .move_i    ('0),
    .tile_x_i  ('0),
    .tile_y_i  ('0),
    .superblock_i (1'b0),
    .edge_o    (e),
    .a_o       (a),
    .b_o       (b),
    .outside_o (outside)
  );

  // E at the block and at the first block of its row, and the steps, over integers.
  wide_t here_q, row_q, a_q, b_q, next;
  logic  loaded_q;

  assign next = row_end_i ? row_q + (b_q <<< (BlockLog2 + SubPixelBits))
                          : here_q + (a_q <<< (BlockLog2 + SubPixelBits));

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      loaded_q <= 1'b0;
    end else if (load_i) begin
      loaded_q <= 1'b1;
      here_q   <= wide_t'(edge_i);
      row_q    <= wide_t'(edge_i);
      a_q      <= wide_t'(a_i);
      b_q      <= wide_t'(b_i);
    end else if (advance_i) begin
      here_q <= next;
      if (row_end_i) row_q <= next;
    end
  end

  // proofs/coq/widths.v, edge_fits_closely, and increments.v: E at a sample of the guard band, whichever way it is reached.
  localparam wide_t Close = wide_t'(1) <<< (2 * CoordBits);

  wide_t pixel_e, rising, to_corner;
  assign pixel_e   = here_q >>> SubPixelBits;
  assign rising    = (a_q > 0 ? a_q : wide_t'(0)) + (b_q > 0 ? b_q : wide_t'(0));
  assign to_corner = (rising <<< TileLog2) - rising;

  // To tile i: the sum of the steps by the bits of i.
  wide_t down [RowTiles], across [RowTiles];
  assign down[0]   = '0;
  assign across[0] = '0;
  for (genvar i = 1; i < RowTiles; i++) begin : gen_sums
    localparam int unsigned Bit = $clog2(i + 1) - 1;
    assign down[i]   = down[i-(1<<Bit)] + (b_q <<< (TileLog2 + Bit));
    assign across[i] = across[i-(1<<Bit)] + (a_q <<< (TileLog2 + Bit));
  end

  for (genvar i = 0; i < RowTiles; i++) begin : gen_steps
    always_comb begin
      if (loaded_q) begin
        Down: assert (wide_t'(u_dut.gen_reject.down_q[i]) == down[i] + to_corner);
        Across: assert (wide_t'(u_dut.gen_reject.across_q[i]) == across[i]);
      end
    end
  end

  for (genvar y = 0; y < RowTiles; y++) begin : gen_row
    for (genvar x = 0; x < RowTiles; x++) begin : gen_tile
      always_comb begin
        // What is added to E: Down and Across.
        if (loaded_q) begin
          FollowsOutside: assert (outside[y*RowTiles+x]
              == (pixel_e + wide_t'(u_dut.gen_reject.down_q[y])
                  + wide_t'(u_dut.gen_reject.across_q[x]) < 0));
        end
      end
    end
  end

  always_comb begin
    EdgeFits: assume (wide_t'(edge_i) >= -Close && wide_t'(edge_i) < Close);
    BlockOnScreen: assume (!loaded_q || (here_q >= -Close && here_q < Close
                                         && row_q >= -Close && row_q < Close));

    if (loaded_q) begin
      EdgeAtBlock: assert (wide_t'(e) == here_q);
      EdgeAtRow: assert ((wide_t'(u_dut.gen_raster.row_q) <<< SubPixelBits)
                         + (here_q & ((wide_t'(1) <<< SubPixelBits) - 1)) == row_q);
      Steps: assert (wide_t'(a) == a_q && wide_t'(b) == b_q);
    end

    OutsideAll: cover (loaded_q && outside == '1 && a_q > 0 && b_q > 0);
    SecondRow: cover (loaded_q && here_q == row_q && advance_i && !row_end_i && outside != '0);
  end

endmodule
