"""Reads the JSON of `halfspace bench speed` and the history that is made of it."""

import csv
import sys

from bench_file import read_json

SCHEMA = ("halfspace-speed", 1)
HISTORY = ["date", "commit", "processor", "workload", "ours", "times_as_fast", "least", "most"]


def read_speed(path):
    return read_json(path, SCHEMA)


def read_history(path):
    """A dictionary for each line."""
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            reader = csv.DictReader(file)
            rows = list(reader)
    except OSError as error:
        sys.exit(f"{path}: {error.strerror}")
    if reader.fieldnames != HISTORY:
        sys.exit(f"{path}: columns are {reader.fieldnames}; legal: {HISTORY}")
    return rows
