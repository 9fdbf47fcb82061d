# Barycentric depth on float32 surfaces before it is rounded: model/halfspace/units/depth_barycentric.cpp,
# barycentric_float(), from the sum of the terms on.
# docs/numerics.md, Depth, Barycentric: "The error is at most 0.52 units of the last place".
# Scales are such that the sum has its top bit at bit 31, as 2A has: v is 2A / 2^shift. z is the exact
# depth, lost what the terms lose (barycentric_float_terms.g) and 2^-53 for the cut of two of them to the
# place of the third.

a = fixed<0,dn>(v);
r = fixed<0,dn>((1b63 - 1) / a);
m = fixed<0,dn>(sum);
depth = m * r * 1b-63;
x = sum / v;
z = x * lost;

{ v in [1b31,4294967296] /\ sum in [1b31,4294967296] /\ lost in [1,0x1.000000020001p0] # 1 + 2^-31 + 2^-48
  -> (z in [0.5,1] -> |depth - z| <= 0x1.41p-30)
  /\ (z in [1,2.1] -> |depth - z| <= 0x1.41p-29) }

depth - z ->
    (m - sum) / a + x * (v - a) / a - (m / a) * 1b-63
  + (m / a) * a * (r - (1b63 - 1) / a) * 1b-63 + x * (1 - lost) { a <> 0, v <> 0 };
m / a -> x + x * (v - a) / a + (m - sum) / a { a <> 0, v <> 0 };

$ a in (0x1.01p31,0x1.8p31);
