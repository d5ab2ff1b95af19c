#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""How fast the target core is beside Embree's own tutorial path tracer and Blender's Cycles, on one scene.

    bench/compare_renderers.py SCENE --camera FILE [--pathtracer build/release/bin/pathtracer] [--embree /usr/bin/pathtracer]
                               [--size 640x360] [--threads N] [--max-path-length 8] [--frames 8] [--runs 5]

SCENE is a .gltf or .glb, FILE a camera file as `pathtracer bench` takes it. All programs render with the same threads, size
and path length. They run in turn, RUNS times over, and each times FRAMES samples a pixel without loading and building.
Prints the median of the seconds that a sample per pixel takes, the paths per second, and the median over the runs of how many
times as fast ours is: ours with roulette beside what has roulette, ours without beside the rest.

Embree's program (apt-get install embree-tools) reads no glTF: it gets the triangles, base colours as diffuse reflectance, and
one ambient light in a temporary folder. It runs without a display. Cycles imports the glTF itself (apt-get install blender
python3-numpy) and has the sky and lights of FILE. What is not installed is left out, and a line says so.
"""
import argparse
import array
import base64
import json
import math
import os
import pathlib
import re
import shutil
import statistics
import struct
import subprocess
import sys
import tempfile
import urllib.parse

OURS = {"no roulette": "pathtracer, no roulette", "roulette": "pathtracer, roulette"}
EMBREE = "Embree 3 tutorial"
INDEX_TYPES = {5121: "B", 5123: "H", 5125: "I"}
FLOAT, TRIANGLES = 5126, 4


def fail(message):
    print(f"{pathlib.Path(sys.argv[0]).name}: {message}", file=sys.stderr)
    sys.exit(2)


# The scene for Embree's program: an .xml with the tree of nodes, and a .bin with positions and indices.


class Gltf:
    def __init__(self, path):
        data = path.read_bytes()
        self.folder, self.chunk = path.parent, None
        if data[:4] == b"glTF":
            size = struct.unpack_from("<I", data, 12)[0]
            self.chunk, data = data[20 + size + 8:], data[20:20 + size]
        self.json = json.loads(data)
        self.buffers = [self.read_buffer(buffer) for buffer in self.json.get("buffers", [])]

    def read_buffer(self, buffer):
        uri = buffer.get("uri")
        if uri is None:
            return self.chunk
        if uri.startswith("data:"):
            return base64.b64decode(uri.partition(",")[2])
        return (self.folder / urllib.parse.unquote(uri)).read_bytes()

    def elements(self, number, code, width):
        """The values of an accessor, `width` of them an element, in an array of type `code`."""
        accessor = self.json["accessors"][number]
        if "sparse" in accessor or "bufferView" not in accessor:
            raise ValueError(f"accessor {number} is sparse, which is not supported here")
        view = self.json["bufferViews"][accessor["bufferView"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        size = array.array(code).itemsize * width
        stride, count = view.get("byteStride", size), accessor["count"]
        data = memoryview(self.buffers[view["buffer"]])[start:start + stride * (count - 1) + size]
        if stride != size:
            data = b"".join(data[at:at + size] for at in range(0, len(data), stride))
        return array.array(code, bytes(data))

    def triangles(self, primitive):
        """Positions and indices of a primitive, or None if it has no triangles."""
        position = primitive["attributes"].get("POSITION")
        if primitive.get("mode", TRIANGLES) != TRIANGLES or position is None:
            return None
        if self.json["accessors"][position]["componentType"] != FLOAT:
            raise ValueError(f"accessor {position}: positions that are not floats are not supported here")
        positions = self.elements(position, "f", 3)
        if "indices" not in primitive:
            return positions, array.array("I", range(len(positions) // 3))
        kind = self.json["accessors"][primitive["indices"]]["componentType"]
        return positions, array.array("I", self.elements(primitive["indices"], INDEX_TYPES[kind], 1))

    def roots(self):
        scenes = self.json.get("scenes")
        return scenes[self.json.get("scene", 0)].get("nodes", []) if scenes else range(len(self.json.get("nodes", [])))


def rows(node):
    """The three rows of the node's transform; glTF has matrices by column."""
    m = node.get("matrix")
    if m is None:
        x, y, z, w = node.get("rotation", (0, 0, 0, 1))
        a, b, c = node.get("scale", (1, 1, 1))
        m = ((1 - 2 * (y * y + z * z)) * a, 2 * (x * y + z * w) * a, 2 * (x * z - y * w) * a, 0,
             2 * (x * y - z * w) * b, (1 - 2 * (x * x + z * z)) * b, 2 * (y * z + x * w) * b, 0,
             2 * (x * z + y * w) * c, 2 * (y * z - x * w) * c, (1 - 2 * (x * x + y * y)) * c, 0,
             *node.get("translation", (0, 0, 0)), 1)
    return [m[column * 4 + row] for row in range(3) for column in range(4)]


def numbers(values):
    return " ".join(f"{value:.9g}" for value in values)


