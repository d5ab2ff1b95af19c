// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/view/camera_text.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

namespace application {
namespace {

using Json = nlohmann::ordered_json;
using render_system::Status;
using render_system::StatusCode;

Json numbers(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

}  // namespace

render_system::Result<std::string> camera_text(const render_system::Camera& camera, const std::string& like) {
    if (camera.parallel_height > 0.0f)
        return Status::invalid("a camera file has no cameras whose rays are parallel; move to another camera first");
    Json file = Json::object();
    if (!like.empty()) {
        std::ifstream stream(like);
        file = Json::parse(stream, nullptr, false);
        if (!file.is_object()) return Status::error(StatusCode::unreadable, like + " is no camera file any more");
    }
    // So far off that floats near the eye do not turn the view.
    constexpr double DEGREES = 57.29577951308232;
    const glm::dvec3 eye(camera.position), way(camera.forward);
    const double off = std::max({1.0, std::abs(eye.x), std::abs(eye.y), std::abs(eye.z)});
    file["position"] = numbers(eye);
    file["target"] = numbers(eye + off * way);
    file["up"] = numbers(glm::dvec3(camera.up));
    file["vfov_degrees"] = DEGREES * static_cast<double>(camera.vertical_fov);
    return file.dump(2) + "\n";
}

}  // namespace application
