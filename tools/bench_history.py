#!/usr/bin/env python3
"""Appends what `halfspace bench speed --json` measured to the history of speed.

    tools/bench_history.py out/speed/speed.json docs/speed_history.csv

A line for each workload: how many times as fast as the plain scalar loop ours is, in the same run. Times
differ from machine to machine and from hour to hour; this ratio differs little. `make bench-history` runs it.
"""

import argparse
import csv
import datetime
import pathlib
import subprocess

from speed_file import HISTORY, read_history, read_speed

ROOT = pathlib.Path(__file__).resolve().parent.parent
YARDSTICK = "scalar_loop"


def commit():
    """Short, and marked where files differ from it."""
    words = ["git", "describe", "--always", "--dirty", "--exclude=*"]
    return subprocess.run(words, cwd=ROOT, check=True, text=True, stdout=subprocess.PIPE).stdout.strip()


def lines(data, date, version):
    for workload in data["workloads"]:
        for pair in workload["times_as_fast"]:
            if pair["yardstick"] == YARDSTICK:
                ratios = [f"{pair[key]:.4f}" for key in ("median", "least", "most")]
                yield [date, version, data["processor"], workload["name"], pair["ours"], *ratios]


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("json", type=pathlib.Path, help="of `halfspace bench speed`")
    parser.add_argument("history", type=pathlib.Path, help="CSV to append to; made if there is none")
    options = parser.parse_args()
    data = read_speed(options.json)
    new = not options.history.exists()
    if not new:
        read_history(options.history)
    with options.history.open("a", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        if new:
            writer.writerow(HISTORY)
        writer.writerows(lines(data, datetime.date.today().isoformat(), commit()))


if __name__ == "__main__":
    main()
