#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""The BSDF by three ways to C++: its port (two texts), its GLSL through glsl.h (one text), and its SPIR-V by spirv-cross.

One probe, written in words that both languages know, draws materials and directions by a hash, makes the BSDF, samples and
evaluates it. Each way compiles it with the flags of the target core's shading; the two that go through glsl.h once for one
lane and once for as many as the machine has. Then: nanoseconds of processor time a probe (the least of several rounds, in
turn), how many results have the same bits, machine code, and what a debugger knows: the BSDF's functions by their names,
and locals that are called param_N. Needs a configured build/release, glslangValidator and spirv-cross.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import one_text  # noqa: E402
from compare_renderers import at_least, fail  # noqa: E402

ROOT = one_text.ROOT
DRAWN = (("metallic", "u"), ("roughness", "u"), ("specular", "u"), ("transmission", "u"), ("ior", "1.1f + u"),
         ("sheen_roughness", "u"), ("coat", "u"), ("coat_roughness", "u"), ("film", "u"), ("film_ior", "1.2f + u"),
         ("film_thickness", "100.0f + 400.0f * u"), ("anisotropy", "u"))
COLOURS = ("base_color", "specular_color", "sheen_color")
ROWS = ("energy_row", "sheen_row", "stretched_row")


def probe_text():
    """The probe, valid as GLSL and, through glsl.h, as C++."""
    numbers = iter(range(64))

    def drawn(form="u"):
        return form.replace("u", f"probe_number(probe, {next(numbers)}u)", 1)
    lines = [f"    material.{colour} = vec3({drawn()}, {drawn()}, {drawn()});" for colour in COLOURS]
    lines += [f"    material.{member} = {drawn(form)};" for member, form in DRAWN]
    lines += [f"    material.{row} = 0u;" for row in ROWS]
    return f"""
Float probe_number(Uint probe, uint which) {{ return unit_float(hash_bits(probe * 64u + which)); }}

vec4 probe_bsdf(Uint probe) {{
    Material material;
{chr(10).join(lines)}
    material.flags = select({drawn()} < 0.5f, Uint(MATERIAL_THIN_WALLED), Uint(0u));
    vec3 up = vec3(0.0f, 0.0f, 1.0f);
    vec2 around = cos_sin_turns({drawn()});
    Float cosine = 0.05f + 0.9f * {drawn()};
    Float sine = sqrt(1.0f - cosine * cosine);
    Bsdf bsdf = make_bsdf(material, vec3(sine * around.x, sine * around.y, cosine), up, {drawn()} < 0.5f);
    bsdf = with_coat(bsdf, material, up);
    BsdfSample next = sample_bsdf(bsdf, vec2({drawn()}, {drawn()}), {drawn()});
    BsdfValue value = evaluate_bsdf(bsdf, next.wi);
    return vec4(value.value + next.weight, value.pdf + next.pdf);
}}
"""


def through_glsl_h(way, includes, lanes):
    """C++ of a way that goes through glsl.h; `lanes`: the header of wide ones, or none."""
    wide = (f'#define TARGET_CORE_LANES "{lanes}"\n#define TARGET_CORE_TRACE "target_core/device/wide_trace.h"\n'
            f'#define kernels kernels_{way}\n' if lanes else "")
    return f"""{wide}{includes}
namespace target_core::kernels {{
namespace {{
thread_local ::target_core::vec4* probe_results;
{probe_text()}
void probe_job(Uint job) {{ scatter(probe_results, job, probe_bsdf(job), Mask(true)); }}
}}  // namespace
void run_{way}(const float* table, float* results, uint count) {{
    settings.features = ~0u;
    bound.lobe_energy = reinterpret_cast<const ::target_core::vec4*>(table);
    probe_results = reinterpret_cast<::target_core::vec4*>(results);
    for_each_job<probe_job>(count);
}}
}}  // namespace target_core::kernels
#undef kernels
extern "C" void {way}(const float* table, float* results, unsigned count) {{
    target_core::{'kernels_' + way if lanes else 'kernels'}::run_{way}(table, results, count);
}}
"""


# What the C++ of spirv-cross asks of its surroundings, as far as the probe does; Debian's package brings none of it.
SURROUNDINGS = """#pragma once
#include <cstdint>
#include <glm/glm.hpp>
namespace spirv_cross {
struct spirv_cross_shader {
    template <class R> void register_resource(R&, unsigned, unsigned) {}
    template <class R> void register_push_constant(R&) {}
};
namespace internal {
template <class T> struct Resource {
    T* pointer = nullptr;
    T& get() { return *pointer; }
};
template <class T> using PushConstant = Resource<T>;
}  // namespace internal
struct samplerBuffer {};
struct usamplerBuffer {};
struct ComputeResources {
    void init(spirv_cross_shader&) {}
};
struct ComputePrivateResources { glm::uvec3 gl_GlobalInvocationID__; };
}  // namespace spirv_cross
#define gl_GlobalInvocationID __priv_res.gl_GlobalInvocationID__
"""


