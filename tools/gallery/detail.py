"""A part of a frame, magnified 16 times, as SVG: pixels, tiles, samples where they are, edges where they are."""

import collections

import numpy

from pattern import positions

SCALE = 16
MANY = 20  # triangles; their edges are thinner
SMALL = 12  # windows at most as wide are shown twice as large
TRIANGLE, THIN_LINE = 0, 1  # shape, in triangles.npy
DECIDE, JOB = 1, 2  # kind, in steps.npy
RINGS = {"fewer": "#e0322b", "more": "#2f6bff", "other": "#f2b600"}


def number(value):
    """As short as it is exact to 1/10000."""
    return f"{value:.4f}".rstrip("0").rstrip(".")


def dots(places):
    """Path data of a dot at each place, for a line with round ends."""
    return "".join(f"M{number(x)} {number(y)}h0" for x, y in places)


def squares(places):
    """Path data of the pixels at these places, with runs of a row joined."""
    data = []
    for y, row in sorted(_rows(places).items()):
        row.sort()
        first = 0
        for i in range(1, len(row) + 1):
            if i == len(row) or row[i] != row[i - 1] + 1:
                wide = (row[i - 1] - row[first] + 1) * SCALE
                data.append(f"M{row[first] * SCALE} {y * SCALE}h{wide}v{SCALE}h-{wide}z")
                first = i
    return "".join(data)


def _rows(places):
    rows = collections.defaultdict(list)
    for x, y in places:
        rows[y].append(x)
    return rows


def _pixels(run, picture, window):
    """The pixels' own colours, paler, so that what is drawn over them can be seen; nearly white where nothing is."""
    covered = run.fragments.any(axis=0)
    by_color = collections.defaultdict(list)
    for y in range(window.height):
        for x in range(window.width):
            at = window.y + y, window.x + x
            color = picture[at].astype(float) * 0.62 + 255 * 0.38 if covered[at] else (248, 248, 248)
            by_color["#" + "".join(f"{int(value) // 17:x}" for value in color)].append((x, y))
    return [f'<path fill="{color}" d="{squares(places)}"/>' for color, places in by_color.items()]


def _grid(window, tile):
    wide, tall = window.width * SCALE, window.height * SCALE

    def lines(columns, rows):
        return "".join(f"M{x * SCALE} 0v{tall}" for x in columns) + "".join(f"M0 {y * SCALE}h{wide}" for y in rows)

    columns, rows = range(1, window.width), range(1, window.height)
    of_tiles = lines(
        [x for x in columns if (window.x + x) % tile == 0], [y for y in rows if (window.y + y) % tile == 0]
    )
    thin = f'<path stroke="#000" stroke-opacity=".22" d="{lines(columns, rows)}"/>'
    return [thin, f'<path stroke="#000" stroke-opacity=".6" stroke-width="1.5" d="{of_tiles}"/>' if of_tiles else ""]


def shapes(run, window):
    """Path data of the triangles and thin lines that may show in the window, and how many they are."""
    unit = 1 << int(run.config["raster.sub_pixel_bits"])
    data = []
    for shape in run.triangles[run.triangles["verdict"] == 0]:
        count = 2 if shape["shape"] == THIN_LINE else 3
        x = shape["x"][:count] / unit - window.x
        y = shape["y"][:count] / unit - window.y
        if x.max() < 0 or x.min() > window.width or y.max() < 0 or y.min() > window.height:
            continue
        corners = [f"{number(px * SCALE)} {number(py * SCALE)}" for px, py in zip(x, y, strict=True)]
        data.append("M" + "L".join(corners) + ("" if count == 2 else "z"))
    return "".join(data), len(data)


