# Barycentric depth on float32 surfaces where vertex depths have both signs, or an offset is added:
# model/halfspace/units/depth_barycentric.cpp, barycentric_float().
# docs/numerics.md, Depth state: "where depths of both signs cancel, the error of the barycentric sum is
# absolute".
# In units of the largest magnitude of a vertex depth. k0 to k2 are the weights of a sample, cut0 to cut2
# what a term loses of itself (barycentric_float_terms.g), lost what all lose to the place of the
# largest one, m_off what the sum loses of itself, r_off the error of the reciprocal
# (barycentric_reciprocal.g).

k2 = 1 - k0 - k1;
sum = k0 * z0 * (1 - cut0) + k1 * z1 * (1 - cut1) + k2 * z2 * (1 - cut2) - lost;
exact = k0 * z0 + k1 * z1 + k2 * z2;
depth = sum * (1 - m_off) * (1 + r_off);

{ k0 in [0,1] /\ k1 in [0,1] /\ k2 in [0,1]
  /\ |z0| <= 1 /\ |z1| <= 1 /\ |z2| <= 1 /\ |exact| <= 1
  /\ cut0 in [0,1b-31] /\ cut1 in [0,1b-31] /\ cut2 in [0,1b-31] /\ |lost| <= 1b-53
  /\ m_off in [0,1b-31] /\ r_off in [-0x1.00000002p-31,1b-31]
  -> |depth - exact| <= 0x1.80001p-30 }

depth - exact -> (sum - exact) + sum * ((1 - m_off) * (1 + r_off) - 1);
(1 - m_off) * (1 + r_off) - 1 -> r_off - m_off - m_off * r_off;
sum - exact -> -1b-31 - lost
  + (k0 * (1b-31 - z0 * cut0) + k1 * (1b-31 - z1 * cut1) + k2 * (1b-31 - z2 * cut2));
sum - exact -> 1b-31 - lost
  - (k0 * (1b-31 + z0 * cut0) + k1 * (1b-31 + z1 * cut1) + k2 * (1b-31 + z2 * cut2));
