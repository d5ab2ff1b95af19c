#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Measures anew what the thesis has in tables and figures, beside its own numbers.

    bench/thesis.py -o DIR            everything (an hour and more on two processors without a GPU); interrupted, it goes on where it was
    bench/thesis.py --quick -o DIR    a small picture of one scene, in seconds
    bench/thesis.py --self-test FILE  the same small run packed into one file, for a machine with a GPU, to be sent back
    bench/thesis.py --with FILE...    such files beside this machine
    bench/thesis.py --keep PAGE.md ...   also puts the page there, with its pictures in a folder PAGE beside it: those of
                                         scenes of our own, as others' are not ours to pass on
    bench/thesis.py --age PAGE        brings up to date how many kernel files changed since PAGE was made

DIR/thesis.html is one file, DIR/thesis.md has its pictures in DIR/pictures. Every number of theirs is in DIR/measured,
with the command that gave it; a measurement is taken again only where its command or a kernel changed.
"""
import argparse
import hashlib
import json
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import time
import tomllib
import zipfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import thesis_numbers as thesis  # noqa: E402
from thesis_page import Page  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
CORES = ("source", "target")
BLOCKS = ("generate", "extend", "shade", "connect", "finalize")
QUICK = {"size": "64x36", "counts": [1, 4], "bias": 16, "frames": 2}
FULL = {"size": "320x180", "counts": [1, 4, 16, 64, 256, 1024], "bias": 256, "frames": 9}
OTHER_SEED = 1
FEWEST_PORTS = 8  # that porttool fits equation 8 to


def fail(message):
    print(f"thesis.py: {message}", file=sys.stderr)
    sys.exit(2)


# --- The age of a page ---


def kernel_digests():
    files = [p for core in CORES for p in sorted((ROOT / f"{core}_core/kernels").iterdir())]
    return {p.relative_to(ROOT).as_posix(): hashlib.sha256(p.read_bytes()).hexdigest()[:12] for p in files}


def age_line(then, now):
    changed = [file for file in sorted(then.keys() | now.keys()) if then.get(file) != now.get(file)]
    return f"{len(changed)} of {len(now)} kernel files changed since these numbers were taken."


AGE = re.compile(r"^\d+ of \d+ kernel files changed since these numbers were taken\.$", re.M)


def update_age(page):
    try:
        text = page.read_text()
    except (OSError, UnicodeDecodeError) as error:
        fail(f"--age {page}: {getattr(error, 'strerror', None) or 'is no text'}; name a page that --keep wrote")
    then = dict(re.findall(r"^<!-- kernel (\S+) ([0-9a-f]{12}) -->$", text, re.M))
    if not then or not AGE.search(text):
        fail(f"{page} was not made by this program")
    line = age_line(then, kernel_digests())
    page.write_text(AGE.sub(line, text))
    print(line)


# --- Measuring ---


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class Measurements:
    """Answers of commands, kept in a folder."""

    def __init__(self, folder, program, porttool):
        self.folder, self.program, self.porttool = folder, program, porttool
        self.digest = hashlib.sha256(json.dumps(kernel_digests()).encode()).hexdigest()[:12]
        self.failures = []
        self.seconds, self.processor_seconds = 0.0, 0.0
        (folder / "measured").mkdir(parents=True, exist_ok=True)

    def take(self, name, command, kept=None):
        """The JSON that the command prints ({} where it prints none), from the folder if it is there. `kept`: a file
        that the command writes and that must still be there. None where it fails, which the page then says."""
        file = self.folder / "measured" / f"{name}.json"
        said = [str(word) for word in command]
        if file.is_file() and (kept is None or kept.is_file()):
            before = json.loads(file.read_text())
            if before["command"] == said and before["kernels"] == self.digest and "cost" in before:
                self.add_cost(before["cost"])
                return before["result"]
        start, busy = time.monotonic(), processor_seconds()
        done = subprocess.run(said, capture_output=True, text=True, check=False, cwd=ROOT)
        cost = [time.monotonic() - start, processor_seconds() - busy]
        self.add_cost(cost)
        if done.returncode not in (0, 1) or (done.returncode == 1 and not done.stdout):
            self.failures.append(f"{name}: {' '.join(done.stderr.split())}")
            return None
        result = json.loads(done.stdout) if done.stdout.startswith("{") else {}
        unfinished = file.with_suffix(".new")
        unfinished.write_text(json.dumps({"command": said, "kernels": self.digest, "cost": cost, "result": result},
                                         indent=1))
        unfinished.replace(file)
        return result

    def add_cost(self, cost):
        self.seconds += cost[0]
        self.processor_seconds += cost[1]

    def pathtracer(self, name, *words, kept=None):
        return self.take(name, [self.program, *words, "--quiet", "--format", "json"], kept)


class Scene:
    """A scene as the command line takes it. `ours`: it is of this project's own making."""

    def __init__(self, name, file, options=(), ours=False):
        self.name, self.file, self.options, self.ours = name, file, [str(option) for option in options], ours

    def words(self, settings):
        return [self.file, "--size", settings["size"], *self.options]


