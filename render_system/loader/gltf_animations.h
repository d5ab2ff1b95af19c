// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <vector>

#include "render_system/animation/animation.h"
#include "render_system/loader/gltf_document.h"

namespace render_system {

/// All channels of the file's animations. Throws LoadError where one has a sampler that is not there.
std::vector<GltfChannel> read_channels(const nlohmann::json& document, Omissions& omissions);

/// The names of the file's animations; empty where one has none.
std::vector<std::string> animation_names(const nlohmann::json& document);

/// Keeps the channels of one animation alone: the first of that name, else the one of that number. Throws LoadError
/// where there is none; an empty `wanted` keeps all.
void choose_animation(GltfDocument& document, const std::string& wanted);

/// Whether anything animates the weights of the node's mesh.
std::set<int> nodes_with_animated_weights(const GltfDocument& document);

/// The materials that a channel points at.
std::set<int> animated_materials(const GltfDocument& document);

/// What the parts of the file have become in the scene, by the file's numbers.
struct SceneParts {
    std::map<int, uint32_t> nodes;  ///< of the scene shown
    std::map<int, std::vector<uint32_t>> deformers;
    std::map<int, std::vector<uint32_t>> lights;
    std::map<int, std::vector<uint32_t>> cameras;
};

/// The pose of a node that has no matrix.
NodePose pose_of(const tinygltf::Node& node);

/// All animations of the file as one: they play at once, and of two that move the same the file's first counts. What
/// cannot be animated is added to the omissions. Throws LoadError where keys are missing, out of order, not finite or
/// not as many as their values.
Animation read_animation(GltfDocument& document, const SceneParts& parts, const HostScene& scene);

}  // namespace render_system
