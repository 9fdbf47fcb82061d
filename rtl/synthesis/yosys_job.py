"""One run of Yosys, in a process of its own because Yosys ends its process on an error. Started by runs.py.

    python yosys_job.py JOB.json    # writes the result to the file that the job names
"""

import json
import pathlib
import sys

from pyosys import libyosys as ys

LATCHES = ["$dlatch", "$adlatch", "$dlatchsr", "$sr"]
NEVER = [*LATCHES, "$div", "$mod", "$divfloor", "$modfloor", "$pow"]

# A memory that is read through a register is one from so many bits on: a macro. Below, flip-flops are smaller.
REGISTERED_BITS = 1024
# A memory that is read in the cycle of its address has flip-flops and a multiplexer; from here on it is left out too,
# because mapping it takes longer than all else.
UNREGISTERED_BITS = 16384


class Job:
    def __init__(self, job: dict):
        self.job = job
        self.design = ys.Design()

    def run(self, *commands: str) -> None:
        for command in commands:
            ys.run_pass(command, self.design)

    def cells(self):
        return self.design.top_module().selected_cells()

    def elaborate(self) -> None:
        top = self.job["top"]
        options = [f"-D HALFSPACE_{name}={value}" for name, value in self.job["defines"].items()]
        options += [f"-G {name}={value}" for name, value in self.job["parameters"].items()]
        self.run(
            f"read_slang -D SYNTHESIS --keep-hierarchy --top {top} {' '.join(options + self.job['files'])}",
            f"hierarchy -check -top {top}",
            "proc",
            # opt_dff finds the enables of registers, and memory_dff by them the registers of memories, only where
            # opt_clean was before.
            "opt_expr",
            "opt_clean",
            "opt -fast",
        )
        if self.job["find_memories"]:
            self.find_memories()
        self.run(
            "flatten",
            "opt_expr",
            "opt_clean",
            "opt -fast",
            "wreduce",
            "peepopt",
            "opt_clean",
            "check -assert",
            "select -assert-none " + " ".join(f"t:{kind}" for kind in NEVER),
        )

    def find_memories(self) -> None:
        """Module by module: in the flat design the same takes minutes."""
        self.run(
            "opt_mem",
            "opt_mem_priority",
            "opt_mem_feedback",
            "memory_dff",
            "memory_share",
            "opt_mem_widen",
            "opt_clean",
            "memory_collect",
            # Registers that are written as an array.
            "memory_map t:$mem_v2 r:SIZE=1 %i",
        )

    def memories(self) -> list[dict]:
        found = []
        for cell in self.cells():
            if cell.type.str() != "$mem_v2":
                continue

            def number(name, cell=cell):
                return cell.getParam(ys.IdString("\\" + name)).as_int()

            def mask(name, cell=cell):
                return cell.getParam(ys.IdString("\\" + name)).as_string()

            words, bits = number("SIZE"), number("WIDTH")
            clocked = "0" not in mask("RD_CLK_ENABLE")
            registered = clocked and "1" not in mask("RD_TRANSPARENCY_MASK")
            kept = words * bits >= (REGISTERED_BITS if registered else UNREGISTERED_BITS)
            if kept:
                cell.set_bool_attribute(ys.IdString("\\kept_memory"), True)
            found.append(
                {
                    "name": cell.name.str().lstrip("\\"),
                    "words": words,
                    "bits": bits,
                    "reads": number("RD_PORTS"),
                    "writes": number("WR_PORTS"),
                    "registered": registered,
                    "kept": kept,
                }
            )
        return sorted(found, key=lambda memory: memory["name"])

    def multipliers(self) -> list[str]:
        widths = []
        for cell in self.cells():
            if cell.type.str() == "$mul":
                a, b = (cell.getParam(ys.IdString(f"\\{port}_WIDTH")).as_int() for port in "AB")
                widths.append(f"{max(a, b)} x {min(a, b)}")
        return sorted(widths)

    def map_to_library(self) -> None:
        """Gates of the library, buffered and sized. Kept memories are cut out: their ports become the module's."""
        library, script = self.job["library"], self.job["abc"]
        self.run(
            "expose -evert a:kept_memory",
            "delete -port w:*.RD_CLK w:*.WR_CLK",
            "memory_map",
            "opt_expr",
            "opt_clean",
            "opt -fast -full",
            "alumacc",
            "share",
            "opt -fast",
            "techmap",
            "opt -fast",
            f"dfflibmap -liberty {library}",
            "opt_clean -purge",
            f"abc -liberty {library} -constr {self.job['constraints']} -script {script}",
            "setundef -zero",
            "opt_clean -purge",
            # The flip-flops' names are what a path is known by. Needs to know which of their pins is the output.
            f"read_liberty -lib {library}",
            "rename -wire t:DFF*",
            "splitnets -ports",
            "opt_clean -purge",
            f"tee -q -o {self.job['statistics']} stat -json -liberty {library}",
            f"write_verilog -noattr -noexpr {self.job['netlist']}",
        )

    def map_to_ecp5(self) -> None:
        self.run(
            f"synth_ecp5 -top {self.job['top']}",
            f"tee -q -o {self.job['statistics']} stat -json",
        )

    def statistics(self) -> dict:
        path = pathlib.Path(self.job["statistics"])
        return json.loads(path.read_text())["design"] if path.exists() else {}


def main() -> None:
    description = json.loads(pathlib.Path(sys.argv[1]).read_text())
    job = Job(description)
    job.elaborate()
    result = {"memories": job.memories(), "multipliers": job.multipliers()}
    if description["target"] == "osu018":
        job.map_to_library()
    elif description["target"] == "ecp5":
        job.map_to_ecp5()
    result["statistics"] = job.statistics()
    pathlib.Path(description["result"]).write_text(json.dumps(result))


if __name__ == "__main__":
    main()
