"""What proofs.toml and mutants.toml list, read and checked."""

import pathlib
import tomllib
from dataclasses import dataclass, field

HERE = pathlib.Path(__file__).resolve().parent.parent
RTL = HERE.parent.parent / "rtl"


@dataclass
class Proof:
    name: str
    says: str
    top: str  # a module of properties/, or a file of lemmas/: the name of both
    kind: str  # window, induction, bounded or lemma: see job.py
    rtl: list[str] = field(default_factory=list)  # files of rtl/, or file lists
    depth: int = 0
    configurations: list[dict] = field(default_factory=lambda: [{}])
    properties: list[str] = field(default_factory=list)  # more files of properties/
    reach: int = 0  # cycles of a run from reset that meets the covers
    solver: str = "bitwuzla"
    limit: int = 120  # seconds for one question
    gate: bool = False
    uninterpreted_products: bool = False
    adders: bool = False
    as_signed: list[str] = field(default_factory=list)  # adders that only the language takes for unsigned
    wraps: dict[str, str] = field(default_factory=dict)  # adder: why it may overflow
    narrowed: dict[str, str] = field(default_factory=dict)  # text of raster_pkg.sv: what stands there instead

    def files(self, rtl):
        """All files, in the order of their dependencies; `rtl` may be the folder of a mutant."""
        if self.kind == "lemma":
            return [next(path for path in (rtl / f"lemmas/{self.top}.smt2", HERE / f"lemmas/{self.top}.smt2")
                         if path.exists())]
        names = [name for listed in self.rtl for name in
                 ((RTL / listed).read_text().split() if listed.endswith(".f") else [listed])]
        own = [HERE / "properties" / f"{name}.sv" for name in [*self.properties, self.top]]
        return [rtl / name for name in dict.fromkeys(names)] + own

    def job(self, configuration, rtl):
        defines = {key: value for key, value in configuration.items() if key.startswith("HALFSPACE_")}
        return {
            "top": self.top, "files": [str(path) for path in self.files(rtl)], "kind": self.kind,
            "depth": self.depth, "reach": self.reach, "solver": self.solver, "limit": self.limit,
            "uninterpreted_products": self.uninterpreted_products, "adders": self.adders, "as_signed": self.as_signed, "defines": defines,
            "parameters": {key: value for key, value in configuration.items() if key not in defines},
        }


@dataclass
class Mutant:
    name: str
    file: str  # of rtl/
    old: str
    new: str
    proof: str
    breaks: str  # the assertion, or the adder, that must be refuted
    configuration: int = 0


def proofs():
    listed = tomllib.loads((HERE / "proofs.toml").read_text())
    return {name: Proof(name, **entry) for name, entry in listed.items()}


def mutants():
    listed = tomllib.loads((HERE / "mutants.toml").read_text())
    return [Mutant(name, old=entry.pop("from"), new=entry.pop("to"), **entry) for name, entry in listed.items()]
