# Barycentric depth of vertices outside [0, 1] on unorm surfaces:
# model/halfspace/units/depth_barycentric.hpp, barycentric_unorm(), `cut`.
# docs/numerics.md, Depth state: "Barycentric depths lose e + 1 bits instead".
# In units of 2^(e + 1) of a vertex depth, which is 2^(e - 30) of depth: z0 to z2 are the vertex depths, k0
# to k2 the weights of a sample, off what both weights move z by, relative to the rises
# (barycentric_depth.g), range the largest rise. A rise is that of cut depths, so a unit more than that of
# the depths.

cut0 = fixed<0,dn>(z0);
cut1 = fixed<0,dn>(z1);
cut2 = fixed<0,dn>(z2);
through = k0 * cut0 + k1 * cut1 + (1 - k0 - k1) * cut2;
exact = k0 * z0 + k1 * z1 + (1 - k0 - k1) * z2;
sum = through + (range + 1) * off;

{ k0 in [0,1] /\ k1 in [0,1] /\ 1 - k0 - k1 in [0,1]
  /\ |z0| <= 1073741823.75 /\ |z1| <= 1073741823.75 /\ |z2| <= 1073741823.75
  /\ |off| <= 0x1.a1p-29 /\ range in [0,2147483648]
  -> cut0 in [-1073741824,1073741823]
  /\ cut1 - cut0 in [-2147483648,2147483647]
  /\ sum - exact - range * off in [-1.000001,0.000001] }

sum - exact - range * off -> (through - exact) + off;
through - exact -> -1 +
  (k0 * (cut0 - z0 + 1) + k1 * (cut1 - z1 + 1) + (1 - k0 - k1) * (cut2 - z2 + 1));
through - exact ->
  k0 * (cut0 - z0) + k1 * (cut1 - z1) + (1 - k0 - k1) * (cut2 - z2);
