"""The pictures of methods as small PNG files with a palette."""

import numpy
from PIL import Image

from detail import RINGS

WIDE = 320  # small frames are magnified to about this width
WIDEST = 480  # large ones are reduced to it
COLORS = 48
MOST_TESTS = 8
# From dark over red and yellow to white; as in the pictures of a run.
HEAT = numpy.array([(13, 13, 38), (38, 51, 153), (153, 38, 140), (242, 89, 51), (255, 204, 64), (255, 255, 242)])


def heat(counts, most):
    """RGB of counts, from 0 to `most`."""
    at = numpy.clip(counts / most, 0, 1) * (len(HEAT) - 1)
    low = numpy.minimum(at.astype(int), len(HEAT) - 2)
    part = (at - low)[..., numpy.newaxis]
    return (HEAT[low] * (1 - part) + HEAT[low + 1] * part).astype(numpy.uint8)


def owners(run, places):
    """A colour for each triangle, and what differs as details mark it."""
    owner = numpy.full(run.fragments.shape[1:], -1, numpy.int64)
    for lane in range(4):
        live = run.quads["passed"] >> lane & 1 != 0
        quads = run.quads[live]
        owner[quads["y"] + lane // 2, quads["x"] + lane % 2] = quads["triangle"]
    turn = (owner * 0.618034) % 1  # hues far apart for neighbouring numbers
    rgb = 178 + 60 * numpy.cos(2 * numpy.pi * (turn[..., numpy.newaxis] + numpy.array([0, 1 / 3, 2 / 3])))
    rgb[owner < 0] = (24, 26, 32)
    for name, mask in places.items():
        rgb[mask] = [int(RINGS[name][i : i + 2], 16) for i in (1, 3, 5)]
    return rgb.astype(numpy.uint8)


def of(run, kind, places):
    """RGB, a pixel for each of the frame."""
    if kind == "owners":
        return owners(run, places)
    if kind == "tests":
        return heat(run.fragments.sum(axis=0), MOST_TESTS)
    return run.picture("shaded" if kind == "walk" else kind)


def save(picture, path):
    height, width = picture.shape[:2]
    image = Image.fromarray(picture)
    if width < WIDE:
        times = max(WIDE // width, 1)
        image = image.resize((width * times, height * times), Image.Resampling.NEAREST)
    elif width > 2 * WIDEST:
        image = image.resize((WIDEST, height * WIDEST // width), Image.Resampling.BOX)
    palette = image.quantize(COLORS, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    palette.save(path, optimize=True)
