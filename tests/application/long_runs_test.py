#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Long runs of pathtracer lose nothing: signals, kills, a full disk, damaged checkpoints, ranges of samples.

    long_runs_test.py PATHTRACER SCENE [KILLS]

SCENE is a glTF file; KILLS, 3 unless given, is how often SIGKILL comes at a random moment of one rendering.
"""
import json
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

PROGRAM, SCENE = sys.argv[1], sys.argv[2]
KILLS = int(sys.argv[3]) if len(sys.argv) > 3 else 3
SMALL = ["--core", "target", "--size", "64x36", "--threads", "2"]


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120, **options)


def start(*arguments):
    # Whoever runs this by nohup ignores SIGHUP, and so would the program.
    heard = lambda: signal.signal(signal.SIGHUP, signal.SIG_DFL)
    return subprocess.Popen([PROGRAM, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, preexec_fn=heard)


def render(*arguments, **options):
    return run("render", SCENE, *SMALL, *arguments, **options)


def png_chunks(data):
    """The chunks of a PNG whose checksums hold; fails on one that is torn."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    place, chunks = 8, {}
    while place < len(data):
        length, kind = struct.unpack(">I4s", data[place:place + 8])
        body = data[place + 8:place + 8 + length]
        (checksum,) = struct.unpack(">I", data[place + 8 + length:place + 12 + length])
        assert checksum == zlib.crc32(kind + body)
        chunks.setdefault(kind, []).append(body)
        place += 12 + length
    assert b"IEND" in chunks
    return chunks


def png_texts(file):
    return dict(text.decode().split("\0", 1) for text in png_chunks(file.read_bytes())[b"tEXt"])


def png_samples(file):
    samples = png_texts(file).get("samples")
    return None if samples is None else int(samples)


def exr_samples(file):
    """The attribute `samples` of the header (OpenEXR file layout: name, type, size, value)."""
    found = re.search(rb"samples\0int\0\x04\0\0\0(....)", file.read_bytes(), re.DOTALL)
    return struct.unpack("<i", found.group(1))[0] if found else None


def checkpoint_samples(file):
    """What a checkpoint says; its second line is JSON. None where there is no checkpoint."""
    if not file.exists():
        return None
    first, head, _ = file.read_bytes().split(b"\n", 2)
    assert first == b"pathtracer checkpoint 1", first
    return json.loads(head)["samples"]


def xxh64(data):
    """XXH64 with seed 0, from its specification (github.com/Cyan4973/xxHash, doc/xxhash_spec.md), as hex."""
    p1, p2, p3, p4, p5 = (0x9E3779B185EBCA87, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9, 0x85EBCA77C2B2AE63,
                          0x27D4EB2F165667C5)
    mask = (1 << 64) - 1
    rotate = lambda x, n: ((x << n) | (x >> (64 - n))) & mask
    rounded = lambda acc, lane: rotate((acc + lane * p2) & mask, 31) * p1 & mask
    lanes = [(p1 + p2) & mask, p2, 0, -p1 & mask]
    place = 0
    while place + 32 <= len(data):
        lanes = [rounded(a, lane) for a, lane in zip(lanes, struct.unpack_from("<4Q", data, place))]
        place += 32
    acc = p5
    if len(data) >= 32:
        acc = sum(rotate(a, n) for a, n in zip(lanes, (1, 7, 12, 18))) & mask
        for a in lanes:
            acc = ((acc ^ rounded(0, a)) * p1 + p4) & mask
    acc = (acc + len(data)) & mask
    while place + 8 <= len(data):
        acc = (rotate(acc ^ rounded(0, struct.unpack_from("<Q", data, place)[0]), 27) * p1 + p4) & mask
        place += 8
    if place + 4 <= len(data):
        acc = (rotate(acc ^ (struct.unpack_from("<I", data, place)[0] * p1 & mask), 23) * p2 + p3) & mask
        place += 4
    for byte in data[place:]:
        acc = rotate(acc ^ (byte * p5 & mask), 11) * p1 & mask
    for shift, prime in ((33, p2), (29, p3), (32, 1)):
        acc = (acc ^ (acc >> shift)) * prime & mask
    return f"{acc:016x}"


