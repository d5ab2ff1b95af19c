// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/render_system.h"

#include <algorithm>
#include <utility>

#include "render_system/animation/moving_meshes.h"
#include "render_system/light_table.h"
#include "render_system/scene_limits.h"

namespace render_system {

namespace {

Status send_textures(CoreAPI& core, const HostScene& scene, SceneChanges& changes) {
    if (!changes.textures) return Status::success();
    std::vector<CoreTexture> views;
    for (const HostTexture& texture : scene.textures()) views.push_back(texture.view());
    Status status = core.SetTextures(views);
    if (status.ok()) changes.textures = false;
    return status;
}

// Neighbours that changed go in one call.
Status send_materials(CoreAPI& core, const HostScene& scene, SceneChanges& changes) {
    std::vector<CoreMaterial> run;
    for (size_t i = 0; i < changes.materials.size(); ++i) {
        if (!changes.materials[i]) continue;
        const size_t first = i;
        run.clear();
        while (i < changes.materials.size() && changes.materials[i]) run.push_back(scene.materials()[i++].core);
        Status status = core.SetMaterials(static_cast<uint32_t>(first), run);
        if (!status.ok()) return status;
        for (size_t done = first; done < i; ++done) changes.materials[done] = false;
    }
    return Status::success();
}

// A scene that is given back is not played: then nothing moves, and what could move is as fast as all else.
Status send_meshes(CoreAPI& core, HostScene& scene, SceneChanges& changes, bool gives_back) {
    const bool any = std::find(changes.meshes.begin(), changes.meshes.end(), true) != changes.meshes.end();
    const MovingMeshes moving = any && !gives_back ? moving_meshes(scene) : MovingMeshes{};
    for (uint32_t i = 0; i < changes.meshes.size(); ++i) {
        if (!changes.meshes[i]) continue;
        CoreMesh mesh = scene.meshes()[i].view();
        mesh.moves = !gives_back && moving.moves[i];
        mesh.deforms = !gives_back && moving.deforms[i];
        Status status = core.SetGeometry(i, mesh);
        if (!status.ok()) return status;
        changes.meshes[i] = false;
        if (gives_back) scene.give_back_mesh(i);
    }
    return Status::success();
}

Status send_instances(CoreAPI& core, const HostScene& scene, SceneChanges& changes) {
    for (uint32_t i = 0; i < changes.instances.size(); ++i) {
        if (!changes.instances[i]) continue;
        const HostInstance& instance = scene.instances()[i];
        Status status = core.SetInstance(i, instance.mesh, instance.transform);
        if (!status.ok()) return status;
        changes.instances[i] = false;
    }
    return Status::success();
}

}  // namespace

RenderSystem::RenderSystem(HostScene scene) : scene_(std::move(scene)) {}

void RenderSystem::use_core(std::unique_ptr<CoreAPI> core) {
    core_ = std::move(core);
    scene_.mark_all_changed();
}

Status RenderSystem::synchronize() {
    if (!core_) return Status::error(StatusCode::wrong_order, "the render system has no core yet");
    SceneChanges& changes = scene_.changes();
    const bool new_textures = changes.textures;
    if (Status status = send_textures(*core_, scene_, changes); !status.ok()) return status;
    if (gives_back_ && new_textures) scene_.give_back_textures();
    if (Status status = send_materials(*core_, scene_, changes); !status.ok()) return status;
    if (Status status = send_meshes(*core_, scene_, changes, gives_back_); !status.ok()) return status;
    // Before the flags of the instances go down: what moved may have changed the scene's radius.
    if (radius_matters_ && scene_radius(scene_) != radius_) changes.lights = true;
    if (Status status = send_instances(*core_, scene_, changes); !status.ok()) return status;
    return send_lights_and_sky();
}

Status RenderSystem::send_lights_and_sky() {
    SceneChanges& changes = scene_.changes();
    if (changes.sky) sky_table_ = build_sky_table(scene_.sky());
    if (changes.lights) {
        const LightTable table = build_light_table(scene_, sky_table_.luminance_integral);
        if (Status status = core_->SetLights(table.view()); !status.ok()) return status;
        changes.lights = false;
        radius_ = table.scene_radius;
        radius_matters_ = table.uses_radius;
        // The sky carries its own share of the light table.
        if (table.sky_probability != sky_probability_) changes.sky = true;
        sky_probability_ = table.sky_probability;
    }
    if (!changes.sky) return Status::success();
    const Sky& sky = scene_.sky();
    Status status =
        core_->SetSkyData({sky.radiance, sky.width, sky.height, sky.texels, sky_table_.table, sky_probability_});
    if (status.ok()) changes.sky = false;
    return status;
}

Status RenderSystem::render(const ViewPyramid& view, Convergence convergence, uint32_t samples) {
    const bool changed = scene_.changes().any();
    const Status limits = changed ? check_scene_limits(scene_, view) : check_view(view);
    if (!limits.ok()) return limits;
    restart_ = restart_ || changed;
    if (Status status = synchronize(); !status.ok()) return status;
    Status status = core_->Render(view, restart_ ? Convergence::Restart : convergence, samples);
    if (status.ok()) restart_ = false;
    return status;
}

}  // namespace render_system
