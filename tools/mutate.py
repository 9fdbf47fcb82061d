#!/usr/bin/env python3
"""Mutation test of a unit's bench: changes the unit's SystemVerilog in one place, builds and runs
the bench, and tells what found the change, or that nothing did.

    tools/mutate.py quad_generator                        # 16 mutants, the group's default models
    tools/mutate.py early_z --count 30 --seed 7 --page docs/mutation.md
    tools/mutate.py setup --file setup_cull --model t8_s8 -- --tiles 20000
    tools/mutate.py z_late --file z_test --changed HEAD~2  # only of the lines since then
    tools/mutate.py raster_pipeline                       # and what only the pipeline's bench sees

A build folder must hold the unit's bench; its own commands are run again on a copy of the sources.
The sample is drawn by kind of change and by source file, as evenly as they go. A mutant of which no
program comes is stillborn: another is drawn in its place. One that survives is a hole of the bench,
or listed with its reason in tools/mutants_equivalent.toml; exit status 1 when it is neither.
"""

import argparse
import pathlib
import random
import re
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Sequence
from datetime import date
from typing import NamedTuple

from mutant_bench import PipelineBench, Stillborn, UnitBench, find, models_of, show
from mutants import ROOT, RTL, Equivalents, Sources, change_of, is_activity, mutants_of


class Group(NamedTuple):
    """Sources that one set of models tells from their mutants."""

    unit: str  # whose bench
    models: Sequence[str]  # that a mutant must survive
    arguments: Sequence[str]  # of the bench, for a short run of all cases
    files: Sequence[str] = ()  # modules; none: all of the unit that no other group has


