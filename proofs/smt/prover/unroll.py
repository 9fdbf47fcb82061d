"""Yosys' SMT-LIB of a module, over several clock cycles.

Yosys writes each signal as a function of the state. Here it becomes a constant for each cycle, `|signal@cycle|`. A
register in the first cycle is any value; later it is what the cycle before gave it.
"""

import re

STATE = re.compile(r"\((\|[^|]+)\| state\)")
DECLARE = re.compile(r"\(declare-fun \|([^|]+)\| \(\|[^|]+\|\) (.+?)\)(?: ; (.*))?$")
DEFINE = re.compile(r"\(define-fun \|([^|]+)\| \(\(state \|[^|]+\|\)\) (Bool|\(_ BitVec \d+\)) (.*)\)(?: ; .*)?$")
NEXT = re.compile(r"  \(= (.*) \(\|([^|]+)\| next_state\)\) ;")
PROPERTY = re.compile(r"; yosys-smt2-(assert|assume|cover) (\d+) (\S+)")
PRODUCT = re.compile(r"\(bvmul ")
KINDS = {"assert": "a", "assume": "u", "cover": "c"}


class Module:
    def __init__(self, text, uninterpreted_products=False):
        self.registers = {}  # name: its value in the next cycle
        self.signals = []  # (name, sort, expression, or None for inputs and registers), each after those it needs
        self.labels = {}  # name: what the RTL calls it
        self.products = set()  # widths of the products that became functions
        self.properties = {kind: [] for kind in KINDS}  # (name of the function, label)
        self.top = re.search(r"; yosys-smt2-topmod (\S+)", text)[1]
        for line in text.splitlines():
            self._read(line, uninterpreted_products)

    def _read(self, line, uninterpreted_products):
        if match := PROPERTY.match(line):
            kind, number, label = match.groups()
            self.properties[kind].append((f"{self.top}_{KINDS[kind]} {number}", label))
        elif (match := DECLARE.match(line)) and not match[1].endswith("_is"):
            self.signals.append((match[1], match[2], None))
            self.labels[match[1]] = (match[3] or "").lstrip("\\")
        elif match := DEFINE.match(line):
            name, sort, expression = match.groups()
            if uninterpreted_products and PRODUCT.search(expression):
                width = re.search(r"\d+", sort)[0]
                self.products.add(width)
                expression = PRODUCT.sub(f"(product{width} ", expression)
            self.signals.append((name, sort, expression))
        elif match := NEXT.match(line):
            self.registers[match[2]] = match[1]

    def input(self, label):
        return f"{self.top}_n {label}"

    def at(self, expression, cycle):
        return STATE.sub(rf"\1@{cycle}|", expression)

    def functions(self):
        return [f"(declare-fun product{width} ((_ BitVec {width}) (_ BitVec {width})) (_ BitVec {width}))"
                for width in sorted(self.products)]

    def cycle(self, cycle):
        """The lines that define all signals in a cycle; those of the cycle before come first."""
        lines = []
        for name, sort, expression in self.signals:
            if expression is None and cycle > 0 and name in self.registers:
                lines.append(f"(define-fun |{name}@{cycle}| () {sort} {self.at(self.registers[name], cycle - 1)})")
            elif expression is None:
                lines.append(f"(declare-fun |{name}@{cycle}| () {sort})")
            else:
                lines.append(f"(define-fun |{name}@{cycle}| () {sort} {self.at(expression, cycle)})")
        return lines

    def all(self, kind, cycle):
        """The conjunction of all properties of a kind in a cycle."""
        names = " ".join(f"|{name}@{cycle}|" for name, _ in self.properties[kind])
        return f"(and true true {names})"
