#!/usr/bin/env python3
"""Draws error against cost for the arithmetics of edges and of depth, and the frontier of what nothing beats.

    tools/plot_precision.py out/precision/precision.json docs/precision.json edges docs/images/precision_edges.png
    tools/plot_precision.py out/precision/precision.json docs/precision.json depth docs/images/precision_depth.png

Cost is gates of a sample a cycle, and for edges run time in software too. Errors are the worst of all families
and frames; errors of 0 have a lane at the bottom.
"""

import argparse
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.patheffects  # noqa: E402
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import FuncFormatter, NullFormatter  # noqa: E402

from bench_file import check_endings, save  # noqa: E402
from precision_data import FORMATS, LIKE, STEPS, depth_gates, holes, partitions, rate  # noqa: E402
from precision_data import read_hardware, read_result, worst_depth  # noqa: E402

# Of Okabe and Ito, which the colour-blind can tell apart: integers and words, floating point, the normalised.
BLUE, ORANGE, GREEN, GREY = "#0072B2", "#D55E00", "#009E73", "#888888"


def colour(name):
    if name.startswith(("fixed", "exact", "plane_")) and not name.endswith(("float32", "double")):
        return BLUE
    return GREEN if name.startswith(("barycentric", "normalised")) else ORANGE


def frontier(points):
    """Of (cost, error, name) those that no other beats in one without losing in the other, by cost."""
    best = []
    for point in sorted(points):
        if not best or point[1] < best[-1][1]:
            best.append(point)
    return best




def panel(axes, points, baseline, xlabel, ylabel):
    """points: (cost, error, name); that of the baseline is a diamond."""
    errors = [error for _, error, _ in points if error > 0]
    low, high = min(errors) / 6, max(errors) * 3
    has_zero = len(errors) < len(points)
    zero = low / 12
    shown = [(cost, error if error > 0 else zero, name) for cost, error, name in points]
    axes.set_xscale("log")
    axes.set_yscale("log")
    costs = [cost for cost, _, _ in points]
    axes.set_xlim(min(costs) / 1.35, max(costs) * 2.6)
    axes.set_ylim(zero / 12 if has_zero else low, high)
    axes.grid(True, which="major", color="#EBEBEB", zorder=0)
    axes.spines[["top", "right"]].set_visible(False)
    if has_zero:
        axes.axhspan(zero / 12, zero * 12, color="#F3F7FA", zorder=0)
        axes.annotate("0", (0, zero), (-6, 0), xycoords=("axes fraction", "data"), textcoords="offset points",
                      ha="right", va="center", fontsize=8)  # fmt: skip
    best = frontier(shown)
    xs, ys = [], []
    for cost, error, _ in best:  # steps: what is cheaper is no better
        xs += [cost, cost] if xs else [cost]
        ys += [ys[-1], error] if ys else [error]
    axes.plot(xs, ys, color=GREY, linewidth=1.1, zorder=1)
    for cost, error, name in shown:
        ours = name.removesuffix(STEPS) == baseline
        axes.scatter(
            cost, error, marker="D" if ours else "o", s=34 if ours else 24,
            facecolor=colour(name), edgecolor="black" if ours else "white", linewidth=0.7, zorder=3,
        )  # fmt: skip
    label(axes, shown)
    axes.set_xlabel(xlabel, fontsize=8.5)
    axes.set_ylabel(ylabel, fontsize=8.5)
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,g}"))
    wide = max(costs) > 30 * min(costs)  # no room for numbers between powers of ten
    between = "" if wide else "25"
    axes.xaxis.set_minor_formatter(
        FuncFormatter(lambda value, _: f"{value:,g}" if f"{value:g}"[0] in between else "")
    )
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}" if value >= low else ""))
    axes.tick_params(which="both", labelsize=7.5)