def diffuse_copy(scene, folder):
    """The scene with every material Lambert's: no metal, no reflection, no transmission, same colours and lights."""
    file = pathlib.Path(scene.file)
    if not file.is_file():
        file = ROOT / "scenes" / scene.file / f"{scene.file}.gltf"
    gltf = json.loads(file.read_text())
    for material in gltf.get("materials", []):
        pbr = material.setdefault("pbrMetallicRoughness", {})
        pbr.update(metallicFactor=0.0, roughnessFactor=1.0)
        pbr.pop("metallicRoughnessTexture", None)
        kept = {k: v for k, v in material.get("extensions", {}).items() if k == "KHR_materials_emissive_strength"}
        material["extensions"] = {**kept, "KHR_materials_specular": {"specularFactor": 0.0}}
    gltf["extensionsUsed"] = sorted({*gltf.get("extensionsUsed", []), "KHR_materials_specular"})
    folder.mkdir(parents=True, exist_ok=True)
    for item in gltf.get("buffers", []) + gltf.get("images", []):
        if "uri" in item and not item["uri"].startswith("data:"):
            item["uri"] = os.path.relpath(file.parent / item["uri"], folder)
    copy = folder / f"{scene.name}_diffuse.gltf"
    text = json.dumps(gltf)
    if not copy.is_file() or copy.read_text() != text:
        copy.write_text(text)
    return Scene(f"{scene.name}, diffuse", str(copy), [*scene.options, "--allow-outside"])


def measure_pictures(take, scene, settings, pictures):
    """Table 1 of one scene: the cores with one seed, with a seed for each, and the target core against itself."""
    counts = settings["counts"]
    folder = pictures / scene.name
    last = folder / f"difference_{counts[-1]}spp.png"
    same = take.pathtracer(f"{scene.name}_same", "compare", *scene.words(settings), "--spp", ",".join(map(str, counts)),
                           "-o", folder, kept=last)
    if same is None:
        return None
    rows = {}
    for row in same["results"]:
        spp = row["spp"]
        other = folder / f"other_{spp}spp.png"
        drawn = take.pathtracer(f"{scene.name}_other_{spp}", "render", *scene.words(settings), "--core", "target",
                                "--seed", OTHER_SEED, "--spp", spp, "-o", other, kept=other)
        found = [take.pathtracer(f"{scene.name}_{core}_and_other_{spp}", "compare", folder / f"{core}_{spp}spp.png", other)
                 for core in CORES]
        if drawn is None or None in found:
            return None
        rows[spp] = {"same": row, "own": found[0]["results"][0], "itself": found[1]["results"][0]}
    bias = take.pathtracer(f"{scene.name}_bias", "compare", *scene.words(settings), "--bias", "--spp", settings["bias"],
                           "-o", pictures / f"{scene.name}_bias", kept=pictures / f"{scene.name}_bias/bias.png")
    return {"rows": rows, "bias": bias and bias["bias"]}


def measure_speed(take, scene, settings, folder):
    """Four series: each core, with all materials and with diffuse ones."""
    series = {}
    for kind, variant in (("all materials", scene), ("diffuse", diffuse_copy(scene, folder / "scenes"))):
        for core in CORES:
            bench = take.pathtracer(f"{scene.name}_{kind.split()[0]}_{core}", "bench", *variant.words(settings), "--core",
                                    core, "--spp", settings["frames"])
            if bench is not None:
                series[f"{core} core, {kind}"] = bench
    return series


# --- The page ---


def number(value, digits=3):
    return "-" if value is None else f"{value:.{digits}f}"


def degree_of(block):
    """As `porttool report` has it: 1.00 is a port that costs nothing at all."""
    degree = block["degree_of_portability"]
    if degree is None or degree["loc"] is None:
        return "-"
    return "0.99" if 0.99 < degree["loc"] < 1 else number(degree["loc"], 2)


