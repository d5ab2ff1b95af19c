#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""How long porttool compare takes beside sim_c++ (Debian's similarity-tester) on the same two files.

    bench/compare_speed.py [--porttool build/release/bin/porttool] [--lines 100000] [--runs 3]

Makes a CUDA text and its GLSL port, two thirds of whose functions follow the original, in a temporary folder; runs both
programs in turn; prints the least wall time and processor time of each, and their ratio.
"""
import argparse
import os
import random
import resource
import shutil
import subprocess
import sys
import tempfile
import time

NAMES = ["ray", "hit", "normal", "weight", "pdf", "albedo", "throughput", "sample", "light", "radiance", "cosine"]
CALLS = ["max", "min", "clamp", "dot", "sqrt", "abs", "pow", "evaluate_lobe", "fetch_texel", "sample_table"]


def expression(dice, depth):
    if depth == 0:
        return dice.choice([dice.choice(NAMES), f"{dice.randint(0, 99)}.{dice.randint(0, 9)}f", f"state.{dice.choice(NAMES)}"])
    if dice.random() < 0.4:
        return f"{dice.choice(CALLS)}({expression(dice, depth - 1)}, {expression(dice, depth - 1)})"
    return f"{expression(dice, depth - 1)} {dice.choice('+-*/')} {expression(dice, 0)}"


def function(seed, number):
    """The lines of one function; the same seed gives the same text."""
    dice = random.Random(seed)
    lines = [f"__device__ float3 shade_{number}(float3 ray, float3 normal, float weight) {{"]
    for at in range(dice.randint(6, 30)):
        kind = dice.random()
        if kind < 0.15:
            lines += [f"    if ({expression(dice, 1)} < {expression(dice, 0)}) {{", f"        return {expression(dice, 1)};", "    }"]
        elif kind < 0.2:
            lines.append(f"    // step {at}")
        else:
            lines.append(f"    float {dice.choice(NAMES)}_{at} = {expression(dice, dice.randint(1, 2))};")
    return lines + ["    return make_float3(weight, weight, weight);", "}", ""]


def text(line_count, ported):
    lines, number = [], 0
    while len(lines) < line_count:
        follows = number % 3 != 0
        seed = number if follows or not ported else 1_000_000 + number
        body = "\n".join(function(seed, number))
        if ported:
            body = body.replace("make_float3", "vec3").replace("float3", "vec3").replace("__device__ ", "")
        lines += body.split("\n")
        number += 1
    return "\n".join(lines[:line_count]) + "\n"


def timed(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.perf_counter()
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=False)
    wall = time.perf_counter() - start
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}: exit code {done.returncode}: {done.stderr.decode()}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--porttool", default="build/release/bin/porttool")
    parser.add_argument("--lines", type=int, default=100_000)
    parser.add_argument("--runs", type=int, default=3)
    options = parser.parse_args()
    if shutil.which("sim_c++") is None:
        sys.exit("no sim_c++ here; apt install similarity-tester")
    if not os.path.exists(options.porttool):
        sys.exit(f"no {options.porttool} here; build it, or name it with --porttool")
    with tempfile.TemporaryDirectory() as folder:
        a, b = os.path.join(folder, "a.cu"), os.path.join(folder, "b.glsl")
        for path, ported in ((a, False), (b, True)):
            with open(path, "w", encoding="utf-8") as file:
                file.write(text(options.lines, ported))
        commands = {
            "porttool compare": [options.porttool, "compare", a, b, "--format", "json"],
            "sim_c++": ["sim_c++", "-p", a, b],
        }
        best = {name: (float("inf"), float("inf")) for name in commands}
        for _ in range(options.runs):
            for name, command in commands.items():
                best[name] = tuple(map(min, zip(best[name], timed(command))))
    print(f"{options.lines} lines against {options.lines}, the least of {options.runs} runs")
    for name, (wall, processor) in best.items():
        print(f"{name:<18}{wall:8.3f} s wall{processor:8.3f} s processor")
    wall, processor = (x / y for x, y in zip(best["porttool compare"], best["sim_c++"]))
    print(f"{'ratio':<18}{wall:8.2f}       {processor:8.2f}")


if __name__ == "__main__":
    main()
