#!/usr/bin/env python3
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""Presses Ctrl-C (SIGINT) at random instants of every command: tools/interrupts.py PROGRAM --data FOLDER [--count N] [--seed S]
[--from NAME].

Each command line of the table below runs once to its end, or for LONGEST_S; then N times with a SIGINT at an instant that is uniformly
distributed over that time. The command must end within a second, with exit code 130, or 0 if all that it writes was complete before;
a signal in the first moments, before main(), ends the program by itself. What existed before is as it was, or new and whole; nothing
else remains in the folder, except what is complete. Prints each violation at once and a table at the end; the exit code is 1 if there were
violations. FOLDER has the layout of PALPABLE_DATA (tests/README.md)."""
import argparse
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

LONGEST_S = 20
ALLOWED_S = 1.0
INTERRUPTED = 130
QUIET = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "stdin": subprocess.DEVNULL}


def prepare(program, data, folder):
    """Files that commands read."""
    run = lambda *words: subprocess.run([program, *map(str, words), "--quiet"], check=True, **QUIET)
    run("make", "sample:sculptures", "-o", folder / "relief.palp")
    run("make", "sample:church", "-o", folder / "field.palp", "--resolution", "96")
    run("make", "sample:drawing", "-o", folder / "contours.palp")
    run("make", "sample:map", "-o", folder / "map.palp")
    run("export", folder / "field.palp", "-o", folder / "field.ply")
    run("touch", folder / "relief.palp", "--headless", "--seconds", "4", "--record", folder / "a.rec")
    run("depth", data / "stereo/mid2_cones/imL.png", data / "stereo/mid2_cones/imR.png", "-o", folder / "cones.pfm", "--method", "scanline")
    rng = random.Random(1)
    rows = lambda columns: "\n".join(",".join(f"{rng.uniform(-0.02, 0.02):.6f}" for _ in range(columns)) for _ in range(200000))
    (folder / "points.csv").write_text("x_m,y_m,z_m\n" + rows(3) + "\n")
    path = "\n".join(f"{k / 1000},{0.02 * (k % 997) / 997:.6f},0,0.004" for k in range(400000))
    (folder / "path.csv").write_text("t_s,x_m,y_m,z_m\n" + path + "\n")


def commands(data, made, out):
    """Name, words, and what the command writes, if anything."""
    cones = [data / "stereo/mid2_cones/imL.png", data / "stereo/mid2_cones/imR.png"]
    scene = data / "video/rendered_A_two_buildings"
    film = [scene / "video.mp4", "--calibration", scene / "intrinsics.json"]
    samples = pathlib.Path(__file__).resolve().parent.parent / "samples"
    sculptures = [samples / "sculpture_left.png", samples / "sculpture_right.png", "--calibration", samples / "sculpture_calib.txt"]
    headless = ["--headless", "--seconds", "10"]
    return [
        ("home", ["home", "--no-browser"], None),
        ("touch, page", ["touch", made / "relief.palp", "--no-browser"], None),
        ("touch, headless", ["touch", made / "field.palp", *headless], None),
        ("touch, recording", ["touch", made / "relief.palp", *headless, "--record", out / "touch.rec"], None),
        ("touch of a pair", ["touch", *cones, "--headless", "--seconds", "2"], None),
        ("make, pair", ["make", *cones, "-o", out / "pair.palp"], "pair.palp"),
        ("make, mesh", ["make", data / "mesh/objects/stanford-bunny.obj", "-o", out / "mesh.palp", "--no-cache"], "mesh.palp"),
        ("make, contours", ["make", data / "contour/letters/coins.png", "--as", "contours", "-o", out / "contours.palp"], "contours.palp"),
        ("make, map picture", ["make", data / "map-raster/osmcarto/monaco_z16.png", "--as", "map", "-o", out / "map.palp"], "map.palp"),
        ("make, map extract", ["make", data / "map-vector/extracts/monaco.osm.pbf", "-o", out / "extract.palp"], "extract.palp"),
        ("make, video", ["make", *film, "-o", out / "video.palp"], "video.palp"),
        ("correct", ["correct", made / "field.palp", made / "field.ply", "-o", out / "corrected.palp"], "corrected.palp"),
        ("depth, best", ["depth", *cones, "-o", out / "best.pfm"], "best.pfm"),
        ("depth, fast", ["depth", *cones, "-o", out / "fast.png", "--method", "fast"], "fast.png"),
        ("compare", ["compare", *cones, "-o", out / "compare.png"], "compare.png"),
        ("fit", ["fit", *cones, "-o", out / "fit.png"], "fit.png"),
        ("fit-shapes", ["fit-shapes", *sculptures, "-o", out / "shapes.json"], "shapes.json"),
        ("calibrate", ["calibrate", data / "stereo/calib_chessboard", "-o", out / "camera.yml", "--board", "9x6", "--square", "25"], "camera.yml"),
        ("rectify", ["rectify", data / "map-raster/osmcarto/monaco_z17.png", "-o", out / "flat.png", "--corners", "120,80 900,60 980,900 60,820"], "flat.png"),
        ("marker", ["marker", "-o", out / "marker.pdf"], "marker.pdf"),
        ("probe", ["probe", made / "relief.palp", "--path", made / "path.csv", "-o", out / "forces.csv"], "forces.csv"),
        ("sample", ["sample", made / "field.palp", "--points", made / "points.csv", "-o", out / "values.csv"], "values.csv"),
        ("bench", ["bench"], None),
        ("show, relief", ["show", made / "relief.palp", "-o", out / "show.png"], "show.png"),
        ("show, force", ["show", made / "field.palp", "--view", "force", "-o", out / "force.svg"], "force.svg"),
        ("info", ["info", made / "field.palp"], None),
        ("export, stl", ["export", made / "field.palp", "-o", out / "field.stl"], "field.stl"),
        ("export, vdb", ["export", made / "field.palp", "-o", out / "field.vdb"], "field.vdb"),
        ("export, html", ["export", made / "map.palp", "-o", out / "page.html"], "page.html"),
        ("export, recording", ["export", made / "a.rec", "-o", out / "rec.csv"], "rec.csv"),
        ("score disparity", ["score", "disparity", made / "cones.pfm", data / "stereo/mid2_cones/groundtruth.png", "--truth-scale", "0.25"], None),
        ("check", ["check", made / "a.rec", made / "relief.palp"], None),
        ("study-stability", ["study-stability", "-o", out / "groove.png"], "groove.png"),
        ("study-tracing", ["study-tracing"], None),
        ("study-trajectories", ["study-trajectories"], None),
        ("devices", ["devices"], None),
        ("share", ["share", "sim:"], None),
        ("methods", ["methods"], None),
        ("doctor", ["doctor"], None),
    ]


class Command:
    def __init__(self, program, out, name, words, output):
        self.name, self.out, self.output = name, out, output
        self.command = [program, *map(str, words), "--quiet"]
        self.started = None
        self.whole_s = self.first_run()
        self.old = b"old\n"

    def start(self):
        # Its own group, as that of a shell's foreground job: the signal of a terminal reaches its children, too.
        self.started = time.monotonic()
        return subprocess.Popen(self.command, start_new_session=True, **QUIET)

    def first_run(self):
        process = self.start()
        try:
            code = process.wait(timeout=LONGEST_S)
        except subprocess.TimeoutExpired:
            self.interrupt(process)
            process.wait()
            code = 0
        if code not in (0, 1):
            sys.exit(f"{self.name}: exit code {code} without a signal: {' '.join(self.command)}")
        return time.monotonic() - self.started

    @staticmethod
    def interrupt(process):
        os.killpg(process.pid, signal.SIGINT)

    def violations(self, rng):
        """Of one run with a signal, and the time that it took to end; None if it ended before the signal."""
        for file in self.out.iterdir():
            file.unlink()
        if self.output:
            (self.out / self.output).write_bytes(self.old)
        process = self.start()
        time.sleep(rng.random() * self.whole_s)
        if process.poll() is not None:
            return None
        sent = time.monotonic()
        self.interrupt(process)
        try:
            code = process.wait(timeout=30)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            return ["did not end"], 30
        took_s = time.monotonic() - sent
        return [what for what in (self.late(took_s), self.wrong_code(code), self.wrong_files(code)) if what], took_s

    @staticmethod
    def late(took_s):
        return f"ended after {took_s:.2f} s" if took_s > ALLOWED_S else ""

    def wrong_code(self, code):
        complete = self.output and (self.out / self.output).exists() and (self.out / self.output).read_bytes() != self.old
        allowed = (INTERRUPTED, -signal.SIGINT) + ((0,) if complete else ())
        return "" if code in allowed else f"exit code {code}"

    def wrong_files(self, code):
        left = sorted(file.name for file in self.out.iterdir() if file.name not in (self.output, "touch.rec"))
        if left:
            return "left over: " + " ".join(left)
        if self.output and not (self.out / self.output).exists():
            return "its output was lost"
        return ""


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program", type=os.path.abspath)
    arguments.add_argument("--data", type=pathlib.Path, required=True)
    arguments.add_argument("--count", type=int, default=20)
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--from", dest="first", default="", help="begin at this command of the table")
    given = arguments.parse_args()
    rng = random.Random(given.seed)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    faults = 0
    with tempfile.TemporaryDirectory() as name:
        made, out = pathlib.Path(name) / "made", pathlib.Path(name) / "out"
        made.mkdir()
        out.mkdir()
        prepare(given.program, given.data.resolve(), made)
        print(f"{'command':22}{'whole s':>9}{'signals':>9}{'median s':>10}{'most s':>8}{'violations':>12}")
        table = commands(given.data.resolve(), made, out)
        begin = next((k for k, row in enumerate(table) if row[0] == given.first), 0)
        for title, words, output in table[begin:]:
            command = Command(given.program, out, title, words, output)
            took = []
            wrong = 0
            for k in range(given.count):
                result = command.violations(rng)
                if result is None:
                    continue
                took.append(result[1])
                wrong += bool(result[0])
                for what in result[0]:
                    print(f"{title}, number {k}: {what}", flush=True)
            took.sort()
            faults += wrong
            figures = (took[len(took) // 2], took[-1]) if took else (0, 0)
            print(f"{title:22}{command.whole_s:9.2f}{len(took):9}{figures[0]:10.3f}{figures[1]:8.3f}{wrong:12}", flush=True)
    print(f"seed {given.seed}: {faults} violations")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
