#!/usr/bin/env python3
"""Runs the commands whose output the pages show, and writes it into the pages.

    tools/write_figures.py                                # all that take seconds, on the frames that ship
    tools/write_figures.py bench-frames --captured DIR/*.ptf.xz
    tools/write_figures.py --check demo                   # write nothing; exit status 1 if it is stale

Each figure is a block `<!-- NAME: begin -->` ... `<!-- NAME: end -->` of a page, with its command. Rows
of captured frames, which do not ship, are marked. `make docs-figures` runs this script.
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import textwrap
from collections.abc import Sequence
from typing import NamedTuple

from replace_block import replaced

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENES = sorted(path.relative_to(ROOT) for path in (ROOT / "scenes").glob("*.ptf.xz"))
CAPTURED = " (captured)"


class Tools(NamedTuple):
    program: pathlib.Path
    reference: pathlib.Path
    depth_error: pathlib.Path
    captured: Sequence[pathlib.Path]


def frame_name(path):
    return path.name.split(".")[0]


def marked(text, captured):
    """The text with ` (captured)` behind the names of captured frames in the first column of tables."""
    names = "|".join(re.escape(name) for name in captured)
    return re.sub(rf"^\| ({names}) ", rf"| \1{CAPTURED} ", text, flags=re.MULTILINE) if names else text


def processor():
    """What measured: kind of processor and number of cores."""
    lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    models = [line.split(":", 1)[1] for line in lines if line.startswith("model name")]
    kind = re.sub(r"\((?:R|TM)\)| CPU| Processor|@.*", "", models[0] if models else "unknown").strip()
    return f"{kind}, {max(len(models), 1)} cores, shared"


def output(program, *arguments):
    run = subprocess.run([program, *arguments], cwd=ROOT, check=True, text=True, stdout=subprocess.PIPE)
    return run.stdout.strip()


def demo(tools):
    """What `make demo` prints, but for the folder's name."""
    scene = "scenes/cc0_truck.ptf.xz"
    return f"```text\n{output(tools.program, 'run', scene, '--fidelity', 'recurrence')}\n```"


def table(tools, kind, *options):
    """A table of `halfspace bench KIND`, of the shipped frames and of those that are captured.

    The command's first line, where it has one, says how it measures: then the processor matters too.
    """
    text = output(tools.program, "bench", kind, *options, *SCENES, *tools.captured)
    *method, rows = text.split("\n\n", 1)
    frames = "scenes/*.ptf.xz" + (" FRAME..." if tools.captured else "")
    words = " ".join(["halfspace bench", kind, *options, frames])
    pairs = re.sub(r"(--\w+) ", r"\1~", words)  # an option and its value stay on a line
    lines = textwrap.wrap(pairs, 88, break_on_hyphens=False, break_long_words=False)
    command = " \\\n      ".join(lines).replace("~", " ")
    how = f"{processor()}; {method[0]}.\n\n" if method else ""
    return f"    {command}\n\n{how}{marked(rows, map(frame_name, tools.captured))}"


def columns(text, names):
    """Only these columns of a table of Markdown and of the text before it."""
    lines = text.splitlines()
    start = next(i for i, line in enumerate(lines) if line.startswith("| "))
    head = [cell.strip() for cell in lines[start].split("|")]
    keep = [head.index(name) for name in names if name in head]
    for i in range(start, len(lines)):
        cells = lines[i].split("|")
        lines[i] = "|" + "|".join(cells[k] for k in keep) + "|"
    return "\n".join(lines)


def bench_frames(tools):
    """The captured frames and those that ship, in brief."""
    ratios = ["scalar loop / functional", "llvmpipe / functional"]
    names = ["workload", "depth", "triangles", "fragments", "functional", *ratios, "Mquads/s"]
    return columns(table(tools, "speed"), names)


def timed(text):
    """A table whose first line says how it was measured, with the processor that measured."""
    method, rows = text.split("\n\n", 1)
    return f"{processor()}; {method}.\n\n{rows}"


