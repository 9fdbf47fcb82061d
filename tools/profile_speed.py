#!/usr/bin/env python3
"""Where the fast core spends its time: a table of workloads by stages, from samples of perf.

    tools/profile_speed.py build/profile/bin/halfspace [INPUT...] > out/speed/profile.md

The program needs line numbers and a fixed address: CMake's preset
`profile`. A sample belongs to the innermost function of the fast core that was at work, inlined or not.
Needs perf (Debian: linux-perf) and addr2line (binutils), and the right to sample.
"""

import argparse
import collections
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

LISTS = "tiny_rand tiny_grid medium large_ftb large_btf sliver fill_ftb fill_btf mesh_bunny mesh_crowd".split()
# Stages, by files of model/halfspace/fast, or where one has several by functions of it.
FUNCTIONS = {"coverage": ("inside_edges", "inside_rect", "count_partial")}
FILES = {
    "front end": ("vertices-inl.hpp", "front_end.cpp"),
    "setup": ("set_up-inl.hpp", "set_up.cpp", "setup.cpp"),
    "load": ("triangle-inl.hpp", "raster-inl.hpp"),
    "walk": ("walk-inl.hpp",),
    "coverage": (),
    "small": ("windows-inl.hpp",),
    "small depth": ("small-inl.hpp", "window_depth-inl.hpp"),
    "bounds": ("depth_bounds-inl.hpp", "surface_tiles.hpp", "surface_tiles.cpp"),
    "depth": ("early_z-inl.hpp", "codes-inl.hpp", "plane-inl.hpp"),
    "z cache": ("block_cache.hpp", "block_cache-inl.hpp", "block_cache.cpp"),
}
STAGES = [*FILES, "other"]
STAGE_OF_FILE = {file: stage for stage, files in FILES.items() for file in files}
STAGE_OF_FUNCTION = {name: stage for stage, names in FUNCTIONS.items() for name in names}
SAMPLES_A_SECOND = 5000
SECONDS = 3  # of samples, about


def run(*command):
    done = subprocess.run(command, check=True, text=True, capture_output=True)
    return done.stdout


def measure(program, workload, repeat, prefix=()):
    """Milliseconds of the median pass, by `bench speed`."""
    with tempfile.NamedTemporaryFile(suffix=".json") as file:
        only_ours = ["--without", "functional_pixels,scalar_loop,llvmpipe", "--repeat", str(repeat)]
        run(*prefix, program, "bench", "speed", *only_ours, "--json", file.name, workload)
        times = json.load(open(file.name))["workloads"][0]["runs"]["functional"]["milliseconds"]
    return sorted(times)[len(times) // 2]


def stage_of(chain):
    """`chain`: (function, file) of an address, the innermost first."""
    for function, file in chain:
        if function in STAGE_OF_FUNCTION:
            return STAGE_OF_FUNCTION[function]
        if file in STAGE_OF_FILE:
            return STAGE_OF_FILE[file]
    return "other"


def chains(program, addresses):
    """The chain of each address."""
    command = ["addr2line", "-e", program, "-a", "-f", "-i", *addresses]
    told = []
    lines = iter(run(*command).splitlines())
    for line in lines:
        if line.startswith("0x"):
            told.append([])
        else:
            told[-1].append((base_name(line), next(lines).rsplit("/", 1)[-1].split(":")[0]))
    return told


def base_name(mangled):
    """The name in a mangled one that STAGE_OF_FUNCTION has, if there is one."""
    return next((name for name in STAGE_OF_FUNCTION if f"{len(name)}{name}" in mangled), mangled)


def profile(program, workload):
    """Milliseconds of a pass, and the share of each stage."""
    once = measure(program, workload, 3)
    repeat = min(max(int(SECONDS * 1000 / once), 3), 1000)
    with tempfile.TemporaryDirectory() as folder:
        data = f"{folder}/perf.data"
        record = ["perf", "record", "-q", "-F", str(SAMPLES_A_SECOND), "-o", data]
        milliseconds = measure(program, workload, repeat, record)
        samples = collections.Counter(run("perf", "script", "-i", data, "-F", "ip").split())
    counts = collections.Counter()
    for count, chain in zip(samples.values(), chains(program, samples), strict=True):
        counts[stage_of(chain)] += count
    return milliseconds, {stage: counts[stage] / samples.total() for stage in STAGES}


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("inputs", nargs="*", metavar="INPUT", help="in addition to the ten synthetic lists")
    options = parser.parse_args()
    for tool, package in (("perf", "linux-perf"), ("addr2line", "binutils")):
        if shutil.which(tool) is None:
            parser.error(f"{tool}: not found (Debian: {package})")
    print(f"| workload | ms | {' | '.join(STAGES)} |")
    print("|---|---:|" + "---:|" * len(STAGES))
    for workload in [*(f"synthetic:{name}:full" for name in LISTS), *options.inputs]:
        milliseconds, shares = profile(str(options.program), workload)
        name = pathlib.Path(workload).name.split(".")[0].removeprefix("synthetic:")
        cells = " | ".join(f"{100 * shares[stage]:.0f} %" for stage in STAGES)
        print(f"| {name} | {milliseconds:.3g} | {cells} |", flush=True)


if __name__ == "__main__":
    sys.exit(main())
