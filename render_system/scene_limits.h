// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "render_system/core_data.h"
#include "render_system/host_scene.h"
#include "render_system/status.h"

// How large a scene may be and how far off its camera: where floats still hold the cores' arithmetic, and where Embree
// does not end the process. One place for the loaders, the render system and CoreContract.

namespace render_system {

/// Coordinates of a placed vertex, either sign. The fourth power of what is larger is past a float: a triangle's normal
/// is lost. Measured: up to 1.7e9 pictures stay the same, bit for bit, from 3.4e9 on they do not.
constexpr float FARTHEST_VERTEX = 1e9f;
/// Coordinates of the eye and of a light without extent. Three of them are multiplied in a triangle test.
constexpr float FARTHEST_EYE = 1e12f;
/// The radius of a lens, in distances of its focus: past about a million times that, rays have no direction left.
constexpr float WIDEST_LENS = 1000.0f;
/// What a ray may become in an instance's own space. Embree asserts 1.844e18 of a ray's origin and direction.
constexpr double FARTHEST_LOCAL = 1e18;

/// Texture coordinates and the numbers of a texture's transform, either sign. A ray cone's footprint is made of two of
/// each: it stays a number for as long as their products do.
constexpr float FARTHEST_TEXTURE = 1e8f;
/// Radiance, intensity and irradiance of one light: what is summed over all of them, times their areas, stays a number.
constexpr float BRIGHTEST_LIGHT = 1e12f;
/// Index of refraction of what transmits, and its inverse the lowest. 0 (KHR_materials_ior: all light is reflected) is
/// for what does not.
constexpr float HIGHEST_IOR = 1e4f;

/// What an instance does to coordinates.
struct Placement {
    double reach = 0.0;    ///< the largest coordinate of the placed mesh's box
    double offset = 0.0;   ///< the largest coordinate of the matrix's translation
    double inverse = 0.0;  ///< by how much the way back into the mesh's own space can enlarge a vector
};

/// Whether floats can invert the matrix: neither flattened nor sheared to nearly nothing, nor scaled past their range.
bool is_invertible(const CoreTransform& transform);

/// Whether the matrix flattens everything: that leaves no normals, and no way back from world to object space. What is
/// not invertible for being too large is none of this.
bool is_scaled_to_nothing(const CoreTransform& transform);

/// Of an invertible matrix; `box` is in the mesh's own space and may be empty.
Placement placement_of(const Box& box, const CoreTransform& transform);

/// Fails with invalid_argument where a placed vertex would be past FARTHEST_VERTEX.
Status check_placement(const Placement& placement);

/// Whether rays from anywhere up to `reach` stay within FARTHEST_LOCAL in the instance's own space.
Status check_rays_into(const Placement& placement, double reach);

/// Fails with invalid_argument where the eye is not finite or past FARTHEST_EYE, or the screen is no screen.
Status check_view(const ViewPyramid& view);

/// The same of a camera that is yet to get its screen.
Status check_camera(const Camera& camera);

/// Fails with invalid_argument where a light's place is not finite or past FARTHEST_EYE.
Status check_light_position(const glm::vec3& position);

/// Fails with invalid_argument where a factor is not finite or negative, an emission past BRIGHTEST_LIGHT, the index of
/// a transmitting solid past HIGHEST_IOR, or a texture's transform past FARTHEST_TEXTURE: texels would be looked up at
/// places that are none.
Status check_material(const CoreMaterial& material);

/// Whether all texture coordinates are up to FARTHEST_TEXTURE.
bool within_texture(std::span<const glm::vec2> coordinates);

/// Whether light is finite, not negative and up to BRIGHTEST_LIGHT.
bool is_light(const glm::vec3& light);

/// The largest coordinate of a point, either sign; NaN where one is NaN.
double largest_coordinate(const glm::vec3& point);

/// ` (mesh "NAME")` for a message; nothing where the mesh has no name.
std::string mesh_name(const HostScene& scene, uint32_t mesh);

/// All of the above for a scene seen so; the message names the mesh and the instance.
Status check_scene_limits(const HostScene& scene, const ViewPyramid& view);

}  // namespace render_system
