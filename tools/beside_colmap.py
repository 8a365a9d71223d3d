#!/usr/bin/python3
# Copyright 2026 The Palpable authors
# SPDX-License-Identifier: Apache-2.0
"""Compares the camera path of a video with that of COLMAP (Debian's package, sparse, without a GPU) on the same frames.

  tools/beside_colmap.py FRAMES [--calibration FILE.json] [--true-poses FILE.csv] [--program palpable] [--overlap N]

FRAMES: a folder of pictures in the order of their names, as palpable_video_set --write writes it. FILE.csv: frame,qw,qx,qy,qz,tx,ty,tz,
world from camera; frames are counted from 0. With true poses it prints errors after a similarity alignment: the position's RMS in percent of the path's
length, and the mean rotation. COLMAP runs with its defaults: SIFT, sequential matching, the calibration fixed if there is one."""
import argparse, csv, json, re, subprocess, sys, tempfile, time
from pathlib import Path

import numpy as np


def run(words):
    begin = time.monotonic()
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{words[0]} {words[1]} failed: {done.stderr.strip()[-400:] or done.stdout.strip()[-400:]}")
    return done, time.monotonic() - begin


def rotation(q):
    w, x, y, z = np.asarray(q, float) / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def read_poses(path):
    """Frame -> (rotation, position), world from camera."""
    with open(path) as file:
        return {int(r["frame"]): (rotation([float(r[k]) for k in ("qw", "qx", "qy", "qz")]),
                                  np.array([float(r[k]) for k in ("tx", "ty", "tz")])) for r in csv.DictReader(file)}


def errors(found, truth):
    """Umeyama 1991 on positions; the rotation from the orientations, which also holds on a straight path."""
    common = sorted(set(found) & set(truth))
    u, _, v = np.linalg.svd(sum(truth[f][0] @ found[f][0].T for f in common))
    turn = u @ np.diag([1, 1, np.sign(np.linalg.det(u @ v))]) @ v
    a, b = np.array([turn @ found[f][1] for f in common]), np.array([truth[f][1] for f in common])
    scale = ((a - a.mean(0)) * (b - b.mean(0))).sum() / ((a - a.mean(0)) ** 2).sum()
    left = scale * (a - a.mean(0)) - (b - b.mean(0))
    path = np.linalg.norm(np.diff([truth[f][1] for f in sorted(truth)], axis=0), axis=1).sum()
    angles = [np.degrees(np.arccos(np.clip((np.trace((turn @ found[f][0]).T @ truth[f][0]) - 1) / 2, -1, 1))) for f in common]
    return 100 * np.sqrt((left ** 2).sum(1).mean()) / path, np.mean(angles)


def of_palpable(arguments, scratch):
    poses = scratch / "poses.csv"
    words = [arguments.program, "make", arguments.frames, "-o", scratch / "scene.palp", "--poses", poses, "--json", "--resolution", "64",
             "--set", "video.depth.maps=4"]
    if arguments.calibration:
        words += ["--calibration", arguments.calibration]
    done, seconds = run(words)
    notes = " ".join(json.loads(done.stdout)["notes"])
    error = re.search(r"reprojection error is ([\d.]+) px", notes)
    return read_poses(poses), float(error.group(1)) if error else float("nan"), seconds


def of_colmap(arguments, names, scratch):
    base, sparse = scratch / "colmap.db", scratch / "sparse"
    sparse.mkdir()
    camera = []
    if arguments.calibration:
        k = json.loads(Path(arguments.calibration).read_text())
        camera = ["--ImageReader.camera_model", "PINHOLE", "--ImageReader.camera_params", f"{k['fx']},{k['fy']},{k['cx'] + 0.5},{k['cy'] + 0.5}"]
    seconds = run(["colmap", "feature_extractor", "--database_path", base, "--image_path", arguments.frames, "--ImageReader.single_camera", 1,
                   "--SiftExtraction.use_gpu", 0] + camera)[1]
    seconds += run(["colmap", "sequential_matcher", "--database_path", base, "--SiftMatching.use_gpu", 0, "--SequentialMatching.overlap",
                    arguments.overlap])[1]
    fixed = ["--Mapper.ba_refine_focal_length", 0, "--Mapper.ba_refine_extra_params", 0] if camera else []
    seconds += run(["colmap", "mapper", "--database_path", base, "--image_path", arguments.frames, "--output_path", sparse] + fixed)[1]
    best, reprojection = {}, float("nan")
    for model in sorted(sparse.iterdir()):
        run(["colmap", "model_converter", "--input_path", model, "--output_path", model, "--output_type", "TXT"])
        lines = [l for l in (model / "images.txt").read_text().splitlines() if not l.startswith("#")][::2]
        poses = {}
        for line in lines:
            words = line.split(maxsplit=9)
            turn = rotation([float(x) for x in words[1:5]]).T
            poses[names.index(words[9])] = (turn, -turn @ np.array([float(x) for x in words[5:8]]))
        if len(poses) > len(best):
            best = poses
            text = run(["colmap", "model_analyzer", "--path", model])[0]
            error = re.search(r"Mean reprojection error: ([\d.]+)px", text.stdout + text.stderr)
            reprojection = float(error.group(1)) if error else float("nan")
    return best, reprojection, seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("frames")
    parser.add_argument("--calibration")
    parser.add_argument("--true-poses")
    parser.add_argument("--program", default="palpable")
    parser.add_argument("--overlap", type=int, default=10)
    arguments = parser.parse_args()
    names = sorted(p.name for p in Path(arguments.frames).iterdir() if p.suffix.lower() in (".png", ".jpg", ".jpeg"))
    truth = read_poses(arguments.true_poses) if arguments.true_poses else None
    print("| program | frames with a pose | position, % of path | rotation, deg | reprojection, px (ours RMS, COLMAP mean) | seconds |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory(prefix="palpable-colmap-") as folder:
        for name, of in (("palpable", lambda s: of_palpable(arguments, s)), ("COLMAP", lambda s: of_colmap(arguments, names, s))):
            scratch = Path(folder) / name
            scratch.mkdir()
            poses, reprojection, seconds = of(scratch)
            position, turned = errors(poses, truth) if truth and len(poses) > 2 else (float("nan"), float("nan"))
            print(f"| {name} | {len(poses)} of {len(names)} | {position:.3f} | {turned:.3f} | {reprojection:.2f} | {seconds:.0f} |", flush=True)


if __name__ == "__main__":
    main()
