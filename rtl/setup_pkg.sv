// What the stages of setup pass to each other.

package setup_pkg;

  import raster_pkg::*;

  // Twice the area of a triangle of the guard band: at most the square of the band's side, 2^CoordBits - 1.
  parameter int unsigned AreaBits = 2 * CoordBits;

  typedef logic [AreaBits-1:0] area_t;

  // Pixels of which the bounding box may hold a sample, and that the scissor and the target hold; both ends belong to them.
  typedef struct packed {
    logic [PixelBits-1:0] x_first;
    logic [PixelBits-1:0] x_last;
    logic [PixelBits-1:0] y_first;
    logic [PixelBits-1:0] y_last;
  } bounds_t;

  // A triangle with its verdict. The rest means something where it is drawn: vertices in positive order from the
  // topmost, then leftmost; area2 is positive.
  typedef struct packed {
    logic             drawn;
    screen_triangle_t triangle;
    area_t            area2;
    bounds_t          bounds;
    draw_state_t      state;
  } verdict_t;

  // LineRule of model/halfspace/numerics/line_rule.hpp, by its numbers; 0 is a triangle.
  typedef enum logic [LineRuleBits-1:0] {
    LineNone = 0,
    LineBresenham = 1,
    LineDiamondExit = 2,
    LineMidpoint = 3,
    LineDda = 4
  } line_rule_e;

  // Rules of lines from the centre of a pixel to that of another.
  function automatic logic joins_pixels(line_rule_e rule);
    return rule == LineMidpoint || rule == LineDda;
  endfunction

  // What line_columns finds out about a thin line, for its edges.
  typedef struct packed {
    logic x_major;
    logic left;    // the end is left of the start
    logic up;      // the end is above the start
    logic ties_up; // half-way between two pixels it takes the one of larger v
  } line_t;

  // Fraction bits of the slope of a DDA line.
  parameter int unsigned SlopeBits = 16;

  // The depth of a line is that of a triangle with a third vertex a pixel beside its start, towards 0. Whether the area of
  // start, end and that vertex is negative; of the start only on which side of 0 it is counts.
  function automatic logic line_is_turned(logic x_major, logic left, logic up, logic x_negative,
                                          logic y_negative);
    return x_major ? left == y_negative : up != x_negative;
  endfunction

  // A pixel nearer to 0, so inside the guard band.
  function automatic coord_t towards_zero(coord_t c);
    localparam coord_t One = coord_t'({2'b01, {SubPixelBits{1'b0}}});
    return c[CoordBits-1] ? c + One : c - One;
  endfunction

endpackage : setup_pkg
