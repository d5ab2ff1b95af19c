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
#include "tests/chi_square.h"

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
    float film_thickness = 0.0f;
    float anisotropy = 0.0f;
    float turn = 0.9272952f;  // of wo from x: a cosine of 0.6
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name << ", cosine " << c.cosine; }

Bsdf bsdf_of(const Case& c, vec3 base_color = vec3(1.0f)) {
    settings.features = FEATURE_TRANSMISSION | (c.sheen > 0.0f ? FEATURE_SHEEN : 0u) |
                        (c.coat > 0.0f ? FEATURE_COAT : 0u) | (c.film_thickness > 0.0f ? FEATURE_FILM : 0u) |
                        (c.anisotropy > 0.0f ? FEATURE_ANISOTROPY : 0u);
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
    core.anisotropy = c.anisotropy;
    material.energy_row = energies.row_of(core);
    material.ior = render_system::bending_ior(core);
    material.sheen_color = vec3(c.sheen);
    material.sheen_roughness = c.sheen_roughness;
    material.sheen_row = energies.sheen_row();
    material.anisotropy = c.anisotropy;
    if (c.anisotropy > 0.0f) material.stretched_row = energies.stretched_row();
    bound.lobe_energy = reinterpret_cast<const vec4*>(energies.rows().data());
    material.coat = c.coat;
    material.coat_roughness = c.coat_roughness;
    material.film = 0.75f;
    material.film_ior = 1.3f;
    material.film_thickness = c.film_thickness;
    const vec3 wo(sine * std::cos(c.turn), sine * std::sin(c.turn), c.cosine);
    const Bsdf bsdf = make_bsdf(material, wo, vec3(0.0f, 0.0f, 1.0f), c.front);
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
    constexpr uint N = 200000;
    std::vector<double> seen(chi_square::kCells, 0.0), expected;
    for (uint i = 0; i < N; ++i) {
        BsdfSample s = sample_nr(bsdf, i);
        if (s.valid) seen[chi_square::cell_of(s.wi.x, s.wi.y, s.wi.z)] += 1.0;
    }
    constexpr int FINE = 24;  // sub-cells a side
    for (int cell = 0; cell < chi_square::kCells; ++cell) {
        double sum = 0.0;
        for (int k = 0; k < FINE * FINE; ++k) {
            const double a =
                std::numbers::pi * (cell / chi_square::kTurnCells + (k / FINE + 0.5) / FINE) / chi_square::kPolarCells;
            const double phi = 2.0 * std::numbers::pi * (cell % chi_square::kTurnCells + (k % FINE + 0.5) / FINE) /
                               chi_square::kTurnCells;
            sum += static_cast<double>(evaluate_bsdf(bsdf, direction_at(std::cos(a), phi)).pdf) * std::sin(a);
        }
        expected.push_back(sum * N * chi_square::kCellArea / (FINE * FINE));
    }
    chi_square::expect_agreement(seen, expected);
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
                    Case{"film on thin glass", 0.3f, 0.5f, 1, 0.5f, 1.5f, true, true, 0.6f, 0, 0, 0, 0, 380},
                    Case{"film on solid glass", 0, 0.5f, 1, 1, 1.5f, false, true, 0.6f, 0, 0, 0, 0, 380},
                    Case{"brushed metal", 1, 0.3f, 1, 0, 1.5f, true, true, 0.6f, 0, 0, 0, 0, 0, 0.7f},
                    Case{"brushed thin glass under a coat, grazing", 0, 0.5f, 1, 0.5f, 1.5f, true, true, 0.2f, 0, 0, 1,
                         0.3f, 0, 1},
                    Case{"brushed solid glass, entering", 0, 0.3f, 1, 1, 1.5f, false, true, 0.6f, 0, 0, 0, 0, 0, 0.7f},
                    Case{"brushed solid glass, leaving", 0, 0.4f, 1, 1, 1.5f, false, false, 0.8f, 0, 0, 0, 0, 0, 0.5f},
                    Case{"rough solid glass, leaving past the critical angle", 0, 0.4f, 1, 1, 1.5f, false, false, 0.4f},
                    Case{"rough solid of index 1.1", 0, 0.8f, 1, 1, 1.1f, false, true, 0.6f},
                    Case{"rough solid of index 1.2, leaving", 0, 0.5f, 1, 1, 1.2f, false, false, 0.5f},
                    Case{"rough diamond under sheen, entering", 0, 0.5f, 1, 1, 2.5f, false, true, 0.4f, 0.8f, 0.5f},
                    Case{"rough diamond, leaving", 0, 0.5f, 1, 0.7f, 2.5f, false, false, 0.95f},
                    Case{"filmed plastic of index 2.5 under a coat", 0, 0.5f, 1, 0, 2.5f, true, true, 0.6f, 0, 0, 0.7f,
                         0.4f, 380}));