def bench_profile(tools):
    """The table that tools/profile_speed.py wrote; see the Makefile."""
    rows = (ROOT / "out/speed/profile.md").read_text().strip()
    return f"{processor()}.\n\n" + marked(rows, map(frame_name, tools.captured))


def bench_stages(tools):
    lists = [f"synthetic:{name}:full" for name in ("tiny_rand", "medium", "large_btf", "sliver", "mesh_crowd")]
    inputs = ["scenes/cc0_truck.ptf.xz", *lists]
    method, rows = output(tools.program, "bench", "stages", *inputs).split("\n\n", 1)
    command = textwrap.fill(" ".join(["halfspace bench stages", *inputs]), 88, break_on_hyphens=False)
    command = command.replace("\n", " \\\n      ")
    return f"    {command}\n\n{processor()}; {method}.\n\n{rows}"


def reference(tools):
    """Counts of the reference, a row for each depth surface with both ways to take late draws."""
    columns = ["triangles", "clipped", "culled", "drawn", "fragments", "passed (opaque 0 / 1)"]
    columns += ["quads", "helpers"]
    rows = [f"| frame, surface | {' | '.join(columns)} |", "| --- |" + " ---: |" * len(columns)]
    captured = [frame_name(path) for path in tools.captured]
    for path in [*SCENES, *tools.captured]:
        lines = [line.split("\t") for line in output(tools.reference, path).splitlines()[1:]]
        for no_write, opaque in zip(lines[::2], lines[1::2], strict=True):
            name, surface = opaque[:2]
            triangles, clipped, culled, drawn, fragments, passed, quads, helpers = (
                f"{int(value):,}" for value in opaque[5:]
            )
            passed = f"{int(no_write[10]):,} / {passed}"
            mark = CAPTURED if name in captured else ""
            cells = (triangles, clipped, culled, drawn, fragments, passed, quads, helpers)
            rows.append(f"| {name} {surface}{mark} | {' | '.join(cells)} |")
    return "\n".join(rows)


def depth_error(tools):
    """The largest errors of depth; takes minutes."""
    samples = "100000000"
    text = output(tools.depth_error, "--samples", samples)
    return f"    halfspace_depth_error --samples {samples}\n\n{text}"


def error(tools):
    """The tables that `halfspace bench error` wrote; see the Makefile."""
    text = (ROOT / "out/error/error.md").read_text()
    return f"{processor()}.\n\n" + marked(text, map(frame_name, tools.captured))


def bench_sampled(tools):
    lists = [f"synthetic:{name}:full" for name in ("medium", "large_ftb", "mesh_crowd")]
    return table(tools, "sampled", *lists)


def bench_idle(tools):
    """What SystemC and the RTL leave out, on the named machines and with a longer latency."""
    inputs = ["scenes/vkcube.ptf.xz", *tools.captured]
    names = ("baseline", "small", "wide", "shallow", "slow_memory")
    machines = [["--config", f"configs/{name}.toml"] for name in names]
    machines += [[*machines[1], "--set", "memory.latency=1000"]]
    text = [output(tools.program, "bench", "idle", "--repeat", "1", *machine, *inputs) for machine in machines]
    method, rows = text[0].split("\n\n", 1)
    rows = [rows, *(each.split("|\n", 2)[2] for each in text[1:])]
    names = "|".join(map(frame_name, tools.captured)) or "$"
    rows = re.sub(rf"\| ({names}) \|", rf"| \1{CAPTURED} |", "\n".join(rows))
    return f"    halfspace bench idle --repeat 1 --config MACHINE FRAME...\n\n{processor()}; {method}.\n\n{rows}"


