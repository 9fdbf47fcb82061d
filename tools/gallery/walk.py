"""A triangle drawn step by step, as an animated SVG without script: the order is that of steps.npy."""

import numpy

from detail import JOB, number

LEAD = 0  # kind, in steps.npy
TICK = 0.07  # seconds for each step and each tile job
PAUSE = 2  # seconds, at the end
SHOWN = 6  # pixels of the page for each of the frame
LED, EMPTY, FULL, TILE, PIXEL = "#cdbcf0", "#f3c9c3", "#cfe3f7", "#a9dcae", "#1f7a3a"


def _square(x, y, wide, tall):
    return f"M{x} {y}h{wide}v{tall}h-{wide}z"


def _rows(covered, x, y, side):
    """Path data of the covered pixels of a square: runs of rows, and whole squares at once."""
    part = covered[y : y + side, x : x + side]
    if part.all():
        return _square(x, y, part.shape[1], part.shape[0])
    data = ""
    for j, row in enumerate(part):
        edges = numpy.flatnonzero(numpy.diff(numpy.concatenate([[0], row.astype(int), [0]])))
        for first, last in zip(edges[::2], edges[1::2], strict=True):
            data += _square(x + first, y + j, last - first, 1)
    return data


def _event(step, covered):
    """What a step shows."""
    x, y, side = (int(step[name]) for name in ("x", "y", "side"))
    whole = _square(x, y, side, side)
    if step["kind"] == JOB:
        pixels = _rows(covered, x, y, side)
        return f'<path fill="{TILE}" d="{whole}"/>' + (f'<path d="{pixels}"/>' if pixels else "")
    color = LED if step["kind"] == LEAD else FULL if step["left"] else EMPTY
    return f'<path fill="{color}" d="{whole}"/>'


def _lines(width, height, side):
    return "".join(f"M{x} 0v{height}" for x in range(side, width, side)) + "".join(
        f"M0 {y}h{width}" for y in range(side, height, side)
    )


def _outline(triangles, unit):
    data = ""
    for triangle in triangles:
        corners = zip(triangle["x"] / unit, triangle["y"] / unit, strict=True)
        data += "M" + "L".join(f"{number(x)} {number(y)}" for x, y in corners) + "z"
    return data


def draw(run):
    """The animation of all steps of a run whose triangles lie apart."""
    height, width = run.fragments.shape[1:]
    covered = run.fragments[0] > 0
    length = TICK * len(run.steps) + PAUSE
    events = []
    for i, step in enumerate(run.steps):
        begin = TICK * i
        events.append(
            f'<g>{_event(step, covered)}<set attributeName="visibility" to="visible" '
            f'begin="t.begin+{number(begin)}s" dur="{number(length - begin)}s"/></g>'
        )
    tile, block = (int(run.config[key]) for key in ("tile_walker.tile_size", "block_walker.block_size"))
    outline = _outline(run.triangles[run.triangles["verdict"] == 0], 1 << int(run.config["raster.sub_pixel_bits"]))
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height + 1}" width="{width * SHOWN}"'
        f' height="{(height + 1) * SHOWN}">',
        f'<rect width="{width}" height="{height + 1}" fill="#fff"/>',
        f'<g visibility="hidden" fill="{PIXEL}">',
        *events,
        "</g>",
        f'<g fill="none"><path stroke="#000" stroke-opacity=".18" stroke-width=".1" d="{_lines(width, height, tile)}"/>',
        f'<path stroke="#000" stroke-opacity=".5" stroke-width=".12" d="{_lines(width, height, block)}"/>',
        f'<path stroke="#d01878" stroke-width=".25" stroke-linejoin="round" d="{outline}"/></g>',
        f'<rect y="{height}" width="0" height="1" fill="#888"><animate id="t" attributeName="width" values="0;{width}"'
        f' dur="{number(length)}s" begin="0s;t.end"/></rect>',
        "</svg>",
    ]
    return "\n".join(lines) + "\n"
