#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""One text in place of two, for one BSDF: source_core/kernels/bsdf.glsl compiled as C++ through target_core/device/glsl.h.

In a copy of the target core bsdf.h becomes a wrapper that includes the GLSL file; the kernel that uses it (shade.cpp, one
lane: --exact) is compiled with the build's own command and linked in front of the library into a module, which the program
takes by PATHTRACER_MODULES. Then: lines, bits (the same picture?), machine code, time, which file a debugger shows, and what
spirv-cross makes of the kernel. Needs a built build/release.
"""
import argparse
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import tomllib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from compare_renderers import at_least, fail  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
MODULE = "lib/porttool/pathtracer-core-target.so"
WRAPPER = """// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "target_core/kernels/material.h"
#include "target_core/kernels/random.h"

#define MATERIAL_GLSL  // what bsdf.glsl includes is here already
#define RANDOM_GLSL
namespace target_core::kernels {
namespace {  // GLSL knows no inline
#include "%s"
}  // namespace
}  // namespace target_core::kernels
"""


def run(command, **more):
    return subprocess.run(command, capture_output=True, text=True, check=True, **more).stdout


def compile_command(build, name):
    """The words of the build's own command for that file of the target core, from the compiler on."""
    file = build / "compile_commands.json"
    try:
        entry = next(c for c in json.loads(file.read_text()) if c["file"].endswith(f"target_core/{name}"))
        words = shlex.split(entry["command"])
        return words[words.index(next(w for w in words if w.endswith("c++"))):]
    except OSError as problem:
        fail(f"{file}: {problem.strerror}; configure that build, or name another with --build")
    except (ValueError, LookupError, TypeError, AttributeError, StopIteration):
        fail(f"{file} has no command that compiles target_core/{name}; configure that build anew")


def need_programs(*programs):
    for program in programs:
        if not shutil.which(program):
            fail(f"there is no program {program}; install or build it")


def fail_of_command(problem):
    """One line about a command that failed: the last that it said."""
    said = ((problem.stderr or "") + (problem.stdout or "")).strip().splitlines()
    command = problem.cmd if isinstance(problem.cmd, str) else shlex.join(map(str, problem.cmd))
    fail(f"{command[:200]}: {said[-1] if said else f'exit code {problem.returncode}'}")


def code_lines(text):
    return sum(1 for line in text.splitlines() if line.strip() and not line.strip().startswith("//"))


def compile_shade(arguments, folder, one_text, *options):
    """A copy of the tree, whose shade.cpp was compiled into shade.o beside it."""
    tree = folder / ("one" if one_text else "two")
    tree.mkdir()
    for part in ("render_system", "source_core"):
        (tree / part).symlink_to(ROOT / part)
    shutil.copytree(ROOT / "target_core", tree / "target_core")
    if one_text:
        (tree / "target_core/kernels/bsdf.h").write_text(WRAPPER % (ROOT / "source_core/kernels/bsdf.glsl"))
    words = [w for w in compile_command(arguments.build, "kernels/shade.cpp") if w != f"-I{ROOT}"]
    words[words.index("-o") + 1] = str(tree / "shade.o")
    words[-1] = str(tree / "target_core/kernels/shade.cpp")
    # The wrapper's unnamed namespace, once a file, is no danger where one file is compiled.
    options = [*options, "-Wno-subobject-linkage"]
    done = subprocess.run([words[0], *options, f"-I{tree}", *words[1:]], capture_output=True, text=True, check=False,
                          cwd=arguments.build)
    if done.returncode:
        sys.exit(f"one_text.py: it does not compile:\n{done.stderr[:4000]}")
    return tree


def build(arguments, folder, one_text):
    """A folder with the core's module, whose shade.cpp is compiled from a copy of the tree; also the object."""
    tree = compile_shade(arguments, folder, one_text, "-g")
    link = run(["ninja", "-C", str(arguments.build), "-t", "commands", "-s", MODULE]).strip().splitlines()[-1]
    link = re.search(r"&& (.*?) && :", link).group(1)
    modules = tree / "modules"
    modules.mkdir()
    subprocess.run(re.sub(r"-o \S+", f"-o {modules / pathlib.Path(MODULE).name} {tree / 'shade.o'}", link, count=1), shell=True,
                   cwd=arguments.build, check=True, capture_output=True)
    return modules, tree / "shade.o"


def pathtracer(arguments, modules, *words):
    """What the program prints with the target core of that folder."""
    return run([str(arguments.build / "bin/pathtracer"), *words], env={**os.environ, "PATHTRACER_MODULES": str(modules)})


