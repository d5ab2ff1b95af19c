// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/kernels/bsdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <ostream>
#include <vector>

#include "render_system/lobe_energy.h"
#include "target_core/kernels/random.h"

using namespace target_core;
using namespace target_core::kernels;

namespace {

struct Case {
    const char* name;
    float metallic, roughness, specular, transmission, ior;
    bool thin, front;
    float cosine;  // of wo
    float sheen = 0.0f, sheen_roughness = 0.0f;
    float coat = 0.0f, coat_roughness = 0.0f;  // along a normal of its own
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name << ", cosine " << c.cosine; }

Bsdf bsdf_of(const Case& c, vec3 base_color = vec3(1.0f)) {
    settings.features =
        FEATURE_TRANSMISSION | (c.sheen > 0.0f ? FEATURE_SHEEN : 0u) | (c.coat > 0.0f ? FEATURE_COAT : 0u);
    Material material{};
    material.base_color = base_color;
    material.metallic = c.metallic;
    material.roughness = c.roughness;
    material.specular = c.specular;
    material.transmission = c.transmission;
    material.specular_color = vec3(1.0f);
    material.ior = c.ior;
    material.flags = c.thin ? MATERIAL_THIN_WALLED : 0u;
    float sine = std::sqrt(1.0f - c.cosine * c.cosine);
    static render_system::LobeEnergy energies;
    render_system::CoreMaterial core;
    core.transmission = c.transmission;
    core.thin_walled = c.thin;
    core.ior = c.ior;
    core.specular = c.specular;
    material.energy_row = energies.row_of(core);
    material.ior = render_system::bending_ior(core);
    material.sheen_color = vec3(c.sheen);
    material.sheen_roughness = c.sheen_roughness;
    material.sheen_row = energies.sheen_row();
    bound.lobe_energy = reinterpret_cast<const vec4*>(energies.rows().data());
    material.coat = c.coat;
    material.coat_roughness = c.coat_roughness;
    const Bsdf bsdf = make_bsdf(material, vec3(sine * 0.6f, sine * 0.8f, c.cosine), vec3(0.0f, 0.0f, 1.0f), c.front);
    return c.coat > 0.0f ? with_coat(bsdf, material, normalized(vec3(0.2f, -0.1f, 1.0f))) : bsdf;
}

BsdfSample sample_nr(const Bsdf& bsdf, uint i) {
    vec2 u = random_pair(pixel_seed(i, 11), 0, 0);
    vec2 lobe = random_pair(pixel_seed(i, 11), 0, 1);
    return sample_bsdf(bsdf, u, lobe.x);
}

vec3 direction_at(double z, double phi) {
    double sine = std::sqrt(std::max(0.0, 1.0 - z * z));
    return vec3(static_cast<float>(sine * std::cos(phi)), static_cast<float>(sine * std::sin(phi)),
                static_cast<float>(z));
}

// Mean and standard error of the sampling weights (x component) over 16 independent seeds.
struct Estimate {
    double mean, error;
};

Estimate albedo_by_sampling(const Bsdf& bsdf, bool only_rough) {
    constexpr uint PER_SEED = 20000;
    std::vector<double> means;
    for (uint seed = 0; seed < 16; ++seed) {
        double sum = 0.0;
        for (uint i = 0; i < PER_SEED; ++i) {
            BsdfSample s = sample_nr(bsdf, seed * PER_SEED + i);
            bool counts = s.valid && (!only_rough || s.pdf > 0.0f);
            sum += counts ? static_cast<double>(s.weight.x) : 0.0;
        }
        means.push_back(sum / PER_SEED);
    }
    double mean = 0.0;
    for (double m : means) mean += m / 16.0;
    double variance = 0.0;
    for (double m : means) variance += (m - mean) * (m - mean) / 15.0;
    return {mean, std::sqrt(variance / 16.0)};
}

// Integral of f(direction) over the sphere: midpoint rule in (z, phi), z warped so that lobes near the poles and the
// horizon are resolved.
template <class F>
double over_sphere(F&& f) {
    constexpr int NZ = 2400;
    constexpr int NPHI = 720;
    double sum = 0.0;
    for (int i = 0; i < NZ; ++i) {
        double a = std::numbers::pi * (i + 0.5) / NZ;  // polar angle
        for (int j = 0; j < NPHI; ++j) {
            double phi = 2.0 * std::numbers::pi * (j + 0.5) / NPHI;
            sum += f(direction_at(std::cos(a), phi)) * std::sin(a);
        }
    }
    return sum * (std::numbers::pi / NZ) * (2.0 * std::numbers::pi / NPHI);
}

class RoughBsdf : public testing::TestWithParam<Case> {};

TEST_P(RoughBsdf, DensityIntegratesToTheShareOfValidSamples) {
    Bsdf bsdf = bsdf_of(GetParam());
    constexpr uint N = 200000;
    uint valid = 0;
    for (uint i = 0; i < N; ++i) {
        valid += sample_nr(bsdf, i).valid ? 1 : 0;
    }
    double integral = over_sphere([&](vec3 wi) { return static_cast<double>(evaluate_bsdf(bsdf, wi).pdf); });
    double share = static_cast<double>(valid) / N;
    EXPECT_NEAR(integral, share, 4.0 * std::sqrt(share * (1.0 - share) / N) + 2e-3);
}

TEST_P(RoughBsdf, SamplingAgreesWithDensityByChiSquare) {
    Bsdf bsdf = bsdf_of(GetParam());
    constexpr int NZ = 24;
    constexpr int NPHI = 24;
    constexpr uint N = 200000;
    std::vector<double> seen(NZ * NPHI, 0.0);
    for (uint i = 0; i < N; ++i) {
        BsdfSample s = sample_nr(bsdf, i);
        if (s.valid) {
            double a = std::acos(std::clamp(static_cast<double>(s.wi.z), -1.0, 1.0)) / std::numbers::pi;
            double phi = std::atan2(s.wi.y, s.wi.x) / (2.0 * std::numbers::pi);
            phi -= std::floor(phi);
            seen[static_cast<size_t>(std::min(NZ - 1, static_cast<int>(a * NZ)) * NPHI +
                                     std::min(NPHI - 1, static_cast<int>(phi * NPHI)))] += 1.0;
        }
    }
    constexpr int FINE = 24;  // sub-cells a side
    double chi2 = 0.0, pooled_seen = 0.0, pooled_expected = 0.0;
    int freedom = -1;
    for (int i = 0; i < NZ; ++i) {
        for (int j = 0; j < NPHI; ++j) {
            double expected = 0.0;
            for (int k = 0; k < FINE * FINE; ++k) {
                double a = std::numbers::pi * (i + (k / FINE + 0.5) / FINE) / NZ;
                double phi = 2.0 * std::numbers::pi * (j + (k % FINE + 0.5) / FINE) / NPHI;
                expected += static_cast<double>(evaluate_bsdf(bsdf, direction_at(std::cos(a), phi)).pdf) * std::sin(a);
            }
            expected *= N * (std::numbers::pi / NZ) * (2.0 * std::numbers::pi / NPHI) / (FINE * FINE);
            double count = seen[static_cast<size_t>(i * NPHI + j)];
            if (expected < 10.0) {
                pooled_seen += count;
                pooled_expected += expected;
                continue;
            }
            chi2 += (count - expected) * (count - expected) / expected;
            ++freedom;
        }
    }
    if (pooled_expected > 5.0) {
        chi2 += (pooled_seen - pooled_expected) * (pooled_seen - pooled_expected) / pooled_expected;
        ++freedom;
    } else {
        EXPECT_LT(pooled_seen, 5.0 + pooled_expected + 5.0 * std::sqrt(pooled_expected + 1.0));
    }
    // Wilson and Hilferty: the cube root of chi-square over its freedom is nearly normal. 4 sigma.
    double z = (std::cbrt(chi2 / freedom) - (1.0 - 2.0 / (9.0 * freedom))) / std::sqrt(2.0 / (9.0 * freedom));
    EXPECT_LT(z, 4.0) << "chi-square " << chi2 << " at " << freedom;
}

TEST_P(RoughBsdf, AlbedoBySamplingEqualsQuadratureAndIsAtMostOne) {
    Bsdf bsdf = bsdf_of(GetParam());
    double quadrature = over_sphere([&](vec3 wi) { return static_cast<double>(evaluate_bsdf(bsdf, wi).value.x); });
    Estimate sampled = albedo_by_sampling(bsdf, false);
    EXPECT_LE(quadrature, 1.0 + 1e-3);
    EXPECT_NEAR(sampled.mean, quadrature, 4.0 * sampled.error + 2e-3);
}

TEST_P(RoughBsdf, EvaluationEqualsWhatSamplingReturns) {
    Bsdf bsdf = bsdf_of(GetParam(), vec3(0.3f, 0.6f, 0.9f));
    for (uint i = 0; i < 2000; ++i) {
        BsdfSample s = sample_nr(bsdf, i);
        if (s.valid) {
            BsdfValue value = evaluate_bsdf(bsdf, s.wi);
            ASSERT_EQ(value.pdf, s.pdf);
            ASSERT_NEAR(value.value.y / value.pdf, s.weight.y, 1e-5f * std::max(1.0f, s.weight.y));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Models, RoughBsdf,
    testing::Values(Case{"Lambert", 0, 1, 0, 0, 1.5f, true, true, 0.7f},
                    Case{"plastic", 0, 0.4f, 1, 0, 1.5f, true, true, 0.8f},
                    Case{"plastic, grazing", 0, 0.5f, 1, 0, 1.5f, true, true, 0.15f},
                    Case{"metal", 1, 0.3f, 1, 0, 1.5f, true, true, 0.6f},
                    Case{"rough metal, grazing", 1, 1.0f, 1, 0, 1.5f, true, true, 0.1f},
                    Case{"thin rough glass", 0, 0.5f, 1, 1, 1.5f, true, true, 0.7f},
                    Case{"half transmitting wall", 0, 0.6f, 1, 0.5f, 1.5f, true, true, 0.5f},
                    Case{"rough solid glass, entering", 0, 0.5f, 1, 1, 1.5f, false, true, 0.7f},
                    Case{"rough solid glass, leaving", 0, 0.5f, 1, 1, 1.5f, false, false, 0.85f},
                    Case{"sheen on plastic", 0, 0.4f, 1, 0, 1.5f, true, true, 0.6f, 0.8f, 0.4f},
                    Case{"sheen on metal, grazing", 1, 0.5f, 1, 0, 1.5f, true, true, 0.15f, 1, 0.2f},
                    Case{"sheen on glass", 0, 0.5f, 1, 1, 1.5f, false, true, 0.5f, 1, 1},
                    Case{"coat on metal", 1, 0.6f, 1, 0, 1.5f, true, true, 0.6f, 0, 0, 1, 0.3f},
                    Case{"coat on sheen on plastic", 0, 0.4f, 1, 0, 1.5f, true, true, 0.5f, 0.7f, 0.5f, 0.6f, 0.5f},
                    Case{"coat on glass", 0, 0.5f, 1, 1, 1.5f, false, true, 0.7f, 0, 0, 1, 1},
                    Case{"rough solid glass, leaving past the critical angle", 0, 0.4f, 1, 1, 1.5f, false, false,
                         0.4f}));

TEST(SmoothBsdf, LambertMirrorAndGlassConserveEnergyExactly) {
    for (float cosine : {0.05f, 0.3f, 0.7f, 1.0f}) {
        for (const Case& c : {Case{"Lambert", 0, 1, 0, 0, 1.5f, true, true, cosine},
                              Case{"mirror", 1, 0, 1, 0, 1.5f, true, true, cosine}}) {
            Bsdf bsdf = bsdf_of(c);
            for (uint i = 0; i < 1000; ++i) {
                BsdfSample s = sample_nr(bsdf, i);
                ASSERT_TRUE(s.valid) << c;
                ASSERT_NEAR(s.weight.x, 1.0f, 2e-6f) << c;
            }
        }
        for (bool front : {true, false}) {
            for (bool thin : {true, false}) {
                Bsdf bsdf = bsdf_of(Case{"glass", 0, 0, 1, 1, 1.5f, thin, front, cosine});
                EXPECT_NEAR(albedo_by_sampling(bsdf, false).mean, 1.0, 1e-5) << cosine << thin << front;
            }
        }
    }
}

TEST(SmoothBsdf, RefractionFollowsSnell) {
    for (float cosine : {0.2f, 0.5f, 0.9f}) {
        Bsdf bsdf = bsdf_of(Case{"glass", 0, 0, 1, 1, 1.5f, false, true, cosine});
        BsdfSample s = sample_bsdf(bsdf, vec2(0.3f, 0.4f), 0.9999f);
        ASSERT_TRUE(s.valid);
        ASSERT_LT(s.wi.z, 0.0f);
        double sine_in = std::sqrt(1.0 - static_cast<double>(cosine) * cosine);
        double sine_out = std::sqrt(static_cast<double>(s.wi.x) * s.wi.x + static_cast<double>(s.wi.y) * s.wi.y);
        EXPECT_NEAR(sine_in, 1.5 * sine_out, 1e-5);
        EXPECT_LT(s.wi.x * bsdf.wo.x + s.wi.y * bsdf.wo.y, 0.0f) << "on the far side of the normal";
    }
}

TEST(SmoothBsdf, FoldedShadingNormalsLoseNoEnergy) {
    // A shading normal bent by 40 degrees: Lambert directions below the surface are folded back.
    Case c{"Lambert", 0, 1, 0, 0, 1.5f, true, true, 0.9f};
    Bsdf bsdf = bsdf_of(c);
    bsdf.side = normalized(vec3(0.64f, 0.0f, 0.77f));
    double density = over_sphere([&](vec3 wi) { return static_cast<double>(evaluate_bsdf(bsdf, wi).pdf); });
    EXPECT_NEAR(density, 1.0, 2e-3);
    for (uint i = 0; i < 2000; ++i) {
        BsdfSample s = sample_nr(bsdf, i);
        ASSERT_TRUE(s.valid);
        ASSERT_GE(dot(s.wi, bsdf.side), 0.0f);
        ASSERT_NEAR(s.weight.x, 1.0f, 1e-5f);
    }
}

}  // namespace
