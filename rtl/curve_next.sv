// The next cell of a curve that is in a rectangle, or its first: level by level, from the square of a power of two around
// the rectangle down to the cell.
//
// On the way to the cell where the walk is, each level may have a later quadrant that the rectangle touches; at the
// lowest such level the walk leaves the way, to the first of them, and below goes to the first quadrant of each level. A
// quadrant's column (row) is within the rectangle but where the way so far runs along its first or last column (row).

module curve_next #(
  parameter bit          Hilbert = 1'b0,
  parameter int unsigned CellBits = 9
) (
  input  logic [CellBits-1:0] x_first_i,
  input  logic [CellBits-1:0] x_last_i,
  input  logic [CellBits-1:0] y_first_i,
  input  logic [CellBits-1:0] y_last_i,

  input  logic                start_i, // the first of all; else the next after this one
  input  logic [CellBits-1:0] x_i,
  input  logic [CellBits-1:0] y_i,

  output logic [CellBits-1:0] x_o,
  output logic [CellBits-1:0] y_o,
  output logic                none_o   // there is no next
);

  typedef logic [CellBits-1:0] cell_t;

  // How the curve lies in the square of a level.
  typedef struct packed {
    logic turned;
    logic swapped;
  } turn_t;

  // Whether the way runs along the rectangle's first and last column and row.
  typedef struct packed {
    logic x_first;
    logic x_last;
    logic y_first;
    logic y_last;
  } along_t;

  typedef struct packed {
    logic x;
    logic y;
  } quadrant_t;

  function automatic quadrant_t quadrant(logic [1:0] position, turn_t turn);
    logic u, v;
    u = (Hilbert ? position[1] : position[0]) ^ turn.turned;
    v = (Hilbert ? position[1] ^ position[0] : position[1]) ^ turn.turned;
    return '{x: turn.swapped ? v : u, y: turn.swapped ? u : v};
  endfunction

  function automatic logic [1:0] position_of(quadrant_t at, turn_t turn);
    logic u, v;
    u = (turn.swapped ? at.y : at.x) ^ turn.turned;
    v = (turn.swapped ? at.x : at.y) ^ turn.turned;
    return Hilbert ? {u, u ^ v} : {v, u};
  endfunction

  // How it lies in a quadrant. Outside the square there is no curve yet.
  function automatic turn_t turn_in(turn_t turn, quadrant_t at, logic in_square);
    logic [1:0] position = position_of(at, turn);
    logic       turns = in_square & Hilbert;
    return '{
      turned:  turn.turned ^ (turns & (position == 2'd3)),
      swapped: turn.swapped ^ (turns & (position == 2'd0 || position == 2'd3))
    };
  endfunction

  // `ends`: the bits of the rectangle's ends at this level.
  function automatic along_t along_in(along_t along, quadrant_t at, along_t ends);
    return '{
      x_first: along.x_first & (at.x == ends.x_first),
      x_last:  along.x_last & (at.x == ends.x_last),
      y_first: along.y_first & (at.y == ends.y_first),
      y_last:  along.y_last & (at.y == ends.y_last)
    };
  endfunction

  // Whether a quadrant has a cell of the rectangle.
  function automatic logic touches(along_t along, quadrant_t at, along_t ends);
    return (at.x ? ~(along.x_last & ~ends.x_last) : ~(along.x_first & ends.x_first))
           & (at.y ? ~(along.y_last & ~ends.y_last) : ~(along.y_first & ends.y_first));
  endfunction

  along_t ends [CellBits];
  for (genvar l = 0; l < CellBits; l++) begin : gen_ends
    assign ends[l] = '{
      x_first: x_first_i[l], x_last: x_last_i[l], y_first: y_first_i[l], y_last: y_last_i[l]
    };
  end

  // In the square: the rectangle has more than one cell at this level.
  cell_t in_square;
  always_comb begin
    in_square = '0;
    for (int l = CellBits - 1; l >= 0; l--) begin
      in_square[l] = (x_first_i[l] != x_last_i[l]) | (y_first_i[l] != y_last_i[l])
                     | (l < CellBits - 1 ? in_square[(l+1)%CellBits] : 1'b0);
    end
  end

  // Levels at which the way to the cell has a later quadrant.
  cell_t later;
  always_comb begin
    automatic turn_t turn = '0;
    automatic along_t along = '1;
    later = '0;
    for (int l = CellBits - 1; l >= 0; l--) begin
      for (int unsigned p = 1; p < 4; p++) begin
        later[l] |= in_square[l] && 2'(p) > position_of('{x: x_i[l], y: y_i[l]}, turn)
                    && touches(along, quadrant(2'(p), turn), ends[l]);
      end
      along = along_in(along, '{x: x_i[l], y: y_i[l]}, ends[l]);
      turn  = turn_in(turn, '{x: x_i[l], y: y_i[l]}, in_square[l]);
    end
  end

  assign none_o = later == '0;

  // The lowest of them.
  cell_t lowest;
  assign lowest = later & (~later + cell_t'(1));

  always_comb begin
    automatic turn_t turn = '0;
    automatic along_t along = '1;
    automatic logic left = start_i; // the way
    automatic quadrant_t to = '0;
    x_o = '0;
    y_o = '0;
    for (int l = CellBits - 1; l >= 0; l--) begin
      to = '{x: x_i[l], y: y_i[l]};
      if (left | (lowest[l] & ~start_i)) begin
        // The last that is found is the first of the curve.
        for (int p = 3; p >= 0; p--) begin
          if (touches(along, quadrant(2'(p), turn), ends[l])
              && (left || 2'(p) > position_of('{x: x_i[l], y: y_i[l]}, turn))) begin
            to = quadrant(2'(p), turn);
          end
        end
      end
      left   = left | lowest[l];
      along  = along_in(along, to, ends[l]);
      turn   = turn_in(turn, to, in_square[l]);
      x_o[l] = to.x;
      y_o[l] = to.y;
    end
  end

endmodule