GROUPS = {
    "setup": Group(
        "setup",
        ["t4_s4_i4", "t8_s5_i2", "t8_s8", "plane_t8_s8", "outer_t4_s4_i4", "inner_t8_s5_i2"],
        ["--tiles", "12000"],
    ),
    "squares": Group(
        "setup",
        ["outer_t8_s8", "outer_t4_s4_i4", "inner_t8_s5_i2", "t8_s8"],
        ["--tiles", "12000"],
        ["square_pkg"],
    ),
    "setup_plane": Group(
        "setup",
        ["plane_t8_s8", "plane_t4_s4_i4"],
        ["--tiles", "12000"],
        ["setup_plane", "quotient_digits", "setup_depth"],
    ),
    "setup_hi_z": Group("setup", ["hi_z_t8_s8", "hi_z_t4_s4"], ["--tiles", "12000"], ["setup_hi_z"]),
    "line_setup": Group(
        "setup", ["lines_t8_s8"], ["--tiles", "12000"], ["line_columns", "line_edges", "line_slope"]
    ),
    # The modules that other units have too are mutated there: these have only a part of what credit_fifo can be.
    "block_walker": Group(
        "block_walker",
        ["t8_b32", "t8_b32_all", "t4_b32", "t16_b32_noreject", "t8_b32_samples4"],
        ["--tiles", "40000"],
        ["block_walker", "block_position", "block_inside", "block_edge", "block_plane"],
    ),
    "walks": Group(
        "block_walker",
        ["t8_b32_1_backtracking", "t4_b32_1_zigzag", "t8_b16_1_boustrophedonic", "t4_b16_2_backtracking"]
        + ["t8_b32_2_zigzag", "t4_b8_2_morton", "t8_b32_1_hilbert", "t8_b32_3_hilbert", "t4_b32_3_morton"],
        ["--tiles", "10000"],
        ["block_walk", "row_cells", "curve_cells", "curve_next", "walk_value", "ordered_pick"],
    ),
    "tile_walker": Group(
        "tile_walker",
        ["t8_b32", "t4_b32", "t16_b32_noaccept", "t8_b32_samples4"],
        ["--tiles", "40000"],
        ["tile_walker", "tile_edge"],
    ),
    "samples": Group(
        "raster_pipeline",
        ["sample_aside_no_dfg", "samples4_no_dfg", "samples2_no_dfg", "small_no_dfg"],
        ["--triangles", "3000"],
        ["sample_pkg", "sample_box_pkg"],
    ),
    "inner_coverage": Group(
        "raster_pipeline", ["outer_inner_no_dfg"], ["--triangles", "3000"], ["inner_coverage"]
    ),
    "hi_z": Group(
        "hi_z",
        ["lag8", "lag1", "parts"],
        ["--blocks", "20000"],
        ["hi_z", "hi_z_memory", "hi_z_span", "hi_z_word", "hi_z_test", "hi_z_plane", "hi_z_flights", "hi_z_states"]
        + ["hi_z_slots"],
    ),
    "quad_generator": Group("quad_generator", ["t8_w4_p1", "t4_w4_p2"], ["--tiles", "20000"]),
    "edge_evaluator": Group("edge_evaluator", ["t8_s8", "t8_s6_p1", "t4_s6_p3"], ["--tiles", "20000"]),
    "early_z": Group("early_z", ["t4", "parts", "outer"], ["--bursts", "32000"]),
    "depth_plane": Group("early_z", ["plane", "t4", "samples2"], ["--bursts", "32000"], ["depth_plane", "plane_sample"]),
    "z_late": Group("early_z", ["late2", "late16", "t4", "late_least"], ["--bursts", "32000"], ["z_late_writes"]),
    "interpolator": Group(
        "interpolator",
        ["b24", "b12", "b8_f2"],
        ["--tiles", "6000"],
        ["interpolator", "perspective_weights", "delay_memory"],
    ),
    "z_codec": Group(
        "z_codec",
        ["t4_p1", "t8_p2"],
        ["--lines", "6000"],
        ["z_codec_pkg", "z_encode_plane", "z_encode_ends", "z_encoder", "z_decoder"],
    ),
    "raster_pipeline": Group("raster_pipeline", ["small_no_dfg"], ["--triangles", "20000"]),
}
# Constants of several units, and what no unit's bench has: only the pipeline's has machines with them.
SHARED = {"sample_pkg", "sample_box_pkg", "inner_coverage"}
SURVIVED = "**survived**"
HEAD = ["| place | change | before | after | found by |", "| --- | --- | --- | --- | --- |"]


class Sample:
    """Draws from the kind of change, then from the file, that the fewest live mutants are of yet."""

    def __init__(self, mutants, seed):
        self.left = list(mutants)
        self.random = random.Random(seed)
        self.kinds = Counter()
        self.files = Counter()

    def draw(self):
        def rarest(counts, values):
            values = sorted(values)
            self.random.shuffle(values)
            return min(values, key=lambda value: counts[value])

        kind = rarest(self.kinds, {m.kind for m in self.left})
        file = rarest(self.files, {m.file for m in self.left if m.kind == kind})
        mutant = self.random.choice([m for m in self.left if (m.kind, m.file) == (kind, file)])
        self.left.remove(mutant)
        return mutant

    def live(self, mutant):
        self.kinds[mutant.kind] += 1
        self.files[mutant.file] += 1


def row_of(mutant):
    change = change_of(mutant)
    code = [text.replace("|", "\\|") for text in (change.before, change.after)]
    return f"| {mutant.file}.sv:{change.line} | {mutant.kind} | `{code[0]}` | `{code[1]}` |"


def changed_lines(name, commit):
    """The lines of a module that are not those of `commit`."""
    command = ["git", "diff", "--unified=0", commit, "--", str(RTL / f"{name}.sv")]
    diff = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    lines = set()
    for start, count in re.findall(r"^@@ \S+ \+(\d+)(?:,(\d+))? @@", diff, flags=re.M):
        lines.update(range(int(start), int(start) + int(count or 1)))
    return lines


