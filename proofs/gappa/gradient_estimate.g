# The quotient of a gradient from a double: model/halfspace/units/depth_plane.cpp, gradient() of 64 bits.
# docs/numerics.md, Depth, Plane: "a true quotient ... cut towards zero". The double is less than 1 away from the
# quotient, so cut it is at most 1 off, which the remainder then puts right.
# n is the magnitude of the numerator, below 2^63; 2A is below 2^51, so exact as a double.

estimate = float<ieee_64,ne>(float<ieee_64,ne>(n) * 4194304 / area2);
exact = n * 4194304 / area2;
off = (estimate - exact) / exact;

{ n in [1,9223372036854775807] /\ area2 in [1,2251799813685247] /\ estimate in [0,1b50]
  -> |estimate - exact| <= 0.251 }

estimate - exact -> off * estimate / (1 + off) { n <> 0, area2 <> 0, 1 + off <> 0 };
