#!/usr/bin/env python3
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the fuzzers of the preset `fuzz` in turn: fuzz/rounds.py [FUZZER…] [--seconds N] [--rounds N] [--totals FILE.json].

In each round every fuzzer runs for N seconds of processor time, so that a busy machine costs patience only, the one that ran least
first. It starts from its corpus in
fuzz/corpus and from what earlier runs kept in build/fuzz/corpus, where the inputs that failed are put too. A run over the time limit
counts only if the input, tried again alone, takes that much processor time. --totals names a file that keeps processor time, runs and
findings of every fuzzer over several calls of this script, as fuzz/ledger.json, to which each session adds: the processor time of the
present parser, that is of the sources in the folders whose headers the fuzzer includes (without tests; those of core do not count if
there are others), with the commit at which it last ran; when they have changed, it begins again, and what was before is `earlier_s`. Prints each finding at once and a table at the end, or when it is interrupted
(Ctrl-C, SIGTERM). The exit code is 1 if something was found."""
import argparse
import hashlib
import json
import os
import pathlib
import re
import resource
import signal
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = ROOT / "build" / "fuzz"
SLOW_S = 10
# Wall time of one input, for the fuzzer's own clock.
PATIENCE_S = 120
MEMORY_MB = 2048
# What the decoder programs run, beside the folder of their jobs.
OF_DECODERS = ("sources/calibration", "sources/map", "sources/picture", "sources/solid")
# The signals that arrived.
interrupted = []


def processor_s(pid):
    """Of a process that lives, with its threads."""
    try:
        fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    except (FileNotFoundError, ProcessLookupError):
        return 0.0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def children_s():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def parser_files(name):
    """A fuzzer's own source and those of its parser."""
    source = ROOT / "fuzz" / f"{name}_fuzz.cpp"
    headers = re.findall(r'#include "palpable/([^"]+)/[^/"]+"', source.read_text())
    folders = {folder for folder in headers if not folder.startswith("core")} or set(headers)
    if "sources/decoder" in folders:
        folders.update(OF_DECODERS)
    return [source] + [file for folder in sorted(folders) for file in sorted((ROOT / "src/palpable" / folder).glob("*.[ch]pp"))
                       if not file.stem.endswith("_test")]


def parser_of(name):
    """A short hash of the sources of a fuzzer's parser."""
    return hashlib.sha256(b"\0".join(file.read_bytes() for file in parser_files(name))).hexdigest()[:12]


def commit():
    run = subprocess.run(["git", "-C", ROOT, "rev-parse", "--short=8", "HEAD"], capture_output=True, text=True)
    return run.stdout.strip() or "unknown"


class Fuzzer:
    def __init__(self, program):
        self.program = program
        self.name = program.name.removeprefix("fuzz_")
        self.kept = BUILD / "corpus" / self.name
        self.corpus = ROOT / "fuzz" / "corpus" / self.name
        self.log = self.kept.with_name(self.name + ".log")

    def is_old(self):
        """Whether its parser was changed after it was built."""
        return self.program.stat().st_mtime < max(file.stat().st_mtime for file in parser_files(self.name))

    def run(self, seconds):
        """Runs until it has used so much processor time or found something. Its runs, and the files that it found."""
        self.kept.mkdir(parents=True, exist_ok=True)
        before = set(self.artifacts())
        words = [self.program, f"-timeout={PATIENCE_S}", f"-rss_limit_mb={MEMORY_MB}", "-print_final_stats=1", f"-artifact_prefix={self.kept}/",
                 self.kept] + [self.corpus] * self.corpus.is_dir()
        with open(self.log, "w") as log:
            process = subprocess.Popen(words, stdout=log, stderr=log, stdin=subprocess.DEVNULL)
            while process.poll() is None and processor_s(process.pid) < seconds and not interrupted:
                time.sleep(0.2)
            # The fuzzer ends its present run and prints its figures.
            process.send_signal(signal.SIGUSR1)
            try:
                process.wait(2 * PATIENCE_S)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        text = self.log.read_text(errors="replace")
        runs = re.findall(r"stat::number_of_executed_units: (\d+)", text) or re.findall(r"^#(\d+)", text, re.MULTILINE)
        kept = [file for file in self.artifacts() if file not in before]
        found = [file for file in kept if self.is_fault(file)]
        # An interruption of the whole group reaches the fuzzer, too.
        if not kept and process.returncode != 0 and not interrupted:
            found = [self.log]
        return int(runs[-1]) if runs else 0, found

    def artifacts(self):
        return [file for kind in ("crash", "leak", "oom", "timeout") for file in self.kept.glob(f"{kind}-*")]

    def is_fault(self, file):
        if not file.name.startswith("timeout-"):
            return True
        before = children_s()
        subprocess.run([self.program, "-timeout=0", file], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                       preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (2 * SLOW_S, 2 * SLOW_S)))
        if children_s() - before >= SLOW_S:
            return True
        file.rename(file.with_name("slow-" + file.name))
        return False


