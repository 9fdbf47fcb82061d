#@ -Eprecision=128
# Numerators of gradients do not overflow 64 and 128 bits: model/halfspace/units/depth_plane.cpp,
# set_gradients() and gradient(). An edge's a and b are differences of two coordinates of the guard band; a
# short word is that of a vertex depth in [0, 1], a long one has 64 bits, and the rise of one 65.

short = rise1 * a1 + rise2 * a2;
long = (rise3 * a1 + rise4 * a2) * 4194304;

{ |a1| <= 16776704 /\ |a2| <= 16776704
  /\ |rise1| <= 2147483647 /\ |rise2| <= 2147483647
  /\ |rise3| <= 18446744073709551615 /\ |rise4| <= 18446744073709551615
  -> |short| <= 1b56 /\ |long| <= 1b111 }
