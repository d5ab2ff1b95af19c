// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/scene_setup.h"

#include <fmt/format.h>

#include <chrono>
#include <optional>

#include "metrics/text/visible.h"
#include "render_system/default_sky.h"
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

/// Puts the file's lights into the scene.
Status add_area_lights(const CameraFile& file, HostScene& scene) {
    for (const render_system::QuadLight& light : file.area_lights) {
        if (Status status = add_area_light(scene, light); !status.ok()) return status;
    }
    return Status::success();
}

/// What the command line names beside the scene, read before it: a slip in a name is told at once.
struct Companions {
    std::optional<CameraFile> camera;
    std::optional<render_system::Sky> sky;
};

Result<Companions> read_companions(const Options& options, Console& console) {
    Companions companions;
    std::vector<std::string> warnings;
    if (!options.camera.file.empty()) {
        auto camera = render_system::load_camera_file(options.camera.file, &warnings);
        if (!camera.ok()) return camera.status;
        companions.camera = std::move(*camera);
    }
    if (!options.sky.file.empty()) {
        auto sky = render_system::load_sky(options.sky.file, &warnings);
        if (!sky.ok()) return sky.status;
        companions.sky = std::move(*sky);
    } else if (options.sky.radiance) {
        const auto& radiance = *options.sky.radiance;
        companions.sky = render_system::Sky{.radiance = {radiance[0], radiance[1], radiance[2]}};
    }
    for (const std::string& warning : warnings) console.warning(metrics::visible(warning));
    return companions;
}

/// The view of the whole scene, said with the option that repeats it.
Camera default_camera(const Options& options, const HostScene& scene, Console& console) {
    const float aspect = static_cast<float>(options.width) / static_cast<float>(options.height);
    const float fov = options.vertical_fov.value_or(render_system::kDefaultFov);
    const auto [eye, target] = framing_view(scene, aspect, fov);
    console.note(fmt::format("no camera in the scene: the view frames all of it, --look-at {},{},{},{},{},{}", eye.x,
                             eye.y, eye.z, target.x, target.y, target.z));
    return render_system::look_at(eye, target, {0.0f, 1.0f, 0.0f}, fov);
}

/// The number of the camera that `--camera` names, or of the scene's first; none where there is none to name.
Result<std::optional<uint32_t>> camera_of_scene(const Options& options, const HostScene& scene) {
    const auto& cameras = scene.cameras();
    const uint32_t index = options.camera.index.value_or(0);
    if (index < cameras.size()) return std::optional(index);
    if (!options.camera.index) return std::optional<uint32_t>();
    const std::string offer = cameras.empty() ? "has no camera; leave --camera out for a view of the whole scene"
                                              : fmt::format("has {}; the first is 0", cameras.size());
    return Status::invalid(fmt::format("--camera: there is no camera {}: {} {}", index, options.scene, offer));
}

/// `--aperture` and `--focus`; a lens that is told no focus is sharp where `--look-at` looks.
Status put_lens(const Options& options, Camera& camera) {
    if (!options.aperture) {
        if (!options.focus) return Status::success();
        return Status::invalid(
            "--focus: a pinhole is sharp at every distance; give a lens by --aperture, or leave it out");
    }
    if (!options.focus && !options.look_at)
        return Status::invalid("--aperture: a lens needs --focus, the distance at which the picture is sharp");
    camera.aperture = *options.aperture;
    if (options.focus) {
        camera.focus = *options.focus;
    } else {
        const auto& [eye, target] = *options.look_at;
        camera.focus = glm::distance(glm::vec3(eye[0], eye[1], eye[2]), glm::vec3(target[0], target[1], target[2]));
    }
    return Status::success();
}

/// Field of view and lens as the options have them.
Result<Camera> with_lens(const Options& options, Camera camera) {
    if (options.vertical_fov) {
        camera.vertical_fov = *options.vertical_fov;
        camera.parallel_height = 0.0f;  // an orthographic one becomes one by perspective
    }
    if (const Status lens = put_lens(options, camera); !lens.ok()) return lens;
    const Status status = check_camera(camera);
    if (status.ok()) return camera;
    return Status::error(status.code, fmt::format("{}: {}; or give --look-at", options.scene, status.message));
}

