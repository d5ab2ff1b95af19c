# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Every source of ours is as clang-format 14 writes it, by the file in the root; kernels in GLSL as well.

Exit code 77, which is a skipped test, where that version is not installed: others write some things otherwise.
"""
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
HOUSE = ("application", "bench", "metrics", "packaging", "porttool", "render_system", "source_core", "target_core", "tests")
SUFFIXES = {".cpp", ".h", ".comp", ".glsl"}
FOREIGN = "fixtures"  # other people's ways of writing, made for the tests
VERSION = "version 14."


def is_ours(path):
    return path.suffix in SUFFIXES and FOREIGN not in path.relative_to(ROOT).parts


def main():
    program = shutil.which("clang-format-14") or shutil.which("clang-format")
    if not program or VERSION not in subprocess.run([program, "--version"], capture_output=True, text=True).stdout:
        print(f"skipped: no clang-format {VERSION.split()[1]}")
        return 77
    files = sorted(str(path) for folder in HOUSE for path in (ROOT / folder).rglob("*") if is_ours(path))
    assert files, "no sources found"
    run = subprocess.run([program, "--dry-run", "--Werror", *files], capture_output=True, text=True)
    print(run.stderr, end="")
    if run.returncode:
        print(f"run: {pathlib.Path(program).name} -i on the files above")
    return 1 if run.returncode else 0


if __name__ == "__main__":
    sys.exit(main())
