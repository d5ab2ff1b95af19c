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
import struct
import subprocess
import sys
import tempfile
import unittest

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
FIXTURES = pathlib.Path(__file__).parent / "fixtures"
FORMATS = ("text", "json", "junit", "markdown")


WORD = (1 << 64) - 1


def siphash(key, data):
    """SipHash-2-4 as its paper has it."""
    k0, k1 = struct.unpack("<QQ", key)
    v = [k0 ^ 0x736F6D6570736575, k1 ^ 0x646F72616E646F6D, k0 ^ 0x6C7967656E657261, k1 ^ 0x7465646279746573]

    def rounds(count):
        a, b, c, d = v
        for _ in range(count):
            a, c = (a + b) & WORD, (c + d) & WORD
            b, d = (b << 13 | b >> 51) & WORD ^ a, (d << 16 | d >> 48) & WORD ^ c
            a = (a << 32 | a >> 32) & WORD
            c, a = (c + b) & WORD, (a + d) & WORD
            b, d = (b << 17 | b >> 47) & WORD ^ c, (d << 21 | d >> 43) & WORD ^ a
            c = (c << 32 | c >> 32) & WORD
        v[:] = a, b, c, d

    whole = len(data) // 8 * 8
    last = int.from_bytes(data[whole:], "little") | (len(data) & 255) << 56
    for word in (*struct.unpack(f"<{whole // 8}Q", data[:whole]), last):
        v[3] ^= word
        rounds(2)
        v[0] ^= word
    v[2] ^= 255
    rounds(4)
    return v[0] ^ v[1] ^ v[2] ^ v[3]


FIRST_LINE = b"porttool files 2\n"
KEY = slice(len(FIRST_LINE), len(FIRST_LINE) + 16)


