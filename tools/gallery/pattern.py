"""Where the samples of a pixel are, and whether that is where they were covered."""

import numpy

# standardSampleLocations of Vulkan 1.3 ("Multisampling"), in sixteenths of a pixel.
STANDARD = {
    1: ((8, 8),),
    2: ((12, 12), (4, 4)),
    4: ((6, 2), (14, 6), (2, 10), (10, 14)),
    8: ((9, 5), (7, 11), (13, 9), (5, 3), (3, 13), (1, 7), (11, 15), (15, 1)),
    16: (
        *((9, 9), (7, 5), (5, 10), (12, 7), (3, 6), (10, 13), (13, 11), (11, 3)),
        *((6, 14), (8, 1), (4, 2), (2, 12), (0, 8), (15, 4), (14, 15), (1, 0)),
    ),
}


def positions(config):
    """(x, y) of each sample in sixteenths of a pixel, in order."""
    text = config["raster.sample_positions"]
    if text == "standard":
        return STANDARD[int(config["raster.samples"])]
    return tuple(tuple(int(number) for number in place.split(",")) for place in text.split(";"))


def check(run):
    """Whether each sample inside exactly one triangle, or in none, is covered so; samples on an edge may be either way.

    For runs of filled triangles that cover by samples, whose triangles lie apart.
    """
    bits = int(run.config["raster.sub_pixel_bits"])
    samples, height, width = run.fragments.shape
    y, x = numpy.mgrid[0:height, 0:width].astype(numpy.int64)
    for number, (dx, dy) in enumerate(positions(run.config)):
        px, py = (x << bits) + (dx << bits - 4), (y << bits) + (dy << bits - 4)
        inside = numpy.zeros((height, width), int)
        sure = numpy.ones((height, width), bool)
        for t in run.triangles[run.triangles["verdict"] == 0]:
            corners = list(zip(t["x"].astype(numpy.int64), t["y"].astype(numpy.int64), strict=True))
            edges = [
                (bx - ax) * (py - ay) - (by - ay) * (px - ax)
                for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1], strict=True)
            ]
            signs = numpy.sign(edges)
            inside += (signs > 0).all(axis=0) | (signs < 0).all(axis=0)
            sure &= (signs != 0).all(axis=0)
        if ((run.fragments[number] != inside) & sure).any():
            raise ValueError(f"{run.folder}: sample {number} is not where it was covered")