def by_spirv_cross(folder):
    """C++ around what spirv-cross wrote, and what kept that from compiling as it came."""
    with (ROOT / "portmap.toml").open("rb") as file:
        preamble = tomllib.load(file)["spirv"]["preamble"][0].replace("TABLE_lobe_energy VIA_TEXELS", "TABLE_lobe_energy VIA_STORAGE")
    (folder / "probe.comp").write_text(
        f'#version 460\n#extension GL_GOOGLE_include_directive : require\n{preamble}\n#include "bsdf.glsl"\n'
        "layout(set = 1, binding = 0, std430) buffer ProbeBlock { vec4 probe_results[]; };\n" + probe_text() +
        "void main() { probe_results[gl_GlobalInvocationID.x] = probe_bsdf(gl_GlobalInvocationID.x); }\n")
    # From SPIR-V 1.3 on storage buffers have a class of their own, which its C++ leaves out.
    one_text.run(["glslangValidator", "-V", "--target-env", "vulkan1.0", f"-I{ROOT / 'source_core/kernels'}", "-o",
                  str(folder / "probe.spv"), str(folder / "probe.comp")])
    text = one_text.run(["spirv-cross", "--cpp", str(folder / "probe.spv")]).split("\nspirv_cross_shader_t *")[0] + "\n"
    declared = set(re.findall(r"(?:Resource|PushConstant)<\w+> (\w+);", text))
    unknown = [line for line in text.splitlines(True)
               for name in re.findall(r"s\.register_\w+\((\w+)", line) if name not in declared]
    for line in unknown:
        text = text.replace(line, "")
    (folder / "probe_cross.h").write_text(text)
    (folder / "spirv_cross").mkdir()
    (folder / "spirv_cross/internal_interface.hpp").write_text(SURROUNDINGS)
    (folder / "spirv_cross/external_interface.h").write_text("")
    table, results = (re.search(rf"struct {block}\s*{{[^}}]*}};\s*internal::Resource<{block}> (\w+);", text)[1]
                      for block in ("lobe_energy_block", "ProbeBlock"))
    return one_text.code_lines(text), len(unknown), f"""#include "probe_cross.h"
extern "C" void cross(const float* table, float* results, unsigned count) {{
    using Shader = Impl::Shader;
    Shader::Resources resources;
    resources.{table}.pointer = reinterpret_cast<Shader::Resources::lobe_energy_block*>(const_cast<float*>(table));
    resources.{results}.pointer = reinterpret_cast<Shader::Resources::ProbeBlock*>(results);
    Shader shader;
    shader.__res = &resources;
    for (unsigned job = 0; job < count; ++job) {{
        shader.__priv_res.gl_GlobalInvocationID__ = glm::uvec3(job, 0u, 0u);
        shader.main();
    }}
}}
"""


DRIVER = """#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <vector>
%s
struct Row { alignas(64) float words[16]; };
static double seconds() { return double(clock()) / CLOCKS_PER_SEC; }
int main() {
    constexpr unsigned count = %d, rows = 1u << 16;
    std::vector<Row> table(rows / 4);
    uint32_t state = 1;
    for (Row& row : table) for (float& word : row.words) word = std::bit_cast<float>(state = state * 1664525u + 1013904223u);
    using Way = void (*)(const float*, float*, unsigned);
    const Way ways[] = {%s};
    std::vector<std::vector<Row>> results(std::size(ways), std::vector<Row>(count / 4));
    std::vector<double> least(std::size(ways), 1e30);
    for (int round = 0; round < %d; ++round) {
        for (size_t i = 0; i < std::size(ways); ++i) {
            const double start = seconds();
            ways[i](table[0].words, results[i][0].words, count);
            least[i] = std::min(least[i], seconds() - start);
        }
    }
    unsigned finite = 0;
    for (unsigned job = 0; job < count; ++job) {
        const float* row = results[0][job / 4].words + job %% 4 * 4;
        finite += std::all_of(row, row + 4, [](float word) { return std::isfinite(word); });
    }
    std::printf("%%u\\n", finite);
    for (size_t i = 0; i < std::size(ways); ++i) {
        unsigned same = 0;
        for (unsigned job = 0; job < count; ++job)
            same += std::memcmp(results[0][job / 4].words + job %% 4 * 4, results[i][job / 4].words + job %% 4 * 4, 16) == 0;
        std::printf("%%.1f %%u\\n", least[i] / count * 1e9, same);
    }
}
"""


def flags_of(build, name):
    """The compiler and the flags of a file of the target core, without output and input."""
    words = one_text.compile_command(build, name)
    return [w for w in words[:words.index("-o")] if not w.startswith("-I")]


