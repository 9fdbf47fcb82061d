# A barycentric weight: model/halfspace/units/depth_barycentric.hpp, weight(), and .cpp, set_reciprocal().
# docs/numerics.md, Depth, Barycentric: "a weight is at most 0.88 2^-29 too small and 2^-31 too large".
# k is the exact weight E_i / 2A, v is 2A / 2^shift, e and a are the two as scale_weight() cuts them.
# Cutting 2A makes a weight larger, all other cuts make it smaller.

e = fixed<0,dn>(k * v);
a = fixed<0,dn>(v);
r = fixed<0,dn>((1b63 - 1) / a);
weight = fixed<-30,dn>(e * r * 1b-63);

{ k in [0,1] /\ v in [1b31,4294967296]
  -> weight - k in [-0x1.c1p-30,1b-31] } # 0x1.c1p-30 is 0.877 2^-29

e * r * 1b-63 - k ->
    k * (v - a) / a + (e - k * v) / a - (e / a) * 1b-63
  + (e / a) * a * (r - (1b63 - 1) / a) * 1b-63 { a <> 0 };
e / a -> k + k * (v - a) / a + (e - k * v) / a { a <> 0 };

$ a in (0x1.01p31,0x1.2p31,0x1.8p31);
