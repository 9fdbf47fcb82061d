#!/usr/bin/env python3
"""Draws what each walk takes, beside the default one, from out/traversal/traversal.json.

    tools/plot_traversal.py out/traversal/traversal.json docs/images/traversal.png
"""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter  # noqa: E402

from bench_file import plot  # noqa: E402
from traversal_data import METRICS, SCHEMA, name_of, walks  # noqa: E402

# Walks differ by factors; of the others by percent.
SPREAD = ("steps", "cycles")
DEFAULT = name_of(2, "raster")
# Of Okabe and Ito, which the colour-blind can tell apart.
COLOURS = ("#E69F00", "#56B4E9", "#009E73", "#F0E442", "#0072B2", "#D55E00", "#CC79A7", "#000000", "#999999", "#7F3C8D")
MARKERS = "os^vDPX*<>"


def draw(data):
    names = [name_of(*walk) for walk in walks()]
    figure, panels = plt.subplots(1, len(METRICS), sharey=True, figsize=(12, 5.6), dpi=140, layout="constrained")
    for axes, (metric, (title, _)) in zip(panels, METRICS.items(), strict=True):
        for number, (frame, runs) in enumerate(data["frames"].items()):
            style = number % len(COLOURS)
            axes.scatter(
                [runs[name][metric] / runs[DEFAULT][metric] for name in names], range(len(names)), s=24,
                color=COLOURS[style], marker=MARKERS[style], label=frame, alpha=0.85, linewidth=0.4,
                edgecolor="white", zorder=3,
            )  # fmt: skip
        axes.axvline(1, color="#888888", linewidth=0.8, zorder=1)
        if metric in SPREAD:
            axes.set_xscale("log")
            axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
            axes.xaxis.set_minor_formatter(NullFormatter())
            axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}x"))
        else:
            axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{100 * (value - 1):+g} %"))
        axes.set_title(title, fontsize=9.5)
        axes.grid(True, axis="both", color="#E8E8E8", zorder=0)
        axes.spines[["top", "right"]].set_visible(False)
        axes.tick_params(axis="x", which="both", labelsize=7)
    panels[0].set_yticks(range(len(names)), names, fontsize=8.5)
    panels[0].invert_yaxis()
    figure.suptitle(f"Walks beside “{DEFAULT}”, each frame a mark", fontsize=11, x=0.01, ha="left")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=5, fontsize=8)
    return figure


if __name__ == "__main__":
    plot(__doc__, "traversal.json", SCHEMA, draw)
