// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/lobe_energy.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace render_system {

namespace {

constexpr double kTwoPi = 6.283185307179586;

// An interface as the kernels see it: Schlick's Fresnel term, and what lies behind.
struct Interface {
    double eta;  // index behind over the index before; 0: nothing passes, all is reflected
    double f0;
    double f90;

    // Schlick's weight where light meets a microfacet at that cosine.
    double weight(double cosine) const {
        if (eta == 0.0) return std::pow(1.0 - std::clamp(cosine, 0.0, 1.0), 5.0);
        const double sine2 = (1.0 - cosine * cosine) / (eta * eta);
        const double larger = eta < 1.0 ? std::sqrt(std::max(1.0 - sine2, 0.0)) : cosine;
        const double m = 1.0 - std::clamp(larger, 0.0, 1.0);
        return (m * m) * (m * m) * m;
    }
    double reflected(double weight) const { return f0 + (f90 - f0) * weight; }
};

double smith(double cosine, double alpha) { return std::sqrt(alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine); }

// A Fibonacci lattice: a turn's cosine and sine, and a number from 0 to 1.
template <class Point>
std::vector<Point> lattice_of(uint32_t size, uint32_t generator) {
    std::vector<Point> made;
    for (uint32_t i = 0; i < size; ++i) {
        const double turn = kTwoPi * static_cast<double>(i * generator % size) / size;
        made.emplace_back(std::cos(turn), std::sin(turn), (i + 0.5) / size);
    }
    return made;
}

const std::vector<glm::dvec3>& lattice() {
    static const std::vector<glm::dvec3> points = lattice_of<glm::dvec3>(610, 377);
    return points;
}

// Visible normals by Dupuy and Benyoub 2023.
glm::dvec3 visible_normal(const glm::dvec3& wo, double alpha, const glm::dvec3& point) {
    const glm::dvec3 stretched = glm::normalize(glm::dvec3(wo.x * alpha, wo.y * alpha, wo.z));
    const double z = (1.0 - point.z) * (1.0 + stretched.z) - stretched.z;
    const double sine = std::sqrt(std::max(1.0 - z * z, 0.0));
    const glm::dvec3 h = glm::dvec3(sine * point.x, sine * point.y, z) + stretched;
    return glm::normalize(glm::dvec3(h.x * alpha, h.y * alpha, h.z));
}

// What leaves by one microfacet, of what meets it: all, and what is reflected times Schlick's weight.
glm::dvec2 leaving(const Interface& face, const glm::dvec3& wo, const glm::dvec3& h, double alpha) {
    const double cosine = glm::dot(wo, h), root_o = smith(wo.z, alpha);
    const double weight = face.weight(cosine), reflected = face.reflected(weight);
    glm::dvec2 sum(0.0);
    const double up = 2.0 * cosine * h.z - wo.z;
    if (up > 0.0) {
        const double unmasked = up * (wo.z + root_o) / (wo.z * smith(up, alpha) + up * root_o);
        sum = unmasked * glm::dvec2(reflected, weight);
    }
    const double sine2 = face.eta > 0.0 ? (1.0 - cosine * cosine) / (face.eta * face.eta) : 1.0;
    if (sine2 >= 1.0) return sum;
    const double down = wo.z / face.eta - h.z * (cosine / face.eta - std::sqrt(1.0 - sine2));
    if (down > 0.0) sum.x += (1.0 - reflected) * 2.0 * down / (down + smith(down, alpha));
    return sum;
}

glm::dvec2 energy(const Interface& face, double cosine, double roughness) {
    const double alpha = roughness * roughness;
    if (alpha == 0.0) return {1.0, face.weight(cosine)};
    const double z = std::max(cosine, 1e-4);
    const glm::dvec3 wo(std::sqrt(1.0 - z * z), 0.0, z);
    glm::dvec2 sum(0.0);
    for (const glm::dvec3& point : lattice()) sum += leaving(face, wo, visible_normal(wo, alpha, point), alpha);
    // What sums and interpolation miss, up to a thousandth, shall take light away, not make it.
    return glm::min(1.001 * sum / static_cast<double>(lattice().size()), 1.0);
}

// GGX stretched along x. Below this alpha no lobe is: the kernels' SMOOTH_ALPHA.
constexpr float kSmoothAlpha = 1e-3f;

struct Stretched {
    float along, across;

