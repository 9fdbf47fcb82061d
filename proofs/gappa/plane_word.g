# The word of a plane: model/halfspace/units/depth_plane.cpp, gradient(), and depth_plane.hpp, tile_plane()
# and TilePlane::at(). In units of the last place of a word, before any reduction modulo 2^32 or 2^64.
# docs/numerics.md, Depth, Plane: the table of what the error is from.
# gx and gy are the exact gradients for a sub-pixel, z the word of vertex 0, nx and ny the sub-pixels from
# it to the first pixel of the 16 x 16 square, x and y the pixels from there, S = 2^s.

dx = fixed<-22,zr>(gx);
dy = fixed<-22,zr>(gy);
anchor = z + dx * nx + dy * ny;
origin = fixed<0,dn>(anchor + 0.5);
step_x = fixed<0,dn>(dx * S + 0.5);
step_y = fixed<0,dn>(dy * S + 0.5);
word = origin + x * step_x + y * step_y;

exact = z + gx * (nx + x * S) + gy * (ny + y * S);

{ x in [0,15] /\ y in [0,15] /\ |nx + x * S| <= 12582640 /\ |ny + y * S| <= 12582640 # plane_steps.g
  -> |word - exact| <= 21.5 }

word - exact ->
    (origin - (anchor + 0.5) + 0.5)
  + x * (step_x - (dx * S + 0.5) + 0.5) + y * (step_y - (dy * S + 0.5) + 0.5)
  + (dx - gx) * (nx + x * S) + (dy - gy) * (ny + y * S);
