# Rounding to a float32, halves upwards, after an error: model/halfspace/units/float_parts.hpp, float_bits().
# docs/numerics.md, Depth: 0.52 units of the last place (Barycentric) and 0.59 units (Plane).
# The exact depth is scaled to z in [1, 2], where a unit of the last place is 2^-23; b is off by the error of
# barycentric depth (barycentric_float32.g), p by that of the plane where z >= 2^-32 M (plane_float32.g). The
# same of a subnormal depth y, whose unit is 1, with 2^-30 more for the cut of barycentric terms.

barycentric = float<24,-200,nu>(b);
plane = float<24,-200,nu>(p);
small_barycentric = fixed<0,nu>(yb);
small_plane = fixed<0,nu>(yp);

{ z in [1,2] /\ |b - z| <= 0x1.41p-29 /\ |p - z| <= 45b-32
  /\ |yb - y| <= 0x1.42p-7 /\ |yp - y| <= 45b-9
  -> |barycentric - z| * 1b23 <= 0.52
  /\ |plane - z| * 1b23 <= 0.588
  /\ |small_barycentric - y| <= 0.52
  /\ |small_plane - y| <= 0.588 }

$ b in (1,2), p in (1,2);
