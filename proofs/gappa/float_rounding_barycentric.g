# Rounding barycentric depth (barycentric_float32.g) to a float32, halves upwards:
# model/halfspace/units/float_parts.hpp, float_bits().
# docs/numerics.md, Depth: "The error is at most 0.52 units of the last place".
# The exact depth is scaled to z in [1, 2], where a unit of the last place is 2^-23; b is what is rounded.
# Floats below 1 and above 2 are 2^-24 and 2^-22 apart. The same of a subnormal depth y, whose unit is 1,
# with 2^-30 more for the cut of terms.

below = fixed<-24,dn>(b + 1b-25);
within = fixed<-23,dn>(b + 1b-24);
above = fixed<-22,dn>(b + 1b-23);
small = fixed<0,dn>(yb + 0.5);

{ z in [1,2] /\ |b - z| <= 0x1.41p-29
  /\ |yb - y| <= 0x1.42p-7
  -> (b <= 1 -> |below - z| * 1b23 <= 0.52)
  /\ |within - z| * 1b23 <= 0.52
  /\ (b >= 2 -> |above - z| * 1b23 <= 0.52)
  /\ |small - y| <= 0.52 }

below - z -> (below - (b + 1b-25) + 1b-25) + (b - z);
within - z -> (within - (b + 1b-24) + 1b-24) + (b - z);
small - y -> (small - (yb + 0.5) + 0.5) + (yb - y);
