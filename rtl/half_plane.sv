// One edge in one tile: from its value at the tile origin to the pixels inside it, over the stages of
// edge_evaluator.

module half_plane
  import raster_pkg::*;
#(
  /// 1: a register after saturation.
  parameter bit CutSaturated = 1'b1,
  /// 1: a register after the row and column adders.
  parameter bit CutSteps = 1'b1
) (
  input  logic                clk_i,
  input  logic                saturated_valid_i,  // what enters the first register is of use
  input  logic                steps_valid_i,      // what enters the second register is of use
  input  edge_t               edge_i,
  input  step_t               a_i,
  input  step_t               b_i,
  output logic [MaskBits-1:0] inside_o
);

  typedef logic signed [LocalEdgeBits-2:0] saturated_t;
  typedef logic signed [LocalEdgeBits-1:0] local_t;

  saturated_t origin_d, origin_q;
  step_t      a_q, b_q;
  local_t     row_d [TileSize], row_q [TileSize];
  local_t     column_d [TileSize], column_q [TileSize];

  edge_saturate u_saturate (
    .edge_i   (edge_i),
    .origin_o (origin_d)
  );

  if (CutSaturated) begin : gen_cut_saturated
    always_ff @(posedge clk_i) begin
      if (saturated_valid_i) begin
        origin_q <= origin_d;
        a_q      <= a_i;
        b_q      <= b_i;
      end
    end
  end else begin : gen_no_cut_saturated
    logic unused_saturated;
    assign unused_saturated = ^{clk_i, saturated_valid_i};
    assign origin_q = origin_d;
    assign a_q      = a_i;
    assign b_q      = b_i;
  end

  edge_steps u_steps (
    .origin_i (origin_q),
    .a_i      (a_q),
    .b_i      (b_q),
    .row_o    (row_d),
    .column_o (column_d)
  );

  logic signs_valid;

  if (CutSteps) begin : gen_cut_steps
    logic signs_valid_q;

    always_ff @(posedge clk_i) begin
      signs_valid_q <= steps_valid_i;
    end

    assign signs_valid = signs_valid_q;

    always_ff @(posedge clk_i) begin
      if (steps_valid_i) begin
        row_q    <= row_d;
        column_q <= column_d;
      end
    end
  end else begin : gen_no_cut_steps
    logic unused_steps;
    assign unused_steps = clk_i;
    assign signs_valid = steps_valid_i;
    assign row_q    = row_d;
    assign column_q = column_d;
  end

  edge_signs u_signs (
    .valid_i  (signs_valid),
    .row_i    (row_q),
    .column_i (column_q),
    .inside_o (inside_o)
  );

endmodule
