"""What a method costs, and where it differs from another: from the files of their runs alone."""

from typing import NamedTuple

import numpy

OWNERS = 1 << 40  # more than draws and triangles have numbers, less than 64 bits hold with those of pixels


class Cost(NamedTuple):
    steps: int | None  # of block_walker; none: a reference
    jobs: int | None  # of tile_walker
    tests: float | None  # of an edge at a sample, for each covered sample
    nanoseconds: int
    by: str  # what drew in that time
    cycles: int | None
    fragments: int
    helpers: int

    @property
    def steps_a_job(self):
        return self.steps / self.jobs if self.jobs else None


class Difference(NamedTuple):
    """Pixels, beside the default method."""

    fewer: int  # covered by fewer triangles
    more: int
    other: int  # by as many, but others
    depth: int  # of those whose triangles are the same
    color: int  # of the picture
    partly: int  # covered by some triangle in a part of their samples: of this method alone
    places: dict  # {"fewer": mask of pixels, ...}


def cost_of(run):
    counters = run.stats["frame"]["counters"]
    fragments = counters["quad_generator"]["fragments"]
    steps = jobs = tests = None
    if run.steps is not None:
        steps = counters["block_walker"]["blocks"] + counters["block_walker"]["passes"]
        jobs = counters["tile_walker"]["tiles_accepted"] + counters["tile_walker"]["tiles_partial"]
        samples = int(run.config["tile_walker.tile_size"]) ** 2
        tests = counters["edge_evaluator"]["edges"] * samples / fragments if fragments else None
    return Cost(
        steps=steps,
        jobs=jobs,
        tests=tests,
        nanoseconds=run.nanoseconds,
        by=run.timed.removeprefix("functional on the ").removeprefix("the "),
        cycles=run.cycles,
        fragments=fragments,
        helpers=counters["quad_generator"]["helpers"],
    )


def _covered(run):
    """Each pixel with each triangle of a draw that covers a sample of it: pixel * OWNERS + owner, ascending; how many."""
    width = run.fragments.shape[2]
    quads = run.quads[run.quads["surface"] == 0]
    owner = quads["draw"].astype(numpy.int64) << 28 | quads["triangle"]
    keys = []
    for lane in range(4):
        live = quads["mask"] >> lane & 1 != 0
        at = (quads["y"][live].astype(numpy.int64) + lane // 2) * width + quads["x"][live] + lane % 2
        keys.append(at * OWNERS + owner[live])
    return numpy.unique(numpy.concatenate(keys), return_counts=True)


def _same(a, b):
    return numpy.isclose(a, b, rtol=0, atol=0, equal_nan=True)


def difference_of(run, default):
    height, width = run.fragments.shape[1:]
    pairs, samples = _covered(run)
    base, _ = _covered(default)
    ours = numpy.bincount(pairs // OWNERS, minlength=height * width)
    theirs = numpy.bincount(base // OWNERS, minlength=height * width)
    changed = numpy.zeros(height * width, bool)
    changed[numpy.setxor1d(pairs, base, assume_unique=True) // OWNERS] = True
    places = {
        "fewer": (ours < theirs).reshape(height, width),
        "more": (ours > theirs).reshape(height, width),
        "other": ((ours == theirs) & changed).reshape(height, width),
    }
    same = ~changed.reshape(height, width)
    depth = numpy.zeros((height, width), bool)
    if run.depth is not None and default.depth is not None:
        depth = same & ~_same(run.depth, default.depth[:1]).all(axis=0)
    color = (run.picture("shaded") != default.picture("shaded")).any(axis=2)
    partly = numpy.unique(pairs[samples < run.samples] // OWNERS).size
    counts = {name: int(mask.sum()) for name, mask in places.items()}
    return Difference(**counts, depth=int(depth.sum()), color=int(color.sum()), partly=partly, places=places)
