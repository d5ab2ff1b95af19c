#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Moments of animated glTF files, as the target core and as Blender's Cycles draw them.

    bench/beside_blender.py SCENE... [-o DIR] [--times 0,0.3,0.8] [--size 240x180] [--spp 64] [--pathtracer PROGRAM]

Both draw each file at each time, in seconds, from where ours looks at time 0 unless told otherwise, under a dim sky and a
lamp above the camera.
Prints the SSIM of the two pictures (DIR/NAME/TIME has them and their difference), and that of each with its own first
moment, which says how much there is to see: two programs that stand still would agree as well. What Cycles and we read
differently of a material shows at every time alike. Needs `apt-get install blender python3-numpy`.
"""
import argparse
import json
import math
import os
import pathlib
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from compare_renderers import at_least, cycles_job, fail, need_programs, run_cycles, size  # noqa: E402
from equal_time import times  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
LOOK_AT = re.compile(r"--look-at ([-+.,e\d]+)")
DIM = [0.3, 0.3, 0.3]


def view_of(options, scene):
    """Where ours stands and looks to when it is told nothing: it says so on stderr."""
    done = subprocess.run([options.pathtracer, "render", scene, "--core", "target", "--size", "8x8", "--spp", "1", "--sky", "1,1,1",
                           "-o", options.output / "view.png"], capture_output=True, text=True, check=False)
    found = LOOK_AT.search(done.stderr)
    if done.returncode != 0 or found is None:
        fail(f"{scene}: " + (done.stderr.strip().splitlines() or ["no view is said"])[-1])
    numbers = [float(word) for word in found[1].split(",")]
    eye, target = numbers[:3], numbers[3:6]
    return {"position": eye, "target": target, "up": [0.0, 1.0, 0.0], "vfov_degrees": 40.0, "sky_radiance": DIM,
            "area_lights": [lamp(eye, target)]}


def lamp(eye, target):
    """A square that faces down, as high above the camera as that is away, moved a quarter of the way to what it looks at."""
    away = math.dist(eye, target)
    middle = [e + 0.25 * (t - e) for e, t in zip(eye, target)]
    x, y, z, half = middle[0], eye[1] + away, middle[2], away / 4
    corners = [[x - half, y, z - half], [x + half, y, z - half], [x + half, y, z + half], [x - half, y, z + half]]
    return {"corners": corners, "normal": [0.0, -1.0, 0.0], "radiance": [12.0, 12.0, 12.0]}


def ours(options, scene, camera, folder):
    for seconds in options.times:
        file = folder / f"ours_{seconds:g}.exr"
        done = subprocess.run([options.pathtracer, "render", scene, "--camera", folder / "camera.json", "--core", "target", "--quiet",
                               "--time", str(seconds), "--size", "{}x{}".format(*options.size), "--spp", str(options.spp),
                               "-o", file], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            fail(f"{scene}: {done.stderr.strip()}")


def cycles(options, scene, camera, folder):
    options.scene = scene
    job = cycles_job(options, camera)
    job["pictures"] = [{"file": str(folder / f"cycles_{seconds:g}.exr"), "samples": options.spp, "seed": 0, "seconds": seconds}
                       for seconds in options.times]
    run_cycles(job)


def ssim(options, one, other, *more):
    done = subprocess.run([options.pathtracer, "compare", one, other, "--quiet", "--format", "json", *more], capture_output=True,
                          text=True, check=False)
    if done.returncode not in (0, 1):
        fail(f"{one}: {done.stderr.strip()}")
    return json.loads(done.stdout)["results"][0]["ssim"]


def read_options():
    parser = argparse.ArgumentParser(usage=argparse.SUPPRESS, description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.error = fail
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("out/beside_blender"))
    parser.add_argument("--times", type=times, default=[0.0, 0.3, 0.8])
    parser.add_argument("--size", type=size, default=(240, 180))
    parser.add_argument("--spp", type=at_least(1), default=64)
    parser.add_argument("--threads", type=at_least(1), default=os.cpu_count())
    parser.add_argument("--pathtracer", default=str(ROOT / "build/release/bin/pathtracer"))
    options = parser.parse_args()
    need_programs(options)
    options.output = options.output.resolve()
    options.output.mkdir(parents=True, exist_ok=True)
    options.max_path_length = 8
    return options


def main():
    options = read_options()
    print("| file | seconds | SSIM of the two | ours with its first | Cycles with its first |\n| --- | ---: | ---: | ---: | ---: |")
    for scene in options.scenes:
        name = pathlib.Path(scene).stem
        folder = options.output / name
        folder.mkdir(exist_ok=True)
        camera = view_of(options, scene)
        (folder / "camera.json").write_text(json.dumps(camera))
        for draw in (ours, cycles):
            draw(options, scene, camera, folder)
        first = options.times[0]
        for seconds in options.times:
            mine, theirs = (folder / f"{who}_{seconds:g}.exr" for who in ("ours", "cycles"))
            both = ssim(options, mine, theirs, "-o", str(folder / f"{seconds:g}"))
            moved = [ssim(options, folder / f"{who}_{first:g}.exr", file) for who, file in (("ours", mine), ("cycles", theirs))]
            print(f"| {name} | {seconds:g} | {both:.4f} | {moved[0]:.4f} | {moved[1]:.4f} |", flush=True)


if __name__ == "__main__":
    main()
