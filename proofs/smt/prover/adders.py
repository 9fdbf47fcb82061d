"""A condition for every cell that can overflow, built into the netlist: its result is the exact integer.

That of $add, $sub and $neg is a wider adder beside it. A product is exact without one if its operands are short
enough: |a| < 2^k and |b| < 2^l give |ab| < 2^(k+l), which k + l + 1 signed bits hold.
"""

import pathlib

from pyosys import libyosys as ys

KINDS = ("$add", "$sub", "$neg", "$mul", "$shl", "$sshl")
# Cells that the units must not have, because nothing here looks at them.
UNKNOWN = ("$alu", "$macc", "$macc_v2", "$lcu", "$fa", "$div", "$mod", "$divfloor", "$modfloor", "$pow", "$shift")

TRUE = ys.SigSpec(ys.State.S1, 1)


def name(text):
    return ys.IdString("\\" + text)


def instrument(module, as_signed):
    """Adds an $assert for each cell; returns {name of the assertion: text of the adder}.

    `as_signed`: texts of adders that are unsigned for the language only, as is a sum with '0.
    """
    found = {}
    for cell in list(module.selected_cells()):
        kind = cell.type.str()
        if kind in UNKNOWN:
            raise ValueError(f"{cell.get_src_attribute()}: a cell {kind}, whose result is not looked at")
        if kind in KINDS:
            label = f"exact_{len(found)}"
            found[label] = source_text(cell.get_src_attribute())
            exact = Exact(module, cell, label, signed=found[label] in as_signed)
            module.addAssert(name(label), exact.condition(), TRUE)
    return found


def source_text(place):
    """The expression at a cell's `src`, such as a.sv:12.5-12.20: what a reader knows the adder by."""
    path, span = place.split("|")[0].rsplit(":", 1)
    (first, left), (last, right) = (map(int, end.split(".")) for end in span.split("-"))
    lines = pathlib.Path(path).read_text().splitlines()[first - 1:last]
    lines[-1] = lines[-1][:right - 1]
    lines[0] = lines[0][left - 1:]
    return f"{pathlib.Path(path).name}: {' '.join(' '.join(lines).split())}"


def significant(signal, signed):
    """Bits of a signal without copies of its sign, or without leading zeros."""
    bits = list(signal.to_sigbit_vector())
    if signed:
        while len(bits) > 1 and bits[-1] == bits[-2]:
            bits.pop()
    else:
        zero = ys.SigBit(ys.State.S0)
        while len(bits) > 1 and bits[-1] == zero:
            bits.pop()
    return len(bits)


class Exact:
    def __init__(self, module, cell, label, signed):
        self.module, self.cell, self.label = module, cell, label
        self.kind = cell.type.str()
        self.a = cell.getPort(name("A"))
        self.b = cell.getPort(name("B")) if self.kind != "$neg" else None
        self.y = cell.getPort(name("Y"))
        self.signed = signed or cell.getParam(name("A_SIGNED")).as_bool()
        self.parts = 0

    def wire(self, width):
        self.parts += 1
        return ys.SigSpec(self.module.addWire(name(f"{self.label}_wire_{self.parts}"), width))

    def cell_name(self):
        self.parts += 1
        return name(f"{self.label}_cell_{self.parts}")

    def extended(self, signal, width):
        copy = ys.SigSpec(signal)
        copy.extend_u0(width, self.signed)
        return copy

    def equal(self, exact):
        same = self.wire(1)
        width = exact.size()
        self.module.addEq(self.cell_name(), exact, self.extended(self.y, width), same, False)
        return same

    def condition(self):
        if self.kind == "$mul":
            return self.product()
        if self.kind in ("$shl", "$sshl"):
            amount = self.b.as_int() if self.b.is_fully_const() else 2 ** self.b.size() - 1
            exact = self.wire(max(self.a.size() + amount, self.y.size()) + 1)
            self.module.addShl(self.cell_name(), self.extended(self.a, exact.size()), self.b, exact, False)
            return self.equal(exact)
        width = max(signal.size() for signal in (self.a, self.b, self.y) if signal) + 2
        exact = self.wire(width)
        a = self.extended(self.a, width)
        if self.kind == "$neg":
            self.module.addNeg(self.cell_name(), a, exact, False)
        else:
            add = self.module.addAdd if self.kind == "$add" else self.module.addSub
            add(self.cell_name(), a, self.extended(self.b, width), exact, False)
        return self.equal(exact)

    def product(self):
        bits_a, bits_b = significant(self.a, self.signed), significant(self.b, self.signed)
        width = self.y.size()
        if bits_a + bits_b <= width:
            return TRUE
        if not self.signed or bits_a + bits_b > width + 1:
            raise ValueError(f"{self.cell.get_src_attribute()}: {bits_a} times {bits_b} bits in {width}")
        # One bit short: only the product of the two least numbers is too large.
        least = []
        for signal, bits in ((self.a, bits_a), (self.b, bits_b)):
            is_least = self.wire(1)
            number = ys.SigSpec(ys.State.S0, bits - 1)
            number.append(TRUE)
            self.module.addEq(self.cell_name(), signal.extract(0, bits), number, is_least, False)
            least.append(is_least)
        not_both = self.wire(1)
        both = self.wire(1)
        self.module.addAnd(self.cell_name(), least[0], least[1], both, False)
        self.module.addNot(self.cell_name(), both, not_both, False)
        return not_both
