# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""Draws values over time as an SVG: one panel per group of columns, each axis starting at zero."""
import math

WIDTH, PANEL, LEFT, TOP = 900, 150, 70, 34
COLOURS = ("#1b5e9b", "#c04a00", "#3d7a1f")


def step_of(most):
    """At most five steps to `most`, each 1, 2 or 5 times a power of ten."""
    power = 10.0 ** math.floor(math.log10(most / 5))
    return next(power * factor for factor in (1, 2, 5, 10) if 5 * power * factor >= most)


def panel(y, columns, rows, end_s):
    most = max((row[c] for row in rows for c in columns.values()), default=0) or 1
    least = min(0, min((row[c] for row in rows for c in columns.values()), default=0))
    step = step_of(most - least)
    most = step * math.ceil(most / step)
    x_of = lambda t: LEFT + (WIDTH - LEFT - 20) * t / end_s
    y_of = lambda v: y + PANEL - (PANEL - TOP) * (v - least) / (most - least)
    out = []
    for k in range(math.ceil(least / step), math.floor(most / step + 1e-6) + 1):
        y_k = y_of(k * step)
        out.append(f'<line x1="{LEFT}" x2="{WIDTH - 20}" y1="{y_k:.1f}" y2="{y_k:.1f}" stroke="#ccc"/>'
                   f'<text x="{LEFT - 6}" y="{y_k + 4:.1f}" text-anchor="end">{k * step:g}</text>')
    at = LEFT
    for (name, column), colour in zip(columns.items(), COLOURS):
        points = " ".join(f"{x_of(row['t_s']):.1f},{y_of(row[column]):.1f}" for row in rows)
        out.append(f'<polyline fill="none" stroke="{colour}" stroke-width="1.5" points="{points}"/>'
                   f'<text x="{at}" y="{y + TOP - 10}" fill="{colour}">{name}</text>')
        at += 9 * len(name)
    return "".join(out)


def write_chart(path, heading, panels, rows):
    """`panels`: the columns of each panel by name; `rows`: dicts with t_s and the columns."""
    end_s = max(rows[-1]["t_s"], 1e-9)
    height = TOP + len(panels) * PANEL + 40
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" font-family="sans-serif" font-size="13">'
           f'<rect width="100%" height="100%" fill="white"/><text x="{LEFT}" y="20" font-size="15">{heading}</text>']
    for k, columns in enumerate(panels):
        out.append(panel(TOP + k * PANEL, columns, rows, end_s))
    minutes = end_s / 60
    step = step_of(minutes)
    for k in range(math.floor(minutes / step + 1e-6) + 1):
        x = LEFT + (WIDTH - LEFT - 20) * k * step / minutes
        out.append(f'<text x="{x:.1f}" y="{height - 16}" text-anchor="middle">{k * step:g} min</text>')
    path.write_text("".join(out) + "</svg>\n")
