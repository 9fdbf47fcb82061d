"""Synthesizes the units with Yosys: are there latches, how many multipliers, which memories, gates and longest path.

    .venv/bin/python rtl/synth.py [--quick] [UNIT...]           # elaborates only: latches, warnings, multipliers
    .venv/bin/python rtl/synth.py --library osu018 [UNIT...]    # gates of a library, flip-flops, longest path
    .venv/bin/python rtl/synth.py --target ecp5 [UNIT...]       # cells of an FPGA
    .venv/bin/python rtl/synth.py --table [UNIT...]             # both, or the one named, and the tables of docs/hardware.md
"""

import argparse
import pathlib
import sys

from synthesis import tables
from synthesis.runs import Run, missing_tools, synthesize
from synthesis.units import UNITS

DOCS = pathlib.Path(__file__).resolve().parent.parent / "docs"


def describe(run: Run) -> str:
    words = [f"no latch, {len(run.multipliers)} multipliers"]
    if run.target == "osu018":
        words.append(f"{sum(run.cells.values())} gates, {tables.flip_flops(run.cells)} of them flip-flops")
        words.append(f"{run.path.get('ns')} ns from {run.path.get('from')} to {run.path.get('to')}")
    elif run.target == "ecp5":
        words += [f"{count} {kind}" for kind, count in sorted(run.cells.items())]
    return ", ".join(words)


def run_all(options: argparse.Namespace, targets: list[str]) -> list[Run]:
    done = []
    for name in options.units or UNITS:
        for configuration in UNITS[name].configurations:
            if options.only not in f"{configuration.top} {configuration.label}":
                continue
            if options.quick and configuration.long:
                continue
            for target in targets:
                if target != "none" and not configuration.measured:
                    continue
                run = synthesize(UNITS[name], configuration, target)
                label = f"{configuration.top} {configuration.label}"
                verdict = "FAILED" if run.failures else describe(run)
                print(f"{label} [{target}]: {verdict} ({run.seconds:.1f} s)", flush=True)
                for failure in run.failures:
                    print(f"    {failure}", flush=True)
                done.append(run)
                if options.table and not run.failures:
                    tables.write(options.docs, run)
    return done


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("units", nargs="*", metavar="UNIT", help=f"of {', '.join(UNITS)}; all")
    parser.add_argument("--quick", action="store_true", help="without what takes longer")
    parser.add_argument("--library", choices=["osu018"], help="map to its gates and time them")
    parser.add_argument("--target", choices=["ecp5"], help="map to its cells")
    parser.add_argument("--table", action="store_true", help="map to both and write docs/hardware")
    parser.add_argument("--docs", type=pathlib.Path, default=DOCS, help="where the table goes")
    parser.add_argument("--only", default="", metavar="TEXT", help="configurations with this text")
    options = parser.parse_args()
    unknown = set(options.units) - set(UNITS)
    if unknown:
        parser.error(f"no such unit: {', '.join(sorted(unknown))}")
    targets = [target for target in (options.library, options.target) if target]
    if options.table and not targets:
        targets = ["osu018", "ecp5"]
    if "osu018" in targets and missing_tools():
        print(f"synth.py --library osu018 {missing_tools()}", file=sys.stderr)
        return 1
    done = run_all(options, targets or ["none"])
    return 0 if done and not any(run.failures for run in done) else 1


if __name__ == "__main__":
    sys.exit(main())
