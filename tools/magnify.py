#!/usr/bin/env python3
"""Joins a part of pictures, magnified, side by side: magnify.py X,Y,WIDTHxHEIGHT TIMES OUT.png IN.png ...

Reads and writes PNG files of 8 bits a channel, RGB or grey, without other packages.
"""

import pathlib
import struct
import sys
import zlib


def read_png(path: pathlib.Path) -> tuple[int, int, int, list[bytes]]:
    """Width, height, channels and rows."""
    data = path.read_bytes()
    at, packed = 8, b""
    width = height = channels = 0
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at : at + 8])
        body = data[at + 8 : at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack(">IIBB", body[:10])
            channels = {0: 1, 2: 3, 6: 4}[color]
            if depth != 8:
                sys.exit(f"{path}: {depth} bits a channel; legal: 8")
        packed += body if kind == b"IDAT" else b""
        at += 12 + size
    raw = zlib.decompress(packed)
    stride = width * channels
    rows: list[bytes] = []
    before = bytes(stride)
    for y in range(height):
        line = raw[y * (stride + 1) : (y + 1) * (stride + 1)]
        row = bytearray(line[1:])
        for i in range(stride):
            left = row[i - channels] if i >= channels else 0
            up = before[i]
            corner = before[i - channels] if i >= channels else 0
            row[i] = (row[i] + predict(line[0], left, up, corner)) & 255
        before = bytes(row)
        rows.append(before)
    return width, height, channels, rows


def predict(kind: int, left: int, up: int, corner: int) -> int:
    """The PNG filter of that number."""
    if kind == 4:
        guess = left + up - corner
        return min((left, up, corner), key=lambda value: abs(guess - value))
    return (0, left, up, (left + up) // 2)[kind]


def main() -> None:
    if len(sys.argv) < 5:
        sys.exit(__doc__)
    x, y, size = sys.argv[1].split(",")
    width, height = (int(n) for n in size.split("x"))
    times = int(sys.argv[2])
    strips: list[bytearray] = [bytearray() for _ in range(height * times)]
    for number, name in enumerate(sys.argv[4:]):
        _, _, channels, rows = read_png(pathlib.Path(name))
        for j in range(height):
            row = bytearray(b"\xff" * (3 * times) if number else b"")
            for i in range(width):
                at = (int(x) + i) * channels
                pixel = rows[int(y) + j][at : at + channels]
                row += (pixel * 3 if channels == 1 else pixel[:3]) * times
            for k in range(times):
                strips[j * times + k] += row
    raw = b"".join(b"\0" + bytes(strip) for strip in strips)
    header = struct.pack(">IIBBBBB", len(strips[0]) // 3, len(strips), 8, 2, 0, 0, 0)
    out = b"\x89PNG\r\n\x1a\n"
    for kind, body in ((b"IHDR", header), (b"IDAT", zlib.compress(raw, 9)), (b"IEND", b"")):
        out += struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    pathlib.Path(sys.argv[3]).write_bytes(out)


if __name__ == "__main__":
    main()
