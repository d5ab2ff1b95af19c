// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/checked_core.h"

#include <algorithm>
#include <new>
#include <thread>
#include <utility>

#include "render_system/scene_limits.h"

namespace render_system {

CheckedCore::CheckedCore(std::string id, InstanceMatrices matrices) : id_(std::move(id)), matrices_(matrices) {}

// Does the work that the check allows, with bad_alloc turned into a status.
template <class Work>
Status CheckedCore::after(const Status& check, Work&& work) {
    if (!check.ok()) return check;
    try {
        return work();
    } catch (const std::bad_alloc&) {
        return Status::out_of_memory(id_ + " core: the machine's memory is used up", host_bytes(), 0);
    }
}

// The same for what makes the scene another one.
template <class Work>
Status CheckedCore::change(const Status& check, Work&& work) {
    scene_changed_ = scene_changed_ || check.ok();
    return after(check, std::forward<Work>(work));
}

Status CheckedCore::Init(const CoreOptions& options) {
    return after(contract_.check_init(), [&] {
        options_ = options;
        if (options_.threads == 0) options_.threads = std::max(1u, std::thread::hardware_concurrency());
        const Result<std::string> device = open();
        if (!device.ok()) return device.status;
        stats_.core = id_;
        stats_.device = *device;
        stats_.threads = options_.threads;
        contract_.accept_init();
        return Status::success();
    });
}

Status CheckedCore::SetTarget(const CoreTarget& target) {
    return after(contract_.check_target(target), [&] {
        if (target.width != target_.width || target.height != target_.height) {
            resize(target.width, target.height);
            drop_samples();
            forget_frames();
        }
        target_ = target;
        contract_.accept_target();
        return Status::success();
    });
}

Status CheckedCore::Setting(const CoreSettings& settings) {
    Status status = contract_.check_settings(settings);
    if (!status.ok()) return status;
    CoreSettings same_samples = settings;
    same_samples.seed = settings_.seed;
    same_samples.first_sample = settings_.first_sample;
    scene_changed_ = scene_changed_ || !(same_samples == settings_);  // what of it light depends on
    settings_ = settings;
    return status;
}

Status CheckedCore::SetTextures(std::span<const CoreTexture> textures) {
    return change(contract_.check_textures(textures), [&] {
        set_textures(textures);
        contract_.accept_textures(textures);
        return Status::success();
    });
}

Status CheckedCore::SetMaterials(uint32_t first, std::span<const CoreMaterial> materials) {
    return change(contract_.check_materials(first, materials), [&] {
        set_materials(first, materials);
        contract_.accept_materials(first, materials);
        return Status::success();
    });
}

Status CheckedCore::SetLights(const CoreLights& lights) {
    return change(contract_.check_lights(lights), [&] {
        set_lights(lights);
        contract_.accept_lights(lights);
        return Status::success();
    });
}

Status CheckedCore::SetSkyData(const CoreSky& sky) {
    return change(contract_.check_sky(sky), [&] {
        set_sky(sky);
        return Status::success();
    });
}

Status CheckedCore::settled() const {
    return Status::error(StatusCode::wrong_order, id_ + " core: it was told that its geometry stays as it is");
}

Status CheckedCore::SetGeometry(uint32_t mesh, const CoreMesh& data) {
    if (is_settled_) return settled();
    return change(contract_.check_geometry(mesh, data), [&] {
        keep_shape(mesh, data);
        set_mesh(mesh, data);
        contract_.accept_geometry(mesh, data);
        return Status::success();
    });
}

Status CheckedCore::SetInstance(uint32_t instance, uint32_t mesh, const CoreTransform& transform) {
    if (is_settled_) return settled();
    Status check = contract_.check_instance(instance, mesh, transform);
    if (check.ok() && matrices_ == InstanceMatrices::invertible && mesh != NONE && !is_invertible(transform)) {
        check = Status::invalid("instance: the matrix cannot be inverted");
    }
    return change(check, [&] {
        set_instance(instance, mesh, transform);
        contract_.accept_instance(instance, mesh, transform);
        return Status::success();
    });
}

Status CheckedCore::SetWatch(PathWatch* watch) {
    Status status = contract_.check_watch();
    if (status.ok()) watch_ = watch;
    return status;
}

Status CheckedCore::Render(const ViewPyramid& view, Convergence convergence, uint32_t samples) {
    return after(contract_.check_render(view, samples), [&] {
        is_settled_ = options_.still;
        Status status = prepare();
        if (!status.ok()) return status;
        stats_.triangles = contract_.triangles();
        if (convergence == Convergence::Restart) drop_samples();
        CallOff call_off(target_.is_called_off);
        status = call_off.status();
        if (status.ok()) status = render(view, samples, call_off);
        if (status.ok()) stats_.samples += samples;
        if (status.code == StatusCode::called_off) drop_samples();
        return status;
    });
}

Status CheckedCore::Filter(const ViewPyramid& view, const CoreFilter& filter) {
    return after(contract_.check_filter(view, filter, target_), [&] {
        Status status = prepare();
        if (!status.ok()) return status;
        look_back(view, filter.history);
        CallOff call_off(filter.is_called_off);
        status = call_off.status();
        if (status.ok()) status = this->filter(view, filter, call_off);
        const bool stays = status.code == StatusCode::called_off && filter.history == FilterHistory::go_on;
        if (stays || filter.history == FilterHistory::none) return status;
        if (status.ok())
            remember(view);
        else
            forget_frames();
        return status;
    });
}

Result<CoreHistory> CheckedCore::GetHistory() {
    CoreHistory history{.frames = kept_.frame, .planes = {}};
    const Status status = after(contract_.check_history(),
                                [&] { return kept_.frame > 0 ? read_history(history.planes) : Status::success(); });
    if (!status.ok()) return status;
    return history;
}

Status CheckedCore::SetHistory(const ViewPyramid& view, const CoreHistory& history) {
    return after(contract_.check_render(view, 1), [&] {
        forget_frames();
        Status status = prepare();
        if (!status.ok() || history.frames == 0) return status;
        status = write_history(history.planes);
        if (!status.ok()) return status;
        before_ = {.frame = history.frames};
        scene_changed_ = true;  // so that its transforms are taken
        remember(view);
        return status;
    });
}

Status CheckedCore::read_history(std::vector<float>&) { return Status::success(); }

Status CheckedCore::write_history(std::span<const float> planes) {
    return planes.empty() ? Status::success() : Status::invalid(id_ + " core: the history is not of this core");
}

void CheckedCore::look_back(const ViewPyramid& view, FilterHistory history) {
    before_ = {};
    if (history == FilterHistory::none) return;
    if (history == FilterHistory::go_on) before_ = kept_;
    ++before_.frame;
    before_.is_same = before_.frame > 1 && !scene_changed_ && view == before_.view;
    if (before_.frame == 1 || before_.is_same) return;
    const std::vector<PlacedInstance>& instances = contract_.instances();
    before_.motions = motions_between(instances_before_, instances, shapes_before_);
    before_.shapes_changed = before_.motions.size() > kMotionRows * instances.size();
}

std::vector<glm::vec3> CheckedCore::positions_before(uint32_t, const CoreMesh&) const { return {}; }

// Of each mesh once a frame: as the frame filtered last has shown it, unless it becomes another one.
void CheckedCore::keep_shape(uint32_t mesh, const CoreMesh& data) {
    if (kept_.frame == 0) return;
    std::vector<glm::vec3> positions = positions_before(mesh, data);
    const bool is_other = positions.empty();
    const auto kept = shapes_before_.try_emplace(mesh, std::move(positions)).first;
    if (is_other) kept->second.clear();
}

void CheckedCore::remember(const ViewPyramid& view) {
    kept_ = {.frame = before_.frame, .view = view};
    if (scene_changed_ || before_.frame == 1) instances_before_ = contract_.instances();
    shapes_before_.clear();
    scene_changed_ = false;
}

void CheckedCore::Shutdown() {
    contract_.accept_shutdown();
    close();
    target_ = {};
    watch_ = nullptr;
    is_settled_ = false;
}

void CheckedCore::drop_samples() {
    CoreStats fresh;
    fresh.core = stats_.core;
    fresh.device = stats_.device;
    fresh.threads = stats_.threads;
    fresh.triangles = stats_.triangles;
    fresh.build_ms = stats_.build_ms;
    stats_ = fresh;
}

}  // namespace render_system
