// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include "render_system/give_back.h"
#include "render_system/host_scene.h"

namespace render_system {

namespace {

// Marks `id`, one of `count`, as removed. `what` is a word for messages.
Status mark_removed(std::vector<bool>& removed, uint32_t id, size_t count, const char* what) {
    const std::string name = std::string(what) + " " + std::to_string(id);
    if (id >= count)
        return Status::error(StatusCode::not_found, name + " does not exist; there are " + std::to_string(count));
    removed.resize(std::max<size_t>(removed.size(), size_t{id} + 1), false);
    if (removed[id]) return Status::error(StatusCode::not_found, name + " has been removed already");
    removed[id] = true;
    return Status::success();
}

Status still_used(const char* what, uint32_t id, const char* user, size_t by) {
    return Status::invalid(std::string(what) + " " + std::to_string(id) + " is used by " + user + " " +
                           std::to_string(by) + "; remove that first");
}

bool uses(const CoreMaterial& material, uint32_t texture) {
    return std::any_of(std::begin(kTextureSlots), std::end(kTextureSlots),
                       [&](const auto slot) { return (material.*slot).texture == texture; });
}

// What stands where a texture was: a texel that nothing reads.
HostTexture no_texture() {
    HostTexture texture;
    texture.width = texture.height = 1;
    texture.texels = {0u};
    return texture;
}

}  // namespace

void HostScene::give_back_mesh(uint32_t id) {
    if (is_emissive(id)) return;
    HostMesh kept;
    kept.name = std::move(meshes_[id].name);
    meshes_[id] = std::move(kept);
}

void HostScene::give_back_textures() {
    for (HostTexture& texture : textures_) give_back(texture.texels);
}

Status HostScene::remove_instance(uint32_t id) {
    if (Status status = mark_removed(removed_.instances, id, instances_.size(), "instance"); !status.ok())
        return status;
    // The node that carries it must not show it again.
    if (const uint32_t node = carrier(id); node != NONE) {
        nodes_[node].instance = nodes_[node].mesh = carriers_[id] = NONE;
    }
    set_instance_mesh(id, NONE);
    removed_.instances[id] = true;
    return Status::success();
}

Status HostScene::remove_mesh(uint32_t id) {
    for (size_t i = 0; i < instances_.size(); ++i) {
        if (id != NONE && instances_[i].mesh == id) return still_used("mesh", id, "instance", i);
    }
    for (size_t i = 0; i < nodes_.size(); ++i) {
        if (id != NONE && nodes_[i].mesh == id) return still_used("mesh", id, "node", i);
    }
    if (Status status = mark_removed(removed_.meshes, id, meshes_.size(), "mesh"); !status.ok()) return status;
    set_mesh(id, {});
    removed_.meshes[id] = true;
    return Status::success();
}

Status HostScene::remove_material(uint32_t id) {
    for (size_t i = 0; i < meshes_.size(); ++i) {
        const std::vector<uint32_t>& used = mesh_materials_[i];
        if (std::binary_search(used.begin(), used.end(), id)) return still_used("material", id, "mesh", i);
    }
    if (Status status = mark_removed(removed_.materials, id, materials_.size(), "material"); !status.ok())
        return status;
    set_material(id, {});
    materials_[id].name = {};
    removed_.materials[id] = true;
    return Status::success();
}

Status HostScene::remove_texture(uint32_t id) {
    for (size_t i = 0; i < materials_.size(); ++i) {
        if (id != NONE && uses(materials_[i].core, id)) return still_used("texture", id, "material", i);
    }
    if (Status status = mark_removed(removed_.textures, id, textures_.size(), "texture"); !status.ok()) return status;
    set_texture(id, no_texture());
    removed_.textures[id] = true;
    return Status::success();
}

Status HostScene::remove_punctual_light(uint32_t id) {
    if (Status status = mark_removed(removed_.lights, id, lights_.size(), "light"); !status.ok()) return status;
    for (HostNode& node : nodes_) {
        if (node.light == id) node.light = NONE;
    }
    set_punctual_light(id, {});  // dark: no table takes it in
    removed_.lights[id] = true;
    return Status::success();
}

}  // namespace render_system
