#!/usr/bin/env python3
"""Builds three groups of the gallery on the smallest scenes, and looks whether pictures say what the runs wrote, and
whether tools/gallery/check.py finds what is missing.

    tests/gallery/gallery_test.py PROGRAM    # needs tools/requirements-gallery.txt
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

GALLERY = pathlib.Path(__file__).resolve().parents[2] / "tools/gallery"
sys.path.insert(0, str(GALLERY))

import methods  # noqa: E402
import pattern  # noqa: E402
import runs  # noqa: E402

GROUPS = ("fill", "tiles", "samples")
PROGRAM = pathlib.Path()


def only():
    return [word for group in GROUPS for word in ("--only", group)]


class Gallery(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        cls.docs = pathlib.Path(cls.place.name) / "docs"
        cls.out = pathlib.Path(cls.place.name) / "out"
        build = [sys.executable, GALLERY / "build.py", "--program", PROGRAM, "--docs", cls.docs, "--out", cls.out]
        subprocess.run([*build, *only()], check=True, stdout=subprocess.DEVNULL)
        cls.methods = {m.id: m for g in methods.load() if g.id in GROUPS for m in g.methods}
        cls.runner = runs.Runner(PROGRAM, pathlib.Path(cls.place.name) / "runs")

    @classmethod
    def tearDownClass(cls):
        cls.place.cleanup()

    def checked(self, change=lambda docs, html: None):
        """What check.py says of a copy that `change` has changed: status and text."""
        with tempfile.TemporaryDirectory() as place:
            docs = shutil.copytree(self.docs, pathlib.Path(place) / "docs")
            html = shutil.copytree(self.out, pathlib.Path(place) / "out") / "index.html"
            change(docs, html)
            check = [sys.executable, GALLERY / "check.py", "--docs", docs, "--html", html, *only()]
            done = subprocess.run(check, text=True, stdout=subprocess.PIPE, check=False)
            return done.returncode, done.stdout

    def assert_found(self, change, *words):
        status, text = self.checked(change)
        self.assertEqual(status, 1, text)
        for word in words:
            self.assertIn(word, text)

    def test_whole(self):
        status, text = self.checked()
        self.assertEqual(status, 0, text)
        self.assertIn(f"{len(self.methods)} methods are whole", text)

    def test_what_is_missing_is_found(self):
        images = "images/gallery"

        def edit(which, old, new):
            def change(docs, html):
                path = docs / "guides/gallery.md" if which == "page" else html
                text = path.read_text()
                self.assertIn(old, text)
                path.write_text(text.replace(old, new))

            return change

        self.assert_found(lambda docs, _: (docs / images / "top_left.png").unlink(), "top_left.png")
        self.assert_found(lambda docs, _: (docs / images / "samples_4_detail.svg").unlink(), "samples_4_detail.svg")
        self.assert_found(lambda docs, _: (docs / images / "more.png").write_bytes(b""), "more.png: of no method")
        self.assert_found(lambda docs, _: (docs / images / "top_left.png").write_bytes(b"no"), "not a png file")
        self.assert_found(
            lambda docs, _: (docs / images / "order_hilbert.svg").write_text("<svg xmlns='s'/>"), "it has no step"
        )
        self.assert_found(
            lambda docs, _: (docs / images / "top_left_detail.svg").write_text("<svg href='a'/>"), "refers to something"
        )
        self.assert_found(edit("page", "--set raster.samples=16", "--set raster.samples=8"), "one command of samples_16")
        self.assert_found(edit("html", "--set raster.samples=16", "--set raster.samples=8"), "one command of samples_16")
        self.assert_found(edit("page", "| 16 samples, standard positions | ", "| 16 | "), "no figures of samples_16")
        self.assert_found(edit("html", "<main", '<img src="https://example.org/a.png"><main'), "refers to", "pictures")
        self.assert_found(edit("html", "<style>", "<style>@import 'a.css';"), "refers to @import")
        self.assert_found(edit("html", "#methods", "#nowhere"), "there is no #nowhere")

    def test_animation_has_every_step_in_order(self):
        for name in ("order_raster", "order_hilbert"):
            run = self.runner.run(self.methods[name].command, 1)
            text = (self.docs / "images/gallery" / f"{name}.svg").read_text()
            shown = re.findall(r'<g><path fill="(#\w+)" d="M(\d+) (\d+)h(\d+).*?begin="t.begin\+([\d.]+)s"', text)
            self.assertEqual(len(shown), len(run.steps))
            self.assertEqual(
                [(int(x), int(y), int(side)) for _, x, y, side, _ in shown],
                [(step["x"], step["y"], step["side"]) for step in run.steps],
            )
            times = [float(begin) for *_, begin in shown]
            self.assertEqual(times, sorted(set(times)))
            jobs = [color for color, *_ in shown if color == "#a9dcae"]
            self.assertEqual(len(jobs), (run.steps["kind"] == 2).sum())

    def test_details_fill_what_is_covered(self):
        for method in self.methods.values():
            run, window = self.runner.run(method.command, 1), method.detail
            part = run.fragments[
                :, window.y : window.y + window.height, window.x : window.x + window.width
            ]
            text = (self.docs / "images/gallery" / method.detail_file).read_text()
            filled = re.search(r'<path stroke="#101418"[^>]* d="([^"]*)"', text)[1]
            self.assertEqual(filled.count("M"), (part > 0).sum(), method.id)
            hollow = re.search(r'<path stroke="#fff"[^>]* d="([^"]*)"', text)[1]
            self.assertEqual(hollow.count("M"), (part == 0).sum(), method.id)

    def test_samples_in_another_place_are_found(self):
        run = self.runner.run(self.methods["samples_2"].command, 1)
        pattern.check(run)
        run.stats["config"]["raster.sample_positions"] = "12,12;4,5"
        with self.assertRaises(ValueError):
            pattern.check(run)
        run.stats["config"]["raster.sample_positions"] = "standard"


if __name__ == "__main__":
    PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
