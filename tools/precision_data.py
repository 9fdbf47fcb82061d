"""The figures of the precision study: what halfspace_study_precision measured, and gates of rtl/synth_study.py."""

import pathlib

from bench_file import read_json

ROOT = pathlib.Path(__file__).resolve().parent.parent
RESULT = ROOT / "out/precision/precision.json"
HARDWARE = ROOT / "docs/precision.json"
FORMATS = {"unorm16": "D16", "unorm24": "D24", "float32": "D32F"}
# Evaluated as another arithmetic is; their difference is in setup.
LIKE = {"float_average": "float_difference"}
STEPS = " by increments"  # behind the name of an arithmetic: in hardware, of integers


def read_result(path):
    return read_json(path, ("halfspace-precision", 1))


def read_hardware(path):
    return read_json(path, ("halfspace-precision-hardware", 1))["osu018"]


def per_million(count, total):
    return 1e6 * count / total if total else 0.0


def edge_sets(edges):
    """Families and frames."""
    return [*edges["families"], *edges["frames"]]


def partitions(edges):
    """Sets in which a gap can be seen: families that tile their target, and frames."""
    return [each for each in edge_sets(edges) if each.get("partition", True)]


def holes(each, name):
    """Gaps and doubles per million pixels."""
    row = each["rows"][name]
    return per_million(row["gaps"], each["pixels"]), per_million(row["doubles"], each["pixels"])


def rate(each, name, what):
    """Of wrong or moved samples, per million."""
    return per_million(each["rows"][name][what], each["samples"])


def depth_sets(depth):
    return [*depth["families"], *depth["frames"]]


def worst_depth(depth, name, depth_format, what="worst"):
    """Of all families and frames; None where the arithmetic does not take the format."""
    rows = [each["formats"][depth_format].get(name) for each in depth_sets(depth)]
    return None if None in rows else max(row[what] for row in rows)


def depth_gates(hardware, name):
    """Of a sample a cycle, what a square of pixels needs once included; None where nothing is measured."""
    if name not in hardware:
        return None
    anchor = hardware.get(f"anchor: {name}")
    if name.startswith("plane_") and name[6:].isdigit() and anchor is None:
        return None
    return hardware[name]["gates"] + (anchor["gates"] if anchor else 0)
