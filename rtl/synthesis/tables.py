"""The figures: docs/hardware.json, and from it the tables between the marks of docs/hardware.md."""

import json
import pathlib
import re

from synthesis.runs import Run
from synthesis.units import UNITS

# The default machine by interpolator: its parts and how many; see "The machine" of docs/hardware.md.
MACHINE = {
    interpolator: [
        (1, "setup", f"sub_pixel_bits=8 Interval=1 Interpolator={number}"),
        (1, "block_walker", "tile_size=8 block_size=32 sub_pixel_bits=8"),
        (1, "tile_walker", "tile_size=8 block_size=32 sub_pixel_bits=8"),
        (1, "edge_evaluator", "tile_size=8 sub_pixel_bits=8"),
        (1, "quad_generator", "tile_size=8 quad_width=4"),
        *early_z,
    ]
    for interpolator, number, early_z in (
        ("plane", 0, [(1, "early_z", "test_width=4 Interpolator=0")]),
        (
            "barycentric",
            1,
            [(1, "early_z", "test_width=1 Interpolator=1"), (12, "barycentric_sample", "defaults")],
        ),
    )
}
# The configurations whose memories the page lists one by one.
LISTED = [(top, label) for _, top, label in MACHINE["plane"]]
ECP5_CELLS = ["LUT4", "CCU2C", "TRELLIS_FF", "MULT18X18D", "DP16KD", "TRELLIS_DPR16X4"]


_LABELS = {(c.top, c.label) for unit in UNITS.values() for c in unit.configurations}
assert all(part[1:] in _LABELS for parts in MACHINE.values() for part in parts), "a part of no unit"


def flip_flops(cells: dict[str, int]) -> int:
    return sum(count for kind, count in cells.items() if "DFF" in kind)


def _entry(run: Run) -> dict:
    entry = {
        "top": run.configuration.top,
        "configuration": run.configuration.label,
        "multipliers": run.multipliers,
    }
    if run.target == "osu018":
        entry["gates"] = sum(run.cells.values()) - flip_flops(run.cells)
        entry["flip_flops"] = flip_flops(run.cells)
        entry["area"] = round(run.area)
        entry["path"] = run.path
        entry["memories"] = run.memories
    else:
        entry["memories"] = run.memories
        entry["cells"] = {kind: run.cells.get(kind, 0) for kind in ECP5_CELLS}
    return entry


def write(docs: pathlib.Path, run: Run) -> None:
    """Puts the run in the place of an older one of the same configuration; those of no unit any more go."""
    path = docs / "hardware.json"
    figures = json.loads(path.read_text()) if path.exists() else {}
    new = (run.target, run.configuration.top, run.configuration.label)
    kept = {}
    for target in ("osu018", "ecp5"):
        old = {(e["top"], e["configuration"]): e for e in figures.get(target, [])}
        entries = []
        for unit in UNITS.values():
            for configuration in unit.configurations:
                key = (configuration.top, configuration.label)
                if (target, *key) == new:
                    entries.append(_entry(run))
                elif configuration.measured and key in old:
                    entries.append(old[key])
        kept[target] = entries
    docs.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(kept, indent=1) + "\n")
    _replace(
        docs / "hardware.md",
        {
            "machine": _machine(kept["osu018"]),
            "osu018": _library(kept["osu018"]),
            "ecp5": _ecp5(kept["ecp5"]),
            "memories": _memories(kept["ecp5"]),
        },
    )


def _memory_words(memories: list[dict]) -> str:
    kept = [memory for memory in memories if memory["kept"]]
    if not kept:
        return ""
    counts: dict[str, int] = {}
    for memory in kept:
        shape = f"{memory['words']} x {memory['bits']}"
        shape += "" if memory["registered"] else " *"
        counts[shape] = counts.get(shape, 0) + 1
    return ", ".join(f"{count} of {shape}" if count > 1 else shape for shape, count in counts.items())


def _table(head: list[str], rows: list[list[str]], words: int = 2) -> str:
    """The first columns are words, the others numbers."""
    lines = [head, ["---" if i < words else "---:" for i in range(len(head))], *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def _library(entries: list[dict]) -> str:
    head = ["module", "configuration", "gates", "flip-flops", "area, um2", "memories", "multipliers", "path, ns", "from", "to"]
    rows = []
    for e in entries:
        figures = [str(e[key]) for key in ("gates", "flip_flops", "area")]
        path = [str(e["path"]["ns"]), f"`{e['path']['from']}`", f"`{e['path']['to']}`"]
        words = [_memory_words(e["memories"]), str(len(e["multipliers"]))]
        rows.append([e["top"], e["configuration"], *figures, *words, *path])
    return _table(head, rows)


def _machine(entries: list[dict]) -> str:
    """The parts of the default machine and their sum, as far as all of them have been measured."""
    head = ["interpolator", "part", "gates", "flip-flops", "path, ns"]
    measured = {(e["top"], e["configuration"]): e for e in entries}
    rows = []
    for interpolator, parts in MACHINE.items():
        if any((top, label) not in measured for _, top, label in parts):
            continue
        gates, flip_flops, path = 0, 0, 0.0
        for count, top, label in parts:
            entry = measured[top, label]
            gates += count * entry["gates"]
            flip_flops += count * entry["flip_flops"]
            path = max(path, entry["path"]["ns"])
            name = f"{top}, {label}" + (f", {count} of them" if count > 1 else "")
            figures = (count * entry["gates"], count * entry["flip_flops"], entry["path"]["ns"])
            rows.append([interpolator, name, *map(str, figures)])
        rows.append([interpolator, "**all**", f"**{gates}**", f"**{flip_flops}**", f"**{path}**"])
    return _table(head, rows)


def _ecp5(entries: list[dict]) -> str:
    head = ["module", "configuration", *ECP5_CELLS]
    rows = [
        [e["top"], e["configuration"], *(str(e["cells"][kind]) for kind in ECP5_CELLS)]
        for e in entries
    ]
    return _table(head, rows)


def _memories(entries: list[dict]) -> str:
    head = ["module", "memory", "words x bits", "ports", "read", "osu018", "ECP5"]
    rows: dict[tuple, int] = {}
    for entry in entries:
        if (entry["top"], entry["configuration"]) not in LISTED:
            continue
        for memory in entry.get("memories", []):
            row = (
                entry["top"],
                "`" + re.sub(r"\[\d+\]", "[]", memory["name"]) + "`",
                f"{memory['words']} x {memory['bits']}",
                f"{memory['writes']} write, {memory['reads']} read",
                "registered" if memory["registered"] else "at once",
                "memory" if memory["kept"] else "flip-flops",
                memory["ecp5"],
            )
            rows[row] = rows.get(row, 0) + 1
    lines = [
        [row[0], row[1] + (f", {count} of them" if count > 1 else ""), *row[2:]]
        for row, count in rows.items()
    ]
    return _table(head, lines, len(head))


def _replace(path: pathlib.Path, tables: dict[str, str]) -> None:
    """The text between `<!-- table: NAME -->` and `<!-- end -->`."""
    marks = "".join(f"<!-- table: {name} -->\n<!-- end -->\n\n" for name in tables)
    text = path.read_text() if path.exists() else marks
    for name, table in tables.items():
        text = re.sub(
            rf"(<!-- table: {name} -->\n).*?(<!-- end -->)",
            lambda match, table=table: f"{match[1]}\n{table}\n\n{match[2]}",
            text,
            flags=re.S,
        )
    path.write_text(text)
