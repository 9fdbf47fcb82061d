// The plane of depth on the walk over blocks, as hi_z wants it: moved like an edge, modulo 2^HiZWordBits.

module block_plane
  import raster_pkg::*;
  import walk_pkg::*;
#(
  /// As in block_edge.
  parameter int unsigned Levels = 2,
  parameter int unsigned Order = RasterWalk
) (
  input  logic            clk_i,

  // A triangle, at the first block of its walk.
  input  logic            load_i,
  input  hi_z_word_t      z_i,
  input  hi_z_step_t      dx_i,
  input  hi_z_step_t      dy_i,
  input  logic            known_i,

  input  logic            advance_i, // to the next block, at the end of the cycle
  input  logic            row_end_i, // the block is the last of its row
  input  walk_move_t      move_i,

  output hi_z_word_t      z_o,       // at the block's first pixel
  output hi_z_step_t      dx_o,
  output hi_z_step_t      dy_o,
  output logic            known_o
);

  hi_z_step_t dx_q, dy_q;
  logic       known_q;

  always_ff @(posedge clk_i) begin
    if (load_i) begin
      dx_q    <= dx_i;
      dy_q    <= dy_i;
      known_q <= known_i;
    end
  end

  if (Levels == 2 && Order == RasterWalk) begin : gen_raster
    // The value at the block, and at the first block of its row.
    hi_z_word_t here_q, row_q, along, down, next;

    assign along = here_q + (hi_z_word_t'(dx_q) <<< BlockLog2);
    assign down  = row_q + (hi_z_word_t'(dy_q) <<< BlockLog2);
    assign next  = row_end_i ? down : along;

    always_ff @(posedge clk_i) begin
      if (load_i) begin
        here_q <= z_i;
        row_q  <= z_i;
      end else if (advance_i) begin
        here_q <= next;
        if (row_end_i) begin
          row_q <= next;
        end
      end
    end
    assign z_o = here_q;

    logic unused_move;
    assign unused_move = ^move_i;
  end else begin : gen_walk
    walk_value #(
      .Width     ($bits(hi_z_word_t)),
      .SlopeBits ($bits(hi_z_step_t)),
      .Jumps     (jumps(Levels, Order))
    ) u_value (
      .clk_i     (clk_i),
      .load_i    (load_i),
      .value_i   (z_i),
      .dx_i      (dx_q),
      .dy_i      (dy_q),
      .advance_i (advance_i),
      .move_i    (move_i),
      .value_o   (z_o)
    );

    logic unused_row_end;
    assign unused_row_end = row_end_i;
  end

  assign dx_o    = dx_q;
  assign dy_o    = dy_q;
  assign known_o = known_q;

endmodule
