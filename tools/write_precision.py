#!/usr/bin/env python3
"""Writes the tables of docs/guides/precision.md, from out/precision/precision.json and docs/precision.json.

    tools/write_precision.py                             # all tables
    tools/write_precision.py --captured DIR/*.ptf.xz     # rows of these frames are marked
    tools/write_precision.py precision-depth             # one table

`make study-precision` measures and runs this script.
"""

import functools

from precision_data import FORMATS, HARDWARE, LIKE, RESULT, STEPS, depth_gates, depth_sets, edge_sets, holes
from precision_data import partitions, rate, read_hardware, read_result, worst_depth
from write_figures import CAPTURED, frame_name, main, processor

PAGE = "docs/guides/precision.md"
MESH = "jittered"  # on which others measured
# The machine's module for a sample, and the one for a tile, which holds four of the former.
BUILT = {"unit_plane": ("plane_sample", "depth_plane"), "unit_barycentric": ("barycentric_sample", "")}
SNAPPED = ("exact_integer", "fixed_8", "fixed_6", "fixed_4")


@functools.cache
def result():
    return read_result(RESULT)


@functools.cache
def hardware():
    return read_hardware(HARDWARE)


def number(value):
    """Three digits that count, and nothing behind the point of larger numbers."""
    if value == 0:
        return "0"
    if value >= 1e6:
        return f"{value:.1e}"
    return f"{value:,.0f}" if value >= 100 else f"{value:.3g}"


