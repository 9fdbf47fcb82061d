#!/usr/bin/env python3
"""Compares which triangles cover each pixel in two results of `halfspace run --quads`, pixel by pixel, and draws it.

    tools/coverage_difference.py A B OUT.png [--surface S] [--crop X,Y,W,H] [--scale N]

Red: B covers the pixel fewer times than A; blue: more often; yellow: as often, but by other triangles. Grey: the same.
Prints how many there are of each in the whole surface.
"""

import argparse
import collections
import json
import pathlib
import struct
import zlib

RECORD = struct.Struct("<5I2B4IQ")  # quads.npy: docs/guides/results.md
FEWER, MORE, OTHER = (220, 40, 40), (50, 90, 255), (250, 200, 0)


def quads(folder, surface):
    """The records of a surface: (draw, triangle, x, y, mask)."""
    data = (folder / "quads.npy").read_bytes()
    begin = 10 + struct.unpack_from("<H", data, 8)[0]
    for draw, triangle, on, x, y, mask, *_ in RECORD.iter_unpack(memoryview(data)[begin:]):
        if on == surface:
            yield draw, triangle, x, y, mask


def covered_by(folder, surface):
    """For each pixel the triangles that cover it."""
    pixels = collections.defaultdict(list)
    for draw, triangle, x, y, mask in quads(folder, surface):
        for i in range(4):
            if mask >> i & 1:
                pixels[x + i % 2, y + i // 2].append((draw, triangle))
    return pixels


def write_png(path, width, height, pixel):
    """An RGB picture of pixel(x, y)."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + b"".join(bytes(pixel(x, y)) for x in range(width)) for y in range(height))
    header = struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("a", type=pathlib.Path, metavar="A")
    parser.add_argument("b", type=pathlib.Path, metavar="B")
    parser.add_argument("out", type=pathlib.Path, metavar="OUT.png")
    parser.add_argument("--surface", type=int, default=0)
    parser.add_argument("--crop", help="X,Y,W,H in pixels (default: all)")
    parser.add_argument("--scale", type=int, default=1, help="pixels of the picture for each pixel")
    options = parser.parse_args()
    surface = json.loads((options.a / "stats.json").read_text(encoding="utf-8-sig"))["surfaces"][options.surface]
    whole = (0, 0, surface["width"], surface["height"])
    left, top, width, height = map(int, options.crop.split(",")) if options.crop else whole

    ours = covered_by(options.a, options.surface)
    theirs = covered_by(options.b, options.surface)
    color = {}
    for at in ours.keys() | theirs.keys():
        a, b = ours.get(at, []), theirs.get(at, [])
        if len(a) != len(b):
            color[at] = FEWER if len(b) < len(a) else MORE
        elif sorted(a) != sorted(b):
            color[at] = OTHER
    found = collections.Counter(color.values())
    print(f"{found[FEWER]} pixels fewer times, {found[MORE]} more often, {found[OTHER]} by other triangles")

    def pixel(x, y):
        at = left + x // options.scale, top + y // options.scale
        if at in color:
            return color[at]
        if not ours.get(at):
            return (24, 26, 32)
        # Grey by the first triangle, so that neighbours can be told apart.
        return (90 + ours[at][0][1] * 37 % 64,) * 3

    write_png(options.out, width * options.scale, height * options.scale, pixel)


if __name__ == "__main__":
    main()
