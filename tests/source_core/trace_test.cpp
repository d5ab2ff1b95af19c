// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// trace_closest and trace_any on the device against brute force here, bit for bit: kernels of the test's own replace
// the camera and the shading. Rays travel in the sky map: origins in row 0, directions in row 1, tmax beside them.
#include <cmath>
#include <cstring>

#include "tests/source_core/test_scene.h"

using namespace render_system;
using namespace source_core_test;

namespace {

constexpr const char* GENERATE = R"GLSL(
#ifndef GENERATE_GLSL
#define GENERATE_GLSL
#include "path_state.glsl"
void generate_path(Uint job) {
    PathRay path_ray;
    path_ray.ray.origin = vec3(fetch_sky_texels(job));
    path_ray.ray.direction = vec3(fetch_sky_texels(settings.sky_width + job));
    path_ray.cone_width = 0.0f;
    path_ray.cone_spread = 0.0f;
    Throughput throughput;
    throughput.weight = vec3(1.0f);
    throughput.pdf = 0.0f;
    store_path(job, path_ray, throughput, true);
    store_path_radiance(job, vec4(0.0f), true);
    push_extension_ray(job, true);
}
#endif
)GLSL";

constexpr const char* EXTEND = R"GLSL(
#ifndef EXTEND_GLSL
#define EXTEND_GLSL
#include "trace.glsl"
void extend_path(Uint job) {
    Uint path = load_extension_job(job);
    Hit hit = trace_closest(load_path_ray(path).ray, path);
    push_surface_job(uvec4(path, hit.instance, hit.triangle, 0u), true);
}
#endif
)GLSL";

constexpr const char* SHADE = R"GLSL(
#ifndef SHADE_GLSL
#define SHADE_GLSL
#include "trace.glsl"
void shade_path(Uint job) {
    uvec4 row = load_surface_job(job);
    Uint path = row.x;
    Hit hit;
    hit.instance = row.y;
    hit.triangle = row.z;
    PathRay path_ray = load_path_ray(path);
    Float tmax = fetch_sky_texels(path).w;
    Mask blocked = trace_any(path_ray.ray, tmax, path);
    vec4 found = vec4(-1.0f, -1.0f, 0.0f, blocked ? 1.0f : 0.0f);
    if (hit.instance != NONE) {
        TriangleVertices triangle = fetch_triangle(hit.instance, hit.triangle);
        TriangleTest test = intersect_triangle(path_ray.ray.origin, path_ray.ray.direction, triangle.v0, triangle.v1,
                                               triangle.v2);
        found = vec4(Float(hit.instance), Float(triangle.primitive), test.t, found.w);
    }
    store_path_radiance(path, found, true);
}
#endif
)GLSL";

constexpr const char* FINALIZE = R"GLSL(
#ifndef FINALIZE_GLSL
#define FINALIZE_GLSL
#include "path_state.glsl"
void finalize_pixel(Uint job) { store_target(job + pass.first_pixel, load_path_radiance(job)); }
#endif
)GLSL";

constexpr uint32_t SEED = 5;

struct TestRay {
    glm::vec3 origin;
    glm::vec3 direction;
    float tmax;
};

struct Found {
    float instance = -1.0f;
    float primitive = -1.0f;
    float t = 0.0f;
    float blocked = 0.0f;
};

glm::vec3 place(const CoreTransform& transform, glm::vec3 p) {
    glm::vec3 q;
    for (int r = 0; r < 3; ++r) {
        const glm::vec4& row = transform.rows[r];
        q[r] = ((row.x * p.x + row.y * p.y) + row.z * p.z) + row.w;
    }
    return q;
}

float dot(glm::vec3 a, glm::vec3 b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }

