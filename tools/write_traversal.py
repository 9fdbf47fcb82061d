#!/usr/bin/env python3
"""Runs every walk on every frame, and writes the tables of docs/guides/traversal.md and out/traversal/traversal.json.

    tools/write_traversal.py --captured DIR/*.ptf.xz
    tools/write_traversal.py traversal-leaves          # one of the tables; the picture is of the other

Ends with an error where two walks of a frame do not draw the same. `make study-traversal` runs this script.
"""

import json
import sys

from traversal_data import METRICS, RESULT, SCHEMA, TILE_SIZES, name_of, settings_of, walks
from write_figures import CAPTURED, SCENES, frame_name, main, run_stats

PAGE = "docs/guides/traversal.md"
SYNTHETIC = ("tiny_rand", "medium", "sliver")
# Of a machine with tiles of another size: blocks of 4 x 4 tiles, as many bytes in the z cache.
LEAVES = [(2, "raster"), (3, "raster"), (3, "hilbert")]


def measured(tools, frame, settings):
    """What a run took, and what it drew, which may not depend on the walk."""
    words = [word for setting in settings for word in ("--set", setting)]
    result = run_stats(tools, frame, *words)["frame"]
    counters = result["counters"]
    walker, tiles, early_z = counters["block_walker"], counters["tile_walker"], counters["early_z"]
    jobs = tiles["tiles_accepted"] + tiles["tiles_partial"]
    return {
        "steps": (walker["blocks"] + walker["passes"]) / jobs,
        "cycles": result["time"]["cycles"],
        "misses": early_z["z_misses"],
        "bytes": early_z["bytes_read"] + early_z["bytes_written"] + result["flushed_bytes"],
        "drawn": {
            "fragments": counters["quad_generator"]["fragments"],
            "quads": counters["quad_generator"]["quads"],
            "survivors": early_z["survivors"],
            "written": early_z["written"],
        },
    }


def compared(tools, frame, machines):
    """{name: what measured() says} of these {name: settings}, which draw the same."""
    runs = {name: measured(tools, frame, settings) for name, settings in machines.items()}
    drawn = [run.pop("drawn") for run in runs.values()]
    if any(other != drawn[0] for other in drawn):
        sys.exit(f"{frame}: the walks draw {drawn}")
    return runs


def frames(tools):
    """{name: what `halfspace run` takes}"""
    named = {frame_name(path): str(path) for path in SCENES}
    named |= {frame_name(path) + CAPTURED: str(path) for path in tools.captured}
    return named | {f"synthetic:{name}": f"synthetic:{name}" for name in SYNTHETIC}


def tables(runs, metrics, first):
    """Of {frame: {machine: measured}}: a table a metric, a row a machine, a column a frame."""
    text = []
    for metric in metrics:
        title, number = METRICS[metric]
        text += [f"{title[0].upper()}{title[1:]}:", "", f"| {first} | {' | '.join(runs)} |"]
        text += ["|---|" + "---:|" * len(runs)]
        for machine in next(iter(runs.values())):
            cells = [number(of_frame[machine][metric]) for of_frame in runs.values()]
            text.append(f"| {machine} | {' | '.join(cells)} |")
        text.append("")
    return text


def walks_figure(tools):
    machines = {name_of(*walk): settings_of(*walk) for walk in walks()}
    runs = {name: compared(tools, frame, machines) for name, frame in frames(tools).items()}
    RESULT.parent.mkdir(parents=True, exist_ok=True)
    name, version = SCHEMA
    RESULT.write_text(json.dumps({"schema": name, "schema_version": version, "frames": runs}, indent=1) + "\n")
    text = ["    halfspace run FRAME --fidelity recurrence --set block_walker.levels=N --set block_walker.order=ORDER"]
    text += ["", f"{len(runs)} frames, {len(machines)} walks of each: all have the same fragments, quads,"]
    text += ["survivors and samples written. *Captured* frames do not ship.", ""]
    return "\n".join(text + tables(runs, METRICS, "walk"))


def leaves_figure(tools):
    machines = {}
    for size in TILE_SIZES:
        shape = [f"tile_walker.tile_size={size}", f"block_walker.block_size={4 * size}"]
        shape += [f"z_cache.lines={128 * 64 // size**2}"]
        for walk in LEAVES:
            machines[f"{size} x {size}, {name_of(*walk)}"] = [*shape, *settings_of(*walk)]
    runs = {}
    for name, frame in frames(tools).items():
        of_size = {}
        for size in TILE_SIZES:  # quads are the same, tiles are not
            of_size |= compared(tools, frame, {k: v for k, v in machines.items() if k.startswith(f"{size} x")})
        runs[name] = of_size
    text = ["    halfspace run FRAME --fidelity recurrence --set tile_walker.tile_size=T \\"]
    text += ["      --set block_walker.block_size=4T --set z_cache.lines=8192/T^2 --set block_walker.levels=N ...", ""]
    return "\n".join(text + tables(runs, ["steps", "cycles", "bytes"], "tiles, walk"))


FIGURES = {"traversal-walks": (PAGE, walks_figure), "traversal-leaves": (PAGE, leaves_figure)}

if __name__ == "__main__":
    main(FIGURES, list(FIGURES), __doc__)
