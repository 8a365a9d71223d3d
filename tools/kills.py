#!/usr/bin/env python3
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""Kills the program (SIGKILL) at random instants while it writes: tools/kills.py PROGRAM [--count N] [--seed S].

N runs alternate between `make`, `export`, `correct`, a recording, and saving on the page; each replaces an existing file. Half of the
runs are killed at a random instant, uniformly distributed over the duration of a complete run; the others, and the page, while they
write: mostly at once, at most 10 ms (page: 100 ms, in which it saves again and again) after the first change in the folder of the
output. Afterwards the file must be complete: a scene or an export equals the old or the new bytes, and `palpable check` can read a
recording. Then the run is repeated without a kill; after it, the folder must contain no other file. Prints the violations and the
counts; --minutes limits the time."""
import argparse
import collections
import contextlib
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "soak"))
from page_client import PageClient, let_in

WRITING_S = 0.01
QUIET = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "stdin": subprocess.DEVNULL}


def write_mesh(path, size_m):
    corners = [(x, y, z) for x in (0, size_m) for y in (0, size_m) for z in (0, 0.02)]
    faces = [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)]
    path.write_text("".join("v %g %g %g\n" % c for c in corners) + "".join("f %d %d %d %d\n" % f for f in faces))


class Case:
    """A command that writes `output` in its own folder, where it replaces a file with the content of `old`."""

    def __init__(self, name, folder, output, command, old):
        self.name, self.folder, self.command, self.old = name, folder, command, old
        self.output = folder / output
        folder.mkdir()
        self.output.write_bytes(old)
        begin = time.monotonic()
        subprocess.run(self.command, check=True, **QUIET)
        self.whole_s = time.monotonic() - begin
        self.new = self.output.read_bytes()

    def kill(self, rng):
        self.output.write_bytes(self.old)
        before = self.listing()
        process = subprocess.Popen(self.command, **QUIET)
        if rng.random() < 0.5:
            time.sleep(rng.random() * 1.05 * self.whole_s)
        else:
            while self.listing() == before and process.poll() is None:
                pass
            end = time.monotonic() + rng.random() ** 3 * WRITING_S
            while time.monotonic() < end:
                pass
        process.kill()
        process.wait()
        return self.kept()

    def listing(self):
        """Changes whenever a file of the folder is made, written or replaced."""
        found = set()
        for entry in os.scandir(self.folder):
            with contextlib.suppress(FileNotFoundError):
                state = entry.stat()
                found.add((entry.name, state.st_ino, state.st_size, state.st_mtime_ns))
        return found

    def kept(self):
        """The state of the file: old, new, or the reason why it is neither."""
        found = self.output.read_bytes() if self.output.exists() else None
        return "old" if found == self.old else "new" if found == self.new else "neither"

    def left_over(self):
        """Other files in the folder after a complete run."""
        begin = time.monotonic()
        subprocess.run(self.command, check=True, **QUIET)
        # The load of the machine changes.
        self.whole_s = time.monotonic() - begin
        return [entry.name for entry in self.folder.iterdir() if entry != self.output]


class Recording(Case):
    """A recording in progress is a new file; its written part must be readable."""

    def __init__(self, program, name, folder, output, command, old):
        self.program = program
        super().__init__(name, folder, output, command, old)

    def kept(self):
        if self.output.read_bytes() == self.old:
            return "old"
        run = subprocess.run([self.program, "check", str(self.output), "--json", "--quiet"], capture_output=True, text=True)
        return "new" if '"end":"interrupted"' in run.stdout or '"end":"complete"' in run.stdout else "neither: " + run.stderr.strip()


class PageSave(Case):
    """The page repeatedly changes a scene and saves it to its own file until the program is killed."""

    def __init__(self, program, name, folder, scene):
        self.name, self.folder, self.old = name, folder, scene
        self.output = folder / "scene.palp"
        folder.mkdir()
        self.program = program

    def kill(self, rng):
        self.output.write_bytes(self.old)
        before = self.listing()
        self.page_saves(lambda: self.listing() != before, rng.random() ** 3 * 10 * WRITING_S)
        return self.kept()

    def page_saves(self, begun, longest_s):
        """Saves until `begun()`, for `longest_s` more, then kills."""
        process = subprocess.Popen([self.program, "touch", str(self.output), "--no-browser"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        address = next(word for line in process.stdout for word in line.split() if word.startswith("http://"))
        host, port = address.split("/")[2].split(":")
        page = PageClient(host, int(port), let_in(host, int(port), address.split("#")[1]))
        page.send(type="edit", serial=1, label=0, material={"stiffness_N_per_m": 321.0, "damping_Ns_per_m": None, "friction": None, "stickiness": None,
                                                            "texture": None})
        end = None
        while end is None or time.monotonic() < end:
            page.send(type="save")
            if end is None and begun():
                end = time.monotonic() + longest_s
            time.sleep(0.0005)
        process.kill()
        process.wait()
        page.close()

    def kept(self):
        if self.output.read_bytes() == self.old:
            return "old"
        run = subprocess.run([self.program, "info", str(self.output)], capture_output=True, text=True)
        return "new" if run.returncode == 0 else "neither: " + run.stderr.strip()

    def left_over(self):
        self.page_saves(lambda: True, 3.0)
        return [entry.name for entry in self.folder.iterdir() if entry != self.output]


def cases_of(program, folder):
    write_mesh(folder / "a.obj", 0.05)
    write_mesh(folder / "b.obj", 0.06)
    run = lambda *words: subprocess.run([program, *map(str, words), "--quiet"], check=True, **QUIET)
    for name in "ab":
        run("make", folder / f"{name}.obj", "-o", folder / f"{name}.palp", "--resolution", "64", "--no-cache")
    run("export", folder / "a.palp", "-o", folder / "a.stl")
    run("export", folder / "a.palp", "-o", folder / "a.ply")
    run("touch", folder / "a.palp", "--headless", "--seconds", "0.3", "--record", folder / "a.rec")
    old = lambda name: (folder / name).read_bytes()
    command = lambda *words: [program, *map(str, words), "--quiet"]
    return [
        Case("make", folder / "make", "out.palp", command("make", folder / "b.obj", "-o", folder / "make/out.palp", "--resolution", "64", "--no-cache"),
             old("a.palp")),
        Case("export", folder / "export", "out.stl", command("export", folder / "b.palp", "-o", folder / "export/out.stl"), old("a.stl")),
        Case("correct", folder / "correct", "out.palp", command("correct", folder / "a.palp", folder / "a.ply", "-o", folder / "correct/out.palp"),
             old("b.palp")),
        Recording(program, "recording", folder / "recording", "out.rec",
                  command("touch", folder / "b.palp", "--headless", "--seconds", "0.3", "--record", folder / "recording/out.rec"), old("a.rec")),
        PageSave(program, "page save", folder / "page", old("a.palp")),
    ]


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program", type=os.path.abspath)
    arguments.add_argument("--count", type=int, default=1000)
    arguments.add_argument("--minutes", type=float, default=float("inf"))
    arguments.add_argument("--seed", type=int, default=1)
    given = arguments.parse_args()
    rng = random.Random(given.seed)
    counts = collections.defaultdict(collections.Counter)
    faults = done = 0
    end = time.monotonic() + 60 * given.minutes
    with tempfile.TemporaryDirectory() as name:
        cases = cases_of(given.program, pathlib.Path(name))
        for k in range(given.count):
            if time.monotonic() > end:
                break
            done += 1
            case = cases[k % len(cases)]
            kept = case.kill(rng)
            # Only every tenth, because a complete run doubles the time.
            left = case.left_over() if k // len(cases) % 10 == 9 else []
            counts[case.name][kept] += 1
            if kept.startswith("neither") or left:
                faults += 1
                print(f"{case.name}, number {k}: {kept}{', left over: ' + ' '.join(left) if left else ''}", flush=True)
    for name, kept in counts.items():
        print(f"{name}: " + ", ".join(f"{count} {what}" for what, count in sorted(kept.items())))
    print(f"{done} kills with seed {given.seed}, {faults} faults")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
