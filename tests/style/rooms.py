#!/usr/bin/env python3
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""Fails and lists the errors if the README of a room names an entry header that does not exist, or a user (after "Used by:") that
does not include the room. Run in the root folder."""
import re
import sys
from pathlib import Path

root = Path("src/palpable")


def includes(folder):
    for source in folder.rglob("*.[ch]pp"):
        yield from re.findall(r'#include "palpable/([^"]+)/[^/"]+"', source.read_text())


wrong = []
for readme in sorted(root.rglob("README.md")):
    room = readme.parent
    text = readme.read_text()
    wrong += [
        f"{readme}: there is no {header}" for header in re.findall(r"`([\w/]+\.hpp)`", text) if not (room / header).exists()
    ]
    users = re.search(r"^Used by: (.*?)\.$", text, re.M | re.S)
    for user in re.findall(r"[a-z_]+(?:/[a-z_]+)*", users[1]) if users else []:
        # "sculpt/solid, field" means sculpt/field.
        folder = next((f for f in (root / user, room.parent / user) if f.is_dir()), None)
        if folder and str(room.relative_to(root)) not in includes(folder):
            wrong.append(f"{readme}: {folder.relative_to(root)} does not use it")
if wrong:
    sys.exit("\n".join(wrong))