class LongRuns(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)

    def file(self, name):
        return self.path / name

    def refused(self, result, *words):
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(result.stdout, "")
        lines = [line for line in result.stderr.splitlines() if "error" in line]
        self.assertEqual(len(lines), 1, result.stderr)
        for word in words:
            self.assertIn(word, lines[0])

    def end_by(self, number, name, times=1, *more):
        """Starts a rendering that takes hours and sends it a signal; gives exit code, seconds since, and stderr."""
        output = self.file(name)
        process = start("render", SCENE, "--core", "target", "--size", "64x36", "--spp", "10000000", "--progress",
                        "-o", str(output), *more)
        while "samples" not in (seen := os.read(process.stderr.fileno(), 4096).decode()):
            self.assertTrue(seen, "ended by itself")
        since = time.monotonic()
        for _ in range(times):
            process.send_signal(number)
        _, errors = process.communicate(timeout=60)
        return process.returncode, time.monotonic() - since, errors

    def test_signals_write_the_picture_so_far(self):
        for number, name, code in ((signal.SIGINT, "a.exr", 130), (signal.SIGTERM, "a.png", 143),
                                   (signal.SIGHUP, "b.png", 129)):
            exit_code, seconds, errors = self.end_by(number, name)
            self.assertEqual(exit_code, code, errors)
            self.assertLess(seconds, 30)
            said = int(re.search(r"the picture has (\d+) of 10000000 samples", errors).group(1))
            written = (exr_samples if name.endswith("exr") else png_samples)(self.file(name))
            self.assertEqual(written, said)
            # Those samples are the first of the run: as many in one go give the same file.
            if said < 400:
                again = run("render", SCENE, "--core", "target", "--size", "64x36", "--spp", str(said), "-o",
                            str(self.file("again-" + name)))
                self.assertEqual(again.returncode, 0, again.stderr)
                self.assertEqual(self.file("again-" + name).read_bytes(), self.file(name).read_bytes())

    def test_a_terminal_that_closes_may_say_so_twice(self):
        exit_code, _, errors = self.end_by(signal.SIGHUP, "a.png", 3)
        self.assertEqual(exit_code, 129, errors)
        self.assertIn("interrupted by SIGHUP: the picture has", errors)
        self.assertTrue(self.file("a.png").exists())

    def test_a_sequence_says_how_many_frames_it_has(self):
        process = start("render", SCENE, *SMALL, "--spp", "2", "--frames", "0:1000000", "-o", str(self.file("f#.png")))
        while not self.file("f0.png").exists():
            self.assertIsNone(process.poll(), "ended by itself")
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, errors)
        there = sorted(self.path.iterdir())
        self.assertIn(f"interrupted by Ctrl-C: {len(there)} of 1000000 frames are done; --resume goes on", errors)
        for file in there:
            png_chunks(file.read_bytes())

    def test_a_second_signal_ends_at_once(self):
        exit_code, seconds, _ = self.end_by(signal.SIGTERM, "a.png", 3)
        # Both may have come before the program looked; then the first alone counts.
        self.assertIn(exit_code, (-signal.SIGTERM, 143))
        self.assertLess(seconds, 30)
        self.assertEqual([f.name for f in self.path.iterdir() if f.name.startswith(".")], [])

    def test_killed_at_random_moments_it_comes_to_the_same_bits(self):
        wanted, interval = 60 * KILLS, 0.05
        whole, parts = self.file("whole.exr"), self.file("parts.exr")
        self.assertEqual(render("--spp", str(wanted), "-o", str(whole)).returncode, 0)
        began = time.monotonic()
        self.assertEqual(render("--spp", str(wanted), "-o", str(self.file("timed.png"))).returncode, 0)
        seconds = time.monotonic() - began
        checkpoint = self.file("parts.exr.checkpoint")
        dice = random.Random(20261123)
        kills = before = 0
        while kills < KILLS:
            process = start("render", SCENE, *SMALL, "--spp", str(wanted), "-o", str(parts), "--resume", "--checkpoint",
                            f"{interval}s")
            try:
                process.wait(timeout=dice.uniform(0.05, 0.4 + 0.5 * seconds))
            except subprocess.TimeoutExpired:
                process.kill()
                kills += 1
            process.communicate()
            self.assertIn(process.returncode, (0, -signal.SIGKILL))
            if process.returncode == 0:  # all of it, before the dice fell: that again counts for nothing
                self.assertEqual(parts.read_bytes(), whole.read_bytes())
                parts.unlink()
                before = 0
                continue
            samples = checkpoint_samples(checkpoint) or 0
            self.assertGreaterEqual(samples, before, "a kill lost what an earlier checkpoint had")
            before = samples
            if parts.exists():
                self.assertEqual(exr_samples(parts), wanted)
        last = render("--spp", str(wanted), "-o", str(parts), "--resume")
        self.assertEqual(last.returncode, 0, last.stderr)
        self.assertEqual(parts.read_bytes(), whole.read_bytes())
        left = sorted(f.name for f in self.path.iterdir())
        self.assertEqual(left, ["parts.exr", "timed.png", "whole.exr"], "nothing unfinished stays")

    def test_no_more_than_the_interval_is_lost(self):
        """Where a rendering is killed, its checkpoint is no older than the interval, and what one portion takes."""
        output, interval = self.file("a.png"), 0.5
        process = start("render", SCENE, *SMALL, "--spp", "10000000", "-o", str(output), "--checkpoint", f"{interval}s")
        checkpoint = self.file("a.png.checkpoint")
        while not checkpoint.exists():
            time.sleep(0.01)
            self.assertIsNone(process.poll())
        time.sleep(1.3)
        age = time.time() - checkpoint.stat().st_mtime
        process.kill()
        process.communicate()
        self.assertLess(age, interval + 2.0, "loaded machines get two seconds")
        self.assertGreater(checkpoint_samples(checkpoint), 1)

    def test_resume_holds_the_checkpoint_against_what_is_asked_for(self):
        output = self.file("a.png")
        checkpoint = self.file("a.png.checkpoint")
        stop = ["--time-limit", "0.4s", "--checkpoint", "10m", "-o", str(output)]
        first = render("--spp", "10000000", *stop)
        self.assertEqual(first.returncode, 0, first.stderr)
        self.assertIn("the time limit is reached", first.stderr)
        samples = checkpoint_samples(checkpoint)
        self.assertEqual(png_samples(output), samples)
        picture = output.read_bytes()

        resume = ["--resume", "-o", str(output), "--spp", str(samples + 1)]
        self.refused(render(*resume, "--seed", "4"), "a.png.checkpoint", "--seed was 0 and is 4")
        self.refused(render(*resume, "--max-path-length", "3"), "--max-path-length was 8 and is 3")
        self.refused(render(*resume, "--aperture", "0.01", "--focus", "3"), "the view")
        self.refused(render(*resume, "--sky", "1,0,0"), "the sky (--sky")
        self.refused(render(*resume, "--size", "32x18"), "--size was 64x36 and is 32x18")
        self.refused(render("--resume", "-o", str(output), "--samples", f"5:{samples + 6}"), "first sample was 0")
        if samples > 1:
            self.refused(render("--resume", "-o", str(output), "--spp", "1"), f"it has {samples} samples, 1 are wanted")
        good = checkpoint.read_bytes()
        for damage in (good[:len(good) // 2], good[:-1], b"", b"something else",
                       good[:5000] + bytes([good[5000] ^ 1]) + good[5001:]):
            checkpoint.write_bytes(damage)
            self.refused(render(*resume), "a.png.checkpoint", "delete it")
            self.assertEqual(checkpoint.read_bytes(), damage)
        self.assertEqual(xxh64(good[:-16]), good[-16:].decode())
        older = re.sub(rb'(the program.s version.":.")[^"]*(.")', rb"\g<1>0.0.1\2", good[:-16], count=1)
        self.assertNotEqual(older, good[:-16])
        checkpoint.write_bytes(older + xxh64(older).encode())
        self.refused(render(*resume), "the program's version was 0.0.1")
        checkpoint.write_bytes(good)
        self.assertEqual(output.read_bytes(), picture, "nothing refused has touched the picture")
        done = render(*resume)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"going on after {samples} sample" + ("\n" if samples == 1 else "s\n"), done.stderr)
        self.assertFalse(checkpoint.exists())
        one_go = self.file("one.png")
        self.assertEqual(render("-o", str(one_go), "--spp", str(samples + 1)).returncode, 0)
        self.assertEqual(one_go.read_bytes(), output.read_bytes())

    def test_a_full_disk_stops_neither_rendering_nor_is_it_silent(self):
        output = self.file("a.png")
        small_files = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))
        result = render("--spp", "40", "--checkpoint", "0.001s", "-o", str(output), preexec_fn=small_files)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("a.png.checkpoint: File too large", result.stderr)
        self.assertEqual(result.stderr.count("rendering goes on"), 1, result.stderr)
        self.assertEqual([f.name for f in self.path.iterdir()], ["a.png"])
        nothing = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (10, 10))
        result = render("--spp", "2", "-o", str(self.file("b.png")), preexec_fn=nothing)
        self.refused(result, "b.png", "File too large")
        self.assertEqual([f.name for f in self.path.iterdir()], ["a.png"])

    def test_a_png_of_other_samples_than_the_first_says_which(self):
        for name, arguments, texts in (("a.png", ["--samples", "3:4"], {"samples": "1", "sampleRanges": "3:4"}),
                                       ("b.png", ["--samples", "0:2"], {"samples": "2"}), ("c.png", ["--spp", "2"], {"samples": "2"})):
            result = render(*arguments, "-o", str(self.file(name)))
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn(texts["samples"] + (" sample " if texts["samples"] == "1" else " samples ") + "per pixel", result.stderr)
            self.assertEqual(png_texts(self.file(name)), texts)

    def test_merged_ranges_are_the_picture_of_one_run(self):
        name = lambda text: str(self.file(text))
        for file, samples, threads in (("a.exr", "0:3", "1"), ("b.exr", "3:4", "2"), ("c.exr", "4:16", "2"),
                                       ("whole.exr", "0:16", "1")):
            result = render("--samples", samples, "-o", name(file), "--threads", threads)
            self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(render("--spp", "16", "-o", name("one.png")).returncode, 0)
        self.assertEqual(run("merge", name("c.exr"), name("a.exr"), "-o", name("ac.exr")).returncode, 0)
        gap = run("merge", name("ac.exr"), "-o", name("gap.png"))
        self.assertIn("samples 0:3,4:16 only", gap.stderr)
        merged = run("merge", name("ac.exr"), name("b.exr"), "-o", name("merged.exr"))
        self.assertEqual(merged.returncode, 0, merged.stderr)
        self.assertEqual(self.file("merged.exr").read_bytes(), self.file("whole.exr").read_bytes())
        self.assertEqual(exr_samples(self.file("merged.exr")), 16)
        self.assertEqual(run("merge", name("merged.exr"), "-o", name("merged.png")).returncode, 0)
        self.assertEqual(self.file("merged.png").read_bytes(), self.file("one.png").read_bytes())
        # The check that docs/long-runs.md gives: an EXR of one run has no sums beside its pixels.
        self.assertEqual(render("--spp", "16", "-o", name("one.exr")).returncode, 0)
        compared = run("compare", name("one.exr"), name("merged.exr"), "--format", "json")
        self.assertEqual(compared.returncode, 0, compared.stderr)
        self.assertEqual(json.loads(compared.stdout)["results"][0]["identical_pixels"], 1.0)

        before = sorted(f.name for f in self.path.iterdir())
        self.refused(run("merge", name("a.exr"), name("whole.exr"), "-o", name("x.exr")), "samples 0:3 are there already")
        self.refused(run("merge", name("a.exr"), name("one.png"), "-o", name("x.exr")), "one.png", "no EXR")
        self.refused(run("merge", name("a.exr"), name("gone.exr"), "-o", name("x.exr")), "gone.exr")
        self.refused(run("merge", name("a.exr"), SCENE, "-o", name("x.exr")), "--samples A:B")
        torn = self.file("torn.exr")
        torn.write_bytes(self.file("b.exr").read_bytes()[:9000])
        self.refused(run("merge", name("a.exr"), str(torn), "-o", name("x.exr")), "torn.exr")
        torn.unlink()
        self.assertEqual(sorted(f.name for f in self.path.iterdir()), before)
        for option, value, words in (("--seed", "1", "--seed is 0 and here 1"), ("--sky", "1,0,0", "the sky (--sky")):
            self.assertEqual(render("--samples", "16:17", option, value, "-o", name("other.exr")).returncode, 0)
            self.refused(run("merge", name("a.exr"), name("other.exr"), "-o", name("x.exr")), "other.exr", words)
        other = shutil.copytree(pathlib.Path(SCENE).parent, self.file("other")) / pathlib.Path(SCENE).name
        scene = json.loads(other.read_text())
        scene["materials"][0].setdefault("pbrMetallicRoughness", {})["baseColorFactor"] = [0.1, 0.2, 0.9, 1.0]
        other.write_text(json.dumps(scene))
        self.assertEqual(run("render", str(other), *SMALL, "--samples", "16:17", "-o", name("other.exr")).returncode, 0)
        self.refused(run("merge", name("a.exr"), name("other.exr"), "-o", name("x.exr")), "other.exr", "the scene's content")
        # Without sums a picture still adds up, but for its last bits, and says so.
        self.assertEqual(render("--spp", "3", "-o", name("plain.exr")).returncode, 0)
        merged = run("merge", name("plain.exr"), name("b.exr"), name("c.exr"), "-o", name("near.png"))
        self.assertIn("not all files hold exact sums", merged.stderr)
        self.assertEqual(self.file("near.png").read_bytes(), self.file("one.png").read_bytes())

    def test_limits_of_time_and_noise_end_a_run(self):
        began = time.monotonic()
        result = render("--time-limit", "1s", "-o", str(self.file("t.png")))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertLess(time.monotonic() - began, 60)
        # An idle machine takes many more than the default of 16 in that time; a loaded one perhaps one.
        samples = png_samples(self.file("t.png"))
        self.assertRegex(result.stderr, f"the time limit is reached: the picture has {samples} samples?\n")
        noisy = render("--noise", "0.2", "-o", str(self.file("n.png")))
        self.assertEqual(noisy.returncode, 0, noisy.stderr)
        found = re.search(r"noise ([0-9.]+) after (\d+) samples", noisy.stderr)
        self.assertLessEqual(float(found.group(1)), 0.2)
        again = render("--noise", "0.2", "--threads", "1", "-o", str(self.file("m.png")))
        self.assertEqual(again.returncode, 0)
        self.assertEqual(self.file("n.png").read_bytes(), self.file("m.png").read_bytes(), "not a matter of time")
        few = render("--noise", "0.00001", "--spp", "9", "-o", str(self.file("f.png")))
        self.assertIn("more than asked for", few.stderr)
        self.refused(render("--samples", "0:4", "--spp", "3"), "--samples", "--spp")
        self.refused(render("--samples", "4:4"), "4:4")
        self.refused(render("--checkpoint", "5x"), "5x", "5m")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
