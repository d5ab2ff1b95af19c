// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/physics/photometer.h"

using namespace physics;
using namespace render_system;

namespace {

using Lighting = OnEveryCore;

constexpr float ALBEDO = 0.6f;

HostScene lit_plane() {
    HostScene scene;
    place(scene, quad_mesh({-50, -50, 0}, {100, 0, 0}, {0, 100, 0}, scene.add_material(lambert(ALBEDO))));
    return scene;
}

// Reads the plane's radiance at `at`, from above and aside.
Reading read_at(const char* core, const HostScene& scene, const glm::vec3& at, bool next_event_estimation = true) {
    Exposure exposure;
    exposure.size = 32;
    exposure.max_path_length = 2;
    exposure.next_event_estimation = next_event_estimation;
    return measure(core, scene, square_view(at + glm::vec3(-2.0f, 0.5f, 1.0f), at, 0.0005f), exposure);
}

// Irradiance from a polygon of radiance 1 at the origin with normal +z: Lambert's formula (1760), as in Arvo 1995.
double polygon_irradiance(const std::vector<glm::dvec3>& corners) {
    double sum = 0.0;
    for (size_t i = 0; i < corners.size(); ++i) {
        glm::dvec3 a = glm::normalize(corners[i]);
        glm::dvec3 b = glm::normalize(corners[(i + 1) % corners.size()]);
        sum += std::acos(glm::dot(a, b)) * glm::normalize(glm::cross(a, b)).z;
    }
    return std::fabs(0.5 * sum);
}

TEST_P(Lighting, LambertUnderAQuadLightHasTheClosedForm) {
    HostScene scene = lit_plane();
    uint32_t light = scene.add_material(emitter(5.0f));
    // Faces down: u x v = -z.
    place(scene, quad_mesh({-1, -1, 2}, {0, 2, 0}, {3, 0, 0.5f}, light));
    for (glm::vec3 at : {glm::vec3(0, 0, 0), glm::vec3(1.5f, -2.0f, 0)}) {
        std::vector<glm::dvec3> corners = {{-1, -1, 2}, {-1, 1, 2}, {2, 1, 2.5}, {2, -1, 2.5}};
        for (glm::dvec3& corner : corners) {
            corner -= glm::dvec3(at);
        }
        double truth = static_cast<double>(ALBEDO) / std::numbers::pi * 5.0 * polygon_irradiance(corners);
        for (bool nee : {true, false}) {
            Reading reading = read_at(GetParam(), scene, at, nee);
            EXPECT_NEAR(reading.mean, truth, 4.0 * reading.error + 1e-4 * truth) << "next event estimation " << nee;
        }
    }
}

TEST_P(Lighting, EmittersShineOnTheirFrontOnly) {
    for (bool double_sided : {false, true}) {
        HostScene scene = lit_plane();
        HostMaterial material = emitter(5.0f);
        material.core.double_sided = double_sided;
        // Faces up, away from the plane.
        place(scene, quad_mesh({-1, -1, 2}, {2, 0, 0}, {0, 2, 0}, scene.add_material(material)));
        Reading reading = read_at(GetParam(), scene, {0, 0, 0});
        double truth = double_sided ? static_cast<double>(ALBEDO) / std::numbers::pi * 5.0 *
                                          polygon_irradiance({{-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}})
                                    : 0.0;
        EXPECT_NEAR(reading.mean, truth, 4.0 * reading.error + 1e-4 * truth);
    }
}

TEST_P(Lighting, PointSpotAndDirectionalLightsFollowTheirDefinition) {
    PunctualLight light;
    light.position = {1.0f, 0.0f, 2.0f};
    light.emission = glm::vec3(10.0f);
    double distance2 = 5.0;
    double cosine = 2.0 / std::sqrt(distance2);
    {
        HostScene scene = lit_plane();
        light.kind = LightKind::point;
        scene.add_punctual_light(light);
        Reading reading = read_at(GetParam(), scene, {0, 0, 0});
        double truth = static_cast<double>(ALBEDO) / std::numbers::pi * 10.0 * cosine / distance2;
        EXPECT_NEAR(reading.mean, truth, 4.0 * reading.error + 1e-3 * truth) << "point";
    }
    {
        HostScene scene = lit_plane();
        light.kind = LightKind::spot;
        light.direction = {0.0f, 0.0f, -1.0f};
        light.inner_cone = 0.2f;
        light.outer_cone = 0.8f;
        scene.add_punctual_light(light);
        Reading reading = read_at(GetParam(), scene, {0, 0, 0});
        double inside = (cosine - std::cos(0.8)) / (std::cos(0.2) - std::cos(0.8));
        double truth = static_cast<double>(ALBEDO) / std::numbers::pi * 10.0 * inside * inside * cosine / distance2;
        EXPECT_NEAR(reading.mean, truth, 4.0 * reading.error + 1e-3 * truth) << "spot";
        EXPECT_EQ(read_at(GetParam(), scene, {8, 0, 0}).mean, 0.0) << "outside the cone";
    }
    {
        HostScene scene = lit_plane();
        light.kind = LightKind::directional;
        light.direction = glm::normalize(glm::vec3(0.5f, 0.0f, -1.0f));
        scene.add_punctual_light(light);
        Reading reading = read_at(GetParam(), scene, {0, 0, 0});
        double truth = static_cast<double>(ALBEDO) / std::numbers::pi * 10.0 * (1.0 / std::sqrt(1.25));
        EXPECT_NEAR(reading.mean, truth, 4.0 * reading.error + 1e-3 * truth) << "directional";
    }
}

TEST_P(Lighting, BlendedSurfacesLetTheirShareOfRaysPass) {
    // A black veil of alpha 0.3 in front of a wall of radiance 1: 0.7 of it comes through.
    HostScene scene;
    HostMaterial veil = lambert(0.0f);
    veil.core.opaque = false;
    veil.core.alpha = 0.3f;
    place(scene, quad_mesh({-5, -5, 1}, {10, 0, 0}, {0, 10, 0}, scene.add_material(veil)));
    set_sky(scene, 1.0f);
    Exposure exposure;
    exposure.size = 32;
    Reading reading = measure(GetParam(), scene, square_view({0, 0, 3}, {0, 0, 0}, 0.3f), exposure);
    EXPECT_NEAR(reading.mean, 0.7, 4.0 * reading.error + 1e-4);
}

// Each set names another texel of a texture of four. Where the texel that the third set names is clear, the wall behind
// is seen, whose mesh has no coordinates at all but one.
TEST_P(Lighting, EachOfFourSetsOfCoordinatesIsRead) {
    const bool is_source = GetParam() == std::string("source");  // whose every opening takes half a second
    for (const uint32_t set : is_source ? std::vector{3u} : std::vector{0u, 1u, 2u, 3u}) {
        for (const bool masked : {false, true}) {
            HostScene scene;
            HostTexture texture;
            texture.width = 4;
            texture.height = 1;
            texture.nearest = true;
            texture.texels = {0xFF333333u, 0xFF666666u, 0x00999999u, 0xFFFFFFFFu};
            HostMaterial glow = emitter(1.0f);
            glow.core.emission_texture.texture = scene.add_texture(texture);
            glow.core.emission_texture.uv_set = set;
            if (masked) {
                glow.core.opaque = false;
                glow.core.alpha_cutoff = 0.5f;
                glow.core.base_color_texture.texture = glow.core.emission_texture.texture;
                glow.core.base_color_texture.uv_set = 2;
            }
            HostMesh quad = quad_mesh({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}, scene.add_material(glow));
            std::vector<glm::vec2>* const sets[] = {&quad.uv0, &quad.uv1, &quad.uv2, &quad.uv3};
            for (int k = 0; k < 4; ++k)
                sets[k]->assign(quad.positions.size(), {0.25f * static_cast<float>(k) + 0.125f, 0.5f});
            place(scene, quad);
            HostMesh wall = quad_mesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, scene.add_material(emitter(5.0f)));
            wall.uv1.clear();
            place(scene, wall);
            const double levels[] = {0.2, 0.4, 0.6, 1.0};
            const Reading reading = measure(GetParam(), scene, square_view({0, 0, 3}, {0, 0, 0}, 0.1f),
                                            {.size = 8, .samples = 1, .max_path_length = 1});
            EXPECT_NEAR(reading.mean, masked ? 5.0 : levels[set], 1e-6) << set << ", " << masked;
        }
    }
}

