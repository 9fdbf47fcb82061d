// What of a square is in the bounds, in its units and in the places that these touch: of a block pixels and tiles, of a
// superblock blocks and blocks.

module block_inside
  import raster_pkg::*;
#(
  /// Of a coordinate.
  parameter int unsigned PositionBits = PixelBits,
  /// Sides of the square and of a place, as powers of two.
  parameter int unsigned SquareLog2 = BlockLog2,
  parameter int unsigned PlaceLog2 = TileLog2,
  localparam int unsigned SquareBits = PositionBits - SquareLog2,
  localparam int unsigned RowPlaces = 1 << (SquareLog2 - PlaceLog2)
) (
  input  logic [PositionBits-1:0]           x_first_i,
  input  logic [PositionBits-1:0]           x_last_i,
  input  logic [PositionBits-1:0]           y_first_i,
  input  logic [PositionBits-1:0]           y_last_i,

  input  logic [SquareBits-1:0]          square_x_i,
  input  logic [SquareBits-1:0]          square_y_i,

  // What is in the bounds, and the places that it touches.
  output logic [SquareLog2-1:0]          x_first_o,
  output logic [SquareLog2-1:0]          x_last_o,
  output logic [SquareLog2-1:0]          y_first_o,
  output logic [SquareLog2-1:0]          y_last_o,
  output logic [RowPlaces*RowPlaces-1:0] touched_o
);

  typedef logic [SquareLog2-PlaceLog2-1:0] place_t;
  typedef logic [RowPlaces-1:0] row_t;

  // A coordinate, taken apart.
  typedef struct packed {
    logic [SquareBits-1:0] square;
    logic [SquareLog2-1:0] place;
  } in_square_t;

  in_square_t x_first, x_last, y_first, y_last;
  assign x_first = x_first_i;
  assign x_last  = x_last_i;
  assign y_first = y_first_i;
  assign y_last  = y_last_i;

  assign x_first_o = square_x_i == x_first.square ? x_first.place : '0;
  assign x_last_o  = square_x_i == x_last.square ? x_last.place : '1;
  assign y_first_o = square_y_i == y_first.square ? y_first.place : '0;
  assign y_last_o  = square_y_i == y_last.square ? y_last.place : '1;

  // The places in a row or column from first to last; RowPlaces - 1 - last is ~last.
  function automatic row_t from_to(place_t first, place_t last);
    row_t all = '1;
    return (all << first) & (all >> ~last);
  endfunction

  row_t columns, rows;
  assign columns = from_to(x_first_o[SquareLog2-1:PlaceLog2], x_last_o[SquareLog2-1:PlaceLog2]);
  assign rows    = from_to(y_first_o[SquareLog2-1:PlaceLog2], y_last_o[SquareLog2-1:PlaceLog2]);

  for (genvar y = 0; y < RowPlaces; y++) begin : gen_touched
    assign touched_o[y*RowPlaces+:RowPlaces] = columns & {RowPlaces{rows[y]}};
  end

endmodule
