# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Runs every pure pair of the project's own kernels on 120,000 inputs: difftest_own_kernels_test.py PORTTOOL.

Each must give the same bits on both sides, and no pair may leave the set unseen: there are at least so many.
"""
import json
import pathlib
import shutil
import subprocess
import sys
import tomllib

LEAST_PAIRS = 95
INPUTS = 120_000
LEAST_INPUTS = 80_000  # that are compared; the others are out of a function's domain


def main():
    if not shutil.which("g++") and not shutil.which("clang++"):
        print("no compiler is installed")
        return 77
    root = pathlib.Path(__file__).resolve().parents[2]
    with open(root / "portmap.toml", "rb") as file:
        mapped = tomllib.load(file)["pair"]
    kernels = [pair["source"] for pair in mapped if "/kernels/" in pair["source"]]
    run = subprocess.run([sys.argv[1], "-C", root, "difftest", *kernels, "--ulps", "0", "--inputs", str(INPUTS),
                          "--format", "json"],
                         capture_output=True, text=True)
    print(run.stderr, end="")
    pairs = [pair for pair in json.loads(run.stdout)["pairs"] if "/kernels/" in pair["source"]]
    same = [pair for pair in pairs if pair["state"] == "same"]
    wrong = [pair for pair in pairs if pair["state"] == "differs" or
             (pair["state"] == "same" and (pair["inputs"] < LEAST_INPUTS or pair["tolerance"] != "bits"
                                           or pair["counterexample"]))]
    for pair in wrong:
        print(json.dumps(pair))
    print(f"{len(same)} pairs of the kernels are the same to the bit, {len(wrong)} are not")
    return 0 if run.returncode == 0 and not wrong and len(same) >= LEAST_PAIRS else 1


if __name__ == "__main__":
    sys.exit(main())
