#@ -Eprecision=128
# Words of barycentric depth that must not overflow: model/halfspace/units/depth_barycentric.hpp and .cpp.
# rtl/barycentric_sample.sv has the same widths. e and a as scale_weight() gives them, 32 bits; rises of 32
# signed bits; mantissas of float32 of 24 bits, weights and sums as normalise() gives them.

r = fixed<0,dn>((1b63 - 1) / a);
weight = fixed<0,dn>(e * r * 1b-33);
sum = z0 * 1b30 + weight1 * rise1 + weight2 * rise2;
product = m * z;
float_sum = product0 + product1 + product2;

{ a in [1b31,4294967295] /\ e in [0,4294967295] /\ m in [0,4294967295] /\ z in [0,16777215]
  /\ z0 in [-1b31,2147483647] /\ |rise1| <= 2147483647 /\ |rise2| <= 2147483647
  /\ weight1 in [0,1b30] /\ weight2 in [0,1b30]
  /\ product0 in [0,1b56] /\ product1 in [0,1b56] /\ product2 in [0,1b56]
  -> r in [1b31,4294967295]
  /\ e * r in [0,18446744073709551615]
  /\ sum in [-9223372036854775808,9223372036854775807]
  /\ product in [0,1b56]
  /\ m * r in [0,18446744073709551615]
  /\ float_sum in [0,9223372036854775807] }
