#!/usr/bin/env python3
"""Measures what published mechanisms save on our frames, and writes the tables of docs/guides/literature.md.

    tools/write_literature.py                             # on the frames that ship, and synthetic ones
    tools/write_literature.py --captured DIR/*.ptf.xz
    tools/write_literature.py compression                 # one table

Each mechanism has a table, and `literature` has a line for each. What was published in full, and why ours
is less where it is, is written by hand in the page. `make bench-literature` runs this script.
"""

import functools
import pathlib
import tempfile
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from write_figures import CAPTURED, SCENES, frame_name, main, merging_counts, output, run_stats

PAGE = "docs/guides/literature.md"
NOTHING_HIDDEN = "vkcube"  # a scene of which no mechanism of visibility can save anything
RANDOM = ("synthetic:medium:full", "synthetic:tiny_rand:full")
ORDERED = ("synthetic:large_ftb:full", "synthetic:large_btf:full")
HI_Z = ("--set", "hi_z.enabled=true")
CODED = ("--set", "z_cache.compression=true")


class Case(NamedTuple):
    source: str
    name: str  # in the tables


class Measured(NamedTuple):
    """What a mechanism does to each frame."""

    command: str
    columns: Sequence[str]
    rows: Mapping[Case, Sequence[str]]
    ours: Mapping[Case, float]  # what stands beside the published figure; not where it does not apply
    written: Callable[[float], str]


class Mechanism(NamedTuple):
    section: str  # of the page
    published: str
    measure: Callable


def cases(tools, *synthetic):
    """The frames that ship, those that are captured, and synthetic ones."""
    found = [Case(str(path), frame_name(path)) for path in SCENES if frame_name(path) != NOTHING_HIDDEN]
    found += [Case(str(path), frame_name(path) + CAPTURED) for path in tools.captured]
    return found + [Case(name, name) for name in synthetic]


@functools.cache
def stats(tools, *arguments):
    """stats.json of a timed run, once for all who ask."""
    return run_stats(tools, *arguments)


def percent(with_it, without):
    return 100 * (with_it / without - 1)


def signed(change):
    return f"{change:+.1f} %"


def share(part):
    return f"{part:.1f} %"


def times(factor):
    return f"{factor:.2f}"


def depth_bytes(run):
    """Bytes of depth to and from memory, with those of clears that are drawn and of the flush."""
    frame = run["frame"]
    moved = [frame[part]["early_z"] for part in ("counters", "drawn_clears")]
    return sum(each["bytes_read"] + each["bytes_written"] for each in moved) + frame["flushed_bytes"]


def what_if_bytes(what_if, which):
    return sum(what_if[name][which] for name in ("depth_read", "depth_written"))


def with_hi_z(tools, columns, numbers):
    """numbers(without, with): the change, and the cells, from the stats of both runs."""
    rows, ours = {}, {}
    for case in cases(tools, *RANDOM, *ORDERED):
        ours[case], cells = numbers(stats(tools, case.source), stats(tools, case.source, *HI_Z))
        rows[case] = cells
    command = "halfspace run FRAME --fidelity recurrence --set hi_z.enabled=false|true"
    return Measured(command, columns, rows, ours, signed)


def hi_z_traffic(tools):
    def numbers(without, with_it):
        moved = depth_bytes(without), depth_bytes(with_it)
        change = percent(moved[1], moved[0])
        return change, [f"{moved[0]:,}", f"{moved[1]:,}", signed(change)]

    return with_hi_z(tools, ["bytes of depth without", "with", "change"], numbers)


def hi_z_fragments(tools):
    def numbers(without, with_it):
        before, after = (run["frame"]["counters"]["quad_generator"]["fragments"] for run in (without, with_it))
        survivors = without["frame"]["counters"]["early_z"]["survivors"]
        change = percent(after, before)
        return change, [f"{before:,}", f"{after:,}", signed(change), signed(percent(survivors, before))]

    columns = ["fragments without", "with", "change", "if all went that fail the test"]
    return with_hi_z(tools, columns, numbers)


