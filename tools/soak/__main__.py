# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""Runs a long touch under load: python3 tools/soak PROGRAM -o FOLDER [--minutes M] [--pages N] [--messages-per-s R] [--seed S]
[--patience S].

Starts `palpable touch` with the simulated device, its page and a recording. N simulated users move probes, change laws and materials,
save, disconnect and return; a hostile client sends damaged requests and messages, and stops the process for moments. Every five
seconds, memory, descriptors, threads, ticks, force and energy are written to FOLDER/soak.csv; at the end they are drawn in
FOLDER/soak.svg, the touch is ended by SIGINT, and `palpable check` recomputes the recording. Prints the figures as JSON. The exit code
is 1 if memory or descriptors changed by more than 2 % between the first and the last fifth after the warm-up, if a client met a
fault, or if the touch did not end by the signal. A real user sends at most 60 messages per second and probe: R / 60 is the speed-up.
--patience is the time that the touch has to begin."""
import argparse
import csv
import json
import pathlib
import shutil
import signal
import statistics
import subprocess
import sys
import threading
import time
import types

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from chart import write_chart
from page_client import let_in
from visitors import Neighbour, Person
from watch import GrowingRecording, used_by

PERIOD_S = 5
WARM_UP = 0.1
MOST_FINDINGS = 40
PANELS = [{"resident memory, MiB": "resident_MiB", "of it private": "own_MiB"}, {"descriptors": "descriptors", "threads": "threads"},
          {"ticks per second": "ticks_per_s"}, {"energy balance, J: lowest": "least_J", "highest": "most_J"}, {"greatest force, N": "most_N"},
          {"messages from pages, per s": "messages_per_s"}]


def start_touch(program, folder, patience_s):
    scene = folder / "scene.palp"
    subprocess.run([program, "make", str(folder / "box.obj"), "-o", str(scene), "--resolution", "64", "--quiet"], check=True)
    shutil.copy(scene, folder / "touched.palp")
    log = open(folder / "touch.log", "wb")
    process = subprocess.Popen([program, "touch", str(folder / "touched.palp"), "--device", "sim:", "--no-browser", "--json", "--record",
                                str(folder / "soak.rec")], stdout=subprocess.PIPE, stderr=log, stdin=subprocess.DEVNULL, text=True)
    deadline = time.monotonic() + patience_s
    while time.monotonic() < deadline and process.poll() is None:
        text = (folder / "touch.log").read_text(errors="replace")
        if "http://" in text and "\n" in text[text.index("http://"):]:
            address = text[text.index("http://"):].split()[0]
            host, port = address.split("/")[2].split(":")
            return process, types.SimpleNamespace(host=host, port=int(port), process=process.pid,
                                                  cookie=let_in(host, int(port), address.split("#")[1]))
        time.sleep(0.1)
    process.terminate()
    process.wait()
    raise SystemExit(f"the touch did not begin within {patience_s:g} s; see {folder / 'touch.log'}")


def write_box(path):
    """A box 60 x 60 x 20 mm."""
    corners = [(x, y, z) for x in (0, .06) for y in (0, .06) for z in (0, .02)]
    faces = [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)]
    path.write_text("".join("v %g %g %g\n" % c for c in corners) + "".join("f %d %d %d %d\n" % f for f in faces))


def watch(process, people, folder, minutes):
    """Writes one row every PERIOD_S seconds until the time is over or the touch has ended."""
    rows, begin, recording = [], time.monotonic(), GrowingRecording(folder / "soak.rec")
    before = {"t_s": 0.0, "ticks": 0, "messages": 0}
    with open(folder / "soak.csv", "w", newline="") as file:
        writer = None
        while time.monotonic() - begin < 60 * minutes and process.poll() is None:
            time.sleep(PERIOD_S)
            least_J, most_J, most_N = recording.news()
            if process.poll() is not None:
                break
            row = {"t_s": time.monotonic() - begin, **used_by(process.pid), "ticks": recording.ticks, "further_ticks": recording.further,
                   "scenes": recording.scenes, "missed": recording.missed, "stalls": recording.stalls, "contact_ticks": recording.contact,
                   "least_J": least_J, "most_J": most_J, "most_N": most_N, "messages": sum(p.messages for p in people)}
            for name in ("ticks", "messages"):
                row[name + "_per_s"] = (row[name] - before[name]) / (row["t_s"] - before["t_s"])
            if writer is None:
                writer = csv.DictWriter(file, row.keys())
                writer.writeheader()
            writer.writerow({k: round(v, 6) for k, v in row.items()})
            file.flush()
            rows.append(row)
            before = row
    return rows


def change_of(rows, column):
    """Relative change of the median from the first to the last fifth after the warm-up."""
    kept = rows[int(WARM_UP * len(rows)):]
    fifth = max(1, len(kept) // 5)
    first, last = (statistics.median(r[column] for r in part) for part in (kept[:fifth], kept[-fifth:]))
    return last / first - 1


def ended(process):
    process.send_signal(signal.SIGINT)
    try:
        output = process.communicate(timeout=30)[0]
    except subprocess.TimeoutExpired:
        process.kill()
        output = process.communicate()[0]
    return process.returncode, output


def check(program, folder):
    run = subprocess.run([program, "check", str(folder / "soak.rec"), str(folder / "scene.palp"), "--json", "--quiet"], capture_output=True, text=True)
    report = json.loads(run.stdout) if run.stdout.startswith("{") else {}
    return {"code": run.returncode, **{k: report.get(k) for k in ("clean", "problems", "end", "ticks", "recomputed", "energy", "lost_ticks")},
            "findings": [f["sentence"] for f in report.get("findings", []) if f["problem"]][:MOST_FINDINGS]}


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program")
    arguments.add_argument("-o", "--output", required=True, type=pathlib.Path)
    arguments.add_argument("--minutes", type=float, default=120)
    arguments.add_argument("--pages", type=int, default=3)
    arguments.add_argument("--messages-per-s", type=float, default=400)
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--patience", type=float, default=300)
    given = arguments.parse_args()
    folder = given.output
    folder.mkdir(parents=True, exist_ok=True)
    write_box(folder / "box.obj")
    process, touch = start_touch(given.program, folder, given.patience)
    stop = threading.Event()
    people = [Person(touch, stop, given.seed + k, k + 1, given.messages_per_s) for k in range(given.pages)]
    neighbour = Neighbour(touch, stop, given.seed + 100)
    for visitor in (*people, neighbour):
        visitor.start()
    rows = watch(process, people, folder, given.minutes)
    stop.set()
    for visitor in (*people, neighbour):
        visitor.join(10)
    code, output = ended(process)
    write_chart(folder / "soak.svg", f"{rows[-1]['t_s'] / 60:.0f} minutes of touch with {given.pages} pages, faults and a recording", PANELS, rows)
    changes = {column: change_of(rows, column) for column in ("resident_MiB", "own_MiB", "descriptors")}
    figures = {"minutes": rows[-1]["t_s"] / 60, "code": code, "change": changes,
               "most": {c: max(r[c] for r in rows) for c in ("resident_MiB", "descriptors", "threads", "most_N")},
               **{c: rows[-1][c] for c in ("ticks", "further_ticks", "scenes", "missed", "stalls", "contact_ticks", "messages", "processor_s")},
               "visits": sum(p.visits for p in people), "faults_of_people": [p.faults for p in people if p.faults],
               "hostile_acts": neighbour.visits, "faults_of_neighbour": neighbour.faults,
               "recording_bytes": (folder / "soak.rec").stat().st_size, "check": check(given.program, folder)}
    print(json.dumps(figures, indent=1))
    if output.strip().startswith("{"):
        print(output.strip())
    flat = all(abs(change) <= 0.02 for change in changes.values())
    sys.exit(0 if flat and code == 130 and not figures["faults_of_people"] else 1)


if __name__ == "__main__":
    main()
