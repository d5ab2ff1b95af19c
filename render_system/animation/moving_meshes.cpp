// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/animation/moving_meshes.h"

#include <algorithm>
#include <cstdint>

#include "render_system/animation/animation.h"

namespace render_system {
namespace {

// By node: those with a track, and all that hangs on them.
std::vector<bool> moving_nodes(const HostScene& scene, const Animation& animation) {
    std::vector<bool> moves(scene.nodes().size(), false);
    for (const Track<NodeState>& track : animation.nodes.tracks) moves[animation.nodes.rest[track.state].node] = true;
    for (size_t i = 0; i < moves.size(); ++i) {
        const uint32_t parent = scene.nodes()[i].parent;
        if (parent != NONE && moves[parent]) moves[i] = true;
    }
    return moves;
}

}  // namespace

MovingMeshes moving_meshes(const HostScene& scene) {
    MovingMeshes out{std::vector<bool>(scene.meshes().size(), false), std::vector<bool>(scene.meshes().size(), false)};
    if (!scene.is_animated()) return out;
    const Animation& animation = *scene.animation();
    const std::vector<bool> nodes = moving_nodes(scene, animation);
    for (size_t i = 0; i < nodes.size(); ++i)
        if (nodes[i] && scene.nodes()[i].instance != NONE && scene.nodes()[i].mesh != NONE)
            out.moves[scene.nodes()[i].mesh] = true;
    const auto deform = [&](const HostDeformer& deformer) {
        if (deformer.mesh != NONE) out.deforms[deformer.mesh] = true;
    };
    for (const Track<WeightState>& track : animation.weights.tracks)
        for (const uint32_t id : animation.weights.rest[track.state].deformers) deform(scene.deformers()[id]);
    for (const HostDeformer& deformer : scene.deformers()) {
        if (!deformer.skin) continue;
        const std::vector<uint32_t>& joints = deformer.skin->joints;
        if (std::any_of(joints.begin(), joints.end(), [&](uint32_t joint) { return nodes[joint]; })) deform(deformer);
    }
    return out;
}

}  // namespace render_system
