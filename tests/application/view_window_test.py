# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""`pathtracer view` as a person uses it: under Xvfb, with xdotool, and a look into what stands on the screen.

With `--record FILE.png` at the end the story is played alone, and what the screen shows becomes an animated picture (APNG):
    tests/application/view_window_test.py build/release/bin/pathtracer source_core/kernels --record docs/story.png
"""
import base64
import json
import math
import os
import pathlib
import shlex
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

PATHTRACER = os.path.abspath(sys.argv.pop(1))
KERNELS = pathlib.Path(os.path.abspath(sys.argv.pop(1)))
BUILD = pathlib.Path(PATHTRACER).parents[1]
MODULE = "pathtracer-core-target.so"
RECORD = pathlib.Path(os.path.abspath(sys.argv[2])) if sys.argv[1:2] == ["--record"] else None
WIDTH, HEIGHT = (960, 540) if RECORD else (640, 360)
PATIENCE = 120 if RECORD else 40


def skip(why):
    print("skipped: " + why)
    sys.exit(77)


class Screen:
    """An X server without a screen; its picture lies in a file, in the format of xwd (X11/XWDFile.h)."""

    def __init__(self, folder, *options):
        self.folder = folder
        ends = os.pipe()
        self.process = subprocess.Popen(
            ["Xvfb", "-displayfd", str(ends[1]), "-screen", "0", f"{WIDTH}x{HEIGHT}x24", "-fbdir", folder,
             "-nolisten", "tcp", *options], pass_fds=[ends[1]], stderr=subprocess.DEVNULL)
        os.close(ends[1])
        with os.fdopen(ends[0]) as pipe:
            self.display = ":" + pipe.readline().strip()

    def rows(self):
        """The pixels as rows of (red, green, blue)."""
        data = (pathlib.Path(self.folder) / "Xvfb_screen0").read_bytes()
        head = struct.unpack(">25I", data[:100])
        first, line, little = head[0] + 12 * head[19], head[12], head[7] == 0
        out = []
        for y in range(HEIGHT):
            row = data[first + y * line:first + y * line + 4 * WIDTH]
            pixels = [row[x:x + 4] for x in range(0, 4 * WIDTH, 4)]
            out.append([(p[2], p[1], p[0]) if little else (p[1], p[2], p[3]) for p in pixels])
        return out

    def end(self):
        self.process.terminate()
        self.process.wait()


class Recording:
    """An animated PNG: https://wiki.mozilla.org/APNG_Specification."""

    def __init__(self):
        self.frames = []

    def take(self, rows, seconds):
        """Of each colour the upper five bits: noise costs most of the bytes."""
        lines, above = [], bytes(3 * WIDTH)
        for row in rows:
            now = bytes(channel & 0xF8 for pixel in row for channel in pixel)
            lines.append(b"\x02" + bytes((a - b) & 255 for a, b in zip(now, above)))
            above = now
        self.frames.append((zlib.compress(b"".join(lines), 9), int(1000 * seconds)))

    def write(self, path):
        def chunk(name, data):
            return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

        out = [b"\x89PNG\r\n\x1a\n", chunk(b"IHDR", struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 2, 0, 0, 0)),
               chunk(b"acTL", struct.pack(">II", len(self.frames), 0))]
        number = 0
        for i, (data, ms) in enumerate(self.frames):
            out.append(chunk(b"fcTL", struct.pack(">IIIIIHHBB", number, WIDTH, HEIGHT, 0, 0, ms, 1000, 0, 0)))
            out.append(chunk(b"IDAT", data) if i == 0 else chunk(b"fdAT", struct.pack(">I", number + 1) + data))
            number += 1 if i == 0 else 2
        path.write_bytes(b"".join(out) + chunk(b"IEND", b""))


