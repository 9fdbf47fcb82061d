#!/usr/bin/env python3
"""Draws what `halfspace bench speed` measured, or how that went over time.

    tools/plot_speed.py out/speed/speed.json docs/images/speed.svg
    tools/plot_speed.py docs/speed_history.csv docs/images/speed_history.svg

Of the JSON: a row for each workload, a point with its spread for each rasterizer. Of the history: a line for
each workload, how many times as fast as the plain scalar loop the model is.
"""

import argparse
import pathlib
import statistics

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import FuncFormatter, NullFormatter  # noqa: E402

from bench_file import check_endings, save  # noqa: E402
from speed_file import read_history, read_speed  # noqa: E402

# Marker and colour (of Okabe and Ito, which the colour-blind can tell apart), ours first.
STYLES = [("o", "#0072B2"), ("s", "#D55E00"), ("^", "#009E73"), ("D", "#CC79A7"), ("v", "#000000")]
GRID = "#E5E5E5"


def milliseconds(value, _):
    return f"{value / 1e3:g} s" if value >= 1e3 else f"{value:g} ms"


def draw_speed(data):
    workloads = data["workloads"]
    contenders = [each for each in data["contenders"] if not each["absent"]]
    figure, axes = plt.subplots(figsize=(9, 1.2 + 0.42 * len(workloads)), dpi=140, layout="constrained")
    for k, contender in enumerate(contenders):
        marker, colour = STYLES[k % len(STYLES)]
        for i, workload in enumerate(workloads):
            times = workload["runs"][contender["name"]]["milliseconds"]
            y = i + 0.22 * (k - (len(contenders) - 1) / 2)
            axes.plot([min(times), max(times)], [y, y], color=colour, linewidth=1.4, zorder=2)
            axes.scatter(
                statistics.median(times), y, marker=marker, s=30, facecolor=colour, edgecolor="white",
                linewidth=0.6, zorder=3, label=contender["name"].replace("_", " ") if i == 0 else None,
            )  # fmt: skip
    for i in range(1, len(workloads)):
        axes.axhline(i - 0.5, color=GRID, linewidth=0.8, zorder=0)
    axes.set_xscale("log")
    axes.xaxis.set_major_formatter(FuncFormatter(milliseconds))
    axes.grid(True, which="major", axis="x", color=GRID, zorder=0)
    axes.set_yticks(range(len(workloads)), [f"{each['name']}, {each['depth']}" for each in workloads])
    axes.set_ylim(len(workloads) - 0.4, -0.6)
    axes.spines[["top", "right"]].set_visible(False)
    axes.set_xlabel(f"median of {data['repeat']} passes in turns, and their spread")
    axes.set_title(f"Run time on {data['processor']}, one thread", loc="left", fontsize=11)
    axes.legend(loc="best", framealpha=1, edgecolor="#DDDDDD", fontsize=8.5)
    return figure


def draw_history(rows):
    runs = list(dict.fromkeys((row["date"], row["commit"], row["processor"]) for row in rows))
    kinds = list(dict.fromkeys((row["workload"], row["ours"]) for row in rows))
    names = {ours for _, ours in kinds}
    figure, axes = plt.subplots(figsize=(9, 5), dpi=140, layout="constrained")
    colours = plt.get_cmap("tab10")
    for k, (workload, ours) in enumerate(kinds):
        mine = [row for row in rows if (row["workload"], row["ours"]) == (workload, ours)]
        # A processor at a time: a line across two would say nothing.
        for number, processor in enumerate(dict.fromkeys(row["processor"] for row in mine)):
            some = [row for row in mine if row["processor"] == processor]
            x = [runs.index((row["date"], row["commit"], processor)) for row in some]
            y, least, most = ([float(row[key]) for row in some] for key in ("times_as_fast", "least", "most"))
            spread = [[a - b for a, b in zip(y, least)], [a - b for a, b in zip(most, y)]]
            label = workload if len(names) == 1 else f"{workload}, {ours}"
            axes.errorbar(
                x, y, spread, color=colours(k % 10), marker=STYLES[k // 10 % len(STYLES)][0], markersize=4,
                linewidth=1.2, elinewidth=0.8, label=label if number == 0 else None,
            )  # fmt: skip
    axes.set_yscale("log")
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}x"))
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.grid(True, which="major", axis="y", color=GRID, zorder=0)
    axes.spines[["top", "right"]].set_visible(False)
    labels = [f"{date}\n{commit}\n{processor[:24]}" for date, commit, processor in runs]
    axes.set_xticks(range(len(runs)), labels, fontsize=7)
    axes.set_xlim(-0.5, len(runs) - 0.5)
    axes.set_title("Times as fast as the plain scalar loop in the same run", loc="left", fontsize=11)
    figure.legend(loc="outside right center", edgecolor="#DDDDDD", fontsize=8)
    return figure


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("data", type=pathlib.Path, help="JSON of `halfspace bench speed`, or the history, .csv")
    parser.add_argument("image", type=pathlib.Path, nargs="+", help="file to write, .png or .svg")
    options = parser.parse_args()
    check_endings(options.image)
    is_history = options.data.suffix == ".csv"
    figure = draw_history(read_history(options.data)) if is_history else draw_speed(read_speed(options.data))
    save(figure, options.image)


if __name__ == "__main__":
    main()