/// Sets the camera of `setup`, and whether it is one of the scene's.
Status choose_camera(const Options& options, const Companions& companions, SceneSetup& setup, Console& console) {
    std::optional<Camera> camera;
    if (companions.camera) {
        camera = companions.camera->camera;
    } else {
        const auto found = camera_of_scene(options, setup.scene);
        if (!found.ok()) return found.status;
        if (*found) camera = setup.scene.cameras()[**found].camera;
        if (!options.look_at) setup.followed = *found;
    }
    if (options.look_at) {
        if (companions.camera)
            console.note(fmt::format("--look-at has the view; of {} the field of view, sky and lights count",
                                     options.camera.file));
        const auto& [eye, target] = *options.look_at;
        const float fov = options.camera.index || companions.camera ? camera->vertical_fov : render_system::kDefaultFov;
        camera = render_system::look_at({eye[0], eye[1], eye[2]}, {target[0], target[1], target[2]}, {0.0f, 1.0f, 0.0f},
                                        fov);
    }
    if (!camera) camera = default_camera(options, setup.scene, console);
    const auto chosen = with_lens(options, *camera);
    if (chosen.ok()) setup.camera = *chosen;
    return chosen.status;
}

/// `--sky`, else the camera file's, else the scene's own, else black where the scene lights itself.
void choose_sky(Companions& companions, const Camera& camera, HostScene& scene, Console& console) {
    if (companions.sky) {
        scene.set_sky(std::move(*companions.sky));
    } else if (companions.camera && companions.camera->has_sky) {
        scene.set_sky({.radiance = companions.camera->sky_radiance});
    } else if (!scene.sky().texels.empty()) {
        return;
    } else if (!lights_itself(scene, camera)) {
        console.note("the scene does not light itself: it stands in a neutral studio sky; --sky 0,0,0 leaves it black");
        scene.set_sky(render_system::studio_sky());
    }
}

/// `<prefix>/share/porttool` of a program in `<prefix>/bin`.
path installed_data_folder() {
    std::error_code error;
    const path program = std::filesystem::read_symlink("/proc/self/exe", error);
    return error ? path() : program.parent_path().parent_path() / PORTTOOL_DATA_FOLDER;
}

std::vector<InputFile> input_files(const Options& options, const std::vector<path>& of_scene) {
    std::vector<InputFile> inputs = {{"--camera", options.camera.file}, {"--sky", options.sky.file}};
    for (const path& file : of_scene) inputs.push_back({"the scene", file});
    std::error_code error;
    if (options.kernels.empty()) return inputs;
    for (const auto& entry : std::filesystem::directory_iterator(options.kernels, error))
        inputs.push_back({"--kernels", entry.path()});
    return inputs;
}

}  // namespace

path scene_path(const std::string& scene) {
    std::error_code error;
    const auto found = std::filesystem::status(scene, error);
    const bool is_there = std::filesystem::exists(found) && !std::filesystem::is_directory(found);
    if (is_there || scene.find('/') != std::string::npos) return scene;
    for (const path& folder : {installed_data_folder(), path(PORTTOOL_SOURCE_FOLDER)}) {
        path built_in = folder / "scenes" / scene / (scene + ".gltf");
        if (!folder.empty() && std::filesystem::exists(built_in, error)) return built_in;
    }
    return scene;
}

std::string default_picture_name(const std::string& scene) { return path(scene).stem().string() + ".png"; }

Result<Camera> followed_camera(const Options& options, const HostScene& scene, uint32_t followed) {
    return with_lens(options, scene.cameras()[followed].camera);
}

Result<SceneSetup> set_up_scene(const Options& options, Console& console, const std::vector<OutputFile>& outputs) {
    const auto start = std::chrono::steady_clock::now();
    auto companions = read_companions(options, console);
    if (!companions.ok()) return companions.status;
    auto loaded = render_system::load_scene(scene_path(options.scene), {.allow_outside = options.allow_outside,
                                                                        .variant = options.variant,
                                                                        .animation = options.animation,
                                                                        .time = options.time});
    if (!loaded.ok()) return loaded.status;
    if (Status status = check_outputs(outputs, input_files(options, loaded->files)); !status.ok()) return status;
    for (const std::string& warning : loaded->warnings) console.warning(metrics::visible(warning));
    SceneSetup setup{std::move(loaded->scene), {}, {}};
    HostScene& scene = setup.scene;

    if (companions->camera) {
        if (Status status = add_area_lights(*companions->camera, scene); !status.ok()) return status;
    }
    if (Status status = choose_camera(options, *companions, setup, console); !status.ok()) return status;
    const auto view = render_system::view_pyramid(setup.camera, options.width, options.height);
    if (const Status status = check_scene_limits(scene, view); !status.ok()) {
        return Status::error(status.code, options.scene + ": " + status.message);
    }

    choose_sky(*companions, setup.camera, scene, console);

    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    console.detail(
        fmt::format("{}: {} triangles in {} instances of {} meshes, {} materials, {} textures, read in "
                    "{:.2f} s",
                    options.scene, scene.triangle_count(), scene.instances().size(), scene.meshes().size(),
                    scene.materials().size(), scene.textures().size(), seconds.count()));
    return setup;
}

}  // namespace application
