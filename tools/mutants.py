"""The mutants of a module: its text changed in one place, by rule.

Every kind of change is a function over the source's text that yields places; none knows a module.
"""

import functools
import pathlib
import re
import tomllib
from dataclasses import dataclass

ROOT = pathlib.Path(__file__).resolve().parent.parent
RTL = ROOT / "rtl"
# Printed, or checkers themselves.
NOT_MUTATED = {"raster_pkg", "handshake_checker"}

OTHER_OPERATOR = {
    "==": "!=",
    "!=": "==",
    "&&": "||",
    "||": "&&",
    "&": "|",
    "|": "&",
    "^": "|",
    "+": "-",
    "-": "+",
    "*": "+",
    "<<": ">>",
    ">>": "<<",
    "<<<": ">>>",
    ">>>": ">>",
    "&=": "|=",
    "|=": "&=",
}
BORDER = {"<=": "<", ">=": ">", "<": "<=", ">": ">="}
OPERATOR = re.compile(r"<<<|>>>|<<|>>|==|!=|<=|>=|&&|\|\||\+\+|--|->|\+:|-:|[-+*/&|^<>]=|[<>&|^+*-]")
NUMBER = re.compile(r"(?<![\w'.])\d+(?![\w'])")
SIZED = re.compile(r"\b(\d+)'d(\d+)\b")
PARAMETER = re.compile(r"(?<![\w.$:'`])[A-Z][a-z]\w*(?![\w'(]|\s*(?:\(|::|=[^=]|[-+]\s*1\s*:))")
BIT = re.compile(r"1'b([01])\b")
FILL = re.compile(r"(?<!\w)'([01])(?![\w'])")
NEGATION = re.compile(r"[~!](?=[\w(])")
TERM = r"[~!]?\w+(?:\.\w+)*(?:\[[^][]*\])?"
RIGHT_TERM = re.compile(rf"\s+&&?\s+{TERM}(?=\s*[;,)&|\n?:])")
LEFT_TERM = re.compile(rf"(?:(?<=[=?:]\s)|(?<=[(|]))({TERM}\s+&&?\s+)(?=[\w(~!])")
OPERANDS = re.compile(rf"({TERM})(\s+(?:-|<<|>>|<|>)\s+)({TERM})(?=\s*[;,)\n?])")
CHOICE = re.compile(r"\?\s*([^?:;()\n]+?)\s*:\s*([^?:;()\n]+?)(?=\s*[;,)])")
CONNECTIONS = re.compile(r"\.\w+\s*\(([^()\n]+)\),\s*\.\w+\s*\(([^()\n]+)\)")
ITEMS = re.compile(r"(?<=[{,\s])(\w+(?:\.\w+)*), (\w+(?:\.\w+)*)(?=\s*[,}])")
MEMBERS = re.compile(r"\b\w+:\s*([^,:?\n{}]+),\s*\n\s*\w+:\s*([^,:?\n{}]+)(?=,\n|\n\s*\})")
RANGE = re.compile(r"\[([^][:\n]*?)-\s?1:0\]")
CLOG2_MORE = re.compile(r"\$clog2\((\w+) \+ 1\)|\$clog2\((\w+)\+1\)")
CLOG2 = re.compile(r"\$clog2\(\w+\)")
CREDIT_NAME = r"credit|free|reserve|pop\b|push|room|fetch|taken|waiting|used|left|pending|promised"
CREDIT_PORT = re.compile(r"\.(?:reserve|push|pop|take|free|release|credit)\w*_i\s*\(([^()\n]+)\)")
STEP = re.compile(r"([\w.]+(?:\[[^][]*\])?)\s*[-+]\s*\w+'\(1\)(?=\s*[;:)])")
# What no unit's bench looks at, but the pipeline's does: what a cycle is spent on, whether work is left.
ACTIVITY = re.compile(r"\b\w*activity\w*\b|\b\w*idle_o\b|\bempty_o\b|\b\w+_empty\b")


class Sources:
    """Where the RTL is read; a build folder's commands name RTL."""

    folder = RTL


def text_of(name):
    return (Sources.folder / f"{name}.sv").read_text()


@dataclass(frozen=True)
class Mutant:
    file: str
    start: int
    end: int
    text: str
    kind: str


@dataclass(frozen=True)
class Change:
    """A mutant as a reader sees it: the lines that it touches."""

    line: int
    before: str
    after: str


