// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/tone_map.h"

#include <algorithm>
#include <cmath>

namespace application {
namespace {

// Largest value that curves are asked for: past it their squares are past a float.
constexpr float kBrightest = 1e9f;

// "Khronos PBR Neutral Tone Mapper", Khronos Group 2024: the reference code of its specification.
glm::vec3 neutral(glm::vec3 color) {
    constexpr float kStart = 0.8f - 0.04f, kDesaturation = 0.15f;
    const float low = std::min(color.x, std::min(color.y, color.z));
    color -= low < 0.08f ? low - 6.25f * low * low : 0.04f;
    const float peak = std::max(color.x, std::max(color.y, color.z));
    if (peak < kStart) return color;
    constexpr float kRoom = 1.0f - kStart;
    const float new_peak = 1.0f - kRoom * kRoom / (peak + kRoom - kStart);
    color *= new_peak / peak;
    const float white = 1.0f - 1.0f / (kDesaturation * (peak - new_peak) + 1.0f);
    return color + (glm::vec3(new_peak) - color) * white;
}

// Stephen Hill, "BakingLab" (ACES.hlsl), 2016; matrices by columns.
glm::vec3 aces(const glm::vec3& color) {
    const glm::mat3 into(0.59719f, 0.07600f, 0.02840f, 0.35458f, 0.90834f, 0.13383f, 0.04823f, 0.01566f, 0.83777f);
    const glm::mat3 back(1.60475f, -0.10208f, -0.00327f, -0.53108f, 1.10813f, -0.07276f, -0.07367f, -0.00605f,
                         1.07602f);
    const glm::vec3 v = into * color;
    const glm::vec3 a = v * (v + 0.0245786f) - 0.000090537f;
    const glm::vec3 b = v * (0.983729f * v + 0.4329510f) + 0.238081f;
    return back * (a / b);
}

// Benjamin Wrensch, "Minimal AgX Implementation", 2023.
glm::vec3 agx(const glm::vec3& color) {
    const glm::mat3 into(0.842479062253094f, 0.0423282422610123f, 0.0423756549057051f, 0.0784335999999992f,
                         0.878468636469772f, 0.0784336f, 0.0792237451477643f, 0.0791661274605434f, 0.879142973793104f);
    const glm::mat3 back(1.19687900512017f, -0.0528968517574562f, -0.0529716355144438f, -0.0980208811401368f,
                         1.15190312990417f, -0.0980434501171241f, -0.0990297440797205f, -0.0989611768448433f,
                         1.15107367264116f);
    constexpr float kLowest = -12.47393f, kHighest = 4.026069f;  // stops
    glm::vec3 x = into * color;
    for (int i = 0; i < 3; ++i) {
        const float stops = std::log2(std::max(x[i], 1e-10f));
        x[i] = (std::clamp(stops, kLowest, kHighest) - kLowest) / (kHighest - kLowest);
    }
    const glm::vec3 x2 = x * x, x4 = x2 * x2;
    x = 15.5f * x4 * x2 - 40.14f * x4 * x + 31.96f * x4 - 6.868f * x2 * x + 0.4298f * x2 + 0.1191f * x - 0.00232f;
    x = glm::max(back * x, glm::vec3(0.0f));
    return {std::pow(x.x, 2.2f), std::pow(x.y, 2.2f), std::pow(x.z, 2.2f)};
}

}  // namespace

glm::vec3 tone_mapped(const glm::vec3& radiance, float exposure, ToneMap curve) {
    glm::vec3 color = radiance * exposure;
    for (int i = 0; i < 3; ++i) color[i] = color[i] > 0.0f ? color[i] : 0.0f;
    if (curve == ToneMap::none) return color;
    color = glm::min(color, glm::vec3(kBrightest));
    color = curve == ToneMap::neutral ? neutral(color) : curve == ToneMap::aces ? aces(color) : agx(color);
    return glm::clamp(color, 0.0f, 1.0f);
}

}  // namespace application