class EmbreeScene:
    """Writes a glTF as `path`.xml and `path`.bin."""

    def __init__(self, gltf, path, ambient):
        self.gltf = gltf
        with open(f"{path}.bin", "wb") as self.binary, open(f"{path}.xml", "w", encoding="utf-8") as xml:
            lines = ['<?xml version="1.0"?>', f"<scene><AmbientLight><L>{numbers(ambient)}</L></AmbientLight>"]
            for root in gltf.roots():
                lines += self.node(gltf.json["nodes"][root])
            xml.write("\n".join(lines + ["</scene>", ""]))

    def node(self, node):
        inside = []
        if "mesh" in node:
            for primitive in self.gltf.json["meshes"][node["mesh"]]["primitives"]:
                inside += self.mesh(primitive)
        for child in node.get("children", []):
            inside += self.node(self.gltf.json["nodes"][child])
        if not inside:
            return []
        return [f"<Transform><AffineSpace>{numbers(rows(node))}</AffineSpace><Group>", *inside, "</Group></Transform>"]

    def mesh(self, primitive):
        found = self.gltf.triangles(primitive)
        if found is None:
            return []
        positions, indices = (self.block(values) for values in found)
        return ["<TriangleMesh>", self.material(primitive.get("material")), f"<positions {positions}/>",
                f"<triangles {indices}/>", "</TriangleMesh>"]

    def block(self, values):
        at = self.binary.tell()
        values.tofile(self.binary)
        return f'ofs="{at}" size="{len(values) // 3}"'

    def material(self, number):
        material = {} if number is None else self.gltf.json["materials"][number]
        color = material.get("pbrMetallicRoughness", {}).get("baseColorFactor", (1, 1, 1, 1))
        return (f'<material id="material {number}"><code>"Matte"</code><parameters>'
                f'<float3 name="reflectance">{numbers(color[:3])}</float3></parameters></material>')


# The programs. Each is a function that runs once and returns, by the name of a row, the seconds that a sample per pixel takes.


def output_of(command, environment=None):
    try:
        done = subprocess.run(command, capture_output=True, check=False, text=True, errors="replace", env=environment)
    except OSError as problem:
        fail(f"{command[0]}: {problem.strerror}")
    if done.returncode != 0:
        said = [line for line in done.stderr.splitlines() if line.strip() and "script failed" not in line]
        said = [line for line in said if "error:" in line] or said[-1:]
        fail(f"{command[0]}: exit code {done.returncode}" + (f": {said[0]}" if said else ""))
    return done.stdout


def paths_per_s(command):
    try:
        return json.loads(output_of(command))["paths_per_s"]
    except (ValueError, KeyError):
        fail(f"{command[0]}: its output is not that of pathtracer bench; name ours by --pathtracer")


def ours(options, roulette):
    command = [options.pathtracer, "bench", options.scene, "--camera", options.camera, "--core", "target", "--format", "json",
               "--size", "{}x{}".format(*options.size), "--threads", str(options.threads), "--spp", str(options.frames),
               "--max-path-length", str(options.max_path_length), *([] if roulette == "roulette" else ["--no-roulette"])]
    return lambda: {OURS[roulette]: math.prod(options.size) / paths_per_s(command)}


def embree(options, camera, folder):
    """Its average leaves out the slowest quarter of its frames."""
    scene = os.path.join(folder, "scene")
    sky = camera["sky_radiance"]
    try:
        EmbreeScene(Gltf(pathlib.Path(options.scene)), scene, sky if any(sky) else (1, 1, 1))
    except ValueError as problem:
        fail(f"{options.scene}: {problem}")
    command = [options.embree, "-i", f"{scene}.xml", "--righthanded", "--instancing", "none",
               "--vp", *map(str, camera["position"]), "--vi", *map(str, camera["target"]), "--vu", *map(str, camera["up"]),
               "--fov", str(camera["vfov_degrees"]), "--size", *map(str, options.size), "--threads", str(options.threads),
               "--max-path-length", str(options.max_path_length), "--spp", "1", "--benchmark", "2", str(options.frames)]

    def run():
        found = re.search(r"^BENCHMARK_RENDER_AVG (\S+)", output_of(command), re.MULTILINE)
        if found is None:
            fail(f"{options.embree} printed no BENCHMARK_RENDER_AVG")
        return {EMBREE: 1 / float(found[1])}
    return run


def cycles_job(options, camera):
    """What bench/cycles_render.py has to know of a scene."""
    job = {"scene": os.path.abspath(options.scene), "sky": camera["sky_radiance"],
           "area_lights": camera.get("area_lights", []), "view": {name: camera[name] for name in ("position", "target", "up")},
           "size": options.size, "threads": options.threads, "max_path_length": options.max_path_length}
    job["view"]["vfov"] = math.radians(camera["vfov_degrees"])
    return job


def need_programs(options):
    """Ends where ours or Blender is missing."""
    if not os.access(options.pathtracer, os.X_OK):
        fail(f"there is no program {options.pathtracer}; build it, or name it with --pathtracer")
    if shutil.which("blender") is None:
        fail("there is no blender on the PATH; apt-get install blender python3-numpy")


