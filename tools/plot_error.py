#!/usr/bin/env python3
"""Draws run time against error, from the error.json of `halfspace bench error`.

    tools/plot_error.py out/error/error.json docs/images/error.png out/error/error.svg

A point is a fidelity on a workload. Those with an error are drawn above, by its magnitude; those whose
cycles are exactly the RTL's have a lane for each fidelity below, and so have those without cycles.
"""

import statistics

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import FuncFormatter  # noqa: E402

from bench_file import plot  # noqa: E402

SCHEMA = ("halfspace-error", 2)
# Fidelity: marker, colour (of Okabe and Ito, which the colour-blind can tell apart).
STYLE = {
    "functional": ("D", "#999999"),
    "sampled": ("o", "#D55E00"),
    "retime": ("v", "#56B4E9"),
    "recurrence": ("s", "#0072B2"),
    "systemc": ("^", "#009E73"),
    "rtl": ("P", "#000000"),
}
LABEL_SIZE = 7.5


def points(data):
    """{fidelity: [(workload, milliseconds, |error| in percent or None where it has no cycles)]}"""
    found = {}
    for workload in data["workloads"]:
        for line in workload["fidelities"]:
            error = None
            if line["cycles"] is not None:
                error = abs(line["error"]["percent"]) if line["error"] else 0
            found.setdefault(line["fidelity"], []).append((workload["name"], line["milliseconds"], error))
    return found


def speed(data, fidelity):
    """Cycles a second over all workloads, or None where it has no cycles."""
    cycles, time = 0, 0
    for workload in data["workloads"]:
        lines = {line["fidelity"]: line for line in workload["fidelities"]}
        if lines[fidelity]["cycles"] is None:
            return None
        cycles += lines[data["truth"]]["cycles"]  # the same work for all
        time += lines[fidelity]["milliseconds"]
    return cycles / time * 1e3


def scatter(axes, fidelity, at):
    marker, colour = STYLE.get(fidelity, ("x", "#CC79A7"))
    axes.scatter(
        *zip(*at), marker=marker, s=26, facecolor=colour, edgecolor="white", linewidth=0.6, alpha=0.85,
        zorder=3,
    )  # fmt: skip


def label(axes, names):
    """Names beside their points, each where it hides nothing; `names` is [(x, y, text)]."""
    figure = axes.figure
    renderer = figure.canvas.get_renderer()
    scale = figure.dpi / 72
    taken = []
    for x, y, _ in names:
        px, py = axes.transData.transform((x, y))
        size = 4 * scale
        taken.append(matplotlib.transforms.Bbox.from_extents(px - size, py - size, px + size, py + size))
    points_taken = len(taken)
    if axes.get_legend():
        taken.append(axes.get_legend().get_window_extent(renderer))
    lines = []  # points along the lines from names to what they name
    frame = axes.get_window_extent(renderer)
    places = [(6, 0, "left", "center"), (-6, 0, "right", "center")]
    places += [(0, 5, "center", "bottom"), (0, -5, "center", "top")]
    for distance in (14, 22, 30, 38, 48):
        for share in (0.5, 1, 0):
            for up in (distance, -distance):
                aside = distance * share + 3
                places += [(aside, up, "left", "center"), (-aside, up, "right", "center")]
    for x, y, text in sorted(names, key=lambda name: -name[1]):
        for place, (dx, dy, horizontal, vertical) in enumerate(places):
            note = axes.annotate(
                text, (x, y), (dx, dy), textcoords="offset points", ha=horizontal, va=vertical,
                fontsize=LABEL_SIZE, color="#333333", zorder=4,
                arrowprops={"arrowstyle": "-", "color": "#888888", "lw": 0.6, "shrinkA": 1, "shrinkB": 2}
                if place > 3 else None,
            )  # fmt: skip
            note.update_positions(renderer)
            box = matplotlib.text.Text.get_window_extent(note, renderer)  # without its line
            inside = frame.x0 <= box.x0 and box.x1 <= frame.x1 and frame.y0 <= box.y0 and box.y1 <= frame.y1
            line = []
            if place > 3:
                start = axes.transData.transform((x, y))
                end = box.x0 + box.width / 2, box.y0 + box.height / 2
                line = [[a + (b - a) * i / 20 for a, b in zip(start, end)] for i in range(21)]
            crosses = any(other.contains(*p) for other in taken[points_taken:] for p in line)
            covers = any(box.contains(*p) for p in lines)
            if inside and not crosses and not covers and not any(box.overlaps(other) for other in taken):
                taken.append(box)
                lines += line
                break
            note.remove()