glm::vec3 cross(glm::vec3 a, glm::vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// The triangle test of kernels/intersect.glsl; negative: no hit.
float intersect(const TestRay& ray, glm::vec3 v0, glm::vec3 v1, glm::vec3 v2) {
    const glm::vec3 a = v0 - ray.origin;
    const glm::vec3 b = v1 - ray.origin;
    const glm::vec3 c = v2 - ray.origin;
    const float weight0 = dot(cross(b, c), ray.direction);
    const float weight1 = dot(cross(c, a), ray.direction);
    const float weight2 = dot(cross(a, b), ray.direction);
    const float sum = (weight0 + weight1) + weight2;
    const glm::vec3 normal = cross(v1 - v0, v2 - v0);
    const float approach = dot(normal, ray.direction);
    const float t = dot(normal, a) / approach;
    const bool inside = std::min({weight0, weight1, weight2}) >= 0.0f || std::max({weight0, weight1, weight2}) <= 0.0f;
    return sum != 0.0f && approach != 0.0f && inside && t > 0.0f ? t : -1.0f;
}

// The hashed decision of kernels/alpha.glsl: the share of (ray, instance, primitive) that meet.
uint32_t hash_bits(uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

uint32_t hash_pair(uint32_t a, uint32_t b) { return hash_bits(a ^ (hash_bits(b) + 0x9e3779b9u)); }

// Of the ray of pixel `pixel` in the first sample's first segment; kind 0: extension, 1: shadow.
uint32_t ray_key(uint32_t pixel, uint32_t kind) {
    return hash_pair(hash_pair(pixel, hash_bits(SEED)), hash_pair(0, 2 + kind));
}

bool meets(const CoreMaterial& material, uint32_t key, uint32_t instance, uint32_t primitive) {
    const float draw = static_cast<float>(hash_pair(key, hash_pair(instance, primitive)) >> 8) * 0x1p-24f;
    return material.opaque || draw < material.alpha;
}

// All triangles in the order of (instance, primitive): the first of equal t wins.
Found brute_force(const TestScene& scene, const TestRay& ray, uint32_t pixel) {
    Found best;
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        if (scene.instances[i].mesh == NONE) {
            continue;
        }
        const TestMesh& mesh = scene.meshes[scene.instances[i].mesh];
        const CoreTransform& transform = scene.instances[i].transform;
        for (size_t k = 0; k < mesh.triangles.size(); ++k) {
            const glm::uvec4& corners = mesh.triangles[k];
            auto met_by = [&](uint32_t kind) {
                return meets(scene.materials[corners.w], ray_key(pixel, kind), static_cast<uint32_t>(i),
                             static_cast<uint32_t>(k));
            };
            const float t =
                intersect(ray, place(transform, mesh.positions[corners.x]), place(transform, mesh.positions[corners.y]),
                          place(transform, mesh.positions[corners.z]));
            if (t > 0.0f && (best.instance < 0.0f || t < best.t) && met_by(0)) {
                best.instance = static_cast<float>(i);
                best.primitive = static_cast<float>(k);
                best.t = t;
            }
            best.blocked = t > 0.0f && t < ray.tmax && met_by(1) ? 1.0f : best.blocked;
        }
    }
    return best;
}

// Rays from around the scene and from inside it, some along the axes.
std::vector<TestRay> random_rays(uint32_t count, float reach, std::mt19937& random) {
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    std::vector<TestRay> rays;
    for (uint32_t i = 0; i < count; ++i) {
        TestRay ray;
        ray.origin = glm::vec3(unit(random), unit(random), unit(random)) * reach * 2.0f;
        const glm::vec3 aim = glm::vec3(unit(random), unit(random), unit(random)) * reach;
        ray.direction = glm::normalize(aim - ray.origin);
        if (i % 8 == 0) {
            ray.direction = glm::vec3(0.0f);
            ray.direction[static_cast<int>(i / 8 % 3)] = i % 16 == 0 ? 1.0f : -1.0f;
        }
        ray.tmax = reach * (2.0f + unit(random));
        rays.push_back(ray);
    }
    return rays;
}

class Trace : public ::testing::Test {
protected:
    void SetUp() override {
        folder_.write_kernels();
        folder_.write("generate.glsl", GENERATE);
        folder_.write("extend.glsl", EXTEND);
        folder_.write("shade.glsl", SHADE);
        folder_.write("finalize.glsl", FINALIZE);
    }

    // Renders one pixel per ray and holds each against brute force.
    void expect_brute_force(TestScene& scene, const std::vector<TestRay>& rays) {
        source_core::SourceOptions options;
        options.kernels_directory = folder_.path();
        OPEN_CORE_OR_SKIP(core, options);
        const Status sent = scene.send(*core);
        ASSERT_TRUE(sent.ok()) << sent.message;
        const auto width = static_cast<uint32_t>(rays.size());
        std::vector<glm::vec4> texels(2 * width);
        std::vector<AliasEntry> table(2 * width);
        for (uint32_t i = 0; i < width; ++i) {
            texels[i] = glm::vec4(rays[i].origin, 0.0f);
            texels[width + i] = glm::vec4(rays[i].direction, 0.0f);
            table[i].probability = rays[i].tmax;
        }
        CoreSky sky;
        sky.width = width;
        sky.height = 2;
        sky.texels = texels;
        sky.table = table;
        ASSERT_TRUE(core->SetSkyData(sky).ok());
        CoreSettings settings;
        settings.max_path_length = 1;
        settings.seed = SEED;
        ASSERT_TRUE(core->Setting(settings).ok());
        const auto pixels = render(*core, width, 1, 1);
        uint32_t hits = 0;
        uint32_t blocked = 0;
        for (uint32_t i = 0; i < width; ++i) {
            const Found expected = brute_force(scene, rays[i], i);
            ASSERT_EQ(pixels[i].x, expected.instance) << "ray " << i;
            ASSERT_EQ(pixels[i].y, expected.primitive) << "ray " << i;
            ASSERT_EQ(pixels[i].z, expected.t) << "ray " << i;
            ASSERT_EQ(pixels[i].w, expected.blocked) << "ray " << i;
            hits += expected.instance >= 0.0f ? 1 : 0;
            blocked += expected.blocked > 0.0f ? 1 : 0;
        }
        EXPECT_GT(hits, width / 20) << "the scene is too thin to show anything";
        EXPECT_LT(blocked, width);
    }

    TemporaryFolder folder_;
};

}  // namespace

