#!/usr/bin/env python3
"""Checks that a gallery is whole. Needs no other packages.

    tools/gallery/check.py                                   # the page of the docs and its pictures
    tools/gallery/check.py --docs DIR --html FILE --only fill    # a part, elsewhere, and its HTML file

Every method has its picture, its detail and its command on the page, every picture is one of a method, each picture says
what it is, and all together are small. The HTML file has them too, and refers to nothing outside of itself.
Exit status 1 where something is wrong.
"""

import argparse
import html.parser
import pathlib
import re
import shlex
import sys
import xml.etree.ElementTree

import methods

MOST_BYTES = 1_500_000
STARTS = {".png": b"\x89PNG\r\n\x1a\n", ".svg": b"<svg "}
REFERS = {"src", "href", "srcset", "data", "action", "poster", "xlink:href"}


class Reader(html.parser.HTMLParser):
    """What an HTML file refers to, and what it shows."""

    def __init__(self):
        super().__init__()
        self.outside = []
        self.images = 0
        self.ids = set()
        self.code = []
        self.targets = []
        self._in_code = False

    def handle_starttag(self, tag, attributes):
        self.images += tag == "img"
        if tag == "code":
            self._in_code = True
            self.code.append("")
        for name, value in attributes:
            if name == "id":
                self.ids.add(value)
            elif name in REFERS and value.startswith("#"):
                self.targets.append(value[1:])
            elif name in REFERS and not value.startswith("data:"):
                self.outside.append(f"{tag} {name}={value}")

    def handle_endtag(self, tag):
        if tag == "code":
            self._in_code = False

    def handle_data(self, data):
        if self._in_code:
            self.code[-1] += data
        self.outside += re.findall(r"@import|url\([^)]*|https?://\S+|\bfetch\(|\bimport\(", data)


def is_command_of(method, line):
    """Whether the line is `halfspace run` with just these options, then records, passes and the folder."""
    words = shlex.split(line)
    return words[: 2 + len(method.command)] == ["halfspace", "run", *method.command] and words[-2:] == [
        "--out",
        f"out/gallery/{method.id}",
    ]


def check_image(path, alone):
    if not path.is_file():
        return [f"{path}: there is no such picture"]
    data = path.read_bytes()
    if not data.startswith(STARTS[path.suffix]):
        return [f"{path}: it is not a {path.suffix[1:]} file"]
    if path.suffix == ".svg":
        xml.etree.ElementTree.fromstring(data)
        if re.search(rb"<script|href=|url\(", data):
            return [f"{path}: it refers to something"]
    return [f"{path}: it has no step"] if alone and b"<set " not in data else []


def check_docs(groups, docs):
    images, page = docs / "images/gallery", docs / "guides/gallery.md"
    if not page.is_file() or not images.is_dir():
        yield f"{page}, {images}: there is no such page or folder"
        return
    text = page.read_text()
    commands = [line.strip() for line in text.splitlines() if line.startswith("    halfspace run ")]
    wanted = set()
    for method in (method for group in groups for method in group.methods):
        for name in (method.picture_file, method.detail_file):
            wanted.add(name)
            yield from check_image(images / name, alone=name == method.picture_file and method.picture == "walk")
            if f"](../images/gallery/{name})" not in text:
                yield f"{page}: no picture {name}"
        if sum(is_command_of(method, line) for line in commands) != 1:
            yield f"{page}: not one command of {method.id}"
        rows = [line for line in text.splitlines() if line.startswith(f"| {method.title} | ")]
        if not any(re.search(r"\| [\d,]+ \|", row) for row in rows):
            yield f"{page}: no figures of {method.id}"
    for path in sorted(images.iterdir()):
        if path.name not in wanted:
            yield f"{path}: of no method"
    size = sum(path.stat().st_size for path in images.iterdir())
    if size > MOST_BYTES:
        yield f"{images}: {size} bytes; legal: at most {MOST_BYTES}"


def check_html(groups, path):
    if not path.is_file():
        yield f"{path}: there is no such file"
        return
    reader = Reader()
    reader.feed(path.read_text())
    yield from (f"{path}: it refers to {what}" for what in reader.outside)
    yield from (f"{path}: there is no #{target}" for target in reader.targets if target not in reader.ids)
    all_methods = [method for group in groups for method in group.methods]
    if reader.images != 2 * len(all_methods):
        yield f"{path}: {reader.images} pictures of {len(all_methods)} methods"
    for method in all_methods:
        if f"m-{method.id}" not in reader.ids:
            yield f"{path}: no {method.id}"
        if sum(is_command_of(method, code) for code in reader.code if code.startswith("halfspace run ")) != 1:
            yield f"{path}: not one command of {method.id}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--docs", type=pathlib.Path, default=methods.ROOT / "docs")
    parser.add_argument("--html", type=pathlib.Path, help="also this file")
    parser.add_argument("--only", action="append", metavar="GROUP", help="these groups alone, repeatable")
    options = parser.parse_args()
    groups = [group for group in methods.load() if not options.only or group.id in options.only]
    wrong = list(check_docs(groups, options.docs))
    if options.html:
        wrong += check_html(groups, options.html)
    print("\n".join(wrong) if wrong else f"{sum(len(group.methods) for group in groups)} methods are whole")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
