#!/usr/bin/env python3
"""Writes a mesh that tiles a square without gap or overlap, as OBJ: a grid of squares, each cut in two, whose inner
corners are moved at random. What a rasterizer draws of it more than once, or not at all, is wrong.

    tools/jittered_mesh.py CELLS OUT.obj    # CELLS x CELLS squares, -1 to 1 in x and z, y = 0
"""

import random
import sys


def main():
    if len(sys.argv) != 3 or not sys.argv[1].isdigit() or int(sys.argv[1]) == 0:
        sys.exit("usage: jittered_mesh.py CELLS OUT.obj, with CELLS 1 or more")
    cells = int(sys.argv[1])
    choose = random.Random(1)
    lines = []
    for j in range(cells + 1):
        for i in range(cells + 1):
            inner = 0 < i < cells and 0 < j < cells
            x, z = (n + (choose.uniform(-0.25, 0.25) if inner else 0) for n in (i, j))
            lines.append(f"v {2 * x / cells - 1:.9f} 0 {2 * z / cells - 1:.9f}")
    for j in range(cells):
        for i in range(cells):
            a = j * (cells + 1) + i + 1
            b, c, d = a + 1, a + cells + 1, a + cells + 2
            rising = choose.random() < 0.5
            for face in ((a, b, c), (b, d, c)) if rising else ((a, b, d), (a, d, c)):
                lines.append("f {} {} {}".format(*face))
    with open(sys.argv[2], "w", encoding="ascii") as out:
        out.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
