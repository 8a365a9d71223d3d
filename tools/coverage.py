# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""Sums gcov's JSON reports into covered lines per module: coverage.py REPORT.gcov.json.gz…"""
import collections
import gzip
import json
import re
import sys

run = collections.defaultdict(dict)  # file -> line -> was it run in any report
for path in sys.argv[1:]:
    with gzip.open(path) as report:
        for file in json.load(report)["files"]:
            found = re.search(r"src/palpable/(.+)$", file["file"])
            if not found or found[1].endswith("_test.cpp"):
                continue
            for line in file["lines"]:
                lines = run[found[1]]
                lines[line["line_number"]] = lines.get(line["line_number"], False) or line["count"] > 0

modules = collections.defaultdict(lambda: [0, 0])
for file, lines in run.items():
    for name in (file.split("/")[0], "all"):
        modules[name][0] += sum(lines.values())
        modules[name][1] += len(lines)
for name, (covered, total) in sorted(modules.items(), key=lambda m: (m[0] == "all", m[0])):
    print(f"{name:10} {covered:6} of {total:6} lines  {100 * covered / total:5.1f} %")
