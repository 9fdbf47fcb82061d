#@ -Eprecision=128
# Long words of unorm surfaces, where a vertex depth is outside [0, 1]:
# model/halfspace/units/depth_plane.hpp, word_of_unorm(), and z_test.cpp, interpolate_plane().
# docs/numerics.md, Depth state: "47 bits are left below 1, and the errors above are less than 2^-42".
# e <= 16, so a unit of a vertex depth is 2^(32 - e) >= 2^16 of a word, a word without error is 2^63 - 2^16
# at most, and a unit of a 24-bit code is 2^(39 - e) >= 2^23. z is the exact depth as a word, err the error
# of the word (plane_word.g), up is 2^e, unit that of a code in a word to the power of -1.

word = z + err;
code = fixed<0,dn>((word + offset) * unit + 0.5);

{ |z| <= 9223372036854710272 /\ |err| <= 21.5 /\ up in [1,65536] /\ unit in [0,1b-23]
  -> |err * 1b-63 * up| <= 1b-42
  /\ |code - (z + offset) * unit| <= 0.500003
  /\ word in [-9223372036854775808,9223372036854775807] }

code - (z + offset) * unit -> (code - ((word + offset) * unit + 0.5) + 0.5) + err * unit;
