# Codes of barycentric depth on unorm surfaces: model/halfspace/units/z_test.cpp, interpolate_barycentric().
# docs/numerics.md, Depth, Barycentric: "The error is at most 0.551 units of a 24-bit code and 0.501 of a
# 16-bit one".
# z is the exact depth in units of a vertex depth, off what the weights move it by, relative to the range of
# the vertices. barycentric_unorm() cuts the sum to a whole number before the rounding to a code cuts again;
# one cut is the same (arguments.v, nested_cuts).

sum = z + range * off;
code24 = fixed<0,dn>((sum + offset + 64) * 1b-7);
code16 = fixed<0,dn>((sum + offset + 16384) * 1b-15);

{ range in [0,2147483520] /\ |off| <= 0x1.a1p-29 # barycentric_depth.g
  -> |code24 - (z + offset) * 1b-7| <= 0.551
  /\ |code16 - (z + offset) * 1b-15| <= 0.5002 }

code24 - (z + offset) * 1b-7 ->
  (code24 - (sum + offset + 64) * 1b-7 + 0.5) + range * off * 1b-7;
code16 - (z + offset) * 1b-15 ->
  (code16 - (sum + offset + 16384) * 1b-15 + 0.5) + range * off * 1b-15;