def mutants_for(bench, options):
    """The group's: the pipeline's are its own modules, and of the units what their benches miss."""
    files = options.file or GROUPS[options.group].files
    own = {"raster_pipeline", "cycle_counters", *files}
    of_others = SHARED | {
        name
        for key, group in GROUPS.items()
        if group.unit == bench.unit and key != options.group
        for name in group.files
    }
    for name in bench.sources:
        if name not in files if files else name in of_others:
            continue
        lines = changed_lines(name, options.changed) if options.changed else None
        for mutant in mutants_of(name):
            if lines is not None and change_of(mutant).line not in lines:
                continue
            if is_activity(mutant) == (bench.unit == "raster_pipeline") or name in own:
                yield mutant


def sections(page):
    """What stands before the first unit of a page, and the units' parts."""
    text = page.read_text() if page.exists() else ""
    parts = re.split(r"^## (\w+)\n", text, flags=re.M)
    return parts[0], dict(zip(parts[1::2], parts[2::2], strict=True))


def found_before(page, unit):
    """By row what found a mutant, as the page has it."""
    lines = sections(page)[1].get(unit, "").splitlines() if page else []
    rows = (line.rpartition(" | ") for line in lines if re.match(r"\| \w+\.sv:", line))
    return {f"{row} |": found[:-2] for row, _, found in rows if found[:-2] != SURVIVED}


def write_page(page, unit, text):
    head, units = sections(page)
    units[unit] = text
    order = [name for name in GROUPS if name in units]
    table = [
        "| unit | live | killed | equivalent | survived | stillborn |",
        "| --- | ---: | ---: | ---: | ---: | ---: |",
    ]
    sums = Counter()
    for name in order:
        counts = dict(re.findall(r"(\w+) (\d+)", units[name].split(", of ")[0]))
        table.append(f"| [{name}](#{name}) | {' | '.join(counts.values())} |")
        sums.update({key: int(value) for key, value in counts.items()})
    table.append(f"| all | {' | '.join(map(str, sums.values()))} |")
    head = re.sub(r"(\| unit \| live .*?\n)\n", "\n".join(table) + "\n\n", head, flags=re.S)
    page.write_text(head + "".join(f"## {name}\n{units[name]}" for name in order))


def parse_command_line(own):
    """The options, and the arguments of the bench behind --."""
    arguments = []
    if "--" in own:
        arguments = own[own.index("--") + 1 :]
        own = own[: own.index("--")]
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("group", choices=GROUPS, help="a unit, a part of it, or the pipeline")
    parser.add_argument("--count", type=int, default=16, help="live mutants, 0 for all (default 16)")
    parser.add_argument("--seed", type=int, default=1, help="chooses the mutants (default 1)")
    parser.add_argument("--file", action="append", help="only of this module, repeatable")
    parser.add_argument("--changed", metavar="COMMIT", help="only of lines that it does not have")
    parser.add_argument("--model", action="append", help="to run, repeatable (default: by group)")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "release")
    parser.add_argument("--rtl", type=pathlib.Path, default=RTL, help="another copy of the sources")
    parser.add_argument("--limit", type=float, default=120, help="seconds for a run (default 120)")
    parser.add_argument("--page", type=pathlib.Path, help="Markdown file whose part of the group is written")
    parser.add_argument(
        "--keep", action="store_true", help="do not run again what the page has as found, by place and text"
    )
    parser.add_argument("--list", action="store_true", help="list the mutants, run nothing")
    parser.epilog = "What follows -- are options of the bench."
    options = parser.parse_args(own)
    group = GROUPS[options.group]
    options.model = options.model or group.models
    return options, arguments or list(group.arguments)


class Failed(Exception):
    """Nothing can be said of the mutants."""


