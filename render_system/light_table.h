// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "render_system/core_data.h"
#include "render_system/host_scene.h"

namespace render_system {

/// The share of an emitter that alpha leaves, where it is the same everywhere: next event estimation multiplies the
/// emission by it. 0 where a texture decides: such an emitter is left to be found by chance, which is right on average.
float even_coverage(const CoreMaterial& material);

/// All lights of a scene in world space, with the table that chooses among them by power.
///
/// Weights are emitted power over pi, in scene units squared times radiance, so that they can be added up:
///   triangle     area * material.emission_weight (a Lambert emitter; the same for one and two sides, so that a hit
///                finds its density without knowing more than the material)
///   point        4 * luminance(intensity)
///   spot         4 * luminance(intensity) * the share of the sphere inside the cone, attenuated
///   directional  R^2 * luminance(irradiance), R the radius of the scene's bounding sphere
///   sky map      R^2 * the integral of luminance over all directions
/// Lights of weight 0 and triangles of no area are left out; a constant sky never takes part.
struct LightTable {
    std::vector<CoreLight> lights;
    std::vector<AliasEntry> table;
    float total_weight = 0.0f;
    float sky_probability = 0.0f;  ///< of the sky's entry; see CoreSky::light_probability
    float scene_radius = 0.0f;     ///< R as it was used
    bool uses_radius = false;      ///< whether a change of R changes the table

    CoreLights view() const;
};

/// One entry a texel of a sky map, proportional to luminance times solid angle, where luminance is the mean over the
/// texel and its eight neighbours: no direction that bilinear filtering lights has a density of 0.
struct SkyTable {
    std::vector<AliasEntry> table;
    double luminance_integral = 0.0;  ///< of the map over all directions
};

SkyTable build_sky_table(const Sky& sky);

enum class Emitters {
    all,
    without_unlit,
};

/// `sky_luminance_integral` is that of build_sky_table(scene.sky()), 0 without a map.
LightTable build_light_table(const HostScene& scene, double sky_luminance_integral, Emitters emitters = Emitters::all);

/// Half the diagonal of the scene's box; 1 for an empty scene.
float scene_radius(const HostScene& scene);

}  // namespace render_system