def blank(text, pattern, flags=0):
    """The text with all that matches replaced by blanks, so that positions stay."""
    return re.sub(pattern, lambda m: re.sub(r"[^\n]", " ", m.group()), text, flags=flags)


def statements_only(text):
    """No comments, strings, assertions, signals unused, legality checks, ports and parameters."""
    text = blank(text, r"/\*.*?\*/|//[^\n]*", re.S)
    text = blank(text, r"\"[^\"\n]*\"")
    text = blank(text, r"`ifn?def SYNTHESIS.*?`endif", re.S)
    text = blank(text, r"\(\*.*?\*\)")
    text = blank(text, r"`[^\n]*")
    text = blank(text, r"\$(?:error|fatal)\b[^;]*;")
    text = blank(text, r"\bif \([^\n]*: gen_illegal.*?\bend\b", re.S)
    text = blank(text, r"\bassign\s+unused_[^;]*;")
    return blank(text, r"\bmodule\b.*?\)\s*;", re.S)


def expressions_only(text):
    """Of the statements those that compute: no declarations, no heads of loops."""
    text = blank(text, r"\btypedef\b[^;{]*;")
    text = blank(text, r"\btypedef\b.*?\}\s*\w+;", re.S)
    text = blank(text, r"\bfor\s*\([^)]*\)")
    text = blank(text, r"\b(?:logic|bit|\w+_t)\b\s*(?:\[[^;\n]*\]\s*)?[\w\s,]+(?:\[[^;\n]*\])?;")
    return blank(text, r"\b(?:logic|bit)\b\s*(?:signed\s*)?\[[^]\n]*\]")


def is_binary(code, position):
    before = code[:position].rstrip()
    return bool(before) and (before[-1].isalnum() or before[-1] in "_)]}'")


def is_assignment(code, position):
    """Whether <= at this position is a non-blocking assignment."""
    statement = re.split(r";|\bbegin\b|\bend\b|\belse\b", code[:position])[-1]
    depth = statement.count("(") - statement.count(")")
    return depth == 0 and not re.search(r"[^=!<>]=[^=]", statement)


def statement_at(code, position):
    start = max(code.rfind(mark, 0, position) for mark in (";", "begin", "end\n"))
    end = code.find(";", position)
    return code[start + 1 : end]


def operators(code):
    for match in OPERATOR.finditer(code):
        operator = match.group()
        if not is_binary(code, match.start()):
            continue
        if operator in OTHER_OPERATOR:
            yield *match.span(), OTHER_OPERATOR[operator], "operator"
        elif operator in BORDER and not (operator == "<=" and is_assignment(code, match.start())):
            yield *match.span(), BORDER[operator], "off by one"


def constants(code, yes_or_no):
    for match in NUMBER.finditer(code):
        value = int(match.group())
        for other in {value + 1, max(value - 1, 0)} - {value}:
            yield *match.span(), str(other), "off by one"
    for match in SIZED.finditer(code):
        value = int(match.group(2)) ^ 1
        yield *match.span(), f"{match.group(1)}'d{value}", "constant"
    for match in PARAMETER.finditer(code):
        if match.group() in yes_or_no:
            continue
        yield *match.span(), f"({match.group()} - 1)", "off by one"
        yield *match.span(), f"({match.group()} + 1)", "off by one"
    for match in BIT.finditer(code):
        yield *match.span(), f"1'b{1 - int(match.group(1))}", "constant"
    for match in FILL.finditer(code):
        yield *match.span(), f"'{1 - int(match.group(1))}", "constant"


def dropped(code):
    for match in NEGATION.finditer(code):
        yield *match.span(), "", "negation removed"
    for pattern, group in ((RIGHT_TERM, 0), (LEFT_TERM, 1)):
        for match in pattern.finditer(code):
            credit = re.search(CREDIT_NAME, match.group())
            yield *match.span(group), "", "credit dropped" if credit else "term dropped"
    for match in CREDIT_PORT.finditer(code):
        if not match.group(1).startswith("1'b"):
            yield *match.span(1), "1'b0", "credit dropped"
            yield *match.span(1), "1'b1", "credit dropped"
    for match in STEP.finditer(code):
        credit = re.search(CREDIT_NAME + "|count", match.group())
        yield *match.span(), match.group(1), "credit dropped" if credit else "off by one"


