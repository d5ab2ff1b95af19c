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
    bench/thesis.py --code PAGE       also counts Table 2, Figure 16 and the equations of costs anew, of the code as it is

DIR/thesis.html is one file, DIR/thesis.md has its pictures in DIR/pictures. Every number of theirs is in DIR/measured,
with the command that gave it; a measurement is taken again only where its command, its scene, a kernel or one of the pictures
that it read and wrote changed, and what is read from the code where any text of a core did.
"""
import argparse
import fcntl
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import thesis_pack  # noqa: E402
import thesis_sections as sections  # noqa: E402
from thesis_measure import (  # noqa: E402
    ROOT, Measurements, Scene, file_digest, kernel_digests, measure_pictures, measure_speed)
from thesis_page import Page, markdown_of_section, write_charts  # noqa: E402

# `most`: samples a pixel; Table 1 has the powers of four up to it.
QUICK = {"size": "64x36", "most": 4, "bias": 16, "frames": 2}
FULL = {"size": "320x180", "most": 1024, "bias": 256, "frames": 9}


def fail(message):
    print(f"thesis.py: {message}", file=sys.stderr)
    sys.exit(2)


def replace_text(file, text):
    """The file is the old one or the new one, whatever happens meanwhile."""
    file = file.resolve()
    unfinished = file.with_name(file.name + ".new")
    try:
        unfinished.write_text(text)
        if file.exists():
            shutil.copymode(file, unfinished)
        unfinished.replace(file)
    except OSError as problem:
        unfinished.unlink(missing_ok=True)
        fail(f"{file}: {problem.strerror}; name another place, or make room")


# --- The age of a page ---


def age_line(then, now):
    changed = [file for file in sorted(then.keys() | now.keys()) if then.get(file) != now.get(file)]
    return f"{len(changed)} of {len(now)} kernel files changed since these numbers were taken."


AGE = re.compile(r"^\d+ of \d+ kernel files changed since these numbers were taken\.$", re.M)


def update_age(page):
    try:
        text = page.read_text()
    except (OSError, UnicodeDecodeError) as error:
        fail(f"{page}: {getattr(error, 'strerror', None) or 'is no text'}; name a page that --keep wrote")
    then = dict(re.findall(r"^<!-- kernel (\S+) ([0-9a-f]{12}) -->$", text, re.M))
    if not then or not AGE.search(text):
        fail(f"{page} was not made by this program")
    line = age_line(then, kernel_digests())
    replace_text(page, AGE.sub(line, text))
    print(line)


def update_code(page_file, porttool):
    """Counts anew, in a page that --keep wrote, what is read from the code alone: Table 2, Figure 16 and the equations of
    costs. The rest stays, with its age."""
    update_age(page_file)
    text = page_file.read_text()
    page, pictures = Page(""), page_file.parent / page_file.stem
    with tempfile.TemporaryDirectory() as name:
        take = Measurements(pathlib.Path(name), None, porttool)
        report = take.report()
        if report is None:
            fail(f"--code {page_file}: {'; '.join(take.failures) or 'there is no porttool; build it, or name it with --porttool'}")
        sections.add_table2(page, report, pictures / "charts")
        sections.add_cost_equations(page, report, take)
    for section in page.sections:
        found = re.search(rf"^## {re.escape(section.title)}$.*?(?=^## |^<!-- kernel )", text, re.M | re.S)
        if found is None:
            fail(f"{page_file} has no section '{section.title}'; make it anew with --keep")
        write_charts(section)
        text = text[:found.start()] + "\n".join(markdown_of_section(section, page_file.parent)) + "\n" + text[found.end():]
    replace_text(page_file, text)


# --- The page ---


MAKER = ROOT / "scenes/make_scenes.py"


def contents(folder):
    return {file.relative_to(folder).as_posix(): file_digest(file) for file in sorted(folder.rglob("*")) if file.is_file()}


def generated(name, folder):
    """A scene that scenes/make_scenes.py writes, and why there is none, if so. It lies beside a list of its files and of
    their digests, and is made anew where these do not agree."""
    scenes, maker = folder / "scenes", file_digest(MAKER)
    made, listed = scenes / name, scenes / f"{name}.json"
    scene = Scene(name, str(made / f"{name}.gltf"), ours=True)
    try:
        if json.loads(listed.read_text()) == {"maker": maker, "files": contents(made)}:
            return scene, ""
    except (OSError, ValueError, RecursionError):
        pass  # not made yet, or not to the end
    scenes.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=scenes) as unfinished:
        new = pathlib.Path(unfinished) / name
        done = subprocess.run([sys.executable, str(MAKER), name, str(new)], capture_output=True, text=True, check=False)
        if done.returncode:
            return scene, f"{MAKER.name}: {' '.join(done.stderr.split()[-40:])}"
        shutil.rmtree(made, ignore_errors=True)
        new.replace(made)
    listed.write_text(json.dumps({"maker": maker, "files": contents(made)}))
    return scene, ""


def unlike(name, taken):
    """That name, or the first of NAME_2, NAME_3, ... that nobody has."""
    names = [name, *(f"{name}_{i}" for i in range(2, len(taken) + 3))]
    return next(name for name in names if name not in taken)


DEEPEST = 200  # objects and arrays within each other, far below where Python's own reader and writer give up


def depth(value):
    levels, level = 0, [value]
    while level and levels <= DEEPEST:
        level = [child for item in level if isinstance(item, (dict, list))
                 for child in (item.values() if isinstance(item, dict) else item)]
        levels += 1
    return levels


def all_of(kind, items):
    return isinstance(items, list) and all(isinstance(item, kind) for item in items)


def is_gltf(file):
    """Whether it is JSON in the shape that is read here; whether it is a scene, the program says."""
    try:
        gltf = json.loads(pathlib.Path(file).read_text())
    except (OSError, ValueError, RecursionError):
        return False
    return (isinstance(gltf, dict) and depth(gltf) <= DEEPEST and all_of(str, gltf.get("extensionsUsed", [])) and
            all(all_of(dict, gltf.get(key, [])) for key in ("buffers", "images", "materials")) and
            all(isinstance(material.get(key, {}), dict) for material in gltf.get("materials", [])
                for key in ("pbrMetallicRoughness", "extensions")))


def find_scenes(arguments, folder):
    """The scenes by rising size, and why others are left out."""
    scenes, left_out = [Scene("still_life", "still_life", ours=True)], []
    taken = {"still_life", "interior", "city", "pica", "kitchen"}
    for file in arguments.scene:
        name = unlike(re.sub(r"[^\w.-]", "_", pathlib.Path(file).stem), taken)  # it becomes part of links
        taken.add(name)
        scenes.append(Scene(name, os.path.abspath(file)))
    if not arguments.quick:
        for name in ("interior", "city"):
            scene, problem = generated(name, folder)
            if problem:
                left_out.append(f"{name}, {problem}")
            else:
                scenes.append(scene)
        for name in ("pica", "kitchen"):
            file = pathlib.Path(os.path.abspath(arguments.scenes)) / name / "scene.gltf"
            scenes.append(Scene(name, str(file), ["--camera", file.with_name("camera.json")]))
    found = scenes[:1]
    for scene in scenes[1:]:
        file = os.path.relpath(scene.file, ROOT)
        if not os.path.isfile(scene.file):
            left_out.append(f"{scene.name}, there is no {file}")
        elif not is_gltf(scene.file):
            left_out.append(f"{scene.name}, since {file} is no .gltf file")
        else:
            found.append(scene)
    return found, left_out


def make_page(arguments, settings, take, folder, machines):
    scenes, left_out = find_scenes(arguments, folder)
    page = Page("The thesis's tables and figures, measured anew")
    asked = [f"--{name} {getattr(arguments, name)}" for name in ("size", "samples") if getattr(arguments, name) is not None]
    page.lead(f"Made by `{' '.join(['bench/thesis.py', *['--quick'] * arguments.quick, *asked])}`; every number below is its own, "
              "but for those of the thesis.")
    now = kernel_digests()
    page.lead(age_line(now, now))
    found = [(scene, measure_pictures(take, scene, settings, folder / "pictures"),
              measure_speed(take, scene, settings, folder)) for scene in scenes]
    report = take.report()
    charts = folder / "pictures/charts"
    for scene, pictures, series in found:
        if pictures is None or not series:
            left_out.append(f"parts of {scene.name}, which could not be rendered")
    if take.porttool is None:
        left_out.append("what is read from the code, as there is no porttool; build it, or name it with --porttool")
    left_out += take.failures
    for reason in left_out:
        print(f"thesis.py: left out: {reason}", file=sys.stderr)
    sections.add_machine(page, take, settings, left_out, scenes)
    for scene, pictures, series in found:
        if pictures is not None:
            sections.add_table1(page, scene, pictures)
            sections.add_pictures(page, scene, settings["counts"], folder / "pictures")
        if series:
            sections.add_speed(page, scene, series, charts)
    sections.add_picture_equations(page, scenes[0], found[0][1])
    sections.add_table2(page, report, charts)
    sections.add_cost_equations(page, report, take)
    sections.add_other_machines(page, machines)
    page.kernels = now
    return page, found


def pack_self_test(arguments, settings, take, found, file):
    info = take.take("info", [take.program, "info", "--format", "json"]) or {"cores": []}
    _, pictures, series = found[0]
    content = {"devices": {core["id"]: core.get("device") for core in info["cores"]}, "size": settings["size"],
               "series": series, "bias": pictures and pictures["bias"],
               "ssim": {spp: row["same"]["ssim"] for spp, row in (pictures or {"rows": {}})["rows"].items()}}
    thesis_pack.write_pack(file, content, take.folder, [*sorted((take.folder / "measured").iterdir()), take.folder / "thesis.md"])
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
    replace_text(page, text.replace("](pictures/", f"]({page.stem}/"))


def picture_size(text):
    if not re.fullmatch(r"[1-9]\d{0,4}x[1-9]\d{0,4}", text):
        raise argparse.ArgumentTypeError(f"'{text}' is no size; give WIDTHxHEIGHT in pixels, e.g. 320x180")
    return text


def sample_count(text):
    if not re.fullmatch(r"[1-9]\d{0,7}", text):
        raise argparse.ArgumentTypeError(f"'{text}' is no number of samples from 1 on")
    return int(text)


def name_of_file(text):
    if not text:
        raise argparse.ArgumentTypeError("the name is empty; give one")
    return pathlib.Path(text)


def name_of_page(text):
    file = name_of_file(text)
    if file.suffix != ".md":
        raise argparse.ArgumentTypeError(f"{text}: a page ends in .md, and its pictures go into a folder of that name without it")
    return file


def read_options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.error = fail
    parser.add_argument("-o", "--output", type=name_of_file, default=pathlib.Path("out/thesis"))
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--scene", action="append", type=name_of_file, default=[], help="one more scene, a .gltf file")
    parser.add_argument("--scenes", default=str(ROOT.parent / "shared/scenes"), help="folder of pica and kitchen")
    parser.add_argument("--size", type=picture_size, metavar="WxH", help="of the pictures (320x180; 64x36 with --quick)")
    parser.add_argument("--samples", type=sample_count, metavar="N",
                        help="the most samples a pixel, taken in powers of four (1024; 4 with --quick)")
    parser.add_argument("--program", type=name_of_file, default=ROOT / "build/release/bin/pathtracer")
    parser.add_argument("--porttool", type=name_of_file, help="left out where there is none (build/release/bin/porttool)")
    parser.add_argument("--self-test", type=name_of_file, metavar="FILE")
    parser.add_argument("--with", dest="others", nargs="+", type=name_of_file, default=[], metavar="FILE")
    parser.add_argument("--keep", type=name_of_page, metavar="PAGE")
    parser.add_argument("--age", type=name_of_file, metavar="PAGE")
    parser.add_argument("--code", type=name_of_file, metavar="PAGE")
    return parser.parse_args()


def settings_of(arguments):
    """Size, counts of samples and frames of the run that is asked for."""
    settings = QUICK if arguments.quick else FULL
    if arguments.self_test is not None:
        settings = {**settings, "size": "640x360"}
    if arguments.size is not None:
        settings = {**settings, "size": arguments.size}
    most = settings["most"]
    if arguments.samples is not None:
        most = arguments.samples
        settings = {**settings, "bias": max(16, min(settings["bias"], most))}
    return {**settings, "counts": [4 ** i for i in range(most.bit_length()) if 4 ** i <= most]}


def lock_of(folder):
    """A lock on the folder, as a descriptor: of one run, and of what it started as long as that goes on without it."""
    lock = os.open(folder / "busy", os.O_CREAT | os.O_RDWR, 0o644)
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        fail(f"{folder}: another run works there, or what it started; wait for its end, or name another folder with -o")
    return lock


def is_program(file):
    return file.is_file() and os.access(file, os.X_OK)


def porttool_of(arguments):
    """The program; None where nobody named one and it is not built."""
    if arguments.porttool is not None and not is_program(arguments.porttool):
        fail(f"there is no program {arguments.porttool}; build it, or leave --porttool out")
    file = arguments.porttool or ROOT / "build/release/bin/porttool"
    return os.path.abspath(file) if is_program(file) else None


def main():
    arguments = read_options()
    if arguments.age is not None:
        update_age(arguments.age)
        return
    porttool = porttool_of(arguments)
    if arguments.code is not None:
        update_code(arguments.code, porttool)
        return
    if not is_program(arguments.program):
        fail(f"there is no program {arguments.program}; build it, or name it with --program")
    arguments.quick = arguments.quick or arguments.self_test is not None
    settings = settings_of(arguments)
    for file in filter(None, (arguments.self_test, arguments.keep)):
        if file.exists() and not file.is_file():  # it would be replaced, be it a device
            fail(f"{file}: is a folder, a pipe or a device; name a file")
        if not os.access(file.resolve().parent, os.W_OK):
            fail(f"{file}: nothing can be written to that folder; make it, or name another")
    try:
        machines = [thesis_pack.machine_of(thesis_pack.read_pack(file)) for file in arguments.others]
    except thesis_pack.NoSelfTest as problem:
        fail(problem)
    folder = arguments.output.resolve()
    take = Measurements(folder, os.path.abspath(arguments.program), porttool)
    take.inherited = (lock_of(folder),)
    page, found = make_page(arguments, settings, take, folder, machines)
    page.write(folder)
    print(folder / "thesis.html")
    if arguments.keep is not None:
        keep(folder, arguments.keep, found)
    if not any(pictures or series for _, pictures, series in found):
        print("thesis.py: nothing could be measured", file=sys.stderr)
        sys.exit(1)
    if arguments.self_test is not None:
        pack_self_test(arguments, settings, take, found, arguments.self_test.resolve())


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        print("thesis.py: stopped; the same command goes on from here", file=sys.stderr)
        sys.exit(130)
    except OSError as problem:
        place = f"{problem.filename}: " if problem.filename else ""  # a full disk has no name
        fail(f"{place}{problem.strerror}; name another place, or make room")
