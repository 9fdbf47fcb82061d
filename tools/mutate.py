#!/usr/bin/env python3
"""Mutation test of a unit's bench: changes the unit's SystemVerilog in one place, builds and runs
the bench, and tells what found the change, or that nothing did.

    tools/mutate.py edge_evaluator --count 10 --seed 1
    tools/mutate.py quad_generator --model t8_w4_p1 --model t4_w4_p2 -- --tiles 2000

A build folder must hold the unit's bench; its own commands are run again on a copy of the sources.
A mutant that survives is one that no case tells from the original: a hole of the bench, or a change
that changes nothing.
"""

import argparse
import pathlib
import random
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass

ROOT = pathlib.Path(__file__).resolve().parent.parent
RTL = ROOT / "rtl"
# Printed, or checkers themselves.
NOT_MUTATED = {"raster_pkg", "handshake_checker"}
KINDS = {
    10: "payload",
    11: "missing",
    12: "order",
    13: "extra",
    14: "handshake",
    15: "timing",
    16: "deadlock",
    17: "assertion",
    18: "functional coverage",
}
OPERATORS = {
    "==": ["!="],
    "!=": ["=="],
    "<=": ["<"],
    ">=": [">"],
    "<": ["<="],
    ">": [">="],
    "&&": ["||"],
    "||": ["&&"],
    "&": ["|"],
    "|": ["&"],
    "^": ["|"],
    "+": ["-"],
    "-": ["+"],
    "<<": [">>"],
    ">>": ["<<"],
    ">>>": [">>"],
    "&=": ["|="],
    "|=": ["&="],
}
OPERATOR = re.compile(r"<<<|>>>|<<|>>|==|!=|<=|>=|&&|\|\||\+\+|--|->|\+:|-:|[-+*/&|^<>]=|[<>&|^+-]")
NUMBER = re.compile(r"(?<![\w'.])\d+(?![\w'])")
BIT = re.compile(r"1'b([01])\b")
FILL = re.compile(r"(?<!\w)'([01])(?![\w'])")
NEGATION = re.compile(r"[~!](?=[\w(])")
TERM = r"[~!]?\w+(?:\.\w+)*(?:\[[^][]*\])?"
RIGHT_TERM = re.compile(rf"\s+&&?\s+{TERM}(?=\s*[;,)&|\n?:])")
LEFT_TERM = re.compile(rf"(?:(?<=[=?:]\s)|(?<=[(|]))({TERM}\s+&&?\s+)(?=[\w(~!])")
OPERANDS = re.compile(rf"({TERM})(\s+(?:-|<<|>>)\s+)({TERM})(?=\s*[;,)\n])")
CHOICE = re.compile(r"\?\s*([^?:;()\n]+?)\s*:\s*([^?:;()\n]+?)(?=\s*[;,)])")


@dataclass(frozen=True)
class Mutant:
    file: str
    start: int
    end: int
    text: str
    what: str


def blank(text, pattern, flags=0):
    """The text with all that matches replaced by blanks, so that positions stay."""
    return re.sub(pattern, lambda m: re.sub(r"[^\n]", " ", m.group()), text, flags=flags)


def code_only(text):
    """What may be mutated: no comments, strings, assertions, declarations, headers, loops' heads."""
    text = blank(text, r"/\*.*?\*/|//[^\n]*", re.S)
    text = blank(text, r"\"[^\"\n]*\"")
    text = blank(text, r"`ifndef SYNTHESIS.*?`endif", re.S)
    text = blank(text, r"`ifdef SYNTHESIS.*?`endif", re.S)
    text = blank(text, r"\(\*.*?\*\)")
    text = blank(text, r"`[^\n]*")
    text = blank(text, r"\b(?:module|package)\b.*?\)\s*;", re.S)
    text = blank(text, r"\btypedef\b.*?;", re.S)
    text = blank(text, r"\bfor\s*\([^)]*\)")
    text = blank(text, r"\b(?:logic|bit|\w+_t)\b\s*(?:\[[^;\n]*\]\s*)?[\w\s,]+(?:\[[^;\n]*\])?;")
    return blank(text, r"\b(?:logic|bit)\b\s*(?:signed\s*)?\[[^]\n]*\]")


def is_binary(code, position):
    before = code[:position].rstrip()
    return bool(before) and (before[-1].isalnum() or before[-1] in "_)]}'")


