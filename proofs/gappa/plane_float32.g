#@ -Eprecision=128
# Words of a plane on float32 surfaces: model/halfspace/units/float_parts.hpp, word_of_float(), and
# depth_plane.cpp, set_plane(). In units of 2^-63 M.
# docs/numerics.md, Depth, Plane: "cutting the vertices, less than a unit each, and weights add up to 1".
# z0 to z2 are the vertex depths, k0 to k2 the weights of a sample, e is the error of the word
# (plane_word.g). The largest float32 below M is 2^63 - 2^39. An offset is cut to a word, too, and M is
# above its magnitude.

cut0 = fixed<0,zr>(z0);
cut1 = fixed<0,zr>(z1);
cut2 = fixed<0,zr>(z2);
vertices = k0 * cut0 + k1 * cut1 + (1 - k0 - k1) * cut2;
exact = k0 * z0 + k1 * z1 + (1 - k0 - k1) * z2;
word = vertices + e;
sum = word + fixed<0,zr>(offset);

{ k0 in [0,1] /\ k1 in [0,1] /\ 1 - k0 - k1 in [0,1] /\ |e| <= 21.5
  /\ |z0| <= 9223371487098961920 /\ |z1| <= 9223371487098961920 /\ |z2| <= 9223371487098961920
  /\ |vertices| <= 9223371487098961920 # between the three
  /\ |offset| <= 9223371487098961920
  -> |word - exact| <= 22.5
  /\ |sum - (exact + offset)| <= 23.5
  /\ |sum - (exact + offset)| * 1b-63 <= 1b-58
  /\ word in [-9223372036854775808,9223372036854775807]
  /\ sum <= 18446744073709551615 }

word - exact -> (vertices - exact) + e;
vertices - exact -> -1 +
  (k0 * (cut0 - z0 + 1) + k1 * (cut1 - z1 + 1) + (1 - k0 - k1) * (cut2 - z2 + 1));
vertices - exact -> 1 -
  (k0 * (1 - (cut0 - z0)) + k1 * (1 - (cut1 - z1)) + (1 - k0 - k1) * (1 - (cut2 - z2)));
