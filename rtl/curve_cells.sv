// The walk over the cells of a rectangle along a curve, a cell a step; cells outside the rectangle take none.

module curve_cells #(
  parameter bit          Hilbert = 1'b0,
  parameter int unsigned CellBits = 9
) (
  input  logic                clk_i,
  input  logic                load_i,
  input  logic [CellBits-1:0] x_first_i,
  input  logic [CellBits-1:0] x_last_i,
  input  logic [CellBits-1:0] y_first_i,
  input  logic [CellBits-1:0] y_last_i,

  input  logic                advance_i, // to the next cell, at the end of the cycle

  output logic [CellBits-1:0] x_o,
  output logic [CellBits-1:0] y_o,
  output logic                last_o     // the cell is the last of the walk
);

  typedef logic [CellBits-1:0] cell_t;

  cell_t x_first_q, x_last_q, y_first_q, y_last_q, x_q, y_q, x_start, y_start, x_next, y_next;

  // Morton's curve has the first corner of a rectangle before all other cells of it.
  if (Hilbert) begin : gen_start
    logic unused_none;
    curve_next #(
      .Hilbert  (1'b1),
      .CellBits (CellBits)
    ) u_start (
      .x_first_i (x_first_i),
      .x_last_i  (x_last_i),
      .y_first_i (y_first_i),
      .y_last_i  (y_last_i),
      .start_i   (1'b1),
      .x_i       (x_first_i),
      .y_i       (y_first_i),
      .x_o       (x_start),
      .y_o       (y_start),
      .none_o    (unused_none)
    );
  end else begin : gen_corner
    assign x_start = x_first_i;
    assign y_start = y_first_i;
  end

  curve_next #(
    .Hilbert  (Hilbert),
    .CellBits (CellBits)
  ) u_next (
    .x_first_i (x_first_q),
    .x_last_i  (x_last_q),
    .y_first_i (y_first_q),
    .y_last_i  (y_last_q),
    .start_i   (1'b0),
    .x_i       (x_q),
    .y_i       (y_q),
    .x_o       (x_next),
    .y_o       (y_next),
    .none_o    (last_o)
  );

  always_ff @(posedge clk_i) begin
    if (load_i) begin
      x_first_q <= x_first_i;
      x_last_q  <= x_last_i;
      y_first_q <= y_first_i;
      y_last_q  <= y_last_i;
      x_q       <= x_start;
      y_q       <= y_start;
    end else if (advance_i) begin
      x_q <= x_next;
      y_q <= y_next;
    end
  end

  assign x_o = x_q;
  assign y_o = y_q;

endmodule