def add_machine(page, take, settings, left_out, scenes):
    info = take.take("info", [take.program, "info", "--format", "json"]) or {"cores": []}
    devices = {core["id"]: core.get("device") or core.get("reason") for core in info["cores"]}
    section = page.section("What was run, and on what")
    section.table(["core", "device"], [[core, devices.get(core, "-")] for core in CORES])
    section.say(f"Pictures of {settings['size']}, up to {settings['counts'][-1]} samples a pixel. Times are of this machine in "
                f"the state in which it was (load {os.getloadavg()[2]:.0f} on {os.cpu_count()} processors when the page was made); "
                "whoever compares times should leave it alone meanwhile.")
    if any(word in (devices.get("source") or "").lower() for word in ("llvmpipe", "lavapipe", "swiftshader")):
        section.say("This machine has no GPU: the source core runs in software here, and its times say nothing of the thesis's "
                    "GPU. `bench/thesis.py --self-test FILE` on a machine with one makes a file that `--with FILE` adds.")
    section.say(f"Measuring took {take.seconds / 60:.1f} minutes, and {take.processor_seconds / 60:.1f} minutes of processor "
                "time, of which an idle machine needs at least its share a processor.")
    ours, others = ([scene.name for scene in scenes if scene.ours == own] for own in (True, False))
    section.say("Scenes of our own, by rising size: " + ", ".join(ours) + ("; and " + ", ".join(others) if others else "") + ".")
    for reason in left_out:
        section.say(f"Left out: {reason}.")


def add_table1(page, scene, found):
    section = page.section(f"Table 1: pictures of the two cores, {scene.name}")
    rows = []
    for spp, row in found["rows"].items():
        cells = [spp]
        for kind in ("same", "own", "itself"):
            cells += [number(row[kind]["ssim"], 4), number(row[kind]["rmse"], 2)]
        for theirs in (thesis.TABLE1["Sponza"], thesis.TABLE1["Pica Pica"]):
            ssim, rmse = theirs.get(spp, (None, None))
            cells += [number(ssim), number(rmse, 1)]
        rows.append(cells)
    section.table(["samples", "same seed: SSIM", "RMSE", "a seed each: SSIM", "RMSE", "target against itself: SSIM", "RMSE",
                   "thesis, Sponza: SSIM", "RMSE", "thesis, Pica Pica: SSIM", "RMSE"], rows)
    section.say("RMSE of levels from 0 to 255. \"A seed each\" is the source core against the target core with independent noise; "
                "\"target against itself\" is that very picture against the target core with the first seed. Where these two "
                "agree, all that differs is noise. The thesis's own figures stop falling at 28.1 and 31.9: what noise cannot do.")
    bias = found["bias"]
    if bias is not None:
        section.table(["batches with seeds of their own", "verdict", "p", "tiles that differ", "mean difference", "standard error", "would be found from"],
                      [["bias", bias["verdict"], f"{bias['p_value']:.2g}", f"{bias['tiles_different']} of {bias['tiles']}",
                        f"{bias['mean_difference']:+.2e}", f"{bias['standard_error']:.1e}",
                        "-" if bias["detectable"] is None else f"{100 * bias['detectable']:.2g} %"]])


def add_pictures(page, scene, counts, pictures):
    section = page.section(f"Figures 8 to 11: {scene.name}")
    for name, what in (("source", "source core"), ("target", "target core"), ("difference", "difference, times 16")):
        section.picture(pictures / scene.name / f"{name}_{counts[-1]}spp.png", f"{what}, {counts[-1]} samples")
    section.picture(pictures / f"{scene.name}_bias/bias.png", "where the means differ, if they do")


def add_speed(page, scene, series):
    section = page.section(f"Figures 12 to 15: speed, {scene.name}")
    def rows_of(cells):
        return [[name, *cells(bench)] for name, bench in series.items()]
    section.table(["series", "frames a second (Fig. 12)", "ms a frame", "million rays a second (Fig. 15)", "tracing alone"], rows_of(
        lambda b: [number(1000 / b["ms_per_frame"]["total"], 2), number(b["ms_per_frame"]["total"], 2),
                   number(b["mrays_per_s"]["total"], 2), number(b["mrays_per_s"]["trace"], 2)]) + thesis.SPEED)
    section.bars("frames a second", {name: 1000 / bench["ms_per_frame"]["total"] for name, bench in series.items()})
    section.table(["rays of a frame (Fig. 13)", "primary", "extension", "shadow", "total", "primary and extension, % of all"],
                  rows_of(lambda b: [*(b["rays"][kind] for kind in ("primary", "extension", "shadow", "total")),
                                     number(100 * (b["rays"]["primary"] + b["rays"]["extension"]) / max(b["rays"]["total"], 1), 1)])
                  + thesis.RAYS)
    section.table(["time of a frame, % (Fig. 14)", *BLOCKS, "between them", "tracing"], rows_of(time_shares) + thesis.TIME)


