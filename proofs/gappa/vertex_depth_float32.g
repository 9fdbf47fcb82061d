# A vertex depth or an offset of a float32 surface is the float nearest to a double: half a unit of its last
# place. model/halfspace/numerics/depth.hpp, vertex_depth_code().
# docs/numerics.md, Depth: "A vertex depth is the rounded float"; Depth state: "or to a float32".
# Below 2^-125 the last place is 2^-149.

d32 = float<ieee_32,ne>(d);
t32 = float<ieee_32,ne>(t);

{ |d| in [1b-125,1b16] /\ |t| <= 1b-125
  -> d32 -/ d in [-1b-24,1b-24] /\ |t32 - t| <= 1b-150 }
