// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/light_table.h"

#include <algorithm>
#include <cmath>

#include "render_system/alias_table.h"

namespace render_system {

float even_coverage(const CoreMaterial& material) {
    if (material.opaque) return 1.0f;
    if (material.base_color_texture.texture != NONE) return 0.0f;
    if (material.alpha_cutoff > 0.0f) return material.alpha >= material.alpha_cutoff ? 1.0f : 0.0f;
    return material.alpha;
}

namespace {

constexpr double PI = 3.14159265358979323846;

bool mirrors(const CoreTransform& t) {
    const glm::dvec3 x(t.rows[0]), y(t.rows[1]), z(t.rows[2]);
    return glm::dot(x, glm::cross(y, z)) < 0.0;
}

double triangle_area(const CoreLight& light) {
    const glm::dvec3 v0(light.vertices[0]), v1(light.vertices[1]), v2(light.vertices[2]);
    return 0.5 * glm::length(glm::cross(v1 - v0, v2 - v0));
}

glm::vec2 transformed_uv(const CoreTextureSlot& slot, const HostMesh& mesh, uint32_t vertex) {
    const std::vector<glm::vec2>& set = mesh.uv(slot.uv_set);
    const glm::vec2 uv = set.empty() ? glm::vec2(0.0f) : set[vertex];
    const glm::vec3 &u = slot.row_u, &v = slot.row_v;
    return {u.x * uv.x + u.y * uv.y + u.z, v.x * uv.x + v.y * uv.y + v.z};
}

struct Builder {
    LightTable result;
    std::vector<double> weights;

    void add(const CoreLight& light, double weight) {
        if (!(weight > 0.0) || !std::isfinite(weight)) return;
        result.lights.push_back(light);
        weights.push_back(weight);
    }
};

void add_instance_triangles(Builder& builder, const HostScene& scene, const HostInstance& instance, Emitters emitters) {
    const HostMesh& mesh = scene.meshes()[instance.mesh];
    const bool mirrored = mirrors(instance.transform);
    for (const glm::uvec4& triangle : mesh.triangles) {
        const CoreMaterial& material = scene.materials()[triangle.w].core;
        if (material.emission_weight <= 0.0f) continue;
        if (emitters == Emitters::without_unlit && scene.materials()[triangle.w].unlit) continue;
        // A mirrored instance shows the other winding: exchanging two vertices keeps the emitting side in front.
        const uint32_t order[3] = {triangle.x, mirrored ? triangle.z : triangle.y, mirrored ? triangle.y : triangle.z};
        CoreLight light;
        light.kind = LightKind::triangle;
        light.emission = material.emission * even_coverage(material);
        light.two_sided = material.double_sided;
        light.emission_texture = material.emission_texture;
        for (int i = 0; i < 3; ++i) {
            light.vertices[i] = transform_point(instance.transform, mesh.positions[order[i]]);
            light.uv[i] = transformed_uv(material.emission_texture, mesh, order[i]);
        }
        builder.add(light, triangle_area(light) * static_cast<double>(material.emission_weight));
    }
}

// The integral over all directions of clamp(cos * scale + offset, 0, 1)^2, as a share of the sphere's 4 pi.
double spot_share(double cos_inner, double cos_outer) {
    return 0.5 * ((1.0 - cos_inner) + (cos_inner - cos_outer) / 3.0);
}

void add_punctual_light(Builder& builder, const PunctualLight& source, double radius) {
    CoreLight light;
    light.kind = source.kind;
    light.vertices[0] = source.position;
    light.direction = source.direction;
    light.emission = source.emission;
    const double brightness = static_cast<double>(luminance(source.emission));
    if (source.kind == LightKind::directional) {
        builder.result.uses_radius = true;
        builder.add(light, radius * radius * brightness);
    } else if (source.kind == LightKind::spot) {
        // KHR_lights_punctual's own recommendation, with its guard against a cone of no width.
        const double cos_inner = std::cos(static_cast<double>(source.inner_cone));
        const double cos_outer = std::cos(static_cast<double>(source.outer_cone));
        light.spot_scale = static_cast<float>(1.0 / std::max(0.001, cos_inner - cos_outer));
        light.spot_offset = static_cast<float>(-cos_outer) * light.spot_scale;
        builder.add(light, 4.0 * brightness * std::max(spot_share(cos_inner, cos_outer), 1e-6));
    } else {
        builder.add(light, 4.0 * brightness);
    }
}

}  // namespace

CoreLights LightTable::view() const { return {lights, table, total_weight}; }

float scene_radius(const HostScene& scene) {
    const Box box = scene.bounds();
    const float radius = box.empty() ? 0.0f : 0.5f * glm::length(box.upper - box.lower);
    return radius > 0.0f ? radius : 1.0f;
}

SkyTable build_sky_table(const Sky& sky) {
    SkyTable result;
    if (sky.texels.empty()) return result;
    const size_t width = sky.width, height = sky.height;
    const auto brightness = [&](size_t x, size_t y) {
        return static_cast<double>(luminance(glm::vec3(sky.texels[y * width + x])));
    };
    std::vector<double> weights(sky.texels.size());
    for (size_t y = 0; y < height; ++y) {
        // Of one texel in this row: the row's zone over the number of texels.
        const double top = std::cos(PI * static_cast<double>(y) / static_cast<double>(height));
        const double bottom = std::cos(PI * static_cast<double>(y + 1) / static_cast<double>(height));
        const double solid_angle = 2.0 * PI * (top - bottom) / static_cast<double>(width);
        const size_t rows[3] = {y == 0 ? 0 : y - 1, y, std::min(y + 1, height - 1)};
        for (size_t x = 0; x < width; ++x) {
            const size_t columns[3] = {(x + width - 1) % width, x, (x + 1) % width};
            double sum = 0.0;
            for (size_t row : rows) {
                for (size_t column : columns) sum += brightness(column, row);
            }
            weights[y * width + x] = sum / 9.0 * solid_angle;
            result.luminance_integral += brightness(x, y) * solid_angle;
        }
    }
    result.table = build_alias_table(weights);
    return result;
}

LightTable build_light_table(const HostScene& scene, double sky_luminance_integral, Emitters emitters) {
    Builder builder;
    const double radius = static_cast<double>(scene_radius(scene));
    builder.result.scene_radius = static_cast<float>(radius);
    for (const HostInstance& instance : scene.instances()) {
        if (instance.mesh != NONE && scene.is_emissive(instance.mesh)) {
            add_instance_triangles(builder, scene, instance, emitters);
        }
    }
    for (const PunctualLight& light : scene.punctual_lights()) add_punctual_light(builder, light, radius);
    if (sky_luminance_integral > 0.0) {
        CoreLight sky;
        sky.kind = LightKind::sky;
        builder.result.uses_radius = true;
        builder.add(sky, radius * radius * sky_luminance_integral);
    }
    double total = 0.0;
    for (double weight : builder.weights) total += weight;
    builder.result.total_weight = static_cast<float>(total);
    builder.result.table = build_alias_table(builder.weights);
    const std::vector<CoreLight>& lights = builder.result.lights;
    if (!lights.empty() && lights.back().kind == LightKind::sky) {
        builder.result.sky_probability = builder.result.table.back().probability;
    }
    return std::move(builder.result);
}

}  // namespace render_system
