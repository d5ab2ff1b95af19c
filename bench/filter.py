#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""What --filter spatial leaves of noise: 4 filtered samples held against 32 plain ones, over several seeds.

    bench/filter.py build/release/bin/pathtracer out --scene still_life --scene ../shared/scenes/pica/scene.gltf

A camera.json beside a scene is used. References are rendered once and kept in the folder; one that was interrupted goes on.
Error is that of the 8-bit values of PNGs (--tone-map): root mean square over all pixels, and mean SSIM of luma (Gaussian of
11 pixels, sigma 1.5) over the tenth of the pixels at which the reference's Sobel gradient is largest. Brightness is the ratio
of mean linear values of those PNGs, so it says little where much is clipped. Times are the least of all seeds: that of the
filter without its guides, and that of all processors for the whole run, from loading the scene on. Prints a table and exits
with 1 where a median misses its bar.
"""
import argparse
import math
import pathlib
import re
import resource
import statistics
import struct
import subprocess
import sys
import zlib


def read_png(path):
    """Width, height and rows of 8-bit RGB of a PNG that is not interlaced."""
    data = path.read_bytes()
    place, packed, width, height = 8, b"", 0, 0
    while place < len(data):
        length, kind = struct.unpack(">I4s", data[place:place + 8])
        body = data[place + 8:place + 8 + length]
        if kind == b"IHDR":
            width, height, bits, color = struct.unpack(">IIBB", body[:10])
            if (bits, color) != (8, 2):
                sys.exit(f"{path}: not 8-bit RGB")
        elif kind == b"IDAT":
            packed += body
        place += length + 12
    raw, stride = zlib.decompress(packed), width * 3
    rows, above = [], bytearray(stride)
    for y in range(height):
        kind, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            left, up, corner = (line[i - 3] if i > 2 else 0), above[i], (above[i - 3] if i > 2 else 0)
            if kind == 1:
                line[i] = line[i] + left & 255
            elif kind == 2:
                line[i] = line[i] + up & 255
            elif kind == 3:
                line[i] = line[i] + (left + up) // 2 & 255
            elif kind == 4:
                guess = left + up - corner
                nearest = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))
                line[i] = line[i] + nearest[2] & 255
        rows.append(line)
        above = line
    return width, height, b"".join(rows)


def luma(pixels):
    return [(0.2126 * pixels[i] + 0.7152 * pixels[i + 1] + 0.0722 * pixels[i + 2]) / 255 for i in range(0, len(pixels), 3)]


KERNEL = [math.exp(-(i - 5) ** 2 / 4.5) for i in range(11)]
KERNEL = [k / sum(KERNEL) for k in KERNEL]


def blurred(values, width, height):
    def along(lines):
        result = []
        for line in lines:
            padded = [line[0]] * 5 + list(line) + [line[-1]] * 5
            result.append([sum(k * v for k, v in zip(KERNEL, padded[i:i + 11])) for i in range(len(line))])
        return result
    rows = along([values[y * width:(y + 1) * width] for y in range(height)])
    columns = along(zip(*rows))
    return [value for row in zip(*columns) for value in row]


def edges(values, width, height):
    """The tenth of the pixels where the Sobel gradient is largest."""
    def at(x, y):
        return values[min(max(y, 0), height - 1) * width + min(max(x, 0), width - 1)]
    gradients = []
    for y in range(height):
        for x in range(width):
            gx = sum(w * (at(x + 1, y + d) - at(x - 1, y + d)) for d, w in ((-1, 1), (0, 2), (1, 1)))
            gy = sum(w * (at(x + d, y + 1) - at(x + d, y - 1)) for d, w in ((-1, 1), (0, 2), (1, 1)))
            gradients.append(math.hypot(gx, gy))
    limit = sorted(gradients)[len(gradients) * 9 // 10]
    return [i for i, g in enumerate(gradients) if g >= limit]


class Reference:
    def __init__(self, path):
        self.width, self.height, self.pixels = read_png(path)
        self.luma = luma(self.pixels)
        self.edges = edges(self.luma, self.width, self.height)
        self.mean = blurred(self.luma, self.width, self.height)
        self.square = blurred([v * v for v in self.luma], self.width, self.height)

    def errors(self, path):
        """Root mean square error, SSIM on edges, and mean linear brightness over that of the reference."""
        _, _, pixels = read_png(path)
        rmse = math.sqrt(sum((a - b) ** 2 for a, b in zip(pixels, self.pixels)) / len(pixels))
        values = luma(pixels)
        mean = blurred(values, self.width, self.height)
        square = blurred([v * v for v in values], self.width, self.height)
        product = blurred([a * b for a, b in zip(values, self.luma)], self.width, self.height)
        total = 0.0
        for i in self.edges:
            a, b = mean[i], self.mean[i]
            total += ((2 * a * b + 1e-4) * (2 * (product[i] - a * b) + 9e-4) /
                      ((a * a + b * b + 1e-4) * (square[i] - a * a + self.square[i] - b * b + 9e-4)))
        linear = [(v / 255 + 0.055) ** 2.4 for v in range(256)]
        bright = sum(linear[v] for v in pixels) / sum(linear[v] for v in self.pixels)
        return rmse, total / len(self.edges), bright


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--scene", action="append", required=True)
    parser.add_argument("--size", default="320x180")
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--core", default="target")
    parser.add_argument("--tone-map", default="none")
    parser.add_argument("--reference-spp", type=int, default=4096)
    given = parser.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)

    def render(scene, name, *more):
        """The picture, what was said on the way, and the processor time of it all in seconds."""
        camera = pathlib.Path(scene).parent / "camera.json"
        command = [given.program, "render", scene, "--size", given.size, "--core", given.core, "--tone-map", given.tone_map,
                   "-o", given.folder / name, "--verbose", *more]
        if camera.is_file():
            command += ["--camera", camera]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(done.stderr)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return given.folder / name, done.stderr, spent

    missed = False
    print(f"{'scene':12} {'picture':12} {'RMSE':>8} {'SSIM on edges':>14} {'brightness':>11} {'filter ms':>10} {'CPU s':>7}")
    for scene in given.scene:
        path = pathlib.Path(scene)
        name = path.parent.name if path.suffix else scene
        key = f"{name}-{given.size}-{given.tone_map}"
        reference = given.folder / f"{key}-reference-{given.reference_spp}.png"
        if not reference.exists():
            render(scene, reference.name, "--spp", str(given.reference_spp), "--seed", "1000", "--checkpoint", "60",
                   "--resume")
        reference = Reference(reference)
        medians = {}
        for label, options in (("4", ["--spp", "4"]), ("32", ["--spp", "32"]),
                               ("4 filtered", ["--spp", "4", "--filter", "spatial"])):
            found, times, spent = [], [], []
            for seed in range(given.seeds):
                name_of_picture = f"{key}-{label.replace(' ', '-')}-{seed}.png"
                picture, said, seconds = render(scene, name_of_picture, *options, "--seed", str(seed))
                found.append(reference.errors(picture))
                spent.append(seconds)
                times += [float(t) for t in re.findall(r"filter: ([0-9.]+) ms", said)]
            medians[label] = [statistics.median(column) for column in zip(*found)]
            rmse, ssim, bright = medians[label]
            took = f"{min(times):10.2f}" if times else f"{'-':>10}"
            print(f"{name:12} {label:12} {rmse:8.3f} {ssim:14.4f} {bright:11.4f} {took} {min(spent):7.2f}", flush=True)
        plain, filtered = medians["32"], medians["4 filtered"]
        for what, met in (("RMSE", filtered[0] <= plain[0]), ("SSIM on edges", filtered[1] >= plain[1]),
                          ("brightness", abs(filtered[2] - 1) <= 0.01)):
            missed = missed or not met
            print(f"{name:12} {what}: {'met' if met else 'MISSED'}", flush=True)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
