#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Runs of --filter temporal, whose pictures follow from each other, and sequences of frames lose nothing either.

    filtered_runs_test.py PATHTRACER SCENE [KILLS [CORE]]

As long_runs_test.py, whose means it uses; what is right is always the files of one run that nothing stopped.
"""
import base64
import json
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

import long_runs_test as runs

KILLS = int(sys.argv[3]) if len(sys.argv) > 3 else 2
CORE = sys.argv[4] if len(sys.argv) > 4 else "target"
SMALL = ["--core", CORE, "--size", "64x36", "--threads", "2"]
TEMPORAL = ["--filter", "temporal"]


def animated(folder):
    """The scene with its first two meshes on the move, in a folder of its own."""
    source = pathlib.Path(runs.SCENE)
    shutil.copytree(source.parent, folder)
    scene = json.loads(source.read_text())
    moving = [i for i, node in enumerate(scene["nodes"]) if "mesh" in node and "matrix" not in node][:2]
    data = struct.pack("<2f", 0.0, 10.0)
    samplers, channels = [], []
    view = len(scene["bufferViews"])
    scene["bufferViews"].append({"buffer": len(scene["buffers"]), "byteOffset": 0, "byteLength": len(data)})
    times = len(scene["accessors"])
    scene["accessors"].append({"bufferView": view, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0.0],
                               "max": [10.0]})
    for place, node in enumerate(moving):
        at = scene["nodes"][node].get("translation", [0.0, 0.0, 0.0])
        scene["bufferViews"].append({"buffer": len(scene["buffers"]), "byteOffset": len(data), "byteLength": 24})
        data += struct.pack("<6f", *at, at[0] + 3.0, at[1] + 2.0 * place, at[2])
        scene["accessors"].append({"bufferView": view + 1 + place, "componentType": 5126, "count": 2, "type": "VEC3"})
        samplers.append({"input": times, "output": times + 1 + place})
        channels.append({"sampler": place, "target": {"node": node, "path": "translation"}})
    scene["buffers"].append({"byteLength": len(data),
                             "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()})
    scene["animations"] = [{"samplers": samplers, "channels": channels}]
    file = pathlib.Path(folder) / "animated.gltf"
    file.write_text(json.dumps(scene))
    return file


def done_in(checkpoint, what):
    """What a checkpoint says is done; 0 where there is none."""
    return json.loads(checkpoint.read_bytes().split(b"\n", 2)[1])[what] if checkpoint.exists() else 0


def processor_seconds():
    """Of all processes that were started here and have ended."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


