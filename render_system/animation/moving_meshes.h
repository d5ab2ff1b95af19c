// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "render_system/host_scene.h"

namespace render_system {

/// What an animation does to the meshes of its scene, by mesh.
struct MovingMeshes {
    std::vector<bool> moves;    ///< an instance of it goes elsewhere
    std::vector<bool> deforms;  ///< its vertices do: by joints that move, or by weights that change
};

/// Asks for what any track of the scene's animation reaches, at whatever time; no mesh without one.
MovingMeshes moving_meshes(const HostScene& scene);

}  // namespace render_system
