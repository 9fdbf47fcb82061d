#!/usr/bin/env python3
"""Draws how far pictures of few samples a pixel are from one of very many, from out/samples/samples.json.

    tools/plot_samples.py out/samples/samples.json docs/images/samples.png
"""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter, NullLocator  # noqa: E402

from bench_file import plot  # noqa: E402
from samples_data import METHODS, SAMPLES, SCHEMA  # noqa: E402

# Of Okabe and Ito, which the colour-blind can tell apart.
STYLES = dict(zip(METHODS, (("#D55E00", "o"), ("#0072B2", "s"), ("#009E73", "^")), strict=True))
COLUMNS = 4


def draw(data):
    frames = data["frames"]
    rows = -(-len(frames) // COLUMNS)
    figure, panels = plt.subplots(rows, COLUMNS, sharex=True, figsize=(12, 0.6 + 2.7 * rows), dpi=140,
                                  layout="constrained", squeeze=False)  # fmt: skip
    for axes, (frame, found) in zip(panels.flat, frames.items()):  # the last panels may stay empty
        for method, of_samples in found["error"].items():
            samples = sorted(map(int, of_samples))
            colour, marker = STYLES[method]
            axes.plot(samples, [of_samples[str(n)] for n in samples], color=colour, marker=marker, markersize=5,
                      linewidth=1.4, label=method)  # fmt: skip
        axes.set_xscale("log", base=2)
        axes.set_yscale("log", base=2)
        axes.xaxis.set_major_locator(FixedLocator(SAMPLES))
        axes.xaxis.set_minor_locator(NullLocator())
        axes.yaxis.set_minor_formatter(NullFormatter())
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axes.set_title(frame, fontsize=9.5)
        axes.grid(True, color="#E8E8E8")
        axes.spines[["top", "right"]].set_visible(False)
        axes.tick_params(labelsize=8)
        axes.set_xlabel("samples of a pixel", fontsize=8.5)
    for axes in panels.flat[len(frames) :]:
        axes.remove()
    figure.supylabel("error, 255ths", fontsize=9)
    figure.suptitle("Root mean square error of the shaded picture", fontsize=11, x=0.01, ha="left")
    figure.legend(*panels.flat[0].get_legend_handles_labels(), loc="outside lower center", ncols=3, fontsize=8.5)
    return figure


if __name__ == "__main__":
    plot(__doc__, "samples.json", SCHEMA, draw)