def time_shares(bench):
    ms = bench["ms_per_frame"]
    total = max(ms["total"], 1e-9)
    shares = [100 * ms[block] / total for block in BLOCKS]
    return [number(share, 1) for share in [*shares, 100 - sum(shares), shares[1] + shares[3]]]


def add_table2(page, report):
    section = page.section("Table 2 and Figure 16: what the port shares")
    if report is None:
        section.say("Left out: porttool is not there; build it, or name it with --porttool.")
        return
    whole = {block["name"]: block for block in report["blocks"]}.get("Render core", report["totals"])
    rows = []
    for block in report["blocks"]:
        theirs = thesis.TABLE2.get(block["name"], ("-",) * 7)
        rows.append([block["name"], block["target_lines"], block["shared_target"], number(block["moss_percent_target"], 0),
                     block["source_lines"], block["shared_source"], number(block["moss_percent_source"], 0),
                     degree_of(block),
                     number(100 * block["target_lines"] / max(whole["target_lines"], 1), 1), *theirs])
    section.table(["block", "CPU lines", "shared", "Moss %", "GPU lines", "shared", "Moss %", "degree of portability",
                   "% of the whole CPU core", "thesis: CPU lines", "shared", "Moss %", "GPU lines", "shared", "Moss %",
                   "degree of portability"], rows)
    section.say("The render core's lines are host code for the most part, whose changes the count of kernel files at the head of this "
                "page does not see; the figures of the day are in docs/portability-report.md.")
    section.bars("degree of portability", {b["name"]: b["degree_of_portability"]["loc"] for b in report["blocks"]
                                           if b["degree_of_portability"]})


def law_of_ports(take):
    """Equation 8 fitted to the ports that portmap.toml records with lines and hours, asked of the last of them."""
    records = tomllib.loads((ROOT / "portmap.toml").read_text()).get("effort", [])
    timed = [record for record in records if "lines" in record and "port" in record]
    if len(timed) < FEWEST_PORTS or take.porttool is None:
        return f"{len(timed)} ports are recorded with lines and hours; a fit needs {FEWEST_PORTS}"
    answer = take.take("effort", [take.porttool, "effort", "--from", timed[-1]["from"], "--to", timed[-1]["to"],
                                  "--format", "json"])
    law = answer and answer["predicted_hours_by_law"]
    if not law:
        return "not fitted"
    return f"{law['value']:.2g} h ({law['low']:.2g} to {law['high']:.2g}) for {timed[-1]['lines']} lines"


def add_equations(page, report, scene, pictures, take):
    section = page.section("Equations 3 to 8")
    rows = []
    if pictures is not None:
        spp, row = list(pictures["rows"].items())[-1]
        rows += [[f"RMSE, {scene.name}, {spp} samples", "sqrt(mean (a - b)^2)", number(row["same"]["rmse"], 2),
                  "31.9 (Pica Pica, 1024)"],
                 [f"SSIM, {scene.name}, {spp} samples",
                  "(2 m_a m_b + c_1)(2 s_ab + c_2) / ((m_a^2 + m_b^2 + c_1)(s_a^2 + s_b^2 + c_2))",
                  number(row["same"]["ssim"], 4), "0.878 (Pica Pica, 1024)"]]
    for block in (report or {"blocks": []})["blocks"]:
        theirs = thesis.TABLE2.get(block["name"])
        if not theirs:
            continue
        lines, shared = block["target_lines"], block["shared_target"]
        rows += [[f"C_port, {block['name']}", "lines not shared", lines - shared, theirs[0] - theirs[1]],
                 [f"C_redevelop, {block['name']}", "lines", lines, theirs[0]],
                 [f"degree of portability, {block['name']}", "1 - C_port / C_redevelop", degree_of(block), theirs[-1]]]
    rows.append(["equation 8, hours of a port", "Y = C prod 10^(beta alpha) X^beta", law_of_ports(take), "-"])
    section.table(["quantity", "formula", "here", "thesis"], rows)
    section.say("The project holds no copy of the thesis: which formula has which of its numbers is known of equation 8 alone "
                "(3.1.3). These are the quantities of its tables; docs/metrics.md has each formula in full, with its source.")


