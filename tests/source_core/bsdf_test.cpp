// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The BSDF's text as a device runs it: what it draws, held against the density that it says it draws by. The same text
// in C++ stands before a processor in tests/target_core/bsdf_test.cpp.
#include <glm/glm.hpp>

#include "tests/chi_square.h"
#include "tests/source_core/test_scene.h"

using namespace render_system;
using namespace source_core_test;

namespace {

constexpr uint32_t kSampleRows = 60;
constexpr uint32_t kRowWidth = chi_square::kCells;

constexpr const char* kIdleKernel =
    "#version 460\n#extension GL_GOOGLE_include_directive : require\n#include \"buffers.glsl\"\nvoid main() {}\n";

// Of each material kSampleRows rows of sampled directions, with 1 beside those that count; then a row of what each cell
// of chi_square.h expects of one sample.
constexpr const char* kDrawKernel = R"(
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bsdf.glsl"

const uint FINE = 12u;  // sub-cells a side

Bsdf bsdf_of(uint number) {
    Surface surface;
    surface.material = number;
    surface.color = vec4(1.0f);
    Material material = fetch_material(surface);
    Bsdf bsdf = make_bsdf(material, vec3(VIEWS[number]), vec3(0.0f, 0.0f, 1.0f), VIEWS[number].w > 0.0f);
    return with_coat(bsdf, material, normalized(vec3(0.2f, -0.1f, 1.0f)));
}

vec4 drawn(Bsdf bsdf, uint number) {
    Uint stream = pixel_seed(number, 11u);
    BsdfSample found = sample_bsdf(bsdf, random_pair(stream, 0u, 0u), random_pair(stream, 0u, 1u).x);
    return vec4(found.wi, found.valid ? 1.0f : 0.0f);
}

float expected(Bsdf bsdf, uint cell) {
    float sum = 0.0f;
    for (uint i = 0u; i < FINE * FINE; ++i) {
        float polar = (float(cell / TURN_CELLS) + (float(i / FINE) + 0.5f) / float(FINE)) * PI / float(POLAR_CELLS);
        float turn = (float(cell % TURN_CELLS) + (float(i % FINE) + 0.5f) / float(FINE)) / float(TURN_CELLS);
        vec2 around = vec2(cos(turn * 2.0f * PI), sin(turn * 2.0f * PI));
        vec3 wi = vec3(around * sin(polar), cos(polar));
        sum += evaluate_bsdf(bsdf, wi).pdf * sin(polar);
    }
    return sum / float(FINE * FINE);
}

void main() {
    uint job = gl_GlobalInvocationID.x;
    if (job >= pass.path_count) {
        return;
    }
    uint pixel = job + pass.first_pixel;
    uint row = pixel / WIDTH;
    uint column = pixel % WIDTH;
    Bsdf bsdf = bsdf_of(row / (SAMPLE_ROWS + 1u));
    uint part = row % (SAMPLE_ROWS + 1u);
    vec4 result = vec4(0.0f);
    if (part < SAMPLE_ROWS) {
        result = drawn(bsdf, part * WIDTH + column);
    } else {
        result.x = expected(bsdf, column);
    }
    store_target(job + pass.first_pixel, result);
}
)";

struct Lit {
    const char* name;
    float cosine;
    bool front;
    CoreMaterial material;
};

CoreMaterial glass(float ior, float roughness) {
    CoreMaterial material;
    material.metallic = 0.0f;
    material.roughness = roughness;
    material.ior = ior;
    material.transmission = 1.0f;
    material.thin_walled = false;
    return material;
}

CoreMaterial opaque(float metallic, float roughness) {
    CoreMaterial material;
    material.metallic = metallic;
    material.roughness = roughness;
    return material;
}

