#!/usr/bin/env python3
"""Counts the bits of registers that toggle, by unit, and how many of them in a unit that does nothing.

    halfspace run scenes/vkcube.ptf.xz --config configs/small.toml --fidelity rtl \\
      --rtl-folder build/release/lib/halfspace/no_dfg --wave run.fst
    tools/count_toggles.py run.fst

A unit does nothing where all of its stages have waited for the same for longer than its pipelines are. Registers
are the signals with names in _q; memories with more than 32 words are not in the waveform. Needs fst2vcd (Debian:
gtkwave).
"""

import argparse
import re
import subprocess
import sys
from collections import Counter

STILL_CYCLES = 40  # longer than any pipeline
TICKS = 2  # of a cycle: clock low, clock high


class Unit:
    def __init__(self, name):
        self.name = name
        self.bits = 0
        self.stages = {}  # activity, by code of the signal
        self.since = 0  # tick of the last change of an activity
        self.toggles = 0
        self.idle_toggles = 0
        self.idle_registers = Counter()
        self.idle_ticks = 0

    def idle_at(self, tick):
        return all(self.stages.values()) and tick - self.since >= STILL_CYCLES * TICKS

    def set_activity(self, code, value, tick):
        if value != self.stages[code]:
            self.add_idle(tick)
            self.stages[code] = value
            self.since = tick

    def add_idle(self, tick):
        if self.idle_at(tick):
            self.idle_ticks += tick - self.since - STILL_CYCLES * TICKS


def read_header(lines):
    """Units by name; and by code of a signal: the unit of an activity, and unit and name of a register."""
    units, activities, registers = {}, {}, {}
    scopes = []
    for line in lines:
        words = line.split()
        if not words:
            continue
        if words[0] == "$scope":
            scopes.append(words[2])
        elif words[0] == "$upscope":
            scopes.pop()
        elif words[0] == "$enddefinitions":
            break
        elif words[0] == "$var" and len(scopes) > 2 and scopes[:2] == ["TOP", "raster_pipeline"]:
            at = next((i for i, scope in enumerate(scopes) if scope.startswith("u_")), 2)
            width, code, name = int(words[2]), words[3], ".".join([*scopes[at + 1 :], words[4]])
            unit = units.setdefault(scopes[at], Unit(scopes[at]))
            if len(scopes) == at + 1 and words[4] in ("activity_o", "lookup_activity_o"):
                activities[code] = unit
                unit.stages[code] = 0
            if re.search(r"_q\b", name) and code not in registers:
                registers[code] = (unit, name)
                unit.bits += width
    return units, activities, registers


def count(lines):
    units, activities, registers = read_header(lines)
    values = {}
    tick = 0
    for line in lines:
        if line[0] == "#":
            tick = int(line[1:])
            continue
        if line[0] not in "01b":
            continue
        value, code = line[1:].split() if line[0] == "b" else (line[0], line[1:].strip())
        if code in activities:
            activities[code].set_activity(code, int(value, 2), tick)
        if code in registers:
            number = int(value, 2)
            toggled = (number ^ values.get(code, number)).bit_count()
            values[code] = number
            unit, name = registers[code]
            unit.toggles += toggled
            if unit.idle_at(tick):
                unit.idle_toggles += toggled
                unit.idle_registers[name] += toggled
    for unit in units.values():
        unit.add_idle(tick)
    return units, tick


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("wave", help="FST file of the pipeline")
    parser.add_argument("--registers", type=int, default=0, metavar="N", help="list N of each unit that toggle in it")
    options = parser.parse_args()
    with subprocess.Popen(["fst2vcd", options.wave], text=True, stdout=subprocess.PIPE) as reader:
        units, ticks = count(reader.stdout)
    print("| unit | bits of registers | toggles a cycle | cycles idle, % | toggles while idle | of its toggles, % |")
    print("|---|---:|---:|---:|---:|---:|")
    for unit in units.values():
        if unit.stages:
            print(
                f"| {unit.name.removeprefix('u_')} | {unit.bits} | {unit.toggles * TICKS / ticks:.1f} "
                f"| {100 * unit.idle_ticks / ticks:.1f} | {unit.idle_toggles} "
                f"| {100 * unit.idle_toggles / max(unit.toggles, 1):.2f} |"
            )
            for name, toggles in unit.idle_registers.most_common(options.registers):
                print(f"    {toggles:>8} {name}")


if __name__ == "__main__":
    sys.exit(main())