def is_assignment(code, position):
    """Whether <= at this position is a non-blocking assignment."""
    statement = re.split(r";|\bbegin\b|\bend\b|\belse\b", code[:position])[-1]
    depth = statement.count("(") - statement.count(")")
    return depth == 0 and not re.search(r"[^=!<>]=[^=]", statement)


def candidates(name, text):
    code = code_only(text)

    def mutant(start, end, replacement, what):
        return Mutant(name, start, end, replacement, what)

    for match in OPERATOR.finditer(code):
        operator = match.group()
        if operator not in OPERATORS or not is_binary(code, match.start()):
            continue
        if operator == "<=" and is_assignment(code, match.start()):
            continue
        for other in OPERATORS[operator]:
            yield mutant(*match.span(), other, "operator")
    for match in NUMBER.finditer(code):
        value = int(match.group())
        for other in {value + 1, max(value - 1, 0)} - {value}:
            yield mutant(*match.span(), str(other), "constant")
    for match in BIT.finditer(code):
        yield mutant(*match.span(), f"1'b{1 - int(match.group(1))}", "constant")
    for match in FILL.finditer(code):
        yield mutant(*match.span(), f"'{1 - int(match.group(1))}", "constant")
    for match in NEGATION.finditer(code):
        yield mutant(*match.span(), "", "negation removed")
    for match in RIGHT_TERM.finditer(code):
        yield mutant(*match.span(), "", "term dropped")
    for match in LEFT_TERM.finditer(code):
        yield mutant(*match.span(1), "", "term dropped")
    for match in OPERANDS.finditer(code):
        yield mutant(*match.span(), "".join(match.group(3, 2, 1)), "operands swapped")
    for match in CHOICE.finditer(code):
        yield mutant(*match.span(), f"? {match.group(2)} : {match.group(1)}", "choice swapped")


@dataclass
class Model:
    """One verilated configuration: the commands that make its part of the bench."""

    name: str
    prefix: str
    verilate: str
    compile: list


class Bench:
    def __init__(self, unit, build):
        self.target = f"{unit}_bench"
        self.build = build
        self.folder = build / "tb" / unit
        done = subprocess.run(
            ["ninja", "-C", build, "-t", "commands", self.target],
            capture_output=True,
            text=True,
            check=True,
        )
        commands = [c for c in done.stdout.splitlines() if c and not c.startswith("ninja:")]
        self.link = commands[-1]
        self.models = {}
        for command in commands:
            match = re.search(r"--prefix (\S+)", command)
            if not match:
                continue
            prefix = match.group(1)
            compiles = [c for c in commands if " -c " in c and self.holds(c, prefix)]
            makers = "".join(self.text_of(c) for c in compiles if prefix not in self.source_of(c).name)
            name = re.search(r"\bmake_(\w+)\(", makers).group(1)
            self.models[name] = Model(name, prefix, command, compiles)
        verilate = next(iter(self.models.values())).verilate
        sources = re.findall(rf"{re.escape(str(RTL))}/(\w+)\.sv", verilate)
        self.sources = [name for name in sources if name not in NOT_MUTATED]

    @staticmethod
    def source_of(command):
        return pathlib.Path(shlex.split(command)[-1])

    def text_of(self, command):
        return (self.build / self.source_of(command)).read_text()

    def holds(self, command, prefix):
        """Whether a compilation is of what Verilator writes for `prefix`, or of its wrapper."""
        source = self.source_of(command)
        if source.name == f"{prefix}__all.cpp":
            return True
        return source.parent == self.folder and f'#include "{prefix}.h"' in self.text_of(command)

    def make(self, model, folder):
        """Builds the bench with `model` made of the sources in `folder`; what went wrong, or None."""
        made = folder / model.prefix
        place = [(str(RTL) + "/", f"{folder}/rtl/"), (str(self.folder / model.prefix), str(made))]
        link = self.link
        error = self.run(model.verilate, place)
        if error:
            warning = re.search(r"%(?:Warning|Error)-(\w+)", error)
            return f"verilator: {warning.group(1) if warning else 'error'}"
        for command in model.compile:
            object_file = re.search(r" -o (\S+)", command).group(1)
            new_object = str(folder / pathlib.Path(object_file).name)
            if self.run(command, [*place, (object_file, new_object)]):
                return "C++ compiler"
            link = link.replace(object_file, new_object)
        executable = re.search(r" -o (\S+)", link).group(1)
        return "linker" if self.run(link, [(f" -o {executable}", f" -o {folder}/bench")]) else None

    def run(self, command, replacements):
        for old, new in replacements:
            command = command.replace(old, new)
        done = subprocess.run(command, shell=True, cwd=self.build, capture_output=True, text=True)
        return None if done.returncode == 0 else done.stdout + done.stderr + "error"

    def verdict(self, model, folder, arguments, limit):
        """What the bench found, or None."""
        command = [folder / "bench", "--model", model.name, "--failure-wave", "none", *arguments]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=limit, cwd=folder)
        except subprocess.TimeoutExpired:
            return f"{model.name}: time limit"
        if done.returncode == 0:
            return None
        failed = re.search(r"^FAIL \S+ \S+: (\w+)", done.stdout, re.M)
        kind = KINDS.get(done.returncode, f"exit status {done.returncode}")
        return f"{model.name} {failed.group(1) if failed else 'all cases'}: {kind}"


