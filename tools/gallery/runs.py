"""Runs `halfspace run` for a method, and reads what it wrote."""

import json
import pathlib
import re
import subprocess
from typing import NamedTuple

import numpy
from PIL import Image

from methods import ROOT, is_reference

TIME = re.compile(r"^  time +(\d+)  ns a frame, the median of \d+ passes of (.*)$", re.MULTILINE)


class Run(NamedTuple):
    """A result folder, in memory as far as the gallery shows it."""

    folder: pathlib.Path
    stats: dict
    fragments: numpy.ndarray  # (samples, height, width)
    depth: numpy.ndarray | None  # the same shape
    quads: numpy.ndarray
    steps: numpy.ndarray | None  # none: of a reference
    triangles: numpy.ndarray | None
    nanoseconds: int
    timed: str  # what drew in the passes that were timed
    cycles: int | None

    @property
    def config(self):
        return self.stats["config"]

    @property
    def samples(self):
        return self.fragments.shape[0]

    def picture(self, kind):
        """A picture of the result, RGB."""
        return numpy.asarray(Image.open(self.folder / f"{kind}0.png").convert("RGB"))


def records_of(command):
    """What the run keeps beside arrays and pictures; a reference has no steps."""
    return ["--quads"] if is_reference(command) else ["--quads", "--steps"]


def without_value(words, option):
    """The words without an option and its value: that of pictures means nothing where there are none."""
    if option not in words:
        return words
    at = words.index(option)
    return words[:at] + words[at + 2 :]


def _layers(array):
    return array if array.ndim == 3 else array[numpy.newaxis]


class Runner:
    """Runs each command once, however many methods show it."""

    def __init__(self, program, folder):
        self.program = program
        self.folder = folder
        self.known = {}

    def run(self, command, passes):
        if command not in self.known:
            self.known[command] = self._run(command, passes)
        return self.known[command]

    def _halfspace(self, *arguments):
        done = subprocess.run(
            [self.program, "run", *arguments], cwd=ROOT, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE
        )
        if done.returncode != 0:
            raise RuntimeError(f"halfspace run {' '.join(map(str, arguments))}: {done.stderr.strip()}")
        return done.stdout

    def _run(self, command, passes):
        out = self.folder / str(len(self.known))
        text = self._halfspace(*command, *records_of(command), "--time", str(passes), "--out", out)
        time = TIME.search(text)
        cycles = None
        if not is_reference(command):
            timed = self.folder / f"{len(self.known)}_cycles"
            unseen = without_value(command, "--interpolation")
            self._halfspace(*unseen, "--fidelity", "recurrence", "--no-pictures", "--out", timed)
            cycles = json.loads((timed / "stats.json").read_text())["cycles"]
        files = {path.stem: path for path in out.glob("*.npy")}
        return Run(
            folder=out,
            stats=json.loads((out / "stats.json").read_text()),
            fragments=_layers(numpy.load(files["fragments0"])),
            depth=_layers(numpy.load(files["depth0"])) if "depth0" in files else None,
            quads=numpy.load(files["quads"]),
            steps=numpy.load(files["steps"]) if "steps" in files else None,
            triangles=numpy.load(files["triangles"]) if "triangles" in files else None,
            nanoseconds=int(time[1]),
            timed=time[2],
            cycles=cycles,
        )
