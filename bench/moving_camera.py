#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""What --filter temporal leaves of flicker under a moving camera, and how long what was seen stays in the picture.

    bench/moving_camera.py build/release/bin/pathtracer out --scene still_life --scene ../shared/scenes/pica/scene.gltf

The camera of the scene (of a camera.json beside it, else of the file) goes sideways and turns a little with each frame, so that
what is nearest crosses some six pixels of 160. A copy of the scene that does so is written into the folder. Held against
frames of many samples (--reference-spp):

flicker  root mean square over pixels of how the error of luma changes from one frame to the next, in levels of 255
error    root mean square of that error itself
ghost k  how much of the picture of k frames ago is still there at its old place, as a share: regression of the error on
         those pictures minus today's, all at once, over the pixels where one of them differs from today's by 16 levels

No trail longer than 4 frames: ghosts 5 and 6 are below 0.02. Exits with 1 where a bar is missed.
"""
import argparse
import base64
import json
import math
import pathlib
import shutil
import struct
import subprocess
import sys

from filter import luma, read_png

FPS, BACK = 24, 6


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def scaled(v, length):
    size = math.sqrt(sum(x * x for x in v))
    return [x * length / size for x in v]


def quaternion(right, up, back):
    """Of the rotation whose matrix has these columns (Shepperd 1978)."""
    m = list(zip(right, up, back))
    trace = m[0][0] + m[1][1] + m[2][2]
    squares = [trace, m[0][0], m[1][1], m[2][2]]
    largest = squares.index(max(squares))
    if largest == 0:
        q = [m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1], 1 + trace]
    else:
        i = largest - 1
        j, k = (i + 1) % 3, (i + 2) % 3
        q = [0.0] * 4
        q[i] = 1 + m[i][i] - m[j][j] - m[k][k]
        q[j], q[k], q[3] = m[i][j] + m[j][i], m[k][i] + m[i][k], m[k][j] - m[j][k]
    return scaled(q, 1.0)


class Copy:
    """A copy of a scene with one camera that moves."""

    def __init__(self, scene, folder, frames):
        self.root = json.loads(scene.read_text())
        self.parts, self.length = [], 0
        folder.mkdir(parents=True, exist_ok=True)
        for entry in self.root.get("buffers", []) + self.root.get("images", []):
            name = entry.get("uri", "data:")
            if not name.startswith("data:"):
                (folder / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(scene.parent / name, folder / name)
        self.options = []
        beside = scene.parent / "camera.json"
        self.find_camera(json.loads(beside.read_text()) if beside.is_file() else None)
        self.animate(frames)
        self.root["buffers"].append({"byteLength": self.length, "uri": "data:application/octet-stream;base64," +
                                     base64.b64encode(b"".join(self.parts)).decode()})
        self.path = folder / "scene.gltf"
        self.path.write_text(json.dumps(self.root))

    def add(self, kind, values, component=5126, letter="f"):
        width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[kind]
        data = struct.pack(f"<{len(values)}{letter}", *values)
        self.root["bufferViews"].append({"buffer": len(self.root["buffers"]), "byteOffset": self.length, "byteLength": len(data)})
        accessor = {"bufferView": len(self.root["bufferViews"]) - 1, "componentType": component, "type": kind,
                    "count": len(values) // width}
        if width < 4:
            rows = list(zip(*[iter(values)] * width))
            accessor.update(min=[min(c) for c in zip(*rows)], max=[max(c) for c in zip(*rows)])
        self.root["accessors"].append(accessor)
        self.parts.append(data)
        self.length += len(data)
        return len(self.root["accessors"]) - 1

    def find_camera(self, given):
        nodes = self.root["nodes"]
        if given:
            self.eye, self.fov = given["position"], math.radians(given["vfov_degrees"])
            ahead = [b - a for a, b in zip(self.eye, given["target"])]
            self.distance, up = math.sqrt(sum(x * x for x in ahead)), given["up"]
            self.options = ["--sky", ",".join(str(c) for c in given["sky_radiance"])]
            for light in given["area_lights"]:
                self.add_light(light)
        else:
            node = next(n for n in nodes if "camera" in n)
            matrix = node["matrix"]
            self.eye, ahead, up = matrix[12:15], [-x for x in matrix[8:11]], matrix[4:7]
            self.distance = math.sqrt(sum(x * x for x in self.eye))
            self.fov = self.root["cameras"][node["camera"]]["perspective"]["yfov"]
        for node in nodes:
            node.pop("camera", None)
        self.back = scaled([-x for x in ahead], 1.0)
        self.right = scaled(cross(up, self.back), 1.0)

    def add_light(self, light):
        corners = [c for corner in light["corners"] for c in corner]
        strength = max(light["radiance"])
        self.root["materials"].append({"emissiveFactor": [c / strength for c in light["radiance"]], "extensions": {
            "KHR_materials_emissive_strength": {"emissiveStrength": strength}}})
        used = self.root.setdefault("extensionsUsed", [])
        if "KHR_materials_emissive_strength" not in used:
            used.append("KHR_materials_emissive_strength")
        a, b, c = light["corners"][:3]
        faces = cross([y - x for x, y in zip(a, b)], [y - x for x, y in zip(a, c)])
        turned = sum(x * y for x, y in zip(faces, light["normal"])) < 0
        indices = [0, 2, 1, 0, 3, 2] if turned else [0, 1, 2, 0, 2, 3]
        self.root["meshes"].append({"primitives": [{"attributes": {"POSITION": self.add("VEC3", corners)},
                                                    "indices": self.add("SCALAR", indices, 5125, "I"),
                                                    "material": len(self.root["materials"]) - 1}]})
        self.add_node({"mesh": len(self.root["meshes"]) - 1})

    def add_node(self, node):
        self.root["nodes"].append(node)
        self.root["scenes"][self.root.get("scene", 0)]["nodes"].append(len(self.root["nodes"]) - 1)
        return len(self.root["nodes"]) - 1

    def animate(self, frames):
        step, turn = 0.035 * self.distance * math.tan(self.fov / 2), math.radians(0.3)
        up = cross(self.back, self.right)
        places, turns = [], []
        for frame in range(frames):
            places += [e + step * frame * r for e, r in zip(self.eye, self.right)]
            c, s = math.cos(turn * frame), math.sin(turn * frame)
            right = [c * r + s * b for r, b in zip(self.right, self.back)]
            back = [c * b - s * r for r, b in zip(self.right, self.back)]
            turns += quaternion(right, up, back)
        times = self.add("SCALAR", [frame / FPS for frame in range(frames)])
        self.root["cameras"] = [{"type": "perspective", "perspective": {"yfov": self.fov, "aspectRatio": 16 / 9, "znear": 0.01}}]
        node = self.add_node({"camera": 0, "translation": places[:3], "rotation": turns[:4]})
        self.root["animations"] = [{
            "samplers": [{"input": times, "output": self.add("VEC3", places)}, {"input": times, "output": self.add("VEC4", turns)}],
            "channels": [{"sampler": 0, "target": {"node": node, "path": "translation"}},
                         {"sampler": 1, "target": {"node": node, "path": "rotation"}}]}]


def root_mean_square(values):
    return math.sqrt(sum(v * v for v in values) / len(values))


def solved(matrix, right):
    """The solution of a small symmetric system of equations, by Gauss and Jordan."""
    rows = [list(row) + [value] for row, value in zip(matrix, right)]
    for i, row in enumerate(rows):
        pivot = row[i]
        row[:] = [x / pivot for x in row]
        for other in rows[:i] + rows[i + 1:]:
            factor = other[i]
            other[:] = [x - factor * y for x, y in zip(other, row)]
    return [row[-1] for row in rows]


def ghosts(shown, references, numbers):
    """How much of the frames 1 to BACK before is left: least squares over all these frames at once."""
    matrix, right = [[0.0] * BACK for _ in range(BACK)], [0.0] * BACK
    for n in numbers:
        for picture, *values in zip(shown[n], *(references[n - back] for back in range(BACK + 1))):
            old = [value - values[0] for value in values[1:]]
            if max(old) - min(min(old), 0) < 16 / 255:
                continue
            for i, x in enumerate(old):
                right[i] += x * (picture - values[0])
                for j, y in enumerate(old):
                    matrix[i][j] += x * y
    return solved(matrix, right)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--scene", action="append", required=True)
    parser.add_argument("--size", default="160x90")
    parser.add_argument("--core", default="target")
    parser.add_argument("--frames", type=int, default=12)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--reference-spp", type=int, default=512)
    parser.add_argument("--kernels", help="of the source core")
    given = parser.parse_args()
    root = pathlib.Path(__file__).resolve().parent.parent
    missed = False
    print(f"{'scene':11} {'picture':12} {'flicker':>8} {'error':>7}   ghost 1 to 6")
    for scene in given.scene:
        path = root / "scenes" / scene / f"{scene}.gltf" if not pathlib.Path(scene).suffix else pathlib.Path(scene)
        name = path.parent.name
        copy = Copy(path, given.folder / name, given.frames)

        def frames(label, spp, *more, core=given.core):
            pattern = given.folder / f"{name}-{given.size}-{label}-###.png"
            first = pathlib.Path(str(pattern).replace("###", "000"))
            if label.startswith("reference") and first.exists():
                more += ("--resume",)
            if core == "source" and given.kernels:
                more += ("--kernels", given.kernels)
            command = [given.program, "render", copy.path, "--camera", "0", *copy.options, "--size", given.size, "--core", core,
                       "--frames", f"0:{given.frames}", "--fps", str(FPS), "--spp", str(spp), "-o", pattern, *more]
            done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
            if done.returncode != 0:
                sys.exit(done.stderr)
            return [luma(read_png(pathlib.Path(str(pattern).replace("###", f"{n:03}")))[2]) for n in range(given.frames)]

        reference = frames(f"reference-{given.reference_spp}", given.reference_spp, "--seed", "1000", core="target")
        found = {}
        seed = ("--seed", str(given.seed))
        for label, spp, more in (("32", 32, ()), ("4", 4, ()), ("4 spatial", 4, ("--filter", "spatial")),
                                 ("4 temporal", 4, ("--filter", "temporal"))):
            shown = frames(label.replace(" ", "-"), spp, *seed, *more)
            errors = [[p - r for p, r in zip(*both)] for both in zip(shown, reference)]
            settled = range(BACK, given.frames)
            flicker = 255 * root_mean_square([b - a for n in settled for a, b in zip(errors[n - 1], errors[n])])
            error = 255 * root_mean_square([e for n in settled for e in errors[n]])
            left = ghosts(shown, reference, settled)
            found[label] = (flicker, left)
            print(f"{name:11} {label:12} {flicker:8.2f} {error:7.2f}   " + " ".join(f"{g:6.3f}" for g in left), flush=True)
        plain, temporal = found["32"], found["4 temporal"]
        trail = any(abs(share) > 0.02 for share in temporal[1][4:])
        for what, met in (("flicker", temporal[0] < plain[0]), ("trail", not trail)):
            missed = missed or not met
            print(f"{name:11} {what}: {'met' if met else 'MISSED'}", flush=True)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
