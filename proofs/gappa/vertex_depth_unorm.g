# A vertex depth of a unorm surface: model/halfspace/numerics/depth.hpp, vertex_depth_code().
# docs/numerics.md, Depth: "within 2^-8 of a unit of a 24-bit code".
# In units of a vertex depth, of which a 24-bit code has 2^7: half a unit. depth * one is rounded to a
# double first, which adds 2^-23 for a double in [0, 1], nothing for a float32, and 2^-8 below 2^15.

one24 = 2147483520; # (2^24 - 1) 2^7
one16 = 2147450880; # (2^16 - 1) 2^15

f = float<ieee_32,ne>(f_);
d = float<ieee_64,ne>(d_);
l = float<ieee_64,ne>(l_);

f24 = fixed<0,ne>(float<ieee_64,ne>(f * one24));
f16 = fixed<0,ne>(float<ieee_64,ne>(f * one16));
d24 = fixed<0,ne>(float<ieee_64,ne>(d * one24));
d16 = fixed<0,ne>(float<ieee_64,ne>(d * one16));
l24 = fixed<0,ne>(float<ieee_64,ne>(l * one24));

{ |d| <= 1 /\ |l| <= 1b15
  -> |f24 - f * one24| <= 0.5
  /\ |f16 - f * one16| <= 0.5
  /\ |d24 - d * one24| <= 0x1.000004p-1
  /\ |d16 - d * one16| <= 0x1.000004p-1
  /\ |l24 - l * one24| <= 0x1.02p-1 }
