// The orders of block_walker and tile_walker, by the numbers of their keys, and how a walk moves.

package walk_pkg;
  import raster_pkg::*;

  // What the parameter WalkOrder chooses.
  localparam int unsigned RasterWalk = 0;
  localparam int unsigned BoustrophedonicWalk = 1;
  localparam int unsigned BacktrackingWalk = 2;
  localparam int unsigned ZigzagWalk = 3;
  localparam int unsigned MortonWalk = 4;
  localparam int unsigned HilbertWalk = 5;

  // What the parameter TileOrder chooses.
  localparam int unsigned RasterTiles = 0;
  localparam int unsigned BoustrophedonicTiles = 1;
  localparam int unsigned MortonTiles = 2;
  localparam int unsigned HilbertTiles = 3;

  // From the block of a step to that of the next, in rows: from here or from the entry, to a neighbour or not at all; in
  // jumps: how far the step's block is from the first of the bounds.
  typedef struct packed {
    logic from_entry;
    logic west;
    logic east;
    logic south;
    logic save; // the next block is the entry
    logic signed [BlockCoordBits:0] x;
    logic signed [BlockCoordBits:0] y;
  } walk_move_t;

  function automatic bit is_curve(int unsigned order);
    return order == MortonWalk || order == HilbertWalk;
  endfunction

  // The walk jumps, else it goes to neighbours.
  function automatic bit jumps(int unsigned levels, int unsigned order);
    return levels == 3 || is_curve(order);
  endfunction

  // The order within a superblock.
  function automatic int unsigned order_in_square(int unsigned order);
    return order == BoustrophedonicWalk ? BoustrophedonicTiles
           : order == MortonWalk        ? MortonTiles
           : order == HilbertWalk       ? HilbertTiles : RasterTiles;
  endfunction

  // Place n of a square of side x side: y * side + x.
  function automatic int unsigned place_in_order(int unsigned order, int unsigned side,
                                                 int unsigned n);
    int unsigned x, y, position, u, v;
    bit turned, swapped;
    if (order == RasterTiles) begin
      return n;
    end
    if (order == BoustrophedonicTiles) begin
      return (n / side) * side + ((n / side) % 2 == 0 ? n % side : side - 1 - n % side);
    end
    x = 0;
    y = 0;
    turned = 1'b0;
    swapped = 1'b0;
    for (int unsigned quarter = side * side / 4; quarter != 0; quarter = quarter / 4) begin
      position = (n / quarter) % 4;
      if (order == MortonTiles) begin
        u = position % 2;
        v = position / 2;
      end else begin
        u = (position / 2) ^ (turned ? 1 : 0);
        v = (position / 2) ^ (position % 2) ^ (turned ? 1 : 0);
      end
      x = 2 * x + (swapped ? v : u);
      y = 2 * y + (swapped ? u : v);
      turned  = turned ^ (order == HilbertTiles && position == 3);
      swapped = swapped ^ (order == HilbertTiles && (position == 0 || position == 3));
    end
    return y * side + x;
  endfunction
endpackage
