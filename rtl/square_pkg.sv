// Conservative rasterization: which pixels a triangle has, and how far their squares reach that decide; as
// model/halfspace/numerics/conservative.hpp has it.
//
// Where pixels are those whose centres are covered, all of this is 0 or an identity.

package square_pkg;

  import raster_pkg::*;

  // Which pixels triangles have that are drawn by squares: those that they touch, or those that they fill.
  parameter int unsigned Centres = 0;
  parameter int unsigned Outer = 1;
  parameter int unsigned Inner = 2;

  // |A| + |B| of an edge. A and B are less than 2^CoordBits in magnitude.
  typedef logic [StepBits-1:0] span_t;

  function automatic span_t span_of(step_t a, step_t b);
    return (a[StepBits-1] ? span_t'(-a) : span_t'(a)) + (b[StepBits-1] ? span_t'(-b) : span_t'(b));
  endfunction

  // From E at the centre of a square to where it decides: a corner, half a pixel and `uncertainty` sub-pixels away in x and
  // in y.
  function automatic edge_t to_square(span_t span, int unsigned conservative,
                                      int unsigned uncertainty);
    edge_t most; // a constant multiple: a shifted span for each bit that is set
    most = edge_t'({1'b0, span}) <<< (SubPixelBits - 1);
    for (int unsigned i = 0; i < SubPixelBits; i++) begin
      if (uncertainty[i]) begin
        most += edge_t'({1'b0, span}) <<< i;
      end
    end
    return conservative == Outer ? most : conservative == Inner ? -most : '0;
  endfunction

endpackage : square_pkg
