# The quotient of a gradient from a double: model/halfspace/units/depth_plane.cpp, gradient() of 64 bits.
# docs/numerics.md, Depth, Plane: "a true quotient ... cut towards zero". The double is less than 1 away
# from the quotient, so cut it is at most 1 off, which the remainder then puts right. n is the magnitude of
# the numerator, below 2^63; 2A is below 2^51, so exact as a double. An estimate of at most 2^50 means a
# quotient of at most 2^50 + 1.

double_n = float<ieee_64,ne>(n);
estimate = float<ieee_64,ne>(double_n * 4194304 / area2);
exact = n * 4194304 / area2;

{ n in [1,9223372036854775807] /\ area2 in [1,2251799813685247] /\ exact in [0,1125899906842625]
  -> |estimate - exact| <= 0.26 }

estimate - exact ->
  (estimate - double_n * 4194304 / area2) + ((double_n - n) / n) * exact { n <> 0, area2 <> 0 };
double_n * 4194304 / area2 -> (1 + (double_n - n) / n) * exact { n <> 0, area2 <> 0 };
