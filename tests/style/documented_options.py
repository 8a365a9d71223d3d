#!/usr/bin/env python3
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""Fails and lists the options that the documents name and no command has: tests/style/documented_options.py PROGRAM, run in the root
folder. Options of other programs in the documents are listed here."""
import re
import subprocess
import sys
from pathlib import Path

OPTION = r"(?<![\w-])--[a-z][a-z0-9-]*"
# Lines about other programs.
OTHERS = re.compile(r"cmake |pkg-config |diff --git|palpable_(stereo|video)_set|tools/|fuzz/|\./(test|run)|--table|--write FOLDER")


def help_of(*command):
    return subprocess.run([sys.argv[1], "help", *command], capture_output=True, text=True, check=True).stdout


def options_of(*command):
    """The options of a command and of the commands below it."""
    text = help_of(*command)
    below = re.search(r"^Commands:\n((?:  .*\n)+)", text, re.M)
    names = re.findall(r"^  ([a-z][a-z-]*) ", below[1], re.M) if below and command else []
    return set(re.findall(OPTION, text)).union(*(options_of(*command, name) for name in names))


commands = re.findall(r"^  ([a-z][a-z-]*) ", help_of(), re.M)
known = set(re.findall(OPTION, help_of())).union(*(options_of(command) for command in commands if command != "help"))
assert len(commands) > 10 and "--law" in known, "the help texts could not be read"
wrong = [
    f"{file}:{number}: no command has {option}"
    for file in [Path("README.md"), *sorted(Path("docs").glob("*.md"))]
    for number, line in enumerate(file.read_text().splitlines(), 1)
    if not OTHERS.search(line)
    for option in re.findall(OPTION, line)
    if option not in known
]
print("\n".join(wrong))
sys.exit(1 if wrong else 0)
