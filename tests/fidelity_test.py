#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""bench/fidelity.py and its pictures: fidelity_test.py PATHTRACER. Exit code 77 (skipped) where there is no numpy."""
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent
PATHTRACER = pathlib.Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else ROOT / "build/release/bin/pathtracer"
sys.path.insert(0, str(ROOT / "bench"))
try:
    import numpy
    import pictures
except ImportError:
    sys.exit(77)
import fidelity  # noqa: E402

fidelity.numpy, fidelity.pictures = numpy, pictures


class Pictures(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)

    def test_exr_of_pathtracer_holds_what_was_rendered(self):
        # One segment sees the sky alone: two strips of a map, left and right of straight ahead.
        pixels = numpy.zeros((128, 256, 4), numpy.uint8)
        pixels[:, :128], pixels[:, 128:] = (128, 0, 0, 129), (0, 64, 0, 130)
        pictures.write_radiance(self.path / "sky.hdr", pixels)
        scene = ROOT / "tests/render_system/formats/triangles.gltf"
        subprocess.run([PATHTRACER, "render", scene, "--core", "target", "--quiet", "--size", "20x37", "--spp", "1",
                        "--max-path-length", "1", "--look-at=0,500,0,0,500,-1", "--sky", self.path / "sky.hdr", "-o",
                        self.path / "a.exr"], check=True)
        picture = pictures.read_exr(self.path / "a.exr")
        self.assertEqual(picture.shape, (37, 20, 3))
        numpy.testing.assert_allclose(picture[:, 0], [[1, 0, 0]] * 37, atol=0.01)
        numpy.testing.assert_allclose(picture[:, -1], [[0, 1, 0]] * 37, atol=0.01)

    def test_radiance_comes_back_as_it_was_written(self):
        pixels = numpy.arange(3 * 300 * 4, dtype=numpy.uint8).reshape(3, 300, 4)
        pictures.write_radiance(self.path / "a.hdr", pixels)
        self.assertTrue((pictures.read_radiance(self.path / "a.hdr") == pixels).all())
        (self.path / "b.hdr").write_bytes(b"no picture")
        with self.assertRaises(ValueError):
            pictures.read_radiance(self.path / "b.hdr")

    def test_halves_weigh_colour_by_cover(self):
        picture = numpy.zeros((2, 2, 4))
        picture[0, 0] = (1, 0.5, 0, 1)
        numpy.testing.assert_allclose(pictures.halved(picture), [[[1, 0.5, 0, 0.25]]])

    def test_distances(self):
        everywhere = numpy.ones((16, 16), bool)
        a = numpy.random.default_rng(1).random((16, 16, 3))
        self.assertAlmostEqual(pictures.ssim(a, a, everywhere), 1.0)
        self.assertAlmostEqual(pictures.rmse(a, a + 0.5, everywhere), 127.5)
        self.assertLess(pictures.ssim(a, 1 - a, everywhere), 0)
        self.assertTrue(math.isnan(pictures.rmse(a, a, ~everywhere)))


class Verdict(unittest.TestCase):
    def test_apart_is_further_than_the_furthest_of_the_others(self):
        near = {("a", "b"): 1.0, ("a", "c"): 5.0, ("b", "c"): 5.0, ("ours", "a"): 4.0, ("ours", "b"): 4.0, ("ours", "c"): 4.0}
        found = {pair: {"rmse": value} for (x, y), value in near.items() for pair in ((x, y), (y, x))}
        self.assertEqual(fidelity.verdict(found, ["a", "b", "c"], "rmse"), {"ours": 4.0, "theirs": 5.0})
        self.assertTrue(math.isnan(fidelity.verdict(found, ["a"], "rmse")["theirs"]))

    def test_the_camera_goes_around_its_target(self):
        scenario = {"orbit": {"radius": 2, "theta": 90, "phi": 90}, "target": {"x": 1, "y": 2, "z": 3}}
        view = [float(word) for word in fidelity.look_at(scenario).split(",")]
        numpy.testing.assert_allclose(view, [3, 2, 3, 1, 2, 3], atol=1e-6)
        scenario["orbit"] = {"radius": 0, "theta": 0, "phi": 90}
        numpy.testing.assert_allclose([float(word) for word in fidelity.look_at(scenario).split(",")], [1, 2, 3, 1, 2, 2], atol=1e-6)


if __name__ == "__main__":
    unittest.main()