def add_other_machines(page, files):
    for file in files:
        try:
            with zipfile.ZipFile(file) as pack:
                found = json.loads(pack.read("self-test.json"))
        except (OSError, KeyError, ValueError, zipfile.BadZipFile) as problem:
            fail(f"{file}: is no file of --self-test ({problem})")
        section = page.section(f"Another machine: {found['devices'].get('source', '-')}")
        section.table(["series", "ms a frame", "million rays a second"],
                      [[name, number(bench["ms_per_frame"]["total"], 2), number(bench["mrays_per_s"]["total"], 2)]
                       for name, bench in found["series"].items()])
        section.say(f"Size {found['size']}; SSIM of the two cores there: " +
                    ", ".join(f"{spp}: {number(ssim, 6)}" for spp, ssim in found["ssim"].items()) + ".")


def generated(name, folder):
    """A scene that scenes/make_scenes.py writes."""
    file = folder / "scenes" / name / f"{name}.gltf"
    if not file.is_file():
        subprocess.run([sys.executable, str(ROOT / "scenes/make_scenes.py"), name, str(file.parent)], check=True)
    return Scene(name, str(file), ours=True)


def unlike(name, taken):
    """That name, or the first of NAME_2, NAME_3, ... that nobody has."""
    names = [name, *(f"{name}_{i}" for i in range(2, len(taken) + 3))]
    return next(name for name in names if name not in taken)


def is_json(file):
    try:
        return isinstance(json.loads(pathlib.Path(file).read_text()), dict)
    except (OSError, ValueError):
        return False


def find_scenes(arguments, folder):
    """The scenes by rising size, and why others are left out."""
    scenes, left_out = [Scene("still_life", "still_life", ours=True)], []
    taken = {"still_life", "interior", "city", "pica", "kitchen"}
    for file in arguments.scene:
        name = unlike(pathlib.Path(file).stem, taken)
        taken.add(name)
        scenes.append(Scene(name, os.path.abspath(file)))
    if not arguments.quick:
        scenes += [generated(name, folder) for name in ("interior", "city")]
        for name in ("pica", "kitchen"):
            file = pathlib.Path(arguments.scenes) / name / "scene.gltf"
            scenes.append(Scene(name, str(file), ["--camera", file.with_name("camera.json")]))
    found = scenes[:1]
    for scene in scenes[1:]:
        file = os.path.relpath(scene.file, ROOT)
        if not os.path.isfile(scene.file):
            left_out.append(f"{scene.name}, there is no {file}")
        elif not is_json(scene.file):
            left_out.append(f"{scene.name}, since {file} is no .gltf file")
        else:
            found.append(scene)
    return found, left_out


def make_page(arguments, settings, take, folder):
    scenes, left_out = find_scenes(arguments, folder)
    page = Page("The thesis's tables and figures, measured anew")
    asked = [f"--{name} {getattr(arguments, name)}" for name in ("size", "samples") if getattr(arguments, name) is not None]
    page.lead(f"Made by `{' '.join(['bench/thesis.py', *['--quick'] * arguments.quick, *asked])}`; every number below is its own, "
              "but for those of the thesis.")
    now = kernel_digests()
    page.lead(age_line(now, now))
    found = [(scene, measure_pictures(take, scene, settings, folder / "pictures"),
              measure_speed(take, scene, settings, folder)) for scene in scenes]
    report = None
    if take.porttool is not None:
        report = take.take("report", [take.porttool, "report", "--format", "json"])
    for scene, pictures, series in found:
        if pictures is None or not series:
            left_out.append(f"parts of {scene.name}, which could not be rendered")
    add_machine(page, take, settings, left_out + take.failures, scenes)
    for scene, pictures, series in found:
        if pictures is not None:
            add_table1(page, scene, pictures)
            add_pictures(page, scene, settings["counts"], folder / "pictures")
        if series:
            add_speed(page, scene, series)
    add_table2(page, report)
    add_equations(page, report, scenes[0], found[0][1], take)
    add_other_machines(page, arguments.others)
    page.kernels = now
    return page, found