def cause_in(log):
    """The line of a fuzzer's log that names the fault."""
    for line in log.read_text(errors="replace").splitlines():
        if re.search(r"ERROR:|runtime error|SUMMARY:", line):
            return line.strip()[:200]
    return "see " + str(log)


class Totals:
    def __init__(self, file):
        self.file = file
        self.of = json.loads(file.read_text()) if file and file.exists() else {}

    def entry(self, name, parser=None):
        """Of a parser by its hash, or of the present one."""
        entry = self.of.setdefault(name, {"processor_s": 0.0, "runs": 0, "findings": [], "earlier_s": 0.0})
        parser = parser or parser_of(name)
        if entry.setdefault("parser", parser) != parser:
            entry.update(parser=parser, earlier_s=round(entry.get("earlier_s", 0.0) + entry["processor_s"], 1), processor_s=0.0, runs=0)
        return entry

    def add(self, name, parser, seconds, runs, found):
        entry = self.entry(name, parser)
        entry["processor_s"] = round(entry["processor_s"] + seconds, 1)
        entry["runs"] += runs
        entry["findings"] += found
        entry["commit"] = commit()
        if self.file:
            beside = self.file.with_name(self.file.name + ".new")
            beside.write_text(json.dumps(self.of, indent=1, sort_keys=True) + "\n")
            beside.replace(self.file)

    def print(self, names):
        print(f"{'fuzzer':18}{'processor min':>15}{'runs':>14}{'findings':>10}")
        for name in names:
            entry = self.entry(name)
            print(f"{name:18}{entry['processor_s'] / 60:15.1f}{entry['runs']:14}{len(entry['findings']):10}", flush=True)


def one_turn(fuzzer, seconds, totals):
    """Whether nothing was found."""
    before = children_s()
    # Its sources may change while it runs.
    parser = parser_of(fuzzer.name)
    runs, found = fuzzer.run(seconds)
    cause = cause_in(fuzzer.log) if found else ""
    totals.add(fuzzer.name, parser, children_s() - before, runs, [f"{file.name}: {cause}" for file in found])
    for file in found:
        print(f"{fuzzer.name}: {cause}\n  {file}", flush=True)
    return not found


def interrupt(number, frame):
    interrupted.append(number)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("fuzzers", nargs="*", metavar="FUZZER", help="a fuzzer's name, as ply; all of build/fuzz/bin if none is given")
    arguments.add_argument("--seconds", type=float, default=300, help="of processor time, for each fuzzer in each round (300)")
    arguments.add_argument("--rounds", type=int, default=1)
    arguments.add_argument("--totals", type=pathlib.Path)
    given = arguments.parse_args()
    fuzzers = [Fuzzer(program) for program in sorted((BUILD / "bin").glob("fuzz_*")) if os.access(program, os.X_OK)]
    unknown = set(given.fuzzers) - {fuzzer.name for fuzzer in fuzzers}
    if unknown or not fuzzers:
        sys.exit(f"there is no fuzzer {' '.join(sorted(unknown))} in {BUILD / 'bin'}: ./test --fuzz 1 builds all of them")
    fuzzers = [fuzzer for fuzzer in fuzzers if not given.fuzzers or fuzzer.name in given.fuzzers]
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, interrupt)
    totals = Totals(given.totals)
    whole = True
    for _ in range(given.rounds):
        for fuzzer in sorted(fuzzers, key=lambda fuzzer: totals.entry(fuzzer.name)["processor_s"]):
            if interrupted:
                break
            if fuzzer.is_old():
                print(f"{fuzzer.name}: left out, since its parser was changed after it was built", flush=True)
            else:
                whole = one_turn(fuzzer, given.seconds, totals) and whole
    totals.print([fuzzer.name for fuzzer in fuzzers])
    sys.exit(130 if interrupted else 0 if whole else 1)


if __name__ == "__main__":
    main()