def sum_of_facts(data):
    """What ends a file of facts: a hash of the hashes of its head and of each file's facts, cut as its table says."""
    key, at = data[KEY], KEY.stop
    try:
        at += 8 + struct.unpack_from("<Q", data, at)[0]
        count = struct.unpack_from("<Q", data, at)[0]
        sizes = [struct.unpack_from("<Q", data, at + 16 + 16 * i)[0] for i in range(count)]
    except struct.error:
        return struct.pack("<Q", siphash(key, data))
    ends = [at + 8 + 16 * count]
    for size in sizes:
        ends.append(ends[-1] + size)
    pieces = [data[first:end] for first, end in zip([0, *ends], ends)]
    return struct.pack("<Q", siphash(key, b"".join(struct.pack("<Q", siphash(key, piece)) for piece in pieces)))


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

    def kept(self, what="check"):
        return sorted((self.home / "porttool" / what).glob("*"))

    def forget_answers(self):
        shutil.rmtree(self.home / "porttool" / "check", True)

    def facts(self):
        """The file of facts, after a check that kept it."""
        self.check()
        self.forget_answers()
        (entry,) = self.kept("files")
        return entry

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
        self.assertEqual((self.kept(), self.kept("files")), ([], []), "--no-cache keeps nothing")

    def test_facts_of_files_are_used_and_what_they_say_is_theirs_alone(self):
        """Whoever can write the owner's files can lie; that a lie shows is how we know that facts are used."""
        entry = self.facts()
        good = entry.read_bytes()
        self.assertTrue(good.startswith(FIRST_LINE))
        self.assertEqual(sum_of_facts(good[:-8]), good[-8:])
        victim = self.root / "source" / "rays.comp"
        victim.write_bytes(victim.read_bytes() + b"\nint new_one(int x) { return x + 1; }\n")
        fresh = self.check("--no-cache")
        self.assertIn(b"new_one", fresh[1])
        lie = good[:-8]
        names = re.findall(rb"(?<=\x08\0\0\0\0\0\0\0)[a-z_]{8}(?=[\0-\4]..\0\0..\0\0)", lie, re.S)
        self.assertTrue(names, "a unit's name, kind and lines")
        lie = lie.replace(b"\x08" + b"\0" * 7 + names[0], b"\x08" + b"\0" * 7 + b"made__up")
        entry.write_bytes(lie + sum_of_facts(lie))
        self.assertIn(b"made__up", self.check()[1])
        entry.write_bytes(lie + good[-8:])
        self.forget_answers()
        self.assertEqual(self.check(), fresh)

    def test_facts_that_are_damaged_anothers_or_of_another_program_only_cost_time(self):
        entry = self.facts()
        good = entry.read_bytes()
        self.home, mine = self.home.with_name("other"), self.home
        self.addCleanup(shutil.rmtree, self.home, True)
        others = self.facts().read_bytes()  # of another key
        self.home = mine
        start = KEY.start
        request = good[start + 24:start + 24 + struct.unpack("<Q", good[start + 16:start + 24])[0]]

        def with_sum(data):
            return data + sum_of_facts(data)

        count_at = start + 24 + len(request)
        damages = [b"", FIRST_LINE, good[:50], good[:-1], good[:-8], good[:-20] + b"x" * 20, b"\0" * len(good),
                   good[:start] + others[start:start + 16] + good[start + 16:],
                   with_sum(good[:-8].replace(request, request[:-1] + b"~", 1)),
                   with_sum(good[:count_at] + struct.pack("<Q", WORD) + good[count_at + 8:-8]),
                   with_sum(good[:count_at] + struct.pack("<Q", 0) + good[count_at + 8:-8]),
                   with_sum(good[:count_at + 16] + struct.pack("<Q", WORD) + good[count_at + 24:-8]),
                   with_sum(good[:-8] + b"more"), with_sum(good[:-16])]
        victim = self.root / "source" / "rays.comp"
        for number, damage in enumerate(damages):
            victim.write_bytes(victim.read_bytes() + f"\nint new_{number}(int x) {{ return x + {number}; }}\n".encode())
            fresh = self.check("--no-cache")
            entry.write_bytes(damage)
            self.assertEqual(self.check(), fresh, number)
            (whole,) = self.kept("files")
            self.assertNotEqual(whole.read_bytes(), damage, "a good one takes its place")
            self.assertGreater(len(whole.read_bytes()), len(good) // 2)
        program = pathlib.Path(self.folder.name) / "program"
        shutil.copy(PROGRAM, program)
        self.forget_answers()
        ran = subprocess.run([program, *self.command()[1:]], capture_output=True, env=self.environment())
        self.assertEqual((ran.returncode, ran.stdout, ran.stderr), fresh)
        self.assertEqual(len(self.kept("files")), 2, "facts of another build stand for themselves")

    def test_every_torn_or_flipped_file_of_facts_gives_the_same_answer(self):
        entry = self.facts()
        good = entry.read_bytes()
        fresh = self.check("--no-cache")
        for number in range(40):
            at = (number * 7919) % (len(good) - 60) + 50
            data = bytearray(good[:-8] if number % 2 else good[:at])
            if number % 2:
                data[at - 8] ^= 1 << number % 8
            else:
                data += sum_of_facts(bytes(data)) if number % 4 else b""
            self.forget_answers()
            entry.write_bytes(bytes(data) + (good[-8:] if number % 2 else b""))
            self.assertEqual(self.check(), fresh, (number, at))

    def test_facts_that_others_can_write_are_not_read(self):
        entry = self.facts()
        fresh = self.check("--no-cache")
        there = entry.parent.parent / "there"
        for spoil in (lambda: entry.chmod(0o666), lambda: (entry.rename(there), entry.symlink_to(there)),
                      lambda: entry.parent.chmod(0o777)):
            spoil()
            spoilt = entry.lstat().st_ino
            self.forget_answers()
            self.assertEqual(self.check(), fresh)
            if entry.parent.stat().st_mode & 0o22 == 0:
                self.assertNotEqual(entry.lstat().st_ino, spoilt, "a file of our own takes its place")
                self.assertFalse(entry.is_symlink())
                self.assertEqual(entry.stat().st_mode & 0o777, 0o600)

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
            self.assertEqual(len(self.kept("files")), 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
