# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""The file that bench/thesis.py --self-test writes on one machine and --with reads on another, where it is a stranger's."""
import json
import os
import re
import zipfile
import zlib

from thesis_sections import BLOCKS, number, time_shares

CONTENT = "self-test.json"
LARGEST = 1 << 24  # bytes of its content; what --self-test wrote has thousands
LONGEST = 200  # characters of a device's or a series' name
MOST = 16  # series, sample counts and devices; --self-test writes four, two and two
GREATEST = 1e9  # milliseconds of a frame (eleven days), and million rays a second
OVERLAP = 1.5  # blocks of a frame together, over the frame: clocks of a GPU and its host differ, but not by that


class NoSelfTest(Exception):
    """A file that --self-test did not write."""


def write_pack(file, content, folder, members):
    """`members` lie in `folder`; the file is whole or not there."""
    unfinished = file.with_name(file.name + ".new")
    with zipfile.ZipFile(unfinished, "w", zipfile.ZIP_DEFLATED) as pack:
        pack.writestr(CONTENT, json.dumps(content, indent=1))
        for path in members:
            pack.write(path, path.relative_to(folder).as_posix())
    unfinished.replace(file)


def read_pack(file):
    """What write_pack was given as `content`, once everything in it that a page shows can be true."""
    try:
        if not os.path.isfile(file):
            raise ValueError("there is no such file")
        with zipfile.ZipFile(file) as pack:
            if pack.getinfo(CONTENT).file_size > LARGEST:
                raise ValueError(f"its {CONTENT} is too large")
            return checked(json.loads(pack.read(CONTENT)))
    except (OSError, LookupError, ValueError, EOFError, RuntimeError, NotImplementedError, zlib.error, zipfile.BadZipFile) as problem:
        # A RuntimeError: JSON too deep, or a pack with a password.
        raise NoSelfTest(f"{file}: is no file of --self-test ({' '.join(str(problem).split())})") from problem


# --- What can be true ---


def checked(content):
    found = an_object(content, "its content")
    for name in ("devices", "size", "series", "bias", "ssim"):
        if name not in found:
            raise ValueError(f"it has no '{name}'")
    size = found["size"]
    if not isinstance(size, str) or not re.fullmatch(r"[1-9]\d{0,4}x[1-9]\d{0,4}", size):
        raise ValueError(f"size is {shown(size)}, not such as 640x360")
    return {"size": size,
            "devices": {label(core, "a core"): device if device is None else label(device, "a device")
                        for core, device in few(found["devices"], "devices")},
            "series": {label(name, "a series"): checked_bench(name, bench) for name, bench in few(found["series"], "series")},
            "ssim": dict(checked_ssim(spp, value) for spp, value in few(found["ssim"], "ssim")),
            "bias": None if found["bias"] is None else checked_bias(found["bias"])}


def checked_bench(name, bench):
    at = f"series {shown(name)}"
    parts = an_object(an_object(bench, at).get("ms_per_frame"), f"{at}, ms_per_frame")
    rays = an_object(bench.get("mrays_per_s"), f"{at}, mrays_per_s")
    ms = {part: quantity(parts.get(part), f"{at}, ms_per_frame.{part}", 0, GREATEST) for part in ("total", *BLOCKS)}
    if not ms["total"] >= 1 / GREATEST:
        raise ValueError(f"{at}, ms_per_frame.total is {shown(ms['total'])}: no frame takes no time")
    if sum(ms[block] for block in BLOCKS) > OVERLAP * ms["total"]:
        raise ValueError(f"{at}: the blocks of a frame take longer than the frame")
    return {"ms_per_frame": ms,
            "mrays_per_s": {kind: known(rays.get(kind), f"{at}, mrays_per_s.{kind}", 0, GREATEST) for kind in ("total", "trace")}}


def checked_ssim(spp, value):
    if not re.fullmatch(r"[1-9]\d{0,7}", spp):
        raise ValueError(f"ssim has {shown(spp)} where a number of samples should stand")
    return spp, known(value, f"ssim of {spp} samples", -1, 1)


def checked_bias(bias):
    verdict = an_object(bias, "bias").get("verdict")
    if verdict not in ("agree", "differ", "too_few"):
        raise ValueError(f"bias, verdict is {shown(verdict)}: agree, differ or too_few")
    return {"verdict": verdict, "p_value": quantity(bias.get("p_value"), "bias, p_value", 0, 1)}


def an_object(value, what):
    if not isinstance(value, dict):
        raise ValueError(f"{what} is {shown(value)}, not an object of names and values")
    return value


def few(value, what):
    if len(an_object(value, what)) > MOST:
        raise ValueError(f"{what} has {len(value)} names; at most {MOST} are read")
    return value.items()


def quantity(value, what, low, high):
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not low <= value <= high:
        raise ValueError(f"{what} is {shown(value)}, not a number from {low:g} to {high:g}")
    return float(value)


def known(value, what, low, high):
    """The same of what may be unknown (null)."""
    return None if value is None else quantity(value, what, low, high)


def label(value, what):
    """One line of text that shows on any screen as it is."""
    if not isinstance(value, str) or len(value) > LONGEST:
        raise ValueError(f"{what} is {shown(value)}, not a text of at most {LONGEST} characters")
    return "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in " ".join(value.split()))


def shown(value):
    text = ascii(value) if isinstance(value, (str, int, float, type(None))) else type(value).__name__
    return text if len(text) <= 40 else text[:37] + "..."


# --- The section of a page ---


def machine_of(content):
    """The title, the rows and the words of a section about the machine that wrote a pack."""
    devices, bias = content["devices"], content["bias"]
    rows = [[name, number(1000 / bench["ms_per_frame"]["total"], 2), number(bench["ms_per_frame"]["total"], 2),
             number(bench["mrays_per_s"]["total"], 2), number(bench["mrays_per_s"]["trace"], 2), number(time_shares(bench)[-1], 1)]
            for name, bench in content["series"].items()]
    ssim = ", ".join(f"{spp}: {number(value, 6)}" for spp, value in content["ssim"].items())
    words = (f"Size {content['size']}; the target core on {devices.get('target') or '-'}. SSIM of the two cores there, samples and "
             f"figure: {ssim or '-'}." +
             (f" With seeds of their own: {bias['verdict']}, p = {bias['p_value']:.2g}." if bias else ""))
    return f"Another machine: {devices.get('source') or '-'}", rows, words
