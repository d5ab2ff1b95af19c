#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""The Khronos sample models as the target core draws them, beside what other path tracers made of them.

    bench/fidelity.py --models DIR --goldens DIR --skies DIR --config FILE [-o DIR] [NAME...] [--spp 16]
                      [--filter spatial|none] [--max-path-length 16] [--threads N] [--pathtracer build/release/bin/pathtracer]

--goldens is `public/thumbnails/goldens` of KhronosGroup/glTF-Render-Fidelity; --config is `test/config.json` of
glTF-Render-Fidelity-Generator, which has each picture's camera, size and sky; --skies holds its `environments`; --models
holds the models anywhere below it (KhronosGroup/glTF-Sample-Assets, or what one has of them). Nothing is downloaded; what is
not there is left out, and a line says what. NAMEs are scenarios, as `ToyCar`.

Writes DIR/fidelity.html, all pictures side by side, DIR/fidelity.json and DIR/NAME/, and prints a table as Markdown. Ours is
rendered twice as wide and high and made smaller after the curve, as the reference was (pictures.py has the curve); where the
reference shows no sky it is cut out by three more renders of one segment. Ours is filtered, since noise would be most of what
is measured; what stands apart is worth a look with --filter none and more samples, since a filter smooths what it cannot tell
from noise, such as patterns of sheen.

Distances are those of the pictures at half their size, where it no longer shows by what filter the references were made
smaller: the RMSE of levels from 0 to 255 where both are covered whole, and SSIM over white wherever one of them is. A model
stands apart where ours is further from the path tracers, on average, than the one of them that is furthest from the others;
with one path tracer alone there is nothing to tell.

