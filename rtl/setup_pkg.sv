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

endpackage : setup_pkg