TEST_F(Trace, FindsWhatBruteForceFinds) {
    std::mt19937 random(11);
    TestScene scene;
    scene.meshes.push_back(random_mesh(800, 1.0f, 0.3f, random));
    scene.meshes.push_back(random_mesh(500, 0.7f, 0.2f, random));
    scene.instances = {{0, {}}, {1, random_transform(0.3f, false, random)}};
    expect_brute_force(scene, random_rays(4000, 1.0f, random));
}

TEST_F(Trace, InstancesOfAnyScaleAndHandAreFound) {
    std::mt19937 random(12);
    TestScene scene;
    scene.meshes.push_back(random_mesh(60, 0.4f, 0.2f, random));
    scene.meshes.push_back(random_mesh(80, 0.4f, 0.2f, random));
    scene.meshes.push_back(random_mesh(100, 1.0f, 0.2f, random));
    for (uint32_t i = 0; i < 40; ++i) {
        scene.instances.push_back({i % 2, random_transform(2.0f, i % 3 == 0, random)});
    }
    scene.instances.push_back({2, random_transform(0.5f, true, random)});
    scene.instances.push_back({NONE, {}});
    scene.instances[7].transform.rows[1] *= 1e-4f;           // nearly flat
    scene.instances[9].transform.rows[2] = {0, 0, 0, 0.5f};  // flat: no inverse
    for (glm::vec4& row : scene.instances[11].transform.rows) {
        row = glm::vec4(glm::vec3(row) * 50.0f, row.w);  // far larger than the rest
    }
    expect_brute_force(scene, random_rays(4000, 2.0f, random));
}

TEST_F(Trace, TiesGoToTheLowerInstanceAndPrimitive) {
    std::mt19937 random(13);
    TestScene scene;
    TestMesh sheet = random_mesh(40, 1.0f, 0.8f, random);
    for (glm::vec3& p : sheet.positions) {
        p.z = 0.25f;  // all in one plane
    }
    for (uint32_t i = 0; i < 40; ++i) {
        sheet.triangles.push_back(sheet.triangles[39 - i]);  // and twice
    }
    scene.meshes = {sheet, sheet};
    scene.instances = {{1, {}}, {0, {}}, {0, {}}};
    std::vector<TestRay> rays = random_rays(3000, 1.0f, random);
    for (TestRay& ray : rays) {
        ray.direction = glm::normalize(glm::vec3(ray.direction.x * 0.1f, ray.direction.y * 0.1f, -1.0f));
        ray.origin.z = std::fabs(ray.origin.z) + 0.5f;
    }
    expect_brute_force(scene, rays);
}