def idle_toggles(tools):
    """What toggles in a waveform of the RTL."""
    run = ["run", "scenes/vkcube.ptf.xz", "--config", "configs/small.toml", "--fidelity", "rtl"]
    run += ["--rtl-folder", "build/release/lib/halfspace/no_dfg", "--wave"]
    with tempfile.TemporaryDirectory() as folder:
        wave = pathlib.Path(folder) / "run.fst"
        output(tools.program, *run, wave)
        rows = output(ROOT / "tools/count_toggles.py", wave)
    command = textwrap.indent("\n".join(textwrap.wrap(" ".join(["halfspace", *run, "run.fst"]), 88, break_on_hyphens=False)), "    ")
    command = command.replace("\n", " \\\n  ")
    return f"{command}\n    tools/count_toggles.py run.fst\n\n{rows}"


def hi_z_kills(tools):
    """What hi_z stops of the bursts that die."""
    inputs = [*SCENES[:1], *tools.captured, "synthetic:large_ftb:full"]
    method, rows = output(tools.program, "bench", "hi-z", *inputs).split("\n\n", 1)
    command = "    halfspace bench hi-z FRAME..."
    return f"{command}\n\n{method[0].upper()}{method[1:]}.\n\n{marked(rows, map(frame_name, tools.captured))}"


def hi_z_by_time(tools):
    """What hi_z would stop, and what the frame would take, if it decided by time; on the named machines."""
    machines = sorted((ROOT / "configs").glob("*.toml"))
    inputs = [*SCENES[:1], *tools.captured, "synthetic:large_ftb:full"]
    cells = {}  # by frame
    for machine in machines:
        options = ["--bits", "8", "--lags", "128", "--config", machine]
        table_rows = output(tools.program, "bench", "hi-z", *inputs, *options).split("\n\n", 1)[1].splitlines()[2:]
        for row in table_rows:
            name, *_, by_order, by_time, before, after = [cell.strip() for cell in row.strip("|").split("|")]
            kills = f"{by_order.removesuffix(' %')} to {by_time}"
            cells.setdefault(name, []).append(f"{kills}, {int(after) / int(before):.3f}")
    text = ["    halfspace bench hi-z FRAME... --bits 8 --lags 128 --config MACHINE", ""]
    text += [f"| frame | {' | '.join(machine.stem for machine in machines)} |", "|---|" + "---:|" * len(machines)]
    text += [f"| {name} | {' | '.join(row)} |" for name, row in cells.items()]
    return marked("\n".join(text), map(frame_name, tools.captured))


def hi_z_machines(tools):
    """Cycles and bytes of depth with hi_z and without, on the named machines."""
    machines = sorted((ROOT / "configs").glob("*.toml"))
    rows = [f"| frame | {' | '.join(machine.stem for machine in machines)} | bytes, baseline |"]
    rows += ["| --- |" + " --- |" * (len(machines) + 1)]
    inputs = [*SCENES, *tools.captured, "synthetic:medium:full", "synthetic:large_ftb:full"]
    for source in inputs:
        cells = []
        for machine in machines:
            both = []
            for on in ("false", "true"):
                stats = run_stats(tools, source, "--config", machine, "--set", f"hi_z.enabled={on}")["frame"]
                early_z = stats["counters"]["early_z"]
                moved = early_z["bytes_read"] + early_z["bytes_written"] + stats["flushed_bytes"]
                both.append((stats["time"]["cycles"], moved))
            cells.append(f"{both[0][0]:,} to {both[1][0]:,} ({both[1][0] / both[0][0]:.2f})")
            if machine.stem == "baseline":
                bytes_cell = f"{both[0][1]:,} to {both[1][1]:,} ({both[1][1] / max(both[0][1], 1):.2f})"
        name = source if isinstance(source, str) else frame_name(source)
        rows.append(f"| {name} | {' | '.join(cells)} | {bytes_cell} |")
    command = "    halfspace run FRAME --fidelity recurrence --config MACHINE --set hi_z.enabled=false|true"
    return f"{command}\n\n{marked(chr(10).join(rows), map(frame_name, tools.captured))}"


