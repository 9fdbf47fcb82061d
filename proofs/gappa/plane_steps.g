# Sub-pixels between vertex 0 and a sample, along x or y: model/halfspace/units/depth_plane.hpp,
# from_vertex.
# docs/numerics.md, Depth, Plane: "for fewer than 1.5 2^23 steps from vertex 0".
# A pixel is on a screen of at most 2^14 pixels, a vertex inside the guard band; S = 2^s. A sample of the
# pixel is up to 15/16 from its first side.

steps = (pixel + sample - vertex) * S;

{ pixel in [0,16383] /\ sample in [0,0.9375] /\ vertex in [-32767,32767] /\ S in [16,256]
  -> steps in [-8388352,12582640] }
