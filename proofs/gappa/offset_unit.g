# One unit of polygon offset on unorm surfaces is a whole number of units of a word, 2^7 and 2^15:
# model/halfspace/scene/front_end.cpp, offset_unit(), and model/halfspace/numerics/depth.hpp,
# vertex_depth_code().
# docs/numerics.md, Depth state: "One unit of offset separates".

unit24 = float<ieee_64,ne>(1 / 16777215);
unit16 = float<ieee_64,ne>(1 / 65535);

{ fixed<0,ne>(float<ieee_64,ne>(unit24 * 2147483520)) - 128 in [0,0]
  /\ fixed<0,ne>(float<ieee_64,ne>(unit16 * 2147450880)) - 32768 in [0,0] }
