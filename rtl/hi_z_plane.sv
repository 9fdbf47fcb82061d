// Between which words the plane of a triangle lies in each tile of a block, in two cycles: its corners of the first tile
// with the columns, and the rows; then their sums. Bit for bit tile_words() of model/halfspace/units/hi_z_plane.hpp.

module hi_z_plane
  import raster_pkg::*;
#(
  localparam int unsigned UnitBits = HiZWordBits - 16
) (
  input  logic       clk_i,

  // At the centre of the block's first pixel.
  input  logic       valid_i,
  input  hi_z_word_t z_i,
  input  hi_z_step_t dx_i,
  input  hi_z_step_t dy_i,

  // In the next cycle, combinational from registers.
  output logic [BlockTiles-1:0][UnitBits:0] least_o,
  output logic [BlockTiles-1:0][UnitBits:0] most_o
);

  localparam int unsigned RowTiles = BlockSize / TileSize;

  typedef logic signed [UnitBits:0] unit_t;

  localparam unit_t Margin = 18; // kHiZMargin

  hi_z_word_t dx, dy, down, up, to_least, to_most;

  assign dx       = hi_z_word_t'(dx_i);
  assign dy       = hi_z_word_t'(dy_i);
  assign down     = (dx_i[HiZStepBits-1] ? dx : '0) + (dy_i[HiZStepBits-1] ? dy : '0);
  assign up       = (dx_i[HiZStepBits-1] ? '0 : dx) + (dy_i[HiZStepBits-1] ? '0 : dy);
  assign to_least = (down <<< TileLog2) - down;
  assign to_most  = (up <<< TileLog2) - up;

  // Multiples by the constants below are shifts and adds.
  function automatic hi_z_word_t times(hi_z_word_t step, int unsigned tiles);
    hi_z_word_t product;
    product = '0;
    for (int unsigned bit_ = 0; bit_ < 3; bit_++) begin
      if (((tiles >> bit_) & 1) == 1) begin
        product += step <<< (TileLog2 + bit_);
      end
    end
    return product;
  endfunction

  hi_z_word_t least_q [RowTiles];
  hi_z_word_t most_q  [RowTiles];
  hi_z_word_t row_q   [RowTiles];

  for (genvar i = 0; i < RowTiles; i++) begin : gen_step
    always_ff @(posedge clk_i) begin
      if (valid_i) begin
        least_q[i] <= z_i + to_least + times(dx, i);
        most_q[i]  <= z_i + to_most + times(dx, i);
        row_q[i]   <= times(dy, i);
      end
    end
  end

  for (genvar i = 0; i < BlockTiles; i++) begin : gen_tile
    hi_z_word_t least, most;
    assign least      = least_q[i%RowTiles] + row_q[i/RowTiles];
    assign most       = most_q[i%RowTiles] + row_q[i/RowTiles];
    assign least_o[i] = unit_t'(signed'(least[HiZWordBits-1:16])) - Margin;
    assign most_o[i]  = unit_t'(signed'(most[HiZWordBits-1:16])) + Margin + unit_t'(1);

    logic unused_fraction;
    assign unused_fraction = ^{least[15:0], most[15:0]};
  end

endmodule