TEST_F(Trace, AlphaIsDecidedPerTriangleInAnyOrder) {
    std::mt19937 random(17);
    TestScene scene;
    scene.meshes = {random_mesh(500, 1.0f, 0.4f, random), random_mesh(60, 0.4f, 0.3f, random)};
    scene.materials.resize(3);
    scene.materials[1].opaque = false;
    scene.materials[1].alpha = 0.5f;
    scene.materials[2].opaque = false;
    scene.materials[2].alpha = 0.0f;
    for (TestMesh& mesh : scene.meshes) {
        for (size_t k = 0; k < mesh.triangles.size(); ++k) {
            mesh.triangles[k].w = k % 5 == 0 ? 0 : 1 + k % 2;
        }
    }
    scene.instances.push_back({0, {}});
    for (uint32_t i = 0; i < 12; ++i) {
        scene.instances.push_back({1, random_transform(1.0f, i % 2 == 0, random)});
    }
    expect_brute_force(scene, random_rays(4000, 1.0f, random));
}

TEST_F(Trace, DegenerateTrianglesAreNeverHit) {
    std::mt19937 random(14);
    TestScene scene;
    TestMesh mesh = random_mesh(300, 1.0f, 0.4f, random);
    for (uint32_t i = 0; i < 100; ++i) {
        const glm::vec3 p = mesh.positions[i * 3];
        mesh.add_triangle(p, p, p);                                       // a point
        mesh.add_triangle(p, p + glm::vec3(0.5f), p + glm::vec3(0.25f));  // a line
    }
    scene.meshes.push_back(mesh);
    scene.instances.push_back({0, {}});
    expect_brute_force(scene, random_rays(3000, 1.0f, random));
}

TEST_F(Trace, HugeAndTinyScenesAreTraced) {
    for (const float scale : {1.0e-6f, 1.0e-3f, 1.0e4f, 1.0e8f}) {
        SCOPED_TRACE(scale);
        std::mt19937 random(15);
        TestScene scene;
        scene.meshes.push_back(random_mesh(400, scale, 0.4f * scale, random));
        scene.instances.push_back({0, {}});
        expect_brute_force(scene, random_rays(1000, scale, random));
    }
}

TEST_F(Trace, FarFromTheOriginNothingSlipsThrough) {
    std::mt19937 random(16);
    TestScene scene;
    TestMesh mesh = random_mesh(400, 1.0f, 0.4f, random);
    for (glm::vec3& p : mesh.positions) {
        p += glm::vec3(3000.0f, -2000.0f, 5000.0f);
    }
    scene.meshes = {mesh, random_mesh(40, 0.4f, 0.2f, random)};
    scene.instances.push_back({0, {}});
    for (uint32_t i = 0; i < 6; ++i) {
        scene.instances.push_back({1, random_transform(0.5f, i % 2 == 0, random)});
        for (int r = 0; r < 3; ++r) {
            scene.instances.back().transform.rows[r].w += glm::vec3(3000.0f, -2000.0f, 5000.0f)[r];
        }
    }
    std::vector<TestRay> rays = random_rays(3000, 1.0f, random);
    for (TestRay& ray : rays) {
        ray.origin += glm::vec3(3000.0f, -2000.0f, 5000.0f);
    }
    expect_brute_force(scene, rays);
}

TEST_F(Trace, AnEmptySceneIsMissed) {
    TestScene scene;
    source_core::SourceOptions options;
    options.kernels_directory = folder_.path();
    OPEN_CORE_OR_SKIP(core, options);
    ASSERT_TRUE(scene.send(*core).ok());
    for (const glm::vec4& pixel : render(*core, 4, 1, 1)) {
        EXPECT_EQ(pixel, glm::vec4(-1.0f, -1.0f, 0.0f, 0.0f));
    }
}
