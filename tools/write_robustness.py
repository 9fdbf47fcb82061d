#!/usr/bin/env python3
"""Runs the tests that others published, and writes their tables into the pages.

    tools/write_robustness.py                             # all
    tools/write_robustness.py stress-reports              # one of them

`make stress-reports` runs this script.
"""

from write_figures import main, output


def stress_reports(tools):
    """The scenes of public reports, and who fails on them."""
    options = "--reports --sharpness --cases 16 --depth-bound 1"
    return f"    halfspace stress {options}\n\n{output(tools.program, 'stress', *options.split())}"


FIGURES = {
    "stress-reports": ("docs/guides/stress.md", stress_reports),
}

if __name__ == "__main__":
    main(FIGURES, list(FIGURES), __doc__)
