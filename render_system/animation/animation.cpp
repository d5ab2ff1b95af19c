// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/animation/animation.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "render_system/host_scene.h"
#include "render_system/scene_limits.h"

namespace render_system {

namespace {

// The states of one kind at a time.
template <class State>
std::vector<State> states_at(const Tracks<State>& tracks, double time) {
    std::vector<State> states = tracks.rest;
    std::vector<double> value;
    for (const Track<State>& track : tracks.tracks) {
        sample_curve(track.curve, time, value);
        track.put(states[track.state], value);
    }
    return states;
}

CoreMaterial material_of(const MaterialState& state) {
    CoreMaterial material = state.core;
    material.emission = state.emission * state.emission_strength;
    for (size_t i = 0; i < state.transforms.size(); ++i) {
        if (state.moves[i]) put_texture_transform(state.transforms[i], material.*kTextureSlots[i]);
    }
    // As the loader has it: index 0 stands for one past all bounds.
    if (material.ior == 0.0f) material.transmission = 0.0f;
    return material;
}

Status play_materials(const Tracks<MaterialState>& tracks, double time, HostScene& scene) {
    for (const MaterialState& state : states_at(tracks, time)) {
        if (scene.is_removed_material(state.material)) continue;
        CoreMaterial material = material_of(state);
        const HostMaterial& before = scene.materials()[state.material];
        material.emission_weight = before.core.emission_weight;
        if (Status status = check_material(material); !status.ok())
            return Status::invalid("material " + std::to_string(state.material) + " \"" + before.name + "\" at " +
                                   std::to_string(time) + " s: " + status.message);
        if (material != before.core) scene.set_material(state.material, material);
    }
    return Status::success();
}

void play_lights(const Tracks<LightState>& tracks, double time, HostScene& scene) {
    for (const LightState& state : states_at(tracks, time)) {
        for (const uint32_t id : state.lights) {
            if (scene.is_removed_light(id)) continue;
            PunctualLight light = scene.punctual_lights()[id];
            light.emission = glm::clamp(glm::vec3(state.color * state.intensity), 0.0f, BRIGHTEST_LIGHT);
            light.outer_cone = state.outer_cone;
            light.inner_cone = std::min(state.inner_cone, state.outer_cone);
            const PunctualLight& before = scene.punctual_lights()[id];
            if (light.emission == before.emission && light.outer_cone == before.outer_cone &&
                light.inner_cone == before.inner_cone)
                continue;
            scene.set_punctual_light(id, std::move(light));
        }
    }
}

void play_cameras(const Tracks<CameraState>& tracks, double time, HostScene& scene) {
    for (const CameraState& state : states_at(tracks, time)) {
        for (const uint32_t id : state.cameras) {
            Camera camera = scene.cameras()[id].camera;
            camera.vertical_fov = state.vertical_fov;
            camera.parallel_height = state.parallel_height;
            scene.set_camera(id, camera);
        }
    }
}

}  // namespace

glm::dmat4 pose_matrix(const NodePose& pose) {
    const bool turns = glm::length(pose.rotation) > 0.0;
    glm::dmat4 matrix = turns ? glm::mat4_cast(glm::normalize(pose.rotation)) : glm::dmat4(1.0);
    for (int i = 0; i < 3; ++i) matrix[i] *= pose.scale[i];
    matrix[3] = glm::dvec4(pose.translation, 1.0);
    return matrix;
}

void put_texture_transform(const TextureTransform& transform, CoreTextureSlot& slot) {
    const glm::vec2 offset(transform.offset), scale(transform.scale);
    const auto c = static_cast<float>(std::cos(transform.rotation));
    const auto s = static_cast<float>(std::sin(transform.rotation));
    slot.row_u = {c * scale.x, s * scale.y, offset.x};
    slot.row_v = {-s * scale.x, c * scale.y, offset.y};
}

bool Animation::empty() const {
    return nodes.tracks.empty() && weights.tracks.empty() && materials.tracks.empty() && lights.tracks.empty() &&
           cameras.tracks.empty();
}

double Animation::duration() const {
    double last = 0.0;
    const auto look_at = [&](const auto& tracks) {
        for (const auto& track : tracks.tracks) last = std::max(last, static_cast<double>(track.curve.times->back()));
    };
    look_at(nodes);
    look_at(weights);
    look_at(materials);
    look_at(lights);
    look_at(cameras);
    return last;
}

Status play_animation(const Animation& animation, double time, HostScene& scene) {
    if (Status status = play_materials(animation.materials, time, scene); !status.ok()) return status;
    play_cameras(animation.cameras, time, scene);
    play_lights(animation.lights, time, scene);
    const std::vector<WeightState> weight_states = states_at(animation.weights, time);
    std::vector<NewWeights> weights;
    for (const WeightState& state : weight_states) {
        for (const uint32_t deformer : state.deformers) weights.push_back({deformer, state.weights});
    }
    std::vector<NodeMove> moves;
    for (const NodeState& state : states_at(animation.nodes, time))
        moves.push_back({state.node, pose_matrix(state.pose)});
    scene.set_poses(moves, weights);
    return Status::success();
}

}  // namespace render_system