class FilteredRuns(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name)
        self.scene = str(animated(self.path / "scene"))

    def file(self, name):
        return self.path / name

    def render(self, *arguments, **options):
        return runs.run("render", self.scene, *SMALL, *arguments, **options)

    def rendered(self, *arguments):
        result = self.render(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def refused(self, result, *words):
        self.assertEqual(result.returncode, 2, result.stderr)
        lines = [line for line in result.stderr.splitlines() if "error" in line]
        self.assertEqual(len(lines), 1, result.stderr)
        for word in words:
            self.assertIn(word, lines[0])

    def left(self):
        return sorted(f.name for f in self.path.iterdir() if f.is_file())

    def killed_until_done(self, arguments, done, most, seconds):
        """Runs the command until it has been killed KILLS times at random moments and was then done; `done` is asked
        after each how much is kept, and told whether it ended by itself. Says how often that was."""
        dice = random.Random(20261125)
        kills = whole = before = 0
        ended = False
        while kills < KILLS or not ended:
            process = runs.start("render", self.scene, *SMALL, *arguments)
            try:
                process.wait(timeout=dice.uniform(0.05, 0.4 + 0.6 * seconds) if kills < KILLS else None)
            except subprocess.TimeoutExpired:
                process.kill()
                kills += 1
            _, errors = process.communicate()
            self.assertIn(process.returncode, (0, -signal.SIGKILL), errors)
            ended = process.returncode == 0
            if ended:
                whole += 1
                done(True)
                before = 0
                continue
            there = done(False)
            self.assertGreaterEqual(there, before, "a kill lost what was kept before")
            before = there if there < most else 0
        print(f"{self.id().split('.')[-1]}: {kills} kills, done {whole} times", file=sys.stderr)

    def test_a_still_picture_goes_on_after_kills_to_the_same_bits(self):
        wanted = 12 * (1 + KILLS)
        whole, parts = self.file("whole.png"), self.file("parts.png")
        began = time.monotonic()
        self.rendered(*TEMPORAL, "--spp", str(wanted), "-o", str(whole))
        seconds = time.monotonic() - began
        checkpoint = self.file("parts.png.checkpoint")

        def done(all_of_it):
            if not parts.exists():
                self.assertFalse(all_of_it)
                return done_in(checkpoint, "passes")
            self.assertEqual(parts.read_bytes(), whole.read_bytes())
            if checkpoint.exists():  # killed between the two
                self.assertFalse(all_of_it)
                return done_in(checkpoint, "passes")
            parts.unlink()
            return wanted if not all_of_it else 0

        self.killed_until_done([*TEMPORAL, "--spp", str(wanted), "-o", str(parts), "--resume", "--checkpoint", "0.05s"],
                               done, wanted, seconds)
        self.assertEqual(self.left(), ["whole.png"], "nothing unfinished stays")

    def frames_after_kills(self, *more):
        count = 4 * (1 + KILLS)
        common = ["--spp", "2", "--frames", f"3:{count + 3}", *more]
        began = time.monotonic()
        self.rendered(*common, "-o", str(self.file("whole_##.png")))
        seconds = time.monotonic() - began
        names = [f"{i + 3:02}.png" for i in range(count)]
        right = [self.file("whole_" + name).read_bytes() for name in names]

        def done(all_of_it):
            there = [self.file("parts_" + name) for name in names]
            for file, expected in zip(there, right):
                if all_of_it or file.exists():
                    self.assertEqual(file.read_bytes(), expected, file.name)
            if not all_of_it:
                kept = sum(file.exists() for file in there)
                of_checkpoint = done_in(self.file("parts_##.png.checkpoint"), "frames")
                return of_checkpoint if more and kept < count else kept
            for file in there:
                file.unlink()
            self.assertEqual(self.left(), sorted("whole_" + name for name in names), "nothing unfinished stays")
            return 0

        checkpoint = ["--checkpoint", "0.05s"] if more else []
        self.killed_until_done([*common, "-o", str(self.file("parts_##.png")), "--resume", *checkpoint], done, count,
                               seconds)

    def test_frames_go_on_after_kills_to_the_same_bits(self):
        self.frames_after_kills()

    def test_frames_that_follow_from_each_other_go_on_after_kills_to_the_same_bits(self):
        self.frames_after_kills(*TEMPORAL)

    def test_a_signal_calls_the_filter_off(self):
        """What is written then is plain samples, and says so; --resume goes on to the filtered picture of one run."""
        large = ["--core", CORE, "--size", "480x270", "--threads", "2", "--spp", "1"]
        for name in ("spatial", "temporal"):
            filtered = ["render", self.scene, *large, "--filter", name]
            whole, parts, plain = (str(self.file(f"{name}_{word}.exr")) for word in ("whole", "parts", "plain"))
            before = processor_seconds()
            self.assertEqual(runs.run(*filtered, "-o", whole).returncode, 0)
            all_of_it = processor_seconds() - before
            before = processor_seconds()
            process = runs.start(*filtered, "-o", parts, "--resume", "--verbose")
            while "core " not in (line := process.stderr.readline()):  # it has its sample then
                self.assertTrue(line, "ended by itself")
            process.send_signal(signal.SIGTERM)
            _, errors = process.communicate()
            self.assertEqual(process.returncode, 143, errors)
            self.assertIn("the picture is not filtered", errors)
            self.assertLess(processor_seconds() - before, 0.6 * all_of_it)
            self.assertEqual(runs.run("render", self.scene, *large, "-o", plain).returncode, 0)
            self.assertEqual(self.file(parts).read_bytes(), self.file(plain).read_bytes())
            result = runs.run(*filtered, "-o", parts, "--resume")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("going on after 1 sample\n", result.stderr)
            self.assertEqual(self.file(parts).read_bytes(), self.file(whole).read_bytes())
            self.assertFalse(self.file(parts + ".checkpoint").exists())

    def test_signals_at_random_moments_lose_no_pass_and_no_frame(self):
        dice = random.Random(20261126)
        for name, more in (("s.png", [*TEMPORAL, "--spp", "12"]), ("f_#.png", [*TEMPORAL, "--spp", "2", "--frames", "0:4"]),
                           ("g_#.png", ["--filter", "spatial", "--spp", "2", "--frames", "0:4"])):
            self.rendered(*more, "-o", str(self.file("one_" + name)))
            signals = 0
            while True:
                process = runs.start("render", self.scene, *SMALL, *more, "-o", str(self.file(name)), "--resume")
                try:
                    process.wait(timeout=dice.uniform(0.05, 0.6) if signals < 2 * KILLS else None)
                except subprocess.TimeoutExpired:
                    process.send_signal(signal.SIGINT)
                    signals += 1
                _, errors = process.communicate()
                if process.returncode == 0:
                    break
                self.assertIn(process.returncode, (130, -signal.SIGINT), errors)
            for file in self.path.glob("one_" + name.replace("#", "?")):
                self.assertEqual(self.file(file.name[4:]).read_bytes(), file.read_bytes(), file.name)

    def test_a_signal_leaves_what_the_next_run_goes_on_from(self):
        for name, more, count in (("s.exr", ["--spp", "1000000"], "passes"),
                                  ("f_###.png", ["--spp", "2", "--frames", "0:1000"], "frames")):
            checkpoint = self.file(name + ".checkpoint")
            process = runs.start("render", self.scene, *SMALL, *TEMPORAL, *more, "-o", str(self.file(name)), "--resume",
                                 "--checkpoint", "0.01s")
            while done_in(checkpoint, count) < 1:  # a signal calls the first pass off as well
                self.assertIsNone(process.poll(), "ended by itself")
                time.sleep(0.01)
            process.send_signal(signal.SIGTERM)
            _, errors = process.communicate(timeout=60)
            self.assertEqual(process.returncode, 143, errors)
            done = done_in(checkpoint, count)
            self.assertIn(f" {done} of ", errors)
            wanted = done + 2
            more = ["--spp", str(wanted)] if count == "passes" else ["--spp", "2", "--frames", f"0:{wanted}"]
            result = self.rendered(*TEMPORAL, *more, "-o", str(self.file(name)), "--resume")
            self.assertIn(f"going on after {done} ", result.stderr)
            self.assertFalse(checkpoint.exists())
            self.rendered(*TEMPORAL, *more, "-o", str(self.file("one_" + name)))
            last = name.replace("###", f"{wanted - 1:03}")
            self.assertEqual(self.file(last).read_bytes(), self.file("one_" + last).read_bytes())

    def kept_sequence(self):
        """Four frames of which three are kept, as one that was interrupted leaves them; gives their checkpoint."""
        frames = [*TEMPORAL, "--spp", "2", "--frames", "0:4", "-o", str(self.file("f_#.png"))]
        self.rendered(*frames, "--checkpoint", "0.0001s")
        checkpoint = self.file("f_#.png.checkpoint")
        self.assertFalse(checkpoint.exists())
        process = runs.start("render", self.scene, *SMALL, *TEMPORAL, "--spp", "2", "--frames", "0:1000", "-o",
                             str(self.file("f_#.png")), "--checkpoint", "0.0001s")
        while done_in(checkpoint, "frames") < 1:
            self.assertIsNone(process.poll(), "ended by itself")
            time.sleep(0.005)
        process.kill()
        process.communicate()
        return checkpoint

    def test_resume_holds_the_checkpoint_of_frames_against_what_is_asked_for(self):
        checkpoint = self.kept_sequence()
        done = done_in(checkpoint, "frames")
        number = lambda i: self.file(f"f_{i}.png")
        asked = ["--spp", "2", "--frames", f"0:{done + 2}", "-o", str(self.file("f_#.png")), "--resume"]
        resume = [*TEMPORAL, *asked]
        good = checkpoint.read_bytes()
        number(done).unlink(missing_ok=True)
        for damage in (good[:len(good) // 2], good[:-1], b"", b"something else",
                       good[:5000] + bytes([good[5000] ^ 1]) + good[5001:]):
            checkpoint.write_bytes(damage)
            self.refused(self.render(*resume), "f_#.png.checkpoint", "delete it")
            self.assertEqual(checkpoint.read_bytes(), damage)
        self.assertEqual(runs.xxh64(good[:-16]), good[-16:].decode())
        for was, other, word in ((rb'(the core.s kernels.":.")[^"]*(.")', rb"\g<1>0\2", "the core's kernels was 0"),
                                 (rb'(the program.s version.":.")[^"]*(.")', rb"\g<1>0.0.1\2", "version was 0.0.1")):
            older = re.sub(was, other, good[:-16], count=1)
            self.assertNotEqual(older, good[:-16])
            checkpoint.write_bytes(older + runs.xxh64(older).encode())
            self.refused(self.render(*resume), word)
        checkpoint.write_bytes(good)
        # Frames of other options are not of this sequence, nor is what the last of them has left.
        for more, word in ((["--seed", "4"], "f_0.png is not of this sequence (--seed was 0 and is 4)"),
                           (["--sky", "1,0,0"], "f_0.png is not of this sequence (")):
            checkpoint.write_bytes(good)
            result = self.rendered(*resume, *more)
            self.assertIn(word, result.stderr)
            self.assertIn("it starts from its first frame", result.stderr)
        whole = [number(i).read_bytes() for i in range(done + 2)]
        self.rendered(*resume[:-1])
        self.assertNotEqual(number(0).read_bytes(), whole[0], "another sky")
        # A frame that the checkpoint counts on is gone: the sequence starts anew, to the same bits.
        right = [number(i).read_bytes() for i in range(done + 2)]
        checkpoint.write_bytes(good)
        number(0).unlink()
        result = self.rendered(*resume)
        self.assertIn("f_0.png is not there", result.stderr)
        self.assertEqual([number(i).read_bytes() for i in range(done + 2)], right)
        # Whole, it needs no checkpoint.
        self.assertIn(f"{done + 2} of them kept", self.rendered(*resume).stderr)
        self.refused(self.render(*asked[:-1], "--checkpoint", "1s"), "--checkpoint", "--filter temporal")

    def test_a_picture_is_not_taken_up_with_another_filter(self):
        for then, now in ((TEMPORAL, ["--filter", "spatial"]), (["--filter", "spatial"], TEMPORAL)):
            output = ["-o", str(self.file("a.png"))]
            self.rendered(*then, "--time-limit", "0.2s", "--spp", "1000000", "--checkpoint", "10m", *output)
            self.refused(self.render(*now, "--spp", "1000000", "--resume", *output), "--filter temporal was")

    def test_another_scene_of_that_name_is_not_taken_up(self):
        """Of a picture it is refused; frames of it are none of this sequence, and start anew."""
        output = ["-o", str(self.file("a.png"))]
        self.rendered("--time-limit", "0.2s", "--spp", "1000000", "--checkpoint", "10m", *output)
        checkpoint = self.kept_sequence()
        frames = [*TEMPORAL, "--spp", "2", "--frames", f"0:{done_in(checkpoint, 'frames') + 1}", "--resume", "-o"]
        scene = json.loads(pathlib.Path(self.scene).read_text())
        scene["materials"][0].setdefault("pbrMetallicRoughness", {})["baseColorFactor"] = [0.1, 0.2, 0.9, 1.0]
        pathlib.Path(self.scene).write_text(json.dumps(scene))
        self.refused(self.render("--spp", "1000000", "--resume", *output), "a.png.checkpoint", "the scene's content was")
        self.assertIn("it starts from its first frame", self.rendered(*frames, str(self.file("f_#.png"))).stderr)
        self.rendered(*frames, str(self.file("g_#.png")))
        self.assertEqual(self.file("f_0.png").read_bytes(), self.file("g_0.png").read_bytes())

    def test_a_full_disk_stops_no_sequence_nor_is_it_silent(self):
        small_files = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))
        result = self.render(*TEMPORAL, "--spp", "2", "--frames", "0:3", "--checkpoint", "0.0001s", "-o",
                             str(self.file("a_#.png")), preexec_fn=small_files)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("a_#.png.checkpoint: File too large", result.stderr)
        self.assertEqual(result.stderr.count("rendering goes on"), 1, result.stderr)
        self.assertEqual(self.left(), ["a_0.png", "a_1.png", "a_2.png"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