def swapped(code):
    for match in OPERANDS.finditer(code):
        yield *match.span(), "".join(match.group(3, 2, 1)), "operands swapped"
    for match in CHOICE.finditer(code):
        yield *match.span(), f"? {match.group(2)} : {match.group(1)}", "choice swapped"
    for pattern in (CONNECTIONS, ITEMS, MEMBERS):
        position = 0
        while match := pattern.search(code, position):
            one, two = match.span(1), match.span(2)
            between = code[one[1] : two[0]]
            if match.group(1) != match.group(2):
                text = match.group(2) + between + match.group(1)
                yield one[0], two[1], text, "connections swapped"
            position = one[1]


def widths(code):
    for match in RANGE.finditer(code):
        yield *match.span(), f"[{match.group(1)}-2:0]", "width"
    for match in CLOG2_MORE.finditer(code):
        yield *match.span(), f"$clog2({match.group(1) or match.group(2)})", "width"
    for match in CLOG2.finditer(code):
        yield *match.span(), f"({match.group()} - 1)", "width"


def mutants_of(name):
    """All mutants of a module, in the order of its text."""
    text = text_of(name)
    statements = statements_only(text)
    code = expressions_only(statements)
    yes_or_no = set(re.findall(r"param(?:eter)?\s+bit\s+(\w+)", text))
    found = {
        Mutant(name, *change)
        for changes in (
            operators(code),
            constants(code, yes_or_no),
            dropped(code),
            swapped(code),
            widths(statements),
        )
        for change in changes
    }
    return sorted(found, key=lambda m: (m.start, m.end, m.text))


def change_of(mutant):
    text = text_of(mutant.file)
    first = text.rfind("\n", 0, mutant.start) + 1
    last = text.find("\n", mutant.end)
    after = text[first : mutant.start] + mutant.text + text[mutant.end : last]
    line = text.count("\n", 0, mutant.start) + 1
    return Change(line, *(" ".join(part.split()) for part in (text[first:last], after)))


@functools.cache
def activity_of(name):
    """What finds the lines of a module that only the pipeline's bench looks at, in its statements."""
    code = statements_only(text_of(name))
    signals = []
    for match in re.finditer(r"^ *assign (\w+) +=[^;]*;", code, re.M):
        signal = rf"\b{match.group(1)}\b"
        rest = blank(code[: match.start()], r"^ *logic\b[^;]*;", re.M) + code[match.end() :]
        uses = [lines_at(rest, use.start(), use.end()) for use in re.finditer(signal, rest)]
        if uses and all(ACTIVITY.search(use) for use in uses):
            signals.append(signal)
    return code, re.compile("|".join([ACTIVITY.pattern, *signals]))


def lines_at(code, start, end):
    """The assignment that holds these positions, or else their lines."""
    statement = statement_at(code, start)
    if statement.lstrip().startswith("assign"):
        return statement
    return code[code.rfind("\n", 0, start) + 1 : code.find("\n", end)]


def is_activity(mutant):
    """Whether the mutant is of what only the pipeline's bench looks at."""
    code, pattern = activity_of(mutant.file)
    return bool(pattern.search(lines_at(code, mutant.start, mutant.end)))


def write_mutant(mutant, folder):
    file = folder / f"{mutant.file}.sv"
    text = file.read_text()
    file.write_text(text[: mutant.start] + mutant.text + text[mutant.end :])


class Equivalents:
    """The mutants that no input of a unit tells from the original, each with the reason."""

    FILE = pathlib.Path(__file__).with_name("mutants_equivalent.toml")

    def __init__(self, unit):
        entries = tomllib.loads(self.FILE.read_text()).get("equivalent", [])
        here = [e for e in entries if e.get("unit", unit) == unit]
        self.reasons = {(e["file"], e["before"], e["after"]): e["reason"] for e in here}
        self.places = [((e["file"], e["before"], e["after"]), e.get("places", 1)) for e in entries]

    def reason(self, mutant):
        change = change_of(mutant)
        return self.reasons.get((mutant.file, change.before, change.after))

    def stale(self):
        """Entries that are not the text of as many places any more as they say."""
        for (file, before, after), expected in self.places:
            source = Sources.folder / f"{file}.sv"
            places = set()
            if source.exists():
                changes = (change_of(m) for m in mutants_of(file))
                places = {c.line for c in changes if (c.before, c.after) == (before, after)}
            if len(places) != expected:
                yield f"{file}: `{before}` -> `{after}` is made at {len(places)} places, not {expected}"
