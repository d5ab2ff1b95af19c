// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render_system/loader/file_bytes.h"
#include "render_system/loader/load_error.h"
#include "render_system/scene_limits.h"
#include "render_system/scene_loader.h"

namespace render_system {

namespace {

using nlohmann::json;

constexpr float RADIANS_PER_DEGREE = 0.017453292f;

const json& member(const json& object, const char* key, const std::string& place) {
    if (!object.is_object()) fail_at(place.empty() ? "/" : place, "is no object; write {...} with its members");
    const auto found = object.find(key);
    if (found == object.end()) fail_at(place + "/" + key, "is missing; add it");
    return *found;
}

// What a camera file may say. The first two of a file are for its readers.
constexpr std::string_view kMembers[]{"description", "emitters_in_gltf", "position",     "target",
                                      "up",          "vfov_degrees",     "sky_radiance", "area_lights"};
constexpr std::string_view kLightMembers[]{"corners", "radiance", "normal"};

// Members that the picture is made without: of a slip in one that may be missing nothing else would tell.
void note_unknown(const json& object, std::span<const std::string_view> known, const std::string& place,
                  std::vector<std::string>& unknown) {
    for (const auto& [key, value] : object.items()) {
        if (std::find(known.begin(), known.end(), key) == known.end()) unknown.push_back(place + "/" + key);
    }
}

std::string unknown_text(const std::vector<std::string>& unknown) {
    constexpr size_t kNamed = 4;
    std::string text = "not known and left out: " + unknown.front();
    for (size_t i = 1; i < std::min(unknown.size(), kNamed); ++i) text += ", " + unknown[i];
    if (unknown.size() > kNamed) text += " and " + std::to_string(unknown.size() - kNamed) + " more";
    return text +
           "; a camera file has position, target, up, vfov_degrees, sky_radiance, area_lights, and each light corners, "
           "radiance, normal";
}

// The document, none of whose objects says a thing twice: of the two values one would be left out without a word.
json parse_said_once(std::string_view text) {
    std::vector<std::set<std::string>> open;
    return json::parse(text, [&open](int, json::parse_event_t event, const json& parsed) {
        if (event == json::parse_event_t::object_start) open.emplace_back();
        if (event == json::parse_event_t::object_end) open.pop_back();
        if (event == json::parse_event_t::key && !open.back().insert(parsed.get<std::string>()).second)
            fail_at('"' + parsed.get<std::string>() + '"', "is given twice in one object; keep one of the two");
        return true;
    });
}

float number_of(const json& value, const std::string& place) {
    if (!value.is_number() || !std::isfinite(value.get<float>()))
        fail_at(place, "must be a number; write a finite one");
    return value.get<float>();
}

glm::vec3 vector_of(const json& value, const std::string& place) {
    if (!value.is_array() || value.size() != 3)
        fail_at(place, "must be an array of three numbers; write e.g. [0, 1, 0]");
    glm::vec3 result;
    for (int i = 0; i < 3; ++i) {
        result[i] = number_of(value[static_cast<size_t>(i)], place + "/" + std::to_string(i));
    }
    return result;
}

glm::vec3 radiance_of(const json& value, const std::string& place) {
    const glm::vec3 radiance = vector_of(value, place);
    if (radiance.x < 0.0f || radiance.y < 0.0f || radiance.z < 0.0f)
        fail_at(place, "must not be negative; raise it to 0");
    return radiance;
}

QuadLight quad_light_of(const json& value, const std::string& place, std::vector<std::string>& unknown) {
    QuadLight light;
    const json& corners = member(value, "corners", place);
    note_unknown(value, kLightMembers, place, unknown);
    if (!corners.is_array() || corners.size() != 4)
        fail_at(place + "/corners", "must be four points; write an array of four arrays of three numbers");
    for (size_t i = 0; i < 4; ++i) {
        const std::string corner = place + "/corners/" + std::to_string(i);
        light.corners[i] = vector_of(corners[i], corner);
        const Placement placement{.reach = largest_coordinate(light.corners[i])};
        if (const Status status = check_placement(placement); !status.ok()) fail_at(corner, status.message);
    }
    light.radiance = radiance_of(member(value, "radiance", place), place + "/radiance");
    const glm::vec3 front = glm::cross(light.corners[1] - light.corners[0], light.corners[3] - light.corners[0]);
    if (!(glm::length(front) > 0.0f)) fail_at(place + "/corners", "enclose no area; move them apart");
    if (value.contains("normal") && !(glm::dot(vector_of(value["normal"], place + "/normal"), front) > 0.0f)) {
        fail_at(place + "/normal", "points away from the side whose corners run counter-clockwise; turn one of both");
    }
    return light;
}

CameraFile camera_file_of(const json& root, std::vector<std::string>& unknown) {
    CameraFile file;
    const glm::vec3 position = vector_of(member(root, "position", ""), "/position");
    note_unknown(root, kMembers, "", unknown);
    const glm::vec3 target = vector_of(member(root, "target", ""), "/target");
    const glm::vec3 up = vector_of(member(root, "up", ""), "/up");
    const float degrees = number_of(member(root, "vfov_degrees", ""), "/vfov_degrees");
    if (!(degrees > 0.0f && degrees < 180.0f)) fail_at("/vfov_degrees", "must be between 0 and 180; write e.g. 40");
    if (position == target) fail_at("/target", "is the camera's own position; name a point to look at");
    if (up == glm::vec3(0.0f)) fail_at("/up", "has no length; use e.g. [0, 1, 0]");
    const glm::dvec3 aside = glm::cross(glm::dvec3(target) - glm::dvec3(position), glm::dvec3(up));
    if (glm::length(aside) <=
        1e-6 * glm::length(glm::dvec3(target) - glm::dvec3(position)) * glm::length(glm::dvec3(up))) {
        fail_at("/up", "is parallel to the view; use a direction that is not");
    }
    if (const Status status = check_camera({.position = position}); !status.ok()) fail_at("/position", status.message);
    file.camera = look_at(position, target, up, degrees * RADIANS_PER_DEGREE);
    file.has_sky = root.contains("sky_radiance");
    if (file.has_sky) file.sky_radiance = radiance_of(root["sky_radiance"], "/sky_radiance");
    if (!root.contains("area_lights")) return file;
    const json& lights = root["area_lights"];
    if (!lights.is_array()) fail_at("/area_lights", "must be an array; write [] for no lights");
    for (size_t i = 0; i < lights.size(); ++i) {
        file.area_lights.push_back(quad_light_of(lights[i], "/area_lights/" + std::to_string(i), unknown));
    }
    return file;
}

}  // namespace

Result<CameraFile> load_camera_file(const std::filesystem::path& path, std::vector<std::string>* warnings) {
    const auto unreadable = [&](const std::string& why) {
        return Status::error(StatusCode::unreadable, path.string() + ": " + why);
    };
    try {
        const FileBytes file(path);
        const auto* text = reinterpret_cast<const char*>(file.bytes().data());
        if (file.bytes().empty()) return unreadable("the file is empty; a camera file is JSON");
        std::vector<std::string> unknown;
        CameraFile camera = camera_file_of(parse_said_once({text, file.bytes().size()}), unknown);
        if (warnings && !unknown.empty()) warnings->push_back(path.string() + ": " + unknown_text(unknown));
        return camera;
    } catch (const LoadError& error) {
        return Status::error(error.code, path.string() + ": " + error.message);
    } catch (const json::exception& error) {
        const std::string what = error.what();  // after an error number of the parser's own
        const size_t start = what.find("] ");
        return unreadable("is no camera file (" + (start == std::string::npos ? what : what.substr(start + 2)) +
                          "); name one that the key K of 'pathtracer view' saved");
    }
}

Status add_area_light(HostScene& scene, const QuadLight& light) {
    const auto refuse = [](const char* why) { return Status::invalid(std::string("area light: ") + why); };
    HostMesh mesh;
    mesh.name = "area light";
    for (const glm::vec3& corner : light.corners) {
        if (!std::isfinite(corner.x + corner.y + corner.z)) return refuse("a corner is not finite");
        mesh.positions.push_back(corner);
    }
    for (int i = 0; i < 3; ++i) {
        if (!(light.radiance[i] >= 0.0f) || !std::isfinite(light.radiance[i])) {
            return refuse("its radiance is not a number of at least 0");
        }
    }
    const glm::dvec3 front = glm::cross(glm::dvec3(light.corners[1]) - glm::dvec3(light.corners[0]),
                                        glm::dvec3(light.corners[3]) - glm::dvec3(light.corners[0]));
    if (!(glm::length(front) > 0.0)) return refuse("its corners enclose no area");
    mesh.normals.assign(4, glm::vec3(glm::normalize(front)));
    HostMaterial material;
    material.name = "area light";
    material.core.base_color = glm::vec3(0.0f);
    material.core.specular = 0.0f;
    material.core.metallic = 0.0f;
    material.core.emission = light.radiance;
    const uint32_t id = scene.add_material(material);
    mesh.triangles = {{0, 1, 2, id}, {0, 2, 3, id}};
    scene.add_instance(scene.add_mesh(std::move(mesh)), CoreTransform());
    return Status::success();
}

}  // namespace render_system
