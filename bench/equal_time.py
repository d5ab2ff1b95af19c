#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""How far from converged a picture is after equal time, of the target core and of Blender's Cycles.

    bench/equal_time.py [-o DIR] [--scenes DIR] [--size 160x90] [--reference 4096] [--times 0.25,1,4,16] [--threads N]
                        [--pathtracer build/release/bin/pathtracer]

Four scenes: `interior` and `city`, which scenes/make_scenes.py writes, and pica and kitchen where --scenes has them (what is
not there is left out, and a line says so). Each renderer is held against its OWN converged picture, of --reference samples
with another seed: how the two read a material is no error here. Error is the RMSE of tone-mapped levels from 0 to 255, as
`pathtracer compare` prints it. Paths of both have up to 8 segments and roulette; Cycles has no denoiser, no clamping, no
adaptive sampling and a box filter.

Time is processor time over the threads, of rendering alone: the slope between the fewest samples and the most, so that
starting, loading and building drop out, and another program on the machine hardly shows. The samples of a time are that time
over the slope; the error between two sample counts is taken from the line through both, in logarithms.

Needs `apt-get install blender python3-numpy`. A picture that is in DIR already is not rendered again.
"""
import argparse
import json
import math
import os
import pathlib
import resource
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from compare_renderers import at_least, cycles_job, fail, need_programs, output_of, run_cycles, size  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Both renderers need camera and sky from outside of the file; these are the ones that make_scenes.py puts there.
CAMERAS = {
    "interior": {"position": [0.0, 1.42, 5.2], "target": [0.0, 1.16, 0.0], "vfov_degrees": 33.0, "sky_radiance": [0, 0, 0]},
    "city": {"position": [9.0, 6.5, 13.0], "target": [0.0, 0.5, 0.0], "vfov_degrees": 40.0, "sky_radiance": [1, 1, 1]},
}
COUNTS = [1, 4, 16, 64, 256]
CONVERGED_SEED = 1


# The scenes: a name, the glTF and the camera file.


def find_scenes(options):
    found = []
    for name, camera in CAMERAS.items():
        folder = options.output / "scenes" / name
        if not (folder / "camera.json").is_file():
            subprocess.run([sys.executable, str(ROOT / "scenes/make_scenes.py"), name, str(folder)], check=True)
            (folder / "camera.json").write_text(json.dumps(camera | {"up": [0.0, 1.0, 0.0]}))
        found.append((name, folder / f"{name}.gltf", folder / "camera.json"))
    for name in ("pica", "kitchen"):
        folder = options.scenes / name
        if (folder / "scene.gltf").is_file():
            found.append((name, folder / "scene.gltf", folder / "camera.json"))
        else:
            print(f"without {name}: there is no {folder / 'scene.gltf'}")
    return found


# The renderers. Each gives {samples: processor seconds} and leaves its pictures as FOLDER/SAMPLES.exr.


def ours(options, scene, camera, folder, counts):
    taken = {}
    for samples in counts:
        command = [options.pathtracer, "render", str(scene), "--camera", str(camera), "--core", "target", "--quiet",
                   "--size", "{}x{}".format(*options.size), "--threads", str(options.threads), "--spp", str(samples),
                   "--seed", str(seed_of(options, samples)), "-o", str(folder / f"{samples}.exr")]
        start = processor_seconds()
        output_of(command)
        taken[samples] = processor_seconds() - start
    return taken


def cycles(options, scene, camera, folder, counts):
    options.scene, options.max_path_length = str(scene), 8
    job = cycles_job(options, json.loads(camera.read_text()))
    job["pictures"] = [{"file": str(folder / f"{samples}.exr"), "samples": samples, "seed": seed_of(options, samples)}
                       for samples in counts]
    return dict(zip(counts, run_cycles(job)["processor_seconds"]))


def seed_of(options, samples):
    return CONVERGED_SEED if samples == options.reference else 0


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def render(renderer, options, scene, camera, folder):
    """The seconds of a sample, and the error by samples. Rendered once; what was found is kept in FOLDER/found.json."""
    kept = folder / "found.json"
    if kept.is_file():
        found = json.loads(kept.read_text())
        return found["seconds"], {int(samples): error for samples, error in found["errors"].items()}
    folder.mkdir(parents=True, exist_ok=True)
    counts = COUNTS + [options.reference]
    taken = renderer(options, scene, camera, folder, counts)
    seconds = (taken[counts[-1]] - taken[counts[0]]) / (counts[-1] - counts[0]) / options.threads
    errors = {samples: rmse(options, folder / f"{samples}.exr", folder / f"{options.reference}.exr") for samples in COUNTS}
    kept.write_text(json.dumps({"seconds": seconds, "errors": errors}, indent=1))
    return seconds, errors


def rmse(options, picture, converged):
    done = subprocess.run([options.pathtracer, "compare", str(picture), str(converged), "--quiet", "--format", "json"],
                          capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):
        fail(f"{picture}: {done.stderr.strip()}")
    return json.loads(done.stdout)["results"][0]["rmse"]


# The table


def error_after(time, seconds, errors):
    """The samples of that time and their error; None beyond what was rendered."""
    samples = time / seconds
    counts = sorted(errors)
    for low, high in zip(counts, counts[1:]):
        if low <= samples <= high:
            part = math.log(samples / low) / math.log(high / low)
            return samples, math.exp((1 - part) * math.log(errors[low]) + part * math.log(errors[high]))
    return samples, None


def cells(time, seconds, errors):
    samples, error = error_after(time, seconds, errors)
    return [f"{samples:.1f}", "-" if error is None else f"{error:.2f}"]


def print_table(options, found):
    head = ["scene", "seconds", "ours: samples", "RMSE", "Cycles: samples", "RMSE", "Cycles' time for our error"]
    print("| " + " | ".join(head) + " |\n| --- |" + " ---: |" * (len(head) - 1))
    for name, (mine, theirs) in found.items():
        for time in options.times:
            _, error = error_after(time, *mine)
            needed = None if error is None else time_for(error, *theirs)
            row = [name, f"{time:g}", *cells(time, *mine), *cells(time, *theirs),
                   "-" if needed is None else f"{needed / time:.2f} times"]
            print("| " + " | ".join(row) + " |")


def time_for(error, seconds, errors):
    """The time after which a renderer has that error; None beyond what was rendered."""
    counts = sorted(errors)
    for low, high in zip(counts, counts[1:]):
        if errors[high] <= error <= errors[low] and errors[high] < errors[low]:
            part = math.log(error / errors[low]) / math.log(errors[high] / errors[low])
            return seconds * low * (high / low) ** part
    return None


def times(text):
    try:
        found = [float(word) for word in text.split(",")]
    except ValueError:
        found = []
    if not found or not all(0 <= time < math.inf for time in found):
        raise argparse.ArgumentTypeError(f"{text}: expected seconds, such as 1,4,16")
    return found


def read_options():
    parser = argparse.ArgumentParser(usage=argparse.SUPPRESS, description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.error = fail
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("out/equal_time"))
    parser.add_argument("--scenes", type=pathlib.Path, default=ROOT.parent / "shared/scenes")
    parser.add_argument("--size", type=size, default=(160, 90))
    parser.add_argument("--reference", type=at_least(2 * COUNTS[-1]), default=4096)
    parser.add_argument("--times", type=times, default=[0.25, 1, 4, 16])
    parser.add_argument("--threads", type=at_least(1), default=os.cpu_count())
    parser.add_argument("--pathtracer", default=str(ROOT / "build/release/bin/pathtracer"))
    options = parser.parse_args()
    need_programs(options)
    options.output = options.output.resolve()
    return options


def main():
    options = read_options()
    found = {}
    for name, scene, camera in find_scenes(options):
        kind = "{}x{}_{}".format(*options.size, options.reference)
        found[name] = [render(renderer, options, scene, camera, options.output / name / kind / renderer.__name__)
                       for renderer in (ours, cycles)]
    print_table(options, found)


if __name__ == "__main__":
    main()