def hi_z_cycles(tools):
    def numbers(without, with_it):
        change = percent(with_it["cycles"], without["cycles"])
        return change, [f"{without['cycles']:,}", f"{with_it['cycles']:,}", signed(change)]

    return with_hi_z(tools, ["cycles without", "with", "change"], numbers)


def compressed_cache(tools):
    rows, ours = {}, {}
    twice = (*CODED, "--set", "z_cache.lines=256")
    for case in cases(tools, *RANDOM, *ORDERED):
        raw, coded, larger = (depth_bytes(stats(tools, case.source, *options)) for options in ((), CODED, twice))
        ours[case] = percent(larger, coded)
        rows[case] = [f"{raw:,}", f"{coded:,}", signed(percent(coded, raw)), f"{larger:,}", signed(ours[case])]
    command = "halfspace run FRAME --set z_cache.compression=false|true --set z_cache.lines=128|256"
    columns = ["bytes of depth, raw", "coded behind the cache", "change", "and twice the lines", "change"]
    return Measured(command, columns, rows, ours, signed)


def compression(tools):
    rows, ours = {}, {}
    cube = [Case(str(path), frame_name(path)) for path in SCENES if frame_name(path) == NOTHING_HIDDEN]
    found = [*cube, *cases(tools, *RANDOM, "synthetic:tiny_grid:full", *ORDERED)]
    text = output(tools.program, "bench", "depth-traffic", *(case.source for case in found))
    moved = [line for line in text.splitlines() if "| moved |" in line]
    for case, line in zip(found, moved, strict=True):
        numbers = [int(cell) for cell in line.split("|")[3:9]]
        raw, stored = (numbers[i] + numbers[i + 3] for i in (1, 2))
        ours[case] = raw / stored
        rows[case] = [f"{raw:,}", f"{stored:,}", times(ours[case])]
    command = "halfspace bench depth-traffic FRAME..."
    return Measured(command, ["raw, bytes", "stored, bytes", "ratio"], rows, ours, times)


def culling(tools):
    rows, ours = {}, {}
    found = cases(tools, "synthetic:medium:full", "synthetic:large_ftb:full")
    options = ["--bits", "8", "--lags", "128"]
    text = output(tools.program, "bench", "hi-z", *(case.source for case in found), *options)
    for case, line in zip(found, text.split("\n\n", 1)[1].splitlines()[2:], strict=True):
        cells = [cell.strip(" %") for cell in line.strip("|").split("|")]
        die, first, second, by_order, by_time = (float(cells[i]) for i in (2, 3, 4, 6, 7))
        ours[case] = second / first * by_order
        rows[case] = [share(die), share(first), share(ours[case]), share(second / first * by_time)]
        rows[case] += [share(second / 100 * by_order)]
    columns = ["bursts that die", "the oracle's, of these", "hi_z, of the oracle's", "hi_z by time"]
    columns += ["hi_z, of all that die"]
    return Measured(f"halfspace bench hi-z FRAME... {' '.join(options)}", columns, rows, ours, share)


def delay(tools):
    rows, ours = {}, {}
    for case in cases(tools, *RANDOM, *ORDERED):
        late, first = (
            stats(tools, case.source, *options)["what_if"] for options in (("--delay", "1000"), ("--prepass",))
        )
        draws = late["applied"][0]["draws"]
        rows[case] = [str(draws), f"{late['shaded']['without']:,}"]
        if draws == 0:
            rows[case] += ["-"] * 3
            continue
        ours[case] = 1 / late["shaded"]["ratio"]
        rows[case] += [times(ours[case]), times(1 / first["shaded"]["ratio"])]
        rows[case] += [signed(percent(what_if_bytes(late, "with"), what_if_bytes(late, "without")))]
    columns = ["draws that may move", "shaded without", "times fewer", "with `--prepass`", "bytes of depth"]
    return Measured("halfspace run FRAME --fidelity recurrence --delay 1000", columns, rows, ours, times)


