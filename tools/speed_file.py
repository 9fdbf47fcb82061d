"""Reads the JSON of `halfspace bench speed` and the history that is made of it."""

import csv
import json
import sys

SCHEMA = ("halfspace-speed", 1)
HISTORY = ["date", "commit", "processor", "workload", "ours", "times_as_fast", "least", "most"]


def read_speed(path):
    try:
        data = json.loads(path.read_text())
    except OSError as error:
        sys.exit(f"{path}: {error.strerror}")
    except ValueError as error:
        sys.exit(f"{path}: is not JSON: {error}")
    schema = (data.get("schema"), data.get("schema_version")) if isinstance(data, dict) else None
    if schema != SCHEMA:
        sys.exit(f"{path}: schema is {schema}; legal: {SCHEMA}")
    return data


def read_history(path):
    """A dictionary for each line."""
    try:
        with path.open(newline="") as file:
            reader = csv.DictReader(file)
            rows = list(reader)
    except OSError as error:
        sys.exit(f"{path}: {error.strerror}")
    if reader.fieldnames != HISTORY:
        sys.exit(f"{path}: columns are {reader.fieldnames}; legal: {HISTORY}")
    return rows
