#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""What --filter spatial leaves of noise: 4 filtered samples held against 32 plain ones, over several seeds.

    bench/filter.py build/release/bin/pathtracer out --scene still_life --scene ../shared/scenes/pica/scene.gltf

A camera.json beside a scene is used. References are rendered once and kept in the folder; one that was interrupted goes on.
All is measured on linear EXR files. Error is that of tone-mapped values (Khronos PBR Neutral, or --tone-map none, which cuts
off), from 0 to 255 of the sRGB curve and not rounded: root mean square over all pixels, and mean SSIM of luma (Gaussian of
11 pixels, sigma 1.5) over the tenth of the pixels at which the reference's Sobel gradient is largest. Brightness is the mean
radiance over that of the reference: no curve, and nothing cut off. Times are the least of all seeds: that of the filter
without its guides, that of its guides, and that of all processors for the whole run, from loading the scene on. Prints a
table and exits with 1 where a median misses its bar.
"""
import argparse
import array
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


def number_at(data, place, kind="<I"):
    return struct.unpack_from(kind, data, place)[0]


def exr_header(data, path):
    """Attributes by name, and where the table of blocks begins."""
    if data[:4] != b"v/1\x01":
        sys.exit(f"{path}: not an OpenEXR file")
    place, found = 8, {}
    while data[place]:
        name, kind, rest = data[place:place + 512].split(b"\0", 2)
        place += len(name) + len(kind) + 2
        size = number_at(data, place)
        found[name.decode()] = data[place + 4:place + 4 + size]
        place += 4 + size
    return found, place + 1


def unzipped(block, size):
    """What OpenEXR's zip made of these bytes: differences of neighbours, odd places behind even ones."""
    if len(block) == size:
        return block
    bytes_ = bytearray(zlib.decompress(block))
    for i in range(1, len(bytes_)):
        bytes_[i] = bytes_[i - 1] + bytes_[i] - 128 & 255
    half = (size + 1) // 2
    bytes_[0::2], bytes_[1::2] = bytes_[:half], bytes_[half:]
    return bytes(bytes_)


