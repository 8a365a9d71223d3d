#!/usr/bin/env python3
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""Draws town.osm, the sample map: a small town that does not exist. Usage: samples/draw_town.py > samples/town.osm"""
import math
import sys
from xml.sax.saxutils import quoteattr

LATITUDE, LONGITUDE = 50.0, -30.0  # in the Atlantic
METRES_PER_DEGREE = 111195.0

nodes, ways, named = [], [], {}


def node(x, y, **tags):
    """A node at metres east and north of the middle; the same place is the same node."""
    key = (round(x, 2), round(y, 2))
    if key not in named:
        named[key] = len(nodes) + 1
        nodes.append([key, {}])
    nodes[named[key] - 1][1].update(tags)
    return named[key]


def way(points, **tags):
    ways.append(([node(x, y) for x, y in points], tags))


def area(points, **tags):
    way(points + points[:1], **tags)


def box(x, y, width, height, **tags):
    a, b = width / 2, height / 2
    area([(x - a, y - b), (x + a, y - b), (x + a, y + b), (x - a, y + b)], **tags)


def ring(x, y, radius, parts):
    return [(x + radius * math.cos(2 * math.pi * k / parts), y + radius * math.sin(2 * math.pi * k / parts))
            for k in range(parts)]


# Streets. The roundabout is at 60, 0.
circle = ring(60, 0, 15, 16)
area(circle, highway="secondary", junction="roundabout", name="Clock Circle")
east, north, west, south = circle[0], circle[4], circle[8], circle[12]
way([(-170, -4), (-110, 0), (-75, 2), (-20, 4), west], highway="secondary", name="High Street")
way([east, (125, -4), (170, -12)], highway="secondary", name="High Street")
way([north, (64, 60), (65, 88), (60, 170)], highway="tertiary", name="Station Road")
way([south, (54, -50), (50, -80), (52, -112), (56, -170)], highway="tertiary", name="Mill Lane")
way([(-75, 2), (-80, 45), (-78, 72), (-70, 170)], highway="residential", name="Church Lane")
way([(-78, 72), (-40, 78), (0, 82), (65, 88)], highway="residential", name="Market Street")
way([(0, 82), (-3, 128)], highway="residential", name="Garden Close")
way([(-170, -92), (-90, -86), (-20, -84), (50, -80)], highway="pedestrian", name="River Walk")
way([(125, -4), (128, -60), (116, -106), (52, -112)], highway="residential", name="School Lane")
way([(-20, 4), (-22, -40), (-20, -84)], highway="steps", name="Ferry Steps")

# Special buildings, and others.
box(-40, 44, 26, 16, building="church", amenity="place_of_worship", name="St Anne's Church")
node(-27, 44, entrance="main")
box(105, 126, 46, 18, building="train_station", railway="station", name="Oldbridge Station")
node(82, 126, entrance="main")
box(-122, 64, 40, 34, building="yes", amenity="hospital", name="Oldbridge Hospital")
box(92, -60, 32, 26, building="yes", amenity="school", name="Mill School")
box(14, 40, 24, 20, building="yes", amenity="townhall", name="Town Hall")
for x, y, width, height in [(-140, 22, 24, 18), (-105, 22, 20, 14), (-50, 22, 0, 0), (100, 30, 40, 30),
                            (140, 40, 24, 40), (110, 80, 40, 24), (30, 120, 34, 30), (-45, 120, 40, 40),
                            (-120, 130, 40, 50), (-60, -40, 40, 36), (15, -40, 36, 40), (92, -28, 30, 14),
                            (150, -50, 20, 50), (-4, 20, 0, 0), (90, -140, 0, 0)]:
    if width:
        box(x, y, width, height, building="yes")

# A river under the bridge of Mill Lane, and a park.
area([(-175, -118), (-60, -114), (40, -132), (170, -134), (170, -160), (40, -158), (-60, -140), (-175, -144)],
     natural="water", name="Old River")
area([(-160, -20), (-90, -16), (-92, -70), (-160, -76)], leisure="park", name="Ferry Park")

# For people on foot.
node(-120, 6, highway="bus_stop", name="Ferry Park")
node(100, -8, highway="bus_stop", name="Clock Circle")
node(68, 120, highway="bus_stop", name="Oldbridge Station")
for x, y, paving in [(-52, 2.8364, "yes"), (92, 0, "yes"), (64, 48, "no"), (-78, 20, "no"), (54.5, -43, "yes")]:
    node(x, y, highway="crossing", tactile_paving=paving)

out = ['<?xml version="1.0" encoding="UTF-8"?>', '<osm version="0.6" generator="samples/draw_town.py">']
shrink = math.cos(math.radians(LATITUDE))
for number, ((x, y), tags) in enumerate(nodes, 1):
    lat, lon = LATITUDE + y / METRES_PER_DEGREE, LONGITUDE + x / METRES_PER_DEGREE / shrink
    head = f'<node id="{number}" version="1" lat="{lat:.7f}" lon="{lon:.7f}"'
    inner = "".join(f"<tag k={quoteattr(k)} v={quoteattr(v)}/>" for k, v in sorted(tags.items()))
    out.append(f"{head}>{inner}</node>" if inner else f"{head}/>")
for number, (refs, tags) in enumerate(ways, 1001):
    inner = "".join(f'<nd ref="{r}"/>' for r in refs)
    inner += "".join(f"<tag k={quoteattr(k)} v={quoteattr(v)}/>" for k, v in sorted(tags.items()))
    out.append(f'<way id="{number}" version="1">{inner}</way>')
out.append("</osm>")
sys.stdout.write("\n".join(out) + "\n")
