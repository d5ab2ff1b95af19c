# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""What bench/thesis.py measures, kept in a folder from one run to the next."""
import functools
import hashlib
import json
import os
import pathlib
import resource
import subprocess
import time
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parent.parent
CORES = ("source", "target")
OTHER_SEED = 1


def kernel_digests():
    files = [p for core in CORES for p in sorted((ROOT / f"{core}_core/kernels").iterdir())]
    return {p.relative_to(ROOT).as_posix(): hashlib.sha256(p.read_bytes()).hexdigest()[:12] for p in files}


@functools.lru_cache(maxsize=None)
def digest_of_version(path, _changed, _size):
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def file_digest(path):
    """Of its contents, read once as long as nobody changes it; None where there is no such file."""
    try:
        if not path.is_file():
            return None
        about = path.stat()
        return digest_of_version(str(path), about.st_mtime_ns, about.st_size)
    except (OSError, ValueError):
        return None


def digests_of(files):
    return {str(file): file_digest(file) for file in files}


def digest_of(parts):
    return hashlib.sha256(json.dumps(parts).encode()).hexdigest()[:12]


def code_digest():
    """Of the map and of all texts of both cores."""
    files = sorted(p for core in CORES for p in (ROOT / f"{core}_core").rglob("*") if p.is_file())
    return digest_of([hashlib.sha256(p.read_bytes()).hexdigest() for p in [ROOT / "portmap.toml", *files]])


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def answer_in(file):
    """What an earlier run kept; nothing of a file that is not there or was damaged, so that it is measured anew."""
    try:
        answer = json.loads(file.read_text())
    except (OSError, ValueError, RecursionError):
        return {}
    whole = isinstance(answer, dict) and answer.pop("whole", None) == whole_digest(answer)
    return answer if whole else {}


def whole_digest(answer):
    """By which an answer that was damaged after it was kept is known."""
    return digest_of([json.dumps(answer, sort_keys=True)])


class Measurements:
    """Answers of commands, kept in a folder."""

    def __init__(self, folder, program, porttool):
        self.folder, self.program, self.porttool = folder, program, porttool
        self.digest = digest_of(kernel_digests())
        self.failures = []
        self.inherited = ()  # descriptors that what is started keeps open, as that of a lock
        self.seconds, self.processor_seconds = 0.0, 0.0
        (folder / "measured").mkdir(parents=True, exist_ok=True)

    def take(self, name, command, reads=(), writes=(), inputs=""):
        """The JSON that the command prints ({} where it prints none), from the folder if it is there and the files that
        the command reads and writes have the contents that they had then. `inputs`: a digest of what else the answer
        depends on. None where it fails, which the page then says."""
        file = self.folder / "measured" / f"{name}.json"
        said = [str(word) for word in command]
        asked = {"command": said, "kernels": self.digest, "inputs": inputs, "read": self.inside(reads)}
        before = answer_in(file)
        if all(before.get(key) == value for key, value in {**asked, "written": self.inside(writes)}.items()):
            self.add_cost(before["cost"])
            return before["result"]
        self.withdraw(writes)
        start, busy = time.monotonic(), processor_seconds()
        done = subprocess.run(said, capture_output=True, text=True, check=False, cwd=ROOT,
                              pass_fds=self.inherited)
        cost = [time.monotonic() - start, processor_seconds() - busy]
        self.add_cost(cost)
        if done.returncode not in (0, 1) or (done.returncode == 1 and not done.stdout):
            self.failures.append(f"{name}: {' '.join(done.stderr.split())}")
            return None
        result = json.loads(done.stdout) if done.stdout.startswith("{") else {}
        unfinished = file.with_suffix(".new")
        kept = {**asked, "written": self.inside(writes), "cost": cost, "result": result}
        unfinished.write_text(json.dumps({**kept, "whole": whole_digest(kept)}, indent=1))
        unfinished.replace(file)
        return result

    def inside(self, files):
        """Their digests by the paths in the folder."""
        return {os.path.relpath(file, self.folder): digest for file, digest in digests_of(files).items()}

    def withdraw(self, files):
        """Removes files that are to be written anew, and before them the page of an earlier run that shows them, so that a
        killed run leaves no page with pictures that are not its own. The HTML page has its pictures in itself and stays."""
        if any(file.is_file() for file in files):
            (self.folder / "thesis.md").unlink(missing_ok=True)
        for file in files:
            file.unlink(missing_ok=True)

    def add_cost(self, cost):
        self.seconds += cost[0]
        self.processor_seconds += cost[1]

    def pathtracer(self, name, *words, reads=(), writes=(), scene=None):
        command = [self.program, *words, "--quiet", "--format", "json"]
        return self.take(name, command, reads, writes, scene.digest() if scene is not None else "")

    def report(self):
        """What both cores share, of the texts and the map as they are; None without porttool."""
        return self.porttool and self.take("report", [self.porttool, "report", "--format", "json"], inputs=code_digest())

    def effort(self, first, last):
        return self.porttool and self.take("effort", [self.porttool, "effort", "--from", first, "--to", last, "--format", "json"],
                                           inputs=code_digest())


