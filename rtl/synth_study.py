"""Synthesizes what the precision study compares, with Yosys: gates, flip-flops and longest path of each arithmetic.

    .venv/bin/python rtl/synth_study.py --quick               # elaborates only: latches, warnings, multipliers
    .venv/bin/python rtl/synth_study.py --json docs/precision.json [NAME...]

The file keeps what is measured already; names that are given are measured again, without names those that are missing.
"""

import argparse
import json
import pathlib
import sys

from synthesis import tables
from synthesis.runs import missing_tools, synthesize
from synthesis.study import NAMES

SCHEMA = {"schema": "halfspace-precision-hardware", "schema_version": 1}


def measure(path: pathlib.Path, names: list[str]) -> bool:
    figures = json.loads(path.read_text()) if path.exists() else {**SCHEMA, "osu018": {}}
    done = figures["osu018"]
    for name in names or [name for name in NAMES if name not in done]:
        run = synthesize(*NAMES[name], "osu018")
        if run.failures:
            print(f"{name}: FAILED: " + "; ".join(run.failures), file=sys.stderr)
            return False
        flip_flops = tables.flip_flops(run.cells)
        done[name] = {
            "module": run.configuration.top,
            "configuration": run.configuration.label,
            "gates": sum(run.cells.values()) - flip_flops,
            "flip_flops": flip_flops,
            "area": round(run.area),
            "path": run.path["ns"],
        }
        print(f"{name}: {done[name]['gates']} gates, {run.path['ns']} ns ({run.seconds:.0f} s)", flush=True)
        figures["osu018"] = {key: done[key] for key in NAMES if key in done}
        path.write_text(json.dumps(figures, indent=1) + "\n")
    return True


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help="arithmetics: " + ", ".join(NAMES))
    parser.add_argument("--quick", action="store_true", help="only elaborate")
    parser.add_argument("--json", type=pathlib.Path, help="where the figures go")
    options = parser.parse_args()
    for name in options.names:
        if name not in NAMES:
            parser.error(f"arithmetic is '{name}'; legal: {', '.join(NAMES)}")
    if options.quick:
        runs = {name: synthesize(*what, "none") for name, what in NAMES.items()}
        for name, run in runs.items():
            print(f"{name}: " + ("FAILED: " + "; ".join(run.failures) if run.failures else "elaborates"))
        return 1 if any(run.failures for run in runs.values()) else 0
    if options.json is None:
        parser.error("--json is missing: where the figures go")
    if missing_tools():
        print(f"synth_study.py {missing_tools()}", file=sys.stderr)
        return 1
    return 0 if measure(options.json, options.names) else 1


if __name__ == "__main__":
    sys.exit(main())