    Stretched(float roughness, float strength) {
        const float alpha = roughness * roughness;
        along = alpha + (1.0f - alpha) * strength * strength;
        across = std::min(std::max(alpha, kSmoothAlpha), along);
    }
    float root(const glm::vec3& w) const { return glm::length(w * glm::vec3(along, across, 1.0f)); }

    // The view at that cosine and turn: its projected roughness lies between those of the axes, in equal steps of
    // roots.
    glm::vec3 view(float cosine, float turn) const {
        const float z = std::max(cosine, 1e-4f), sine = std::sqrt(1.0f - z * z);
        const float root = std::sqrt(across) + (std::sqrt(along) - std::sqrt(across)) * turn;
        const float widest = along * along - across * across;
        const float x2 = widest > 0.0f ? (root * root * root * root - across * across) / widest : 0.0f;
        const float bounded = std::clamp(x2, 0.0f, 1.0f);
        return {sine * std::sqrt(bounded), sine * std::sqrt(1.0f - bounded), z};
    }
};

// As leaving(), of a stretched lobe in floats; `h` is of any length.
glm::vec2 leaving(const Interface& face, const Stretched& lobe, const glm::vec3& wo, float root_o, const glm::vec3& h) {
    const float squared = glm::dot(h, h), wo_h = glm::dot(wo, h), cosine = wo_h / std::sqrt(squared);
    const auto eta = static_cast<float>(face.eta), f0 = static_cast<float>(face.f0);
    const float sine2 = eta > 0.0f ? (1.0f - cosine * cosine) / (eta * eta) : 1.0f;
    const float larger = eta > 0.0f && eta < 1.0f ? std::sqrt(std::max(1.0f - sine2, 0.0f)) : cosine;
    const float m = std::max(1.0f - larger, 0.0f), weight = (m * m) * (m * m) * m;
    const float reflected = f0 + (static_cast<float>(face.f90) - f0) * weight;
    glm::vec2 sum(0.0f);
    const glm::vec3 up = h * (2.0f * wo_h / squared) - wo;
    if (up.z > 0.0f) {
        const float unmasked = up.z * (wo.z + root_o) / (wo.z * lobe.root(up) + up.z * root_o);
        sum = unmasked * glm::vec2(reflected, weight);
    }
    if (sine2 >= 1.0f) return sum;
    const glm::vec3 down = h * ((cosine / eta - std::sqrt(1.0f - sine2)) / std::sqrt(squared)) - wo / eta;
    if (down.z < 0.0f) sum.x += (1.0f - reflected) * 2.0f * down.z / (down.z - lobe.root(down));
    return sum;
}

// As energy(), in floats: it is asked for 40,000 times. Reflection alone is smooth enough for fewer points.
glm::dvec2 stretched_energy(const Interface& face, float cosine, float turn, float roughness, float strength) {
    static const std::vector<glm::vec3> few = lattice_of<glm::vec3>(144, 89), many = lattice_of<glm::vec3>(610, 377);
    const std::vector<glm::vec3>& points = face.eta > 0.0 ? many : few;
    const Stretched lobe(roughness, strength);
    if (lobe.along < kSmoothAlpha) return energy(face, static_cast<double>(cosine), 0.0);
    const glm::vec3 wo = lobe.view(cosine, turn), scale(lobe.along, lobe.across, 1.0f);
    const glm::vec3 seen = glm::normalize(wo * scale);
    const float root_o = lobe.root(wo);
    glm::vec2 sum(0.0f);
    for (const glm::vec3& point : points) {
        const float z = (1.0f - point.z) * (1.0f + seen.z) - seen.z;
        const float sine = std::sqrt(std::max(1.0f - z * z, 0.0f));
        sum += leaving(face, lobe, wo, root_o, (glm::vec3(sine * point.x, sine * point.y, z) + seen) * scale);
    }
    return glm::min(1.001 * glm::dvec2(sum) / static_cast<double>(points.size()), 1.0);
}

// Charlie's sheen: Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF", with its fitted shadowing.
struct Sheen {
    double alpha;

