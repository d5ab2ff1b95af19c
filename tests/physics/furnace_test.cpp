// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "render_system/texture.h"
#include "tests/physics/photometer.h"

using namespace physics;
using namespace render_system;

namespace {

using Furnace = OnEveryCore;

// A sphere that fills the picture, seen under a sky of radiance 1.
Reading sphere_in_furnace(const char* core, const HostMaterial& material, uint32_t max_path_length) {
    HostScene scene;
    place(scene, sphere_mesh(1.0f, 24, scene.add_material(material)));
    set_sky(scene, 1.0f);
    Exposure exposure;
    exposure.max_path_length = max_path_length;
    exposure.size = 64;
    exposure.samples = 1;
    return measure(core, scene, square_view({0.3f, 0.4f, 3.0f}, {0, 0, 0}, 0.6f), exposure);
}

// A large plane seen at that cosine: all directions above see the sky.
Reading plane_in_furnace(const char* core, const HostMaterial& material, double cosine, uint32_t size = 32) {
    HostScene scene;
    place(scene, quad_mesh({-1000, -1000, 0}, {2000, 0, 0}, {0, 2000, 0}, scene.add_material(material)));
    set_sky(scene, 1.0f);
    double sine = std::sqrt(1.0 - cosine * cosine);
    glm::vec3 eye(static_cast<float>(sine), 0.0f, static_cast<float>(cosine));
    Exposure exposure;
    exposure.size = size;
    return measure(core, scene, square_view(eye, {0, 0, 0}, 0.001f), exposure);
}

HostMaterial glass(float roughness, bool thin) {
    HostMaterial material;
    material.core.metallic = 0.0f;
    material.core.roughness = roughness;
    material.core.transmission = 1.0f;
    material.core.thin_walled = thin;
    return material;
}

TEST_P(Furnace, LambertIsInvisible) {
    Reading reading = sphere_in_furnace(GetParam(), lambert(1.0f), 8);
    EXPECT_NEAR(reading.mean, 1.0, 4.0 * reading.error + 1e-4);
}

// In 8 bits the texture would be 2 % off, the vertices' colour 0.6 %.
TEST_P(Furnace, TexturesOfSixteenBitsAndColoursOfVerticesKeepTheirDepth) {
    HostScene scene;
    Image image;
    image.width = image.height = 1;
    image.shorts = {{0x0523, 0x0523, 0x0523, 65535}};
    HostMaterial material = lambert(1.0f);
    material.core.base_color_texture.texture = scene.add_texture(build_texture(image, TextureRole::color));
    HostMesh plane = quad_mesh({-1000, -1000, 0}, {2000, 0, 0}, {0, 2000, 0}, scene.add_material(material));
    plane.colors.assign(plane.positions.size(), glm::vec4(0.3003f, 0.3003f, 0.3003f, 1.0f));
    plane.colors[0] = glm::vec4(0.3003f);  // alpha, which an opaque material does not read
    place(scene, plane);
    // A mesh of an odd number of vertices before others' rows: nothing of them moves.
    HostMesh corner = plane;
    corner.positions.resize(3);
    corner.normals.resize(3);
    corner.uv0.resize(std::min<size_t>(corner.uv0.size(), 3));
    corner.colors.assign(3, glm::vec4(1.0f));
    corner.triangles.assign(1, {0, 1, 2, corner.triangles[0].w});
    for (glm::vec3& p : corner.positions) p.z = -5.0f;
    place(scene, corner);
    place(scene, plane);
    set_sky(scene, 1.0f);
    const double linear = 0x0523 / 65535.0 / 12.92;  // IEC 61966-2-1, below 0.04045
    const Reading reading =
        measure(GetParam(), scene, square_view({0, 0, 1}, {0, 0, 0.0f}, 0.001f), {.size = 4, .samples = 1});
    EXPECT_NEAR(reading.mean / (0.3003 * linear), 1.0, 1e-4);
}

TEST_P(Furnace, ThePerfectMirrorIsInvisible) {
    HostMaterial mirror;
    mirror.core.roughness = 0.0f;
    Reading reading = sphere_in_furnace(GetParam(), mirror, 8);
    EXPECT_NEAR(reading.mean, 1.0, 4.0 * reading.error + 1e-4);
}

TEST_P(Furnace, SmoothSolidGlassIsInvisibleOnLongPaths) {
    Reading reading = sphere_in_furnace(GetParam(), glass(0.0f, false), 256);
    EXPECT_NEAR(reading.mean, 1.0, 4.0 * reading.error + 2e-4);
}

TEST_P(Furnace, SmoothThinGlassIsInvisibleOnLongPaths) {
    Reading reading = sphere_in_furnace(GetParam(), glass(0.0f, true), 256);
    EXPECT_NEAR(reading.mean, 1.0, 4.0 * reading.error + 2e-4);
}

// The microfacet model in double precision, from the papers and not from the kernels: Walter et al. 2007 for D and
// the refracted lobe, Heitz 2014 for the height-correlated masking of reflection.
struct Microfacets {
    double alpha;
    double f0;
    double ior;