TEST_P(Lighting, OneSegmentShowsEmittersAndSkyOnly) {
    HostScene scene = lit_plane();
    uint32_t light = scene.add_material(emitter(5.0f));
    place(scene, quad_mesh({-0.5f, -0.5f, 0.5f}, {1, 0, 0}, {0, 1, 0}, light));
    set_sky(scene, 0.25f);
    Exposure exposure;
    exposure.max_path_length = 1;
    EXPECT_FLOAT_EQ(
        static_cast<float>(measure(GetParam(), scene, square_view({0, 0, 3}, {0, 0, 0}, 0.1f), exposure).mean), 5.0f);
    EXPECT_EQ(measure(GetParam(), scene, square_view({5, 0, 3}, {5, 0, 0}, 0.1f), exposure).mean, 0.0);
    EXPECT_FLOAT_EQ(
        static_cast<float>(measure(GetParam(), scene, square_view({0, 0, 3}, {0, 0, 9}, 0.1f), exposure).mean), 0.25f);
}

// Inside a glowing white ball a path of k segments brings albedo^(k - 1) times its radiance, whichever way it takes.
TEST_P(Lighting, AClampHoldsWhatEachIndirectPathBrings) {
    HostScene scene;
    HostMaterial material = lambert(0.8f);
    material.core.emission = glm::vec3(1.0f);
    material.core.double_sided = true;
    place(scene, sphere_mesh(1.0f, 24, scene.add_material(material)));
    // On the source core each measurement is a second; what it adds is the same text.
    const bool is_source = GetParam() == std::string("source");
    for (const bool next_event_estimation : is_source ? std::vector{false} : std::vector{false, true}) {
        Exposure exposure;
        exposure.max_path_length = 6;
        exposure.samples = 1;
        exposure.next_event_estimation = next_event_estimation;
        const ViewPyramid view = square_view({0, 0, 0}, {0, 0, 1}, 1.0f);
        const double all = measure(GetParam(), scene, view, exposure).mean;
        exposure.indirect_limit = 1e6f;
        EXPECT_EQ(measure(GetParam(), scene, view, exposure).mean, all) << "out of reach";
        exposure.indirect_limit = 0.5f;
        const Reading clamped = measure(GetParam(), scene, view, exposure);
        if (next_event_estimation) {
            EXPECT_LT(clamped.mean, all) << "two ways to each light are held apart";
            continue;
        }
        EXPECT_NEAR(all, 1.0 + 0.8 + 0.64 + 0.512 + 0.4096 + 0.32768, 1e-4);
        EXPECT_NEAR(clamped.mean, 1.0 + 0.8 + 0.5 + 0.5 + 0.4096 + 0.32768, 1e-4);
    }
}