// All lobes are in one scene, so that the kernel has the text of each.
std::vector<Lit> lit_materials() {
    std::vector<Lit> all = {
        {"plastic", 0.8f, true, opaque(0, 0.4f)},
        {"rough metal, grazing", 0.15f, true, opaque(1, 1)},
        {"thin rough glass", 0.7f, true, glass(1.5f, 0.5f)},
        {"rough solid of index 1.1", 0.6f, true, glass(1.1f, 0.8f)},
        {"rough solid of index 1.2, leaving", 0.5f, false, glass(1.2f, 0.5f)},
        {"rough solid glass, leaving past the critical angle", 0.4f, false, glass(1.5f, 0.4f)},
        {"rough diamond under sheen, entering", 0.4f, true, glass(2.5f, 0.5f)},
        {"rough diamond, leaving", 0.95f, false, glass(2.5f, 0.5f)},
        {"sheen on plastic", 0.6f, true, opaque(0, 0.4f)},
        {"coat on sheen on metal", 0.5f, true, opaque(1, 0.6f)},
        {"film on plastic of index 2.5", 0.6f, true, opaque(0, 0.5f)},
        {"brushed metal", 0.6f, true, opaque(1, 0.3f)},
        {"brushed solid glass, entering", 0.6f, true, glass(1.5f, 0.3f)},
    };
    all[2].material.thin_walled = true;
    for (const size_t i : {6u, 8u, 9u}) {
        all[i].material.sheen_color = glm::vec3(0.8f);
        all[i].material.sheen_roughness = 0.4f;
    }
    all[7].material.transmission = 0.7f;
    all[9].material.coat = 0.8f;
    all[9].material.coat_roughness = 0.4f;
    all[10].material.ior = 2.5f;
    all[10].material.film = 0.75f;
    all[11].material.anisotropy = all[12].material.anisotropy = 0.7f;
    return all;
}

std::string head(const std::vector<Lit>& all) {
    std::string views;
    for (const Lit& lit : all) {
        const float sine = std::sqrt(1.0f - lit.cosine * lit.cosine);
        views += (views.empty() ? "" : ", ") + ("vec4(" + std::to_string(0.6f * sine)) + "f, " +
                 std::to_string(0.8f * sine) + "f, " + std::to_string(lit.cosine) + "f, " +
                 (lit.front ? "1.0f)" : "0.0f)");
    }
    const std::string count = "[" + std::to_string(all.size()) + "]";
    return "const vec4 VIEWS" + count + " = vec4" + count + "(" + views + ");\n" +
           "const uint WIDTH = " + std::to_string(kRowWidth) +
           "u;\nconst uint SAMPLE_ROWS = " + std::to_string(kSampleRows) +
           "u;\nconst uint POLAR_CELLS = " + std::to_string(chi_square::kPolarCells) +
           "u;\nconst uint TURN_CELLS = " + std::to_string(chi_square::kTurnCells) + "u;\n";
}

}  // namespace

TEST(SourceBsdf, SamplingAgreesWithDensityByChiSquare) {
    const std::vector<Lit> all = lit_materials();
    const TemporaryFolder folder;
    folder.write_kernels();
    for (const char* name : {"generate.comp", "extend.comp", "shade.comp", "connect.comp"})
        folder.write(name, kIdleKernel);
    std::string draw = std::string(kDrawKernel).substr(1);
    const std::string include = "#include \"bsdf.glsl\"\n";
    draw.insert(draw.find(include) + include.size(), head(all));
    folder.write("finalize.comp", draw);
    OPEN_CORE_OR_SKIP(core, {.kernels_directory = folder.path().string()});
    TestScene scene;
    scene.materials.clear();
    scene.meshes.emplace_back();
    for (const Lit& lit : all) {
        const float x = static_cast<float>(scene.materials.size());
        scene.meshes[0].add_triangle({x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}, static_cast<uint32_t>(x));
        scene.materials.push_back(lit.material);
    }
    scene.instances.push_back({0, {}});
    ASSERT_TRUE(scene.send(*core).ok());
    const auto rows = static_cast<uint32_t>(all.size()) * (kSampleRows + 1);
    const std::vector<glm::vec4> pixels = render(*core, kRowWidth, rows, 1);
    for (size_t i = 0; i < all.size(); ++i) {
        SCOPED_TRACE(all[i].name);
        const size_t first = i * (kSampleRows + 1) * kRowWidth, samples = size_t{kSampleRows} * kRowWidth;
        std::vector<double> seen(chi_square::kCells, 0.0), expected;
        for (size_t k = first; k < first + samples; ++k) {
            const glm::vec4& found = pixels[k];
            if (found.w > 0.0f) seen[chi_square::cell_of(found.x, found.y, found.z)] += 1.0;
        }
        for (size_t k = 0; k < kRowWidth; ++k) {
            expected.push_back(static_cast<double>(pixels[first + samples + k].x) * static_cast<double>(samples) *
                               chi_square::kCellArea);
        }
        chi_square::expect_agreement(seen, expected);
    }
}
