# The sum of the three products on float32 surfaces: model/halfspace/units/depth_barycentric.cpp,
# normalise() of the edge values.
# docs/numerics.md, Depth, Barycentric: "cutting the three E_i to 32 bits".
# e is E_i as normalise() scales it, before the cut, and y the vertex depth, not negative, times the power
# of two that undoes the scale. An E_i that is 0 adds nothing to either sum.

cut = fixed<0,dn>(e0) * y0 + fixed<0,dn>(e1) * y1 + fixed<0,dn>(e2) * y2;
exact = e0 * y0 + e1 * y1 + e2 * y2;

{ e0 in [1b31,1b32] /\ e1 in [1b31,1b32] /\ e2 in [1b31,1b32]
  /\ y0 in [0,1b200] /\ y1 in [0,1b200] /\ y2 in [0,1b200]
  -> cut - exact <= 0 /\ cut - (1 - 1b-31) * exact >= 0 }

cut - exact -> (fixed<0,dn>(e0) - e0) * y0 + (fixed<0,dn>(e1) - e1) * y1 + (fixed<0,dn>(e2) - e2) * y2;
cut - (1 - 1b-31) * exact ->
    (fixed<0,dn>(e0) - e0 + 1b-31 * e0) * y0
  + (fixed<0,dn>(e1) - e1 + 1b-31 * e1) * y1
  + (fixed<0,dn>(e2) - e2 + 1b-31 * e2) * y2;
