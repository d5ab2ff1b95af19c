// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/default_sky.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "render_system/light_table.h"
#include "render_system/ray_probe.h"
#include "render_system/texel.h"

namespace render_system {

namespace {

constexpr uint32_t kGrid = 64;          // rays across and down the picture
constexpr double kAspect = 16.0 / 9.0;  // of the picture looked at, whatever is rendered
constexpr size_t kPoints = 1024;        // of what they meet
constexpr uint32_t kCandidates = 128;   // places on lights, tried for each point
constexpr uint32_t kShadowRays = 8;     // of these, where most of their light comes from
constexpr double kEnough = 0.05;        // irradiance
constexpr float kEmits = 0.01f;         // luminance of a texel that is more than a shade of black

struct Point {
    glm::dvec3 place;
    glm::dvec3 normal;  // on the side that is seen
    RayProbe::Hit hit;
};

double fraction(double x) { return x - std::floor(x); }

// A texel's number along one side, by the wrap mode.
uint32_t texel_at(float coordinate, uint32_t size, TextureWrap wrap) {
    const double x = static_cast<double>(coordinate);
    double inside = fraction(x);
    if (wrap == TextureWrap::mirrored_repeat) inside = 1.0 - std::abs(1.0 - 2.0 * fraction(0.5 * x));
    if (wrap == TextureWrap::clamp_to_edge) inside = std::clamp(x, 0.0, 1.0);
    return std::min(static_cast<uint32_t>(inside * size), size - 1);
}

bool is_unlit(const HostScene& scene, const RayProbe::Hit& hit) {
    const HostMesh& mesh = scene.meshes()[scene.instances()[hit.instance].mesh];
    return scene.materials()[mesh.triangles[hit.triangle].w].unlit;
}

glm::vec3 emission_at(const HostScene& scene, const RayProbe::Hit& hit) {
    const HostMesh& mesh = scene.meshes()[scene.instances()[hit.instance].mesh];
    const glm::uvec4& triangle = mesh.triangles[hit.triangle];
    const CoreMaterial& material = scene.materials()[triangle.w].core;
    const CoreTextureSlot& slot = material.emission_texture;
    if (material.emission_weight <= 0.0f || slot.texture == NONE) return material.emission;
    const std::vector<glm::vec2>& set = mesh.uv(slot.uv_set);
    glm::vec3 uv(0.0f, 0.0f, 1.0f);
    const auto u = static_cast<float>(hit.u), v = static_cast<float>(hit.v);
    if (!set.empty()) {
        uv = glm::vec3(set[triangle.x] * (1.0f - u - v) + set[triangle.y] * u + set[triangle.z] * v, 1.0f);
    }
    const HostTexture& texture = scene.textures()[slot.texture];
    const uint32_t x = texel_at(glm::dot(slot.row_u, uv), texture.width, texture.wrap_s);
    const uint32_t y = texel_at(glm::dot(slot.row_v, uv), texture.height, texture.wrap_t);
    return material.emission * glm::vec3(unpack_texel(texture.texels[size_t{y} * texture.width + x], texture.format));
}

/// What the camera sees of surfaces that neither emit nor are unlit, evenly chosen; `emitters` counts the other rays
/// that met one.
std::vector<Point> seen_points(const HostScene& scene, const Camera& camera, RayProbe& probe, size_t& emitters) {
    const double beside = 0.5 * static_cast<double>(camera.parallel_height);
    const double slope = beside > 0.0 ? 0.0 : std::tan(0.5 * static_cast<double>(camera.vertical_fov));
    std::vector<Point> points;
    for (uint32_t i = 0; i < kGrid * kGrid; ++i) {
        const double x = (2.0 * (i % kGrid) + 1.0) / kGrid - 1.0, y = (2.0 * (i / kGrid) + 1.0) / kGrid - 1.0;
        const glm::dvec3 direction = glm::dvec3(camera.forward) + glm::dvec3(camera.right) * (kAspect * x * slope) +
                                     glm::dvec3(camera.up) * (y * slope);
        const glm::dvec3 eye = glm::dvec3(camera.position) + glm::dvec3(camera.right) * (kAspect * x * beside) +
                               glm::dvec3(camera.up) * (y * beside);
        const auto hit = probe.first_hit(eye, direction);
        if (!hit) continue;
        if (is_unlit(scene, *hit) || luminance(emission_at(scene, *hit)) > kEmits) {
            ++emitters;
            continue;
        }
        glm::dvec3 corners[3];
        probe.vertices(*hit, corners);
        const glm::dvec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double size = glm::length(across);
        if (!(size > 0.0)) continue;
        const glm::dvec3 normal = across * ((glm::dot(across, direction) > 0.0 ? -1.0 : 1.0) / size);
        points.push_back({eye + direction * hit->t, normal, *hit});
    }
    if (points.size() <= kPoints) return points;
    std::vector<Point> chosen;
    for (size_t i = 0; i < kPoints; ++i) chosen.push_back(points[i * points.size() / kPoints]);
    return chosen;
}

struct Candidate {
    glm::dvec3 place;
    double geometry = 0.0;  // both cosines over the squared distance
};

// A place on a light, chosen by area and mean emission, as `point` sees it.
Candidate candidate_for(const Point& point, const LightTable& table, uint32_t number, double turn) {
    // Roberts' sequence in four dimensions, turned for each point.
    const auto r = [&](double step) { return fraction(turn + step * (number + 1.0)); };
    const double pick = r(0.8566748838545029) * static_cast<double>(table.table.size());
    const auto entry = std::min(static_cast<size_t>(pick), table.table.size() - 1);
    const bool own = r(0.7338918566271260) < static_cast<double>(table.table[entry].threshold);
    const CoreLight& light = table.lights[own ? entry : table.table[entry].alias];
    const double root = std::sqrt(r(0.6287067210378087)), v = r(0.5385972572236101) * root;
    const glm::dvec3 v0(light.vertices[0]), v1(light.vertices[1]), v2(light.vertices[2]);
    Candidate result;
    result.place = v0 + (v1 - v0) * (root - v) + (v2 - v0) * v;
    const glm::dvec3 way = result.place - point.place;
    const double squared = glm::dot(way, way);
    const glm::dvec3 across = glm::cross(v1 - v0, v2 - v0);
    const double size = glm::length(across) * squared * squared;
    if (!(size > 0.0)) return result;
    const double leaving = -glm::dot(across, way);
    result.geometry = std::max(glm::dot(point.normal, way), 0.0) *
                      (light.two_sided ? std::abs(leaving) : std::max(leaving, 0.0)) / size;
    return result;
}

// Direct irradiance: all candidates without shadows, times the share of a few that are seen, taken where the light
// comes from. A triangle's density times its mean radiance is the same for all: the table's total weight.
bool is_lit(const Point& point, size_t number, const LightTable& table, RayProbe& probe) {
    std::vector<Candidate> candidates;
    double sum = 0.0;
    const double turn = fraction(0.6180339887498949 * static_cast<double>(number));
    for (uint32_t i = 0; i < kCandidates; ++i) {
        candidates.push_back(candidate_for(point, table, i, turn));
        sum += candidates.back().geometry;
    }
    const double unshadowed = sum / kCandidates * static_cast<double>(table.total_weight);
    if (!(unshadowed > kEnough)) return false;
    double reached = 0.0, seen = 0.0;
    uint32_t taken = 0;
    for (const Candidate& candidate : candidates) {
        reached += candidate.geometry;
        while (taken < kShadowRays && reached >= sum * (taken + 0.5) / kShadowRays) {
            seen += probe.passage(point.place, candidate.place, point.hit);
            ++taken;
        }
    }
    if (seen > 0.0) return unshadowed * seen / kShadowRays > kEnough;
    // A few that see nothing say nothing of a bright light through a small opening: all of them are asked.
    double lit = 0.0;
    for (const Candidate& candidate : candidates) {
        if (!(candidate.geometry > 0.0)) continue;
        lit += candidate.geometry * probe.passage(point.place, candidate.place, point.hit);
        if (lit / kCandidates * static_cast<double>(table.total_weight) > kEnough) return true;
    }
    return false;
}

double smooth_step(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

double studio_radiance(const glm::dvec3& direction) {
    const double key = glm::dot(direction, glm::normalize(glm::dvec3(-0.45, 0.75, 0.65)));
    const double fill = glm::dot(direction, glm::normalize(glm::dvec3(0.95, 0.25, 0.1)));
    return 0.45 + 0.25 * direction.y + 4.0 * smooth_step(0.9, 0.97, key) + 0.8 * smooth_step(0.85, 0.95, fill);
}

}  // namespace

bool lights_itself(const HostScene& scene, const Camera& camera) {
    if (!scene.punctual_lights().empty()) return true;
    const LightTable table = build_light_table(scene, 0.0, Emitters::without_unlit);
    const std::vector<HostMaterial>& materials = scene.materials();
    const bool has_unlit = std::any_of(materials.begin(), materials.end(), [](const auto& m) { return m.unlit; });
    if (table.lights.empty() && !has_unlit) return false;
    RayProbe probe(scene);
    size_t emitters = 0;
    const std::vector<Point> points = seen_points(scene, camera, probe, emitters);
    if (points.empty()) return emitters > 0;
    if (table.lights.empty()) return false;
    size_t lit = 0;
    for (size_t i = 0; i < points.size(); ++i) lit += is_lit(points[i], i, table, probe) ? 1 : 0;
    return 2 * lit >= points.size();
}

Sky studio_sky() {
    constexpr uint32_t kWidth = 128, kHeight = 64;
    constexpr double kPi = 3.14159265358979323846;
    Sky sky;
    sky.width = kWidth;
    sky.height = kHeight;
    for (uint32_t y = 0; y < kHeight; ++y) {
        const double polar = kPi * (y + 0.5) / kHeight;
        for (uint32_t x = 0; x < kWidth; ++x) {
            const double around = 2.0 * kPi * ((x + 0.5) / kWidth - 0.5);  // 0 looks along -z, towards +x it grows
            const glm::dvec3 direction(std::sin(around) * std::sin(polar), std::cos(polar),
                                       -std::cos(around) * std::sin(polar));
            sky.texels.emplace_back(glm::vec3(static_cast<float>(studio_radiance(direction))), 1.0f);
        }
    }
    return sky;
}

}  // namespace render_system