def depth_traffic(tools):
    """Bytes of depth, coded and raw, of each frame, and the lines and ratio of each form."""
    rows = output(tools.program, "bench", "depth-traffic", *SCENES, *tools.captured).split("\n\n", 1)[1]
    frames = {}
    for line in rows.splitlines()[2:]:
        name, line_class, *numbers = [cell.strip() for cell in line.strip("|").split("|")]
        frames.setdefault(name, {})[line_class] = [int(number) for number in numbers[:6]]
    columns = ["raw, bytes", "stored, bytes", "ratio", "ratio, read", "ratio, written"]
    columns += ["plane: lines", "ratio", "ends: lines", "ratio", "raw: lines", "cleared: lines"]
    text = ["    halfspace bench depth-traffic FRAME...", ""]
    text += [f"| frame | {' | '.join(columns)} |", "|---|" + "---:|" * len(columns)]
    for name, classes in frames.items():

        def total(prefix, ways=(0, 1)):
            """Lines, raw and stored bytes of these classes; ways: 0 read, 1 written."""
            found = [numbers for each, numbers in classes.items() if each.startswith(prefix)]
            return [sum(numbers[3 * way + i] for numbers in found for way in ways) for i in range(3)]

        def ratio(counts):
            return f"{counts[1] / counts[2]:.2f}" if counts[2] else "-"

        moved = total("moved")
        lines = moved[0] + total("cleared")[0]
        cells = [f"{moved[1]:,}", f"{moved[2]:,}", ratio(moved)]
        cells += [ratio(total("moved", [way])) for way in (0, 1)]
        for form in ("plane", "ends"):
            cells += [f"{100 * total(form)[0] / lines:.1f} %", ratio(total(form))]
        cells += [f"{100 * total(each)[0] / lines:.1f} %" for each in ("raw", "cleared")]
        text.append(f"| {name} | {' | '.join(cells)} |")
    return marked("\n".join(text), map(frame_name, tools.captured))


def merging_counts(tools, source, held, folder):
    """What quad merging counts of a frame, with so many quads held."""
    options = ["--no-pictures", "--quad-merging", str(held), "--out", folder]
    output(tools.program, "run", source, *options)
    return json.loads((folder / "stats.json").read_text())["frame"]["quad_merging"]


def quad_merging(tools):
    """What quad merging prints of a frame, and what it saves of all, by the quads that the buffer holds."""
    arguments = ["run", "scenes/cc0_truck.ptf.xz", "--quad-merging", "32"]
    lines = output(tools.program, *arguments).splitlines()
    first = next(i for i, line in enumerate(lines) if line.startswith("  quad_merging "))
    example = textwrap.indent("\n".join([" ".join(["halfspace", *arguments]), "  ...", *lines[first:]]), "    ")
    buffers = (8, 32, 128, 1 << 20)
    lists = [f"synthetic:{name}:full" for name in ("tiny_grid", "mesh_bunny", "mesh_crowd", "tiny_rand")]
    columns = ["quads", "fragments a survivor", *(f"{held:,} held" for held in buffers)]
    columns += [f"fragments a survivor, {buffers[1]} held"]
    rows = [f"| workload | {' | '.join(columns)} |", "| --- |" + " ---: |" * len(columns)]
    with tempfile.TemporaryDirectory() as folder:
        for source in [*SCENES, *lists, *tools.captured]:
            counts = [merging_counts(tools, source, held, pathlib.Path(folder) / "run") for held in buffers]
            unmerged, merged = (
                f"{counts[1][key] / counts[1]['survivors']:.2f}" for key in ("fragments_unmerged", "fragments_shaded")
            )
            saved = " | ".join(f"{100 * count['saved']:.1f}%" for count in counts)
            name = frame_name(source) if isinstance(source, pathlib.Path) else source
            rows.append(f"| {name} | {counts[1]['quads']:,} | {unmerged} | {saved} | {merged} |")
    command = f"    halfspace run INPUT --quad-merging N    # N: {', '.join(map(str, buffers))}"
    return f"{example}\n\n{command}\n\n{marked(chr(10).join(rows), map(frame_name, tools.captured))}"


