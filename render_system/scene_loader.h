// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "render_system/host_scene.h"
#include "render_system/status.h"
#include "render_system/texture.h"

namespace render_system {

/// A scene, and what its file asked for that it does not have: one line each, each naming the file. All that is not
/// supported is in one line.
struct LoadedScene {
    HostScene scene;
    std::vector<std::string> warnings;
    std::vector<std::filesystem::path> files;  ///< the file and those that it names: buffers, images, materials
};

/// What the caller lets a scene do.
struct LoadOptions {
    bool allow_outside = false;  ///< buffers and images may lie outside the scene's folder
    std::string variant;         ///< of KHR_materials_variants, by name; empty: the file's own materials
    std::string animation;       ///< the only one to play, by name or else by number; empty: all of the file's
    double time = 0.0;           ///< seconds, at which an animated scene is shown
};

/// Reads a glTF 2.0 file (.gltf or .glb, told apart by content), or a Wavefront OBJ or an FBX (told by the name's
/// ending) through `pathtracer-import`, a program beside this one. Cameras are those of the scene's camera nodes in
/// node order; light intensities are taken as radiometric; its sky is black but for
/// an image-based light. A buffer or image outside the scene's folder is
/// refused unless allowed, and so is what a core could not take (scene_limits.h). Fails with not_found or unreadable;
/// the message names the file, the place in it, what is wrong and what to do.
Result<LoadedScene> load_scene(const std::filesystem::path& path, const LoadOptions& options = {});

/// A one-sided quadrilateral light.
struct QuadLight {
    std::array<glm::vec3, 4> corners{};  ///< counter-clockwise as seen from the emitting side
    glm::vec3 radiance{0.0f};
};

/// What a camera file says (camera.json beside a scene): world space, lengths in scene units.
struct CameraFile {
    Camera camera;
    bool has_sky = false;  ///< whether the file has `sky_radiance`
    glm::vec3 sky_radiance{0.0f};
    std::vector<QuadLight> area_lights;
};

/// Reads a camera file: position, target, up, vfov_degrees, and optionally sky_radiance and area_lights (4 corners,
/// radiance, and a normal that must agree with the corners). Of other keys `description` and `emitters_in_gltf` are
/// left alone; what is not known is named in one warning, which is added to `warnings` where given. Fails as load_scene
/// does.
Result<CameraFile> load_camera_file(const std::filesystem::path& path, std::vector<std::string>* warnings = nullptr);

/// Adds a quadrilateral light to the scene: two triangles with a black, emissive, one-sided material. Fails with
/// invalid_argument if the corners enclose no area or something is not finite or negative.
Status add_area_light(HostScene& scene, const QuadLight& light);

/// Reads an equirectangular map (Radiance .hdr or .exr) as a sky. Negative and NaN texels become 0, which is added to
/// `warnings` where given. Fails as load_scene does.
Result<Sky> load_sky(const std::filesystem::path& path, std::vector<std::string>* warnings = nullptr);

/// Reads a picture of any program: PNG, Radiance HDR, OpenEXR, or another kind that a texture may be. Numbers are as
/// stored, NaN too; grey becomes RGB (`channels` says so). Fails as load_scene does.
Result<Image> load_image(const std::filesystem::path& path);

}  // namespace render_system
