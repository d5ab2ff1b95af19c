#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""memory_test.py PORTTOOL: what `init` and `check` take at their peak of files that are nothing but tiny units.

Work of this kind is counted by porttool_work_tests; what lives at one time is not. 512 KiB on each side, all of it
edited: with --base a unit is there four times, by facts that are kept of files or by the scanned files.
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

BYTES, MIB = 512 << 10, 1 << 20
TEXTS = {"functions of a letter": "a(){{{}}}\n", "definitions of one macro": "#define N ({} + 1)\n"}
# MiB; about a tenth more than was seen. At eight times the size, the 4 MiB a side that docs/security.md speaks of, `init`
# of functions takes 870, `check` 560 and `check --base` 925, below 1 GiB: they grow with the text.
MOST = {
    ("functions of a letter", "1", "init"): 150,
    ("functions of a letter", "1", "check"): 165,
    ("functions of a letter", "1", "check --base HEAD"): 245,
    ("functions of a letter", "99999999", "check --base HEAD"): 226,
    ("definitions of one macro", "1", "init"): 85,
    ("definitions of one macro", "1", "check"): 100,
    ("definitions of one macro", "1", "check --base HEAD"): 140,
}


class Repository:
    def __init__(self, folder):
        self.root = pathlib.Path(folder) / "repository"
        self.home = pathlib.Path(folder) / "home"
        for name in ("s", "t"):
            (self.root / name).mkdir(parents=True)

    def write(self, line, source, target):
        count = BYTES // len(line.format("1"))
        (self.root / "s" / "a.cu").write_text(line.format(source) * count, encoding="utf-8")
        (self.root / "t" / "a.cpp").write_text(line.format(target) * count, encoding="utf-8")

    def git(self, *arguments):
        subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@b", *arguments], cwd=self.root, check=True,
                       stdout=subprocess.DEVNULL)

    def peak(self, cache_from, *arguments):
        """In MiB; and the exit code."""
        environment = {**os.environ, "XDG_CACHE_HOME": str(self.home), "PORTTOOL_CACHE_FROM": cache_from}
        process = subprocess.Popen([PROGRAM, *arguments], cwd=self.root, env=environment, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        return usage.ru_maxrss * 1024 / MIB, process.returncode


class Memory(unittest.TestCase):
    def test_of_tiny_units_has_a_bound(self):
        for name, line in TEXTS.items():
            with tempfile.TemporaryDirectory() as folder:
                repository = Repository(folder)
                repository.write(line, "1", "1")
                peak, code = repository.peak("1", "init", "--source", "s/**", "--target", "t/**")
                self.assertEqual(code, 0)
                self.assertLess(peak, MOST[name, "1", "init"])
                for command in (["init", "-q"], ["add", "."], ["commit", "-qm", "before"]):
                    repository.git(*command)
                repository.write(line, "9", "8")
                for (text, cache_from, command), most in MOST.items():
                    if text != name or command == "init":
                        continue
                    peak, code = repository.peak(cache_from, *command.split())
                    with self.subTest(text=text, cache_from=cache_from, command=command):
                        self.assertIn(code, (0, 1))
                        self.assertLess(peak, most)


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv.pop())
    unittest.main()