// GGX stretched along x in double precision, from the papers and not from the kernels: Burley 2012 for its density,
// Heitz 2014, "Understanding the Masking-Shadowing Function", for the masking, with the two roughnesses of
// KHR_materials_anisotropy.
struct StretchedGgx {
    double along, across;

    StretchedGgx(double roughness, double strength)
        : along(std::lerp(roughness * roughness, 1.0, strength * strength)), across(roughness * roughness) {}
    double lambda(double x, double y, double z) const {
        const double slopes = (along * along * x * x + across * across * y * y) / (z * z);
        return 0.5 * (std::sqrt(1.0 + slopes) - 1.0);
    }
    double density(double x, double y, double z) const {
        const double sum = std::pow(x / along, 2) + std::pow(y / across, 2) + z * z;
        return 1.0 / (std::numbers::pi * along * across * sum * sum);
    }
    // What one scattering of a white metal returns of the light from that direction, over slopes of equal share.
    double returned(double cosine, double turn) const {
        constexpr int N = 160;
        const double sine = std::sqrt(1.0 - cosine * cosine), x = sine * std::cos(turn), y = sine * std::sin(turn);
        double sum = 0.0;
        for (int i = 0; i < N; ++i) {
            const double u = (i + 0.5) / N, slope = std::sqrt(u / (1.0 - u));
            for (int j = 0; j < N; ++j) {
                const double around = 2.0 * std::numbers::pi * (j + 0.5) / N;
                const double hx = -along * slope * std::cos(around), hy = -across * slope * std::sin(around);
                const double squared = 1.0 + hx * hx + hy * hy, wo_h = x * hx + y * hy + cosine;
                const double f = 2.0 * wo_h / squared, ix = f * hx - x, iy = f * hy - y, iz = f - cosine;
                if (wo_h <= 0.0 || iz <= 0.0) continue;
                sum += wo_h / cosine / (1.0 + lambda(x, y, cosine) + lambda(ix, iy, iz));
            }
        }
        return sum / (N * N);
    }
};

TEST(StretchedBsdf, IsTheLobeOfTheExtension) {
    for (float turn : {0.0f, 0.7f, 1.5f}) {
        Case c{"brushed metal", 1, 0.4f, 1, 0, 1.5f, true, true, 0.5f};
        c.anisotropy = 0.6f;
        c.turn = turn;
        const Bsdf bsdf = bsdf_of(c);
        const StretchedGgx model(0.4, 0.6);
        const double along = model.lambda(bsdf.wo.x, bsdf.wo.y, bsdf.wo.z);
        for (uint i = 0; i < 200; ++i) {
            const vec3 wi = direction_at(0.02 + 0.0049 * i, 2.4 * i);
            const vec3 h = normalized(bsdf.wo + wi);
            const double masking = 1.0 / (1.0 + along + model.lambda(wi.x, wi.y, wi.z));
            const double once = model.density(h.x, h.y, h.z) * masking / (4.0 * static_cast<double>(bsdf.wo.z));
            const double again = static_cast<double>(bsdf.again_reflected.x * wi.z) / std::numbers::pi;
            ASSERT_NEAR(static_cast<double>(evaluate_bsdf(bsdf, wi).value.x), once + again, 2e-5 * (once + 1.0))
                << turn;
        }
    }
}

TEST(StretchedBsdf, RefractsThroughTheSameMicrofacets) {
    for (bool front : {true, false}) {
        Case c{"brushed glass", 0, 0.4f, 1, 1, 1.5f, false, front, 0.8f};
        c.anisotropy = 0.6f;
        c.turn = 0.7f;
        const Bsdf bsdf = bsdf_of(c);
        const StretchedGgx model(0.4, 0.6);
        const double eta = front ? 1.5 : 1.0 / 1.5;
        const glm::dvec3 wo(bsdf.wo.x, bsdf.wo.y, bsdf.wo.z);
        int met = 0;
        for (uint i = 0; i < 200; ++i) {
            const vec3 wi = direction_at(-0.02 - 0.0049 * i, 2.4 * i);
            // Walter et al. 2007, equations 16 and 21, with Heitz's separate masking on either side.
            const glm::dvec3 to(wi.x, wi.y, wi.z), h = -glm::normalize((wo + eta * to) * (eta > 1.0 ? 1.0 : -1.0));
            const double wo_h = glm::dot(wo, h), to_h = glm::dot(to, h);
            if (wo_h <= 0.0 || to_h >= 0.0 || h.z <= 0.0) continue;
            const double masking =
                1.0 / ((1.0 + model.lambda(wo.x, wo.y, wo.z)) * (1.0 + model.lambda(to.x, to.y, to.z)));
            const double larger = eta > 1.0 ? wo_h : -to_h;
            const double passed = 0.96 * (1.0 - std::pow(1.0 - larger, 5.0));
            const double once = passed * model.density(h.x, h.y, h.z) * masking * eta * eta * -to_h * wo_h /
                                (wo.z * std::pow(wo_h + eta * to_h, 2.0));
            const double again = static_cast<double>(bsdf.again_transmitted.x * -wi.z) / std::numbers::pi;
            ASSERT_NEAR(static_cast<double>(evaluate_bsdf(bsdf, wi).value.x), once + again, 1e-4 * (once + 1.0));
            ++met;
        }
        EXPECT_GT(met, 20);
    }
}

