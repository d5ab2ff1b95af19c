#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Writes the project's own scenes as glTF 2.0. Needs nothing but Python's standard library.

    scenes/make_scenes.py still_life DIR    the built-in scene (scenes/still_life holds its output)
    scenes/make_scenes.py parity DIR        1,000 instances that ask everything of two cores that must agree
    scenes/make_scenes.py interior DIR      a furnished room
    scenes/make_scenes.py city DIR          houses of more than a million triangles

Each scene lands in DIR as <name>.gltf with its buffer and textures beside it. The same call writes the same bytes.
"""
import json
import math
import pathlib
import random
import struct
import sys
import zlib

FLOAT, UINT16 = 5126, 5123
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963


# --- Files ---------------------------------------------------------------------------------------------------------

def write_png(path, width, height, pixel, channels=3):
    """Writes 8-bit pixels; `pixel(x, y)` gives a tuple of `channels` levels (3: RGB, 4: RGBA)."""
    raw = bytearray()
    for y in range(height):
        raw.append(0)  # no row filter
        for x in range(width):
            raw += bytes(pixel(x, y))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, {3: 2, 4: 6}[channels], 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(bytes(raw), 9)) +
                     chunk(b"IEND", b""))


def write_hdr(path, width, height, radiance):
    """Writes a Radiance picture without run-length encoding; `radiance(x, y)` gives linear RGB."""
    data = bytearray(f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode())
    for y in range(height):
        for x in range(width):
            rgb = radiance(x, y)
            mantissa, exponent = math.frexp(max(rgb))
            scale = mantissa * 256.0 / max(rgb)
            data += bytes(int(c * scale) for c in rgb) + bytes([exponent + 128])
    path.write_bytes(data)


class Scene:
    """A glTF document under construction, with one binary buffer."""

    def __init__(self, name):
        self.name = name
        self.buffer = bytearray()
        self.gltf = {"asset": {"version": "2.0", "generator": "scenes/make_scenes.py"}, "scene": 0,
                     "scenes": [{"nodes": []}], "nodes": [], "meshes": [], "materials": [], "accessors": [],
                     "bufferViews": [], "buffers": []}

    def add(self, kind, item):
        self.gltf.setdefault(kind, []).append(item)
        return len(self.gltf[kind]) - 1

    def accessor(self, values, width, component, target):
        """`values` is a flat list; `width` its elements per item."""
        data = struct.pack(f"<{len(values)}{'f' if component == FLOAT else 'H'}", *values)
        view = self.add("bufferViews", {"buffer": 0, "byteOffset": len(self.buffer), "byteLength": len(data),
                                        "target": target})
        self.buffer += data + bytes(-len(data) % 4)
        item = {"bufferView": view, "componentType": component, "count": len(values) // width,
                "type": {1: "SCALAR", 2: "VEC2", 3: "VEC3"}[width]}
        if target == ARRAY_BUFFER and width == 3:
            stored = struct.unpack(f"<{len(values)}f", data)  # bounds of what the file holds, not of Python's doubles
            item["min"] = [min(stored[i::3]) for i in range(3)]
            item["max"] = [max(stored[i::3]) for i in range(3)]
        return self.add("accessors", item)

    def shape(self, shape):
        """The accessors of a (positions, normals, uvs, indices) shape, to be shared by meshes. uvs may be None."""
        positions, normals, uvs, indices = shape

        def flat(vectors):
            return [component for vector in vectors for component in vector]

        attributes = {"POSITION": self.accessor(flat(positions), 3, FLOAT, ARRAY_BUFFER),
                      "NORMAL": self.accessor(flat(normals), 3, FLOAT, ARRAY_BUFFER)}
        if uvs:
            attributes["TEXCOORD_0"] = self.accessor(flat(uvs), 2, FLOAT, ARRAY_BUFFER)
        return {"attributes": attributes, "indices": self.accessor(indices, 1, UINT16, ELEMENT_ARRAY_BUFFER)}

    def mesh(self, name, shape, material):
        return self.add("meshes", {"name": name, "primitives": [dict(shape, material=material)]})

    def material(self, name, color, metallic=0.0, roughness=1.0, **more):
        """`more` may hold texture entries of pbrMetallicRoughness (as `pbr`) and anything of the material itself."""
        pbr = {"baseColorFactor": list(color) + [1.0] * (4 - len(color)), "metallicFactor": metallic,
               "roughnessFactor": roughness}
        pbr.update(more.pop("pbr", {}))
        for extension in more.get("extensions", {}):
            used = self.gltf.setdefault("extensionsUsed", [])
            if extension not in used:
                used.append(extension)
        return self.add("materials", {"name": name, "pbrMetallicRoughness": pbr, **more})

    def texture(self, file_name):
        if "samplers" not in self.gltf:
            self.add("samplers", {"magFilter": 9729, "minFilter": 9987})  # linear, trilinear; repeat by default
        image = self.add("images", {"uri": file_name})
        return self.add("textures", {"source": image, "sampler": 0})

    def node(self, **fields):
        index = self.add("nodes", fields)
        self.gltf["scenes"][0]["nodes"].append(index)
        return index

    def camera(self, position, target, vertical_fov_degrees):
        index = self.add("cameras", {"type": "perspective", "perspective": {
            "yfov": math.radians(vertical_fov_degrees), "aspectRatio": 16 / 9, "znear": 0.01}})
        self.node(name="camera", camera=index, matrix=look_at(position, target))

    def write(self, folder):
        self.gltf["buffers"] = [{"uri": f"{self.name}.bin", "byteLength": len(self.buffer)}]
        (folder / f"{self.name}.bin").write_bytes(self.buffer)
        (folder / f"{self.name}.gltf").write_text(compact_json(self.gltf) + "\n")


def compact_json(gltf):
    """One line for each element of each list: short enough to read, and to keep 1,000 nodes small."""
    def rounded(value):
        if isinstance(value, float):
            return round(value, 9)
        if isinstance(value, list):
            return [rounded(v) for v in value]
        if isinstance(value, dict):
            return {k: rounded(v) for k, v in value.items()}
        return value

    fields = []
    for key, value in rounded(gltf).items():
        if isinstance(value, list) and value and isinstance(value[0], dict):
            lines = ",\n".join("  " + json.dumps(item) for item in value)
            fields.append(f'"{key}": [\n{lines}\n]')
        else:
            fields.append(f'"{key}": {json.dumps(value)}')
    return "{\n" + ",\n".join(fields) + "\n}"


# --- Vectors -------------------------------------------------------------------------------------------------------

def subtract(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v]


def look_at(position, target):
    """Column-major matrix of a camera that looks along its -z."""
    back = unit(subtract(position, target))
    right = unit(cross([0, 1, 0], back))
    up = cross(back, right)
    return right + [0] + up + [0] + back + [0] + list(position) + [1]


def turn(axis, degrees):
    """Quaternion."""
    half = math.radians(degrees) / 2
    return [x * math.sin(half) for x in unit(axis)] + [math.cos(half)]


# --- Shapes: (positions, normals, uvs, indices) -----------------------------------------------------------------------

def grid_indices(columns, rows):
    """Triangles of a grid of (columns + 1) x (rows + 1) vertices, row by row; front faces where v x u points out."""
    indices = []
    for r in range(rows):
        for c in range(columns):
            a = r * (columns + 1) + c
            b = a + columns + 1
            indices += [a, b, a + 1, a + 1, b, b + 1]
    return indices


def quad(a, b, c, d, uv_scale=1.0):
    """Corners counter-clockwise as seen from the front."""
    normal = unit(cross(subtract(b, a), subtract(d, a)))
    uvs = [[0, uv_scale], [uv_scale, uv_scale], [uv_scale, 0], [0, 0]]
    return [a, b, c, d], [normal] * 4, uvs, [0, 1, 2, 0, 2, 3]


def box():
    """A cube from -1 to 1 with flat faces, each with its own texture square."""
    positions, normals, uvs, indices = [], [], [], []
    for axis in range(3):
        for sign in (-1, 1):
            normal = [0, 0, 0]
            normal[axis] = sign
            u = [0, 0, 0]
            u[(axis + 1) % 3] = sign
            v = [0, 0, 0]
            v[(axis + 2) % 3] = 1
            first = len(positions)
            for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                positions.append([n + s * x + t * y for n, x, y in zip(normal, u, v)])
                normals.append(normal)
                uvs.append([(s + 1) / 2, (1 - t) / 2])
            indices += [first + i for i in (0, 1, 2, 0, 2, 3)]
    return positions, normals, uvs, indices


def lathe(profile, columns, smooth=True):
    """Turns a profile of (radius, height), from the bottom up on the outside, about the y axis."""
    positions, normals, uvs = [], [], []
    count = len(profile)
    for i, (radius, height) in enumerate(profile):
        before, after = profile[max(0, i - 1)], profile[min(count - 1, i + 1)]
        slope = unit([after[1] - before[1], before[0] - after[0]])  # outward normal in the plane (radius, height)
        for c in range(columns + 1):
            angle = 2 * math.pi * c / columns
            cosine, sine = math.cos(angle), math.sin(angle)
            positions.append([radius * cosine, height, -radius * sine])
            normals.append(unit([slope[0] * cosine, slope[1], -slope[0] * sine]))
            uvs.append([c / columns, 1 - i / (count - 1)])
    indices = []
    for r in range(count - 1):
        for c in range(columns):
            a = r * (columns + 1) + c
            b = a + columns + 1
            if profile[r][0] > 0:
                indices += [a, a + 1, b + 1]
            if profile[r + 1][0] > 0:
                indices += [a, b + 1, b]
    return positions, normals, uvs, indices


def sphere(columns, rows):
    """Radius 1."""
    profile = []
    for r in range(rows + 1):
        angle = math.pi * r / rows
        profile.append((0.0 if r in (0, rows) else math.sin(angle), -math.cos(angle)))
    positions, _, uvs, indices = lathe(profile, columns)
    return positions, [unit(p) for p in positions], uvs, indices


def knot(turns, strands, tube_radius, columns, rows):
    """A tube along a torus knot, lying in the xz plane."""
    def centre(t):
        radius = 1.0 + 0.4 * math.cos(strands * t)
        return [radius * math.cos(turns * t), 0.4 * math.sin(strands * t), radius * math.sin(turns * t)]

    positions, normals = [], []
    for r in range(rows + 1):
        t = 2 * math.pi * (r % rows) / rows
        middle = centre(t)
        along = unit(subtract(centre(t + 1e-4), centre(t - 1e-4)))
        side = unit(cross(along, middle))
        up = cross(side, along)
        for c in range(columns + 1):
            angle = 2 * math.pi * (c % columns) / columns
            normal = [s * math.cos(angle) + u * math.sin(angle) for s, u in zip(side, up)]
            positions.append([m + tube_radius * n for m, n in zip(middle, normal)])
            normals.append(normal)
    indices = grid_indices(columns, rows)
    a, b, c = (positions[i] for i in indices[:3])
    if sum(x * y for x, y in zip(cross(subtract(b, a), subtract(c, a)), normals[0])) < 0:
        indices = [i for k in range(0, len(indices), 3) for i in (indices[k], indices[k + 2], indices[k + 1])]
    return positions, normals, None, indices


# --- The built-in scene ----------------------------------------------------------------------------------------------

def noise(*key):
    """A repeatable number from 0 to 1 for a few whole numbers."""
    return zlib.crc32(struct.pack(f"<{len(key)}i", *key)) / 0xFFFFFFFF


def parquet(x, y, size):
    """Herringbone of 2:1 blocks (four to a side) with a grain along each block; repeats at the borders."""
    unit_size = size // 8
    column, row = x // unit_size, y // unit_size
    diagonal = (column - row) % 4
    if diagonal < 2:  # a block that lies along x
        block, across = (column - diagonal, row, 0), y
        along = (column - diagonal) * unit_size
        edge = min(y % unit_size, unit_size - 1 - y % unit_size,
                   x - along, 2 * unit_size - 1 - (x - along))
        seed = ((column - diagonal) % 8, row % 8, 0)
    else:             # a block that stands along y
        offset = 3 - diagonal
        along = (row - offset) * unit_size
        across = x
        edge = min(x % unit_size, unit_size - 1 - x % unit_size,
                   y - along, 2 * unit_size - 1 - (y - along))
        seed = (column % 8, (row - offset) % 8, 1)
    shade = 0.72 + 0.28 * noise(*seed)
    grain = 0.88 + 0.08 * noise(across, seed[0] * 8 + seed[1], 7) + 0.04 * noise(x, y, 11)
    if edge < 1:
        shade *= 0.45
    level = round(shade * grain * 40) / 40  # few tones compress well
    return tuple(min(255, int(c * level)) for c in (196, 138, 84))


def room(scene):
    """Floor, walls, ceiling and the light in it. x -2..2, y 0..2.8, z -2..2; open towards the viewer."""
    floor = scene.texture("floor.png")
    wood = scene.material("parquet", (1, 1, 1), roughness=0.35, pbr={"baseColorTexture": {"index": floor}})
    white = scene.material("plaster", (0.78, 0.76, 0.72))
    warm = scene.material("terracotta", (0.72, 0.28, 0.16))
    cool = scene.material("teal", (0.10, 0.34, 0.36))
    light = scene.material("lamp", (0, 0, 0), emissiveFactor=[1.0, 0.86, 0.68],
                           extensions={"KHR_materials_emissive_strength": {"emissiveStrength": 6.5}})
    l, r, t, b, f = -2, 2, 2.8, -2, 2
    h = t - 0.01  # of the lamp
    walls = [
        ("floor", quad([l, 0, f], [r, 0, f], [r, 0, b], [l, 0, b], 3.0), wood),
        ("back wall", quad([l, 0, b], [r, 0, b], [r, t, b], [l, t, b]), white),
        ("ceiling", quad([l, t, b], [r, t, b], [r, t, f], [l, t, f]), white),
        ("left wall", quad([l, 0, f], [l, 0, b], [l, t, b], [l, t, f]), warm),
        ("right wall", quad([r, 0, b], [r, 0, f], [r, t, f], [r, t, b]), cool),
        ("lamp", quad([-1.1, h, -1.1], [1.1, h, -1.1], [1.1, h, 0.5], [-1.1, h, 0.5]), light),
    ]
    for name, shape, material in walls:
        scene.node(name=name, mesh=scene.mesh(name, scene.shape(shape), material))
    return white


VASE = [(0.0, 0.0), (0.26, 0.0), (0.28, 0.02), (0.40, 0.18), (0.46, 0.36), (0.42, 0.56), (0.28, 0.76), (0.17, 0.90),
        (0.14, 1.00), (0.16, 1.08), (0.22, 1.14), (0.20, 1.13), (0.13, 1.06), (0.11, 1.00), (0.10, 0.90)]


def still_life(folder):
    scene = Scene("still_life")
    write_png(folder / "floor.png", 256, 256, lambda x, y: parquet(x, y, 256))
    plaster = room(scene)

    ball = scene.shape(sphere(48, 24))
    glass = scene.material("glass", (1, 1, 1), roughness=0.0, extensions={
        "KHR_materials_transmission": {"transmissionFactor": 1.0}, "KHR_materials_ior": {"ior": 1.5},
        "KHR_materials_volume": {"thicknessFactor": 1.0}})
    copper = scene.material("brushed copper", (0.93, 0.52, 0.36), metallic=1.0, roughness=0.3)
    glaze = scene.material("blue glaze", (0.04, 0.12, 0.42), roughness=0.08)
    pearls = [scene.mesh(name, ball, scene.material(name, color, metallic, roughness))
              for name, color, metallic, roughness in (
                  ("gold", (1.0, 0.77, 0.34), 1.0, 0.2), ("ivory", (0.86, 0.82, 0.72), 0.0, 0.25),
                  ("coral", (0.80, 0.16, 0.12), 0.0, 0.35))]

    scene.node(name="pedestal", mesh=scene.mesh("pedestal", scene.shape(box()), plaster), scale=[0.46, 0.34, 0.46],
               translation=[-0.72, 0.34, -0.72], rotation=turn([0, 1, 0], 24))
    scene.node(name="knot", mesh=scene.mesh("knot", scene.shape(knot(2, 3, 0.22, 12, 120)), copper),
               translation=[-0.72, 1.10, -0.72], rotation=turn([1, 0.2, 0.3], 74), scale=[0.30, 0.30, 0.30])
    scene.node(name="glass ball", mesh=scene.mesh("glass ball", ball, glass), translation=[0.22, 0.5, 0.55],
               scale=[0.5, 0.5, 0.5])
    scene.node(name="vase", mesh=scene.mesh("vase", scene.shape(lathe(VASE, 40)), glaze), translation=[1.08, 0, -0.62],
               scale=[1.15, 1.25, 1.15])

    # Pearls on a spiral that unrolls over the floor: one shape, three materials, 33 instances.
    for i in range(33):
        angle, distance = 0.42 * i + 0.6, 0.74 + 0.030 * i
        size = 0.055 + 0.035 * noise(i, 3)
        position = [0.22 + distance * math.cos(angle), size, 0.55 + 0.62 * distance * math.sin(angle)]
        if abs(position[0]) > 1.85 or position[2] > 1.75:
            continue
        scene.node(name=f"pearl {i}", mesh=pearls[i % 3], translation=position, scale=[size] * 3)
    scene.camera([0.0, 1.42, 5.6], [0.0, 1.16, 0.0], 33.0)
    scene.write(folder)


# --- The parity scene ------------------------------------------------------------------------------------------------

def leaf_alpha(x, y, size):
    """A four-leaved shape with a soft rim, for MASK and BLEND alike."""
    u, v = (x + 0.5) / size * 2 - 1, (y + 0.5) / size * 2 - 1
    edge = 0.35 + 0.55 * math.cos(2 * math.atan2(v, u)) ** 2
    return max(0.0, min(1.0, (edge - math.hypot(u, v)) * 4 + 0.5))


def bump_normal(x, y, size):
    """Tangent-space normals of a product of cosines."""
    k = 2 * math.pi * 3 / size
    slope_x = 0.5 * math.sin(k * x) * math.cos(k * y)
    slope_y = 0.5 * math.cos(k * x) * math.sin(k * y)
    return tuple(int(127.5 * c + 128) for c in unit([slope_x, slope_y, 1.0]))


def sky_radiance(x, y, width, height):
    """A gradient from horizon to zenith, dark ground, and a small sun 400 times as bright."""
    up = math.cos(math.pi * (y + 0.5) / height)
    sun = 400.0 if abs(x - width * 5 // 8) <= 1 and abs(y - height // 4) <= 1 else 0.0
    if up < 0:
        return (0.12, 0.10, 0.08)
    return (0.25 + 0.5 * (1 - up) + sun, 0.4 + 0.4 * (1 - up) + sun, 0.9 - 0.2 * (1 - up) + 0.8 * sun)


def parity_textures(folder):
    size = 64
    write_png(folder / "leaf.png", size, size, lambda x, y: (
        60 + int(80 * noise(x // 4, y // 4)), 150, 50, int(255 * leaf_alpha(x, y, size))), channels=4)
    write_png(folder / "checker.png", size, size, lambda x, y: (
        (230, 220, 200) if (x // 8 + y // 8) % 2 else (40 + x * 2, 60, 160 - y)))
    write_png(folder / "bumps.png", size, size, lambda x, y: bump_normal(x, y, size))
    write_png(folder / "metal.png", size, size, lambda x, y: (
        0, 40 + int(200 * noise(x // 8, y // 8, 1)), 255 if (x // 16 + y // 16) % 2 else 0))
    write_hdr(folder / "sky.hdr", 64, 32, lambda x, y: sky_radiance(x, y, 64, 32))


def parity_meshes(scene):
    """One mesh for each thing that two cores could see differently."""
    leaf, checker, bumps, metal = (scene.texture(f"{name}.png") for name in ("leaf", "checker", "bumps", "metal"))
    cube, ball = scene.shape(box()), scene.shape(sphere(20, 10))
    card = scene.shape(quad([-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]))
    transform = {"KHR_texture_transform": {"offset": [0.25, 0.1], "rotation": 0.4, "scale": [2.0, 1.5]}}
    scene.gltf.setdefault("extensionsUsed", []).append("KHR_texture_transform")
    mask = scene.material("mask", (1, 1, 1), alphaMode="MASK", alphaCutoff=0.4, doubleSided=True,
                          pbr={"baseColorTexture": {"index": leaf}})
    blend = scene.material("blend", (1, 0.8, 0.6, 0.7), alphaMode="BLEND", doubleSided=True,
                           pbr={"baseColorTexture": {"index": leaf}})
    tiles = scene.material("tiles", (1, 1, 1), roughness=0.4, normalTexture={"index": bumps, "scale": 0.8},
                           pbr={"baseColorTexture": {"index": checker, "extensions": transform}})
    patchy = scene.material("patchy metal", (0.95, 0.85, 0.6), metallic=1.0,
                            pbr={"metallicRoughnessTexture": {"index": metal}}, normalTexture={"index": bumps})
    glass = scene.material("glass", (0.95, 1, 0.97), roughness=0.1, extensions={
        "KHR_materials_transmission": {"transmissionFactor": 0.9}, "KHR_materials_ior": {"ior": 1.45},
        "KHR_materials_volume": {"thicknessFactor": 1.0, "attenuationDistance": 0.5,
                                 "attenuationColor": [0.9, 0.5, 0.2]}})
    cloth = scene.material("cloth", (0.4, 0.1, 0.12), roughness=0.7, extensions={"KHR_materials_sheen": {
        "sheenColorFactor": [0.9, 0.7, 0.5], "sheenRoughnessFactor": 0.6, "sheenColorTexture": {"index": checker},
        "sheenRoughnessTexture": {"index": leaf}}})
    lacquer = scene.material("lacquer", (0.1, 0.3, 0.7), metallic=0.5, roughness=0.6, normalTexture={"index": bumps},
                             extensions={"KHR_materials_clearcoat": {
        "clearcoatFactor": 0.9, "clearcoatRoughnessFactor": 0.3, "clearcoatTexture": {"index": checker},
        "clearcoatRoughnessTexture": {"index": metal}, "clearcoatNormalTexture": {"index": bumps, "scale": 0.4}}})
    bubble = scene.material("bubble", (0.5, 0.5, 0.5), metallic=0.3, roughness=0.2, extensions={
        "KHR_materials_iridescence": {"iridescenceFactor": 0.8, "iridescenceThicknessMaximum": 700,
                                      "iridescenceThicknessTexture": {"index": metal}}})
    brushed = scene.material("brushed", (0.9, 0.8, 0.7), metallic=1.0, roughness=0.3, extensions={
        "KHR_materials_anisotropy": {"anisotropyStrength": 0.9, "anisotropyRotation": 0.6,
                                     "anisotropyTexture": {"index": bumps}}})
    lamp = scene.material("lamp", (0, 0, 0), emissiveFactor=[1.0, 0.7, 0.4],
                          extensions={"KHR_materials_emissive_strength": {"emissiveStrength": 6.0}})
    return [scene.mesh(name, shape, material) for name, shape, material in (
        ("masked card", card, mask), ("blended card", card, blend), ("tiled cube", cube, tiles),
        ("patchy ball", ball, patchy), ("tiled ball", ball, tiles), ("glass ball", ball, glass),
        ("masked cube", cube, mask), ("cloth ball", ball, cloth),
        ("lacquered ball", ball, lacquer), ("bubble", ball, bubble),
        ("brushed ball", ball, brushed))], scene.mesh("lamp", card, lamp)


def parity(folder):
    scene = Scene("parity")
    parity_textures(folder)
    meshes, lamp = parity_meshes(scene)
    draw = random.Random(2)

    def one_of(low, high):
        return low + (high - low) * draw.random()

    for i in range(1000):
        cell = [i % 10, i // 10 % 10, i // 100]
        scale = [one_of(0.12, 0.42) for _ in range(3)]
        for axis in range(3):
            if draw.random() < 0.25:
                scale[axis] = -scale[axis]
        axis = [one_of(-1, 1) for _ in range(3)]
        scene.node(mesh=lamp if i % 125 == 60 else meshes[i % len(meshes)], scale=scale,
                   translation=[c - 4.5 + one_of(-0.3, 0.3) for c in cell], rotation=turn(axis, one_of(0, 360)))
    scene.camera([7.5, 5.0, 13.0], [0.0, 0.0, 0.0], 40.0)
    scene.write(folder)


# --- Larger scenes, for measurements ----------------------------------------------------------------------------------

def joined(shapes):
    """One shape of many."""
    positions, normals, uvs, indices = [], [], [], []
    for shape in shapes:
        indices += [len(positions) + i for i in shape[3]]
        for whole, part in zip((positions, normals, uvs), shape):
            whole += part
    return positions, normals, uvs, indices


def interior(folder):
    """A furnished room of some 155,000 triangles: shelves with books and knots, and the lamp of the still life."""
    scene = Scene("interior")
    write_png(folder / "floor.png", 256, 256, lambda x, y: parquet(x, y, 256))
    plaster = room(scene)
    board, ball, ring = scene.shape(box()), scene.shape(sphere(48, 24)), scene.shape(knot(2, 3, 0.22, 12, 120))
    covers = [scene.mesh(f"cover {i}", board, scene.material(f"cover {i}", [0.1 + 0.7 * noise(i, c) for c in range(3)],
                                                             roughness=0.3 + 0.6 * noise(i, 9))) for i in range(8)]
    metals = [scene.mesh(f"ornament {i}", shape, scene.material(f"ornament {i}", (0.9, 0.6 + 0.05 * i, 0.4), 1.0, 0.1 + 0.1 * i))
              for i, shape in enumerate((ball, ring, ball, ring))]
    shelf = scene.mesh("shelf", board, plaster)
    for row in range(5):
        y = 0.3 + 0.48 * row
        scene.node(mesh=shelf, translation=[0, y - 0.02, -1.75], scale=[1.9, 0.02, 0.24])
        for i in range(36):
            x, tall = -1.82 + 0.104 * i, 0.10 + 0.09 * noise(row, i)
            if (i + 3 * row) % 9 == 4:
                scene.node(mesh=metals[(i + row) % 4], translation=[x, y + 0.07, -1.7], scale=[0.045] * 3)
            else:
                scene.node(mesh=covers[(5 * i + row) % 8], translation=[x, y + tall, -1.75],
                           scale=[0.042, tall, 0.15], rotation=turn([0, 0, 1], 6 * noise(i, row, 1) - 3))
    for i in range(40):
        size = 0.05 + 0.05 * noise(i, 5)
        scene.node(mesh=metals[i % 4], translation=[-1.7 + 3.4 * noise(i, 6), size, -1.2 + 2.6 * noise(i, 7)], scale=[size] * 3)
    scene.camera([0.0, 1.42, 5.2], [0.0, 1.16, 0.0], 33.0)
    scene.write(folder)


def brick(x, y, size):
    row = y // 8
    in_mortar = y % 8 == 0 or (x + 8 * (row % 2)) % 16 == 0
    shade = 0.75 + 0.25 * noise((x + 8 * (row % 2)) // 16 % (size // 16), row)
    return (150, 146, 140) if in_mortar else tuple(int(c * shade) for c in (168, 84, 62))


def facade(columns, floors):
    """The four sides of a house of 1 x 1 x 1 on y = 0 and its roof: walls with window reveals, and the panes apart."""
    walls, panes = [], []
    for side in range(4):
        c, s = ((1, 0), (0, 1), (-1, 0), (0, -1))[side]

        def at(x, y, depth):  # on the side, from its left, and how far inside
            u, w = x - 0.5, 0.5 - depth
            return [c * u + s * w, y, -s * u + c * w]

        for i in range(columns):
            for k in range(floors):
                l, r, b, t = i / columns, (i + 1) / columns, k / floors, (k + 1) / floors
                wl, wr, wb, wt, deep = l + 0.25 / columns, r - 0.25 / columns, b + 0.25 / floors, t - 0.2 / floors, 0.01
                outer, inner = ((l, b), (r, b), (r, t), (l, t)), ((wl, wb), (wr, wb), (wr, wt), (wl, wt))
                for n in range(4):
                    o0, o1, i0, i1 = outer[n], outer[(n + 1) % 4], inner[n], inner[(n + 1) % 4]
                    walls.append(quad(at(*o0, 0), at(*o1, 0), at(*i1, 0), at(*i0, 0)))
                    walls.append(quad(at(*i0, 0), at(*i1, 0), at(*i1, deep), at(*i0, deep)))
                panes.append(quad(*(at(*corner, deep) for corner in inner)))
    walls.append(quad([-0.5, 1, 0.5], [0.5, 1, 0.5], [0.5, 1, -0.5], [-0.5, 1, -0.5]))
    return joined(walls), joined(panes)


def city(folder):
    """Twelve by twelve blocks of textured houses, more than a million triangles in all; it stands in the studio sky."""
    scene = Scene("city")
    write_png(folder / "brick.png", 128, 128, lambda x, y: brick(x, y, 128))
    bricks = {"baseColorTexture": {"index": scene.texture("brick.png")}}
    street = scene.material("asphalt", (0.12, 0.12, 0.13), roughness=0.9)
    glass = scene.material("panes", (0.05, 0.06, 0.08), roughness=0.05)
    houses = []
    for number, (columns, floors) in enumerate(((8, 14), (10, 10), (7, 18))):
        walls, panes = (scene.shape(shape) for shape in facade(columns, floors))
        wall = scene.material(f"wall {number}", (1, 0.9 - 0.1 * number, 0.8), roughness=0.8, pbr=bricks)
        houses.append(scene.add("meshes", {"name": f"house {number}", "primitives": [
            dict(walls, material=wall), dict(panes, material=glass)]}))
    scene.node(name="street", mesh=scene.mesh("street", scene.shape(quad([-20, 0, 20], [20, 0, 20], [20, 0, -20],
                                                                         [-20, 0, -20])), street))
    for i in range(144):
        x, z = i % 12 - 5.5, i // 12 - 5.5
        scene.node(mesh=houses[i % 3], translation=[2 * x, 0, 2 * z], scale=[1.2, 1.5 + 2.5 * noise(i, 1), 1.2],
                   rotation=turn([0, 1, 0], 90 * (i % 4)))
    scene.camera([9.0, 6.5, 13.0], [0.0, 0.5, 0.0], 40.0)
    scene.write(folder)


SCENES = {"still_life": still_life, "parity": parity, "interior": interior, "city": city}


def main(arguments):
    if len(arguments) != 2 or arguments[0] not in SCENES:
        sys.exit(f"usage: make_scenes.py {'|'.join(SCENES)} DIR")
    folder = pathlib.Path(arguments[1])
    folder.mkdir(parents=True, exist_ok=True)
    SCENES[arguments[0]](folder)


if __name__ == "__main__":
    main(sys.argv[1:])
