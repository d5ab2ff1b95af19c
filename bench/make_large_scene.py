#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Writes a landscape of more than 2 GiB of geometry: bench/make_large_scene.py DIR [TILES]

DIR/large.gltf has TILES x TILES meshes (6 x 6 by default), each with a buffer of its own of 64 MB: facets that share no
vertex, with positions, normals and 32-bit indices. Heights repeat from tile to tile, so that tiles join; the program
cannot know that and has to hold all of them. Takes half a minute and as much disk as geometry.
"""
import array
import json
import math
import pathlib
import sys

CELLS = 624  # along the side of a tile; two facets each
SIDE = 10.0


def height(i, j):
    u, v = 2 * math.pi * i / CELLS, 2 * math.pi * j / CELLS
    return 0.5 * math.sin(u) * math.cos(v) + 0.12 * math.sin(5 * u + 2 * math.sin(v)) + 0.03 * math.cos(23 * v + u)


def facet(a, b, c):
    """Three corners and, for each of them, the facet's normal."""
    e = [b[k] - a[k] for k in range(3)]
    f = [c[k] - a[k] for k in range(3)]
    n = (e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0])
    length = math.sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2])
    return (*a, *b, *c), (n[0] / length, n[1] / length, n[2] / length) * 3


def tile():
    """The bytes of one tile: positions, normals, indices; and the number of its vertices."""
    step = SIDE / CELLS
    points = [[(i * step, height(i, j), j * step) for i in range(CELLS + 1)] for j in range(CELLS + 1)]
    positions, normals = array.array("f"), array.array("f")
    for near, far in zip(points, points[1:]):
        for a, b, c, d in zip(near, near[1:], far, far[1:]):
            for corners, normal in (facet(a, c, b), facet(b, c, d)):
                positions.extend(corners)
                normals.extend(normal)
    count = len(positions) // 3
    indices = array.array("I", range(count))
    return b"".join(part.tobytes() for part in (positions, normals, indices)), count


def document(tiles, size, count):
    gltf = {"asset": {"version": "2.0", "generator": "bench/make_large_scene.py"}, "scene": 0,
            "scenes": [{"nodes": list(range(tiles * tiles + 1))}], "nodes": [], "meshes": [], "accessors": [],
            "bufferViews": [], "buffers": [],
            "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.55, 0.5, 0.42, 1], "metallicFactor": 0}}]}
    low, high = [0, -0.65, 0], [SIDE, 0.65, SIDE]
    for n in range(tiles * tiles):
        gltf["buffers"].append({"uri": f"large_{n:02}.bin", "byteLength": size})
        for k, bytes_each in enumerate((12, 12, 4)):
            gltf["bufferViews"].append({"buffer": n, "byteOffset": k * 12 * count, "byteLength": bytes_each * count})
        gltf["accessors"] += [
            {"bufferView": 3 * n, "componentType": 5126, "count": count, "type": "VEC3", "min": low, "max": high},
            {"bufferView": 3 * n + 1, "componentType": 5126, "count": count, "type": "VEC3"},
            {"bufferView": 3 * n + 2, "componentType": 5125, "count": count, "type": "SCALAR"}]
        gltf["meshes"].append({"primitives": [{
            "attributes": {"POSITION": 3 * n, "NORMAL": 3 * n + 1}, "indices": 3 * n + 2, "material": 0}]})
        gltf["nodes"].append({"mesh": n, "translation": [(n % tiles - tiles / 2) * SIDE, 0,
                                                         (n // tiles - tiles / 2) * SIDE]})
    # From above the near edge, tilted 35 degrees (0.61) down.
    gltf["cameras"] = [{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.01}}]
    gltf["nodes"].append({"camera": 0, "translation": [0, 0.6 * SIDE * tiles / 2, 1.1 * SIDE * tiles / 2],
                          "rotation": [math.sin(-0.305), 0, 0, math.cos(-0.305)]})
    return gltf


def main(arguments):
    if len(arguments) not in (1, 2) or arguments[0].startswith("-"):
        sys.exit("usage: make_large_scene.py DIR [TILES]")
    folder = pathlib.Path(arguments[0])
    tiles = int(arguments[1]) if len(arguments) == 2 else 6
    folder.mkdir(parents=True, exist_ok=True)
    data, count = tile()
    for n in range(tiles * tiles):
        (folder / f"large_{n:02}.bin").write_bytes(data)
    (folder / "large.gltf").write_text(json.dumps(document(tiles, len(data), count)))
    geometry = tiles * tiles * len(data)
    print(f"{folder / 'large.gltf'}: {tiles * tiles * count // 3} triangles, {geometry / 2**30:.2f} GiB of geometry")


if __name__ == "__main__":
    main(sys.argv[1:])
