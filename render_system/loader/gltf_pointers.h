// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "render_system/animation/animation.h"
#include "render_system/loader/tinygltf_model.h"

// What KHR_animation_pointer can point at: JSON pointers of the glTF object model, and what each sets.

namespace render_system {

/// An element of one of the file's arrays, and what below it is meant.
struct PointedProperty {
    std::string list;  ///< "/nodes", "/materials", "/cameras" or "/extensions/KHR_lights_punctual/lights"
    int index = 0;
    std::string property;  ///< "pbrMetallicRoughness/metallicFactor"
};

/// Takes a pointer apart; none where it points at anything else.
std::optional<PointedProperty> split_pointer(std::string_view pointer);

/// A property as a track sets it: how many numbers it has, and what becomes of them.
template <class State>
struct AnimatedProperty {
    uint32_t width = 1;
    std::function<void(State&, std::span<const double>)> put;
};

/// Factors of what the file's material has; values are held to the range of each. None: it cannot be animated here.
std::optional<AnimatedProperty<MaterialState>> material_property(const std::string& property,
                                                                 const tinygltf::Material& material);
std::optional<AnimatedProperty<LightState>> light_property(const std::string& property);
std::optional<AnimatedProperty<CameraState>> camera_property(const std::string& property);

/// The parts of a material as its file has them; `core` is what was made of it.
MaterialState material_state(const tinygltf::Material& material, uint32_t id, const CoreMaterial& core);

}  // namespace render_system