// A lens of radius A, sharp at D, spreads a point at distance z over a disc: seen through the middle of the picture,
// from the lens's point p the plane of the point is met at p (1 - z/D), so that light from up to A |1 - z/D| aside
// arrives.
TEST_P(Lighting, AThinLensHasItsCircleOfConfusion) {
    constexpr double A = 0.25, D = 4.0, SIDE = 0.05;
    const bool is_source = GetParam() == std::string("source");  // whose every opening takes half a second
    for (double z : is_source ? std::vector{10.0} : std::vector{2.0, 4.0, 10.0}) {
        const double circle = A * std::fabs(1.0 - z / D);
        const bool sharp = circle == 0.0;
        const double expected = sharp ? 1.0 : SIDE * SIDE / (std::numbers::pi * circle * circle);
        for (double aside : {sharp ? 0.1 * SIDE : 0.6 * circle, 1.2 * circle + SIDE}) {
            HostScene scene;
            const float corner = static_cast<float>(aside - SIDE / 2);
            place(scene,
                  quad_mesh({corner, -SIDE / 2, -z}, {SIDE, 0, 0}, {0, SIDE, 0}, scene.add_material(emitter(1))));
            Camera camera;
            camera.vertical_fov = 1e-5f;
            camera.aperture = A;
            camera.focus = D;
            Exposure exposure;
            exposure.size = 32;
            exposure.max_path_length = 1;
            const Reading reading = measure(GetParam(), scene, view_pyramid(camera, 32, 32), exposure);
            const double truth = aside > circle + SIDE / 2 ? 0.0 : expected;
            EXPECT_NEAR(reading.mean, truth, 4.0 * reading.error + 1e-6) << "at " << z << ", aside " << aside;
        }
    }
}

