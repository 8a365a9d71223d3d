#!/usr/bin/env python3
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""Builds church.obj, the sample solid: a small church, in metres of a table-top model, y up. Usage: samples/build_church.py > samples/church.obj"""
import math

vertices, faces = [], []


def solid(rings, close_top=True):
    """A closed body of rings of points, from below to above, each counter-clockwise as seen from above."""
    base = len(vertices)
    n = len(rings[0])
    for ring in rings:
        vertices.extend(ring)
    faces.append([base + k for k in reversed(range(n))])
    for level in range(len(rings) - 1):
        a, b = base + level * n, base + (level + 1) * n
        for k in range(n):
            m = (k + 1) % n
            faces.append([a + k, a + m, b + m])
            faces.append([a + k, b + m, b + k])
    if close_top:
        faces.append([base + (len(rings) - 1) * n + k for k in range(n)])


def rectangle(x0, x1, z0, z1, y):
    return [(x0, y, z1), (x1, y, z1), (x1, y, z0), (x0, y, z0)]


def circle(x, z, radius, y, parts=24):
    return [(x + radius * math.sin(2 * math.pi * k / parts), y, z + radius * math.cos(2 * math.pi * k / parts)) for k in range(parts)]


solid([rectangle(-0.046, 0.050, -0.022, 0.022, 0.000), rectangle(-0.046, 0.050, -0.022, 0.022, 0.003)])  # the ground
solid([rectangle(-0.020, 0.034, -0.013, 0.013, 0.002), rectangle(-0.020, 0.034, -0.013, 0.013, 0.024),
       rectangle(-0.020, 0.034, -0.0004, 0.0004, 0.038)])  # the nave and its roof
solid([rectangle(-0.040, -0.018, -0.011, 0.011, 0.002), rectangle(-0.040, -0.018, -0.011, 0.011, 0.046),
       rectangle(-0.0294, -0.0286, -0.0004, 0.0004, 0.080)])  # the tower and its spire
solid([circle(0.034, 0.0, 0.010, 0.002), circle(0.034, 0.0, 0.010, 0.018), circle(0.034, 0.0, 0.0005, 0.027)])  # the apse
solid([rectangle(0.002, 0.014, 0.012, 0.019, 0.002), rectangle(0.002, 0.014, 0.012, 0.019, 0.014),
       rectangle(0.0076, 0.0084, 0.012, 0.019, 0.019)])  # the porch

print("# A small church: palpable's sample of a solid (samples/build_church.py). Metres, y up.")
for x, y, z in vertices:
    print(f"v {x:.4f} {y - 0.04:.4f} {z:.4f}")  # the middle of the model is the origin
for face in faces:
    print("f " + " ".join(str(k + 1) for k in face))
