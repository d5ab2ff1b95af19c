// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "render_system/loader/gltf_document.h"

namespace render_system {

/// The node's EXT_mesh_gpu_instancing, null where it has none.
const tinygltf::Value* instancing_of(const tinygltf::Node& node);

/// How many instances that makes. Throws LoadError, with `place`, where the attributes differ in length.
uint64_t instance_count(const GltfDocument& document, const tinygltf::Value& instancing, const std::string& place);

/// Throws LoadError where a scene would have more than a million of them: attributes can be shared, so that a small
/// file could ask for any number.
void check_instance_total(uint64_t total);

/// Where the instances stand within their node: T * R * S of each element of its attributes. Throws LoadError, with
/// `place`, also where they hold what is no transform.
std::vector<glm::dmat4> instance_transforms(const GltfDocument& document, const tinygltf::Value& instancing,
                                            const std::string& place);

}  // namespace render_system
