#!/usr/bin/env python3
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""Fails and lists the differences if docs/dependencies.md does not list exactly the shared libraries that the programs load, as
shown by ldd: linked_libraries.py PROGRAM...; --write as the first argument writes the lists. Only on Debian 12, to which they apply."""
import re
import subprocess
import sys
from pathlib import Path

DOCUMENT = Path("docs/dependencies.md")
END = "\n<!-- end of the list -->"
SKIPPED = 77
# The package that provides BLAS and LAPACK, and the libraries that it loads, differ between machines.
BLAS = {"libatlas", "libblas", "libcblas", "libf77blas", "libgfortran", "liblapack", "libopenblas", "libquadmath"}


def loaded(program):
    text = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
    found = {re.sub(r"(-[\d.]+)?\.so.*", "", Path(line.split()[0]).name) for line in text.splitlines() if line.strip()} - BLAS
    if len(found) < 3:
        sys.exit(f"ldd lists only {len(found)} libraries of {program}: nothing was checked")
    return found


write = sys.argv[1] == "--write"
release = Path("/etc/os-release").read_text()
if "ID=debian" not in release or 'VERSION_ID="12"' not in release:
    print("skipped: the lists are those of Debian 12")
    sys.exit(SKIPPED)
wrong = []
for program in sys.argv[2 if write else 1:]:
    name, libraries = Path(program).name, loaded(program)
    before, begin, rest = DOCUMENT.read_text().partition(f"<!-- ldd {name} -->\n")
    listed, _, after = rest.partition(END)
    if write:
        DOCUMENT.write_text(before + begin + ", ".join(f"`{library}`" for library in sorted(libraries)) + "." + END + after)
        continue
    documented = set(re.findall(r"`([^`]+)`", listed))
    wrong += [f"{name} loads {library}, which docs/dependencies.md does not list" for library in sorted(libraries - documented)]
    wrong += [f"docs/dependencies.md lists {library}, which {name} does not load" for library in sorted(documented - libraries)]
if wrong:
    sys.exit("\n".join(wrong))