def read_exr(path):
    """Width, height and linear R, G, B of each pixel, of a file that pathtracer wrote: floats, zipped scan lines."""
    data = path.read_bytes()
    header, place = exr_header(data, path)
    names = re.findall(rb"([^\0]+)\0(.{16})", header["channels"], re.DOTALL)
    if [name for name, _ in names] != [b"B", b"G", b"R"] or any(number_at(rest, 0) != 2 for _, rest in names):
        sys.exit(f"{path}: not the floats B, G and R")
    if header["compression"] != b"\3":
        sys.exit(f"{path}: not zipped")
    left, top, right, bottom = struct.unpack("<4i", header["dataWindow"])
    width, height, lines = right - left + 1, bottom - top + 1, 16
    pixels = [0.0] * (3 * width * height)
    for block in range((height + lines - 1) // lines):
        at = number_at(data, place + 8 * block, "<Q")
        first, size = number_at(data, at, "<i") - top, number_at(data, at + 4)
        count = min(lines, height - first)
        values = array.array("f", unzipped(data[at + 8:at + 8 + size], 12 * width * count))
        for row in range(count):
            for channel in range(3):
                begin = (3 * row + 2 - channel) * width
                whole = 3 * width * (first + row)
                pixels[whole + channel:whole + 3 * width:3] = values[begin:begin + width]
    return width, height, pixels


def neutral(color):
    """The reference code of Khronos PBR Neutral (2024)."""
    start, room = 0.76, 0.24
    low = min(color)
    offset = low - 6.25 * low * low if low < 0.08 else 0.04
    color = [c - offset for c in color]
    peak = max(color)
    if peak < start:
        return color
    new_peak = 1 - room * room / (peak + room - start)
    white = 1 - 1 / (0.15 * (peak - new_peak) + 1)
    return [c * new_peak / peak * (1 - white) + new_peak * white for c in color]


def shown(pixels, curve):
    """sRGB values from 0 to 255 of linear ones, not rounded."""
    result = []
    for i in range(0, len(pixels), 3):
        color = [max(c, 0.0) for c in pixels[i:i + 3]]
        for c in neutral(color) if curve == "neutral" else color:
            c = min(max(c, 0.0), 1.0)
            result.append(255 * (12.92 * c if c <= 0.0031308 else 1.055 * c ** (1 / 2.4) - 0.055))
    return result


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
    def __init__(self, path, curve):
        self.width, self.height, linear = read_exr(path)
        self.curve = curve
        self.brightness = math.fsum(linear)
        self.shown = shown(linear, curve)
        self.luma = luma(self.shown)
        self.edges = edges(self.luma, self.width, self.height)
        self.mean = blurred(self.luma, self.width, self.height)
        self.square = blurred([v * v for v in self.luma], self.width, self.height)

    def errors(self, path):
        """Root mean square error, SSIM on edges, and mean radiance over that of the reference."""
        _, _, linear = read_exr(path)
        pixels = shown(linear, self.curve)
        rmse = math.sqrt(sum((a - b) ** 2 for a, b in zip(pixels, self.shown)) / len(pixels))
        values = luma(pixels)
        mean = blurred(values, self.width, self.height)
        square = blurred([v * v for v in values], self.width, self.height)
        product = blurred([a * b for a, b in zip(values, self.luma)], self.width, self.height)
        total = 0.0
        for i in self.edges:
            a, b = mean[i], self.mean[i]
            total += ((2 * a * b + 1e-4) * (2 * (product[i] - a * b) + 9e-4) /
                      ((a * a + b * b + 1e-4) * (square[i] - a * a + self.square[i] - b * b + 9e-4)))
        return rmse, total / len(self.edges), math.fsum(linear) / self.brightness


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--scene", action="append", required=True)
    parser.add_argument("--size", default="320x180")
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--core", default="target")
    parser.add_argument("--tone-map", default="neutral", choices=["neutral", "none"])
    parser.add_argument("--reference-spp", type=int, default=4096)
    given = parser.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)

    def render(scene, name, *more):
        """The picture, what was said on the way, and the processor time of it all in seconds."""
        camera = pathlib.Path(scene).parent / "camera.json"
        command = [given.program, "render", scene, "--size", given.size, "--core", given.core, "-o", given.folder / name,
                   "--verbose", *more]
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
    print(f"{'scene':12} {'picture':12} {'RMSE':>8} {'SSIM on edges':>14} {'brightness':>11} {'filter ms':>10} "
          f"{'guides ms':>10} {'CPU s':>7}")
    for scene in given.scene:
        path = pathlib.Path(scene)
        name = path.parent.name if path.suffix else scene
        key = f"{name}-{given.size}"
        reference = given.folder / f"{key}-reference-{given.reference_spp}.exr"
        if not reference.exists():
            render(scene, reference.name, "--spp", str(given.reference_spp), "--seed", "1000", "--checkpoint", "60",
                   "--resume")
        reference = Reference(reference, given.tone_map)
        medians = {}
        for label, options in (("4", ["--spp", "4"]), ("32", ["--spp", "32"]),
                               ("4 filtered", ["--spp", "4", "--filter", "spatial"])):
            found, times, spent = [], [], []
            for seed in range(given.seeds):
                name_of_picture = f"{key}-{label.replace(' ', '-')}-{seed}.exr"
                picture, said, seconds = render(scene, name_of_picture, *options, "--seed", str(seed))
                found.append(reference.errors(picture))
                spent.append(seconds)
                times += [tuple(map(float, t)) for t in re.findall(r"filter: ([0-9.]+) ms, after ([0-9.]+) ms", said)]
            medians[label] = [statistics.median(column) for column in zip(*found)]
            rmse, ssim, bright = medians[label]
            took = "".join(f" {min(column):10.2f}" for column in zip(*times)) if times else f" {'-':>10}" * 2
            print(f"{name:12} {label:12} {rmse:8.3f} {ssim:14.4f} {bright:11.4f}{took} {min(spent):7.2f}", flush=True)
        plain, filtered = medians["32"], medians["4 filtered"]
        for what, met in (("RMSE", filtered[0] <= plain[0]), ("SSIM on edges", filtered[1] >= plain[1]),
                          ("brightness", abs(filtered[2] - 1) <= 0.01)):
            missed = missed or not met
            print(f"{name:12} {what}: {'met' if met else 'MISSED'}", flush=True)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
