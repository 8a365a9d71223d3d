#!/usr/bin/env python3
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""Passes damaged files of every kind to the real program: fuzz/mutated_files.py PROGRAM [--count N] [--seed S] [--keep FOLDER].

First, valid files of every kind are made by the program, or taken from fuzz/corpus if the program does not write the kind. Then N
copies, each with some bytes changed or a part removed, repeated or exchanged, are read by a command. A run passes if no signal ends
it, it takes less than 10 s of processor time and 2 GB, its exit code is 0 to 4, its error is one short line of plain text, and a file
that contradicts its own counts, sizes or checksums (whole.py) is refused. Prints each failure at once with its seed, and the counts
after every 500 files, at the end, and when it is interrupted (Ctrl-C, SIGTERM), then with the options that continue; --keep keeps the
files that failed. File number k depends only on the seed and on k: --first K --count 1 repeats one file."""
import argparse
import os
import pathlib
import random
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time

from whole import contradiction

MEMORY_BYTES = 2 << 30
SECONDS = 10
# Wall time is limited less strictly, since other programs may use the processor.
PATIENCE_S = 600
SUMMARY_EVERY = 500
CORPUS = pathlib.Path(__file__).resolve().parent / "corpus"


def box_mesh(path):
    corners = [(x, y, z) for x in (0, .04) for y in (0, .04) for z in (0, .04)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))]
    if path.suffix == ".obj":
        path.write_text("".join("v %g %g %g\n" % c for c in corners) + "".join("f %d %d %d\n" % tuple(i + 1 for i in t) for t in triangles))
    elif path.suffix == ".ply":
        head = ("ply\nformat binary_little_endian 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
                "element face 12\nproperty list uchar int vertex_indices\nend_header\n").encode()
        path.write_bytes(head + b"".join(struct.pack("<3f", *c) for c in corners) + b"".join(struct.pack("<B3i", 3, *t) for t in triangles))
    else:
        path.write_bytes(bytes(80) + struct.pack("<I", 12) +
                         b"".join(struct.pack("<12fH", 0, 0, 0, *[v for i in t for v in corners[i]], 0) for t in triangles))


SHAPES = """{"primitives": [{"type": "superquadric", "size_m": [0.02, 0.015, 0.01], "exponents": [0.5, 1.0], "rotation": [1, 0, 0, 0],
 "position_m": [0, 0, 0.01], "taper": [0.1, 0], "bend": 0}]}"""


def exr():
    """A depth map of 8 x 4 as OpenEXR, one channel Z of floats, not compressed."""
    attribute = lambda name, kind, value: f"{name}\0{kind}\0".encode() + struct.pack("<I", len(value)) + value
    box = struct.pack("<4i", 0, 0, 7, 3)
    head = struct.pack("<2I", 20000630, 2) + b"".join((
        attribute("channels", "chlist", b"Z\0" + struct.pack("<IB3xII", 2, 0, 1, 1) + b"\0"), attribute("compression", "compression", b"\0"),
        attribute("dataWindow", "box2i", box), attribute("displayWindow", "box2i", box), attribute("lineOrder", "lineOrder", b"\0"),
        attribute("pixelAspectRatio", "float", struct.pack("<f", 1)), attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)),
        attribute("screenWindowWidth", "float", struct.pack("<f", 1)))) + b"\0"
    lines = [struct.pack("<iI8f", y, 32, *(1 + 0.1 * x * y for x in range(8))) for y in range(4)]
    first = len(head) + 8 * len(lines)
    return head + b"".join(struct.pack("<Q", first + 40 * k) for k in range(4)) + b"".join(lines)


def whole_files(program, folder):
    """At least one file of each kind, with the command that reads it."""
    files = []
    make = lambda f: [program, "make", str(f), "-o", str(folder / "out.palp"), "--no-cache", "--resolution", "32", "--quiet"]
    read = lambda f: [program, "info", str(f)]
    for name in ("box.obj", "box.ply", "box.stl"):
        box_mesh(folder / name)
        files.append((folder / name, make))
    subprocess.run([program, "make", str(folder / "box.obj"), "-o", str(folder / "field.palp"), "--resolution", "32", "--quiet"], check=True)
    files.append((folder / "field.palp", read))
    for name in ("field.glb", "field.vdb"):
        subprocess.run([program, "export", str(folder / "field.palp"), "-o", str(folder / name), "--quiet"], check=True)
        files.append((folder / name, make))
    subprocess.run([program, "touch", str(folder / "field.palp"), "--headless", "--seconds", "0.2", "--record", str(folder / "touch.rec"), "--quiet"],
                   check=True, stdout=subprocess.DEVNULL)
    for command in (lambda f: [program, "export", str(f), "-o", str(folder / "out.csv")],
                    lambda f: [program, "check", str(f), str(folder / "field.palp")],
                    lambda f: [program, "touch", str(folder / "field.palp"), "--headless", "--seconds", "0.1", "--device", f"replay:{f}"]):
        files.append((folder / "touch.rec", command))
    (folder / "path.csv").write_text("t_s,x_m,y_m,z_m\n" + "".join(f"{0.001 * k},{0.001 * k},0,{0.03 - 0.001 * k}\n" for k in range(30)))
    files.append((folder / "path.csv", lambda f: [program, "probe", str(folder / "field.palp"), "--path", str(f), "-o", str(folder / "out.csv"), "--quiet"]))
    (folder / "shapes.json").write_text(SHAPES)
    (folder / "a.exr").write_bytes(exr())
    files += [(folder / "shapes.json", make), (folder / "a.exr", make)]
    for entry in sorted((CORPUS / "picture").glob("a.*")) + sorted((CORPUS / "npz").glob("a.*")):
        shutil.copy(entry, folder / entry.name)
        files.append((folder / entry.name, make))
    for entry in sorted((CORPUS / "scene").glob("*.palp")):
        shutil.copy(entry, folder / entry.name)
        files.append((folder / entry.name, read))
    picture = folder / "a.png"
    calibrate = lambda f: [program, "depth", str(picture), str(picture), "--method", "fast", "--calibration", str(f), "-o", str(folder / "out.pfm"), "--quiet"]
    for entry in sorted((CORPUS / "calibration").iterdir()):
        shutil.copy(entry, folder / entry.name)
        files.append((folder / entry.name, calibrate))
    for name in ("four16.wav", "robot.json"):
        shutil.copy(CORPUS / "sound" / name, folder / name)
    listen = lambda sound, array: [program, "listen", str(sound), "--microphones", str(array), "--quiet"]
    files.append((folder / "four16.wav", lambda f: listen(f, folder / "robot.json")))
    files.append((folder / "robot.json", lambda f: listen(folder / "four16.wav", f)))
    return files


def mutated(whole, rng):
    data = bytearray(whole)
    kind = rng.randrange(5)
    if kind == 0:
        return bytes(data[:rng.randrange(len(data))])
    if kind == 1 and len(data) > 8:
        begin, length = rng.randrange(len(data)), rng.randrange(1, max(2, len(data) // 4))
        data[begin:begin] = data[begin:begin + length]
    elif kind == 2 and len(data) > 8:
        for _ in range(rng.randrange(1, 4)):
            at = rng.randrange(len(data) - 4)
            data[at:at + 4] = rng.choice((b"\xff\xff\xff\xff", b"\xff\xff\xff\x7f", b"\0\0\0\x80", b"\0\0\0\0", b"\0\0\0\x40"))
    else:
        for _ in range(rng.randrange(1, 30)):
            data[rng.randrange(len(data))] = rng.randrange(256)
    return bytes(data)


def limit():
    resource.setrlimit(resource.RLIMIT_AS, (4 * MEMORY_BYTES, 4 * MEMORY_BYTES))
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS + 1))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def fault_of(command, damaged):
    try:
        run = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=limit)
        output, error = (text.decode(errors="replace") for text in run.communicate(timeout=PATIENCE_S))
    except subprocess.TimeoutExpired:
        run.kill()
        run.communicate()
        return f"took over {PATIENCE_S} s"
    except KeyboardInterrupt:
        run.kill()
        run.communicate()
        raise
    if run.returncode == -signal.SIGXCPU:
        return f"took over {SECONDS} s of processor time"
    if run.returncode < 0:
        return f"ended by signal {-run.returncode}"
    if run.returncode not in (0, 1, 2, 3, 4):
        return f"code {run.returncode}"
    # `check` ends with 1 and a report if it finds a fault (docs/recording.md).
    if run.returncode == 1:
        return "" if command[1] == "check" and ("Not clean." in output or "Not judged" in output) else "code 1: " + error.strip()[:200]
    if run.returncode and (len(error.splitlines()) != 1 or len(error) > 1500 or any(ord(c) < 32 and c != "\n" for c in error)):
        return "its error is not one short line: " + repr(error[:200])
    if run.returncode == 0 and (why := contradiction(damaged)) and not says_damage(error + output):
        return "was taken for good: " + why
    return ""


def says_damage(text):
    """Whether the program reports the damage of a recording; it still reads the part before the damage."""
    return any(word in text for word in ("damage", "cut off", "interrupted"))


class Tally:
    """What was found so far, in lines that are printed at once: a long run may be ended at any time."""

    def __init__(self, given, kinds):
        self.given, self.kinds = given, kinds
        self.done = self.faults = 0
        self.begin = time.monotonic()

    def failed(self, file, number, fault):
        self.faults += 1
        print(f"{file.name}, seed {self.given.seed}, number {number}: {fault}", flush=True)

    def passed(self):
        self.done += 1
        if self.done % SUMMARY_EVERY == 0 and self.done < self.given.count:
            self.summary()

    def summary(self):
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        print(f"{self.done} files of {self.kinds} kinds and samples from number {self.given.first} of seed {self.given.seed}: {self.faults} not "
              f"withstood, at most {used.ru_maxrss >> 10} MiB, {used.ru_utime + used.ru_stime:.0f} s of processor time, "
              f"{time.monotonic() - self.begin:.0f} s", flush=True)
        return used.ru_maxrss << 10

    def to_continue(self):
        left = self.given.count - self.done
        return f"interrupted; continue with --seed {self.given.seed} --first {self.given.first + self.done} --count {left}"


def try_all(given, folder, files, tally):
    for n in range(given.first, given.first + given.count):
        rng = random.Random(given.seed * 1000003 + n)
        file, command = files[n % len(files)]
        damaged = folder / ("damaged" + file.suffix)
        damaged.write_bytes(mutated(file.read_bytes(), rng))
        if fault := fault_of(command(damaged), damaged):
            tally.failed(file, n, fault)
            if given.keep:
                os.makedirs(given.keep, exist_ok=True)
                shutil.copy(damaged, os.path.join(given.keep, f"{given.seed}-{n}-{file.name}"))
        tally.passed()


def interrupt(number, frame):
    raise KeyboardInterrupt


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("program", type=os.path.abspath)
    arguments.add_argument("--count", type=int, default=1000)
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--first", type=int, default=0)
    arguments.add_argument("--keep")
    given = arguments.parse_args()
    # A shell starts background processes with SIGINT ignored.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, interrupt)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        files = whole_files(given.program, folder)
        tally = Tally(given, len(files))
        try:
            try_all(given, folder, files, tally)
        except KeyboardInterrupt:
            tally.summary()
            print(tally.to_continue(), flush=True)
            sys.exit(130)
    if tally.summary() > MEMORY_BYTES:
        sys.exit("the largest run took more memory than is allowed")
    sys.exit(1 if tally.faults else 0)


if __name__ == "__main__":
    main()
