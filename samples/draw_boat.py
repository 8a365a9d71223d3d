#!/usr/bin/env python3
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""Draws boat.png, the sample drawing: a sailing boat in black ink on white paper. Usage: samples/draw_boat.py samples/boat.png"""
import math
import struct
import sys
import zlib

SIDE = 480  # pixels
INK = 3.0  # half the width of a line, pixels


def curve(points, parts=24):
    """A smooth line through points (Catmull-Rom)."""
    padded = [points[0]] + points + [points[-1]]
    line = []
    for a, b, c, d in zip(padded, padded[1:], padded[2:], padded[3:]):
        for k in range(parts):
            t = k / parts
            line.append(tuple(0.5 * (2 * q + (r - p) * t + (2 * p - 5 * q + 4 * r - s) * t * t + (3 * q - p - 3 * r + s) * t ** 3)
                              for p, q, r, s in zip(a, b, c, d)))
    return line + [points[-1]]


def ring(x, y, radius, parts=72):
    return [(x + radius * math.cos(2 * math.pi * k / parts), y + radius * math.sin(2 * math.pi * k / parts))
            for k in range(parts + 1)]


lines = [
    # The hull.
    [(90, 330), (390, 330)] + curve([(390, 330), (362, 372), (330, 392)])[1:] + [(150, 392)] + curve([(150, 392), (116, 372), (90, 330)])[1:],
    # The mast, the main sail and the jib.
    [(235, 330), (235, 70)],
    curve([(249, 84), (318, 180), (360, 300)]) + [(249, 300), (249, 84)],
    curve([(221, 110), (170, 190), (112, 300)]) + [(221, 300), (221, 110)],
    # The sun, and the sea.
    ring(405, 90, 38),
    curve([(20, 430), (65, 415), (110, 430), (155, 445), (200, 430), (245, 415), (290, 430), (335, 445), (380, 430), (425, 415), (460, 430)]),
]


def distance_to_segment(x, y, a, b):
    dx, dy = b[0] - a[0], b[1] - a[1]
    length = dx * dx + dy * dy
    t = 0.0 if length == 0 else max(0.0, min(1.0, ((x - a[0]) * dx + (y - a[1]) * dy) / length))
    return math.hypot(x - a[0] - t * dx, y - a[1] - t * dy)


rows = [bytearray([255] * SIDE) for _ in range(SIDE)]
for line in lines:
    for a, b in zip(line, line[1:]):
        reach = INK + 1
        for y in range(max(0, int(min(a[1], b[1]) - reach)), min(SIDE, int(max(a[1], b[1]) + reach) + 1)):
            for x in range(max(0, int(min(a[0], b[0]) - reach)), min(SIDE, int(max(a[0], b[0]) + reach) + 1)):
                ink = max(0.0, min(1.0, INK + 0.5 - distance_to_segment(x, y, a, b)))
                rows[y][x] = min(rows[y][x], round(255 - 225 * ink))


def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


with open(sys.argv[1], "wb") as file:
    file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", SIDE, SIDE, 8, 0, 0, 0, 0))
               + chunk(b"IDAT", zlib.compress(b"".join(b"\0" + bytes(row) for row in rows), 9)) + chunk(b"IEND", b""))
