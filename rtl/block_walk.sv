// Where a walk is that is not block by block in row order: which block, how much of it is in the bounds, which tiles the
// step looks at, and how the edges come to the next.
//
// A cell is a tile (one level), a block (two) or a superblock (three): row_cells or curve_cells give one a step. Of a
// superblock the first step finds the blocks that are left, and each of them has a step of its own. Bounds within one
// block need no such step.

module block_walk
  import raster_pkg::*;
  import walk_pkg::*;
#(
  parameter int unsigned Levels = 2,
  parameter int unsigned Order = RasterWalk,
  localparam int unsigned RowLog2 = BlockLog2 - TileLog2
) (
  input  logic                      clk_i,
  input  logic                      load_i,
  input  logic [PixelBits-1:0]      x_first_i,
  input  logic [PixelBits-1:0]      x_last_i,
  input  logic [PixelBits-1:0]      y_first_i,
  input  logic [PixelBits-1:0]      y_last_i,

  input  logic                      advance_i,    // to the next step, at the end of the cycle
  // Nothing of the triangle is left of the cell, in its row; right of it.
  input  logic                      none_left_i,
  input  logic                      none_right_i,
  // Tiles, or of a superblock blocks, inside all edges.
  input  logic [BlockTiles-1:0]     in_all_i,

  output logic                      pass_o,       // the step gives out nothing
  output logic                      last_o,       // the step is the last of the bounds
  // The step is that of a superblock; the block is its first.
  output logic                      superblock_o,
  output walk_move_t                move_o,

  output logic [BlockCoordBits-1:0] block_x_o,
  output logic [BlockCoordBits-1:0] block_y_o,
  output logic [RowLog2-1:0]        tile_x_o,     // with one level
  output logic [RowLog2-1:0]        tile_y_o,
  output logic [BlockLog2-1:0]      x_first_o,
  output logic [BlockLog2-1:0]      x_last_o,
  output logic [BlockLog2-1:0]      y_first_o,
  output logic [BlockLog2-1:0]      y_last_o,
  output logic [BlockTiles-1:0]     touched_o
);

  localparam int unsigned RowTiles = 1 << RowLog2;
  localparam int unsigned CellLog2 = Levels == 1   ? TileLog2
                                     : Levels == 2 ? BlockLog2 : BlockLog2 + RowLog2;
  localparam int unsigned CellBits = PixelBits - CellLog2;

  typedef logic [CellBits-1:0] cell_t;
  typedef logic [RowLog2-1:0] place_t;

  logic [PixelBits-1:0] x_first_q, x_last_q, y_first_q, y_last_q;

  always_ff @(posedge clk_i) begin
    if (load_i) begin
      x_first_q <= x_first_i;
      x_last_q  <= x_last_i;
      y_first_q <= y_first_i;
      y_last_q  <= y_last_i;
    end
  end

  // Cells.
  cell_t cell_x, cell_y;
  logic  cell_last, cell_pass, next_cell;

  if (is_curve(Order)) begin : gen_curve
    curve_cells #(
      .Hilbert  (Order == HilbertWalk),
      .CellBits (CellBits)
    ) u_cells (
      .clk_i     (clk_i),
      .load_i    (load_i),
      .x_first_i (x_first_i[PixelBits-1:CellLog2]),
      .x_last_i  (x_last_i[PixelBits-1:CellLog2]),
      .y_first_i (y_first_i[PixelBits-1:CellLog2]),
      .y_last_i  (y_last_i[PixelBits-1:CellLog2]),
      .advance_i (next_cell),
      .x_o       (cell_x),
      .y_o       (cell_y),
      .last_o    (cell_last)
    );
    assign cell_pass         = 1'b0;
    assign move_o.from_entry = 1'b0;
    assign move_o.west       = 1'b0;
    assign move_o.east       = 1'b0;
    assign move_o.south      = 1'b0;
    assign move_o.save       = 1'b0;

    logic unused_sides;
    assign unused_sides = none_left_i ^ none_right_i;
  end else begin : gen_rows
    row_cells #(
      .Order     (Order),
      .CellBits  (CellBits),
      .PlaceBits (Levels == 1 ? RowLog2 : 0)
    ) u_cells (
      .clk_i        (clk_i),
      .load_i       (load_i),
      .x_first_i    (x_first_i[PixelBits-1:CellLog2]),
      .x_last_i     (x_last_i[PixelBits-1:CellLog2]),
      .y_first_i    (y_first_i[PixelBits-1:CellLog2]),
      .y_last_i     (y_last_i[PixelBits-1:CellLog2]),
      .none_left_i  (none_left_i),
      .none_right_i (none_right_i),
      .advance_i    (next_cell),
      .x_o          (cell_x),
      .y_o          (cell_y),
      .pass_o       (cell_pass),
      .last_o       (cell_last),
      .from_entry_o (move_o.from_entry),
      .west_o       (move_o.west),
      .east_o       (move_o.east),
      .south_o      (move_o.south),
      .save_o       (move_o.save)
    );
  end

  // Blocks.
  logic [BlockTiles-1:0] chosen;

  if (Levels == 1) begin : gen_tiles
    assign {block_x_o, tile_x_o} = cell_x;
    assign {block_y_o, tile_y_o} = cell_y;
    assign chosen       = BlockTiles'(1) << {tile_y_o, tile_x_o};
    assign next_cell    = advance_i;
    assign pass_o       = cell_pass;
    assign last_o       = cell_last;
    assign superblock_o = 1'b0;
  end else if (Levels == 2) begin : gen_blocks
    assign block_x_o    = cell_x;
    assign block_y_o    = cell_y;
    assign tile_x_o     = '0;
    assign tile_y_o     = '0;
    assign chosen       = '1;
    assign next_cell    = advance_i;
    assign pass_o       = cell_pass;
    assign last_o       = cell_last;
    assign superblock_o = 1'b0;
  end else begin : gen_superblocks
    typedef struct packed {
      cell_t  superblock;
      place_t place;
    } in_superblock_t;

    in_superblock_t block_x, block_y, x_first, y_first;
    assign x_first = x_first_i[PixelBits-1:BlockLog2];
    assign y_first = y_first_i[PixelBits-1:BlockLog2];

    logic [BlockTiles-1:0] touched, found, left_q, pick, rest;
    logic                  alone, superblock_q;

    assign alone = x_first == x_last_i[PixelBits-1:BlockLog2]
                   && y_first == y_last_i[PixelBits-1:BlockLog2];

    logic [RowLog2-1:0] unused_x_first, unused_x_last, unused_y_first, unused_y_last;

    block_inside #(
      .PositionBits (BlockCoordBits),
      .SquareLog2 (RowLog2),
      .PlaceLog2  (0)
    ) u_blocks (
      .x_first_i  (x_first_q[PixelBits-1:BlockLog2]),
      .x_last_i   (x_last_q[PixelBits-1:BlockLog2]),
      .y_first_i  (y_first_q[PixelBits-1:BlockLog2]),
      .y_last_i   (y_last_q[PixelBits-1:BlockLog2]),
      .square_x_i (cell_x),
      .square_y_i (cell_y),
      .x_first_o  (unused_x_first),
      .x_last_o   (unused_x_last),
      .y_first_o  (unused_y_first),
      .y_last_o   (unused_y_last),
      .touched_o  (touched)
    );

    assign found = touched & in_all_i;

    ordered_pick #(
      .Side  (RowTiles),
      .Order (order_in_square(Order))
    ) u_pick (
      .set_i  (left_q),
      .pick_o (pick),
      .rest_o (rest)
    );

    logic done;
    assign done      = superblock_q ? found == '0 : rest == '0;
    assign next_cell = advance_i & done;
    assign last_o    = cell_last & done;

    always_ff @(posedge clk_i) begin
      if (load_i) begin
        superblock_q <= ~alone;
        left_q       <= BlockTiles'(1) << {y_first.place, x_first.place};
      end else if (advance_i) begin
        superblock_q <= done;
        left_q       <= superblock_q ? found : rest;
      end
    end

    assign block_x.superblock = cell_x;
    assign block_y.superblock = cell_y;
    always_comb begin
      block_x.place = '0;
      block_y.place = '0;
      for (int unsigned i = 0; i < BlockTiles; i++) begin
        if (pick[i] & ~superblock_q) begin
          block_x.place |= place_t'(i % RowTiles);
          block_y.place |= place_t'(i / RowTiles);
        end
      end
    end

    assign block_x_o    = block_x;
    assign block_y_o    = block_y;
    assign tile_x_o     = '0;
    assign tile_y_o     = '0;
    assign chosen       = '1;
    assign pass_o       = superblock_q;
    assign superblock_o = superblock_q;

    logic unused_pass;
    assign unused_pass = ^{cell_pass, x_first.superblock, y_first.superblock};
  end

  if (Levels != 3) begin : gen_no_superblocks
    logic unused_in_all;
    assign unused_in_all = ^in_all_i;
  end

  logic [BlockTiles-1:0] touched;

  block_inside u_inside (
    .x_first_i  (x_first_q),
    .x_last_i   (x_last_q),
    .y_first_i  (y_first_q),
    .y_last_i   (y_last_q),
    .square_x_i (block_x_o),
    .square_y_i (block_y_o),
    .x_first_o  (x_first_o),
    .x_last_o   (x_last_o),
    .y_first_o  (y_first_o),
    .y_last_o   (y_last_o),
    .touched_o  (touched)
  );

  assign touched_o = touched & chosen;

  // Signed, because a superblock may begin before the bounds.
  assign move_o.x = {1'b0, block_x_o} - {1'b0, x_first_q[PixelBits-1:BlockLog2]};
  assign move_o.y = {1'b0, block_y_o} - {1'b0, y_first_q[PixelBits-1:BlockLog2]};

endmodule
