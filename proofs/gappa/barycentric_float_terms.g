# The sum of the three products on float32 surfaces: model/halfspace/units/depth_barycentric.cpp, normalise() of
# an edge value and the cut of each product to the place of the largest one.
# docs/numerics.md, Depth, Barycentric: "a term loses 2^-31 of itself".
# e is E_i, m the same cut to 32 bits; z is a vertex depth, not negative.

m0 = float<32,-1000,dn>(e0);
m1 = float<32,-1000,dn>(e1);
m2 = float<32,-1000,dn>(e2);
cut = m0 * z0 + m1 * z1 + m2 * z2;
exact = e0 * z0 + e1 * z1 + e2 * z2;

{ e0 in [1,1b51] /\ e1 in [1,1b51] /\ e2 in [1,1b51] # one that is 0 adds nothing to either sum
  /\ z0 in [0,1b128] /\ z1 in [0,1b128] /\ z2 in [0,1b128]
  -> cut - exact <= 0 /\ cut - (1 - 1b-31) * exact >= 0 }

cut - exact -> (m0 - e0) * z0 + (m1 - e1) * z1 + (m2 - e2) * z2;
cut - (1 - 1b-31) * exact ->
  (m0 - (1 - 1b-31) * e0) * z0 + (m1 - (1 - 1b-31) * e1) * z1 + (m2 - (1 - 1b-31) * e2) * z2;
m0 - (1 - 1b-31) * e0 -> e0 * ((m0 - e0) / e0 + 1b-31) { e0 <> 0 };
m1 - (1 - 1b-31) * e1 -> e1 * ((m1 - e1) / e1 + 1b-31) { e1 <> 0 };
m2 - (1 - 1b-31) * e2 -> e2 * ((m2 - e2) / e2 + 1b-31) { e2 <> 0 };
