#!/usr/bin/env python3
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""Measures the program and keeps the figures.

  tools/measure.py GROUP… [--program FILE] [--data FOLDER]   runs groups of measurements, writes docs/measurements.json and
                                                             the table docs/measurements.md (groups: see below; all)
  tools/measure.py GROUP… --try                              runs a small part of each group and writes nothing
  tools/measure.py --table                                   writes the table again from docs/measurements.json
  tools/measure.py --check                                   fails if the table is not what the figures give, a group is not
                                                             measured and not on the list of those to come, or a record
                                                             has no commit

A record of docs/measurements.json: group, figure, input, value, unit, bar ("<= 2.7", or empty), how (a command, or words
for a figure measured by hand), commit, date. Times are of an otherwise idle machine with 2 cores, or processor time
where the figure says so."""
import argparse, datetime, json, math, os, re, resource, subprocess, sys, tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
RECORDS = ROOT / "docs/measurements.json"
TABLE = ROOT / "docs/measurements.md"
GROUPS = {
    "setup": "Building and testing",
    "stereo": "Stereo matching: bad pixels",
    "contours": "Contours",
    "ticks": "One tick, release build",
    "servo": "The servo loop",
    "fields": "Distance fields",
    "touch": "Until the first touch",
    "page": "The page",
    "force": "Force and energy: attacks",
    "faults": "Damaged input, kills, signals",
    "screen": "Depth on the screen",
    "maps": "Pictures of street maps",
    "pictures": "Pictures as people have them",
    "video": "Videos of models",
}


class Measurement:
    def __init__(self, program, data, part):
        self.program, self.data, self.part = str(program), Path(data), part
        self.scratch = Path(tempfile.mkdtemp(prefix="palpable-measure-"))
        self.records = []

    def run(self, *arguments):
        """The JSON that a command answers, with the processor time that it took as `cpu_seconds`."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        result = subprocess.run([self.program, *map(str, arguments), "--json"], capture_output=True, text=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if result.returncode != 0:
            sys.exit(f"{' '.join(map(str, arguments))}: {result.stderr.strip()[-300:]}")
        answer = json.loads(result.stdout) if result.stdout.strip() else {}
        answer["cpu_seconds"] = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return answer

    def inputs(self, all_inputs):
        """The inputs to measure: with --try only the first one."""
        return list(all_inputs)[:1] if self.part else list(all_inputs)

    def add(self, group, figure, of, value, unit, bar, how):
        if value is None:
            sys.exit(f"{figure}, {of}: there is no value ({how})")
        self.records.append(dict(group=group, figure=figure, input=of, value=value, unit=unit, bar=bar, how=how))
        print(f"{figure}, {of}: {value:.4g} {unit} {('(' + bar + ')') if bar else ''}", file=sys.stderr)


# Pair, left, right, truth, what the truth's values are multiples of, masks.
PAIRS = [
    ("tsukuba", "mid2_tsukuba", "imL.png", "imR.png", "groundtruth.png", 16, ("nonocc", "all", "disc")),
    ("venus", "mid2_venus", "imL.png", "imR.png", "groundtruth.png", 8, ("nonocc", "all", "disc")),
    ("cones", "mid2_cones", "imL.png", "imR.png", "groundtruth.png", 4, ("nonocc", "all", "disc")),
    ("Art", "mid05_Art", "view1.png", "view5.png", "disp1.png", 3, ()),
    ("Laundry", "mid05_Laundry", "view1.png", "view5.png", "disp1.png", 3, ()),
    ("Reindeer", "mid06_Reindeer", "view1.png", "view5.png", "disp1.png", 2, ()),
]
STEREO_BARS = {
    "fast": {"tsukuba": 6, "venus": 4, "cones": 7.5},
    "best": {"tsukuba": 2.7, "venus": 0.6, "cones": 5.4},
    "graph-cut": {"tsukuba": 5.2, "venus": 4.7, "cones": 13.7},
    "segments": {"tsukuba": 4, "venus": 2, "cones": 9},
    "pyramid": {"tsukuba": 10, "venus": 8, "cones": 17},
    "scanline": {"tsukuba": 5.9, "venus": 11.9, "cones": 14.3},
}