class Scene:
    """A scene as the command line takes it. `ours`: it is of this project's own making."""

    def __init__(self, name, file, options=(), ours=False):
        self.name, self.file, self.options, self.ours = name, file, [str(option) for option in options], ours

    def words(self, settings):
        return [self.file, "--size", settings["size"], *self.options]

    def path(self):
        """Of its .gltf, also of a scene of the project's own that goes by its name alone, wherever this was started."""
        file = pathlib.Path(self.file)
        return file if file.is_absolute() else ROOT / "scenes" / self.file / f"{self.file}.gltf"

    def digest(self):
        """Of the contents of its text, its camera's, and all files that it names."""
        texts = [self.path(), *(pathlib.Path(option) for option in self.options if option.endswith(".json"))]
        named = [self.path().parent / urllib.parse.unquote(item["uri"]) for item in named_files(json.loads(self.path().read_text()))]
        return digest_of([file_digest(p) for p in [*texts, *named]])


def named_files(gltf):
    """Its buffers and images that are files of their own."""
    return [item for item in gltf.get("buffers", []) + gltf.get("images", [])
            if isinstance(item.get("uri"), str) and not item["uri"].startswith("data:")]


def diffuse_copy(scene, folder):
    """The scene with every material Lambert's: no metal, no reflection, no transmission, same colours and lights."""
    file = scene.path()
    gltf = json.loads(file.read_text())
    for material in gltf.get("materials", []):
        pbr = material.setdefault("pbrMetallicRoughness", {})
        pbr.update(metallicFactor=0.0, roughnessFactor=1.0)
        pbr.pop("metallicRoughnessTexture", None)
        kept = {k: v for k, v in material.get("extensions", {}).items() if k == "KHR_materials_emissive_strength"}
        material["extensions"] = {**kept, "KHR_materials_specular": {"specularFactor": 0.0}}
    gltf["extensionsUsed"] = sorted({*gltf.get("extensionsUsed", []), "KHR_materials_specular"})
    folder.mkdir(parents=True, exist_ok=True)
    for item in named_files(gltf):
        item["uri"] = os.path.relpath(file.parent / item["uri"], folder)
    copy = folder / f"{scene.name}_diffuse.gltf"
    text = json.dumps(gltf)
    if not copy.is_file() or copy.read_bytes() != text.encode():
        copy.write_text(text)
    return Scene(f"{scene.name}, diffuse", str(copy), [*scene.options, "--allow-outside"])


def measure_pictures(take, scene, settings, pictures):
    """Table 1 of one scene: the cores with one seed, with a seed for each, and the target core against itself."""
    counts = settings["counts"]
    folder = pictures / scene.name
    shown = [folder / f"{what}_{spp}spp.png" for spp in counts for what in (*CORES, "difference")]
    same = take.pathtracer(f"{scene.name}_same", "compare", *scene.words(settings), "--spp", ",".join(map(str, counts)),
                           "-o", folder, writes=shown, scene=scene)
    if same is None:
        return None
    rows = {}
    for row in same["results"]:
        spp = row["spp"]
        other = folder / f"other_{spp}spp.png"
        drawn = take.pathtracer(f"{scene.name}_other_{spp}", "render", *scene.words(settings), "--core", "target",
                                "--seed", OTHER_SEED, "--spp", spp, "-o", other, writes=[other], scene=scene)
        pairs = {core: (folder / f"{core}_{spp}spp.png", other) for core in CORES}
        found = [take.pathtracer(f"{scene.name}_{core}_and_other_{spp}", "compare", *pair, reads=pair, scene=scene)
                 for core, pair in pairs.items()]
        if drawn is None or None in found:
            return None
        rows[spp] = {"same": row, "own": found[0]["results"][0], "itself": found[1]["results"][0]}
    bias = take.pathtracer(f"{scene.name}_bias", "compare", *scene.words(settings), "--bias", "--spp", settings["bias"],
                           "-o", pictures / f"{scene.name}_bias", writes=[pictures / f"{scene.name}_bias/bias.png"],
                           scene=scene)
    return {"rows": rows, "bias": bias and bias["bias"]}


def measure_speed(take, scene, settings, folder):
    """Four series: each core, with all materials and with diffuse ones."""
    series = {}
    for kind, variant in (("all materials", scene), ("diffuse", diffuse_copy(scene, folder / "scenes"))):
        for core in CORES:
            bench = take.pathtracer(f"{scene.name}_{kind.split()[0]}_{core}", "bench", *variant.words(settings), "--core",
                                    core, "--spp", settings["frames"], scene=variant)
            if bench is not None:
                series[f"{core} core, {kind}"] = bench
    return series