def label(axes, shown):
    """Names to the right of their points, apart from each other, with a line where they had to move."""
    figure = axes.figure
    figure.canvas.draw()
    height = 10.5 * figure.dpi / 72
    pixels = [(*axes.transData.transform((cost, error)), name) for cost, error, name in shown]
    taken = []
    for x, y, name in sorted(pixels, key=lambda p: (-p[0], p[1])):
        text = name.replace("plane_", "").replace("barycentric_", "w") if axes.get_gid() == "depth" else name
        text = text.replace(STEPS, ", steps")
        width = 4.6 * len(text) * figure.dpi / 72 + 10
        place = y
        tries = [0, *(sign * step * height / 2 for step in range(1, 24) for sign in (1, -1))]
        for offset in tries:
            box = (x + 4, y + offset - height / 2, x + 6 + width, y + offset + height / 2)
            hits_label = any(box[0] < b[2] and b[0] < box[2] and box[1] < b[3] and b[1] < box[3] for b in taken)
            hits_point = any(
                box[0] < px + 3 and px - 3 < box[2] and box[1] < py + 3 and py - 3 < box[3]
                for px, py, other in pixels
                if other != name
            )
            if not hits_label and not hits_point:
                place = y + offset
                taken.append(box)
                break
        axes.annotate(
            text, (x, y), (x + 8 * figure.dpi / 72, place), xycoords="figure pixels", textcoords="figure pixels",
            fontsize=7, va="center", color="#333333", zorder=4,
            path_effects=[matplotlib.patheffects.withStroke(linewidth=2.5, foreground="white")],
            arrowprops={"arrowstyle": "-", "color": "#BBBBBB", "lw": 0.5, "shrinkA": 0, "shrinkB": 3}
            if place != y else None,
        )  # fmt: skip


def draw_edges(result, hardware):
    edges = result["edges"]
    names = [each["name"] for each in edges["arithmetics"]]
    time = {name: row["ratio"] for name, row in edges["time"][0]["rows"].items()}
    sets = partitions(edges)
    error = {
        "gaps and doubles per million pixels": {n: max(sum(holes(each, n)) for each in sets) for n in names},
        "samples per million decided otherwise\nthan by exact positions": {
            n: max(rate(each, n, "moved") for each in sets) for n in names
        },
    }
    gates = {name: hardware[LIKE.get(name, name)]["gates"] for name in names}
    gates |= {name + STEPS: hardware[name + STEPS]["gates"] for name in names if name + STEPS in hardware}
    software = f"time in software, small triangles, beside {edges['baseline']}"
    cost = {"gates of an edge function a cycle (osu018)": gates, software: time}
    figure, axes = plt.subplots(2, 2, figsize=(10.5, 8), dpi=140)
    figure.subplots_adjust(left=0.085, right=0.985, top=0.93, bottom=0.07, hspace=0.27, wspace=0.14)
    for row, (ylabel, errors) in zip(axes, error.items()):
        for at, (xlabel, costs) in zip(row, cost.items()):
            points = [(costs[name], errors[name.removesuffix(STEPS)], name) for name in costs]
            panel(at, points, edges["baseline"], xlabel, ylabel if at is row[0] else "")
    figure.suptitle("Edge functions: error against cost, the worst of meshes and frames", x=0.085, ha="left", fontsize=11)
    return figure


def draw_depth(result, hardware):
    depth = result["depth"]
    figure, axes = plt.subplots(1, 3, figsize=(12.5, 5), dpi=140)
    figure.subplots_adjust(left=0.06, right=0.99, top=0.88, bottom=0.11, wspace=0.16)
    for at, (key, title) in zip(axes, FORMATS.items()):
        points = []
        for each in depth["arithmetics"]:
            worst = worst_depth(depth, each["name"], key)
            gates = depth_gates(hardware, each["name"])
            if worst is not None and gates is not None:
                points.append((gates, worst, each["name"]))
        at.set_gid("depth")
        ylabel = "worst error, units of the last place" if at is axes[0] else ""
        panel(at, points, "plane_63" if key == "float32" else "plane_31", "gates of a sample a cycle (osu018)", ylabel)
        at.axhline(1, color="#CC79A7", linewidth=0.8, linestyle="--", zorder=1)
        at.set_title(title, loc="left", fontsize=10)
    figure.suptitle(
        "Depth: error against cost. Blue: planes in words of so many bits; green: weights by reciprocals of so many bits",
        x=0.06, ha="left", fontsize=10.5,
    )  # fmt: skip
    return figure


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("json", type=pathlib.Path, help="of halfspace_study_precision")
    parser.add_argument("hardware", type=pathlib.Path, help="of rtl/synth_study.py")
    parser.add_argument("kind", choices=["edges", "depth"])
    parser.add_argument("image", type=pathlib.Path, nargs="+", help="file to write, .png or .svg")
    options = parser.parse_args()
    check_endings(options.image)
    draw = draw_edges if options.kind == "edges" else draw_depth
    save(draw(read_result(options.json), read_hardware(options.hardware)), options.image)


if __name__ == "__main__":
    main()