class Campaign:
    """Runs mutants until enough are live, and counts what became of them."""

    def __init__(self, options, bench, models, arguments, equivalents):
        self.options = options
        self.bench = bench
        self.models = models
        self.arguments = arguments
        self.equivalents = equivalents
        self.known = found_before(options.page, options.group) if options.keep else {}
        self.counts = Counter()
        self.refused = Counter()
        self.rows = []

    def run(self, mutants):
        sample = Sample(mutants, self.options.seed)
        print("\n".join(HEAD))
        while sample.left and (self.options.count == 0 or self.counts["live"] < self.options.count):
            mutant = sample.draw()
            start = time.monotonic()
            row = row_of(mutant)
            try:
                found = self.known.get(row) or self.find(mutant)
            except Stillborn as why:
                self.refused[str(why)] += 1
                print(f"{row} stillborn: {why} | {time.monotonic() - start:.0f}", flush=True)
                continue
            self.rows.append(f"{row} {self.judge(mutant, row, found) or SURVIVED} |")
            sample.live(mutant)
            print(f"{self.rows[-1]} {time.monotonic() - start:.0f}", flush=True)
        self.counts["stillborn"] = sum(self.refused.values())

    def find(self, mutant):
        return find(self.bench, self.models, mutant, self.arguments, self.options.limit)

    def judge(self, mutant, row, found):
        """What the page says of a live mutant; None where it survived."""
        self.counts["live"] += 1
        reason = self.equivalents.reason(mutant)
        if not reason:
            self.counts["survived" if found is None else "killed"] += 1
            return found
        if found is not None and row not in self.known:
            raise Failed(f"listed as equivalent, but found: {row} {found}")
        self.counts["equivalent"] += 1
        return f"equivalent: {reason}"

    def summary(self, mutants):
        """The group's part of the page, by lines."""
        keys = ("live", "killed", "equivalent", "survived", "stillborn")
        numbers = ", ".join(f"{key} {self.counts[key]}" for key in keys)
        why = ", ".join(f"{reason} {count}" for reason, count in self.refused.most_common())
        options = self.options
        command = f"tools/mutate.py {options.group} --count {options.count} --seed {options.seed}"
        command += "".join(f" --file {name}" for name in options.file or [])
        if options.changed:
            command += f" --changed {options.changed}"
        models = ", ".join(model.name for model in self.models)
        return [
            "",
            f"{numbers}, of {len(mutants)} mutants{f' ({why})' if why else ''}.",
            "",
            f"{date.today()}, `{command}`: models {models}, bench options `{show(self.arguments)}`.",
            "",
            *HEAD,
            *self.rows,
            "",
            "",
        ]


def check_before(bench, models, arguments, limit, equivalents):
    """What has to hold before a mutant says anything."""
    stale = list(equivalents.stale())
    if stale:
        raise Failed("\n".join(["stale entries of the list of equivalent mutants:", *stale]))
    for model in models:
        wrong = find(bench, [model], None, arguments, limit)
        if wrong:
            raise Failed(f"the original fails: {wrong}")


def main():
    options, arguments = parse_command_line(sys.argv[1:])
    Sources.folder = options.rtl.resolve()
    build = options.build.resolve()
    unit = GROUPS[options.group].unit
    bench = PipelineBench(options.model, build) if unit == "raster_pipeline" else UnitBench(unit, build)
    models = models_of(bench, options.model)
    mutants = list(mutants_for(bench, options))
    if options.list:
        print("\n".join(map(row_of, mutants)))
        return 0
    equivalents = Equivalents(unit)
    campaign = Campaign(options, bench, models, arguments, equivalents)
    try:
        check_before(bench, models, arguments, options.limit, equivalents)
        campaign.run(mutants)
    except Failed as why:
        print(why, file=sys.stderr)
        return 1
    text = campaign.summary(mutants)
    print("\n".join(text[1:4]))
    if options.page:
        write_page(options.page, options.group, "\n".join(text))
    return 1 if campaign.counts["survived"] else 0


if __name__ == "__main__":
    sys.exit(main())