    double fit(double x) const {
        const double t = (1.0 - alpha) * (1.0 - alpha);
        const auto between = [t](double rough, double smooth) { return rough + (smooth - rough) * t; };
        return between(21.5473, 25.3245) / (1.0 + between(3.82987, 3.32435) * std::pow(x, between(0.19823, 0.16801))) +
               between(-1.97760, -1.27393) * x + between(-4.32054, -4.85967);
    }
    double lambda(double cosine) const {
        return std::exp(cosine < 0.5 ? fit(cosine) : 2.0 * fit(0.5) - fit(1.0 - cosine));
    }
};

// What sheen returns of the light, and what that is to be scaled by. Lines are even steps of the root of roughness,
// from the smoothest sheen (SMOOTHEST_SHEEN of the kernels) on; the cosine is GRAZING_SHEEN of the kernels at least.
// Cosines summed over stand at squares of even steps, since most of it is at the horizon.
glm::dvec2 sheen_energy(double cosine, double line) {
    constexpr int kPolar = 48, kAround = 32;
    const double root = std::lerp(std::sqrt(0.07), 1.0, line);
    const Sheen sheen{root * root * root * root};
    const double z = std::max(cosine, 1e-4), x = std::sqrt(1.0 - z * z), lambda_o = sheen.lambda(z);
    double sum = 0.0;
    for (int i = 0; i < kPolar; ++i) {
        const double u = (i + 0.5) / kPolar, zi = u * u, xi = std::sqrt(1.0 - zi * zi);
        const double visible = 2.0 * u / (4.0 * z * (1.0 + lambda_o + sheen.lambda(zi)));
        for (int j = 0; j < kAround; ++j) {
            const double around = 0.5 * kTwoPi * (j + 0.5) / kAround;
            const glm::dvec3 h = glm::normalize(glm::dvec3(x + xi * std::cos(around), xi * std::sin(around), z + zi));
            sum += visible * std::pow(std::max(1.0 - h.z * h.z, 0.0), 0.5 / sheen.alpha);
        }
    }
    // What interpolation misses, up to eight thousandths of it, shall take light away, not make it.
    sum *= 1.008 * (2.0 + 1.0 / sheen.alpha) / (kPolar * kAround);
    return {std::min(sum, 1.0), 1.0 / std::max(sum, 1.0)};
}

template <class Values>
std::vector<glm::vec4> slice_with(Values&& values_at) {
    constexpr uint32_t kCorners = kEnergyCells + 1;
    std::vector<float> values;
    const auto in_16_bits = [](double value) { return static_cast<uint32_t>(std::lround(value * 65535.0)); };
    for (uint32_t i = 0; i < kCorners * kCorners; ++i) {
        const double root = static_cast<double>(i % kCorners) / kEnergyCells;
        const glm::dvec2 value = values_at(root * root, static_cast<double>(i / kCorners) / kEnergyCells);
        values.push_back(std::bit_cast<float>(in_16_bits(value.x) | in_16_bits(value.y) << 16));
    }
    std::vector<glm::vec4> rows;
    for (uint32_t i = 0; i < kEnergyCells * kEnergyCells; ++i) {
        const float* corner = &values[i / kEnergyCells * kCorners + i % kEnergyCells];
        rows.emplace_back(corner[0], corner[1], corner[kCorners], corner[kCorners + 1]);
    }
    return rows;
}

std::vector<glm::vec4> slice_of(const Interface& face) {
    return slice_with([&face](double cosine, double roughness) { return energy(face, cosine, roughness); });
}

const std::vector<glm::vec4>& reflection_slice() {
    static const std::vector<glm::vec4> slice = slice_of({0.0, 1.0, 1.0});
    return slice;
}

// All slices of a stretched lobe; those of strength 0 are one, `round`.
std::vector<glm::vec4> stretched_slices(const Interface& face, const std::vector<glm::vec4>& round) {
    std::vector<glm::vec4> made;
    for (uint32_t i = 0; i < (kEnergyStrengths + 1) * (kEnergyTurns + 1); ++i) {
        const float turn = static_cast<float>(i % (kEnergyTurns + 1)) / kEnergyTurns;
        const float strength = static_cast<float>(i / (kEnergyTurns + 1)) / kEnergyStrengths;
        const auto value_at = [&](double cosine, double roughness) {
            return stretched_energy(face, static_cast<float>(cosine), turn, static_cast<float>(roughness), strength);
        };
        const std::vector<glm::vec4> slice = strength == 0.0f ? round : slice_with(value_at);
        made.insert(made.end(), slice.begin(), slice.end());
    }
    return made;
}

}  // namespace

