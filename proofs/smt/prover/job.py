"""One proof, in a process of its own: Yosys ends its process on an error, and the parent counts its seconds.

    python job.py JOB.json    # writes the result to the file that the job names

Kinds: `window`, from any state of the registers at all every assertion holds after so many cycles; this is for
pipelines, which have forgotten their state by then. `induction`, all assertions hold after a reset, and after so many
cycles in which they held. `bounded`, they hold for so many cycles after a reset. `lemma`, a file of SMT-LIB that knows
no RTL. Every cover must be met, in the window or in a run from reset.
"""

import json
import pathlib
import re
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

from prover import netlist, solver, unroll  # noqa: E402


def follows(label):
    """Whether an assertion is proved from the others alone: in one cycle, from any state in which they hold."""
    return label.split(".")[-1].startswith("Follows")


class Proof:
    def __init__(self, job, text, found):
        self.job = job
        self.adder = found
        self.module = unroll.Module(text, job["uninterpreted_products"])
        self.failed = {}  # label of an assertion: how

    def solver(self):
        made = solver.SOLVERS[self.job["solver"]](self.job["limit"])
        made.add(self.module.functions())
        return made

    def assume(self, made, cycle):
        made.add([*self.module.cycle(cycle), f"(assert {self.module.all('assume', cycle)})"])

    def reset(self, made):
        made.add([f"(assert (not |{self.module.input('rst_ni')}@0|))"])

    def assume_others(self, made, cycle):
        made.add([f"(assert |{name}@{cycle}|)" for name, label in self.module.properties["assert"]
                  if not follows(label)])

    def check_asserts(self, made, cycle, where, following=False):
        breaks = self.job["breaks"]
        for name, label in self.module.properties["assert"]:
            if label in self.failed or (breaks is None and follows(label) != following):
                continue
            if breaks not in (None, label, self.adder.get(label)):
                continue
            answer = made.check(f"(not |{name}@{cycle}|)")
            print(f"{label}, {where}: {answer}, {time.process_time():.1f} s", flush=True)
            if answer != "unsat":
                self.failed[label] = f"{where}: {answer}{self.example(made, cycle) if answer == 'sat' else ''}"

    def example(self, made, cycle):
        """What inputs and registers hold in the counterexample."""
        if not self.job["example"]:
            return ""
        lines = []
        for at in range(cycle + 1):
            lines += [f"  {at}: {label} = {made.value(f'|{name}@{at}|')}" for name, label in
                      self.module.labels.items() if at == 0 or name not in self.module.registers]
        return "\n" + "\n".join(lines)

    def window(self):
        depth = self.job["depth"]
        made = self.solver()
        for cycle in range(depth + 1):
            self.assume(made, cycle)
        self.check_asserts(made, depth, "window")
        if not self.job["breaks"]:
            self.check_following()
        return [label for name, label in self.module.properties["cover"]
                if made.check(f"|{name}@{depth}|") == "sat"]

    def check_following(self):
        if any(follows(label) for _, label in self.module.properties["assert"]):
            made = self.solver()
            self.assume(made, 0)
            self.assume_others(made, 0)
            self.check_asserts(made, 0, "from the others", following=True)

    def induction(self):
        depth = self.job["depth"]
        base = self.solver()
        self.assume(base, 0)
        self.reset(base)
        for cycle in range(1, depth + 1):
            self.assume(base, cycle)
            self.check_asserts(base, cycle, f"{cycle} cycles after reset")
        step = self.solver()
        for cycle in range(depth):
            self.assume(step, cycle)
            self.assume_others(step, cycle)
        self.assume(step, depth)
        self.check_asserts(step, depth, "step")
        self.check_following()
        return self.reached(self.job["reach"], check=False)

    def reached(self, reach, check):
        """A run from reset: the covers it meets and, to check them, the assertions that it breaks."""
        run = self.solver()
        self.assume(run, 0)
        self.reset(run)
        met = []
        for cycle in range(1, reach + 1):
            self.assume(run, cycle)
            if check:
                self.check_asserts(run, cycle, f"{cycle} cycles after reset")
            if self.job["breaks"]:
                if self.failed:
                    break
                continue
            met += [label for name, label in self.module.properties["cover"]
                    if label not in met and run.check(f"|{name}@{cycle}|") == "sat"]
            if not check and len(met) == len(self.module.properties["cover"]):
                break
        return met

    def result(self):
        if self.job["kind"] == "window":
            met = self.window()
        elif self.job["kind"] == "bounded" or self.job["breaks"]:
            met = self.reached(self.job["reach"], check=True)
        else:
            met = self.induction()
        covers = [label for _, label in self.module.properties["cover"]]
        return {
            "asserts": len(self.module.properties["assert"]),
            "adders": self.adder,
            "failed": self.failed,
            "covers": covers,
            "unmet": [label for label in covers if label not in met],
        }


def lemma(job):
    """A file of SMT-LIB: each of its definitions `property_NAME` follows from its assertions, which can be met."""
    text = pathlib.Path(job["files"][0]).read_text()
    labels = re.findall(r"\(define-fun property_(\w+) ", text)
    made = solver.SOLVERS[job["solver"]](job["limit"], re.search(r"\(set-logic (\w+)\)", text)[1])
    made.add(line for line in text.splitlines() if not line.startswith("(set-logic"))
    answers = {label: made.check(f"(not property_{label})") for label in labels}
    return {
        "asserts": len(labels), "adders": {}, "covers": ["assumptions"],
        "failed": {label: f"lemma: {answer}" for label, answer in answers.items() if answer != "unsat"},
        "unmet": [] if made.check("true") == "sat" else ["assumptions"],
    }


def prove(job):
    smt2 = pathlib.Path(job["folder"]) / "netlist.smt2"
    found = netlist.write(job, smt2)
    return Proof(job, smt2.read_text(), found).result()


def main():
    job = json.loads(pathlib.Path(sys.argv[1]).read_text())
    result = lemma(job) if job["kind"] == "lemma" else prove(job)
    pathlib.Path(job["result"]).write_text(json.dumps(result))


if __name__ == "__main__":
    main()
