"""Builds and runs a bench on changed sources, by the build folder's own commands."""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import tempfile
from dataclasses import dataclass, field

from mutants import NOT_MUTATED, ROOT, RTL, Sources, write_mutant

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


class Stillborn(Exception):
    """No program comes of the mutant: Verilator or the compiler refuses it."""


@dataclass
class Model:
    """One verilated configuration: the commands that make its part of the program."""

    name: str
    prefix: str
    verilate: str
    compile: list = field(default_factory=list)


class Build:
    """A program or library of the build folder, with the verilated models in it."""

    def __init__(self, unit, target, build):
        self.unit = unit
        self.build = build
        self.folder = build / "tb" / unit
        done = subprocess.run(
            ["ninja", "-C", build, "-t", "commands", target], capture_output=True, text=True, check=True
        )
        commands = [c for c in done.stdout.splitlines() if c and not c.startswith("ninja:")]
        self.link = commands[-1]
        objects = set(re.findall(r"\S+\.o\b", self.link))
        self.models = {}
        for command in commands:
            match = re.search(rf"--prefix (V(?:{target}|{unit})_(\S+))", command)
            if match:
                self.models[match.group(2)] = Model(match.group(2), match.group(1), command)
        for command in commands:
            compiled = re.search(r" -o (\S+) -c (\S+)", command)
            if compiled and compiled.group(1) in objects:
                for model in self.models.values():
                    verilated = pathlib.Path(compiled.group(2)).name == f"{model.prefix}__all.cpp"
                    # What looks into the model's insides, as the pipeline's probe does, is compiled with them.
                    if verilated or (unit == "raster_pipeline" and f"/{model.prefix} " in command):
                        model.compile.append(command)
        verilate = next(iter(self.models.values())).verilate
        sources = re.findall(rf"{re.escape(str(RTL))}/(\w+)\.sv", verilate)
        self.sources = [name for name in sources if name not in NOT_MUTATED]

    def make(self, model, folder):
        """Builds `folder`/program with `model` made of the sources in `folder`/rtl."""
        made = folder / model.prefix
        place = [(f"{RTL}/", f"{folder}/rtl/"), (str(self.folder / model.prefix), str(made))]
        # Warnings would find many mutants (a width that does not fit); here the bench is on trial.
        quiet = model.verilate.replace(" -Wall ", " -Wno-lint -Wno-style ")
        # Nobody looks at its waveform; the code for one is a third of what the compiler has to do.
        error = self.run(quiet.replace(" --trace-fst ", " --trace-fst --trace-depth 1 "), place)
        if error:
            kind = re.search(r"%(?:Warning|Error)-(\w+)", error)
            raise Stillborn(f"verilator: {kind.group(1) if kind else 'error'}")
        link = self.link
        for command in model.compile:
            object_file = re.search(r" -o (\S+)", command).group(1)
            new_object = str(folder / pathlib.Path(object_file).name)
            # A short run of many programs: what counts is the time to compile them.
            quick = re.sub(r" -O[123]\b", " -O0", re.sub(r" -MD -MT \S+ -MF \S+", "", command))
            if self.run(quick, [*place, (object_file, new_object)]):
                raise Stillborn("C++ compiler")
            link = link.replace(object_file, new_object)
        output = re.search(r" -o (\S+)", link).group(1)
        link = re.sub(r"-Wl,--dependency-file=\S+", "", link)
        name = pathlib.Path(output).name
        if self.run(link, [(f" -o {output}", f" -o {folder}/{name}")]):
            raise Stillborn("linker")
        return folder / name

    def run(self, command, replacements):
        for old, new in replacements:
            command = command.replace(old, new)
        environment = {**os.environ, "CCACHE_DISABLE": "1"}  # no mutant is compiled twice
        done = subprocess.run(
            command, shell=True, cwd=self.build, env=environment, capture_output=True, text=True
        )
        return None if done.returncode == 0 else done.stdout + done.stderr + "error"


class UnitBench:
    """UNIT_bench_all: a program that holds every model; --model picks one."""

    def __init__(self, unit, build):
        self.unit = unit
        self.build = Build(unit, f"{unit}_bench_all", build)
        self.models = self.build.models
        self.sources = self.build.sources

    def make(self, model, folder):
        return self.build.make(model, folder)

    def command(self, program, model):
        return [program, "--model", model.name, *self.no_wave(program)]

    @staticmethod
    def no_wave(program):
        done = subprocess.run([program, "--help"], capture_output=True, text=True, check=False)
        return ["--failure-wave", "none"] if "--failure-wave" in done.stdout else []

    def verdict(self, model, done):
        failed = re.search(r"^FAIL \S+ \S+: (\w+)", done.stdout, re.M)
        kind = KINDS.get(done.returncode, f"exit status {done.returncode}")
        return f"{model.name} {failed.group(1) if failed else 'all cases'}: {kind}"


class PipelineBench:
    """raster_pipeline_bench: a program that loads a model, which is a library by itself: <machine>_no_dfg."""

    def __init__(self, names, build):
        self.unit = "raster_pipeline"
        builds = {name: Build(self.unit, f"halfspace_rtl_{name}", build) for name in names}
        self.models = {name: made.models[name] for name, made in builds.items()}
        self.builds = builds
        self.sources = next(iter(builds.values())).sources
        self.program = build / "tb" / "raster_pipeline" / "raster_pipeline_bench"

    def make(self, model, folder):
        return self.builds[model.name].make(model, folder)

    def command(self, library, model):
        file = f"{model.name.removesuffix('_no_dfg')}.toml"
        folders = [ROOT / "configs", ROOT / "tb" / "raster_pipeline"]
        machine = next(folder / file for folder in folders if (folder / file).exists())
        return [self.program, "--config", machine, "--rtl-folder", library.parent]

    @staticmethod
    def verdict(model, done):
        words = done.stdout + done.stderr
        if "ssertion" in words:
            kind = "assertion"
        elif "deadlock" in words:
            kind = "deadlock"
        elif "counter" in words:
            kind = "counter"
        elif "against recurrence" in words:
            kind = "timing"
        elif "differences, first" in words or "in no surface" in words:
            kind = "packet"
        else:
            kind = f"exit status {done.returncode}"
        return f"pipeline {model.name}: {kind}"


def models_of(bench, names):
    unknown = [name for name in names if name not in bench.models]
    if unknown:
        raise SystemExit(f"no model {', '.join(unknown)}; there are {', '.join(bench.models)}")
    return [bench.models[name] for name in names]


def find(bench, models, mutant, arguments, limit):
    """What finds `mutant`, or None; of None in its place, what is wrong with the original."""
    with tempfile.TemporaryDirectory(prefix="mutant_") as name:
        folder = pathlib.Path(name)
        shutil.copytree(Sources.folder, folder / "rtl")
        if mutant:
            write_mutant(mutant, folder / "rtl")
        for model in models:
            program = bench.make(model, folder)
            command = [*bench.command(program, model), *arguments]
            try:
                done = subprocess.run(command, capture_output=True, text=True, timeout=limit, cwd=folder)
            except subprocess.TimeoutExpired:
                return f"{model.name}: time limit"
            if done.returncode != 0:
                return bench.verdict(model, done)
    return None


def show(command):
    return shlex.join(str(part) for part in command)
