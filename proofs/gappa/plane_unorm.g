# Codes of a plane on unorm surfaces: model/halfspace/units/z_test.cpp, interpolate_plane(), short words.
# docs/numerics.md, Depth, Plane: "the error is at most 0.5 + 0.168 codes" ... "No short word
# overflows": depths below kShortWordEnd (model/halfspace/numerics/depth.hpp) have one.
# z is the exact depth of the sample in units of a word, e the error of the word. What rounding adds to the
# vertices and the offset is in vertex_depth_unorm.g.

word = z + e;
code24 = fixed<0,dn>((word + offset + 64) * 1b-7);
code16 = fixed<0,dn>((word + offset + 16384) * 1b-15);

{ z in [0,2147483583] /\ |e| <= 21.5 # plane_word.g
  -> |code24 - (z + offset) * 1b-7| <= 0.66797
  /\ |code16 - (z + offset) * 1b-15| <= 0.50066
  /\ word in [-22,2147483647] }

code24 - (z + offset) * 1b-7 ->
  (code24 - (word + offset + 64) * 1b-7 + 0.5) + e * 1b-7;
code16 - (z + offset) * 1b-15 ->
  (code16 - (word + offset + 16384) * 1b-15 + 0.5) + e * 1b-15;
