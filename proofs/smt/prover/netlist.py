"""From RTL and a module of properties to SMT-LIB, by Yosys. Yosys ends its process on an error: see job.py."""

from pyosys import libyosys as ys

from prover import adders

# Cells stay as they are written: no pass may narrow, share or remove one before its adders are looked at.
ELABORATE = ("hierarchy -check -top {top}", "proc -noopt", "flatten")
# What has no value, such as a word behind the last of a memory, may have any.
LOWER = ("opt_expr", "opt_clean", "memory_collect", "memory_map", "setundef -undriven -anyseq", "opt_clean",
         "chformal -lower", "dffunmap", "opt_expr", "opt_clean", "check -assert")


def write(job, smt2):
    """Writes the netlist of the job's top as SMT-LIB; returns the adders that were looked at, {assertion: text}."""
    design = ys.Design()
    top = job["top"]

    def run(*commands):
        for command in commands:
            ys.run_pass(command.format(top=top), design)

    options = [f"-G {name}={value}" for name, value in job["parameters"].items()]
    options += [f"-D {name}={value}" for name, value in job["defines"].items()]
    run(f"read_slang -D SYNTHESIS --top {top} {' '.join(options + job['files'])}", *ELABORATE)
    found = adders.instrument(design.top_module(), job["as_signed"]) if job["adders"] else {}
    run(*LOWER, f"write_smt2 {smt2}")
    return found