def compiled(folder, way, text, flags, kind="-c"):
    file = folder / f"{way}.cpp"
    file.write_text(text)
    done = subprocess.run([*flags, "-g", "-w", f"-I{folder}", f"-I{ROOT}", kind, str(file), "-o", str(folder / f"{way}.o")],
                          capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"cross_compiled.py: {way} does not compile:\n{done.stderr[:4000]}")
    return folder / f"{way}.o"


def known_to_debugger(obj, functions):
    """How many of the functions the debug information names, and of its other names those called param_N."""
    names = re.findall(r"DW_AT_name\s*: (?:\(indirect [^)]*\): )?(\S+)", one_text.run(["objdump", "--dwarf=info", str(obj)]))
    return len(functions & set(names)), sum(1 for name in names if re.fullmatch(r"param(_\d+)?", name))


def widest(build):
    """Header, flags and count of the most lanes that this machine has."""
    features = set(re.search(r"^flags\s*:(.*)$", pathlib.Path("/proc/cpuinfo").read_text(), re.M)[1].split())
    if {"avx512f", "avx512vl", "avx512dq", "avx512bw"} <= features:
        return "target_core/device/lanes_avx512.h", flags_of(build, "device/shade_avx512.cpp"), 16
    if "avx2" in features:
        return "target_core/device/lanes_avx2.h", flags_of(build, "device/shade_avx2.cpp"), 8
    return None


def ways_through_glsl_h(build):
    """Names, texts and flags of the port and of the one text: for one lane, and for as many as this machine has."""
    texts = {"two_texts": '#include "target_core/kernels/bsdf.h"\n',
             "one_text": one_text.WRAPPER % (ROOT / "source_core/kernels/bsdf.glsl")}
    scalar, wide = flags_of(build, "kernels/shade.cpp"), widest(build)
    narrow = [(way, through_glsl_h(way, includes, None), scalar) for way, includes in texts.items()]
    if wide is None:
        return narrow, []
    header, flags, lanes = wide
    return narrow, [(f"{way}_{lanes}", through_glsl_h(f"{way}_{lanes}", includes, header), flags) for way, includes in texts.items()]


def measured(folder, ways, arguments):
    """The objects by way, how many results of the first are finite, and for each way its time and results of equal bits."""
    objects = {way: compiled(folder, way, text, flags) for way, text, flags in ways}
    declared = "\n".join(f'extern "C" void {way}(const float*, float*, unsigned);' for way in objects)
    (folder / "main.cpp").write_text(DRIVER % (declared, arguments.probes, ", ".join(objects), arguments.rounds))
    subprocess.run(["c++", "-std=c++20", "-O2", str(folder / "main.cpp"), *map(str, objects.values()), "-o", str(folder / "main")],
                   check=True)
    finite, *found = [line.split() for line in one_text.run([str(folder / "main")]).splitlines()]
    return objects, finite[0], found


MOST_PROBES = 1 << 24  # a GiB of results by four ways


def whole_rows(text):
    number = at_least(16)(text)
    if number % 16 or number > MOST_PROBES:
        raise argparse.ArgumentTypeError(f"{text}: expected a multiple of 16 up to {MOST_PROBES}")
    return number


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.error = fail
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    parser.add_argument("--rounds", type=at_least(1), default=7)
    parser.add_argument("--probes", type=whole_rows, default=1 << 16, help="a multiple of 16")
    parser.add_argument("--compiles", action="store_true", help="only whether the probe compiles for one lane, without spirv-cross")
    arguments = parser.parse_args()
    if not arguments.compiles:
        one_text.need_programs("glslangValidator", "spirv-cross", "objdump")
    narrow, wide = ways_through_glsl_h(arguments.build)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        if arguments.compiles:
            for way, text, flags in narrow:
                compiled(folder, way, text, flags, "-fsyntax-only")
            print("the probe compiles")
            return
        lines, left_out, cross = by_spirv_cross(folder)
        ways = [*narrow, ("cross", cross, narrow[0][2]), *wide]
        objects, finite, found = measured(folder, ways, arguments)
        functions = set(re.findall(r"^\w+ (\w+)\(.*\{", (ROOT / "source_core/kernels/bsdf.glsl").read_text(), re.M))
        print(f"spirv-cross wrote {lines} lines of C++, of which {left_out} did not compile and were left out; of {arguments.probes} "
              f"results {finite} are finite")
        for (way, obj), (time, same) in zip(objects.items(), found):
            kept, numbered = known_to_debugger(obj, functions)
            print(f"{way}: {time} ns a probe, {same} of {arguments.probes} results have the bits of two_texts, "
                  f"{one_text.machine_code(obj)[0]} bytes of code; a debugger knows {kept} of {len(functions)} functions, "
                  f"{numbered} names are param_N")


if __name__ == "__main__":
    try:
        main()
    except subprocess.CalledProcessError as error:
        one_text.fail_of_command(error)
