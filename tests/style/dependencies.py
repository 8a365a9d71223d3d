#!/usr/bin/env python3
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""Fails and lists the differences if docs/dependencies.md and packages/*.txt do not list the same Debian packages, if CMake
searches for a library that no source includes, or if the modules that include a library differ from the document. Run in the root folder."""
import re
import subprocess
import sys
from pathlib import Path


def expanded(name):
    braces = re.search(r"\{([^}]*)\}", name)
    return [name[: braces.start()] + part + name[braces.end() :] for part in braces[1].split(",")] if braces else [name]


installed = {
    line.strip() for file in Path("packages").glob("*.txt") for line in file.read_text().splitlines() if line.strip() and line[0] != "#"
}
# The first column of every table; libnanovdb-dev is optional.
cells = re.findall(r"^\| ([^|]+?) \|", Path("docs/dependencies.md").read_text(), re.M)
documented = {
    name for cell in cells for word in re.findall(r"[a-z0-9][a-z0-9.+{},-]*", re.sub(r" \d[\d.]*", "", cell)) for name in expanded(word.strip(","))
}
wrong = [f"packages/: {name} is not in docs/dependencies.md" for name in sorted(installed - documented)]
optional = {"libnanovdb-dev"}
wrong += [
    f"docs/dependencies.md: {name} is in no list of packages/"
    for name in sorted(documented - installed - optional)
    if re.fullmatch(r"lib[a-z0-9.+-]*-dev|[a-z0-9]+-[a-z]+-ng", name)
]

# A header of each library that CMake finds for the program itself.
headers = {"assimp": "assimp/", "libblosc": "openvdb/", "libboost": "boost/", "libcairo2": "cairo", "libceres": "ceres/", "libcli11": "CLI/",
           "libeigen3": "Eigen/", "libfmt": "fmt/", "libavcodec": "libavcodec/", "libavformat": "libavformat/", "libavutil": "libavutil/", "libheif": "libheif/", "libjpeg": "jpeglib.h", "libopenexr": "Imf", "libopenvdb": "openvdb/", "libosmium2": "osmium/",
           "libpango1.0": "pango/", "libpng": "png.h", "libqrencode": "qrencode.h", "libspeechd": "libspeechd.h", "libssl": "openssl/", "libswscale": "libswscale/", "libtiff": "tiffio.h", "libusb-1.0-0": "libusb-1.0/", "libwebp": "webp/", "libzip": "zip.h",
           "libzstd": "zstd", "nlohmann-json3": "nlohmann/", "zlib1g": "zlib.h", "libassimp": "assimp/"}
parts = re.findall(r"^libopencv-([a-z0-9]+)-dev$", Path("packages/build.txt").read_text(), re.M)
headers |= {f"libopencv-{part}": f"opencv2/{part}" for part in parts}
sources = subprocess.run(["git", "grep", "-hoE", "#include <[^>]+>", "--", "src"], capture_output=True, text=True).stdout
for line in Path("packages/build.txt").read_text().splitlines():
    name = line.removesuffix("-dev")
    if line.endswith("-dev") and name not in headers:
        wrong.append(f"tests/style/dependencies.py: {line} has no header to look for")
    elif name in headers and f"<{headers[name]}" not in sources:
        wrong.append(f"packages/build.txt: no source includes <{headers[name]}…>, so {line} is not needed")

# The column "modules" of the first table.
def modules_including(header):
    files = subprocess.run(["git", "grep", "-lF", f"<{header}", "--", "src/palpable"], capture_output=True, text=True).stdout.split()
    return {file.split("/")[2] for file in files if not file.endswith("_test.cpp")}


for cell, modules in re.findall(r"^\| ([^|]+?) \| [^|]+ \| ([a-z, ]+) \| [^|]+ \|$", Path("docs/dependencies.md").read_text(), re.M):
    names = {name.removesuffix("-dev") for word in re.findall(r"[a-z0-9][a-z0-9.+{},-]*", cell) for name in expanded(word.strip(","))}
    users = set().union(*(modules_including(headers[name]) for name in names & set(headers)))
    if users and users != set(modules.split(", ")):
        wrong.append(f"docs/dependencies.md: {cell} is included by {', '.join(sorted(users))}, not by {modules}")
if wrong:
    sys.exit("\n".join(wrong))