def _samples(run, window, places):
    """Where pixels differ rings about their only sample, or squares; then the samples: filled where something covers them."""
    part = numpy.s_[window.y : window.y + window.height, window.x : window.x + window.width]
    out = []
    for name, mask in places.items():
        at = numpy.argwhere(mask[part])
        if at.size and run.samples > 1:
            out.append(f'<path fill="{RINGS[name]}" fill-opacity=".4" d="{squares((x, y) for y, x in at)}"/>')
        elif at.size:
            rings = dots(((x + 0.5) * SCALE, (y + 0.5) * SCALE) for y, x in at)
            out.append(f'<path stroke="{RINGS[name]}" stroke-width="12" d="{rings}"/>')
    covered, not_covered = [], []
    for i, (dx, dy) in enumerate(positions(run.config)):
        for (y, x), count in numpy.ndenumerate(run.fragments[i][part]):
            at = ((x + dx / 16) * SCALE, (y + dy / 16) * SCALE)
            (covered if count else not_covered).append(at)
    wide = {1: 5.5, 2: 4, 4: 3.5, 8: 2.8}.get(run.samples, 2.2)
    out.append(f'<path stroke="#666" stroke-width="{wide}" d="{dots(not_covered)}"/>')
    out.append(f'<path stroke="#fff" stroke-width="{number(wide * 0.6)}" d="{dots(not_covered)}"/>')
    out.append(f'<path stroke="#101418" stroke-width="{wide}" d="{dots(covered)}"/>')
    return out


def _order(run, window):
    """Of a walk: the way of the tile jobs, the number of each, and those of the steps in the corners of their cells."""
    jobs, steps = [], []
    for step in run.steps:
        x, y, side = (int(step[name]) for name in ("x", "y", "side"))
        if step["kind"] == JOB:
            jobs.append(((x + side / 2 - window.x) * SCALE, (y + side / 2 - window.y) * SCALE))
        else:
            steps.append(((x - window.x) * SCALE, (y - window.y) * SCALE))

    def shown(places):
        wide, tall = window.width * SCALE, window.height * SCALE
        return [(i, x, y) for i, (x, y) in enumerate(places, 1) if 0 <= x < wide and 0 <= y < tall]

    way = "M" + "L".join(f"{number(x)} {number(y)}" for x, y in jobs)
    out = [f'<path fill="none" stroke="#e06c00" stroke-width="2.5" stroke-opacity=".8" d="{way}"/>']
    out.append('<g fill="#a13f00" stroke="#fff" stroke-width="4" paint-order="stroke" font-size="17" text-anchor="middle">')
    out += [f'<text x="{number(x)}" y="{number(y + 6)}">{i}</text>' for i, x, y in shown(jobs)]
    out.append('</g><g fill="#33507a" stroke="#fff" stroke-width="3" paint-order="stroke" font-size="11">')
    out += [f'<text x="{number(x + 3)}" y="{number(y + 12)}">{i}</text>' for i, x, y in shown(steps)]
    return [*out, "</g>"]


def draw(run, picture, window, places, edges_of, with_order):
    """The SVG. `edges_of`: the run whose triangles are drawn; a reference has none of its own."""
    wide, tall = window.width * SCALE, window.height * SCALE
    tile = int(run.config["tile_walker.tile_size"])
    edges, many = shapes(edges_of, window)
    thick = 1.4 if many < MANY else 0.7
    times = 2 if window.width <= SMALL else 1
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide} {tall}" width="{wide * times}" height="{tall * times}"'
        ' font-family="sans-serif">',
        f'<rect width="{wide}" height="{tall}" fill="#fff"/>',
        *_pixels(run, picture, window),
        *_grid(window, tile),
        '<g fill="none" stroke-linecap="round">',
        *_samples(run, window, places),
        "</g>",
        f'<path fill="none" stroke="#d01878" stroke-width="{thick}" stroke-linejoin="round" d="{edges}"/>',
        *(_order(run, window) if with_order else []),
        f'<rect x=".5" y=".5" width="{wide - 1}" height="{tall - 1}" fill="none" stroke="#555"/>',
        "</svg>",
    ]
    return "\n".join(line for line in lines if line) + "\n"