float bending_ior(const CoreMaterial& material) {
    constexpr float kNearest = 1e-3f;
    if (std::abs(material.ior - 1.0f) >= kNearest) return material.ior;
    return material.ior < 1.0f ? 1.0f - kNearest : 1.0f + kNearest;
}

uint32_t LobeEnergy::sheen_row() {
    if (rows_.empty()) rows_ = reflection_slice();
    if (sheen_row_ != NONE) return sheen_row_;
    sheen_row_ = static_cast<uint32_t>(rows_.size());
    static const std::vector<glm::vec4> all = slice_with(sheen_energy);
    static const std::vector<glm::vec4> grazing =
        slice_with([](double cosine, double line) { return sheen_energy(cosine / 16.0, line); });
    rows_.insert(rows_.end(), all.begin(), all.end());
    rows_.insert(rows_.end(), grazing.begin(), grazing.end());
    return sheen_row_;
}

uint32_t LobeEnergy::stretched_row() {
    if (rows_.empty()) rows_ = reflection_slice();
    if (stretched_row_ != NONE) return stretched_row_;
    stretched_row_ = static_cast<uint32_t>(rows_.size());
    static const std::vector<glm::vec4> slices = stretched_slices({0.0, 1.0, 1.0}, reflection_slice());
    rows_.insert(rows_.end(), slices.begin(), slices.end());
    return stretched_row_;
}

uint32_t LobeEnergy::row_of(const CoreMaterial& material) {
    if (rows_.empty()) rows_ = reflection_slice();
    if (material.thin_walled || !(material.transmission > 0.0f)) return 0;
    const float ior = bending_ior(material);
    const float root = (ior - 1.0f) / (ior + 1.0f);
    const glm::vec3 tinted = glm::min(material.specular_color * (root * root), glm::vec3(1.0f)) * material.specular;
    const float f0 = std::max(tinted.x, std::max(tinted.y, tinted.z));
    const bool stretched = material.anisotropy > 0.0f;
    const auto [place, is_new] =
        known_.try_emplace({ior, f0, material.specular, stretched}, static_cast<uint32_t>(rows_.size()));
    if (!is_new) return place->second;
    std::vector<glm::vec4> stretched_rows;
    for (const double eta : {static_cast<double>(ior), 1.0 / static_cast<double>(ior)}) {
        // Inside, past the critical angle, all is reflected.
        const Interface face{eta, static_cast<double>(f0), eta < 1.0 ? 1.0 : static_cast<double>(material.specular)};
        const std::vector<glm::vec4> slice = slice_of(face);
        rows_.insert(rows_.end(), slice.begin(), slice.end());
        if (!stretched) continue;
        const std::vector<glm::vec4> slices = stretched_slices(face, slice);
        stretched_rows.insert(stretched_rows.end(), slices.begin(), slices.end());
    }
    rows_.insert(rows_.end(), stretched_rows.begin(), stretched_rows.end());
    return place->second;
}

}  // namespace render_system
