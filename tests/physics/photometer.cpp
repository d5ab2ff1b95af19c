// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/physics/photometer.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#ifdef PORTTOOL_HAS_SOURCE_CORE
#include "source_core/render_core.h"
#endif
#ifdef PORTTOOL_HAS_TARGET_CORE
#include "target_core/render_core.h"
#endif

namespace physics {

using namespace render_system;

namespace {

constexpr int SEEDS = 16;

std::unique_ptr<CoreAPI> create(const std::string& core) {
#ifdef PORTTOOL_HAS_SOURCE_CORE
    if (core == "source") {
        return source_core::create_core();
    }
#endif
#ifdef PORTTOOL_HAS_TARGET_CORE
    if (core == "target") {
        return target_core::create_core();
    }
#endif
    return nullptr;
}

double average(const std::vector<glm::vec4>& pixels) {
    double sum = 0.0;
    for (const glm::vec4& p : pixels) {
        sum += (static_cast<double>(p.x) + p.y + p.z) / 3.0;
    }
    return sum / static_cast<double>(pixels.size());
}

/// To open a device and compile its kernels takes longer than most readings: a suite shares one of each core.
struct OpenCore {
    std::unique_ptr<CoreAPI> core;
    size_t instances = 0, materials = 0;  ///< most that it was sent
};
std::map<std::string, OpenCore> open_cores;

/// Opens the core where it is not open.
Status open(const std::string& name) {
    OpenCore& opened = open_cores[name];
    if (opened.core) {
        return {};
    }
    std::unique_ptr<CoreAPI> created = create(name);
    if (!created) {
        return Status::error(StatusCode::no_device, "the " + name + " core is not built in");
    }
    Status status = created->Init({});
    if (status.ok()) {
        opened = {std::move(created), 0, 0};
    }
    return status;
}

/// A core without what the last scene left in it: nothing is placed, and no material asks for a lobe.
std::unique_ptr<CoreAPI> take_cleared(OpenCore& opened) {
    for (uint32_t i = 0; i < opened.instances; ++i) {
        EXPECT_TRUE(opened.core->SetInstance(i, NONE, {}).ok());
    }
    if (opened.materials > 0) {
        EXPECT_TRUE(opened.core->SetMaterials(0, std::vector<CoreMaterial>(opened.materials)).ok());
    }
    return std::move(opened.core);
}

}  // namespace

bool core_available(const std::string& core, std::string& reason) {
    const Status status = open(core);
    reason = status.message;
    return status.ok();
}

void close_cores() { open_cores.clear(); }

Reading measure(const std::string& core, const HostScene& scene, const ViewPyramid& view, const Exposure& exposure,
                const SceneEdit& edit) {
    std::vector<glm::vec4> pixels(size_t{exposure.size} * exposure.size);
    RenderSystem system(scene);
    EXPECT_TRUE(open(core).ok());
    OpenCore& opened = open_cores[core];
    system.use_core(take_cleared(opened));
    EXPECT_TRUE(system.core().SetTarget({exposure.size, exposure.size, pixels}).ok());
    if (edit) {
        EXPECT_TRUE(system.render(view, Convergence::Restart, 1).ok());
        edit(system.scene());
    }
    double means[SEEDS];
    for (int seed = 0; seed < SEEDS; ++seed) {
        CoreSettings settings;
        settings.seed = static_cast<uint32_t>(seed + 1);
        settings.max_path_length = exposure.max_path_length;
        settings.russian_roulette = false;
        settings.next_event_estimation = exposure.next_event_estimation;
        settings.indirect_limit = exposure.indirect_limit;
        EXPECT_TRUE(system.core().Setting(settings).ok());
        Status status = system.render(view, Convergence::Restart, exposure.samples);
        EXPECT_TRUE(status.ok()) << status.message;
        means[seed] = average(pixels);
    }
    opened = {system.take_core(), std::max(opened.instances, scene.instances().size()),
              std::max(opened.materials, scene.materials().size())};
    Reading reading;
    for (double mean : means) {
        reading.mean += mean / SEEDS;
    }
    double variance = 0.0;
    for (double mean : means) {
        variance += (mean - reading.mean) * (mean - reading.mean) / (SEEDS - 1);
    }
    reading.error = std::sqrt(variance / SEEDS);
    return reading;
}

ViewPyramid square_view(const glm::vec3& eye, const glm::vec3& target, float angle) {
    return view_pyramid(look_at(eye, target, {0.0f, 1.0f, 0.0f}, angle), 16, 16);
}

HostMesh quad_mesh(const glm::vec3& corner, const glm::vec3& edge_u, const glm::vec3& edge_v, uint32_t material) {
    HostMesh mesh;
    mesh.positions = {corner, corner + edge_u, corner + edge_u + edge_v, corner + edge_v};
    mesh.normals.assign(4, glm::normalize(glm::cross(edge_u, edge_v)));
    mesh.uv0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{0, 1, 2, material}, {0, 2, 3, material}};
    return mesh;
}

HostMesh sphere_mesh(float radius, uint32_t rings, uint32_t material) {
    HostMesh mesh;
    uint32_t columns = 2 * rings;
    for (uint32_t i = 0; i <= rings; ++i) {
        for (uint32_t j = 0; j <= columns; ++j) {
            float polar = std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(rings);
            float around =
                2.0f * std::numbers::pi_v<float> * static_cast<float>(j % columns) / static_cast<float>(columns);
            glm::vec3 n(std::sin(polar) * std::cos(around), std::cos(polar), std::sin(polar) * std::sin(around));
            if (i == 0 || i == rings) {
                n = glm::vec3(0.0f, i == 0 ? 1.0f : -1.0f, 0.0f);
            }
            mesh.positions.push_back(radius * n);
            mesh.normals.push_back(n);
        }
    }
    for (uint32_t i = 0; i < rings; ++i) {
        for (uint32_t j = 0; j < columns; ++j) {
            uint32_t a = i * (columns + 1) + j;
            uint32_t b = a + columns + 1;
            if (i > 0) {
                mesh.triangles.push_back({a, a + 1, b, material});
            }
            if (i + 1 < rings) {
                mesh.triangles.push_back({a + 1, b + 1, b, material});
            }
        }
    }
    return mesh;
}

void place(HostScene& scene, HostMesh mesh) { scene.add_instance(scene.add_mesh(std::move(mesh)), {}); }

void set_sky(HostScene& scene, float radiance) {
    Sky sky;
    sky.radiance = glm::vec3(radiance);
    scene.set_sky(sky);
}

HostMaterial lambert(float albedo) {
    HostMaterial material;
    material.core.base_color = glm::vec3(albedo);
    material.core.metallic = 0.0f;
    material.core.specular = 0.0f;
    return material;
}

HostMaterial emitter(float radiance) {
    HostMaterial material = lambert(0.0f);
    material.core.emission = glm::vec3(radiance);
    return material;
}

}  // namespace physics
