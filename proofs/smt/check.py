#!/usr/bin/env python3
"""Proves the properties of proofs.toml over the RTL, and refutes every mutant of mutants.toml.

    .venv/bin/python proofs/smt/check.py BUILD_FOLDER            # a new folder
    .venv/bin/python proofs/smt/check.py BUILD_FOLDER --gate     # only what `make lint` runs
    .venv/bin/python proofs/smt/check.py BUILD_FOLDER --only NAME [--example]
    .venv/bin/python proofs/smt/check.py BUILD_FOLDER --table    # writes README.md's table

Fails unless every assertion is proved and every cover is met; unless every adder is proved exact or is listed as one
that wraps, and each listed one is there; unless the assertion that a mutant names is refuted by a counterexample; and
unless README.md has a line for each proof.
"""

import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys

from prover import catalog

HERE = pathlib.Path(__file__).resolve().parent
JOB = HERE / "prover" / "job.py"


class Run:
    """One configuration of a proof, in a folder of its own."""

    def __init__(self, folder, proof, configuration, rtl, breaks=None, example=False):
        self.proof, self.folder, self.faults = proof, folder, []
        folder.mkdir(parents=True)
        self.rtl = self._narrowed(rtl)
        job = {**proof.job(configuration, self.rtl), "breaks": breaks, "example": example, "folder": str(folder),
               "result": str(folder / "result.json")}
        (folder / "job.json").write_text(json.dumps(job, indent=1))
        self.result, self.seconds = self._prove()

    def _narrowed(self, rtl):
        if not self.proof.narrowed:
            return rtl
        own = self.folder / "rtl"
        shutil.copytree(rtl, own, ignore=shutil.ignore_patterns("synthesis", "__pycache__"))
        package = own / "raster_pkg.sv"
        text = package.read_text()
        for old, new in self.proof.narrowed.items():
            if text.count(old) != 1:
                self.faults.append(f"the text to change is in raster_pkg.sv {text.count(old)} times: {old}")
            text = text.replace(old, new)
        package.write_text(text)
        return own

    def _prove(self):
        """The result, or None where Yosys or the job failed; and the seconds of CPU."""
        with open(self.folder / "log", "w") as log:
            started = subprocess.Popen([sys.executable, str(JOB), str(self.folder / "job.json")], stdout=log,
                                       stderr=subprocess.STDOUT)
            _, status, usage = os.wait4(started.pid, 0)
            started.returncode = os.waitstatus_to_exitcode(status)
        seconds = usage.ru_utime + usage.ru_stime
        if started.returncode != 0:
            lines = (self.folder / "log").read_text().splitlines()
            self.faults += [line for line in lines if "error" in line.lower()][-3:] or lines[-3:]
            return None, seconds
        return json.loads((self.folder / "result.json").read_text()), seconds

    def failed(self):
        """What was not proved, adders by their text: {name: how}."""
        adders = self.result["adders"]
        return {adders.get(label, label): how for label, how in self.result["failed"].items()}


def check_proof(build, proof, example):
    """All configurations; returns the numbers for the table, and what is wrong."""
    asserts, seconds, wrong = 0, 0.0, []
    exact, wrapped = set(), set()
    for number, configuration in enumerate(proof.configurations):
        run = Run(build / proof.name / str(number), proof, configuration, catalog.RTL, example=example)
        seconds += run.seconds
        faults = list(run.faults)
        if run.result:
            asserts += run.result["asserts"]
            texts = set(run.result["adders"].values())
            exact |= texts - set(proof.wraps)
            wrapped |= texts & set(proof.wraps)
            faults += [f"{name}: {how}" for name, how in run.failed().items() if name not in proof.wraps]
            faults += [f"the cover {label} is not met" for label in run.result["unmet"]]
            if run.result["asserts"] == 0:
                faults.append("nothing is asserted")
        wrong += [f"{proof.name} {configuration}: {fault}" for fault in faults]
    wrong += [f"{proof.name}: no adder is `{text}`" for text in [*proof.wraps, *proof.as_signed]
              if text not in exact | wrapped]
    print(f"{proof.name}: {'FAILED' if wrong else 'proved'}, {asserts} assertions, {seconds:.1f} s", flush=True)
    return {"asserts": asserts, "seconds": seconds, "exact": len(exact), "wrapped": len(wrapped)}, wrong


