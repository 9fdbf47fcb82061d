#!/usr/bin/env python3
"""Checks the Markdown pages: every relative link and every path in backticks leads to something.

    tools/check_links.py [ROOT]

A link must point to a file or folder; its #anchor to a heading. A path in backticks counts when it
begins with a folder of the source tree, as `tools/check_links.py` does; `*` stands for any name.
Exit status 1 where something is missing.
"""

import argparse
import pathlib
import re
import sys

FENCE = re.compile(r"^```.*?^```[ ]*$", re.MULTILINE | re.DOTALL)
CODE_LINE = re.compile(r"^ {4}.*$", re.MULTILINE)
CODE_SPAN = re.compile(r"`([^`\n]+)`")
LINK = re.compile(r"!?\[[^\]]*\]\(<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\)")
HEADING = re.compile(r"^#{1,6} +(.*?) *#*$", re.MULTILINE)
SOURCES = ("cmake", "configs", "docs", "model", "rtl", "scenes", "tb", "tests", "tools")
PATH = re.compile(rf"^(?:{'|'.join(SOURCES)})/[\w.*/-]+$")
LEFT_OUT = ("build", "out")


def anchors(text):
    """The anchors that a page's headings get on GitHub."""
    found = set()
    for heading in HEADING.findall(FENCE.sub("", text)):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
        slug = re.sub(r"[^\w\- ]", "", plain.strip().lower()).replace(" ", "-")
        number = 0
        while (f"{slug}-{number}" if number else slug) in found:
            number += 1
        found.add(f"{slug}-{number}" if number else slug)
    return found


def broken_links(page, text, root):
    """What is wrong with the links of a page, each a line."""
    for target in LINK.findall(CODE_SPAN.sub("", CODE_LINE.sub("", FENCE.sub("", text)))):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        file = (page.parent / path).resolve() if path else page
        if not file.exists():
            yield f"link to '{target}': there is no such file"
        elif not file.is_relative_to(root):
            yield f"link to '{target}': it leads out of the tree"
        elif anchor and file.suffix == ".md" and anchor not in anchors(file.read_text()):
            yield f"link to '{target}': there is no such heading"


def missing_paths(text, root):
    """Paths in backticks that are not there, each a line. Of a command only the program counts."""
    for code in CODE_SPAN.findall(FENCE.sub("", text)):
        word = code.split()[0] if code.split() else ""
        if PATH.match(word) and not any(root.glob(word.rstrip("/"))):
            yield f"`{word}`: there is no such file"


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "root", type=pathlib.Path, nargs="?", default=pathlib.Path(__file__).parent.parent
    )
    root = parser.parse_args().root.resolve()
    pages = [
        page
        for page in sorted(root.rglob("*.md"))
        if page.relative_to(root).parts[0] not in LEFT_OUT
        and not any(part.startswith(".") for part in page.relative_to(root).parts)
    ]
    faults = 0
    for page in pages:
        text = page.read_text()
        for fault in [*broken_links(page, text, root), *missing_paths(text, root)]:
            print(f"{page.relative_to(root)}: {fault}")
            faults += 1
    print(f"{len(pages)} pages, {faults} faults")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
