#!/usr/bin/env python3
"""Integers at which a tighter bound than a theorem's, or a wider range, is false."""
import struct
from fractions import Fraction

ONE24 = (2**24 - 1) << 7  # depth 1 as a vertex depth, unorm24


def weight(area2, e):
    """model/halfspace/units/depth_barycentric.hpp, weight()."""
    shift = area2.bit_length() - 32
    reciprocal = (2**63 - 1) // (area2 >> shift)
    return (e >> shift) * reciprocal >> 33


def cut(numerator, denominator):
    """Towards zero, as C++ divides."""
    quotient = abs(numerator) // denominator
    return quotient if numerator >= 0 else -quotient


def plane(vertices, pixel, s=8):
    """The word at a pixel before it wraps, and the exact depth: depth_plane.cpp and .hpp."""
    (x0, y0, z0), (x1, y1, z1), (x2, y2, z2) = vertices
    area2 = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
    numerator_x = (z1 - z0) * (y2 - y0) + (z2 - z0) * (y0 - y1)
    numerator_y = (z1 - z0) * (x0 - x2) + (z2 - z0) * (x1 - x0)
    dx, dy = cut(numerator_x << 22, area2), cut(numerator_y << 22, area2)
    centre = [(p << s) + (1 << s - 1) for p in pixel]
    anchor = [(p // 16 * 16 << s) + (1 << s - 1) for p in pixel]
    origin = (z0 << 22) + dx * (anchor[0] - x0) + dy * (anchor[1] - y0) + (1 << 21) >> 22
    step_x, step_y = (d + (1 << 21 - s) >> 22 - s for d in (dx, dy))
    word = origin + pixel[0] % 16 * step_x + pixel[1] % 16 * step_y
    exact = z0 + Fraction(numerator_x * (centre[0] - x0) + numerator_y * (centre[1] - y0), area2)
    return word, exact


# vertex_depth_unorm.g: a double that is more than half a unit away from its vertex depth.
depth = float.fromhex("0x1.d600044800045p-1")
off = abs(round(depth * ONE24) - Fraction(depth) * ONE24)
assert Fraction(1, 2) + Fraction(9, 10 * 2**23) < off <= Fraction(1, 2) + Fraction(1, 2**23)

# barycentric_weight.g: one weight too large by nearly 2^-31, one too small by nearly 7/8 2^-29.
area2, e = 1125899908415487, 1125882613727232
off = Fraction(weight(area2, e), 2**30) - Fraction(e, area2)
assert Fraction(9999, 10000 * 2**31) < off <= Fraction(1, 2**31)
area2, e = 1126062901166080, 1126057468493823
off = Fraction(weight(area2, e), 2**30) - Fraction(e, area2)
assert off < -Fraction(87496, 100000 * 2**29)

# plane_unorm.g: with vertex depths between kShortWordEnd and 2^31 the sum passes the end of a short word. These
# come from float32 clip coordinates with depth clamp and a clip volume from -w to w; z is the float above w.
for z, w in ((1.019436001777649, 1.0194358825683594), (1.0172845125198364, 1.0172843933105469)):
    assert round((z / w * 0.5 + 0.5) * ONE24) == 2147483646
vertices = [(11148, 6784, 2147483646), (12734, 6784, 2147483646), (7628, 15130, 0)]
word, exact = plane(vertices, (46, 26))
assert exact == 2147483646 and word == 2147483649
wrapped = (word + 2**31) % 2**32 - 2**31
assert max(0, wrapped + 64 >> 7) == 0  # the code of depth 0, where that of 1 is right

# offset_unit.g is of unorm surfaces. On float32 ones the unit is 2^(e - 23), which rounds to 0 below 2^-126.
unit = 2.0 ** (-127 - 23)
assert struct.unpack("f", struct.pack("f", unit))[0] == 0
