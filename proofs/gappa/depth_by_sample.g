# Depth of a sample of the strip: model/halfspace/scene/depth_plane_rows.cpp, depth().
# docs/numerics.md, Depth, Plane: "the depth of the plane there, a sum without loss that is rounded as
# doubles are".
# The exact depth is scaled to z in [1, 2], where a float32 has 2^-23; sum is 2A z. Its parts do not
# overlap, so adding them up loses 3 2^-53 at most (Shewchuk, see the code: by argument). Then 2A, a double,
# divides it.

sum = z * area2 * (1 + lost);
depth = float<53,-1000,ne>(sum / area2);
code = fixed<-23,ne>(depth);

{ z in [1,2] /\ area2 in [1,1b51] /\ |lost| <= 3b-53
  -> |depth - z| <= 1b-50 /\ |code - z| * 1b23 <= 0.50000001 }

depth - z -> (depth - sum / area2) + z * lost { area2 <> 0 };
