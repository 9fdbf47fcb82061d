#!/usr/bin/env python3
"""How fast meshes are read, beside other readers: a table of a grid in every format.

    .venv/bin/python tools/bench_read.py build/release/bin/halfspace > out/read/read.md

Each pass reads every file with every reader in turn, so that a drift of the machine's speed meets all of them;
the ratios are medians over passes. Needs assimp (Debian: assimp-utils) and tools/requirements-read.txt.
"""

import argparse
import pathlib
import re
import statistics
import subprocess
import tempfile
import time

import pyminiply
import trimesh


def output(*command):
    return subprocess.run(command, check=True, text=True, capture_output=True).stdout


def seconds(action):
    """Of the processor: on a shared machine others make every reader wait, but not for equally long."""
    start = time.process_time()
    action()
    return time.process_time() - start


def by_halfspace(program, path):
    """The median of three in a process: the readers of Python are called in one that has read before, too."""
    row = output(program, "bench", "read", "--repeat", "3", path).splitlines()[-1]
    return float(row.split("|")[4].split()[0]) / 1000


def by_assimp(path):
    """Without postprocessing; what `assimp info` says that the import took, by clock()."""
    return float(re.search(r"import took approx\. ([\d.]+) seconds", output("assimp", "info", path, "--raw"))[1])


def by_trimesh(path):
    """Without merging vertices or any other processing."""
    return seconds(lambda: trimesh.load(path, process=False, skip_materials=True))


def by_pyminiply(path):
    if path.suffix != ".ply":
        return None
    return seconds(lambda: pyminiply.read(str(path)))


def versions():
    assimp = re.search(r"Version ([\d.]+)", output("assimp", "version"))[1]
    miniply = __import__("importlib.metadata").metadata.version("pyminiply")
    return f"assimp {assimp} (`assimp info --raw`), trimesh {trimesh.__version__} (process=False), pyminiply {miniply}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--passes", type=int, default=5)
    parser.add_argument("--side", type=int, default=400, help="vertices of the grid on a side")
    options = parser.parse_args()
    readers = [lambda path: by_halfspace(options.program, path), by_assimp, by_trimesh, by_pyminiply]
    with tempfile.TemporaryDirectory() as folder:
        table = output(options.program, "bench", "read", "--repeat", "1", "--side", str(options.side), "--keep", folder)
        rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines()[4:]]
        times = {row[0]: [[] for _ in readers] for row in rows}
        for _ in range(options.passes):
            for name, by_reader in times.items():
                for reader, found in zip(readers, by_reader, strict=True):
                    found.append(reader(pathlib.Path(folder) / name))
    print(f"one thread, processor time, medians of {options.passes} passes in turns, from the file that the system holds in memory to")
    print("the mesh; MB: 10^6 bytes; memory: at the peak, in sizes of the file; ratios: how many times as long the")
    print(f"others take, of which assimp alone has a fresh process for each: {versions()}\n")
    print("| mesh | MB | triangles | ms | MB/s | Mtriangles/s | memory | assimp | trimesh | pyminiply |")
    print("|---|" + "---:|" * 9)
    for name, size, triangles, *_, memory in rows:
        ours, *others = times[name]
        ms = 1000 * statistics.median(ours)
        cells = [name, size, f"{int(triangles):,}", f"{ms:.1f}", f"{1000 * float(size) / ms:.0f}"]
        cells += [f"{int(triangles) / 1000 / ms:.1f}", memory]
        for found in others:
            ratios = [theirs / our for theirs, our in zip(found, ours, strict=True) if theirs is not None]
            cells.append(f"{statistics.median(ratios):.1f}" if ratios else "-")
        print(f"| {' | '.join(cells)} |")


main()
