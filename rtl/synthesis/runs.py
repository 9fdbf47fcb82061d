"""Runs of Yosys and OpenSTA, and what is wrong with their results."""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field

from synthesis.units import Configuration, Unit

HERE = pathlib.Path(__file__).resolve().parent
LIBRARY = pathlib.Path("/usr/share/qflow/tech/osu018/osu018_stdcells.lib")
PACKAGES = "apt-get install --no-install-recommends qflow-tech-osu018 opensta"

# Of the optimizer's own working, not of the design.
HARMLESS = re.compile(
    r"ABC: Warning: (The network is combinational|Detected \d+ multi-output|AIG with boxes has internal fanout)"
    r"|\b0 warnings"
    r"|Lexer warning: .*share/abc9_map\.v"
)
# Gates for speed; buffers where the load is high, then sizes. Without them a net of many loads is the longest path.
ABC_SCRIPT = (
    "strash; ifraig; scorr; strash; dch; map -D 1; topo; buffer -N 16; upsize -D 1; dnsize -D 1; stime -p\n"
)
ABC_CONSTRAINTS = "set_driving_cell INVX2\nset_load 0.03 [all_outputs]\n"
PERIOD = 1000.0


@dataclass
class Run:
    """One configuration on one target: "none" (elaborated only), "osu018" or "ecp5"."""

    configuration: Configuration
    target: str
    seconds: float = 0.0
    failures: list[str] = field(default_factory=list)
    memories: list[dict] = field(default_factory=list)
    multipliers: list[str] = field(default_factory=list)
    cells: dict[str, int] = field(default_factory=dict)
    area: float = 0.0
    path: dict = field(default_factory=dict)


def missing_tools() -> str:
    """What keeps the library from being used; empty if nothing does."""
    if LIBRARY.exists() and shutil.which("sta"):
        return ""
    return f"needs the Debian packages qflow-tech-osu018 and opensta: {PACKAGES}"


def synthesize(unit: Unit, configuration: Configuration, target: str) -> Run:
    run = Run(configuration, target)
    start = time.monotonic()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        job = {
            "top": configuration.top,
            "files": unit.files(),
            "defines": dict(configuration.defines),
            "parameters": dict(configuration.parameters),
            "target": target,
            "find_memories": target != "none" or configuration.block_rams is not None,
            "library": str(LIBRARY),
            **{
                key: str(folder / key)
                for key in ("abc", "constraints", "statistics", "netlist", "result")
            },
        }
        (folder / "abc").write_text(ABC_SCRIPT)
        (folder / "constraints").write_text(ABC_CONSTRAINTS)
        (folder / "job.json").write_text(json.dumps(job))
        result = _yosys(folder, run)
        if result is not None:
            _read(run, result)
            if target == "osu018":
                _time(run, folder)
    run.seconds = time.monotonic() - start
    return run


def _yosys(folder: pathlib.Path, run: Run) -> dict | None:
    command = [sys.executable, str(HERE / "yosys_job.py"), str(folder / "job.json")]
    done = subprocess.run(command, capture_output=True, text=True, cwd=folder)
    log = (done.stdout + done.stderr).splitlines()
    warnings = [
        line for line in log if re.search("warning", line, re.I) and not HARMLESS.search(line)
    ]
    run.failures += list(dict.fromkeys(warnings))
    if done.returncode != 0:
        errors = [line for line in log if line.startswith("ERROR") or "error:" in line]
        run.failures += errors[-5:] or log[-15:]
        return None
    result = json.loads((folder / "result").read_text())
    result["mapped"] = dict(
        match.groups()
        for match in re.finditer(r"^mapping memory [^.]+\.(\S+) via \$_+(\w+?)_*$", done.stdout, re.M)
    )
    return result


def _read(run: Run, result: dict) -> None:
    wanted = run.configuration
    run.memories = result["memories"]
    for memory in run.memories:
        memory["ecp5"] = result["mapped"].get(memory["name"], "flip-flops")
    run.multipliers = result["multipliers"]
    run.cells = dict(result["statistics"].get("num_cells_by_type", {}))
    run.cells.pop("$scopeinfo", None)
    run.area = float(result["statistics"].get("area", 0.0))
    if len(run.multipliers) != wanted.multipliers:
        run.failures.append(
            f"{len(run.multipliers)} multipliers, the design states {wanted.multipliers}: "
            + ", ".join(run.multipliers)
        )
    unmapped = [kind for kind in run.cells if kind.startswith("$")]
    if unmapped:
        run.failures.append("not mapped: " + ", ".join(unmapped))
    latches = [kind for kind in run.cells if "LATCH" in kind.upper()]
    if latches:
        run.failures.append("latches: " + ", ".join(latches))
    if wanted.block_rams is not None:
        unregistered = [memory["name"] for memory in run.memories if not memory["registered"]]
        if unregistered or not run.memories:
            run.failures.append(f"not read through a register: {unregistered or 'no memory'}")
        found = run.cells.get("DP16KD", 0)
        if run.target == "ecp5" and found != wanted.block_rams:
            run.failures.append(f"{found} block RAMs, not {wanted.block_rams}")


def _time(run: Run, folder: pathlib.Path) -> None:
    """The least period with ideal clock and wires, inputs at the clock edge: the longest path and its setup time."""
    script = folder / "sta.tcl"
    script.write_text(
        f"""
read_liberty {LIBRARY}
read_verilog {folder / "netlist"}
link_design {run.configuration.top}
create_clock -name clock -period {PERIOD} [get_ports clk_i]
set_input_delay 0 -clock clock [all_inputs]
set_output_delay 0 -clock clock [all_outputs]
report_checks -path_delay max -digits 3
"""
    )
    done = subprocess.run(["sta", "-exit", str(script)], capture_output=True, text=True)
    report = done.stdout + done.stderr
    found = {
        key: re.search(pattern, report, re.M)
        for key, pattern in {
            "from": r"^Startpoint: (\S+)",
            "to": r"^Endpoint: (\S+)",
            "slack": r"(-?[\d.]+)\s+slack",
        }.items()
    }
    if not all(found.values()):
        run.failures.append("no path found: " + " / ".join(report.splitlines()[-3:]))
        return
    run.path = {
        "ns": round(PERIOD - float(found["slack"][1]), 2),
        "from": _register(found["from"][1]),
        "to": _register(found["to"][1]),
    }


def _register(name: str) -> str:
    """The register or port that the netlist's name stands for, without the bit."""
    name = name.replace("\\", "")
    name = re.sub(r"DFF[A-Z0-9]+$", "", name)
    name = re.sub(r"(\[\d+\])+$", "", name)
    return re.sub(r"\.(RD|WR)_(DATA|ADDR|EN)$", lambda m: f" ({m[1]}_{m[2]})", name)
