# How thin the strip is that holds depths below 2^-32 M: docs/numerics.md, Depth, Plane: "thinner than 2^-13
# of a pixel"; model/halfspace/scene/depth_by_sample.cpp, tiny_limit(). In units of M the largest vertex is
# 0.5 or more away from 0. It is no farther from a sample of the strip than the guard band is long, 65534
# pixels along x and y, less than 92680. Depth is linear in between.

slope = (0.5 - 1b-32) / distance; # at least so much for a pixel
strip = 2b-32 / slope;            # from -2^-32 to 2^-32

{ distance in [1b-9,92680] -> strip <= 0x1.7p-14 }