def table(head, rows, words=1):
    lines = [head, ["---" if i < words else "---:" for i in range(len(head))], *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def named(each, tools):
    captured = each["name"] in map(frame_name, tools.captured)
    return each["name"] + (CAPTURED if captured else "")


def code(name):
    return f"`{name}`"


def arithmetics():
    return result()["edges"]["arithmetics"]


def edge_names():
    return [each["name"] for each in arithmetics()]


def list_of_edges(_):
    rows = [[code(each["name"]), each["computes"], each["source"]] for each in arithmetics()]
    return table(["arithmetic", "computes", "from"], rows, 3)


def known(_):
    mesh = next(each for each in edge_sets(result()["edges"]) if each["name"] == MESH)
    rows = []
    for name in edge_names():
        gaps, doubles = holes(mesh, name)
        rows.append([code(name), number(gaps), number(doubles), number(rate(mesh, name, "wrong"))])
    head = ["arithmetic", "gaps per million pixels", "doubles", "wrong per million samples"]
    meshes = f"{mesh['looks']}, from seed {result()['seed']} on: {mesh['triangles'] // 32768} of them."
    return f"{meshes[0].upper()}{meshes[1:]}\n\n{table(head, rows)}"


def wrong(tools):
    sets = edge_sets(result()["edges"])
    rows = [
        [named(each, tools), f"{each['samples'] / 1e6:.1f} M"]
        + [number(rate(each, name, "wrong")) for name in edge_names()]
        for each in sets
    ]
    return table(["family or frame", "samples", *map(code, edge_names())], rows)


def gaps(tools):
    def cell(each, name):
        few, many = holes(each, name)
        return "0" if few == many == 0 else f"{number(few)} / {number(many)}"

    rows = [
        [named(each, tools), f"{each['pixels'] / 1e6:.1f} M"] + [cell(each, name) for name in edge_names()]
        for each in partitions(result()["edges"])
    ]
    return table(["family or frame", "pixels", *map(code, edge_names())], rows)


def snapping(tools):
    rows = [
        [named(each, tools)] + [number(rate(each, name, "moved")) for name in SNAPPED]
        for each in edge_sets(result()["edges"])
    ]
    return table(["family or frame", *map(code, SNAPPED)], rows)


def edge_cost(_):
    edges = result()["edges"]
    small, large = edges["time"]
    rows = []
    for name in edge_names():
        gates = hardware()[LIKE.get(name, name)]
        cells = [code(name)]
        for run in (small, large):
            time = run["rows"][name]
            cells.append(f"{time['nanoseconds']:.1f} ({time['ratio']:.2f})")
        cells += [f"{gates['gates']:,}", f"{gates['flip_flops']:,}", f"{gates['path']:.1f}"]
        most = max(sum(holes(each, name)) for each in partitions(edges))
        cells += [number(most), number(max(rate(each, name, "moved") for each in partitions(edges)))]
        rows.append(cells)
    for name in SNAPPED:
        step, cells = hardware()[name + STEPS], rows[edge_names().index(name)]
        gates = [f"{step['gates']:,}", f"{step['flip_flops']:,}", f"{step['path']:.1f}"]
        rows.append([f"{code(name)}{STEPS}", "-", "-", *gates, *cells[-2:]])
    built = hardware()["edge_evaluator"]
    rows.append(
        ["the machine's `edge_evaluator`, of 192", "-", "-", f"{built['gates'] / 192:,.0f}"]
        + [f"{built['flip_flops'] / 192:,.0f}", f"{built['path']:.1f}", *rows[edge_names().index(edges['baseline'])][-2:]]
    )
    head = ["arithmetic", f"ns a sample, {small['looks']}", f"ns, {large['looks']}"]
    head += ["gates of an edge", "flip-flops", "path, ns", "gaps and doubles, worst", "decided otherwise, worst"]
    how = f"{processor()}; processor time, medians of {small['rounds']} rounds in turns; in brackets\n"
    how += f"beside `{edges['baseline']}` of the same round."
    return f"{how}\n\n{table(head, rows)}"


def depth(tools):
    sets = depth_sets(result()["depth"])
    text = []
    for key, title in FORMATS.items():
        rows = []
        for each in result()["depth"]["arithmetics"]:
            cells = [code(each["name"])]
            for family in sets:
                row = family["formats"][key].get(each["name"])
                if row:
                    cells.append(" / ".join(f"{row[what]:.4g}" for what in ("mean", "p999", "worst")))
            if len(cells) > 1:
                rows.append(cells)
        samples = min(next(iter(family["formats"][key].values()))["samples"] for family in sets)
        text.append(f"**{title}**, {samples:,} samples of each or more.\n")
        text.append(table(["arithmetic", *(named(each, tools) for each in sets)], rows) + "\n")
    return "\n".join(text)


def depth_cost(_):
    rows = []
    for each in result()["depth"]["arithmetics"]:
        name = each["name"]
        if each["unit"]:
            sample, anchor = hardware()[BUILT[name][0]], hardware().get(BUILT[name][1])
            cells = [code(name), f"{sample['gates']:,}", "-", "-", f"{sample['path']:.1f}"]
            if anchor:
                cells[2] = f"{anchor['gates'] - 4 * sample['gates']:,}"
                cells[4] = f"{max(sample['path'], anchor['path']):.1f}"
        else:
            sample, anchor = hardware()[name], hardware().get(f"anchor: {name}")
            cells = [code(name), f"{sample['gates']:,}", f"{anchor['gates']:,}" if anchor else "-"]
            cells += [f"{depth_gates(hardware(), name):,}", f"{sample['path']:.1f}"]
        for key in FORMATS:
            worst = worst_depth(result()["depth"], name, key)
            cells.append("-" if worst is None else f"{worst:.4g}")
        rows.append(cells)
    head = ["arithmetic", "gates of a sample", "of a square", "together", "path, ns"]
    return table(head + [f"worst, {title}" for title in FORMATS.values()], rows)


FIGURES = {
    name: (PAGE, figure)
    for name, figure in {
        "precision-edges": list_of_edges,
        "precision-known": known,
        "precision-gaps": gaps,
        "precision-wrong": wrong,
        "precision-snapping": snapping,
        "precision-edge-cost": edge_cost,
        "precision-depth": depth,
        "precision-depth-cost": depth_cost,
    }.items()
}

if __name__ == "__main__":
    main(FIGURES, list(FIGURES), __doc__)
