#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""What `porttool check` answers with its cache is what it answers without, byte for byte: cache_test.py PORTTOOL

On a repository of all fixtures, each edited in turn; with a cache that is damaged, another's, in the repository, or
shared by runs at once.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
FIXTURES = pathlib.Path(__file__).parent / "fixtures"
FORMATS = ("text", "json", "junit", "markdown")


class Cache(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.start = pathlib.Path(cls.folder.name) / "start"
        for side in ("source", "target"):
            (cls.start / side).mkdir(parents=True)
            for fixture in FIXTURES.iterdir():
                if fixture.suffix != ".units":
                    shutil.copy(fixture, cls.start / side)
        made = subprocess.run([PROGRAM, "-C", str(cls.start), "init", "--source", "source/*", "--target", "target/*"],
                              capture_output=True, text=True)
        assert made.returncode == 0, made.stderr
        subprocess.run(["git", "init", "-q", str(cls.start)], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def setUp(self):
        self.root = pathlib.Path(self.folder.name) / "root"
        shutil.copytree(self.start, self.root)
        self.addCleanup(shutil.rmtree, self.root)
        self.home = pathlib.Path(self.folder.name) / "cache"
        self.addCleanup(shutil.rmtree, self.home, True)

    def environment(self, home=None):
        return {**os.environ, "XDG_CACHE_HOME": str(home or self.home), "PORTTOOL_CACHE_FROM": "0"}

    def command(self, *arguments):
        return [PROGRAM, "-C", str(self.root), "check", *arguments]

    def check(self, *arguments, home=None):
        ran = subprocess.run(self.command(*arguments), capture_output=True, env=self.environment(home))
        return ran.returncode, ran.stdout, ran.stderr

    def kept(self):
        return sorted((self.home / "porttool" / "check").glob("*"))

    def assert_same_with_cache(self, *arguments):
        without = self.check("--no-cache", *arguments)
        self.assertIn(without[0], (0, 1, 2))
        for _ in range(2):
            self.assertEqual(self.check(*arguments), without)
        return without

    def test_answers_are_the_same_with_and_without_it(self):
        self.assert_same_with_cache()
        files = sorted([*self.root.glob("source/*"), *self.root.glob("target/*")])
        self.assertGreater(len(files), 20)
        codes = set()
        for number, file in enumerate(files):
            text = file.read_bytes()
            edited = re.sub(rb"\b([1-9][0-9]*)\b(?!.*#)", rb"\g<1>7", text, count=3 + number % 5)
            self.assertNotEqual(edited, text, file)
            file.write_bytes(edited)
            codes.add(self.assert_same_with_cache("--format", FORMATS[number % len(FORMATS)])[0])
            if number % 2 == 0:
                file.write_bytes(text)
        self.assertIn(1, codes)

    def test_everything_that_an_answer_rests_on_is_noticed(self):
        fresh = self.check("--no-cache")
        self.assertEqual(self.check(), fresh)
        victim = self.root / "source" / "rays.comp"
        text = victim.read_bytes()
        times = victim.stat()
        # As long as before and of the same time: content counts alone.
        victim.write_bytes(text.replace(b"0.5", b"0.7", 1) if b"0.5" in text else text.replace(b"1", b"3", 1))
        os.utime(victim, ns=(times.st_atime_ns, times.st_mtime_ns))
        self.assertEqual(self.assert_same_with_cache()[0], 1)
        victim.write_bytes(text)
        self.assertEqual(self.check(), fresh)
        for change in (lambda: (self.root / "source" / "new.glsl").write_text("float fresh_one(float x) { return x * 7.5 + x; }\n"),
                       lambda: victim.unlink(),
                       lambda: (self.root / ".gitignore").write_text("hard.cu\n"),
                       lambda: subprocess.run(["git", "-C", str(self.root), "add", "-f", "source/hard.cu"], check=True),
                       lambda: (self.root / "portmap.base").rename(self.root / "elsewhere"),
                       lambda: (self.root / "portmap.lock").unlink(),
                       lambda: (self.root / "portmap.toml").write_text("nonsense")):
            change()
            last = self.assert_same_with_cache()
        self.assertEqual(last[0], 2)

    def test_a_day_ends_what_was_put_off(self):
        victim = self.root / "source" / "rays.comp"
        text = victim.read_text()
        victim.write_text(re.sub(r"\b2\b", "5", text, count=1) if re.search(r"\b2\b", text) else text.replace("1", "5", 1))
        report = subprocess.run(self.command("--format", "json", "--no-cache"), capture_output=True, text=True).stdout
        found = re.search(r'"fingerprint": ?"([0-9a-f]+)"', report).group(1)
        put_off = subprocess.run([PROGRAM, "-C", str(self.root), "defer", found, "--owner", "me", "--until", "2026-05-01",
                                  "--reason", "later"], capture_output=True, text=True,
                                 env={**os.environ, "SOURCE_DATE_EPOCH": "1767225600"})
        self.assertEqual(put_off.returncode, 0, put_off.stderr)
        outputs = []
        for day in ("1767225600", "1798761600"):  # 2026-01-01 and 2027-01-01
            os.environ["SOURCE_DATE_EPOCH"] = day
            self.addCleanup(os.environ.pop, "SOURCE_DATE_EPOCH", None)
            outputs.append(self.assert_same_with_cache())
        self.assertNotEqual(outputs[0], outputs[1])

    def test_a_damaged_cache_is_thrown_away(self):
        fresh = self.check()
        (entry,) = self.kept()
        good = entry.read_bytes()
        self.assertIn(fresh[1], good)
        for damage in (b"", good[:50], good[:-1], good[:-20] + b"x" * 20, b"\0" * len(good),
                       good.replace(b"in_step", b"in step", 1)):
            entry.write_bytes(damage)
            self.assertEqual(self.check(), fresh)
            self.assertEqual(self.kept(), [entry])
            self.assertNotEqual(entry.read_bytes(), damage, "a good one takes its place")

    def test_what_others_can_write_is_not_read(self):
        fresh = self.check()
        (entry,) = self.kept()
        first = entry.stat().st_ino
        self.assertEqual(self.check(), fresh)
        self.assertEqual(entry.stat().st_ino, first, "read, and so not written anew")
        there = entry.parent.parent / "there"
        for spoil in (lambda: entry.chmod(0o666), lambda: (entry.rename(there), entry.symlink_to(there))):
            spoil()
            spoilt = entry.lstat().st_ino
            self.assertEqual(self.check(), fresh)
            self.assertNotEqual(entry.lstat().st_ino, spoilt, "a file of our own takes its place")
            self.assertFalse(entry.is_symlink())
            self.assertEqual(entry.stat().st_mode & 0o777, 0o600)

    def test_no_cache_lies_in_the_repository(self):
        fresh = self.check("--no-cache")
        for home in (self.root, self.root / "source" / ".cache"):
            self.assertEqual(self.check(home=home), fresh)
            self.assertFalse((home / "porttool").exists())
        link = pathlib.Path(self.folder.name) / "link"
        link.symlink_to(self.root)
        self.addCleanup(link.unlink)
        self.assertEqual(self.check(home=link), fresh)
        self.assertFalse((self.root / "porttool").exists())
        self.check("--no-cache")
        self.assertEqual(self.kept(), [], "--no-cache keeps nothing")

    def test_runs_at_once_do_not_disturb_each_other(self):
        fresh = self.check("--no-cache")
        for _ in range(3):
            shutil.rmtree(self.home, ignore_errors=True)
            running = [subprocess.Popen(self.command(), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                        env=self.environment()) for _ in range(6)]
            for process in running:
                out, err = process.communicate()
                self.assertEqual((process.returncode, out, err), fresh)
            self.assertEqual(len(self.kept()), 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