def run_cycles(job):
    """What bench/cycles_render.py says of a job."""
    script = pathlib.Path(__file__).with_name("cycles_render.py")
    blender = shutil.which("blender")
    # Blender's Python takes its library from beside the first python3 on the PATH: let that be its own.
    environment = os.environ | {"PATH": os.path.dirname(blender) + os.pathsep + os.environ["PATH"]}
    command = [blender, "-b", "--factory-startup", "--python-exit-code", "2", "--python", str(script), "--", json.dumps(job)]
    found = re.search(r"^CYCLES (.*)", output_of(command, environment), re.MULTILINE)
    if found is None:
        fail("blender printed no line CYCLES; see bench/cycles_render.py")
    return json.loads(found[1])


def cycles(options, camera):
    job = cycles_job(options, camera) | {"frames": options.frames}

    def run():
        said = run_cycles(job)
        if min(said[roulette] for roulette in OURS) <= 0:
            fail("Cycles took no longer for more samples; take more --frames, a larger --size or a quieter machine")
        return {f"Cycles {said['version']}, {roulette}": said[roulette] for roulette in OURS}
    return run


def programs(options, camera, folder):
    """What is installed; a line on each that is not."""
    found = [ours(options, roulette) for roulette in OURS]
    if is_embree(options.embree):
        found.append(embree(options, camera, folder))
    else:
        print(f"without Embree's tutorial: {options.embree} is not it; apt-get install embree-tools")
    if shutil.which("blender"):
        found.append(cycles(options, camera))
    else:
        print("without Cycles: no blender on the PATH; apt-get install blender python3-numpy")
    return found


def is_embree(path):
    """Ours has the same name."""
    try:
        return "--rtcore" in subprocess.run([path, "--help"], capture_output=True, check=False, text=True).stdout
    except OSError:
        return False


def print_table(rounds, pixels):
    print(f"{'program':<28}{'s per sample per pixel':>24}{'M paths/s':>12}{'ours over it':>15}")
    for name in rounds[0]:
        ours_name = OURS["roulette" if name.endswith(", roulette") else "no roulette"]
        seconds = statistics.median(times[name] for times in rounds)
        ratio = statistics.median(times[name] / times[ours_name] for times in rounds)
        faster = "-" if name in OURS.values() else f"{ratio:.2f}"
        print(f"{name:<28}{seconds:>24.4f}{pixels / seconds / 1e6:>12.2f}{faster:>15}")


# What is asked for


def size(text):
    found = re.fullmatch(r"([1-9]\d{0,4})x([1-9]\d{0,4})", text)
    if found is None:
        raise argparse.ArgumentTypeError(f"{text}: expected WxH, such as 640x360")
    return int(found[1]), int(found[2])


def at_least(least):
    def number(text):
        if not text.isascii() or not text.isdigit() or int(text) < least:
            raise argparse.ArgumentTypeError(f"{text}: expected a whole number of at least {least}")
        return int(text)
    return number


def read_options():
    parser = argparse.ArgumentParser(usage=argparse.SUPPRESS, description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.error = fail
    parser.add_argument("scene")
    parser.add_argument("--camera", required=True)
    parser.add_argument("--pathtracer", default="build/release/bin/pathtracer")
    parser.add_argument("--embree", default="/usr/bin/pathtracer")
    parser.add_argument("--size", type=size, default=(640, 360))
    parser.add_argument("--threads", type=at_least(1), default=os.cpu_count())
    parser.add_argument("--max-path-length", type=at_least(2), default=8)
    parser.add_argument("--frames", type=at_least(1), default=8)
    parser.add_argument("--runs", type=at_least(1), default=5)
    options = parser.parse_args()
    for path in (options.scene, options.camera, options.pathtracer):
        if not os.path.isfile(path):
            fail(f"no file {path}" + ("; build it, or name it with --pathtracer" if path == options.pathtracer else ""))
    return options


def read_camera(options):
    """Ours has read the file before, and would have said what is wrong with it."""
    ours(options, "roulette")()
    camera = json.loads(pathlib.Path(options.camera).read_bytes())
    if "sky_radiance" not in camera:
        fail(f"{options.camera}: /sky_radiance is missing; add it, so that all programs have the same sky")
    return camera


def main():
    options = read_options()
    camera = read_camera(options)
    rounds = []
    with tempfile.TemporaryDirectory() as folder:
        found = programs(options, camera, folder)
        for number in range(options.runs):
            if sys.stderr.isatty():
                print(f"run {number + 1} of {options.runs}", file=sys.stderr)
            rounds.append({name: seconds for program in found for name, seconds in program().items()})
    print("{} at {}x{}, {} threads, paths of up to {} segments, medians of {} runs".format(
        options.scene, *options.size, options.threads, options.max_path_length, options.runs))
    print_table(rounds, math.prod(options.size))
    if EMBREE in rounds[0]:
        print("Embree's tutorial does far less a vertex: diffuse only, no textures, flat normals, one ambient light, no MIS;\n"
              "it drops a path whose weight is below 1 %, which cannot be switched off.")


if __name__ == "__main__":
    main()
