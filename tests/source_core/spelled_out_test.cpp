// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What a device makes of a kernel whose divisions and roots are spelled out, held against the processor.
#include <bit>
#include <cmath>
#include <glm/glm.hpp>

#include "tests/source_core/test_scene.h"

using namespace render_system;
using namespace source_core_test;

namespace {

constexpr uint32_t WIDTH = 64, HEIGHT = 32;

constexpr const char* NOTHING =
    "#version 460\n#extension GL_GOOGLE_include_directive : require\n#include \"buffers.glsl\"\nvoid main() {}\n";

// A pixel is one operation on numbers that its index makes; `operand` below makes the same ones.
constexpr const char* OPERATIONS = R"(#version 460
#extension GL_GOOGLE_include_directive : require
#include "buffers.glsl"

float operand(uint at) {
    uint x = at * 2654435761u;
    x = (x ^ (x >> 15)) * 2246822519u;
    x = (x ^ (x >> 13)) * 3266489917u;
    x ^= x >> 16;
    return uintBitsToFloat((x & 0x80ffffffu) + 0x3e000000u);
}

void main() {
    uint pixel = gl_GlobalInvocationID.x;
    if (pixel >= pass.path_count) {
        return;
    }
    uint first = pixel * 12u;
    vec4 a = vec4(operand(first), operand(first + 1u), operand(first + 2u), operand(first + 3u));
    vec4 b = vec4(operand(first + 4u), operand(first + 5u), operand(first + 6u), operand(first + 7u));
    vec4 c = vec4(operand(first + 8u), operand(first + 9u), operand(first + 10u), operand(first + 11u));
    vec4 result = vec4(0.0f);
    switch (pixel & 7u) {
        case 0u: result = a / b; break;
        case 1u: result = vec4(a.x / b.x, a.yz / b.y, 1.0f / c.x); break;
        case 2u: result = sqrt(abs(a)); break;
        case 3u: result = vec4(dot(a.xy, b.xy), dot(a.xyz, b.xyz), dot(a, b), sqrt(abs(b.x))); break;
        case 4u: result = vec4(cross(a.xyz, b.xyz), 0.0f); break;
        case 5u: result = vec4(min(a.xyz, b.xyz), min(a.w, b.w)); break;
        case 6u: result = max(a, b); break;
        case 7u: result = clamp(a, min(b, c), max(b, c)); break;
    }
    store_target(pixel, result);
}
)";

float operand(uint32_t at) {
    uint32_t x = at * 2654435761u;
    x = (x ^ (x >> 15)) * 2246822519u;
    x = (x ^ (x >> 13)) * 3266489917u;
    x ^= x >> 16;
    return std::bit_cast<float>((x & 0x80ffffffu) + 0x3e000000u);
}

glm::vec4 operands(uint32_t first) {
    return {operand(first), operand(first + 1), operand(first + 2), operand(first + 3)};
}

// What IEEE 754 says, in the order in which the target core adds.
glm::vec4 expected(uint32_t pixel) {
    const glm::vec4 a = operands(pixel * 12), b = operands(pixel * 12 + 4), c = operands(pixel * 12 + 8);
    const float plane = a.x * b.x + a.y * b.y;
    switch (pixel & 7u) {
        case 0:
            return {a.x / b.x, a.y / b.y, a.z / b.z, a.w / b.w};
        case 1:
            return {a.x / b.x, a.y / b.y, a.z / b.y, 1.0f / c.x};
        case 2:
            return {std::sqrt(std::fabs(a.x)), std::sqrt(std::fabs(a.y)), std::sqrt(std::fabs(a.z)),
                    std::sqrt(std::fabs(a.w))};
        case 3:
            return {plane, plane + a.z * b.z, (plane + a.z * b.z) + a.w * b.w, std::sqrt(std::fabs(b.x))};
        case 4:
            return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y, 0.0f};
        case 5:
            return glm::min(a, b);
        case 6:
            return glm::max(a, b);
        default:
            return glm::min(glm::max(a, glm::min(b, c)), glm::max(b, c));
    }
}

}  // namespace

TEST(SpelledOutArithmetic, GivesTheBitsOfTheProcessor) {
    const TemporaryFolder folder;
    folder.write_kernels();
    for (const char* name : {"generate.comp", "extend.comp", "shade.comp", "connect.comp"}) {
        folder.write(name, NOTHING);
    }
    folder.write("finalize.comp", OPERATIONS);
    source_core::CoreTuning tuning;
    tuning.spelled_out_arithmetic = true;
    OPEN_CORE_OR_SKIP(core, {.kernels_directory = folder.path().string()}, tuning);
    TestScene scene;
    ASSERT_TRUE(scene.send(*core).ok());
    const auto pixels = render(*core, WIDTH, HEIGHT, 1);
    for (uint32_t pixel = 0; pixel < WIDTH * HEIGHT; ++pixel) {
        const glm::vec4 wanted = expected(pixel);
        for (int i = 0; i < 4; ++i) {
            ASSERT_EQ(std::bit_cast<uint32_t>(pixels[pixel][i]), std::bit_cast<uint32_t>(wanted[i]))
                << "pixel " << pixel << ", operation " << (pixel & 7u) << ", component " << i << ": "
                << pixels[pixel][i] << ", not " << wanted[i];
        }
    }
}
