# What both weights together move z: model/halfspace/units/depth_barycentric.hpp, barycentric_unorm().
# docs/numerics.md, Depth, Barycentric: "together they move z by at most 0.82 2^-28 of the depth range".
# In units of the range: rise1 and rise2 are z1 - z0 and z2 - z0, and the exact depth less z0 is between
# them and 0, so in the range, too. The weights share the error of the reciprocal; two cuts are each
# weight's own.

e1 = fixed<0,dn>(k1 * v);
e2 = fixed<0,dn>(k2 * v);
a = fixed<0,dn>(v);
r = fixed<0,dn>((1b63 - 1) / a);
weight1 = fixed<-30,dn>(e1 * r * 1b-63);
weight2 = fixed<-30,dn>(e2 * r * 1b-63);

moved = weight1 * rise1 + weight2 * rise2;
exact = k1 * rise1 + k2 * rise2;
off = r * v * 1b-63 - 1; # error of the reciprocal, relative

{ k1 in [0,1] /\ k2 in [0,1] /\ v in [1b31,4294967296]
  /\ |rise1| <= 1 /\ |rise2| <= 1 /\ |exact| <= 1
  -> |moved - exact| <= 0x1.a1p-29 }

# Where r is too small, the error of the reciprocal acts on the whole way from z0; elsewhere on each weight.
moved - exact ->
    off * exact + r * 1b-63 * ((e1 - k1 * v) * rise1 + (e2 - k2 * v) * rise2)
  + (weight1 - e1 * r * 1b-63) * rise1 + (weight2 - e2 * r * 1b-63) * rise2;
moved - exact -> (weight1 - k1) * rise1 + (weight2 - k2) * rise2;
weight1 - k1 -> off * k1 + r * 1b-63 * (e1 - k1 * v) + (weight1 - e1 * r * 1b-63);
weight2 - k2 -> off * k2 + r * 1b-63 * (e2 - k2 * v) + (weight2 - e2 * r * 1b-63);
off ->
  (v - a) / a - 1b-63 * (v / a) + (r - (1b63 - 1) / a) * (a + (v - a)) * 1b-63 { a <> 0 };
v / a -> 1 + (v - a) / a { a <> 0 };

$ off in (0),
  a in (0x1.02p31,0x1.04p31,0x1.08p31,0x1.2p31,0x1.8p31);
