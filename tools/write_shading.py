#!/usr/bin/env python3
"""Draws a floor by each interpolation, measures the interpolator's error, and writes both into
docs/guides/shading.md.

    tools/write_shading.py                       # both
    tools/write_shading.py interpolation-error   # the table

`make study-interpolation` runs this script.
"""

import json
import pathlib
import shutil
import tempfile

from write_figures import ROOT, main, output

PAGE = "docs/guides/shading.md"
STUDY = ROOT / "build/release/model/halfspace/study/interpolation/halfspace_study_interpolation"
KINDS = ("perspective", "affine", "flat")
# A floor of two triangles, 6 wide and 12 deep, with 8 squares of the checker across and 16 along.
FLOOR = """ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
property float u
property float v
element face 1
property list uchar int vertex_indices
end_header
-3 0 0 0 0
3 0 0 1 0
3 0 -12 1 2
-3 0 -12 0 2
4 0 1 2 3
"""
VIEW = ("--size", "320x180", "--eye", "0,1.5,1.6", "--at", "0,-0.5,-3", "--fov", "60")


def pictures(tools):
    """The floor by each interpolation, side by side."""
    with tempfile.TemporaryDirectory() as folder:
        mesh = pathlib.Path(folder) / "floor.ply"
        mesh.write_text(FLOOR)
        for kind in KINDS:
            out = pathlib.Path(folder) / kind
            output(tools.program, "run", mesh, *VIEW, "--interpolation", kind, "--out", out)
            shutil.copy(out / "shaded0.png", ROOT / f"docs/images/interpolation_{kind}.png")
    cells = " | ".join(f"![{kind}](../images/interpolation_{kind}.png)" for kind in KINDS)
    return f"| {' | '.join(KINDS)} |\n|{'---|' * len(KINDS)}\n| {cells} |"


def area_of(bits):
    """What the weights at one pixel take in the RTL of this precision, where docs/hardware.json has it."""
    rows = json.loads((ROOT / "docs/hardware.json").read_text())["osu018"]
    for row in rows:
        if row["top"] == "perspective_weights" and row["configuration"] == f"Bits={bits}":
            return f"{row['gates']:,}"
    return "-"


def error(_tools):
    """The interpolator's error by its precision, beside what its RTL takes."""
    result = json.loads(output(STUDY))
    lines = [
        f"{result['samples']:,} pixels of random triangles at each precision; a coordinate from 0 to 1.",
        "",
        "| bits | worst error | mean error | gates of `perspective_weights` (osu018) |",
        "|---:|---:|---:|---:|",
    ]
    for row in result["bits"]:
        lines.append(f"| {row['bits']} | {row['worst']:.2e} | {row['mean']:.2e} | {area_of(row['bits'])} |")
    return "\n".join(lines)


FIGURES = {
    "interpolation-pictures": (PAGE, pictures),
    "interpolation-error": (PAGE, error),
}

if __name__ == "__main__":
    main(FIGURES, list(FIGURES), __doc__)
