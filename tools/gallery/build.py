#!/usr/bin/env python3
"""Builds the gallery: runs every method, draws pictures and details, and writes the pages.

    tools/gallery/build.py                                  # docs/guides/gallery.md, its pictures, out/gallery/index.html
    tools/gallery/build.py --only fill --docs DIR --out DIR # a part, elsewhere

`make gallery` runs this program. Methods are in tools/gallery/methods.toml.
"""

import argparse
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))  # of the neighbours in tools/

import detail
import figures
import methods
import pages
import pattern
import pictures
import runs
import walk
from write_figures import processor


def draw(method, run, default, images):
    """Writes picture and detail of a method; returns its figures."""
    difference = figures.difference_of(run, default)
    picture = pictures.of(run, method.picture, difference.places)
    is_walk = method.picture == "walk"
    if is_walk:
        (images / method.picture_file).write_text(walk.draw(run))
    else:
        pictures.save(picture, images / method.picture_file)
    edges_of = run if run.triangles is not None else default
    rings = difference.places if method.rings else {}
    text = detail.draw(run, picture, method.detail, rings, edges_of, is_walk)
    (images / method.detail_file).write_text(text)
    return figures.cost_of(run), difference


def build(groups, runner, images):
    images.mkdir(parents=True, exist_ok=True)
    for old in (*images.glob("*.png"), *images.glob("*.svg")):
        old.unlink()
    found = {}
    for group in groups:
        for method in group.methods:
            run = runner.run(method.command, method.passes)
            if group.id == "samples":
                pattern.check(run)
            found[method.id] = draw(method, run, runner.run(method.beside, method.passes), images)
            print(f"{group.id}: {method.id}")
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    root = methods.ROOT
    parser.add_argument("--program", type=pathlib.Path, default=root / "build/release/bin/halfspace")
    parser.add_argument("--docs", type=pathlib.Path, default=root / "docs", help="folder of guides/ and images/")
    parser.add_argument("--out", type=pathlib.Path, default=root / "out/gallery", help="folder of index.html")
    parser.add_argument("--only", action="append", metavar="GROUP", help="these groups alone, repeatable")
    options = parser.parse_args()
    groups = methods.load()
    names = [group.id for group in groups]
    for name in options.only or []:
        if name not in names:
            parser.error(f"group is '{name}'; legal: {', '.join(names)}")
    groups = [group for group in groups if not options.only or group.id in options.only]
    images = options.docs / "images/gallery"
    (options.docs / "guides").mkdir(parents=True, exist_ok=True)
    options.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        found = build(groups, runs.Runner(options.program.resolve(), pathlib.Path(folder)), images)
    page, html = options.docs / "guides/gallery.md", options.out / "index.html"
    pages.write(groups, found, images, page, html, processor())
    size = sum(path.stat().st_size for path in images.iterdir())
    print(f"{len(found)} methods: {page}, {size / 1e6:.2f} MB of pictures, {html}")


if __name__ == "__main__":
    main()
