#!/usr/bin/env python3
"""Runs the tests that others published, and writes their tables into the pages.

    tools/write_robustness.py                             # all
    tools/write_robustness.py stress-reports              # one of them

`make study-orientation`, `make study-depth-resolution` and `make stress-reports` run this script.
"""

from write_figures import ROOT, main, output

STUDIES = ROOT / "build/release/model/halfspace/study"
PICTURE = "docs/images/orientation_grids.png"


def stress_reports(tools):
    """The scenes of public reports, and who fails on them."""
    options = "--reports --sharpness --cases 16 --depth-bound 1"
    return f"    halfspace stress {options}\n\n{output(tools.program, 'stress', *options.split())}"


def orientation(_tools):
    """Signs of the grids, and their picture."""
    program = STUDIES / "orientation/halfspace_study_orientation"
    return f"    {program.name} {PICTURE}\n\n{output(program, PICTURE)}"


def depth_resolution(_tools):
    """Planes that are indistinguishable or swapped."""
    program = STUDIES / "depth_resolution/halfspace_study_depth_resolution"
    return f"    {program.name}\n\n{output(program)}"


FIGURES = {
    "stress-reports": ("docs/guides/stress.md", stress_reports),
    "orientation": ("docs/guides/robustness.md", orientation),
    "depth-resolution": ("docs/guides/robustness.md", depth_resolution),
}

if __name__ == "__main__":
    main(FIGURES, list(FIGURES), __doc__)
