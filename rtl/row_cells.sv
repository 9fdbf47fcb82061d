// The walk over the cells of a rectangle in rows: plain, back and forth, or led by the triangle. A cell is a tile of a
// block, or a block.
//
// The led walks are told on which sides of the cell, in its row, nothing of the triangle is; model/halfspace/units/
// cell_walk.hpp says what they make of it. The row begins at its entry, which follows the walk until the first cell of
// the triangle is found; the next row begins below it.

module row_cells
  import raster_pkg::*;
  import walk_pkg::*;
#(
  parameter int unsigned Order = RasterWalk,
  parameter int unsigned CellBits = 9,
  /// Cells of a block's row, as a power of two.
  parameter int unsigned PlaceBits = 0
) (
  input  logic                clk_i,
  input  logic                load_i,
  input  logic [CellBits-1:0] x_first_i,
  input  logic [CellBits-1:0] x_last_i,
  input  logic [CellBits-1:0] y_first_i,
  input  logic [CellBits-1:0] y_last_i,

  input  logic                none_left_i,
  input  logic                none_right_i,
  input  logic                advance_i, // to the next cell, at the end of the cycle

  output logic [CellBits-1:0] x_o,
  output logic [CellBits-1:0] y_o,
  output logic                pass_o,    // the step only leads the walk
  output logic                last_o,    // the cell is the last of the walk
  // From the cell's block to that of the next cell.
  output logic                from_entry_o,
  output logic                west_o,
  output logic                east_o,
  output logic                south_o,
  output logic                save_o
);

  typedef logic [CellBits-1:0] cell_t;

  typedef enum logic [1:0] {
    WayEntry,
    WayLeft,
    WayLeftThenRight,
    WayRight
  } way_e;

  cell_t x_first_q, x_last_q, y_last_q, x_q, y_q, entry_q;
  way_e  way_q, way, way_next;

  logic at_first, at_last, may_left, may_right;
  assign at_first  = x_q == x_first_q;
  assign at_last   = x_q == x_last_q;
  assign may_left  = ~none_left_i & ~at_first;
  assign may_right = ~none_right_i & ~at_last;

  logic left, right, down, from_entry, search;

  always_comb begin
    pass_o     = 1'b0;
    left       = 1'b0;
    right      = 1'b0;
    from_entry = 1'b0;
    search     = 1'b0;
    way        = way_q;
    if (Order == BoustrophedonicWalk) begin
      left  = way_q == WayLeft && !at_first;
      right = way_q != WayLeft && !at_last;
    end else if (Order == BacktrackingWalk) begin
      pass_o = way_q == WayEntry && may_left;
      left   = pass_o;
      way    = pass_o ? WayEntry : WayRight;
      right  = ~pass_o & may_right;
      search = pass_o | none_left_i;
    end else if (Order == ZigzagWalk) begin
      if (way_q == WayEntry) begin
        way = none_left_i ? WayRight : none_right_i ? WayLeft : WayLeftThenRight;
      end
      if (way == WayRight) begin
        right  = may_right;
        search = none_left_i;
      end else begin
        left       = may_left;
        search     = may_left & none_right_i;
        from_entry = ~may_left && way == WayLeftThenRight && entry_q != x_last_q;
        right      = from_entry;
        if (from_entry) begin
          way = WayRight;
        end
      end
    end else begin
      right = ~at_last;
    end
  end

  assign down     = ~left & ~right;
  assign way_next = !down                                              ? way
                    : Order == BoustrophedonicWalk && way_q != WayLeft ? WayLeft : WayEntry;

  // Back and forth goes down where it is, the others below the entry.
  assign from_entry_o = from_entry | (down && Order != BoustrophedonicWalk);
  assign save_o       = down | search;
  assign last_o       = down && y_q == y_last_q;
  assign x_o          = x_q;
  assign y_o          = y_q;

  cell_t base, x_next, y_next;
  assign base   = from_entry_o ? entry_q : x_q;
  assign x_next = left ? base - cell_t'(1) : right ? base + cell_t'(1) : base;
  assign y_next = down ? y_q + cell_t'(1) : y_q;

  if (PlaceBits == 0) begin : gen_blocks
    assign west_o  = left;
    assign east_o  = right;
    assign south_o = down;
  end else begin : gen_tiles
    assign west_o  = left & (base[PlaceBits-1:0] == '0);
    assign east_o  = right & (base[PlaceBits-1:0] == '1);
    assign south_o = down & (y_q[PlaceBits-1:0] == '1);
  end

  always_ff @(posedge clk_i) begin
    if (load_i) begin
      x_first_q <= x_first_i;
      x_last_q  <= x_last_i;
      y_last_q  <= y_last_i;
      x_q       <= x_first_i;
      y_q       <= y_first_i;
      entry_q   <= x_first_i;
      way_q     <= WayEntry;
    end else if (advance_i) begin
      x_q   <= x_next;
      y_q   <= y_next;
      way_q <= way_next;
      if (save_o) begin
        entry_q <= x_next;
      end
    end
  end

endmodule