def pack_self_test(arguments, settings, take, found, file):
    info = take.take("info", [take.program, "info", "--format", "json"]) or {"cores": []}
    _, pictures, series = found[0]
    content = {"devices": {core["id"]: core.get("device") for core in info["cores"]}, "size": settings["size"],
               "series": series, "bias": pictures and pictures["bias"],
               "ssim": {spp: row["same"]["ssim"] for spp, row in (pictures or {"rows": {}})["rows"].items()}}
    unfinished = file.with_name(file.name + ".new")
    with zipfile.ZipFile(unfinished, "w", zipfile.ZIP_DEFLATED) as pack:
        pack.writestr("self-test.json", json.dumps(content, indent=1))
        for path in sorted((take.folder / "measured").iterdir()) + [take.folder / "thesis.md"]:
            pack.write(path, path.relative_to(take.folder).as_posix())
    unfinished.replace(file)
    print(f"send back: {file}")


def keep(folder, page, found):
    """The Markdown page and the pictures that it shows, somewhere else; without those of scenes that others made, which
    are not ours to pass on."""
    text = (folder / "thesis.md").read_text()
    for scene, _, _ in found:
        if not scene.ours:
            shown = re.compile(rf"(!\[[^]]*\]\(pictures/{re.escape(scene.name)}(_bias)?/.*\)\n+)+")
            text = shown.sub(f"{scene.name} is another author's: its pictures stay where this was measured.\n\n", text)
    for link in re.findall(r"^!\[[^]]*\]\(pictures/(.*)\)$", text, re.M):
        copy = page.parent / page.stem / link
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(folder / "pictures" / link, copy)
    page.write_text(text.replace("](pictures/", f"]({page.stem}/"))


def picture_size(text):
    if not re.fullmatch(r"[1-9]\d{0,4}x[1-9]\d{0,4}", text):
        raise argparse.ArgumentTypeError(f"'{text}' is no size; give WIDTHxHEIGHT in pixels, e.g. 320x180")
    return text


def sample_count(text):
    if not re.fullmatch(r"[1-9]\d{0,7}", text):
        raise argparse.ArgumentTypeError(f"'{text}' is no number of samples from 1 on")
    return int(text)


def read_options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("out/thesis"))
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--scene", action="append", default=[], help="one more scene, a .gltf file")
    parser.add_argument("--scenes", default=str(ROOT.parent / "shared/scenes"), help="folder of pica and kitchen")
    parser.add_argument("--size", type=picture_size, metavar="WxH", help="of the pictures (320x180; 64x36 with --quick)")
    parser.add_argument("--samples", type=sample_count, metavar="N", help="the most samples of a whole run (1024; 4 with --quick)")
    parser.add_argument("--program", default=str(ROOT / "build/release/bin/pathtracer"))
    parser.add_argument("--porttool", default=str(ROOT / "build/release/bin/porttool"))
    parser.add_argument("--self-test", type=pathlib.Path, metavar="FILE")
    parser.add_argument("--with", dest="others", nargs="+", type=pathlib.Path, default=[], metavar="FILE")
    parser.add_argument("--keep", type=pathlib.Path, metavar="PAGE")
    parser.add_argument("--age", type=pathlib.Path, metavar="PAGE")
    return parser.parse_args()


def main():
    arguments = read_options()
    if arguments.age is not None:
        update_age(arguments.age)
        return
    if not os.access(arguments.program, os.X_OK):
        fail(f"there is no program {arguments.program}; build it, or name it with --program")
    arguments.quick = arguments.quick or arguments.self_test is not None
    settings = QUICK if arguments.quick else FULL
    if arguments.self_test is not None:
        settings = {**settings, "size": "640x360"}
    if arguments.size is not None:
        settings = {**settings, "size": arguments.size}
    if arguments.samples is not None:
        settings = {**settings, "counts": [count for count in settings["counts"] if count <= arguments.samples] or [1],
                    "bias": max(16, min(settings["bias"], arguments.samples))}
    folder = arguments.output.resolve()
    porttool = arguments.porttool if os.access(arguments.porttool, os.X_OK) else None
    take = Measurements(folder, os.path.abspath(arguments.program), porttool)
    page, found = make_page(arguments, settings, take, folder)
    page.write(folder)
    print(folder / "thesis.html")
    if arguments.keep is not None:
        keep(folder, arguments.keep, found)
    if arguments.self_test is not None:
        pack_self_test(arguments, settings, take, found, arguments.self_test.resolve())


if __name__ == "__main__":
    main()