def milliseconds(value, _):
    return f"{value / 1e3:g} s" if value >= 1e3 else f"{value:g} ms"


def draw(data):
    found = points(data)
    off = {f: [p for p in ps if p[2]] for f, ps in found.items()}
    exact = {f: [p for p in ps if p[2] == 0] for f, ps in found.items()}
    untimed = {f: [p for p in ps if p[2] is None] for f, ps in found.items()}
    lanes = [(f, "no cycles", ps) for f, ps in untimed.items() if ps]
    for fidelity, ps in exact.items():
        if ps:
            lanes.insert(0, (fidelity, "the truth" if fidelity == data["truth"] else "0 %", ps))

    figure, (above, below) = plt.subplots(
        2, 1, sharex=True, figsize=(9, 7), dpi=140, layout="constrained",
        gridspec_kw={"height_ratios": [3.4, 0.42 * max(len(lanes), 1)]},
    )  # fmt: skip
    for axes in (above, below):
        axes.grid(True, which="major", axis="x", color="#E5E5E5", zorder=0)
        axes.spines[["top", "right"]].set_visible(False)
    above.set_xscale("log")
    above.set_yscale("log")
    above.grid(True, which="major", axis="y", color="#E5E5E5", zorder=0)
    errors = [p[2] for ps in off.values() for p in ps]
    if errors:
        above.set_ylim(min(errors) / 2, max(errors) * 2)
    else:
        above.set_ylim(0.1, 100)
    for fidelity, ps in off.items():
        if ps:
            scatter(above, fidelity, [(p[1], p[2]) for p in ps])
    for lane, (fidelity, _, ps) in enumerate(lanes):
        below.axhline(lane, color="#F0F0F0", linewidth=9, zorder=0)
        scatter(below, fidelity, [(p[1], lane) for p in ps])
    below.set_yticks(range(len(lanes)), [f"{f}: {what}" for f, what, _ in lanes])
    below.set_ylim(-0.7, len(lanes) - 0.3)
    times = [p[1] for ps in found.values() for p in ps]
    below.set_xlim(min(times) / 1.6, max(times) * 1.6)
    below.xaxis.set_major_formatter(FuncFormatter(milliseconds))
    above.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g} %"))
    above.set_ylabel("error of the frame's cycles, its magnitude")
    below.set_xlabel("run time, median")
    above.tick_params(axis="x", which="both", labelbottom=False)
    above.set_title(
        f"Run time and error of {len(data['workloads'])} workloads beside the verilated RTL",
        loc="left", fontsize=11,
    )  # fmt: skip

    handles = []
    for fidelity, ps in found.items():
        marker, colour = STYLE.get(fidelity, ("x", "#CC79A7"))
        rate = speed(data, fidelity)
        median = statistics.median(p[1] for p in ps)
        text = fidelity + (f", {rate / 1e6:.3g} Mcycles/s" if rate else f", median {median:.3g} ms")
        handles.append(
            plt.Line2D([], [], marker=marker, color=colour, markersize=6, linestyle="", label=text)
        )
    above.legend(handles=handles, loc="best", framealpha=1, edgecolor="#DDDDDD", fontsize=8.5)
    figure.canvas.draw()
    label(above, [(p[1], p[2], p[0]) for ps in off.values() for p in ps])
    for lane, (fidelity, _, ps) in enumerate(lanes):
        if off[fidelity]:  # the few without an error, of a fidelity that has some
            label(below, [(p[1], lane, p[0]) for p in ps])
    return figure


if __name__ == "__main__":
    plot(__doc__, "error.json", SCHEMA, draw)