def measure_stereo(m):
    for method, bars in m.inputs(STEREO_BARS.items()):
        for name, folder, left, right, truth, scale, masks in m.inputs(PAIRS):
            at = m.data / "stereo" / folder
            out = m.scratch / f"{name}-{method}.pfm"
            made = m.run("depth", at / left, at / right, "--method", method, "-o", out)
            scores = [m.run("score", "disparity", out, at / truth, "--truth-scale", scale, *mask)
                      for mask in ([["--mask", at / f"{k}.png"] for k in masks] or [[]])]
            region = "mean of nonocc, all and disc" if masks else "where the truth is known"
            for pixels in ("0.5", "1"):
                value = sum(s["bad"][pixels] for s in scores) / len(scores)
                bar = f"<= {bars[name]}" if pixels == "1" and name in bars else ""
                m.add("stereo", f"`{method}`, beyond {pixels} px", name, value, "%", bar,
                      f"`depth --method {method}`, `score disparity`, {region}")
            m.add("stereo", f"`{method}`, processor time", name, made["cpu_seconds"], "s", "", f"`depth --method {method}`")


TICK_BARS = {
    ("relief/proxy-friction/640x480", "median_ns"): 150, ("relief/proxy-friction/640x480", "p99_9_ns"): 500,
    ("relief/proxy-friction-texture/640x480", "median_ns"): 200, ("relief/proxy-friction-texture/640x480", "p99_9_ns"): 600,
    ("field/value-gradient/512", "median_ns"): 250, ("field/value-gradient/512", "p99_9_ns"): 1000,
    ("field/proxy-friction/512", "p99_9_ns"): 2000,
}


def measure_ticks(m):
    for b in m.run("bench")["benchmarks"]:
        for key, words in (("median_ns", "median"), ("p99_ns", "99th percentile"), ("p99_9_ns", "99.9th percentile")):
            bar = TICK_BARS.get((b["name"], key))
            m.add("ticks", words, b["name"], b[key], "ns", f"<= {bar}" if bar else "", "`bench`")


def measure_servo(m):
    at = m.data / "stereo/mid2_cones"
    j = m.run("touch", at / "imL.png", at / "imR.png", "--headless", "--seconds", "10")
    servo, how = j["servo"], "`touch --headless --seconds 10`"
    rows = [("rate", servo["rate_hz"], "Hz", ">= 985"), ("missed deadlines", servo["missed"], "", ""),
            ("computing, median", servo["compute_us"]["p50"], "µs", ""),
            ("computing, 99.9th percentile", servo["compute_us"]["p99_9"], "µs", ""),
            ("allocations in ticks", j["allocations_in_ticks"], "", "<= 0"),
            ("first force", j["seconds_to_first_force"], "s", "<= 2")]
    made = j["energy"]["made_max_without_controller_J"]
    if made is not None:
        rows.append(("energy made without the controller", 1e6 * made, "µJ", "<= 1"))
    for figure, value, unit, bar in rows:
        m.add("servo", figure, "cones", value, unit, bar, how)


# Meshes sized to 100 mm, 512 cells: the file, and whether it is a scanned or sculpted one of the sizes of the bars.
MESHES = [("stanford-bunny", "mesh/objects/stanford-bunny.obj", True), ("building-small-a", "mesh/kenney_city/building-small-a.glb", False)]


def measure_fields(m):
    for name, file, scanned in m.inputs(MESHES):
        out = m.scratch / f"{name}.palp"
        made = m.run("make", m.data / file, "--as", "field", "--size", "100x100x100", "--resolution", "512", "--no-cache", "-o", out)
        info = m.run("info", out)
        how = "`make --as field --size 100x100x100 --resolution 512`, `info`"
        bars = ("<= 20", "<= 6", "<= 15") if scanned else ("", "", "")
        m.add("fields", "memory", name, info["memory_bytes"] / 1e6, "MB", bars[0], how)
        m.add("fields", "file", name, info["file_bytes"] / 1e6, "MB", bars[1], how)
        m.add("fields", "processor time of `make`", name, made["cpu_seconds"], "s", bars[2], how)
        m.add("fields", "greatest error met while building", name, 1e6 * info["max_error_m"], "µm", "", how)


