// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <iterator>
#include <span>
#include <vector>

#include "render_system/animation/curve.h"
#include "render_system/core_data.h"
#include "render_system/status.h"

// What moves in a scene, and how. `HostScene::play` turns it into calls of the scene's own setters; what is not
// animated keeps the state that is stored here as the rest.

namespace render_system {

class HostScene;

/// A node's transform in its three parts: translation * rotation * scale.
struct NodePose {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
};

/// The matrix of a pose, with the rotation scaled to unit length; one of no length does not turn.
glm::dmat4 pose_matrix(const NodePose& pose);

/// A texture's transform in its three parts (KHR_texture_transform); turned counter-clockwise, in radians.
struct TextureTransform {
    glm::dvec2 offset{0.0};
    glm::dvec2 scale{1.0};
    double rotation = 0.0;
};

/// Writes the rows of the transform into a slot.
void put_texture_transform(const TextureTransform& transform, CoreTextureSlot& slot);

/// A node that moves.
struct NodeState {
    uint32_t node = NONE;
    NodePose pose;
};

/// The weights of the morph targets of some deformers.
struct WeightState {
    std::vector<uint32_t> deformers;
    std::vector<double> weights;
};

/// A material that changes, in the parts that its file has.
struct MaterialState {
    uint32_t material = NONE;
    CoreMaterial core;
    glm::vec3 emission{0.0f};                                             ///< before the strength
    float emission_strength = 1.0f;                                       ///< KHR_materials_emissive_strength
    std::array<TextureTransform, std::size(kTextureSlots)> transforms{};  ///< by slot, in the order of kTextureSlots
    std::array<bool, std::size(kTextureSlots)> moves{};                   ///< whether a slot's transform is animated
};

/// A light that changes; several of the scene's may be one of its file.
struct LightState {
    std::vector<uint32_t> lights;
    glm::dvec3 color{1.0};
    double intensity = 1.0;
    float inner_cone = 0.0f;
    float outer_cone = 0.7853982f;
};

/// The lens of a camera that changes; several of the scene's may be one of its file.
struct CameraState {
    std::vector<uint32_t> cameras;
    float vertical_fov = 0.0f;
    float parallel_height = 0.0f;
};

/// One curve and what it writes to: `put` sets a part of states[state] in the list of that kind.
template <class State>
struct Track {
    uint32_t state = 0;
    Curve curve;
    std::function<void(State&, std::span<const double>)> put;
};

/// All states of one kind and the tracks that change them, each part by one track at most.
template <class State>
struct Tracks {
    std::vector<State> rest;
    std::vector<Track<State>> tracks;
};

/// All that is animated in a scene.
struct Animation {
    Tracks<NodeState> nodes;
    Tracks<WeightState> weights;
    Tracks<MaterialState> materials;
    Tracks<LightState> lights;
    Tracks<CameraState> cameras;

    bool empty() const;
    /// Seconds up to the last key of all.
    double duration() const;
};

/// Brings the scene to `time` seconds by its setters. What comes out as it is already raises no flag. Fails with
/// invalid_argument where a material cannot be shown; nodes and lights out of bounds are for check_scene_limits.
Status play_animation(const Animation& animation, double time, HostScene& scene);

}  // namespace render_system