def check_mutant(build, mutant, proof):
    """What is wrong: a fault in the RTL that the proof does not find."""
    folder = build / "mutants" / mutant.name
    rtl = folder / "rtl"
    shutil.copytree(catalog.RTL, rtl, ignore=shutil.ignore_patterns("synthesis", "__pycache__"))
    shutil.copytree(HERE / "lemmas", rtl / "lemmas")
    path = rtl / mutant.file
    text = path.read_text()
    if text.count(mutant.old) != 1:
        return [f"{mutant.name}: the text to change is in {mutant.file} {text.count(mutant.old)} times"], 0.0
    path.write_text(text.replace(mutant.old, mutant.new))
    run = Run(folder / "job", proof, proof.configurations[mutant.configuration], rtl, breaks=mutant.breaks)
    if run.faults:
        return [f"{mutant.name}: {fault}" for fault in run.faults], run.seconds
    how = run.failed().get(mutant.breaks, "is not refuted")
    if not how.endswith(": sat"):
        return [f"{mutant.name}: {mutant.breaks} {how}"], run.seconds
    print(f"must fail, {mutant.name}: {mutant.breaks} refuted, {how.removesuffix(': sat')}", flush=True)
    return [], run.seconds


def row(proof, numbers):
    """A line of README.md's table, up to the seconds."""
    over = "; ".join(", ".join(f"{key.removeprefix('HALFSPACE_').lower() if key.isupper() else key} {value}"
                               for key, value in configuration.items()) or "baseline"
                     for configuration in proof.configurations)
    if proof.kind == "lemma":
        over = "integers"
    if proof.narrowed:
        over = "narrowed"
    adders = f"{numbers['exact']} and {numbers['wrapped']}" if proof.adders else ""
    return f"| {proof.name} | {proof.says} | {over} | {proof.solver} | {numbers['asserts']} | {adders} |"


def write_table(readme, text, summary, rows):
    """Puts the rows and a sentence between the marks."""
    begin, end = "<!-- proofs: begin -->\n", "<!-- proofs: end -->"
    head, rest = text.split(begin)
    table = ["| proof | says | over | solver | assertions | sums in the source: exact, may wrap | seconds |",
             "|---|---|---|---|---:|---:|---:|", *rows]
    readme.write_text(head + begin + "\n" + "\n".join(table) + f"\n\n{summary}.\n\n" + end + rest.split(end)[1])


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, metavar="BUILD_FOLDER")
    parser.add_argument("--gate", action="store_true", help="only proofs of the gate")
    parser.add_argument("--only", metavar="NAME", help="one proof and its mutants")
    parser.add_argument("--example", action="store_true", help="print the signals of each counterexample")
    parser.add_argument("--table", action="store_true", help="write README.md's table")
    options = parser.parse_args()
    if options.table and (options.gate or options.only):
        parser.error("--table writes the seconds of all proofs: not with --gate or --only")
    return options


def main():
    options = parse()
    build = options.build.resolve()
    if build.exists() and any(build.iterdir()):
        print(f"{build}: is not empty")
        return 2
    proofs = catalog.proofs()
    if options.only and options.only not in proofs:
        print(f"{options.only}: is no proof; there are {', '.join(proofs)}")
        return 2
    chosen = {name: proof for name, proof in proofs.items()
              if (proof.gate or not options.gate) and options.only in (None, name)}
    measured, wrong, mutant_seconds, count = {}, [], 0.0, 0
    for proof in chosen.values():
        measured[proof.name], faults = check_proof(build, proof, options.example)
        wrong += faults
    proved = not wrong
    for mutant in catalog.mutants():
        if mutant.proof not in proofs:
            wrong.append(f"{mutant.name}: {mutant.proof} is no proof")
        elif mutant.proof in chosen:
            faults, seconds = check_mutant(build, mutant, proofs[mutant.proof])
            wrong += faults
            mutant_seconds += seconds
            count += 1
    seconds = sum(numbers["seconds"] for numbers in measured.values())
    summary = f"{len(chosen)} proofs in {seconds:.0f} s, {count} mutants in {mutant_seconds:.0f} s of CPU"
    readme = HERE / "README.md"
    rows = {name: row(proofs[name], numbers) for name, numbers in measured.items()}
    if options.table and proved:
        write_table(readme, readme.read_text(), summary,
                    [f"{text} {measured[name]['seconds']:.1f}{' *' if proofs[name].gate else ''} |"
                     for name, text in rows.items()])
    text = readme.read_text()
    wrong += [f"{name}: README.md has no such line: {line}" for name, line in rows.items() if line not in text]
    print(f"{summary}, {len(wrong)} faults")
    print("\n".join(wrong), end="\n" if wrong else "")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