// The table that it stands in is off by a tenth of a per cent on average, most where light grazes.
TEST(StretchedBsdf, GivesBackWhatItsMicrofacetsKeep) {
    double errors = 0.0;
    int cases = 0;
    for (float roughness : {0.15f, 0.4f, 0.8f}) {
        for (float strength : {0.3f, 0.65f, 1.0f}) {
            for (float turn : {0.1f, 0.8f, 1.5f}) {
                for (float cosine : {0.15f, 0.5f, 0.95f}) {
                    Case c{"brushed metal", 1, roughness, 1, 0, 1.5f, true, true, cosine};
                    c.anisotropy = strength;
                    c.turn = turn;
                    const StretchedGgx model(static_cast<double>(roughness), static_cast<double>(strength));
                    const double kept = 1.0 - model.returned(static_cast<double>(cosine), static_cast<double>(turn));
                    const double given_back = static_cast<double>(bsdf_of(c).again_reflected.x);
                    EXPECT_NEAR(given_back, kept, 0.013)
                        << roughness << " " << strength << " " << turn << " " << cosine;
                    errors += std::abs(given_back - kept);
                    ++cases;
                }
            }
        }
    }
    EXPECT_LT(errors / cases, 2.5e-3);
}

// Charlie's sheen in double precision: the density of Estevez and Kulla 2017, "Production Friendly Microfacet Sheen
// BRDF", its shadowing by their fit (the table's two rows), and by KHR_materials_sheen alpha as the roughness squared.
struct Charlie {
    double alpha;