def measure_contours(m):
    at = m.data / "contour/bsds"
    for quality in ("live", "best"):
        values = []
        for picture in m.inputs(sorted(at.glob("*.jpg"))):
            out = m.scratch / f"{picture.stem}-{quality}.palp"
            m.run("make", picture, "--as", "contours", "--quality", quality, "-o", out)
            truth = sorted(at.glob(f"{picture.stem}_seg*.png"))
            values.append(m.run("score", "boundary", out, *truth)["best"]["f"])
        m.add("contours", f"`{quality}`, mean boundary F", f"{len(values)} photographs with drawn boundaries", sum(values) / len(values), "", "",
              f"`make --as contours --quality {quality}`, `score boundary`")


def write_bumpy_ball(path, rings):
    """A closed mesh of about 2 * rings * rings * 2 triangles, as a scan has them: a ball with bumps and a fine roughness."""
    around = 2 * rings
    place = lambda i, k: (math.pi * (i + 0.5) / rings, 2 * math.pi * k / around)
    with open(path, "w") as out:
        for i in range(rings):
            for k in range(around):
                a, b = place(i, k)
                r = 1 + 0.08 * math.sin(5 * a) * math.sin(4 * b) + 0.002 * math.sin(97 * a + 31 * b)
                out.write(f"v {r * math.sin(a) * math.cos(b):.6f} {r * math.sin(a) * math.sin(b):.6f} {r * math.cos(a):.6f}\n")
        out.write("v 0 0 1\nv 0 0 -1\n")
        at = lambda i, k: 1 + i * around + k % around
        top, bottom = rings * around + 1, rings * around + 2
        for k in range(around):
            out.write(f"f {top} {at(0, k)} {at(0, k + 1)}\nf {bottom} {at(rings - 1, k + 1)} {at(rings - 1, k)}\n")
            for i in range(rings - 1):
                out.write(f"f {at(i, k)} {at(i + 1, k)} {at(i + 1, k + 1)}\nf {at(i, k)} {at(i + 1, k + 1)} {at(i, k + 1)}\n")


def measure_touch(m):
    mesh = m.scratch / "bumpy-ball.obj"
    write_bumpy_ball(mesh, 24 if m.part else 158)
    triangles = sum(line.startswith("f") for line in mesh.open())
    of = f"generated mesh of {triangles} triangles"
    j = m.run("touch", mesh, "--headless", "--seconds", "3", "--no-cache")
    how = "`touch MESH --headless --no-cache`: from the command to the first force of the simulated hand"
    m.add("touch", "first force", of, j["seconds_to_first_force"], "s", "<= 5", how)
    m.add("touch", "part of the ticks in contact", of, 100 * j["contact_ticks"] / j["servo"]["ticks"], "%", ">= 30", how)


def page_script(name, *arguments):
    result = subprocess.run(["node", ROOT / "web/scripts" / name, *map(str, arguments)], cwd=ROOT / "web", capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"{name}: {result.stderr.strip()[-300:]}")
    return result.stdout


def measure_page(m):
    sound = json.loads(page_script("first_sound.mjs", m.program))
    how = "`node web/scripts/first_sound.mjs PROGRAM`"
    m.add("page", "clicks until sound runs", "the sample", sound["clicks"], "", "<= 1", how)
    m.add("page", "from the command to a page that can be touched", "the sample", sound["seconds_to_running"], "s", "", how)
    m.add("page", "from the click to sound", "the sample", sound["seconds_to_sound"], "s", "", how)
    how = "`node web/scripts/rest_cost.mjs PROGRAM`: browser and program, less an empty page"
    rest = re.findall(r"^(.+): browser .* together ([0-9.]+) % of a core$", page_script("rest_cost.mjs", m.program, 2 if m.part else 20), re.M)
    empty = float(rest[0][1])
    for view, share in rest[1:]:
        m.add("page", "processor time at rest", view, max(0.0, float(share) - empty), "% of a core", "<= 2", how)


RUNS = {"stereo": measure_stereo, "contours": measure_contours, "ticks": measure_ticks, "servo": measure_servo,
        "fields": measure_fields, "touch": measure_touch, "page": measure_page}
# Groups whose figures are written down by hand, with the tool that each states.
BY_HAND = ("setup", "force", "faults", "screen", "maps", "pictures", "video")
# Groups whose figures are not in the table yet. Take a group off when it is measured.
TO_COME = ()