    static double lambda_of(double cosine, double alpha) {
        double tangent2 = (1.0 - cosine * cosine) / (cosine * cosine);
        return 0.5 * (std::sqrt(1.0 + alpha * alpha * tangent2) - 1.0);
    }
    double density(double cosine) const {
        double c2 = cosine * cosine;
        double t = 1.0 + (alpha * alpha - 1.0) * c2;
        return alpha * alpha / (std::numbers::pi * t * t);
    }
    double fresnel(double cosine) const { return f0 + (1.0 - f0) * std::pow(1.0 - cosine, 5.0); }

    /// Integral over the hemisphere of reflection * cosine, with `weight(F)` in place of the Fresnel term.
    double albedo(double cosine, const std::function<double(double)>& weight) const {
        constexpr int N = 600;
        double sine = std::sqrt(1.0 - cosine * cosine);
        double sum = 0.0;
        for (int i = 0; i < N; ++i) {
            double polar = 0.5 * std::numbers::pi * (i + 0.5) / N;
            for (int j = 0; j < N; ++j) {
                double phi = std::numbers::pi * (j + 0.5) / N;  // symmetric in phi
                double zi = std::cos(polar);
                double hx = sine + std::sin(polar) * std::cos(phi);
                double hy = std::sin(polar) * std::sin(phi);
                double hz = cosine + zi;
                double length = std::sqrt(hx * hx + hy * hy + hz * hz);
                double cosine_h = (sine * hx + cosine * hz) / length;
                double masking = 1.0 / (1.0 + lambda_of(cosine, alpha) + lambda_of(zi, alpha));
                sum += weight(fresnel(cosine_h)) * density(hz / length) * masking / (4.0 * cosine) * std::sin(polar);
            }
        }
        return sum * (0.5 * std::numbers::pi / N) * (2.0 * std::numbers::pi / N);
    }
};

// What the tables of a lobe's energy may be off by, always to the dark side.
constexpr double TABLED = 2.5e-3;

TEST_P(Furnace, RoughMetalReflectsItsDirectionalAlbedo) {
    for (double cosine : {0.95, 0.5}) {
        for (float roughness : {0.3f, 0.8f}) {
            HostMaterial metal;
            metal.core.roughness = roughness;
            metal.core.base_color = glm::vec3(0.8f);
            Microfacets model{static_cast<double>(roughness) * roughness, 0.8, 1.5};
            // Scattered once, and what is scattered again: Turquin 2019, equation 16.
            double once = model.albedo(cosine, [](double f) { return f; });
            double white = model.albedo(cosine, [](double) { return 1.0; });
            double truth = once * (1.0 + 0.8 * (1.0 / white - 1.0));
            Reading reading = plane_in_furnace(GetParam(), metal, cosine);
            EXPECT_LE(reading.mean, 1.0);
            EXPECT_NEAR(reading.mean, truth, 4.0 * reading.error + TABLED)
                << "roughness " << roughness << ", " << cosine;
        }
    }
}

TEST_P(Furnace, RoughThinGlassReflectsAndTransmitsItsDirectionalAlbedo) {
    for (double cosine : {0.9, 0.4}) {
        // Reflected and transmitted lobes are mirror images: F and 1 - F add up to the lobe without Fresnel, and what
        // is scattered again to all light.
        Reading reading = plane_in_furnace(GetParam(), glass(0.6f, true), cosine);
        EXPECT_LE(reading.mean, 1.0 + 4.0 * reading.error);
        EXPECT_NEAR(reading.mean, 1.0, 4.0 * reading.error + TABLED) << cosine;
    }
}

TEST_P(Furnace, WhiteMetalOfAnyRoughnessIsInvisible) {
    const bool is_source = GetParam() == std::string("source");  // whose every opening takes half a second
    for (float roughness : is_source ? std::vector{0.8f} : std::vector{0.1f, 0.35f, 0.6f, 0.8f, 1.0f}) {
        HostMaterial metal;
        metal.core.roughness = roughness;
        for (double cosine : {0.95, 0.2}) {
            Reading reading = plane_in_furnace(GetParam(), metal, cosine);
            EXPECT_LE(reading.mean, 1.0 + 4.0 * reading.error) << roughness << ", " << cosine;
            EXPECT_GE(reading.mean, 0.99) << roughness << ", " << cosine;
        }
    }
}

// Light is caught for hundreds of bounces in a ball of index 2.5; where each is a round of dispatches, fewer have to
// do.
TEST_P(Furnace, SolidGlassOfAnyRoughnessAndIndexIsInvisible) {
    const bool is_source = GetParam() == std::string("source");
    const std::vector<float> indices =
        is_source ? std::vector{1.0f, 1.5f} : std::vector{1.0f, 1.0001f, 1.2f, 1.5f, 2.5f};
    for (float ior : indices) {
        for (float roughness : is_source ? std::vector{0.8f} : std::vector{0.05f, 0.2f, 0.5f, 0.8f, 1.0f}) {
            HostMaterial material = glass(roughness, false);
            material.core.ior = ior;
            Reading reading = sphere_in_furnace(GetParam(), material, is_source ? 64 : 1024);
            EXPECT_LE(reading.mean, 1.0 + 4.0 * reading.error) << ior << ", " << roughness;
            EXPECT_GE(reading.mean, 0.99) << ior << ", " << roughness;
        }
    }
}

// Each mixture of metal, glass and white body, over three roughnesses.
std::vector<HostMaterial> mixtures(bool thin) {
    std::vector<HostMaterial> all;
    for (float metallic : {0.0f, 0.5f, 1.0f}) {
        for (float transmission : {0.0f, 0.5f, 1.0f}) {
            for (float roughness : {0.0f, 0.4f, 1.0f}) {
                all.push_back(glass(roughness, thin));
                all.back().core.metallic = metallic;
                all.back().core.transmission = transmission;
            }
        }
    }
    return all;
}

std::string told(const HostMaterial& material, double cosine) {
    return "metallic " + std::to_string(material.core.metallic) + ", transmission " +
           std::to_string(material.core.transmission) + ", roughness " + std::to_string(material.core.roughness) +
           ", thin " + std::to_string(material.core.thin_walled) + ", cosine " + std::to_string(cosine);
}

TEST_P(Furnace, MixturesOfMetalGlassAndBodyAreInvisible) {
    for (bool thin : {true, false}) {
        for (double cosine : {0.9, 0.2}) {
            if (GetParam() == std::string("source")) {
                // Every opening takes half a second: all mixtures in one picture, tiles that fill it.
                HostScene scene;
                float column = 0.0f;
                for (const HostMaterial& material : mixtures(thin)) {
                    place(scene, quad_mesh({-1.0f, column / 13.5f - 1.0f, 0}, {2, 0, 0}, {0, 1.0f / 13.5f, 0},
                                           scene.add_material(material)));
                    column += 1.0f;
                }
                set_sky(scene, 1.0f);
                glm::vec3 eye(static_cast<float>(std::sqrt(1.0 - cosine * cosine)), 0.0f, static_cast<float>(cosine));
                Reading reading =
                    measure("source", scene, square_view(100.0f * eye, {0, 0, 0}, 0.002f), {.size = 54, .samples = 4});
                EXPECT_LE(reading.mean, 1.0 + 4.0 * reading.error) << cosine;
                EXPECT_GE(reading.mean, 0.99) << cosine;
                continue;
            }
            for (const HostMaterial& material : mixtures(thin)) {
                Reading reading = plane_in_furnace(GetParam(), material, cosine, 8);
                EXPECT_LE(reading.mean, 1.0 + 4.0 * reading.error) << told(material, cosine);
                EXPECT_GE(reading.mean, 0.99) << told(material, cosine);
            }
        }
    }
}

// From within as well, and on long paths.
TEST_P(Furnace, BallsOfMixturesAreInvisible) {
    const bool is_source = GetParam() == std::string("source");
    for (float ior : is_source ? std::vector{1.5f} : std::vector{1.2f, 2.5f}) {
        for (float roughness : is_source ? std::vector{1.0f} : std::vector{0.2f, 0.5f, 1.0f}) {
            HostMaterial material = glass(roughness, false);
            material.core.transmission = 0.5f;
            material.core.ior = ior;
            Reading reading = sphere_in_furnace(GetParam(), material, is_source ? 64 : 256);
            EXPECT_LE(reading.mean, 1.0 + 4.0 * reading.error) << ior << ", " << roughness;
            EXPECT_GE(reading.mean, 0.98) << ior << ", " << roughness;
        }
    }
}

// Charlie's sheen in double precision, from Estevez and Kulla 2017 and the extension's text: what one scattering
// returns.
double sheen_albedo(double cosine, double roughness) {
    const double alpha = std::pow(std::max(roughness, 0.07), 2);
    const double t = (1.0 - alpha) * (1.0 - alpha);
    auto fit = [&](double x) {
        double a = 21.5473 + t * 3.7772, b = 3.82987 - t * 0.50552, c = 0.19823 - t * 0.03022;
        double d = -1.97760 + t * 0.70367, e = -4.32054 - t * 0.53913;
        return a / (1.0 + b * std::pow(x, c)) + d * x + e;
    };
    auto lambda = [&](double x) { return std::exp(x < 0.5 ? fit(x) : 2.0 * fit(0.5) - fit(1.0 - x)); };
    constexpr int N = 200;
    const double sine = std::sqrt(1.0 - cosine * cosine);
    double sum = 0.0;
    for (int i = 0; i < N; ++i) {
        const double polar = 0.5 * std::numbers::pi * (i + 0.5) / N, zi = std::cos(polar);
        const double shadow = 1.0 + lambda(cosine) + lambda(zi);
        for (int j = 0; j < N; ++j) {
            const double phi = std::numbers::pi * (j + 0.5) / N;  // symmetric in phi
            const double hx = sine + std::sin(polar) * std::cos(phi), hy = std::sin(polar) * std::sin(phi);
            const double across2 = hx * hx + hy * hy, h2 = across2 + (cosine + zi) * (cosine + zi);
            const double density = (2.0 + 1.0 / alpha) * std::pow(across2 / h2, 0.5 / alpha) / (2.0 * std::numbers::pi);
            sum += density / (4.0 * cosine * shadow) * std::sin(polar);
        }
    }
    return sum * (0.5 * std::numbers::pi / N) * (2.0 * std::numbers::pi / N);
}

// KHR_materials_sheen, "Albedo-scaling technique": over white the sheen and, of what lies below, the share that neither
// direction's sheen has taken. Both directions' shares are at most all there is.
double sheen_over_white(double cosine, double roughness) {
    constexpr int N = 24;
    static std::map<double, std::vector<double>>
        known;  // by roughness: what sheen returns, at equal shares of cosine^2
    std::vector<double>& returned = known[roughness];
    for (int i = static_cast<int>(returned.size()); i < N; ++i)
        returned.push_back(std::min(sheen_albedo(std::sqrt((i + 0.5) / N), roughness), 1.0));
    const double own = std::min(sheen_albedo(cosine, roughness), 1.0);
    double below = 0.0;
    for (double other : returned) below += std::min(1.0 - own, 1.0 - other) / N;
    return own + below;
}

// Over black the lobe alone, over white no more light than there is, down to where it grazes: what the table is off by
// is always to the dark side. Roughnesses and cosines lie in the midst of the table's cells as well as at their ends.
TEST_P(Furnace, SheenTakesItsShareAndMakesNoLight) {
    const bool is_source = GetParam() == std::string("source");
    const std::vector<float> roughnesses =
        is_source ? std::vector{0.078f} : std::vector{0.0f, 0.078f, 0.1f, 0.2f, 0.35f, 0.7f, 0.97f, 1.0f};
    const std::vector<double> cosines =
        is_source ? std::vector{0.07, 0.3} : std::vector{0.003, 0.005, 0.02, 0.05, 0.07, 0.093, 0.3, 0.9};
    for (float roughness : roughnesses) {
        for (double cosine : cosines) {
            HostMaterial cloth = lambert(1.0f);
            cloth.core.sheen_color = glm::vec3(1.0f);
            cloth.core.sheen_roughness = roughness;
            const Reading over_white = plane_in_furnace(GetParam(), cloth, cosine);
            const double truth = sheen_over_white(cosine, static_cast<double>(roughness));
            EXPECT_LE(over_white.mean, 1.0 + 4.0 * over_white.error) << roughness << ", " << cosine;
            EXPECT_NEAR(over_white.mean, truth, 4.0 * over_white.error + 0.016) << roughness << ", " << cosine;
            cloth.core.base_color = glm::vec3(0.0f);
            const Reading alone = plane_in_furnace(GetParam(), cloth, cosine);
            // Where the fit gives more light than there is, what holds it down is tabulated.
            EXPECT_LE(alone.mean, 1.0 + 4.0 * alone.error) << roughness << ", " << cosine;
            EXPECT_NEAR(alone.mean, std::min(sheen_albedo(cosine, roughness), 1.0), 4.0 * alone.error + 0.016)
                << roughness << ", " << cosine;
        }
    }
}

// KHR_materials_clearcoat: over black the lobe alone, of index 1.5; over white all light.
TEST_P(Furnace, ACoatTakesItsShareAndLeavesTheRest) {
    const bool is_source = GetParam() == std::string("source");
    for (float roughness : is_source ? std::vector{0.5f} : std::vector{0.0f, 0.25f, 1.0f}) {
        for (double cosine : is_source ? std::vector{0.3} : std::vector{0.1, 0.95}) {
            HostMaterial lacquer = lambert(1.0f);
            lacquer.core.coat = 0.75f;
            lacquer.core.coat_roughness = roughness;
            const Reading over_white = plane_in_furnace(GetParam(), lacquer, cosine);
            EXPECT_LE(over_white.mean, 1.0 + 4.0 * over_white.error + 1e-6) << roughness << ", " << cosine;
            EXPECT_GE(over_white.mean, 0.99) << roughness << ", " << cosine;
            lacquer.core.base_color = glm::vec3(0.0f);
            const Reading alone = plane_in_furnace(GetParam(), lacquer, cosine);
            const Microfacets model{std::max(static_cast<double>(roughness) * roughness, 2e-3), 0.04, 1.5};
            const double truth =
                roughness > 0.0f ? model.albedo(cosine, [](double f) { return f; }) : model.fresnel(cosine);
            EXPECT_NEAR(alone.mean, 0.75 * truth, 4.0 * alone.error + TABLED) << roughness << ", " << cosine;
        }
    }
}

// Beer and Lambert: a slab of thickness 2 that bends nothing, before a white sky, and with a lamp in its midst. The way
// to the lamp ends at a surface that is not the solid's own.
TEST_P(Furnace, ASolidAbsorbsAlongTheWayThroughIt) {
    for (const bool with_lamp : {false, true}) {
        HostScene scene;
        HostMaterial slab = glass(0.0f, false);
        slab.core.ior = 1.0f;
        slab.core.absorption = glm::vec3(0.5f);
        const uint32_t material = scene.add_material(slab);
        place(scene, quad_mesh({-100, -100, 0}, {200, 0, 0}, {0, 200, 0}, material));
        place(scene, quad_mesh({-100, -100, -2}, {0, 200, 0}, {200, 0, 0}, material));
        if (with_lamp)
            place(scene, quad_mesh({-90, -90, -1}, {180, 0, 0}, {0, 180, 0}, scene.add_material(emitter(1.0f))));
        set_sky(scene, with_lamp ? 0.0f : 1.0f);
        const Reading reading =
            measure(GetParam(), scene, square_view({0, 0, 5}, {0, 0, 0}, 0.001f), {.size = 8, .samples = 1});
        EXPECT_NEAR(reading.mean, std::exp(with_lamp ? -0.5 : -1.0), 4.0 * reading.error + 1e-4) << with_lamp;
    }
}

INSTANTIATE_TEST_SUITE_P(Cores, Furnace, testing::Values("target", "source"),
                         [](const auto& core) { return std::string(core.param); });

}  // namespace