// However far off: a square of side 1 in a picture 4 high covers a sixteenth of it.
TEST_P(Lighting, AnOrthographicCameraSeesSizesWhateverTheirDistance) {
    for (float z : {0.5f, 50.0f}) {
        HostScene scene;
        place(scene, quad_mesh({0.25f, -0.5f, -z}, {1, 0, 0}, {0, 1, 0}, scene.add_material(emitter(1))));
        Camera camera;
        camera.parallel_height = 4.0f;
        Exposure exposure;
        exposure.size = 32;
        exposure.max_path_length = 1;
        const Reading reading = measure(GetParam(), scene, view_pyramid(camera, 32, 32), exposure);
        EXPECT_NEAR(reading.mean, 1.0 / 16.0, 4.0 * reading.error + 1e-6) << z;
        if (GetParam() == std::string("source")) break;  // whose every opening takes half a second
    }
}

// In either order, of meshes with one instance and of such with two.
TEST_P(Lighting, OfTwoSurfacesInOnePlaceTheLowerInstanceIsSeen) {
    for (const float lower : {1.0f, 3.0f}) {
        for (const bool again : {false, true}) {
            HostScene scene;
            for (const float radiance : {lower, 4.0f - lower}) {
                const uint32_t mesh = scene.add_mesh(
                    quad_mesh({-1, -1, 0.3f}, {2, 0.1f, 0}, {0, 2, 0.2f}, scene.add_material(emitter(radiance))));
                scene.add_instance(mesh, CoreTransform());
                CoreTransform behind;
                behind.rows[2].w = 20.0f;
                if (again) scene.add_instance(mesh, behind);
            }
            const Reading reading = measure(GetParam(), scene, square_view({0, 0, 5}, {0, 0, 0}, 0.2f),
                                            {.size = 32, .samples = 1, .max_path_length = 1});
            EXPECT_EQ(reading.mean, static_cast<double>(lower)) << again;
        }
    }
}

// A plane cut into count * count quads.
HostMesh cut_plane(const glm::vec3& corner, const glm::vec3& edge_u, const glm::vec3& edge_v, int count,
                   uint32_t material) {
    HostMesh mesh;
    const auto n = static_cast<float>(count);
    for (int i = 0; i < count * count; ++i) {
        const glm::vec3 at =
            edge_u * (static_cast<float>(i % count) / n) + edge_v * (static_cast<float>(i / count) / n);
        const HostMesh quad = quad_mesh(corner + at, edge_u / n, edge_v / n, material);
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), quad.positions.begin(), quad.positions.end());
        mesh.normals.insert(mesh.normals.end(), quad.normals.begin(), quad.normals.end());
        mesh.uv0.insert(mesh.uv0.end(), quad.uv0.begin(), quad.uv0.end());
        mesh.uv1.insert(mesh.uv1.end(), quad.uv1.begin(), quad.uv1.end());
        for (const glm::uvec4& t : quad.triangles) mesh.triangles.push_back(t + glm::uvec4(first, first, first, 0));
    }
    return mesh;
}

