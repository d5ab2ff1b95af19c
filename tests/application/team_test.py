#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""mpirun gives the file of one process, to the bit, and a dead rank ends the run: team_test.py PATHTRACER SCENE

Skipped (77) where mpirun or pathtracer-mpi is missing.
"""
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM, SCENE = pathlib.Path(sys.argv[1]), sys.argv[2]
RENDER = ["render", SCENE, "--core", "target", "--size", "100x57"]
# Containers run as root and have few cores; nothing here needs a network.
MPIRUN = ["mpirun", "--allow-run-as-root", "--oversubscribe", "--bind-to", "none", "--mca", "btl", "self,vader"]


def environment():
    return {**os.environ, "OMPI_MCA_plm_rsh_agent": "", "OMPI_MCA_rmaps_base_oversubscribe": "1"}


def team(ranks, *arguments, program=PROGRAM):
    return subprocess.run([*MPIRUN, "-n", str(ranks), str(program), *arguments], capture_output=True, text=True, timeout=180,
                          env=environment())


def ranks_of(process):
    """The processes that this mpirun has started; the first is rank 0."""
    return sorted(map(int, subprocess.run(["pgrep", "-P", str(process.pid)], capture_output=True, text=True).stdout.split()))


def state_of(process):
    """What the kernel says of a process; None where it has ended, waited for or not."""
    try:
        state = pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[0]
    except (FileNotFoundError, ProcessLookupError):
        return None
    return None if state in "ZX" else state


class Teams(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name)

    def file(self, name):
        return str(self.path / name)

    def bytes(self, name):
        return (self.path / name).read_bytes()

    def test_any_number_of_ranks_and_threads_gives_the_same_file(self):
        alone = subprocess.run([PROGRAM, *RENDER, "--samples", "2:9", "-o", self.file("alone.exr")], capture_output=True)
        self.assertEqual(alone.returncode, 0, alone.stderr)
        for ranks, threads in ((2, 1), (3, 2)):
            name = f"team{ranks}.exr"
            result = team(ranks, *RENDER, "--samples", "2:9", "--threads", str(threads), "-o", self.file(name))
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(result.stdout, "")
            self.assertEqual(result.stderr.count("7 samples per pixel"), 1, "one rank speaks: " + result.stderr)
            self.assertEqual(self.bytes(name), self.bytes("alone.exr"))
        noise = ["--noise", "0.6", "--threads", "1"]
        self.assertEqual(subprocess.run([PROGRAM, *RENDER, *noise, "-o", self.file("n.png")], capture_output=True).returncode, 0)
        result = team(2, *RENDER, *noise, "-o", self.file("m.png"))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.bytes("m.png"), self.bytes("n.png"), "noise ends a team after the same sample")

    def test_frames_are_those_of_one_process_each_rendered_once(self):
        frames = [*RENDER, "--spp", "2", "--frames", "0:5", "--threads", "1", "-o"]
        alone = subprocess.run([PROGRAM, *frames, self.file("alone_##.png")], capture_output=True)
        self.assertEqual(alone.returncode, 0, alone.stderr)
        result = team(3, *frames, self.file("team_##.png"))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr.count("5 frames of 100x57"), 1, "one rank speaks, of all frames: " + result.stderr)
        self.assertEqual([self.bytes(f"team_{i:02}.png") for i in range(5)], [self.bytes(f"alone_{i:02}.png") for i in range(5)])
        (self.path / "team_03.png").unlink()
        times = {i: (self.path / f"team_{i:02}.png").stat().st_mtime_ns for i in (0, 1, 2, 4)}
        result = team(2, *frames, self.file("team_##.png"), "--resume")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("4 of them kept", result.stderr)
        self.assertEqual({i: (self.path / f"team_{i:02}.png").stat().st_mtime_ns for i in times}, times)
        self.assertEqual(self.bytes("team_03.png"), self.bytes("alone_03.png"))

    def test_a_frame_that_one_stopped_rank_has_dropped_is_not_said_to_be_done(self):
        frames = [*RENDER, "--spp", "100", "--frames", "0:6", "--threads", "1", "-o"]
        process = subprocess.Popen([*MPIRUN, "-n", "2", str(PROGRAM), *frames, self.file("team_##.png")],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env=environment())
        while not list(self.path.glob("team_??.png")):
            self.assertIsNone(process.poll(), "ended by itself")
            time.sleep(0.01)
        os.kill(max(ranks_of(process)), signal.SIGTERM)
        _, errors = process.communicate(timeout=100)
        self.assertEqual(process.returncode, 143, errors)
        self.assertIn("interrupted by SIGTERM: 5 of 6 frames are done; --resume", errors)
        self.assertEqual(len(list(self.path.iterdir())), 5)
        result = team(2, *frames, self.file("team_##.png"), "--resume")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("5 of them kept", result.stderr)

    def test_pictures_that_follow_from_each_other_are_those_of_one_process(self):
        common = [*RENDER, "--filter", "temporal", "--threads", "1"]
        for name, more, files in (("{}.exr", ["--spp", "5"], ["{}.exr"]),
                                  ("{}_#.png", ["--spp", "2", "--frames", "2:6"], [f"{{}}_{i}.png" for i in range(2, 6)])):
            alone = subprocess.run([PROGRAM, *common, *more, "-o", self.file(name.format("alone"))], capture_output=True)
            self.assertEqual(alone.returncode, 0, alone.stderr)
            result = team(3, *common, *more, "-o", self.file(name.format("team")))
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(result.stderr.count("2 samples per pixel" if len(files) > 1 else "5 samples per pixel"), 1)
            for file in files:
                self.assertEqual(self.bytes(file.format("team")), self.bytes(file.format("alone")), file)

    def test_a_team_and_one_process_go_on_from_each_other(self):
        """A sequence is killed under a team, goes on alone and is done by a team: the frames are those of one run."""
        common = [*RENDER, "--filter", "temporal", "--threads", "1", "--spp", "2"]
        output = ["-o", self.file("f_##.png"), "--checkpoint", "0.0001s", "--resume"]
        checkpoint = self.path / "f_##.png.checkpoint"
        done = lambda: int(checkpoint.read_bytes().split(b'"frames":')[1].split(b",")[0]) if checkpoint.exists() else 0
        before = 0
        for start in ([*MPIRUN, "-n", "2", str(PROGRAM)], [str(PROGRAM)]):
            process = subprocess.Popen([*start, *common, "--frames", "0:80", *output], stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL, env=environment())
            deadline = time.monotonic() + 100
            while done() < before + 2 and time.monotonic() < deadline:
                time.sleep(0.02)
            os.kill(process.pid, signal.SIGTERM if start[0] == "mpirun" else signal.SIGKILL)
            process.communicate(timeout=60)
            self.assertGreaterEqual(done(), before + 2)
            before = done()
        result = team(2, *common, "--frames", f"0:{before + 2}", *output)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn(f"going on after {before} frames", result.stderr)
        alone = subprocess.run([PROGRAM, *common, "--frames", f"0:{before + 2}", "-o", self.file("a_##.png")], capture_output=True)
        self.assertEqual(alone.returncode, 0, alone.stderr)
        for i in range(before + 2):
            self.assertEqual(self.bytes(f"f_{i:02}.png"), self.bytes(f"a_{i:02}.png"), i)

    def test_what_fails_is_said_once(self):
        for arguments, word in ((["render", "missing.gltf"], "missing.gltf"), ([*RENDER, "-o", "missing/a.png"], "missing/a.png"),
                                ([*RENDER, "--spp", "0"], "--spp"), ([*RENDER, "--frames", "0:3", "-o", "missing/##.png"], "missing"),
                                ([*RENDER, "--core", "nonsense"], "nonsense")):
            result = team(2, *arguments)
            self.assertNotEqual(result.returncode, 0)
            said = [line for line in result.stderr.splitlines() if line.startswith("pathtracer: error")]
            self.assertEqual(len(said), 1, result.stderr)
            self.assertIn(word, said[0])

    def test_ranks_that_were_told_other_things_are_told_and_nobody_waits(self):
        """Some of these hung, some ended in an error of MPI, some gave frames of two kinds."""
        first = [*RENDER, "--spp", "2", "-o", self.file("a_#.png")]
        for other, words in ((["--frames", "0:3"], "--frames is none and here 0:3"), (["--filter", "temporal"], "--filter is none"),
                             (["--nonsense"], "the command is render and here none")):
            result = subprocess.run([*MPIRUN, "-n", "1", PROGRAM, *first, ":", "-n", "1", PROGRAM, *first, *other],
                                    capture_output=True, text=True, timeout=60, env=environment())
            self.assertEqual(result.returncode, 2, result.stderr)
            said = [line for line in result.stderr.splitlines() if line.startswith("pathtracer: error")]
            self.assertEqual(len(said), 1, result.stderr)
            self.assertIn(words, said[0])
        frames = [*first, "--frames", "0:4", "--spp"]
        result = subprocess.run([*MPIRUN, "-n", "1", PROGRAM, *frames, "2", ":", "-n", "1", PROGRAM, *frames, "3"],
                                capture_output=True, text=True, timeout=60, env=environment())
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn("--spp is 2 and here 3", result.stderr)
        self.assertEqual(list(self.path.iterdir()), [])

    def test_a_damaged_checkpoint_is_told_once_and_nobody_waits(self):
        output = self.file("a.png")
        stopped = subprocess.run([PROGRAM, *RENDER, "--spp", "1000000", "--time-limit", "0.3s", "--checkpoint", "10m", "-o", output],
                                 capture_output=True)
        self.assertEqual(stopped.returncode, 0, stopped.stderr)
        checkpoint = self.path / "a.png.checkpoint"
        checkpoint.write_bytes(checkpoint.read_bytes()[:-1])
        result = team(2, *RENDER, "--spp", "1000000", "--resume", "-o", output)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(result.stderr.count("a.png.checkpoint"), 1, result.stderr)

    def test_a_disk_that_fills_costs_a_team_no_more_than_what_came_since(self):
        """No file may grow any more once there is a checkpoint: it stays, the picture is refused in one line, all end."""
        output, checkpoint = self.file("a.exr"), self.path / "a.exr.checkpoint"
        arguments = [*RENDER, "--threads", "1", "-o"]
        process = subprocess.Popen([*MPIRUN, "-n", "2", str(PROGRAM), *arguments, output, "--spp", "1000000", "--checkpoint", "0.05s"],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env=environment())
        while not checkpoint.exists():
            self.assertIsNone(process.poll(), "ended by itself")
            time.sleep(0.01)
        ranks = ranks_of(process)
        for rank in ranks:
            resource.prlimit(rank, resource.RLIMIT_FSIZE, (100, 100))
        said = ""
        while "rendering goes on" not in said:
            said += (line := process.stderr.readline())
            self.assertTrue(line, "ended by itself: " + said)
        self.assertIn("a.exr.checkpoint: File too large", said)
        kept = checkpoint.read_bytes()
        os.kill(min(ranks), signal.SIGTERM)
        said += process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 2, said)
        errors = [line for line in said.splitlines() if line.startswith("pathtracer: error")]
        self.assertEqual(len(errors), 1, said)
        self.assertRegex(errors[0], "a.exr: File too large")
        self.assertEqual([f.name for f in self.path.iterdir()], ["a.exr.checkpoint"], "nothing torn is left")
        self.assertEqual(checkpoint.read_bytes(), kept)
        self.assertEqual(list(map(state_of, ranks)), [None, None], "all have ended")
        done = int(kept.split(b'"samples":')[1].split(b",")[0])
        result = team(2, *arguments, output, "--spp", str(done + 2), "--resume")
        self.assertIn(f"going on after {done} ", result.stderr)
        alone = subprocess.run([PROGRAM, *arguments, self.file("b.exr"), "--spp", str(done + 2)], capture_output=True)
        self.assertEqual(alone.returncode, 0, alone.stderr)
        self.assertEqual(self.bytes("a.exr"), self.bytes("b.exr"))

    def test_frames_on_a_small_disk_end_the_team_at_the_one_that_does_not_fit(self):
        disk = self.path / "disk"
        disk.mkdir()
        mounted = f'mount -t tmpfs -o size=64k none "{disk}" && '
        inside = ["unshare", "--user", "--map-root-user", "--mount", "sh", "-c"]
        if subprocess.run([*inside, mounted + "true"], capture_output=True).returncode != 0:
            self.skipTest("no small disk can be mounted here without privileges")
        command = [*MPIRUN, "-n", "2", str(PROGRAM), *RENDER, "--spp", "1", "--frames", "0:12", "--threads", "1", "-o",
                   str(disk / "f_##.png")]
        result = subprocess.run([*inside, mounted + '"$@"; code=$?; ls "$0"; cp "$0"/* "$0/.."; exit $code', str(disk), *command],
                                capture_output=True, text=True, timeout=180, env=environment())
        self.assertEqual(result.returncode, 2, result.stderr)
        errors = [line for line in result.stderr.splitlines() if line.startswith("pathtracer: error")]
        self.assertEqual(len(errors), 1, result.stderr)
        self.assertRegex(errors[0], r"f_\d\d.png: No space left on device")
        there = result.stdout.split()
        self.assertIn(len(there), range(1, 12))
        alone = subprocess.run([PROGRAM, *RENDER, "--spp", "1", "--frames", "0:12", "-o", self.file("a_##.png")], capture_output=True)
        self.assertEqual(alone.returncode, 0, alone.stderr)
        for name in there:
            self.assertRegex(name, r"^f_\d\d.png$")
            self.assertEqual(self.bytes(name), self.bytes(name.replace("f_", "a_")), name)

    def test_a_resumed_team_hears_of_its_limit_as_a_fresh_one_does(self):
        """By counts of samples: a first round of unknown length took many times as long."""
        endless = [*RENDER[:-1], "64x36", "--spp", "1000000", "--threads", "1", "--checkpoint", "10m"]
        stopped = subprocess.run([PROGRAM, *endless, "--time-limit", "0.3s", "-o", self.file("a.exr")], capture_output=True)
        self.assertEqual(stopped.returncode, 0, stopped.stderr)
        counts = []
        for name, more in (("fresh.exr", []), ("a.exr", ["--resume"])):
            result = team(2, *endless, "--time-limit", "3s", *more, "-o", self.file(name))
            self.assertEqual(result.returncode, 0, result.stderr)
            before = re.search(r"going on after (\d+)", result.stderr)
            after = re.search(r"the picture has (\d+)", result.stderr)
            counts.append(int(after.group(1)) - (int(before.group(1)) if before else 0))
        self.assertLess(counts[1], 2 * counts[0] + 200)

    def test_a_slow_rank_takes_fewer_tiles_and_the_others_wait_for_one_at_most(self):
        """Rank 1 is stopped nearly all of the time: what is left to it a loaded machine gives it at once."""
        arguments = [*RENDER[:-1], "200x114", "--spp", "1000000", "--time-limit", "6s", "--threads", "1"]
        process = subprocess.Popen([*MPIRUN, "-n", "2", str(PROGRAM), *arguments, "-o", self.file("a.exr")],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   env={**environment(), "PATHTRACER_TILE_TIMES": self.file("times")})
        while not (self.path / "times.1").exists() or (self.path / "times.1").stat().st_size == 0:  # until it has loaded
            self.assertIsNone(process.poll(), "ended by itself")
            time.sleep(0.01)
        slow = max(ranks_of(process))
        try:
            while process.poll() is None:
                for number, seconds in ((signal.SIGSTOP, 0.1), (signal.SIGCONT, 0.005)):
                    os.kill(slow, number)
                    time.sleep(seconds)
        except ProcessLookupError:
            pass
        _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 0, errors)
        lines = [(self.path / f"times.{rank}").read_text().splitlines() for rank in (0, 1)]
        tiles = [[tuple(map(float, line.split())) for line in of] for of in lines]
        pixels = [sum(tile[2] for tile in of) for of in tiles]
        self.assertLess(pixels[1], pixels[0], "a slow rank takes fewer")
        rounds = {tile[0] for of in tiles for tile in of}
        for number in rounds:
            fast, slow = ([tile for tile in of if tile[0] == number] for of in tiles)
            self.assertEqual(sum(tile[2] for tile in fast + slow), 200 * 114, "each pixel once a round")
            if not fast or not slow:
                continue
            wait = slow[-1][-1] - fast[-1][-1]
            self.assertLess(wait, slow[-1][-1] - slow[-1][3] + 0.1, f"round {number:.0f}: no more than its last tile")
        samples = int(errors.split("the picture has ")[1].split(" ")[0])
        alone = subprocess.run([PROGRAM, *RENDER[:-1], "200x114", "--spp", str(samples), "-o", self.file("b.exr")], capture_output=True)
        self.assertEqual(alone.returncode, 0, alone.stderr)
        self.assertEqual(self.bytes("a.exr"), self.bytes("b.exr"))

    def test_a_dead_rank_ends_the_run_and_resume_goes_on(self):
        output = self.file("a.png")
        arguments = [*RENDER, "--spp", "40", "--threads", "1", "--checkpoint", "0.05s", "-o", output]
        slow = [*RENDER, "--spp", "1000000", "--threads", "1", "--checkpoint", "0.05s", "-o", output]
        process = subprocess.Popen([*MPIRUN, "-n", "2", str(PROGRAM), *slow], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True, env=environment())
        checkpoint = self.path / "a.png.checkpoint"
        deadline = time.monotonic() + 100
        while not checkpoint.exists() and time.monotonic() < deadline:
            time.sleep(0.02)
        self.assertTrue(checkpoint.exists())
        ranks = subprocess.run(["pgrep", "-P", str(process.pid)], capture_output=True, text=True).stdout.split()
        self.assertEqual(len(ranks), 2)
        os.kill(int(ranks[-1]), signal.SIGKILL)
        _, errors = process.communicate(timeout=60)
        self.assertNotEqual(process.returncode, 0)
        self.assertRegex(errors, "rank 1.*(\n.*)?signal 9", "which rank died, and of what")
        wanted = int(checkpoint.read_bytes().split(b'"samples":')[1].split(b",")[0]) + 3
        arguments = [*RENDER, "--spp", str(wanted), "--threads", "1", "-o"]
        result = team(2, *arguments, output, "--resume")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("going on after", result.stderr)
        self.assertEqual(subprocess.run([PROGRAM, *arguments, self.file("b.png")], capture_output=True).returncode, 0)
        self.assertEqual(self.bytes("a.png"), self.bytes("b.png"))


if __name__ == "__main__":
    if shutil.which("mpirun") is None or not (PROGRAM.parent / "pathtracer-mpi").exists():
        print("skipped: no mpirun, or pathtracer was built without MPI")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=2)
