// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render_system/host_scene.h"

namespace render_system {

/// Whether the scene needs no sky to be seen from there: it has punctual lights, or its emission lights it. For that,
/// of 1,024 fixed points on surfaces that neither emit nor are unlit, seen from the camera in a picture of 16:9, at
/// least half must receive direct irradiance above 0.05; what unlit surfaces give off does not count. Depends on scene
/// and camera alone; takes time for the meshes in view where something emits.
bool lights_itself(const HostScene& scene, const Camera& camera);

/// A neutral sky for what has no light of its own: brighter above than below, with one large soft light and a fill. A
/// white diffuse floor under it has a radiance of about 1.
Sky studio_sky();

}  // namespace render_system