def tile_order(tools):
    rows, ours = {}, {}
    for case in cases(tools):
        found = stats(tools, case.source, case.source, "--order", "alternate")["what_if"]
        draws = found["applied"][0]["draws"]
        rows[case] = [str(draws), f"{what_if_bytes(found, 'without'):,}"]
        if draws == 0:
            rows[case] += ["-"] * 2
            continue
        ours[case] = percent(what_if_bytes(found, "with"), what_if_bytes(found, "without"))
        rows[case] += [signed(ours[case]), signed(100 * (found["cycles"]["ratio"] - 1))]
    columns = ["draws that may move", "bytes of depth, two frames", "change", "cycles"]
    return Measured("halfspace run FRAME FRAME --fidelity recurrence --order alternate", columns, rows, ours, signed)


def merging(tools):
    rows, ours = {}, {}
    names = [f"synthetic:{name}:full" for name in ("tiny_grid", "mesh_bunny", "mesh_crowd", "tiny_rand")]
    with tempfile.TemporaryDirectory() as folder:
        for case in cases(tools, *names):
            few, many = (
                merging_counts(tools, case.source, held, pathlib.Path(folder) / "run") for held in (32, 1 << 20)
            )
            ours[case], most = (each["fragments_unmerged"] / each["fragments_shaded"] for each in (few, many))
            bound = few["fragments_unmerged"] / few["survivors"]
            rows[case] = [times(ours[case]), times(most), times(bound)]
    columns = ["times fewer, 32 held", "1,048,576 held", "if no fragment were a helper"]
    return Measured("halfspace run FRAME --quad-merging 32", columns, rows, ours, times)


MECHANISMS = {
    "hi-z-traffic": Mechanism("Two-level hierarchical Z", "-10 to -35 % bytes of depth", hi_z_traffic),
    "hi-z-fragments": Mechanism("Depth filter", "up to -62.1 % fragments", hi_z_fragments),
    "hi-z-cycles": Mechanism("Early-Z hierarchy", "-12.5 to -25.6 % cycles", hi_z_cycles),
    "compressed-cache": Mechanism("Compressed depth cache", "-17 % bytes, or twice the lines", compressed_cache),
    "compression": Mechanism("Depth compression", "1.91 : 1", compression),
    "culling": Mechanism("Masked culling", "often over 90 % of an oracle", culling),
    "delay": Mechanism("Delay streams", "2 to 4 times less", delay),
    "tile-order": Mechanism("Order of tiles", "no figure for depth", tile_order),
    "merging": Mechanism("Quad merging", "8 times less shading", merging),
}


@functools.cache
def measured(name, tools):
    return MECHANISMS[name].measure(tools)


def table(name, tools):
    """A line for each frame."""
    found = measured(name, tools)
    text = [f"    {found.command}", "", f"| frame | {' | '.join(found.columns)} |"]
    text += ["|---|" + "---:|" * len(found.columns)]
    text += [f"| {case.name} | {' | '.join(cells)} |" for case, cells in found.rows.items()]
    return "\n".join(text)


def span(found, synthetic):
    """From the least to the most of the frames that are synthetic, or of the others."""
    some = {case: value for case, value in found.ours.items() if case.source.startswith("synthetic:") == synthetic}
    if not some:
        return "-"
    ends = [min(some, key=some.get), max(some, key=some.get)]
    cells = [f"{found.written(some[case])} ({case.name.removesuffix(CAPTURED)})" for case in ends]
    return cells[0] if len(some) == 1 else " to ".join(cells)


def summary(tools):
    """A line for each mechanism."""
    text = ["| mechanism | published | ours, frames of programs | ours, synthetic frames |", "|---|---|---|---|"]
    for name, (section, published, _) in MECHANISMS.items():
        found = measured(name, tools)
        link = f"[{section}](#{section.lower().replace(' ', '-')})"
        text.append(f"| {link} | {published} | {span(found, False)} | {span(found, True)} |")
    return "\n".join(text)


FIGURES = {"literature": (PAGE, summary)}
FIGURES |= {name: (PAGE, functools.partial(table, name)) for name in MECHANISMS}

if __name__ == "__main__":
    main(FIGURES, list(FIGURES), __doc__)
