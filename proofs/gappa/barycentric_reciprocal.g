# The reciprocal of 2A: model/halfspace/units/depth_barycentric.cpp, set_reciprocal().
# docs/numerics.md, Depth, Barycentric: "R cost 2^-31 each" ... "cutting 2A gives at most 2^-31".
# v is 2A / 2^shift, a the same cut to 32 bits.

a = fixed<0,dn>(v);
r = fixed<0,dn>((1b63 - 1) / a);

{ v in [1b31,4294967296]
  -> r * v * 1b-63 - 1 in [-0x1.00000002p-31,1b-31] }

r * v * 1b-63 - 1 ->
  (v - a) / a - 1b-63 * (v / a) + (r - (1b63 - 1) / a) * v * 1b-63 { a <> 0 };
v / a -> 1 + (v - a) / a { a <> 0 };
