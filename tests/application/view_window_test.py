# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""`pathtracer view` as a person uses it: under Xvfb, with xdotool, and a look into what stands on the screen."""
import json
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest

PATHTRACER = os.path.abspath(sys.argv.pop(1))
KERNELS = pathlib.Path(os.path.abspath(sys.argv.pop(1)))
WIDTH, HEIGHT = 640, 360
PATIENCE = 40


def skip(why):
    print("skipped: " + why)
    sys.exit(77)


class Screen:
    """An X server without a screen; its picture lies in a file, in the format of xwd (X11/XWDFile.h)."""

    def __init__(self, folder):
        self.folder = folder
        ends = os.pipe()
        self.process = subprocess.Popen(
            ["Xvfb", "-displayfd", str(ends[1]), "-screen", "0", f"{WIDTH}x{HEIGHT}x24", "-fbdir", folder,
             "-nolisten", "tcp"], pass_fds=[ends[1]], stderr=subprocess.DEVNULL)
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

    def open_window(self, *options):
        self.process = subprocess.Popen(
            [PATHTRACER, "view", "still_life", "--size", "160x90", "--log", self.log, *map(str, options)],
            cwd=self.folder, env={**os.environ, "DISPLAY": self.screen.display}, stderr=subprocess.PIPE)
        self.addCleanup(lambda: (self.process.kill(), self.process.communicate()))

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

def has_both_cores():
    listed = json.loads(subprocess.run([PATHTRACER, "info", "--format", "json"], capture_output=True).stdout)
    return all(core["available"] for core in listed["cores"])


class ViewTest(Person):
    def test_a_person_looks_orbits_switches_compares_and_leaves(self):
        self.open_window("--spp", 8, "-o", "saved.png", "--core", "target,source")
        self.wait_for("pixels", lambda detail: detail["core"] == "target")
        first = self.until(lambda now: brightness(now) > 20)
        self.assertGreater(len(set(first)), 200)

        self.xdotool("mousemove", 300, 260, "sleep", 0.1, "mousedown", 1, "sleep", 0.1, "mousemove", 360, 250, "sleep", 0.1,
                     "mousemove", 420, 240, "sleep", 0.1, "mouseup", 1)
        asked = self.wait_for("input", lambda detail: detail["kind"] == "orbit")
        answered = self.wait_for("pixels")
        self.assertGreaterEqual(answered["t_ms"], asked["t_ms"])
        orbited = brightness(self.until(lambda now: apart(now, first) > 8 and brightness(now) > 5))

        self.xdotool("mousemove", 320, 300, "sleep", 0.1, "click", 1)
        picked = self.wait_for("input", lambda detail: detail["kind"] == "pick")
        self.assertRegex(picked["detail"]["found"], "instance [0-9]+, material")

        self.xdotool("key", "p")
        self.wait_for("input", lambda detail: detail["kind"] == "save")
        png = (self.folder / "saved.png").read_bytes()
        self.assertEqual(struct.unpack(">II", png[16:24]), (160, 90))

        if has_both_cores():
            self.xdotool("key", "Tab")
            self.wait_for("switch", lambda detail: detail["core"] == "source")
            self.wait_for("pixels", lambda detail: detail["core"] == "source")
            # The same paths: the difference times 16 is all but black.
            self.xdotool("key", "3")
            self.until(lambda now: brightness(now) < orbited / 4)
            self.xdotool("key", "2")
            self.until(lambda now: abs(brightness(now) - orbited) < orbited / 4)
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

        self.save("finalize.glsl")
        self.wait_for("reload", lambda detail: detail["core"] == "source")
        self.xdotool("key", "Tab")
        self.wait_for("pixels", lambda detail: detail["core"] == "source")
        plain = brightness(self.until(lambda now: red() < WIDTH / 2 and brightness(now) > 20))
        self.save("finalize.glsl", ("sum * pass.sample_scale", "0.25 * sum * pass.sample_scale"))
        self.assertEqual(self.wait_for("reload")["detail"]["kernels"], ["finalize"])
        self.wait_for("pixels", lambda detail: detail["core"] == "source")
        self.until(lambda now: brightness(now) < 0.7 * plain)
        (self.kernels / "finalize.glsl").unlink()
        self.assertIn("finalize.glsl", self.wait_for("error", lambda detail: detail.get("core") == "source")["detail"]["message"])
        self.until(lambda now: red() > WIDTH / 2 and brightness(now) < 0.7 * plain)
        self.save("finalize.glsl")
        self.wait_for("pixels", lambda detail: detail["core"] == "source")
        self.until(lambda now: red() < WIDTH / 2 and abs(brightness(now) - plain) < plain / 10)
        self.leave()


class RefusedTest(unittest.TestCase):
    def test_says_what_is_missing(self):
        bare = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
        for environment, said in ((bare, b"no display"), ({**bare, "DISPLAY": ":9999"}, b"no window can be opened")):
            got = subprocess.run([PATHTRACER, "view", "still_life"], env=environment, capture_output=True)
            self.assertEqual((got.returncode, got.stdout), (2, b""))
            self.assertIn(said, got.stderr)
            self.assertEqual(got.stderr.count(b"error"), 1)


if __name__ == "__main__":
    for program in ("Xvfb", "xdotool"):
        if shutil.which(program) is None:
            skip(f"there is no {program} here")
    if b"built without a window" in subprocess.run([PATHTRACER, "view", "still_life"], capture_output=True).stderr:
        skip("this build has no window")
    unittest.main()
