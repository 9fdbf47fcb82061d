#!/usr/bin/env python3
"""Measures pictures of few samples a pixel beside pictures of very many, and what samples cost, and writes the
tables of docs/guides/multisampling.md and out/samples/samples.json.

    tools/write_samples.py --captured DIR/*.ptf.xz
    tools/write_samples.py samples-cost          # one of the tables; the picture is of the other

The reference is the frame at 16 x 16 times as many pixels, or 8 x 8 where those are more than a frame may have.
`make study-samples` runs this script.
"""

import json
import pathlib
import tempfile

import numpy
from matplotlib.image import imread

from samples_data import FILTERS, METHODS, MULTISAMPLING, RESULT, SAMPLES, SCHEMA, TIMES, supersampling
from write_figures import CAPTURED, SCENES, frame_name, main, output, run_stats

PAGE = "docs/guides/multisampling.md"
LARGEST_SIDE = 16384
MOST_PIXELS = 1 << 28


def frames(tools):
    """{name: path}"""
    named = {frame_name(path): path for path in SCENES}
    return named | {frame_name(path) + CAPTURED: path for path in tools.captured}


def shaded(tools, path, *options):
    """All shaded pictures of a frame, one behind the other, in units of 8 bits."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "run"
        output(tools.program, "run", path, *map(str, options), "--out", out)
        pictures = [imread(each)[..., :3].ravel() for each in sorted(out.glob("shaded*.png"))]
    return 255 * numpy.concatenate(pictures).astype(numpy.float64)


def magnification(surfaces):
    """How many times as large the reference is drawn."""
    side = max(max(each["width"], each["height"]) for each in surfaces)
    pixels = sum(each["width"] * each["height"] for each in surfaces)
    return 16 if 16 * side <= LARGEST_SIDE and 256 * pixels <= MOST_PIXELS else 8


def errors(tools, path):
    """{method: {samples: root mean square error, in units of 8 bits}} and what the reference was."""
    times = magnification(run_stats(tools, path)["surfaces"])
    found = {method: {} for method in METHODS}
    for each in FILTERS:
        reference = shaded(tools, path, "--supersample", times, "--filter", each)

        def error(*options, reference=reference):
            return float(numpy.sqrt(numpy.mean((shaded(tools, path, *options) - reference) ** 2)))

        for smaller in TIMES:
            found[supersampling(each)][smaller**2] = error("--supersample", smaller, "--filter", each)
        if each == "box":
            for samples in SAMPLES:
                found[MULTISAMPLING][samples] = error("--set", f"raster.samples={samples}")
    return {"reference": times**2, "error": found}


def error_figure(tools):
    result = {name: errors(tools, path) for name, path in frames(tools).items()}
    RESULT.parent.mkdir(parents=True, exist_ok=True)
    name, version = SCHEMA
    RESULT.write_text(json.dumps({"schema": name, "schema_version": version, "frames": result}, indent=1) + "\n")
    heads = [f"{method}: {samples}" for method, all_samples in METHODS.items() for samples in all_samples]
    text = ["    halfspace run FRAME --set raster.samples=N --out DIR"]
    text += ["    halfspace run FRAME --supersample K --filter FILTER --out DIR", ""]
    text += [f"| frame | samples of the reference | {' | '.join(heads)} |", "|---|" + "---:|" * (len(heads) + 1)]
    for frame, of_frame in result.items():
        cells = [f"{of_frame['error'][method][n]:.2f}" for method, all_samples in METHODS.items() for n in all_samples]
        text.append(f"| {frame} | {of_frame['reference']} | {' | '.join(cells)} |")
    return "\n".join(text)


def cost_figure(tools):
    """What a frame takes with each number of samples."""
    text = ["    halfspace run FRAME --fidelity recurrence --set raster.samples=N", ""]
    columns = ["cycles", "tile jobs", "quads", "quads a cycle", "bytes of depth"]
    text += [f"| frame | samples | {' | '.join(columns)} |", "|---|" + "---:|" * (len(columns) + 1)]
    for name, path in frames(tools).items():
        for samples in SAMPLES:
            frame = run_stats(tools, path, "--set", f"raster.samples={samples}")["frame"]
            tiles, early_z = frame["counters"]["tile_walker"], frame["counters"]["early_z"]
            cycles, quads = frame["time"]["cycles"], frame["counters"]["quad_generator"]["quads"]
            moved = early_z["bytes_read"] + early_z["bytes_written"] + frame["flushed_bytes"]
            jobs = tiles["tiles_accepted"] + tiles["tiles_partial"]
            row = f"{cycles:,} | {jobs:,} | {quads:,} | {quads / cycles:.2f} | {moved:,}"
            text.append(f"| {name} | {samples} | {row} |")
    return "\n".join(text)


FIGURES = {"samples-error": (PAGE, error_figure), "samples-cost": (PAGE, cost_figure)}

if __name__ == "__main__":
    main(FIGURES, list(FIGURES), __doc__)
