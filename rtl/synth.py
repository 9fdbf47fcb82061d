"""Synthesizes a unit with Yosys (pyosys) in the configurations of its benches and prints the cells of each.

Fails on a warning, a latch, or a multiplier: constants are multiplied by shifts and adds.

    .venv/bin/python rtl/synth.py edge_evaluator [--tile-size 8] [--sub-pixel-bits 8] [--quick]
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time

RTL = pathlib.Path(__file__).resolve().parent
SOURCES = {
    "edge_evaluator": [
        "raster_pkg",
        "credit_fifo",
        "pipe_register",
        "edge_saturate",
        "edge_steps",
        "edge_signs",
        "half_plane",
        "edge_evaluator",
    ],
    "tile_walker": [
        "raster_pkg",
        "credit_fifo",
        "pipe_register",
        "corner_test",
        "walk_edge",
        "walk_position",
        "tile_walker",
    ],
}
CONFIGURATIONS = [(4, 8), (4, 4), (8, 8), (8, 5), (16, 8), (16, 7)]
FORBIDDEN = ["$mul", "$div", "$mod", "$dlatch", "$adlatch", "$dlatchsr"]
# Of the optimizer's own working, not of the design.
HARMLESS = re.compile(r"ABC: Warning: The network is combinational")


def synthesize(unit, tile_size, sub_pixel_bits, map_to_gates, statistics):
    """Runs in a process of its own, because Yosys ends its process on an error."""
    from pyosys import libyosys as ys

    design = ys.Design()
    files = " ".join(str(RTL / f"{name}.sv") for name in SOURCES[unit])
    ys.run_pass(
        f"read_slang -D SYNTHESIS -D HALFSPACE_TILE_SIZE={tile_size}"
        f" -D HALFSPACE_SUB_PIXEL_BITS={sub_pixel_bits} --top {unit} {files}",
        design,
    )
    ys.run_pass(f"hierarchy -check -top {unit}; proc; flatten; check -assert", design)
    ys.run_pass("select -assert-none " + " ".join(f"t:{cell}" for cell in FORBIDDEN), design)
    if map_to_gates:
        ys.run_pass(f"synth -top {unit}; opt_clean -purge; check -assert", design)
        ys.run_pass("select -assert-none t:$_DLATCH*", design)
    else:
        ys.run_pass("opt; memory -nomap; opt_clean -purge; check -assert", design)
    ys.run_pass(f"tee -q -o {statistics} stat -json", design)


def run(unit, tile_size, sub_pixel_bits, map_to_gates):
    with tempfile.TemporaryDirectory() as folder:
        statistics = pathlib.Path(folder) / "stat.json"
        start = time.monotonic()
        command = [sys.executable, __file__, unit, "--tile-size", str(tile_size)]
        command += ["--sub-pixel-bits", str(sub_pixel_bits), "--statistics", str(statistics)]
        command += [] if map_to_gates else ["--quick"]
        result = subprocess.run(command, capture_output=True, text=True)
        log = result.stdout + result.stderr
        warnings = [
            line
            for line in log.splitlines()
            if re.search("warning", line, re.IGNORECASE)
            and not HARMLESS.search(line)
            and not re.search(r"\b0 warnings", line)
        ]
        name = f"{unit} TileSize={tile_size} SubPixelBits={sub_pixel_bits}"
        if result.returncode != 0 or warnings:
            print(f"{name}: FAILED")
            print("\n".join(warnings) if warnings else "\n".join(log.splitlines()[-15:]))
            return False
        cells = json.loads(statistics.read_text())["design"]["num_cells_by_type"]
        seconds = time.monotonic() - start
        if map_to_gates:
            flip_flops = sum(count for kind, count in cells.items() if "DFF" in kind)
            counts = f"{sum(cells.values()) - flip_flops} gates, {flip_flops} flip-flops"
        else:
            counts = f"{sum(cells.values())} cells before mapping to gates"
        print(f"{name}: {counts} ({seconds:.0f} s)", flush=True)
        return True


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("unit", choices=SOURCES)
    parser.add_argument("--tile-size", type=int)
    parser.add_argument("--sub-pixel-bits", type=int)
    parser.add_argument("--quick", action="store_true", help="no gates for tiles of 16 x 16 pixels")
    parser.add_argument("--statistics", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.statistics:
        synthesize(
            options.unit,
            options.tile_size,
            options.sub_pixel_bits,
            not options.quick,
            options.statistics,
        )
        return 0
    wanted = [
        (tile_size, bits)
        for tile_size, bits in CONFIGURATIONS
        if options.tile_size in (None, tile_size) and options.sub_pixel_bits in (None, bits)
    ]
    results = [run(options.unit, *c, not options.quick or c[0] < 16) for c in wanted]
    return 0 if results and all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