def faults_of(records):
    """What is wrong with the records, as sentences."""
    for group in GROUPS:
        measured = any(r["group"] == group for r in records)
        if not measured and group not in TO_COME:
            yield f"the group {group} has no figure"
        if measured and group in TO_COME:
            yield f"the group {group} is measured: take it off TO_COME in tools/measure.py"
    for r in records:
        if r["group"] not in GROUPS:
            yield f"{r['figure']}, {r['input']}: there is no group {r['group']}"
        if not r.get("commit"):
            yield f"{r['figure']}, {r['input']}: its commit is missing"


def load():
    return json.loads(RECORDS.read_text()) if RECORDS.exists() else []


def holds(record):
    if not record["bar"]:
        return ""
    relation, limit = record["bar"].split()
    good = record["value"] <= float(limit) if relation == "<=" else record["value"] >= float(limit)
    return "yes" if good else "**no**"


def number(value):
    return f"{value:.0f}" if abs(value) >= 1000 or value == int(value) else f"{value:.3g}"


def shown(record):
    """The value as the table shows it: with one digit more where rounding would hide that it misses its bar."""
    rounded = number(record["value"])
    if holds(record) != holds({**record, "value": float(rounded)}):
        return f"{record['value']:.{len(rounded.replace('.', '')) + 1}g}"
    return rounded


def table_of(records):
    lines = ["# Measurements", "",
             "Generated from `measurements.json` by `tools/measure.py --table`: edit neither by hand. `tools/measure.py GROUP…` measures again.",
             "Machine: 2 virtual cores (x86-64), Debian 12, g++ 12.2, release build. No test asserts a time. How figures developed,",
             "what was tried and did not help: [history](history/README.md).", ""]
    for group, title in GROUPS.items():
        of_group = [r for r in records if r["group"] == group]
        lines += [f"## {title}", ""]
        if not of_group:
            lines += [f"Not measured since the table is generated: `tools/measure.py {group}`.", ""]
            continue
        lines += ["| figure | input | value | bar | holds | how | commit | date |", "|---|---|---|---|---|---|---|---|"]
        for r in of_group:
            lines.append(f"| {r['figure']} | {r['input']} | {shown(r)} {r['unit']} | {r['bar']} | {holds(r)} | {r['how']} | {r['commit']} | {r['date']} |")
        lines.append("")
    return "\n".join(lines).replace("  |", " |").rstrip() + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("groups", nargs="*", choices=[*RUNS, "all", []], help="what to measure")
    parser.add_argument("--program", default=ROOT / "build/release/bin/palpable")
    parser.add_argument("--data", default=os.environ.get("PALPABLE_DATA"))
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--try", dest="part", action="store_true")
    options = parser.parse_args()
    records = load()
    if options.check:
        faults = list(faults_of(records))
        if TABLE.read_text() != table_of(records):
            faults.append("docs/measurements.md is not what docs/measurements.json gives: tools/measure.py --table")
        sys.exit("\n".join(faults) if faults else 0)
    if options.groups:
        if not options.data:
            sys.exit("the real data's folder is needed: set PALPABLE_DATA or give --data")
        m = Measurement(options.program, options.data, options.part)
        groups = list(RUNS) if "all" in options.groups else options.groups
        for group in groups:
            before = len(m.records)
            RUNS[group](m)
            if len(m.records) == before:
                sys.exit(f"{group}: gave no figure")
        if options.part:
            return
        git = subprocess.run(["git", "-C", ROOT, "rev-parse", "--short=7", "HEAD"], capture_output=True, text=True)
        for r in m.records:
            r.update(commit=git.stdout.strip(), date=datetime.date.today().isoformat())
        # A figure measured again takes its old place; figures measured by hand stay.
        key = lambda r: (r["group"], r["figure"], r["input"])
        new = {key(r): r for r in m.records}
        records = [new.pop(key(r), r) for r in records] + list(new.values())
        if not git.stdout.strip():
            sys.exit("the figures have no commit: measure in a clone of the repository")
        records.sort(key=lambda r: list(GROUPS).index(r["group"]))
        RECORDS.write_text(json.dumps(records, indent=1, ensure_ascii=False) + "\n")
    TABLE.write_text(table_of(records))


if __name__ == "__main__":
    main()
