#!/usr/bin/env python3
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""Fails and lists the places where a sentence outside cli names an option of the command line: the library and the page
state a fact and its Reason (core/reason.hpp), and the command line names the option (cli/hints.cpp). Run in the root
folder. A literal that is one option alone is an argument for another program."""
import re
import sys
from pathlib import Path

root = Path("src/palpable")
literal = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
named = re.compile(r"(?:^|[\s(])--[a-z]")
wrong = []
for source in sorted(root.rglob("*.[ch]pp")):
    if source.parts[2] == "cli" or source.name.endswith("_test.cpp") or source.name.startswith("test_"):
        continue
    for number, line in enumerate(source.read_text().splitlines(), 1):
        code = line.split("//")[0]
        for text in literal.findall(code):
            if named.search(text) and not re.fullmatch(r"--[a-z-]+", text):
                wrong.append(f"{source}:{number}: {text}")
if wrong:
    sys.exit("\n".join(wrong))