def sample(rows):
    """Every fourth pixel of the lower half, where no panel stands."""
    return [pixel for row in rows[HEIGHT // 2 + 20::4] for pixel in row[::4]]


def brightness(pixels):
    return sum(map(sum, pixels)) / (3 * len(pixels))


def apart(a, b):
    return sum(abs(x - y) for p, q in zip(a, b) for x, y in zip(p, q)) / (3 * len(a))


class Person(unittest.TestCase):
    """Has a screen, and a window on it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.screen = Screen(folder.name)
        self.addCleanup(self.screen.end)
        self.log = self.folder / "log.jsonl"
        self.seen = 0

    def open_window(self, *options, scene="still_life", size="320x180" if RECORD else "160x90", **environment):
        process = self.process = subprocess.Popen(
            [PATHTRACER, "view", scene, "--size", size, "--log", self.log, *map(str, options)],
            cwd=self.folder, env={**os.environ, "DISPLAY": self.screen.display, **environment}, stderr=subprocess.PIPE)
        self.addCleanup(lambda: (process.kill(), process.communicate()))

    def leave(self):
        self.xdotool("key", "Escape")
        self.assertEqual(self.process.wait(PATIENCE), 0)

    def xdotool(self, *arguments):
        subprocess.run(["xdotool", *map(str, arguments)], check=True, stdout=subprocess.DEVNULL,
                       env={**os.environ, "DISPLAY": self.screen.display})

    def events(self):
        lines = self.log.read_text().splitlines() if self.log.exists() else []
        return [json.loads(line) for line in lines]

    def wait_for(self, event, found=lambda detail: True):
        """The next such event of the log; it fails where none comes."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            for i, one in enumerate(self.events()):
                if i >= self.seen and one["event"] == event and found(one["detail"]):
                    self.seen = i + 1
                    return one
            self.assertIsNone(self.process.poll(), self.process.poll() is not None and self.process.stderr.read())
            time.sleep(0.02)
        raise AssertionError(f"no {event}; there are {self.events()}")

    def until(self, holds):
        """The screen, once it is as it should be."""
        end = time.monotonic() + PATIENCE
        while True:
            now = sample(self.screen.rows())
            if holds(now):
                return now
            self.assertLess(time.monotonic(), end, f"brightness {brightness(now)}; {self.events()}")
            time.sleep(0.1)

    def at_rest(self):
        """The screen, once nothing has changed on it for a second: every move is drawn, every sample taken."""
        end = time.monotonic() + PATIENCE
        last, still = sample(self.screen.rows()), 0
        while still < 5:
            self.assertLess(time.monotonic(), end, f"never at rest; {self.events()}")
            time.sleep(0.2)
            now = sample(self.screen.rows())
            last, still = now, still + 1 if now == last else 0
        return last


def cores():
    return json.loads(subprocess.run([PATHTRACER, "info", "--format", "json"], capture_output=True).stdout)["cores"]


def has_both_cores():
    return all(core["available"] for core in cores())


class ViewTest(Person):
    def test_a_person_looks_orbits_switches_compares_and_leaves(self):
        self.open_window("--spp", 8, "-o", "saved.png", "--core", "target,source")
        self.wait_for("pixels", lambda detail: detail["core"] == "target")
        first = self.until(lambda now: brightness(now) > 20 and len(set(now)) > 200)  # not the coarse pass before

        # Without pauses, and from over a panel: all of it may come between two frames.
        self.xdotool("mousemove", 40, 20, "mousemove", 300, 260, "mousedown", 1, "mousemove", 360, 250, "mousemove", 420, 240,
                     "mouseup", 1)
        asked = self.wait_for("input", lambda detail: detail["kind"] == "orbit")
        answered = self.wait_for("pixels")
        self.assertGreaterEqual(answered["t_ms"], asked["t_ms"])
        self.until(lambda now: apart(now, first) > 8 and brightness(now) > 5)
        orbited = brightness(self.at_rest())  # the drag's first half may be what is seen before

        for _ in range(3):
            self.xdotool("mousemove", 40, 20, "mousemove", 320, 300, "click", 1)
            picked = self.wait_for("input", lambda detail: detail["kind"] == "pick")
            self.assertRegex(picked["detail"]["found"], "instance [0-9]+, material")

        self.xdotool("key", "p")
        self.wait_for("input", lambda detail: detail["kind"] == "save")
        png = (self.folder / "saved.png").read_bytes()
        self.assertEqual(struct.unpack(">II", png[16:24]), (160, 90))

        if has_both_cores():
            # The other core has only begun to start: nothing of it can be saved.
            self.xdotool("key", "Tab", "key", "x")
            refused = self.wait_for("error", lambda detail: detail.get("kind") == "save")
            self.assertIn("the source core has not drawn this view yet", refused["detail"]["message"])
            self.assertFalse((self.folder / "saved.exr").exists())
            self.seen = 0
            self.wait_for("switch", lambda detail: detail["core"] == "source")
            self.wait_for("pixels", lambda detail: detail["core"] == "source")
            # The same paths: the difference times 16 is all but black.
            self.xdotool("key", "3")
            self.until(lambda now: brightness(now) < orbited / 4)
            self.xdotool("key", "2")
            self.until(lambda now: abs(brightness(now) - orbited) < orbited / 4)
        # Plain samples have more colours than what a filter leaves of them.
        filtered = len(set(sample(self.screen.rows())))
        self.xdotool("key", "t")
        self.wait_for("input", lambda detail: detail["kind"] == "filter")
        self.until(lambda now: len(set(now)) > filtered)
        self.leave()


class MovingTest(Person):
    def test_an_animation_is_played_and_gone_through_by_hand_and_what_is_shown_is_saved(self):
        listed = {core["id"]: core["available"] for core in cores()}
        if not listed["target"]:
            self.skipTest("there is no Embree here")
        # A triangle that goes from the middle to x = 1 within a second.
        corners = struct.pack("<9f", -1, -1, 0, 1, -1, 0, 0, 1, 0) + struct.pack("<8f", 0, 1, 0, 0, 0, 1, 0, 0)
        views = [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 32}]
        (self.folder / "moving.gltf").write_text(json.dumps({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
                            "samplers": [{"input": 1, "output": 2}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]},
                          {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
                          {"bufferView": 1, "byteOffset": 8, "componentType": 5126, "count": 2, "type": "VEC3"}],
            "bufferViews": views,
            "buffers": [{"byteLength": 68, "uri": "data:application/octet-stream;base64," + base64.b64encode(corners).decode()}]}))
        self.open_window("--spp", 4, "--core", "target", "--sky", "1,1,1", "--max-path-length", 1, "--look-at", "0,0,5,0,0,0", "-o", "shown.png",
                         scene="moving.gltf")
        # Darker than the sky; where it stands, by the mean column of such pixels.
        def place(now):
            dark = [i % (WIDTH // 4) for i, pixel in enumerate(now) if sum(pixel) < 3 * 240]
            return sum(dark) / len(dark) if dark else 0.0
        self.xdotool("key", "h")
        self.wait_for("pixels")
        first = place(self.until(lambda now: place(now) > 0))
        for step in range(1, 13):
            self.xdotool("key", "period")
            scrubbed = self.wait_for("input", lambda detail: detail["kind"] == "scrub")["detail"]
            self.assertAlmostEqual(scrubbed["seconds"], step / 24)
        # By half a unit: of 180 rows that are 2 * 5 * tan(20 degrees) units high, at the window's size.
        half = 0.5 / (10 * math.tan(math.radians(20))) * HEIGHT / 4
        self.until(lambda now: abs(place(now) - first - half) < half / 4)
        self.xdotool("key", "x", "key", "k", "key", "p")
        for name in ("shown.exr", "shown.camera.json", "shown.png"):
            self.assertEqual(self.wait_for("input", lambda detail: detail["kind"] == "save")["detail"]["message"], "saved " + name)
        self.assertEqual((self.folder / "shown.exr").read_bytes()[:4], b"\x76\x2f\x31\x01")
        camera = json.loads((self.folder / "shown.camera.json").read_text())
        self.assertEqual(camera["position"], [0, 0, 5])
        self.assertAlmostEqual(camera["vfov_degrees"], 40, 4)
        self.xdotool("key", "space")
        self.wait_for("input", lambda detail: detail["kind"] == "play")
        self.until(lambda now: abs(place(now) - first - half) > half / 2)
        self.xdotool("key", "space")
        paused = self.wait_for("input", lambda detail: detail["kind"] == "pause")["detail"]["seconds"]
        self.assertGreaterEqual(paused, 0)
        self.assertLessEqual(paused, 1)
        self.leave()


class KernelsTest(Person):
    def save(self, name, *edits):
        text = (KERNELS / name).read_text()
        for old, new in edits:
            self.assertIn(old, text)
            text = text.replace(old, new, 1)
        (self.kernels / name).write_text(text)
        return text

    def test_a_saved_kernel_is_seen_at_once_and_a_broken_one_is_not(self):
        if not has_both_cores():
            self.skipTest("there is no Vulkan device or no Embree here")
        self.kernels = self.folder / "kernels"
        shutil.copytree(KERNELS, self.kernels)
        broken = self.save("finalize.glsl", ("vec4(sum * pass", "nonsense; vec4(sum * pass"))
        line = broken[:broken.index("nonsense")].count("\n") + 1
        self.open_window("--spp", 4, "--core", "source", "--kernels", "kernels")
        # What does not compile at the start: said over the picture, which the other core draws.
        said = self.wait_for("error", lambda detail: detail.get("core") == "source")["detail"]
        self.assertIn(f"finalize.glsl:{line}: 'nonsense'", said["message"])
        red = lambda: sum(r > 60 and g < 30 and b < 30 for r, g, b in self.screen.rows()[HEIGHT - 10])
        self.wait_for("pixels", lambda detail: detail["core"] == "target")
        self.until(lambda now: red() > WIDTH / 2 and brightness(now) > 20)

        # Still broken: said at the save, and no reload is claimed before.
        self.save("finalize.glsl", ("vec4(sum * pass", "gibberish; vec4(sum * pass"))
        self.wait_for("error", lambda detail: "'gibberish'" in detail["message"])
        self.assertNotIn("reload", [event["event"] for event in self.events()])
        self.save("finalize.glsl")
        compiled = self.wait_for("reload", lambda detail: detail["core"] == "source")["detail"]
        self.assertIn("shade", compiled["kernels"])
        self.xdotool("key", "Tab")
        self.wait_for("pixels", lambda detail: detail["core"] == "source")
        plain = brightness(self.until(lambda now: red() < WIDTH / 2 and brightness(now) > 20))
        self.save("finalize.glsl", ("sum * pass.sample_scale", "0.25 * sum * pass.sample_scale"))
        self.assertEqual(self.wait_for("reload")["detail"]["kernels"], ["finalize"])
        self.wait_for("pixels", lambda detail: detail["core"] == "source")
        self.until(lambda now: brightness(now) < 0.7 * plain)
        # One that includes itself: an error like others, and the one that runs goes on.
        (self.kernels / "finalize.glsl").write_text('#include "finalize.glsl"\n' + (self.kernels / "finalize.glsl").read_text())
        self.assertIn("finalize.glsl:1: '#include'", self.wait_for("error", lambda detail: detail.get("core") == "source")["detail"]["message"])
        self.until(lambda now: red() > WIDTH / 2 and brightness(now) < 0.7 * plain)
        (self.kernels / "finalize.glsl").unlink()
        self.assertIn("finalize.glsl", self.wait_for("error", lambda detail: detail.get("core") == "source")["detail"]["message"])
        self.until(lambda now: red() > WIDTH / 2 and brightness(now) < 0.7 * plain)
        # As it is running: nothing is compiled, and the error is over.
        self.save("finalize.glsl", ("sum * pass.sample_scale", "0.25 * sum * pass.sample_scale"))
        self.assertEqual(self.wait_for("reload")["detail"]["kernels"], [])
        self.until(lambda now: red() < WIDTH / 2 and brightness(now) < 0.7 * plain)
        self.save("finalize.glsl")
        self.wait_for("pixels", lambda detail: detail["core"] == "source")
        self.until(lambda now: red() < WIDTH / 2 and abs(brightness(now) - plain) < plain / 10)
        self.leave()


    def test_a_broken_kernel_is_told_while_only_the_other_core_is_shown(self):
        if not has_both_cores():
            self.skipTest("there is no Vulkan device or no Embree here")
        self.kernels = self.folder / "kernels"
        shutil.copytree(KERNELS, self.kernels)
        self.save("finalize.glsl", ("vec4(sum * pass", "nonsense; vec4(sum * pass"))
        self.open_window("--spp", 2, "--core", "target,source", "--kernels", "kernels")
        # At the start, and at a save; the picture is the target core's all along.
        said = self.wait_for("error", lambda detail: detail.get("core") == "source")["detail"]
        self.assertIn("'nonsense'", said["message"])
        self.seen = 0
        self.wait_for("pixels", lambda detail: detail["core"] == "target")
        red = lambda: sum(r > 60 and g < 30 and b < 30 for r, g, b in self.screen.rows()[HEIGHT - 10])
        self.until(lambda now: red() > WIDTH / 2 and brightness(now) > 20)
        self.save("finalize.glsl")
        compiled = self.wait_for("reload", lambda detail: "finalize" in detail["kernels"])["detail"]
        self.assertEqual((compiled["core"], compiled["files"]), ("source", ["finalize.glsl"]))
        self.until(lambda now: red() < WIDTH / 2)
        self.save("shade.glsl", ("clamp(", "gibberish("))
        self.wait_for("error", lambda detail: "'gibberish'" in detail["message"])
        (self.kernels / "shade.glsl").unlink()
        self.wait_for("error", lambda detail: "shade.glsl" in detail["message"] and "'gibberish'" not in detail["message"])
        self.until(lambda now: red() > WIDTH / 2 and brightness(now) > 20)
        self.assertNotIn("source", [event["detail"]["core"] for event in self.events() if event["event"] == "pixels"])
        # Mended, it draws once it is asked to.
        self.save("shade.glsl")
        self.wait_for("reload", lambda detail: detail["core"] == "source")
        self.until(lambda now: red() < WIDTH / 2)
        self.xdotool("key", "Tab")
        self.wait_for("pixels", lambda detail: detail["core"] == "source")
        self.leave()


class StoryTest(Person):
    """An edit of one core alone, from the save to its port."""

    def show(self, seconds):
        if RECORD:
            time.sleep(8)  # the pictures converge, the panels follow
            self.recording.take(self.screen.rows(), seconds)

    def halves(self):
        rows = self.screen.rows()[HEIGHT // 2 + 20:HEIGHT - 20:4]
        return [brightness([pixel for row in rows for pixel in row[first:first + WIDTH // 4:4]])
                for first in (WIDTH // 4 - 16, WIDTH // 2 + 16)]

    def settled_halves(self):
        """The same, once nothing comes any more: a coarse picture comes first, of one core before the other."""
        seen = [self.halves()]

        def rests(_):
            time.sleep(0.7)
            seen.append(self.halves())
            return seen[-1] == seen[-2]

        self.until(rests)
        return seen[-1]

    def rebuild(self, module):
        """Compiles what porttool wrote (one lane: all that exact mode runs) and links the core's module anew, both by the
        commands of the build; the objects of all other files are the build's."""
        command = next(one for one in json.loads((BUILD / "compile_commands.json").read_text())
                       if one["file"].endswith("target_core/kernels/finalize.cpp"))
        words, out = shlex.split(command["command"]), str(self.folder / "finalize.o")
        words[words.index("-o") + 1], words[words.index("-c") + 1] = out, str(self.folder / "target_core/kernels/finalize.cpp")
        first = next(i for i, word in enumerate(words) if word.startswith("-I"))
        subprocess.run(words[:first] + [f"-I{self.folder}"] + words[first:], cwd=BUILD, check=True)
        lines = subprocess.run(["ninja", "-t", "commands", "target_core_module"], cwd=BUILD, check=True, capture_output=True,
                               text=True).stdout.splitlines()
        line = next(line for line in reversed(lines) if f"/{MODULE} " in line)
        words = shlex.split(line)
        words = words[words.index("&&") + 1:]
        words = words[:words.index("&&")]
        at = words.index("-o")
        subprocess.run(words[:at] + ["-o", str(module), out] + words[at + 2:], cwd=BUILD, check=True)

    def test_an_edit_is_seen_named_ported_and_built(self):
        if not has_both_cores():
            self.skipTest("there is no Vulkan device or no Embree here")
        self.recording = Recording()
        root = KERNELS.parent.parent
        for name in ("source_core", "target_core", "portmap.base"):
            shutil.copytree(root / name, self.folder / name)
        for name in ("portmap.toml", "portmap.lock"):
            shutil.copy(root / name, self.folder / name)
        # porttool writes into no file that git could not bring back.
        for words in (["init", "-q"], ["add", "source_core", "target_core", "portmap.toml"],
                      ["-c", "user.name=a", "-c", "user.email=a@b", "commit", "-qm", "first"]):
            subprocess.run(["git", *words], cwd=self.folder, check=True)
        module = self.folder / "modules" / MODULE
        module.parent.mkdir()
        shutil.copy(next(core["file"] for core in cores() if core["id"] == "target"), module)
        self.open_window("--spp", 16 if RECORD else 2, "--core", "target,source", "--exact", "--kernels", "source_core/kernels",
                         PATHTRACER_MODULES=str(module.parent))
        self.wait_for("pixels", lambda detail: detail["core"] == "target")
        if RECORD:
            self.xdotool("search", "--name", "pathtracer", "windowsize", WIDTH, HEIGHT, "mousemove", WIDTH - 1, HEIGHT - 1)
        # Both in the split: no line between them but the one drawn.
        self.xdotool("key", "h", "key", "2")
        self.wait_for("pixels")
        self.xdotool("key", "3")
        self.until(lambda now: brightness(now) < 2)
        self.xdotool("key", "2")
        self.until(lambda now: brightness(now) > 20)
        before = self.settled_halves()
        self.show(1.5)

        source = self.folder / "source_core/kernels/finalize.glsl"
        target = self.folder / "target_core/kernels/finalize.h"
        text, port = source.read_text(), target.read_text()
        self.assertIn("sum * pass.sample_scale", text)
        source.write_text(text.replace("sum * pass.sample_scale", "sum * pass.sample_scale * 0.25f"))
        found = self.wait_for("finding", lambda detail: detail["state"] == "open")["detail"]
        self.assertEqual(found["rule"], "source-changed")
        self.assertEqual(found["source"], "source_core/kernels/finalize.glsl:finalize_pixel")
        self.until(lambda now: self.halves()[1] < 0.8 * before[1])
        self.assertIn("finalize", [name for one in self.events() if one["event"] == "reload"
                                   for name in one["detail"]["kernels"]])
        self.assertLess(abs(self.halves()[0] - before[0]), before[0] / 10)
        self.show(2)
        self.xdotool("key", "3")
        self.until(lambda now: brightness(now) > 40)
        self.show(2)

        self.xdotool("key", "h", "key", "o")
        shown = self.wait_for("patch")["detail"]
        self.assertEqual(shown["state"], "proposed", shown)
        self.assertIn("sample_scale * 0.25f", shown["patch"])
        self.assertEqual(target.read_text(), port)
        self.show(4)
        asked = self.seen
        self.xdotool("key", "Return")
        written = self.wait_for("patch")["detail"]
        self.assertTrue(written["done"], written)
        self.seen = asked  # the window may look before porttool has ended
        self.wait_for("finding", lambda detail: detail["state"] == "gone")
        self.assertIn("sample_scale * 0.25f", target.read_text())
        self.show(2)

        # One that is gone is no news; what is no module is said, and the core goes on; then the build writes one.
        self.xdotool("key", "h")
        module.unlink()
        (self.folder / "broken").write_text("broken")  # and whole as soon as it is there
        (self.folder / "broken").rename(module)
        said = self.wait_for("error")["detail"]
        self.assertEqual((said["core"], "is no shared object" in said["message"]), ("target", True), said)
        self.until(lambda now: brightness(now) > 40)
        self.rebuild(module)
        self.assertEqual(self.wait_for("reload")["detail"]["module"], MODULE)
        self.wait_for("pixels")
        self.until(lambda now: brightness(now) < 0.5)
        self.show(2)
        self.xdotool("key", "2")
        self.until(lambda now: all(half < 0.8 * before[1] for half in self.halves()))
        self.show(3)
        self.leave()
        if RECORD:
            self.recording.write(RECORD)


class HandTest(Person):
    def test_a_hand_that_asks_for_more_views_than_are_drawn_sees_those_that_are(self):
        self.open_window("--core", "source,target", "--spp", 8, size="640x360")
        self.wait_for("pixels")
        path = ["mousemove", 300, 260, "mousedown", 1]
        for i in range(50 * PATIENCE):
            path += ["mousemove", 330 + 2 * (i % 60), 260, "sleep", 0.012]
        hand = subprocess.Popen(["xdotool", *map(str, path)], env={**os.environ, "DISPLAY": self.screen.display})
        self.addCleanup(lambda: (hand.kill(), hand.wait()))
        self.wait_for("input", lambda detail: detail["kind"] == "orbit")
        self.wait_for("pixels")
        self.assertIsNone(hand.poll(), "it has stopped before")
        hand.kill()
        self.xdotool("mouseup", 1)
        self.leave()


class SizesTest(Person):
    def test_pictures_and_windows_of_one_pixel_and_of_4k(self):
        for size in ("1x1", "3840x2160"):
            self.open_window("--core", "target", "--spp", 1, "--max-path-length", 1, size=size)
            self.wait_for("pixels")
            window = subprocess.run(["xdotool", "search", "--pid", str(self.process.pid)], capture_output=True, check=True, text=True,
                                    env={**os.environ, "DISPLAY": self.screen.display}).stdout.split()[-1]
            for width, height in ((1, 1), (3840, 2160), (640, 360)):
                self.xdotool("windowsize", window, width, height, "sleep", 0.2, "key", "f")
                self.wait_for("input", lambda detail: detail["kind"] == "frame")
                self.wait_for("pixels")
            self.leave()
            self.log.unlink()
            self.seen = 0

    def test_what_is_too_large_for_the_filter_is_shown_with_its_noise(self):
        source = next(core for core in cores() if core["id"] == "source")
        if not source["available"] or "llvmpipe" not in json.dumps(source):
            self.skipTest("it has no limit that is as small as lavapipe's")
        self.open_window("--core", "source", "--filter", "spatial", "--spp", 1, "--max-path-length", 1, size="1300x1000")
        refused = self.wait_for("error")["detail"]
        self.assertEqual(refused["core"], "source")
        self.assertRegex(refused["message"], "filter are more than a kernel of .* reaches at once; use --core target")
        self.xdotool("key", "t", "sleep", 0.2, "key", "t")  # temporal, none: the whole picture, and no other core
        self.wait_for("input", lambda detail: detail["kind"] == "filter")
        self.wait_for("input", lambda detail: detail["kind"] == "filter")
        self.wait_for("pixels", lambda detail: detail["core"] == "source" and detail["samples"] == 1)
        self.assertNotIn("switch", [event["event"] for event in self.events()])
        self.leave()


class RefusedTest(unittest.TestCase):
    def test_says_what_is_missing(self):
        bare = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
        for environment, said in ((bare, b"no display"), ({**bare, "DISPLAY": ":9999"}, b"no window can be opened")):
            got = subprocess.run([PATHTRACER, "view", "still_life"], env=environment, capture_output=True)
            self.assertEqual((got.returncode, got.stdout), (2, b""))
            self.assertIn(said, got.stderr)
            self.assertEqual(got.stderr.count(b"error"), 1)
        got = subprocess.run([PATHTRACER, "view", "nowhere.gltf"], env=bare, capture_output=True)
        self.assertEqual((got.returncode, got.stdout), (2, b""))
        self.assertIn(b"nowhere.gltf: there is no such file", got.stderr)

    def test_says_so_where_there_is_no_opengl(self):
        with tempfile.TemporaryDirectory() as name:
            screen = Screen(name, "-extension", "GLX")
            self.addCleanup(screen.end)
            got = subprocess.run([PATHTRACER, "view", "still_life", "--size", "32x18"], capture_output=True, timeout=PATIENCE,
                                 env={**os.environ, "DISPLAY": screen.display})
            self.assertEqual((got.returncode, got.stdout), (2, b""))
            self.assertRegex(got.stderr, rb"^pathtracer: error: view: no OpenGL 3.0 here: .*GLX.*; install a driver .*\n$")
            self.assertEqual(got.stderr.count(b"\n"), 1)

    def test_says_so_where_the_display_goes_away(self):
        with tempfile.TemporaryDirectory() as name:
            screen = Screen(name)
            log = pathlib.Path(name) / "log"
            window = subprocess.Popen([PATHTRACER, "view", "still_life", "--size", "32x18", "--core", "target", "--log", log],
                                      env={**os.environ, "DISPLAY": screen.display}, stderr=subprocess.PIPE)
            deadline = time.monotonic() + PATIENCE
            while not (log.exists() and b'"pixels"' in log.read_bytes()) and time.monotonic() < deadline:
                time.sleep(0.05)
            screen.process.kill()
            screen.process.wait()
            said = window.communicate(timeout=PATIENCE)[1]
            self.assertEqual(window.returncode, 2, said)
            self.assertEqual(said, b"pathtracer: error: view: the display went away; start it again where there is one\n")

    def test_the_log_takes_the_place_of_nothing_that_is_read_and_waits_for_no_reader(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            shutil.copytree(KERNELS, folder / "kernels")
            (folder / "note.txt").write_text("kept")
            os.mkfifo(folder / "pipe")
            kept = (folder / "kernels/shade.comp").read_bytes()
            for words, said in ((("nosuch.gltf", "--log", "note.txt"), b"nosuch.gltf"),
                                (("nosuch.gltf", "--log", "pipe"), b"a pipe that nobody reads from"),
                                (("still_life", "--kernels", "kernels", "--log", "kernels/shade.comp"), b"--kernels reads")):
                got = subprocess.run([PATHTRACER, "view", *words], cwd=folder, env={**os.environ, "DISPLAY": ":9999"},
                                     capture_output=True, timeout=60)
                self.assertEqual(got.returncode, 2, got.stderr)
                self.assertIn(said, got.stderr)
            self.assertEqual((folder / "note.txt").read_text(), "kept")
            (folder / "none").mkdir()
            for words, said in ((("--kernels", "none"), b"there are no kernels (*.comp) in none"),
                                (("-o", "nope/x.png"), b"--output: cannot write nope/x.png: there is no folder nope"),
                                (("--kernels", "kernels", "-o", "x.png"), b"no window can be opened")):
                got = subprocess.run([PATHTRACER, "view", "still_life", *words], cwd=folder, env={**os.environ, "DISPLAY": ":9999"},
                                     capture_output=True, timeout=60)
                self.assertEqual(got.returncode, 2, got.stderr)
                self.assertIn(said, got.stderr)
            # A texture that has the scene's name is not in the way of what keys save.
            subprocess.run([PATHTRACER, "render", "still_life", "--core", "null", "--size", "4x4", "--spp", "1", "-o", "duck.png"],
                           cwd=folder, check=True, capture_output=True)
            corners = base64.b64encode(struct.pack("<9f", -1, -1, 0, 1, -1, 0, 0, 1, 0)).decode()
            (folder / "duck.gltf").write_text(json.dumps({
                "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}], "images": [{"uri": "duck.png"}],
                "textures": [{"source": 0}], "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]}],
                "bufferViews": [{"buffer": 0, "byteLength": 36}],
                "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64," + corners}]}))
            for words, said in ((("duck.gltf",), b"no window can be opened"),
                                (("duck.gltf", "-o", "duck.png"), b"-o duck.png: the scene reads this file")):
                got = subprocess.run([PATHTRACER, "view", *words], cwd=folder, env={**os.environ, "DISPLAY": ":9999"},
                                     capture_output=True, timeout=60)
                self.assertEqual(got.returncode, 2, got.stderr)
                self.assertIn(said, got.stderr)
            self.assertEqual((folder / "kernels/shade.comp").read_bytes(), kept)


if __name__ == "__main__":
    for program in ("Xvfb", "xdotool"):
        if shutil.which(program) is None:
            skip(f"there is no {program} here")
    if b"built without a window" in subprocess.run([PATHTRACER, "view", "still_life"], capture_output=True).stderr:
        skip("this build has no window")
    unittest.main(argv=[sys.argv[0], "StoryTest"] if RECORD else sys.argv)