def try_mutant(bench, models, mutant, arguments, limit):
    """What finds `mutant`, or None; of None in its place, what is wrong with the original."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        shutil.copytree(RTL, folder / "rtl")
        if mutant:
            file = folder / "rtl" / f"{mutant.file}.sv"
            text = file.read_text()
            file.write_text(text[: mutant.start] + mutant.text + text[mutant.end :])
        for model in models:
            found = bench.make(model, folder) or bench.verdict(model, folder, arguments, limit)
            if found:
                return found
    return None


def describe(mutant):
    text = (RTL / f"{mutant.file}.sv").read_text()
    line = text.count("\n", 0, mutant.start) + 1
    first = text.rfind("\n", 0, mutant.start) + 1
    last = text.find("\n", mutant.end)
    before = text[first:last].strip()
    after = (text[first : mutant.start] + mutant.text + text[mutant.end : last]).strip()
    code = [" ".join(part.split()).replace("|", "\\|") for part in (before, after)]
    return f"{mutant.file}.sv:{line} | {mutant.what} | `{code[0]}` | `{code[1]}`"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("unit", help="the bench is the target UNIT_bench")
    parser.add_argument("--count", type=int, default=10, help="mutants, 0 for all (default 10)")
    parser.add_argument("--seed", type=int, default=1, help="chooses the mutants (default 1)")
    parser.add_argument("--file", action="append", help="only of this module, repeatable")
    parser.add_argument("--model", action="append", help="to run, repeatable (default: the first)")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "release")
    parser.add_argument("--limit", type=float, default=120, help="seconds for a run (default 120)")
    parser.add_argument("--list", action="store_true", help="list the mutants, run nothing")
    parser.epilog = "What follows -- are options of the bench."
    own = sys.argv[1:]
    arguments = []
    if "--" in own:
        arguments = own[own.index("--") + 1 :]
        own = own[: own.index("--")]
    options = parser.parse_args(own)

    bench = Bench(options.unit, options.build.resolve())
    names = options.model or [next(iter(bench.models))]
    unknown = [name for name in names if name not in bench.models]
    if unknown:
        parser.error(f"no model {', '.join(unknown)}; there are {', '.join(bench.models)}")
    models = [bench.models[name] for name in names]
    all_mutants = []
    for name in bench.sources:
        if options.file is None or name in options.file:
            found = set(candidates(name, (RTL / f"{name}.sv").read_text()))
            all_mutants += sorted(found, key=lambda m: (m.start, m.end, m.text))
    chosen = all_mutants
    if 0 < options.count < len(all_mutants):
        chosen = random.Random(options.seed).sample(all_mutants, options.count)
    wrong = None if options.list else try_mutant(bench, models, None, arguments, options.limit)
    if wrong:
        print(f"the original fails: {wrong}", file=sys.stderr)
        return 1
    print(f"{len(chosen)} of {len(all_mutants)} mutants of {options.unit}\n")
    print("| place | change | before | after | found by | s |\n| --- | --- | --- | --- | --- | --- |")
    survivors = 0
    for mutant in chosen:
        start = time.monotonic()
        if options.list:
            print(f"| {describe(mutant)} | | |")
            continue
        found = try_mutant(bench, models, mutant, arguments, options.limit)
        survivors += found is None
        seconds = time.monotonic() - start
        print(f"| {describe(mutant)} | {found or '**survived**'} | {seconds:.0f} |", flush=True)
    if not options.list:
        print(f"\n{len(chosen) - survivors} of {len(chosen)} killed")
    return 0


if __name__ == "__main__":
    sys.exit(main())
