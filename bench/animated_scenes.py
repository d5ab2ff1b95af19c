#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""What following an animation costs, beside building everything: bench/animated_scenes.py [PATHTRACER]

Makes two scenes in a temporary folder and renders a few frames of each on both cores:

instances  1,000 instances of 100 meshes of 5,000 triangles, 5 million in all; one of them moves
skinned    a sheet of 20,000 vertices on a chain of 10 joints, which all turn

`full` is what the trees of the first frame took. `follow` is all that a later frame takes until its first ray: the animation,
skinning, trees, upload; `trees` is the trees' part. Medians of the frames after the second: the first move of what stood
still builds all anew (`second`).
"""

import json
import math
import pathlib
import random
import re
import statistics
import struct
import subprocess
import sys
import tempfile

FLOAT, UINT, UBYTE = 5126, 5125, 5121
FRAMES = 9


class Model:
    def __init__(self):
        self.parts, self.length = [], 0
        self.root = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [],
                     "accessors": [], "bufferViews": [], "animations": [{"samplers": [], "channels": []}]}

    def add(self, letter, values, component, kind, width):
        data = struct.pack(f"<{len(values)}{letter}", *values)
        data += b"\0" * (-len(data) % 4)
        self.root["bufferViews"].append({"buffer": 0, "byteOffset": self.length, "byteLength": len(data)})
        self.parts.append(data)
        self.length += len(data)
        self.root["accessors"].append({"bufferView": len(self.root["bufferViews"]) - 1, "componentType": component,
                                       "type": kind, "count": len(values) // width})
        return len(self.root["accessors"]) - 1

    def floats(self, kind, values):
        return self.add("f", values, FLOAT, kind, {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}[kind])

    def sheet(self, columns, rows, more=None):
        """A mesh of 2 * columns * rows uneven triangles in a unit square."""
        places = []
        for y in range(rows + 1):
            for x in range(columns + 1):
                places += [x / columns, y / rows, random.uniform(0, 0.5 / rows)]
        corners = []
        for y in range(rows):
            for x in range(columns):
                a = y * (columns + 1) + x
                corners += [a, a + 1, a + columns + 2, a, a + columns + 2, a + columns + 1]
        attributes = {"POSITION": self.floats("VEC3", places), "NORMAL": self.floats("VEC3", [0, 0, 1] * (len(places) // 3))}
        attributes.update(more(places) if more else {})
        self.root["meshes"].append(
            {"primitives": [{"attributes": attributes, "indices": self.add("I", corners, UINT, "SCALAR", 1)}]})

    def node(self, root=True, **members):
        self.root["nodes"].append(members)
        if root:
            self.root["scenes"][0]["nodes"].append(len(self.root["nodes"]) - 1)
        return len(self.root["nodes"]) - 1

    def animate(self, node, path, kind, values):
        width = {"VEC3": 3, "VEC4": 4}[kind]
        animation = self.root["animations"][0]
        times = [float(i) for i in range(len(values) // width)]
        animation["channels"].append(
            {"sampler": len(animation["samplers"]), "target": {"node": node, "path": path}})
        animation["samplers"].append({"input": self.floats("SCALAR", times), "output": self.floats(kind, values)})

    def write(self, path):
        self.root["buffers"] = [{"byteLength": self.length, "uri": path.stem + ".bin"}]
        path.with_suffix(".bin").write_bytes(b"".join(self.parts))
        path.write_text(json.dumps(self.root))


def instances(path):
    model = Model()
    for _ in range(100):
        model.sheet(50, 50)
    for i in range(1000):
        model.node(mesh=i % 100, translation=[i % 10 * 1.1, i // 10 % 10 * 1.1, i // 100 * 1.0])
    model.animate(500, "translation", "VEC3", [v for t in range(FRAMES) for v in (0.3 * t, 5.0, 5.5)])
    model.write(path)


def skinned(path):
    joints = 10
    model = Model()

    def pulls(places):
        numbers, weights = [], []
        for y in places[1::3]:
            joint = min(int(y * (joints - 1)), joints - 2)
            share = y * (joints - 1) - joint
            numbers += [joint, joint + 1, 0, 0]
            weights += [1 - share, share, 0, 0]
        return {"JOINTS_0": model.add("B", numbers, UBYTE, "VEC4", 4), "WEIGHTS_0": model.floats("VEC4", weights)}

    model.sheet(99, 199, pulls)
    model.node(mesh=0, skin=0)
    for i in range(joints):
        child = {"children": [i + 2]} if i + 1 < joints else {}
        model.node(root=i == 0, translation=[0, 1 / (joints - 1) if i else 0, 0], **child)
        turn = [0.02 * t for t in range(FRAMES)]
        model.animate(i + 1, "rotation", "VEC4", [v for a in turn for v in (math.sin(a), 0, 0, math.cos(a))])
    binds = [v for i in range(joints) for v in (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -i / (joints - 1), 0, 1)]
    model.root["skins"] = [{"joints": list(range(1, joints + 1)), "inverseBindMatrices": model.floats("MAT4", binds)}]
    model.write(path)


def measure(program, scene, core):
    words = [program, "render", scene, "--core", core, "--size", "64x36", "--spp", "1", "--frames", f"0:{FRAMES}", "--fps",
             "1", "--sky", "1,1,1", "--verbose", "-o", scene.parent / "f_####.png"]
    said = subprocess.run(words, capture_output=True, text=True, check=True).stderr
    return [(float(a), float(b)) for a, b in re.findall(r"frame \d+: ([\d.]+) ms until .*?, ([\d.]+) of them", said)]


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else "build/release/bin/pathtracer"
    random.seed(1)
    with tempfile.TemporaryDirectory() as folder:
        print(f"{'scene':<10} {'core':<7} {'full ms':>9} {'second ms':>10} {'follow ms':>10} {'trees ms':>9} {'of full':>8}")
        for make in (instances, skinned):
            scene = pathlib.Path(folder) / (make.__name__ + ".gltf")
            make(scene)
            for core in ("source", "target"):
                frames = measure(program, scene, core)
                full, second = frames[0][1], frames[1][0]
                follow = statistics.median(frame[0] for frame in frames[2:])
                trees = statistics.median(frame[1] for frame in frames[2:])
                print(f"{make.__name__:<10} {core:<7} {full:9.1f} {second:10.2f} {follow:10.2f} {trees:9.2f} "
                      f"{100 * follow / full:7.1f}%")


if __name__ == "__main__":
    main()