def machine_code(obj):
    """Bytes of code, and the operations by name: how often each stands there."""
    size = sum(int(line.split()[2], 16) for line in run(["objdump", "-h", str(obj)]).splitlines()
               if len(line.split()) > 2 and line.split()[1].startswith(".text"))
    operations = {}
    for operation in re.findall(r"^\s+[0-9a-f]+:\t(?:[0-9a-f]{2} )+\s*\t(\S+)", run(["objdump", "-d", str(obj)]), re.M):
        operations[operation] = operations.get(operation, 0) + 1
    return size, operations


def shade_ms(arguments, cores):
    """The least of several runs of each, in turn: milliseconds of shading in a frame."""
    least = [float("inf")] * len(cores)
    for _ in range(arguments.rounds):
        for i, modules in enumerate(cores):
            bench = json.loads(pathtracer(arguments, modules, "bench", "still_life", "--core", "target", "--exact", "--threads", "1",
                                          "--size", "320x180", "--spp", "5", "--format", "json", "--quiet"))
            least[i] = min(least[i], bench["ms_per_frame"]["shade"])
    return least


def files_of_lines(obj):
    """Lines that the debugger knows of, by file."""
    found = {}
    for name in re.findall(r"^(\S+\.(?:h|glsl|cpp))\s+\d+\s+0x", run(["objdump", "--dwarf=decodedline", str(obj)]), re.M):
        found[pathlib.Path(name).name] = found.get(pathlib.Path(name).name, 0) + 1
    return {name: count for name, count in found.items() if name.startswith("bsdf")}


def cross_compiled(folder):
    """Lines of the C++ that spirv-cross writes for the whole kernel."""
    if not shutil.which("spirv-cross") or not shutil.which("glslangValidator"):
        return None
    with (ROOT / "portmap.toml").open("rb") as file:
        preamble = tomllib.load(file)["spirv"]["preamble"]
    text = (ROOT / "source_core/kernels/shade.comp").read_text()
    head, rest = text.split("#version 460\n")
    (folder / "shade.comp").write_text(f"{head}#version 460\n{preamble[0] if isinstance(preamble, list) else preamble}\n{rest}")
    spirv = folder / "shade.spv"
    run(["glslangValidator", "-V", "--target-env", "vulkan1.2", f"-I{ROOT / 'source_core/kernels'}", "-o", str(spirv),
         str(folder / "shade.comp")])
    done = subprocess.run(["spirv-cross", "--cpp", str(spirv)], capture_output=True, text=True, check=False)
    if done.returncode:
        return "spirv-cross: " + " ".join((done.stderr + done.stdout).split())[:300]
    return f"{code_lines(done.stdout)} lines of C++ by spirv-cross for the whole kernel"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.error = fail
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    parser.add_argument("--rounds", type=at_least(1), default=3)
    parser.add_argument("--compiles", action="store_true", help="only whether one text compiles: no picture and no times")
    arguments = parser.parse_args()
    if not arguments.compiles:
        need_programs(arguments.build / "bin/pathtracer", "ninja", "objdump")
    twin = (ROOT / "target_core/kernels/bsdf.h").read_text()
    source = (ROOT / "source_core/kernels/bsdf.glsl").read_text()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        print(f"lines of code: two texts {code_lines(source)} + {code_lines(twin)}, one text {code_lines(source)} + a wrapper of "
              f"{code_lines(WRAPPER)}")
        if arguments.compiles:
            compile_shade(arguments, folder, True, "-fsyntax-only")
            print("one text compiles")
            return
        print(cross_compiled(folder) or "without spirv-cross: it is not installed", flush=True)
        (two, two_object), (one, one_object) = build(arguments, folder, False), build(arguments, folder, True)
        pictures = []
        for modules in (two, one):
            pictures.append(modules / "picture.exr")
            pathtracer(arguments, modules, "render", "still_life", "--core", "target", "--exact", "--size", "160x90", "--spp", "4",
                       "-o", str(pictures[-1]))
        print("bits: " + ("the same picture" if pictures[0].read_bytes() == pictures[1].read_bytes() else "ANOTHER PICTURE"))
        print(f"a debugger's lines: two texts {files_of_lines(two_object)}, one text {files_of_lines(one_object)}", flush=True)
        (size_two, code_two), (size_one, code_one) = machine_code(two_object), machine_code(one_object)
        print(f"machine code: two texts {size_two} bytes, {sum(code_two.values())} instructions; one text {size_one} bytes, "
              f"{sum(code_one.values())} instructions; {'the same operations' if code_two == code_one else 'other operations'}",
              flush=True)
        times = shade_ms(arguments, [two, one])
        print(f"ms of shading a frame, one lane: two texts {times[0]:.2f}, one text {times[1]:.2f}")


if __name__ == "__main__":
    try:
        main()
    except subprocess.CalledProcessError as error:
        fail_of_command(error)