// Two slanted planes, one within the other's, cut into triangles otherwise: without a rule either shows, by rounding.
TEST_P(Lighting, OfTwoSurfacesCutOtherwiseTheLowerInstanceIsSeenWhereverBothAre) {
    const glm::vec3 u(0.8f, 0.1f, -0.5f), v(0.03f, 0.9f, 0.3f), middle(0.37f, -0.21f, 0.3f);
    const Exposure exposure{.size = 32, .samples = 1, .max_path_length = 1};
    const ViewPyramid view = square_view({0, 0, 6}, middle, 0.1f);
    for (const float lower : {1.0f, 3.0f}) {
        HostScene scene;
        const float lower_half = lower == 1.0f ? 2.0f : 1.7f;
        const float upper_half = lower == 1.0f ? 1.3f : 2.0f;
        place(scene, cut_plane(middle - (u + v) * lower_half, u * 2.0f * lower_half, v * 2.0f * lower_half, 11,
                               scene.add_material(emitter(lower))));
        place(scene, cut_plane(middle - (u + v) * upper_half, u * 2.0f * upper_half, v * 2.0f * upper_half, 7,
                               scene.add_material(emitter(4.0f - lower))));
        EXPECT_EQ(measure(GetParam(), scene, view, exposure).mean, static_cast<double>(lower));
        if (GetParam() == std::string("source")) continue;  // which compiles its kernels anew for what moves
        // A thousandth of their size apart the nearer one is seen.
        const auto apart = [](HostScene& edited) {
            CoreTransform nearer;
            nearer.rows[2].w = 0.004f;
            edited.set_instance_transform(1, nearer);
        };
        EXPECT_EQ(measure(GetParam(), scene, view, exposure, apart).mean, 4.0 - static_cast<double>(lower));
    }
}

// What comes to lie in the place of another by an edit is found, and forgotten when it leaves.
TEST_P(Lighting, ASurfaceThatIsMovedOntoAnotherObeysTheSameRule) {
    const Exposure exposure{.size = 32, .samples = 1, .max_path_length = 1};
    const ViewPyramid view = square_view({0.1f, 0.2f, 5}, {0.1f, 0, 0}, 0.2f);
    const auto at = [](float z) {
        CoreTransform transform;
        transform.rows[2].w = z;
        return transform;
    };
    for (const uint32_t moved : {0u, 1u}) {
        HostScene scene;
        for (const int count : {5, 3}) {
            const uint32_t mesh = scene.add_mesh(cut_plane({-1, -1, 0.3f}, {2, 0.1f, 0}, {0, 2, 0.2f}, count,
                                                           scene.add_material(emitter(count == 5 ? 1 : 3))));
            scene.add_instance(mesh, at(0.25f));
            scene.add_instance(mesh, at(-20.0f));
        }
        const uint32_t instance = 2 * moved;
        const auto go = [&](HostScene& edited) { edited.set_instance_transform(instance, at(-10.0f)); };
        const auto come_back = [&](HostScene& edited) { edited.set_instance_transform(instance, at(0.25f)); };
        EXPECT_EQ(measure(GetParam(), scene, view, exposure, go).mean, moved == 0 ? 3.0 : 1.0);
        go(scene);
        EXPECT_EQ(measure(GetParam(), scene, view, exposure, come_back).mean, 1.0);
    }
}

INSTANTIATE_TEST_SUITE_P(Cores, Lighting, testing::Values("target", "source"),
                         [](const auto& core) { return std::string(core.param); });

}  // namespace
