// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/scene_setup.h"

#include <fmt/format.h>

#include <chrono>
#include <optional>

#include "render_system/scene_limits.h"
#include "render_system/scene_loader.h"

namespace application {
namespace {

using render_system::Camera;
using render_system::CameraFile;
using render_system::HostScene;
using render_system::Result;
using render_system::Status;
using std::filesystem::path;

/// Puts the file's lights and sky into the scene.
Status apply_camera_file(const CameraFile& file, HostScene& scene) {
    for (const render_system::QuadLight& light : file.area_lights) {
        if (Status status = add_area_light(scene, light); !status.ok()) return status;
    }
    if (file.has_sky) scene.set_sky({.radiance = file.sky_radiance});
    return Status::success();
}

/// The camera that `--camera` names by number, or the scene's first.
Result<Camera> camera_of_scene(const Options& options, const HostScene& scene, Console& console) {
    const auto& cameras = scene.cameras();
    const uint32_t index = options.camera.index.value_or(0);
    if (index < cameras.size()) {
        const Status status = check_camera(cameras[index].camera);
        if (status.ok()) return cameras[index].camera;
        return Status::error(status.code, fmt::format("{}: camera {}: {}", options.scene, index, status.message));
    }
    if (options.camera.index) {
        const std::string offer = cameras.empty() ? "has no camera; leave --camera out for a view of the whole scene"
                                                  : fmt::format("has {}; the first is 0", cameras.size());
        return Status::invalid(fmt::format("--camera: there is no camera {}: {} {}", index, options.scene, offer));
    }
    console.note("no camera in the scene: the view is from +z and frames all of it");
    const Camera camera = framing_camera(scene, static_cast<float>(options.width) / static_cast<float>(options.height));
    const Status status = check_camera(camera);
    if (status.ok()) return camera;
    return Status::error(status.code, fmt::format("{}: seen whole at {}x{}, {}; or give --camera", options.scene,
                                                  options.width, options.height, status.message));
}

/// Camera, and what a camera file adds to the scene.
Result<Camera> choose_camera(const Options& options, HostScene& scene, bool& sky_given, Console& console) {
    if (options.camera.file.empty()) return camera_of_scene(options, scene, console);
    const auto file = render_system::load_camera_file(options.camera.file);
    if (!file.ok()) return file.status;
    if (Status status = apply_camera_file(*file, scene); !status.ok()) return status;
    sky_given = file->has_sky;
    return file->camera;
}

Status choose_sky(const Options& options, bool sky_given, HostScene& scene, Console& console) {
    if (!options.sky.file.empty()) {
        std::vector<std::string> warnings;
        auto sky = render_system::load_sky(options.sky.file, &warnings);
        if (!sky.ok()) return sky.status;
        for (const std::string& warning : warnings) console.warning(warning);
        scene.set_sky(std::move(*sky));
    } else if (options.sky.radiance) {
        const auto& radiance = *options.sky.radiance;
        scene.set_sky({.radiance = {radiance[0], radiance[1], radiance[2]}});
    } else if (!sky_given && !scene.has_light()) {
        console.note("no light in the scene: the sky is white");
        scene.set_sky({.radiance = glm::vec3(1.0f)});
    }
    return Status::success();
}

/// `<prefix>/share/porttool` of a program in `<prefix>/bin`.
path installed_data_folder() {
    std::error_code error;
    const path program = std::filesystem::read_symlink("/proc/self/exe", error);
    return error ? path() : program.parent_path().parent_path() / PORTTOOL_DATA_FOLDER;
}

}  // namespace

path scene_path(const std::string& scene) {
    std::error_code error;
    if (std::filesystem::exists(scene, error) || scene.find('/') != std::string::npos) return scene;
    for (const path& folder : {installed_data_folder(), path(PORTTOOL_SOURCE_FOLDER)}) {
        path built_in = folder / "scenes" / scene / (scene + ".gltf");
        if (!folder.empty() && std::filesystem::exists(built_in, error)) return built_in;
    }
    return scene;
}

std::string default_picture_name(const std::string& scene) { return path(scene).stem().string() + ".png"; }

Result<SceneSetup> set_up_scene(const Options& options, Console& console) {
    const auto start = std::chrono::steady_clock::now();
    auto loaded = render_system::load_scene(scene_path(options.scene), {.allow_outside = options.allow_outside});
    if (!loaded.ok()) return loaded.status;
    for (const std::string& warning : loaded->warnings) console.warning(warning);
    HostScene& scene = loaded->scene;

    bool sky_given = false;
    const auto camera = choose_camera(options, scene, sky_given, console);
    if (!camera.ok()) return camera.status;
    if (Status status = choose_sky(options, sky_given, scene, console); !status.ok()) return status;
    const auto view = render_system::view_pyramid(*camera, options.width, options.height);
    if (const Status status = check_scene_limits(scene, view); !status.ok()) {
        return Status::error(status.code, options.scene + ": " + status.message);
    }

    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    console.detail(
        fmt::format("{}: {} triangles in {} instances of {} meshes, {} materials, {} textures, read in "
                    "{:.2f} s",
                    options.scene, scene.triangle_count(), scene.instances().size(), scene.meshes().size(),
                    scene.materials().size(), scene.textures().size(), seconds.count()));
    return SceneSetup{std::move(scene), *camera};
}

}  // namespace application
