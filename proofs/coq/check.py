#!/usr/bin/env python3
"""Compiles the proofs in a build folder, and shows that wrong variants of them fail.

    proofs/coq/check.py BUILD_FOLDER

Fails unless every theorem's assumptions are printed, once, and are none; unless README.md counts the theorems
of each file; and unless every mutant of must_fail/mutants.toml makes its file fail behind the line of the
fault. Files of must_fail/ state wrong variants and prove that they are false.
"""

import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
# In the order in which they need each other.
FILES = ("edge_function", "fill_rule", "triangle_cover", "triangle_order", "sub_pixel", "corner_tests",
         "saturation", "widths", "increments", "coverage", "hi_z", "hi_z_bounds", "hi_z_order", "hi_z_plane",
         "late_writes")
CLOSED = "Closed under the global context"


def coqc(build, path):
    """The process, and the seconds of CPU that it took."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    command = ["coqc", "-Q", str(build), "Halfspace", str(path)]
    done = subprocess.run(command, cwd=build, capture_output=True, text=True, check=False)
    return done, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def check_proofs(build, path, name):
    """Compiles a file; returns its number of theorems, and what is wrong."""
    text = path.read_text()
    theorems = re.findall(r"^\s*Theorem\s+(\w+)", text, re.M)
    printed = re.findall(r"^Print Assumptions (\w+)\.", text, re.M)
    done, seconds = coqc(build, path)
    print(f"{name}: {len(theorems)} theorems, {seconds:.1f} s")
    if done.returncode != 0:
        return len(theorems), [f"{name}: {done.stderr.strip()}"]
    wrong = []
    if sorted(theorems) != sorted(printed):
        wrong.append(f"{name}: assumptions are printed of {len(printed)} of {len(theorems)} theorems")
    if done.stdout.count(CLOSED) != len(theorems) or "Axioms:" in done.stdout:
        wrong.append(f"{name}: a theorem is not closed: {done.stdout.strip()}")
    return len(theorems), wrong


def check_mutant(build, name, mutant):
    """What is wrong: a mutant that compiles, or fails for another reason than its fault."""
    text = (HERE / mutant["file"]).read_text()
    if text.count(mutant["from"]) != 1:
        return [f"{name}: the text to change is in {mutant['file']} {text.count(mutant['from'])} times"]
    # A folder of its own: the compiled files of the others stay those of the real proofs.
    folder = build / "mutants" / name
    folder.mkdir(parents=True)
    path = folder / mutant["file"]
    path.write_text(text.replace(mutant["from"], mutant["to"]))
    done, _ = coqc(build, path)
    if done.returncode == 0:
        return [f"{name}: compiles"]
    at = re.search(r"line (\d+), characters.*\nError:\s*(.*)", done.stderr)
    line = text[:text.index(mutant["from"]) + len(mutant["from"])].count("\n") + 1
    if at is None or int(at[1]) <= line or "yntax" in at[2]:
        return [f"{name}: fails for another reason: {done.stderr.strip()}"]
    print(f"must fail, {name}: red in line {at[1]} of {mutant['file']}")
    return []


def main():
    if len(sys.argv) != 2:
        print(__doc__)
        return 2
    build = pathlib.Path(sys.argv[1]).resolve()
    if build.exists() and any(build.iterdir()):
        print(f"{build}: is not empty")
        return 2
    build.mkdir(parents=True, exist_ok=True)
    readme = (HERE / "README.md").read_text()
    total = 0
    wrong = []
    for name in FILES:
        path = shutil.copy(HERE / f"{name}.v", build)
        count, faults = check_proofs(build, pathlib.Path(path), name)
        total += count
        wrong += faults
        if not re.search(rf"^\| \[`{name}\.v`\]\({name}\.v\) \| {count} \|", readme, re.M):
            wrong.append(f"{name}: README.md does not have {count} theorems for it")
    for path in sorted((HERE / "must_fail").glob("*.v")):
        (build / "false").mkdir(exist_ok=True)
        copy = pathlib.Path(shutil.copy(path, build / "false"))
        _, faults = check_proofs(build, copy, f"false, {path.stem}")
        wrong += faults
    mutants = tomllib.loads((HERE / "must_fail" / "mutants.toml").read_text())
    for name, mutant in mutants.items():
        wrong += check_mutant(build, name, mutant)
    unlisted = {path.stem for path in HERE.glob("*.v")} - set(FILES)
    wrong += [f"{name}: not in the list of files" for name in sorted(unlisted)]
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    print(f"{total} theorems, {len(mutants)} mutants, {len(wrong)} faults, {seconds:.0f} s of CPU")
    print("\n".join(wrong), end="\n" if wrong else "")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