def run_stats(tools, *arguments):
    """stats.json of a timed run."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "result"
        output(tools.program, "run", *arguments, "--fidelity", "recurrence", "--no-pictures", "--out", out)
        return json.loads((out / "stats.json").read_text())


def what_if_demo(tools):
    """The end of what a run with a what-if prints."""
    text = output(tools.program, "run", "scenes/cc0_truck.ptf.xz", "--fidelity", "recurrence", "--prepass")
    return f"```text\n{text[text.index('  what if'):]}\n```"


def what_if(tools):
    """What each what-if does to each frame, as ratios of with and without."""
    kinds = ["--prepass", "--delay 1000", "--sort front-to-back", "--sort back-to-front", "--order alternate"]
    ratios = ["shaded", "fragments", "depth_read", "depth_written", "cycles"]
    text = [
        "    halfspace run FRAME --fidelity recurrence OPTION             # FRAME FRAME for --order",
        "",
        f"With / without{'; frames marked *captured* do not ship' if tools.captured else ''}.",
        "",
        f"| frame | option | draws that it acts on | in ranges | shaded without | {' | '.join(ratios)} |",
        "|---|---|" + "---:|" * (len(ratios) + 3),
    ]
    idle = []  # frames in which nothing may move
    for path in [path for path in [*SCENES, *tools.captured] if frame_name(path) != "vkcube"]:
        for kind in kinds:
            frames = [path] * (2 if "--order" in kind else 1)
            found = run_stats(tools, *frames, *kind.split())["what_if"]
            acted = found["applied"][0]
            if acted["draws"] == 0:
                idle += [frame_name(path)] if frame_name(path) not in idle else []
                continue
            cells = [f"{found[name]['ratio']:.3f}" for name in ratios]
            text.append(
                f"| {frame_name(path)} | `{kind}` | {acted['draws']} | {acted['ranges']} "
                f"| {found['shaded']['without']:,} | {' | '.join(cells)} |"
            )
    if idle:
        text += ["", f"Nothing may move in {' and '.join(idle)}."]
    return marked("\n".join(text), map(frame_name, tools.captured))


def what_if_lod(tools):
    """Triangles, work and cycles of two meshes by the error that is allowed."""
    text = ["    halfspace run INPUT --fidelity recurrence --lod PIXELS", ""]
    text += ["| INPUT | PIXELS | draws simplified | triangles | fragments | shaded | cycles |"]
    text += ["|---|" + "---:|" * 6]
    for path in ("scenes/cc0_truck.ptf.xz", "synthetic:mesh_bunny:full"):
        for pixels in ("0.125", "0.25", "0.5", "1", "2", "4", "8", "16", "32"):
            found = run_stats(tools, path, "--lod", pixels)["what_if"]
            names = ("triangles", "fragments", "shaded", "cycles")
            name = pathlib.Path(path).name.split(".")[0]
            if pixels == "0.125":
                cells = " | ".join(f"{found[each]['without']:,}" for each in names)
                text.append(f"| {name} | as it is | | {cells} |")
            cells = " | ".join(f"{found[each]['with']:,}" for each in names)
            text.append(f"| {name} | {pixels} | {found['applied'][0]['draws']} | {cells} |")
    return "\n".join(text)


def late_z(tools):
    """What becomes of frames whose shaders may discard: cycles, waits and kills by the way to take late draws."""
    modes = {
        "`opaque`": ["late_z=opaque"],
        "`no_write`": ["late_z=no_write"],
        "`late`, discard 0": ["late_z=late"],
        "`late`, discard 0, queue of 64": ["late_z=late", "late_z.queue=64"],
        "`late`, discard 0.5": ["late_z=late", "late_z.discard=0.5"],
        "`late`, discard 1": ["late_z=late", "late_z.discard=1"],
    }
    columns = ["cycles", "z_test waits late", "written", "discarded", "hi_z: cycles", "waits late", "tiles rejected"]
    text = ["    halfspace run FRAME --fidelity recurrence --set late_z=MODE [--set hi_z.enabled=true]"]
    text += ["", f"| frame | late draws | {' | '.join(columns)} |", "|---|---|" + "---:|" * len(columns)]
    for path in [*SCENES, *tools.captured]:
        runs = {}
        for mode, settings in modes.items():
            settings = [word for setting in settings for word in ("--set", setting)]
            runs[mode] = [
                run_stats(tools, path, *settings, "--set", f"hi_z.enabled={on}")["frame"] for on in ("false", "true")
            ]
        if runs["`late`, discard 1"][0]["counters"]["early_z"]["discarded"] == 0:
            continue
        for mode, (without, with_hi_z) in runs.items():

            def waits(frame):
                return f"{100 * frame['time']['stages']['z_test']['stalls']['late'] / frame['time']['cycles']:.0f}%"

            early_z = without["counters"]["early_z"]
            cells = [f"{without['time']['cycles']:,}", waits(without)]
            cells += [f"{early_z['written']:,}", f"{early_z['discarded']:,}"]
            cells += [f"{with_hi_z['time']['cycles']:,}", waits(with_hi_z)]
            cells += [f"{with_hi_z['counters']['hi_z']['tiles_rejected']:,}"]
            text.append(f"| {frame_name(path)} | {mode} | {' | '.join(cells)} |")
    return marked("\n".join(text), map(frame_name, tools.captured))


def small_triangles(tools):
    """Triangles a cycle of the two lists of small triangles, and the bytes of depth that go with them."""
    ideal = ["memory.latency=1", "memory.read_bytes=1024", "memory.write_bytes=1024"]
    rejects = ["block_walker.sample_reject=true"]
    large = ["tile_walker.tile_size=16", "block_walker.block_size=64"]
    machines = {
        "baseline": [],
        "baseline, sample_reject": rejects,
        "ideal memory": ideal,
        "ideal memory, sample_reject": [*ideal, *rejects],
        "ideal memory, sample_reject, coded lines, 16 write buffers": [
            *ideal,
            *rejects,
            "z_cache.compression=true",
            "z_cache.write_buffers=16",
        ],
        "ideal memory, sample_reject, tiles of 16, blocks of 64": [*ideal, *rejects, *large],
    }
    names = ("tiny_grid", "tiny_rand")
    columns = [f"{name}: {what}" for name in names for what in ("triangles a cycle", "bytes a cycle")]
    text = ["    halfspace run synthetic:NAME:full --fidelity recurrence --set KEY=VALUE..."]
    text += ["", f"| machine | {' | '.join(columns)} |", "|---|" + "---:|" * len(columns)]
    for machine, settings in machines.items():
        cells = []
        for name in names:
            settings_words = [word for setting in settings for word in ("--set", setting)]
            frame = run_stats(tools, f"synthetic:{name}:full", *settings_words)["frame"]
            early_z = frame["counters"]["early_z"]
            moved = early_z["bytes_read"] + early_z["bytes_written"] + frame["flushed_bytes"]
            cycles = frame["time"]["cycles"]
            cells += [f"{frame['counters']['front_end']['triangles'] / cycles:.3f}", f"{moved / cycles:.0f}"]
        text.append(f"| {machine} | {' | '.join(cells)} |")
    text += ["", "Ideal memory: latency of 1 cycle, 1024 bytes read and 1024 written in a cycle."]
    return "\n".join(text)


LEDGER_OPTIONS = ["--set", "hi_z.enabled=true", "--set", "z_cache.compression=true"]


def ledger_demo(tools):
    """The ledger of the truck, without its draws."""
    scene = "scenes/cc0_truck.ptf.xz"
    return f"```text\n{output(tools.program, 'ledger', scene, *LEDGER_OPTIONS, '--no-draws', '--savings')}\n```"


def ledger_frames(tools):
    """Shares of causes in each frame, and what each switch saves."""
    causes = {
        "pieces": ["culled", "no_sample", "outside", "uncovered", "hi_z", "hi_z_early_z", "early_z", "survive"],
        "tiles": ["edges_block", "edges_tile", "hi_z_block", "hi_z_tile", "empty", "early_z", "survive"],
        "fragments": ["hi_z_block", "hi_z_tile", "early_z", "survive"],
        "read": ["overwritten", "cleared", "compressed", "fetched"],
        "written": ["compressed", "evicted", "flushed"],
    }
    paths = [*SCENES, *tools.captured]
    ledgers = [
        json.loads(output(tools.program, "ledger", path, *LEDGER_OPTIONS, "--json", "--savings")) for path in paths
    ]
    names = [frame_name(path) for path in paths]
    text = [f"    halfspace ledger FRAME {' '.join(LEDGER_OPTIONS)} --savings --json"]
    if tools.captured:
        text += ["", "Frames marked *captured* do not ship."]
    for account, columns in causes.items():
        unit = f"{account}, bytes" if account in ("read", "written") else account
        text += ["", f"| {unit} | all | {' | '.join(columns)} |", "|---|" + "---:|" * (len(columns) + 1)]
        for name, ledger in zip(names, ledgers, strict=True):
            counts = ledger["frame"][account]
            shares = [f"{100 * counts[cause] / max(counts['all'], 1):.1f}%" for cause in columns]
            text.append(f"| {name} | {counts['all']:,} | {' | '.join(shares)} |")
    switches = list(ledgers[0]["savings"]["without"])
    text += ["", "Cycles, and bytes read and written, with one switch off, against all on:", ""]
    text += [f"| savings | all on | {' | '.join(f'`{key}`' for key in switches)} | all off |"]
    text += ["|---|" + "---:|" * (len(switches) + 2)]
    for name, ledger in zip(names, ledgers, strict=True):
        savings = ledger["savings"]
        runs = [*savings["without"].values(), savings["all_off"]]
        on = savings["all_on"]

        def total(run):
            return run["bytes_read"] + run["bytes_written"]

        cells = [f"{100 * (run['cycles'] / on['cycles'] - 1):+.1f}%" for run in runs]
        text.append(f"| {name} | {on['cycles']:,} cycles | {' | '.join(cells)} |")
        cells = [f"{100 * (total(run) / total(on) - 1):+.1f}%" for run in runs]
        text.append(f"| {name} | {total(on):,} bytes | {' | '.join(cells)} |")
    return marked("\n".join(text), map(frame_name, tools.captured))


def stress_sharpness(tools):
    """Which families of the stress campaign find which wrong rasterizer."""
    options = "--sharpness --cases 16 --depth-bound 1"
    return f"    halfspace stress {options}\n\n{output(tools.program, 'stress', *options.split())}"


FIGURES = {
    "demo": ("README.md", demo),
    "bench-frames": ("README.md", bench_frames),
    "bench-time": ("docs/guides/time.md", lambda tools: table(tools, "time", "--repeat", "5")),
    "bench-idle": ("docs/guides/time.md", bench_idle),
    "idle-toggles": ("docs/guides/time.md", idle_toggles),
    "bench-sampled": ("docs/guides/time.md", bench_sampled),
    "depth-traffic": ("docs/units/z_codec.md", depth_traffic),
    "hi-z-kills": ("docs/units/hi_z.md", hi_z_kills),
    "hi-z-by-time": ("docs/units/hi_z.md", hi_z_by_time),
    "hi-z-machines": ("docs/units/hi_z.md", hi_z_machines),
    "late-z": ("docs/units/early_z.md", late_z),
    "small-triangles": ("docs/units/block_walker.md", small_triangles),
    "quad-merging": ("docs/guides/quad_merging.md", quad_merging),
    "reference": ("docs/guides/reference.md", reference),
    "what-if-demo": ("docs/guides/whatif.md", what_if_demo),
    "what-if-lod": ("docs/guides/whatif.md", what_if_lod),
    "what-if": ("docs/guides/whatif.md", what_if),
    "ledger-demo": ("docs/guides/ledger.md", ledger_demo),
    "ledger-frames": ("docs/guides/ledger.md", ledger_frames),
    "stress-sharpness": ("docs/guides/stress.md", stress_sharpness),
    "depth-error": ("docs/numerics.md", depth_error),
    "bench-error": ("docs/guides/error.md", error),
    "bench-speed": ("docs/guides/speed.md", lambda _: timed((ROOT / "out/speed/speed.md").read_text())),
    "bench-roof": ("docs/guides/speed.md", lambda tools: timed(output(tools.program, "bench", "roof"))),
    "bench-profile": ("docs/guides/speed.md", bench_profile),
    "bench-stages": ("docs/guides/speed.md", bench_stages),
    "bench-surfaces": ("docs/guides/speed.md", lambda tools: timed(output(tools.program, "bench", "surfaces"))),
    "bench-read": ("docs/guides/meshes.md", lambda _: timed((ROOT / "out/read/read.md").read_text())),
}
# The others need the RTL, a profiler or minutes: a target of the Makefile each.
SLOW = ("bench-idle", "idle-toggles", "depth-error", "bench-error", "bench-speed", "bench-roof", "bench-profile")
SLOW += ("bench-stages", "bench-surfaces", "bench-read")
ALL = [name for name in FIGURES if name not in SLOW]


def main(known, default, description):
    """Writes the figures that the command line names into their pages, or those of `default`.

    known: by name the page and the function that makes the text.
    """
    parser = argparse.ArgumentParser(
        description=description, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    others = ", ".join(name for name in known if name not in default)
    which = f"all but {others}" if others else "all"
    parser.add_argument("figures", nargs="*", metavar="FIGURE", help=f"{', '.join(known)} (default: {which})")
    parser.add_argument("--check", action="store_true", help="compare with the pages, write nothing")
    build = ROOT / "build/release"
    parser.add_argument("--program", type=pathlib.Path, default=build / "bin/halfspace")
    parser.add_argument(
        "--reference", type=pathlib.Path, default=build / "model/halfspace/reference/halfspace_reference"
    )
    parser.add_argument(
        "--depth-error", type=pathlib.Path, default=build / "tests/depth_error/halfspace_depth_error"
    )
    parser.add_argument(
        "--captured",
        type=pathlib.Path,
        nargs="*",
        default=[],
        metavar="FRAME",
        help="frames that do not ship",
    )
    options = parser.parse_args()
    captured = tuple(path.resolve() for path in options.captured)
    tools = Tools(
        options.program.resolve(), options.reference.resolve(), options.depth_error.resolve(), captured
    )
    stale = False
    for name in options.figures:
        if name not in known:
            parser.error(f"figure is '{name}'; legal: {names}")
    for name in options.figures or default:
        page, figure = known[name]
        try:
            text = figure(tools)
        except (OSError, subprocess.CalledProcessError) as failure:
            sys.exit(f"{name}: {failure}")
        path = ROOT / page
        before = path.read_text()
        after = replaced(before, name, text, path)
        if options.check:
            stale = stale or before != after
            print(f"{page}: {name} is {f'stale: run `{sys.argv[0]} {name}`' if before != after else 'current'}")
        else:
            path.write_text(after)
            print(f"{name}: {page}")
    sys.exit(1 if stale else 0)


if __name__ == "__main__":
    main(FIGURES, ALL, __doc__)
