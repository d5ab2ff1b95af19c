# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""bench/replay.py on a history whose drift is known: replay_test.py PORTTOOL."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent
PORTTOOL = str(pathlib.Path(sys.argv[1]).resolve())
KERNEL = ("__global__ void scale(float* a, const float* b, int n) {\n  int i = threadIdx.x;\n"
          "  if (i < n) a[i] = a[i] * 2.0f + b[i] * b[i];\n}\n")
PORT = ("void scale(float* a, const float* b, int n) {\n  for (int i = 0; i < n; ++i) {\n"
        "    a[i] = a[i] * 2.0f + b[i] * b[i];\n  }\n}\n")


def replay(*words):
    return subprocess.run([sys.executable, str(ROOT / "bench/replay.py"), *(str(word) for word in words), "--porttool", PORTTOOL],
                          capture_output=True, text=True, check=False)


class Replay(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = pathlib.Path(kept.name)
        (self.folder / "clones/town").mkdir(parents=True)
        self.git("init", "-q")

    def git(self, *words):
        identity = {"GIT_AUTHOR_NAME": "A", "GIT_AUTHOR_EMAIL": "a@example.org", "GIT_COMMITTER_NAME": "A",
                    "GIT_COMMITTER_EMAIL": "a@example.org", "GIT_CONFIG_GLOBAL": os.devnull}
        return subprocess.run(["git", "-C", str(self.folder / "clones/town"), *words], check=True, capture_output=True, text=True,
                              env={**os.environ, **identity}).stdout.strip()

    def commit(self, files):
        for name, text in files.items():
            file = self.folder / "clones/town" / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "edit")
        return self.git("rev-parse", "HEAD")

    def replayed(self, *commits):
        lines = ["# a comment", *(f"someone/town\t{commit}\tgpu/**/*.{{cu,cuh}}\tcpu/*.cpp" for commit in commits)]
        (self.folder / "list.tsv").write_text("\n".join(lines) + "\n")
        return replay(self.folder / "list.tsv", "--clones", self.folder / "clones", "-o", self.folder / "out.json")

    def test_findings_are_shown_and_counted_by_what_a_reader_says(self):
        self.commit({"gpu/in/scale.cu": KERNEL, "cpu/scale.cpp": PORT, "cpu/other/scale.cpp": PORT})
        both = self.commit({"gpu/in/scale.cu": KERNEL.replace("2.0f", "4.0f"), "cpu/scale.cpp": PORT.replace("2.0f", "4.0f")})
        one_side = self.commit({"gpu/in/scale.cu": KERNEL.replace("2.0f", "3.0f"), "cpu/other/scale.cpp": "nobody asks"})
        done = self.replayed(one_side, both[:12])
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        drift, in_step = json.loads((self.folder / "out.json").read_text())
        self.assertEqual((drift["exit_code"], drift["verdict"], drift["summary"]["pairs"]), (1, "drift", 1))
        self.assertEqual([(finding["rule"], finding["source"]["id"]) for finding in drift["findings"]],
                         [("source-changed", "gpu/in/scale.cu:scale")])
        self.assertEqual((in_step["commit"], in_step["findings"], drift["parent"]), (both, [], both))

        shown = replay(self.folder / "out.json", "--show", "--template", self.folder / "labels.json")
        self.assertIn("-  if (i < n) a[i] = a[i] * 4.0f + b[i] * b[i];\n+  if (i < n) a[i] = a[i] * 3.0f", shown.stdout)
        self.assertIn("not edited:\nvoid scale", shown.stdout)
        labels = json.loads((self.folder / "labels.json").read_text())
        self.assertEqual(labels[0]["unit"], "gpu/in/scale.cu:scale=cpu/scale.cpp:scale")
        labels[0]["label"] = "true"
        labels.append({"commit": both, "rule": "unported", "unit": "gpu/in/scale.cu:gone", "label": "false"})
        (self.folder / "labels.json").write_text(json.dumps(labels))
        counted = replay(self.folder / "out.json", "--labels", self.folder / "labels.json").stdout
        self.assertRegex(counted, r"(?m)^source-changed +error +1 +0 +0 +0$")
        self.assertIn("red commits with a true error: 1 of 1, of 2 replayed", counted)
        self.assertIn("labelled, and no finding now: 1 false", counted)

    def test_what_cannot_be_replayed_is_said(self):
        first = self.commit({"gpu/scale.cu": KERNEL, "cpu/scale.cpp": PORT})
        self.assertEqual(self.replayed(first).returncode, 0)  # it has no parent; the others of a list go on
        self.assertIn("rev-parse", json.loads((self.folder / "out.json").read_text())[0]["failed"])
        (self.folder / "list.tsv").write_text("someone/village\tHEAD\ta\tb\n")
        for words, told in ((["list.tsv"], "needs --clones"), (["list.tsv", "--clones", self.folder / "clones", "-o", "o"], "village"),
                            (["none.tsv", "--clones", self.folder / "clones", "-o", "o"], "none.tsv")):
            done = replay(self.folder / words[0], *words[1:])
            self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
            self.assertIn(told, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
