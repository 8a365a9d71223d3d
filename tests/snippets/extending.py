# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""extending.py SOURCE COMPILER CMAKE: applies the worked example of docs/extending.md to a copy of what it changes, compiles and runs it,
and checks the copy's layers."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

PROGRAM = """
#include "palpable/device/drivers/open.hpp"
#include <cstdio>
using namespace palpable;
int main() {
  auto device = device::open_device("still:?z=0.002", {});
  if (!device) return std::puts(device.error().sentence().c_str()), 1;
  const auto reading = (*device)->read();
  for (const auto& kind : device::list_devices())
    if (kind.url == "still:") return reading.position.v.z == 0.002 ? 0 : 2;
  return 3;
}
"""

# Sources of core that are linked into test programs alone.
OTHER_PROGRAMS = ("allocation_counter", "test_folder")


def main() -> None:
    source, compiler, cmake = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3]
    text = (source / "docs/extending.md").read_text(encoding="utf-8")
    diffs = re.findall(r"^```diff\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)
    if len(diffs) != 1:
        sys.exit("docs/extending.md must hold one diff")
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder)
        for part in ("cmake", "src"):
            shutil.copytree(source / part, copy / part)
        (copy / "docs").mkdir()
        shutil.copy(source / "docs/architecture.md", copy / "docs")
        subprocess.run(["git", "apply", "-"], input=diffs[0], text=True, cwd=copy, check=True)
        subprocess.run([cmake, f"-DSOURCE={copy}", "-P", copy / "cmake/CheckLayers.cmake"], check=True)
        subprocess.run([cmake, f"-DDOCUMENT={copy}/docs/architecture.md", "-P", copy / "cmake/CheckArchitecture.cmake"], check=True)
        # What the copy's list of sources names, and what it uses of core, as one file: headers are compiled once.
        listed = re.search(r"SOURCES(.*?)TESTS", (copy / "src/palpable/device/CMakeLists.txt").read_text(encoding="utf-8"), re.DOTALL)
        sources = [copy / "src/palpable/device" / name for name in listed.group(1).split()]
        sources += [path for path in (copy / "src/palpable/core").rglob("*.cpp") if not path.stem.endswith("_test") and path.stem not in OTHER_PROGRAMS]
        whole = "".join(f'#include "{path.relative_to(copy / "src")}"\n' for path in sources)
        (copy / "main.cpp").write_text(whole + PROGRAM, encoding="utf-8")
        program = copy / "program"
        # Relative names: a compiler cache then knows what it compiled in another folder.
        cache = shutil.which("ccache")
        compile_it = [*([cache] if cache else []), compiler, "-std=c++20", "-O0", "-Isrc", "-DPALPABLE_LIBRARY_HOST_FOLDER=\"\"", "-c", "main.cpp", "-o", "main.o"]
        subprocess.run(compile_it, check=True, cwd=copy)
        subprocess.run([compiler, "main.o", "-pthread", "-lz", "-lusb-1.0", "-o", program], check=True, cwd=copy)
        subprocess.run([program], check=True)


main()