Needs `apt-get install python3-numpy webp`. A picture that is in DIR already is not rendered again.
"""
import argparse
import html
import json
import math
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import urllib.parse

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from compare_renderers import at_least, fail  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
PATH_TRACERS = {"blender-cycles": "Cycles", "vray": "V-Ray", "three-gpu-pathtracer": "three-gpu", "stellar": "Stellar",
                "dspbr-pt": "dspbr"}
OURS = "ours"
# What the generator takes where a scenario does not say (its src/config-reader.ts).
DEFAULTS = {"lighting": "lightroom_14b.hdr", "dimensions": {"width": 768, "height": 768}, "target": {"x": 0, "y": 0, "z": 0},
            "orbit": {"theta": 0, "phi": 90, "radius": 1}, "verticalFoV": 45, "renderSkybox": False}
COVERED = 0.99


class Missing(Exception):
    """What a model lacks to be compared."""


# What is asked for and where it lies.


def scenarios(options):
    try:
        found = json.loads(options.config.read_text(encoding="utf-8"))["scenarios"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        fail(f"{options.config} is no config.json of the generator: {error}")
    known = {}
    for scenario in found:
        whole = {key: {**value, **scenario.get(key, {})} if isinstance(value, dict) else scenario.get(key, value)
                 for key, value in DEFAULTS.items()}
        known[scenario["name"].removeprefix("khronos-")] = whole | {"name": scenario["name"], "model": scenario["model"]}
    unknown = [name for name in options.names if name not in known]
    if unknown:
        fail(f"{options.config} has no scenario {', '.join(unknown)}")
    return {name: known[name] for name in options.names or known}


def files_of(model):
    """The files beside `model` that it names, or None if it is no glTF 2.0."""
    data = model.read_bytes()
    try:
        if data[:4] == b"glTF":
            data = data[20:20 + struct.unpack_from("<I", data, 12)[0]]
        root = json.loads(data)
        entries = root.get("buffers", []) + root.get("images", [])
        if not root["asset"]["version"].startswith("2"):
            return None
    except (ValueError, KeyError, TypeError, struct.error):
        return None
    uris = [entry["uri"] for entry in entries if not entry.get("uri", "data:").startswith("data:")]
    return [model.parent / urllib.parse.unquote(uri) for uri in uris]


def find_model(options, scenario):
    """The file that the scenario names, else another form of the same model that is there whole."""
    wanted = pathlib.PurePosixPath(scenario["model"])
    form = wanted.parent.name
    same = [path for path in options.known_models if path.stem == wanted.stem]
    lacks = "no file of the model"
    for path in sorted(same, key=lambda path: (path.parent.name != form, path.parent.name != "glTF-Binary", str(path))):
        beside = files_of(path)
        if beside is None:
            continue
        gone = [file.name for file in beside if not file.is_file()]
        if not gone:
            return path
        lacks = f"{path.name} lacks {gone[0]}"
    raise Missing(lacks)


def find_sky(options, scenario):
    """The sky turned by a quarter: the reference looks along -z at a quarter of the picture's width, ours at its middle."""
    name = pathlib.PurePosixPath(scenario["lighting"]).name
    turned = options.output / "skies" / name
    if not turned.is_file():
        source = options.skies / name
        if not source.is_file():
            raise Missing(f"no sky {name}")
        pixels = pictures.read_radiance(source)
        turned.parent.mkdir(parents=True, exist_ok=True)
        pictures.write_radiance(turned, numpy.roll(pixels, pixels.shape[1] // 4, axis=1))
    return turned


def goldens_of(options, scenario):
    folder = options.goldens / scenario["name"]
    found = {label: pictures.read_webp(folder / f"{name}-golden.thumb.webp") for name, label in PATH_TRACERS.items()
             if (folder / f"{name}-golden.thumb.webp").is_file()}
    if not found:
        raise Missing("no picture of a path tracer")
    return found


# Rendering.


def look_at(scenario):
    orbit, target = scenario["orbit"], [scenario["target"][axis] for axis in "xyz"]
    phi, theta = math.radians(orbit["phi"]), math.radians(orbit["theta"])
    back = [math.sin(phi) * math.sin(theta), math.cos(phi), math.sin(phi) * math.cos(theta)]
    eye = [t + orbit["radius"] * b for t, b in zip(target, back)]
    # From within the target the camera looks as it would from without.
    seen = target if orbit["radius"] > 0 else [t - b for t, b in zip(target, back)]
    return ",".join(f"{value:.9g}" for value in eye + seen)


def render(options, job, file, *extra):
    if not file.is_file():
        command = [options.pathtracer, "render", job["model"], "--core", "target", "--quiet", "--spp", str(options.spp),
                   "--size", "{}x{}".format(*job["size"]), f"--look-at={job['look_at']}", "--fov", str(job["fov"]),
                   "--allow-outside", "-o", file, *extra]
        if options.threads:
            command += ["--threads", str(options.threads)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise Missing(f"exit {done.returncode}: " + " ".join((done.stderr.strip().splitlines() or ["no message"])[-1:]))
    return pictures.read_exr(file)


def ours(options, scenario, model, sky, shape):
    """Our picture with alpha, twice as wide and high as the reference. One segment shows sky and emitters alone: what white,
    black and the real sky make there tells how much of a pixel lies open and what shines through it."""
    folder = options.output / scenario["name"].removeprefix("khronos-")
    folder.mkdir(parents=True, exist_ok=True)
    job = {"model": model, "size": (2 * shape[1], 2 * shape[0]), "look_at": look_at(scenario), "fov": scenario["verticalFoV"]}
    light = render(options, job, folder / "light.exr", "--sky", sky, "--max-path-length", str(options.max_path_length),
                   "--filter", options.filter)
    if scenario["renderSkybox"]:
        return numpy.dstack([pictures.aces_levels(light), numpy.ones(light.shape[:2])])
    one = ("--max-path-length", "1")
    black = render(options, job, folder / "black.exr", "--sky", "0,0,0", *one)
    white = render(options, job, folder / "white.exr", "--sky", "1,1,1", *one)
    behind = render(options, job, folder / "behind.exr", "--sky", sky, *one) - black
    alpha = numpy.clip(1 - (white - black).mean(axis=-1), 0, 1)
    # A hundredth of a pixel is too little to tell the colour from the noise of what lies behind.
    front = numpy.where(alpha[..., None] > 0.01, (light - behind) / numpy.maximum(alpha, 0.01)[..., None], 0)
    return numpy.dstack([pictures.aces_levels(front), alpha])


# Measuring.


def distances(drawn):
    """Of each pair, at half the size: RMSE where both are covered whole, and SSIM over white wherever one of them is."""
    found = {}
    names = list(drawn)
    drawn = {name: pictures.halved(picture) for name, picture in drawn.items()}
    shown = {name: pictures.over_white(picture) for name, picture in drawn.items()}
    for i, a in enumerate(names):
        for b in names[i + 1:]:
            alphas = drawn[a][..., 3], drawn[b][..., 3]
            found[a, b] = found[b, a] = {
                "rmse": pictures.rmse(drawn[a][..., :3], drawn[b][..., :3], numpy.minimum(*alphas) >= COVERED),
                "ssim": pictures.ssim(shown[a], shown[b], numpy.maximum(*alphas) > 1 - COVERED)}
    return found


def verdict(found, names, measure):
    """How far ours is from the path tracers on average, and the one of them that is furthest from the rest."""
    def far(name):
        values = [found[name, other][measure] for other in names if other != name]
        values = [1 - value if measure == "ssim" else value for value in values if not math.isnan(value)]
        return sum(values) / len(values) if values else float("nan")

    theirs = [far(name) for name in names] if len(names) > 1 else []
    return {"ours": far(OURS), "theirs": max((value for value in theirs if not math.isnan(value)), default=float("nan"))}


def compare(options, name, scenario):
    goldens = goldens_of(options, scenario)
    shape = next(iter(goldens.values())).shape
    goldens = {label: picture for label, picture in goldens.items() if picture.shape == shape}
    model, sky = find_model(options, scenario), find_sky(options, scenario)
    drawn = {OURS: pictures.halved(ours(options, scenario, model, sky, shape)), **goldens}
    for label, picture in drawn.items():
        pictures.write_png(options.output / name / f"{label}.png", pictures.over_white(picture))
    found = distances(drawn)
    result = {"model": str(model.relative_to(options.models)), "path_tracers": list(goldens),
              "pairs": {f"{a} {b}": values for (a, b), values in found.items() if list(drawn).index(a) < list(drawn).index(b)}}
    for measure in ("rmse", "ssim"):
        result[measure] = verdict(found, list(goldens), measure)
    result["apart"] = [m for m in ("rmse", "ssim") if result[m]["ours"] > result[m]["theirs"]]
    return result


# Telling.


def number(value, places):
    return "-" if math.isnan(value) else f"{value:.{places}f}"


HEAD = ("| model | path tracers | RMSE of ours | of theirs, at most | 1 - SSIM of ours | of theirs, at most | apart |\n"
        "| --- | --- | --- | --- | --- | --- | --- |")


def row(name, result):
    numbers = [number(result[measure][who], places) for measure, places in (("rmse", 1), ("ssim", 3)) for who in ("ours", "theirs")]
    apart = ", ".join(result["apart"]) or ("-" if len(result["path_tracers"]) < 2 else "no")
    return f"| {name} | {', '.join(result['path_tracers'])} | {' | '.join(numbers)} | {apart} |"


def write_sheet(options, results):
    rows = []
    for name, result in results.items():
        cells = "".join(f'<figure><img src="{urllib.parse.quote(name)}/{urllib.parse.quote(label)}.png" loading="lazy">'
                        f"<figcaption>{html.escape(label)}{pair_text(result, label)}</figcaption></figure>"
                        for label in [OURS, *result["path_tracers"]])
        mark = f" stands apart by {', '.join(result['apart'])}" if result["apart"] else ""
        rows.append(f"<h2>{html.escape(name)}</h2><p>{html.escape(result['model'])}{mark}</p><div>{cells}</div>")
    (options.output / "fidelity.html").write_text(
        "<!doctype html><meta charset=utf-8><title>Fidelity</title><style>body{font:14px sans-serif}div{display:flex;flex-wrap:wrap}"
        "figure{margin:2px}img{width:256px;border:1px solid #ccc}</style>" + "\n".join(rows), encoding="utf-8")
    (options.output / "fidelity.json").write_text(json.dumps(results, indent=1), encoding="utf-8")


def pair_text(result, label):
    pair = result["pairs"].get(f"{OURS} {label}")
    return f" {number(pair['rmse'], 1)} / {number(1 - pair['ssim'], 3)}" if pair else ""


def read_options():
    parser = argparse.ArgumentParser(description="The Khronos sample models, beside what other path tracers made of them.")
    for name in ("models", "goldens", "skies", "config"):
        parser.add_argument(f"--{name}", type=pathlib.Path, required=True)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("-o", dest="output", type=pathlib.Path, default=pathlib.Path("fidelity"))
    parser.add_argument("--spp", type=at_least(1), default=16)
    parser.add_argument("--filter", choices=["spatial", "none"], default="spatial")
    parser.add_argument("--threads", type=at_least(1))
    parser.add_argument("--max-path-length", type=at_least(1), default=16)
    parser.add_argument("--pathtracer", default=str(ROOT / "build/release/bin/pathtracer"))
    options = parser.parse_args()
    for folder in (options.models, options.goldens, options.skies):
        if not folder.is_dir():
            fail(f"{folder} is no folder")
    if shutil.which("dwebp") is None:
        fail("there is no dwebp: apt-get install webp")
    if shutil.which(options.pathtracer) is None:
        fail(f"{options.pathtracer} is no program; build it or give --pathtracer")
    options.known_models = [pathlib.Path(folder) / file for folder, _, files in os.walk(options.models) for file in files
                            if file.endswith((".glb", ".gltf"))]
    return options


def main():
    options = read_options()
    options.output.mkdir(parents=True, exist_ok=True)
    wanted, results, left_out = scenarios(options), {}, []
    print(HEAD, flush=True)
    for name, scenario in wanted.items():
        try:
            results[name] = compare(options, name, scenario)
            print(row(name, results[name]), flush=True)
        except (Missing, ValueError) as error:
            left_out.append(f"without {name}: {error}")
    print("\n".join(["", *left_out]))
    write_sheet(options, results)
    if not results:
        fail("nothing was compared")


if __name__ == "__main__":
    try:
        import numpy
        import pictures
    except ImportError:
        fail("there is no numpy for this Python: apt-get install python3-numpy, and start it with /usr/bin/python3")
    main()
