#!/usr/bin/env python3
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""Sends signals to the program during contact: tools/signals.py PROGRAM [--count N] [--signals INT,TERM,...] [--seed S].

Each signal is sent N times, at a random instant during contact, to a touch with the simulated device; the force of its motors can be
read from a file (sim:?motors=FILE). Measures the time from the signal until the force of the motors is zero; after SIGKILL the guardian
sets it to zero. Prints a table. The exit code is 1 if a force remained, if a signal other than KILL took more than 5 ms, or if the
program did not end as docs/real-time.md states."""
import argparse
import os
import pathlib
import random
import signal
import struct
import subprocess
import sys
import tempfile
import time

CONTENT = struct.Struct("<Qqddd")
LIMIT_MS = 5.0
PATIENCE_S = 20
# Signals that report a failed write and do not end the program.
HARMLESS = {"PIPE", "XFSZ"}
BY_ITSELF = {"INT", "TERM", "HUP"}
INTERRUPTED = 130
# So long the motors are watched without a pause after a signal.
CLOSELY_NS = 50_000_000


def write_box(path):
    corners = [(x, y, z) for x in (0, .08) for y in (0, .08) for z in (0, .02)]
    faces = [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)]
    path.write_text("".join("v %g %g %g\n" % c for c in corners) + "".join("f %d %d %d %d\n" % f for f in faces))


def motors(path):
    """The time (ns) and the force (N) of the newest write; None if there was none."""
    data = path.read_bytes() if path.exists() else b""
    if len(data) < CONTENT.size:
        return None
    _, time_ns, x, y, z = CONTENT.unpack(data[:CONTENT.size])
    return time_ns, (x * x + y * y + z * z) ** 0.5


def wait_for_contact(path, process):
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end and process.poll() is None:
        held = motors(path)
        if held and held[1] > 0.05:
            return True
        time.sleep(0.001)
    return False


class Undisturbed:
    """The lowest real-time priority, where the system grants it: on a busy machine this tool itself would be held up, and would see a later
    zero (the program writes several) than the first."""

    def __enter__(self):
        try:
            os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(1))
        except OSError:
            pass

    def __exit__(self, *_):
        os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))


def ms_until_free(path, process, number):
    """Sends the signal; milliseconds until the motors' force was zero, None if that lasts too long."""
    with Undisturbed():
        begin_ns = time.monotonic_ns()
        os.kill(process.pid, number)
        while time.monotonic_ns() < begin_ns + CLOSELY_NS:
            time_ns, force_N = motors(path)
            if force_N == 0.0:
                # The guardian does not write the time.
                return ((time_ns or time.monotonic_ns()) - begin_ns) / 1e6
    end = time.monotonic() + 2
    while time.monotonic() < end:
        if motors(path)[1] == 0.0:
            return (time.monotonic_ns() - begin_ns) / 1e6
    return None


def send(program, scene, path, number, wait_s):
    """Milliseconds until the force was zero, and the exit status; no time if the force remained or there was none."""
    path.unlink(missing_ok=True)
    process = subprocess.Popen([program, "touch", str(scene), "--headless", "--seconds", "30", "--quiet", "--device",
                                f"sim:?motors={path}&speed-mm=150&press=2"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               stdin=subprocess.DEVNULL)
    took_ms = None
    if wait_for_contact(path, process):
        time.sleep(wait_s)
        while process.poll() is None and motors(path)[1] < 0.05:
            time.sleep(0.0005)
        took_ms = ms_until_free(path, process, number)
    return took_ms, process


def status_fault(name, process, number):
    if name in HARMLESS:
        alive = process.poll() is None
        process.kill()
        process.wait()
        return "" if alive else "ended"
    try:
        code = process.wait(timeout=5)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
        return "did not end"
    expected = INTERRUPTED if name in BY_ITSELF else -number
    return "" if code == expected else f"code {code}"


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program", type=os.path.abspath)
    arguments.add_argument("--count", type=int, default=200)
    arguments.add_argument("--signals", default="INT,TERM,HUP,QUIT,ABRT,SEGV,BUS,FPE,XCPU,PIPE,XFSZ,KILL")
    arguments.add_argument("--seed", type=int, default=1)
    given = arguments.parse_args()
    rng = random.Random(given.seed)
    # A shell starts background processes with the first two signals ignored, nohup with the third, and child processes would inherit that.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGQUIT, signal.SIG_DFL)
    signal.signal(signal.SIGHUP, signal.SIG_DFL)
    faults = 0
    with tempfile.TemporaryDirectory(dir="/dev/shm") as name:
        folder = pathlib.Path(name)
        write_box(folder / "box.obj")
        subprocess.run([given.program, "make", str(folder / "box.obj"), "-o", str(folder / "box.palp"), "--resolution", "64", "--quiet"], check=True,
                       stdout=subprocess.DEVNULL)
        print(f"{'signal':8}{'times':>6}{'median ms':>11}{'99 % ms':>9}{'most ms':>9}{'above 5 ms':>12}{'force stayed':>14}{'other end':>11}")
        for word in given.signals.split(","):
            number = getattr(signal, "SIG" + word)
            took, stayed, others = [], 0, []
            for _ in range(given.count):
                took_ms, process = send(given.program, folder / "box.palp", folder / "motors", number, rng.uniform(0, 0.3))
                if word not in HARMLESS:
                    stayed += took_ms is None
                    took += [] if took_ms is None else [max(took_ms, 0.0)]
                others += [fault for fault in [status_fault(word, process, number)] if fault]
            took.sort()
            late = sum(t > LIMIT_MS for t in took)
            at = lambda share: took[min(len(took) - 1, int(share * len(took)))] if took else float("nan")
            print(f"{word:8}{given.count:6}{at(0.5):11.2f}{at(0.99):9.2f}{at(1):9.2f}{late:12}{stayed:14}{len(others):11}"
                  + (f"  ({others[0]})" if others else ""), flush=True)
            faults += stayed + len(others) + (0 if word == "KILL" else late)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