    explicit Charlie(double roughness) : alpha(roughness * roughness) {}
    double fit(double x) const {
        const double rows[2][5] = {{25.3245, 3.32435, 0.16801, -1.27393, -4.85967},
                                   {21.5473, 3.82987, 0.19823, -1.97760, -4.32054}};
        const double between = (1.0 - alpha) * (1.0 - alpha);
        double p[5];
        for (int i = 0; i < 5; ++i) p[i] = between * rows[0][i] + (1.0 - between) * rows[1][i];
        return p[0] / (1.0 + p[1] * std::pow(x, p[2])) + p[3] * x + p[4];
    }
    double lambda(double x) const { return std::exp(x < 0.5 ? fit(x) : 2.0 * fit(0.5) - fit(1.0 - x)); }
    // Times the cosine of `to`.
    double value(const glm::dvec3& from, const glm::dvec3& to) const {
        const glm::dvec3 h = glm::normalize(from + to);
        const double sine = std::sqrt(std::max(0.0, 1.0 - h.z * h.z));
        const double density = (2.0 + 1.0 / alpha) * std::pow(sine, 1.0 / alpha) / (2.0 * std::numbers::pi);
        return density / (4.0 * from.z * (1.0 + lambda(from.z) + lambda(to.z)));
    }
    double returned(double cosine) const {
        constexpr int N = 120;
        const glm::dvec3 from(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
        double sum = 0.0;
        for (int i = 0; i < N; ++i) {
            const double polar = 0.5 * std::numbers::pi * (i + 0.5) / N;
            for (int j = 0; j < N; ++j) {
                const double phi = 2.0 * std::numbers::pi * (j + 0.5) / N, sine = std::sin(polar);
                sum += value(from, {sine * std::cos(phi), sine * std::sin(phi), std::cos(polar)}) * sine;
            }
        }
        return sum * (0.5 * std::numbers::pi / N) * (2.0 * std::numbers::pi / N);
    }
};

// KHR_materials_sheen: the lobe, and of what is below the share that neither direction's sheen has taken.
TEST(Sheen, IsTheLobeOfTheExtensionOverWhatItLeavesOfTheRest) {
    constexpr uint DIRECTIONS = 40;
    const auto z_of = [](uint i) { return 0.25 + 0.018 * i; };
    for (float roughness : {0.3f, 0.6f, 1.0f}) {
        const Charlie model(static_cast<double>(roughness));
        std::vector<double> left_there;
        for (uint i = 0; i < DIRECTIONS; ++i) left_there.push_back(1.0 - 0.8 * model.returned(z_of(i)));
        for (float cosine : {0.4f, 0.7f, 0.95f}) {
            Case c{"cloth over white", 0, 1, 0, 0, 1.5f, true, true, cosine};
            c.sheen = 0.8f;
            c.sheen_roughness = roughness;
            const Bsdf over_white = bsdf_of(c);
            const Bsdf alone = bsdf_of(c, vec3(0.0f));
            const glm::dvec3 wo(alone.wo.x, alone.wo.y, alone.wo.z);
            const double left = 1.0 - 0.8 * model.returned(wo.z);
            for (uint i = 0; i < DIRECTIONS; ++i) {
                const vec3 wi = direction_at(z_of(i), 2.4 * i);
                const glm::dvec3 to(wi.x, wi.y, wi.z);
                const double lobe = 0.8 * model.value(wo, to);
                ASSERT_NEAR(static_cast<double>(evaluate_bsdf(alone, wi).value.x), lobe, 2e-5 * (lobe + 1.0)) << c;
                const double below = std::min(left, left_there[i]) * to.z / std::numbers::pi;
                ASSERT_NEAR(static_cast<double>(evaluate_bsdf(over_white, wi).value.x), lobe + below, 2e-3) << c;
            }
        }
    }
}

// The evaluation that KHR_materials_iridescence gives as its reference, in double precision and by its own names.
double film_reference(double f0, double ior, double thickness, double cos1, int channel) {
    const auto sq = [](double x) { return x * x; };
    const auto fresnel = [](double r0, double c) { return r0 + (1.0 - r0) * std::pow(1.0 - c, 5.0); };
    const double cos2 = std::sqrt(1.0 - (1.0 - sq(cos1)) / sq(ior));
    const double R12 = fresnel(sq((ior - 1.0) / (ior + 1.0)), cos1), T121 = 1.0 - R12;
    const double base_ior = (1.0 + std::sqrt(f0)) / (1.0 - std::sqrt(f0));
    const double R23 = fresnel(sq((base_ior - ior) / (base_ior + ior)), cos2);
    const double phi = std::numbers::pi + (base_ior < ior ? std::numbers::pi : 0.0);
    const double R123 = R12 * R23, Rs = sq(T121) * R23 / (1.0 - R123);
    double sum = R12 + Rs, Cm = Rs - T121;
    for (int m = 1; m <= 2; ++m) {
        Cm *= std::sqrt(R123);
        const double phase = 2.0 * std::numbers::pi * m * 2.0 * ior * thickness * cos2 * 1e-9;
        const double val[] = {5.4856e-13, 4.4201e-13, 5.2481e-13}, pos[] = {1.6810e6, 1.7953e6, 2.2084e6};
        const double var[] = {4.3278e9, 9.3046e9, 6.6121e9};
        double xyz[3];
        for (int i = 0; i < 3; ++i) {
            xyz[i] = val[i] * std::sqrt(2.0 * std::numbers::pi * var[i]) * std::cos(pos[i] * phase + m * phi) *
                     std::exp(-sq(phase) * var[i]);
        }
        xyz[0] += 9.7470e-14 * std::sqrt(2.0 * std::numbers::pi * 4.5282e9) * std::cos(2.2399e6 * phase + m * phi) *
                  std::exp(-4.5282e9 * sq(phase));
        const double to_rgb[3][3] = {{3.2404542, -1.5371385, -0.4985314},
                                     {-0.9692660, 1.8760108, 0.0415560},
                                     {0.0556434, -0.2040259, 1.0572252}};
        const double* row = to_rgb[channel];
        sum += Cm * 2.0 * (row[0] * xyz[0] + row[1] * xyz[1] + row[2] * xyz[2]) / 1.0685e-7;
    }
    return sum;
}

TEST(Film, ReflectsWhatTheExtensionsReferenceReflects) {
    for (float thickness : {100.0f, 280.0f, 550.0f, 1200.0f}) {
        for (float f0 : {0.02f, 0.3f, 0.9f}) {
            for (float cosine : {0.3f, 0.7f, 1.0f}) {
                Material material{};
                material.film = 1.0f;
                material.film_ior = 1.4f;
                material.film_thickness = thickness;
                const vec3 normal = film_f0(vec3(f0), material, cosine);
                const double weight = std::pow(1.0 - static_cast<double>(cosine), 5.0);
                const float got[] = {normal.x, normal.y, normal.z};
                for (int channel = 0; channel < 3; ++channel) {
                    const double truth = film_reference(static_cast<double>(f0), 1.4, thickness, cosine, channel);
                    const double truth_f0 = std::clamp((truth - weight) / (1.0 - weight), 0.0, 1.0);
                    EXPECT_NEAR(got[channel], truth_f0, 2e-5) << thickness << " " << f0 << " " << cosine;
                }
            }
        }
    }
}

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
