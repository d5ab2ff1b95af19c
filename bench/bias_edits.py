#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Holds `pathtracer compare --bias` to what it promises.

Plants biases of 1 % in ten kernels of the source core (nothing is built: --kernels), and edits that change the noise
and not the mean. A bias has to be found in one of the scenes where it shows; a harmless edit must not be called a
difference in any. --equal N compares the two cores as they are N times, each time with another seed, and counts alarms.
Exit code 1 where one of these does not hold.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from compare_renderers import at_least, fail  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
MOST_ALARMS = 5 / 1000

# File, text that stands there once, text in its place.
BIASED = [
    ("generate.glsl", "throughput.weight = vec3(1.0f);", "throughput.weight = vec3(1.01f);"),
    ("extend.glsl", "throughput.weight * sky.radiance", "throughput.weight * 1.01f * sky.radiance"),
    ("shade.glsl", "light.radiance * share;", "light.radiance * (1.01f * share);"),
    ("connect.glsl", "+ load_shadow_contribution(job)", "+ load_shadow_contribution(job) * 1.01f"),
    ("finalize.glsl", "sum * pass.sample_scale", "sum * (1.01f * pass.sample_scale)"),
    ("lights.glsl", "light.pdf = vertex2_row.w * distance_squared", "light.pdf = 0.99f * vertex2_row.w * distance_squared"),
    ("sky.glsl", "sky.radiance = sky_map_radiance(coordinates);", "sky.radiance = sky_map_radiance(coordinates) * 1.01f;"),
    ("material.glsl", "material.base_color = vec3(base_color) * vec3(surface.color);",
     "material.base_color = vec3(base_color) * vec3(surface.color) * 0.99f;"),
    ("bsdf.glsl", "result.value = (bsdf.diffuse_color * leaving + bsdf.again_reflected) * above;",
     "result.value = (bsdf.diffuse_color * leaving + bsdf.again_reflected) * (1.01f * above);"),
    ("texture.glsl", "sample_texture(floatBitsToUint(row_u.w), moved, footprint)",
     "sample_texture(floatBitsToUint(row_u.w), moved, footprint) * 0.99f"),
]
HARMLESS = [
    ("generate.glsl", "Float(column) + jitter.x", "Float(column) + (1.0f - jitter.x)"),
    ("shade.glsl", "pass.segment >= 3u", "pass.segment >= 2u"),
    ("shade.glsl", "clamp(max_component(weight), 0.05f, 1.0f)", "clamp(max_component(weight), 0.2f, 1.0f)"),
    ("bsdf.glsl", "Float diffuse = max_component(material.base_color) * opaque * entering;",
     "Float diffuse = max_component(material.base_color) * opaque * entering * 0.8f;"),
    ("random.glsl", "0x9e3779b9u", "0x7f4a7c15u"),
]


def scenes_of(parity):
    return {"still_life": ["still_life", "--size", "128x72"],
            "its floor": ["still_life", "--look-at", "0,1.6,1.8,0,0,0.3", "--size", "128x72"],  # which has the texture
            "parity": [f"{parity}/parity.gltf", "--sky", f"{parity}/sky.hdr", "--size", "128x72"]}


def ask(program, scene, more):
    """The object `bias`; fails with what the program says."""
    done = subprocess.run([program, "compare", *scene, "--bias", "--format", "json", "--quiet", *more],
                          capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1) or not done.stdout.startswith("{"):
        said = done.stderr.strip().splitlines()
        fail(said[0] if said else f"{program} compare ended with exit code {done.returncode} and no answer")
    return json.loads(done.stdout)["bias"]


def told(bias):
    return f"{bias['verdict']}, p = {bias['p_value']:.2g}, {100 * bias['mean_difference'] / bias['mean']:+.2f} %"


def try_edits(arguments, scenes):
    """The number of wrong answers."""
    edits = [(True, e) for e in BIASED] + [(False, e) for e in HARMLESS]
    edits = [edit for edit in edits if arguments.only in (None, edit[1][0])]
    wrong = 0
    kernels = ROOT / "source_core/kernels"
    with tempfile.TemporaryDirectory() as folder:
        for is_bias, (file, old, new) in edits:
            edited = pathlib.Path(folder) / "kernels"
            shutil.rmtree(edited, ignore_errors=True)
            shutil.copytree(kernels, edited)
            text = (edited / file).read_text()
            if text.count(old) != 1:
                fail(f"{file} has {text.count(old)} times: {old}; adapt the list to the kernels")
            (edited / file).write_text(text.replace(old, new))
            found = []
            for name, scene in scenes.items():
                bias = ask(arguments.program, scene, ["--spp", str(arguments.spp), "--kernels", str(edited)])
                found.append(bias["verdict"] == "differ")
                print(f"  {name}: {told(bias)}", flush=True)
                if is_bias and found[-1]:
                    break
            right = any(found) == is_bias
            wrong += not right
            print(f"{'right' if right else 'WRONG'}: {'1 % in ' if is_bias else 'harmless, '}{file}: {new}", flush=True)
    print(f"{len(edits) - wrong} of {len(edits)} right")
    return wrong


def compare_equal(arguments):
    """The number of alarms among comparisons of the cores as they are, each with seeds of its own."""
    verdicts, lowest = {}, 1.0

    def one(seed):
        return ask(arguments.program, ["still_life", "--size", arguments.equal_size],
                   ["--spp", "16", "--seed", str(seed), "--threads", "1"])

    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for done, bias in enumerate(pool.map(one, range(arguments.equal)), 1):
            verdicts[bias["verdict"]] = verdicts.get(bias["verdict"], 0) + 1
            lowest = min(lowest, bias["p_value"])
            if done % 50 == 0:
                print(f"{done}: {verdicts}, lowest p = {lowest:.2g}", flush=True)
    alarms = verdicts.get("differ", 0)
    print(f"{alarms} alarms in {arguments.equal} comparisons of equal cores, lowest p = {lowest:.2g}")
    return alarms


def read_options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.error = fail
    parser.add_argument("--program", default=str(ROOT / "build/release/bin/pathtracer"))
    parser.add_argument("--parity", default=str(ROOT / "build/release/tests/application/parity"),
                        help="folder of the parity scene (scenes/make_scenes.py parity DIR)")
    parser.add_argument("--spp", type=at_least(16), default=512, help="16 batches or more make a verdict (512)")
    parser.add_argument("--only", metavar="FILE", help="the edits of one kernel file")
    parser.add_argument("--equal", type=at_least(0), default=0, metavar="N", help="compare equal cores N times instead")
    parser.add_argument("--equal-size", default="64x36")
    parser.add_argument("--jobs", type=at_least(1), default=2)
    arguments = parser.parse_args()
    edited = sorted({edit[0] for edit in BIASED + HARMLESS})
    if arguments.only not in (None, *edited):
        fail(f"--only {arguments.only}: no edit is of that file; name one of {', '.join(edited)}")
    if not os.access(arguments.program, os.X_OK) or os.path.isdir(arguments.program):
        fail(f"there is no program {arguments.program}; build it, or name it with --program")
    return arguments


def main():
    arguments = read_options()
    if arguments.equal > 0:
        return int(compare_equal(arguments) > max(1, MOST_ALARMS * arguments.equal))
    for file in ("parity.gltf", "sky.hdr"):
        if not os.path.isfile(f"{arguments.parity}/{file}"):
            fail(f"there is no {arguments.parity}/{file}; make it with scenes/make_scenes.py parity, or name its folder with --parity")
    return int(try_edits(arguments, scenes_of(arguments.parity)) > 0)


if __name__ == "__main__":
    sys.exit(main())
