#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""bench/mined_ports.py on a history whose ports are known: mined_ports_test.py PORTTOOL."""
import os
import pathlib
import subprocess
import sys
import tempfile
import tomllib
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent
PORTTOOL = str(pathlib.Path(sys.argv[1]).resolve())
KERNEL = "__global__ void add(float* a, const float* b, int n) {\n  int i = threadIdx.x;\n  if (i < n) a[i] += b[i];\n}\n"


class History:
    """Commits at minutes of a day, each of some files that it adds or changes."""

    def __init__(self, folder):
        self.folder = folder
        self.git("init", "-q")

    def git(self, *words, minute=0, author="A"):
        time = f"{1600000000 + 60 * minute} +0000"
        environment = {**os.environ, "GIT_AUTHOR_DATE": time, "GIT_COMMITTER_DATE": time, "GIT_AUTHOR_NAME": author,
                       "GIT_AUTHOR_EMAIL": "a@example.org", "GIT_COMMITTER_NAME": "C", "GIT_COMMITTER_EMAIL": "c@example.org",
                       "GIT_CONFIG_GLOBAL": os.devnull}
        return subprocess.run(["git", "-C", str(self.folder), *words], check=True, capture_output=True, text=True,
                              env=environment).stdout.strip()

    def commit(self, minute, files, author="A"):
        for name, text in files.items():
            file = self.folder / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)
        self.git("add", "-A")
        self.git("commit", "-q", "-m", f"minute {minute}", minute=minute, author=author)
        return self.git("rev-parse", "HEAD")


def mined(folder, *more):
    return subprocess.run([sys.executable, str(ROOT / "bench/mined_ports.py"), str(folder), "--porttool", PORTTOOL, "--name", "Town",
                           *more],
                          capture_output=True, text=True, check=False)


class MinedPorts(unittest.TestCase):
    def test_ports_of_one_sitting_are_taken_and_counted(self):
        with tempfile.TemporaryDirectory() as name:
            history = History(pathlib.Path(name))
            port = KERNEL.replace("__global__ ", "")
            start = history.commit(0, {"src/a-cuda/main.cu": KERNEL, "src/b-cuda/main.cu": KERNEL})
            history.commit(20, {"README": "another author's commit says nothing of this one's time"}, author="B")
            taken = history.commit(30, {"src/a-sycl/main.cpp": port + "int queue;\n"})
            history.commit(31, {"src/b-sycl/main.cpp": port})  # made before the last commit
            history.commit(60, {"src/a-hip/main.hip": KERNEL, "src/b-hip/main.hip": KERNEL})  # two at once
            history.commit(90, {"src/c-omp/main.cpp": port})  # there is no c-cuda
            history.commit(120, {"src/a-sycl/main.cpp": port})  # a change of a port, no new one
            history.commit(120 + 121, {"src/a-omp/main.cpp": port})  # two hours and a minute later
            done = mined(name)
            self.assertEqual(done.returncode, 0, done.stderr)
            records = tomllib.loads(done.stdout)["effort"]
            self.assertEqual(len(records), 1, done.stdout)
            record = records[0]
            self.assertEqual(record["what"], "a from CUDA to SYCL, Town, 2020-09-13")
            self.assertEqual(record["to"], taken)
            self.assertNotEqual(record["from"], start)
            self.assertEqual((record["lines"], record["novel"]), (5, 1))
            self.assertEqual(record["port"], {"coding": 0.5})
            self.assertEqual(record["impediments"], {"H": 0, "E": 0.5})
            self.assertTrue(record["mined"])
            with_all = tomllib.loads(mined(name, "--least", "0", "--most", "3").stdout)["effort"]
            self.assertEqual({record["what"].split(",")[0] for record in with_all},
                             {"a from CUDA to SYCL", "b from CUDA to SYCL", "a from CUDA to OMP"})
            self.assertEqual(mined(name, "--each", "0").stdout, "")

    def test_what_is_no_repository_is_refused(self):
        with tempfile.TemporaryDirectory() as name:
            done = mined(pathlib.Path(name) / "none")
            self.assertEqual(done.returncode, 2)
            self.assertIn("none: git log", done.stderr)
            self.assertNotIn("Traceback", done.stderr)

    def test_nonsense_is_one_line(self):
        with tempfile.TemporaryDirectory() as name:
            History(pathlib.Path(name)).commit(0, {"README": "no port"})
            for words, said in ((["--each", "-1"], "-1: expected a whole number"), (["--least", "nan"], "nan: expected hours"),
                                (["--least", "2", "--most", "1"], "--least 2 is above --most 1"), (["--porttool", name], "no program"),
                                (["--nosuch"], "unrecognized")):
                done = mined(name, *words)
                self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)
                self.assertIn(said, done.stderr)
            empty = mined(name)
            self.assertEqual((empty.returncode, empty.stdout), (0, ""))
            self.assertIn("has no commit that adds", empty.stderr)

    def test_odd_names_stay_toml(self):
        with tempfile.TemporaryDirectory() as name:
            history = History(pathlib.Path(name))
            history.commit(0, {"src/a-cuda/main.cu": KERNEL})
            history.commit(30, {"src/a-hip/main.hip": KERNEL})
            record, = tomllib.loads(mined(name, "--name", 'T"o\\wn').stdout)["effort"]
            self.assertEqual(record["what"], 'a from CUDA to HIP, T"o\\wn, 2020-09-13')


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
