# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Both cores built with an edit and its port, and held against each other in checking mode, for bench/own_edits.py.

One work tree is kept warm: between two edits only the files that differ are written, and only the cores' two modules are
built, the target core's for one lane, which is all that --exact runs. The scene is that of make_scenes.py which asks
everything of two cores, with lights of every kind, two solids in one place and something that moves; frames with
--filter temporal run the kernels of the filter as well.
"""
import base64
import hashlib
import json
import math
import pathlib
import struct
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scenes"))
import make_scenes  # noqa: E402

SIZE = ["--size", "64x36", "--spp", "2", "--exact", "--quiet"]
LIGHTS = [{"type": "spot", "intensity": 60.0, "spot": {"innerConeAngle": 0.3, "outerConeAngle": 0.7}},
          {"type": "point", "intensity": 20.0}, {"type": "directional", "intensity": 0.5}]


def write_scene(folder):
    """The scene's file; the sky lies beside it as sky.hdr."""
    make_scenes.parity(folder)
    gltf = json.loads((folder / "parity.gltf").read_text())
    nodes, shown = gltf["nodes"], gltf["scenes"][0]["nodes"]

    def add(node):
        nodes.append(node)
        shown.append(len(nodes) - 1)
        return len(nodes) - 1

    gltf["extensionsUsed"] = gltf.get("extensionsUsed", []) + ["KHR_lights_punctual"]
    gltf["extensions"] = {"KHR_lights_punctual": {"lights": LIGHTS}}
    for i in range(len(LIGHTS)):
        add({"translation": [2.0 * i - 2.0, 3.0, 7.0], "rotation": [-0.2, 0.0, 0.0, math.sqrt(1.0 - 0.04)],
             "extensions": {"KHR_lights_punctual": {"light": i}}})
    solid = {"mesh": nodes[4]["mesh"], "translation": [1.0, 0.8, 7.5], "scale": [0.5, 0.5, 0.5]}
    add(dict(solid))
    add(dict(solid))  # in the very same place
    moved = add({"mesh": nodes[3]["mesh"], "translation": [-1.0, 0.5, 7.5], "scale": [0.6, 0.6, 0.6]})
    data = struct.pack("<2f", 0.0, 1.0) + struct.pack("<6f", -1.0, 0.5, 7.5, 0.6, 1.1, 7.2)
    gltf["buffers"].append({"byteLength": len(data),
                            "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()})
    views, accessors = gltf["bufferViews"], gltf["accessors"]
    views += [{"buffer": len(gltf["buffers"]) - 1, "byteOffset": 0, "byteLength": 8},
              {"buffer": len(gltf["buffers"]) - 1, "byteOffset": 8, "byteLength": 24}]
    accessors += [{"bufferView": len(views) - 2, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0.0], "max": [1.0]},
                  {"bufferView": len(views) - 1, "componentType": 5126, "count": 2, "type": "VEC3"}]
    gltf["animations"] = [{"samplers": [{"input": len(accessors) - 2, "output": len(accessors) - 1}],
                           "channels": [{"sampler": 0, "target": {"node": moved, "path": "translation"}}]}]
    (folder / "edits.gltf").write_text(json.dumps(gltf))
    return folder / "edits.gltf"


class Build:
    """A work tree of one revision whose build stays warm."""

    def __init__(self, folder, revision):
        self.tree, self.pictures = folder / "tree", folder / "pictures"
        self.pictures.mkdir(parents=True, exist_ok=True)
        if not (self.tree / ".git").exists():
            self.shell(folder, "git", "clone", "-q", "-s", str(ROOT), str(self.tree))
        self.shell(self.tree, "git", "checkout", "-q", "--force", "--detach", revision)  # its objects are ours
        self.written = set()
        self.scene = write_scene(self.pictures)
        self.shell(self.tree, "cmake", "--preset", "release", "-DPORTTOOL_TESTS=OFF", "-DTARGET_CORE_LANES=1")
        self.shell(self.tree, "ninja", "-C", "build/release", "pathtracer", "source_core_module", "target_core_module")
        self.unedited, said = self.draw()
        if said:
            sys.exit(f"own_edits.py: without an edit: {said}")

    @staticmethod
    def shell(folder, *words):
        done = subprocess.run(words, cwd=folder, capture_output=True, text=True)
        if done.returncode:
            raise RuntimeError(f"{words[0]}: " + "\n".join((done.stdout + done.stderr).strip().splitlines()[-25:]))
        return done.stdout

    def program(self, *words):
        return self.shell(self.pictures, str(self.tree / "build/release/bin/pathtracer"), *words)

    def draw(self):
        """What the target core drew, as a digest, and how the cores differ (empty: not at all)."""
        sky = ["--sky", "sky.hdr", *SIZE]
        found = json.loads(self.program("compare", self.scene.name, *sky, "--format", "json"))["results"][0]
        if found["identical_pixels"] != 1.0:
            return "", f"{found['identical_pixels']:.3%} of a picture's pixels are identical"
        digest = hashlib.sha256()
        for core in ("source", "target"):
            self.program("render", self.scene.name, *sky, "--core", core, "--filter", "temporal", "--frames", "0:3",
                         "-o", f"{core}_#.exr")
        for path in sorted(self.pictures.glob("target_*.exr")):
            other = path.with_name(path.name.replace("target", "source"))
            found = json.loads(self.program("compare", str(path), str(other), "--format", "json"))["results"][0]
            if found["identical_pixels"] != 1.0:
                return "", f"{found['identical_pixels']:.3%} of the pixels of {path.name[7:]} are identical"
            digest.update(path.read_bytes())
        return digest.hexdigest(), ""

    def try_all(self, edits, group):
        """What came of each edit, (name of the result, what there is to say), for the texts of both cores' changed files
        by path. Up to `group` edits that merge without a conflict are built and drawn together; where that fails, halves
        of them. What of a group changes the picture is not told apart."""
        results, waiting = {}, list(range(len(edits)))
        while waiting:
            merged, taken = {}, []
            for i in list(waiting):
                more = self.merged(merged, edits[i])
                if len(taken) < group and more is not None:
                    merged = more
                    taken.append(i)
                    waiting.remove(i)
            self.try_group(edits, taken, results)
        return [results[i] for i in range(len(edits))]

    def try_group(self, edits, taken, results):
        merged = {}
        for i in taken:
            merged = self.merged(merged, edits[i])
        found = self.try_out(merged)
        print(f"{len(taken)} edits together: {found[0]}", flush=True)
        if found[0].startswith("identical") or len(taken) == 1:
            results.update({i: found for i in taken})
            return
        self.try_group(edits, taken[:len(taken) // 2], results)
        self.try_group(edits, taken[len(taken) // 2:], results)

    def merged(self, files, more):
        """The texts with another edit in them; None where the two touch the same lines, or lines side by side."""
        out = dict(files)
        for path, text in more.items():
            if path not in files:
                out[path] = text
                continue
            base = self.shell(self.tree, "git", "show", f"HEAD:{path}")
            names = []
            for name, content in (("ours", files[path]), ("base", base), ("theirs", text)):
                names.append(str(self.pictures / f"merge.{name}"))
                pathlib.Path(names[-1]).write_text(content)
            done = subprocess.run(["git", "merge-file", "-p", *names], capture_output=True, text=True)
            if done.returncode:
                return None
            out[path] = done.stdout
        return out

    def try_out(self, files):
        """Builds these texts by path in both cores, and draws."""
        for path in self.written - set(files):
            self.shell(self.tree, "git", "checkout", "-q", "HEAD", "--", path)
        self.written = set()
        for path, text in files.items():
            self.written.add(path)
            file = self.tree / path
            if not file.is_file() or file.read_text() != text:
                file.write_text(text)
        try:
            self.shell(self.tree, "ninja", "-C", "build/release", "source_core_module", "target_core_module")
        except RuntimeError as error:
            return "not built", str(error)
        try:
            drawn, said = self.draw()
        except RuntimeError as error:
            return "not drawn", str(error)
        if said:
            return "not identical", said
        return ("identical, as before" if drawn == self.unedited else "identical, changed"), ""
