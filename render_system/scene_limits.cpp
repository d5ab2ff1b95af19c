// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/scene_limits.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace render_system {

namespace {

// A number for a person: 3e+18, 0.25.
std::string shown(double number) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.6g", number);
    return text;
}

// The matrix without its translation, and what its inverse is made of. Cofactors are sums of the products' sizes: what
// cancels out in one order of operations may not in another.
struct Linear {
    double m[3][3];
    double determinant = 0.0;
    double volume = 0.0;  // the determinant's products, without their signs
    double cofactors[3][3];

    explicit Linear(const CoreTransform& transform) {
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c) m[r][c] = static_cast<double>(transform.rows[r][c]);
        }
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c) set_cofactor(r, c);
        }
    }

private:
    void set_cofactor(int r, int c) {
        const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
        const double one = m[r1][c1] * m[r2][c2], other = m[r1][c2] * m[r2][c1];
        cofactors[r][c] = std::abs(one) + std::abs(other);
        if (r > 0) return;
        determinant += m[0][c] * (one - other);
        volume += std::abs(m[0][c]) * cofactors[0][c];
    }
};

glm::dvec3 placed(const CoreTransform& transform, const glm::dvec3& point, bool as_size) {
    glm::dvec3 result;
    for (int r = 0; r < 3; ++r) {
        glm::dvec3 row(transform.rows[r]);
        if (as_size) row = glm::abs(row);
        result[r] = glm::dot(row, point) + (as_size ? 0.0 : static_cast<double>(transform.rows[r].w));
    }
    return result;
}

Status check_eye(const glm::vec3& eye) {
    const double reach = largest_coordinate(eye);
    if (reach <= static_cast<double>(FARTHEST_EYE)) return Status::success();
    return Status::invalid("the eye is at " + shown(static_cast<double>(eye.x)) + ", " +
                           shown(static_cast<double>(eye.y)) + ", " + shown(static_cast<double>(eye.z)) +
                           "; coordinates up to " + shown(static_cast<double>(FARTHEST_EYE)) +
                           " can be rendered: move the camera or scale the scene");
}

Status check_lens(float aperture, float focus) {
    if (!(aperture >= 0.0f && aperture <= FARTHEST_EYE))
        return Status::invalid("the lens's radius is " + shown(static_cast<double>(aperture)) + "; give 0 to " +
                               shown(static_cast<double>(FARTHEST_EYE)));
    if (focus > 0.0f && focus <= FARTHEST_EYE && aperture > WIDEST_LENS * focus)
        return Status::invalid("the lens's radius is " + shown(static_cast<double>(aperture)) + " and its focus at " +
                               shown(static_cast<double>(focus)) + "; give a radius of at most " +
                               shown(static_cast<double>(WIDEST_LENS)) + " times that distance");
    if (focus > 0.0f && focus <= FARTHEST_EYE) return Status::success();
    return Status::invalid("the lens's focus is at " + shown(static_cast<double>(focus)) + "; give a distance up to " +
                           shown(static_cast<double>(FARTHEST_EYE)));
}

std::string instance_name(const HostScene& scene, size_t instance) {
    return "instance " + std::to_string(instance) + mesh_name(scene, scene.instances()[instance].mesh) + ": ";
}

}  // namespace

std::string mesh_name(const HostScene& scene, uint32_t mesh) {
    const std::string& name = scene.meshes()[mesh].name;
    return name.empty() ? "" : " (mesh \"" + name + "\")";
}

double largest_coordinate(const glm::vec3& point) {
    const glm::dvec3 size = glm::abs(glm::dvec3(point));
    return std::isnan(size.x + size.y + size.z) ? std::nan("") : std::max(size.x, std::max(size.y, size.z));
}

bool within_texture(std::span<const glm::vec2> coordinates) {
    // Without a way out, so that compilers make vectors of it; NaN is beyond everything.
    bool within = true;
    for (const glm::vec2& c : coordinates) {
        within &= std::abs(c.x) <= FARTHEST_TEXTURE && std::abs(c.y) <= FARTHEST_TEXTURE;
    }
    return within;
}

bool is_light(const glm::vec3& light) {
    return light.x >= 0.0f && light.y >= 0.0f && light.z >= 0.0f && light.x <= BRIGHTEST_LIGHT &&
           light.y <= BRIGHTEST_LIGHT && light.z <= BRIGHTEST_LIGHT;
}

Status check_material(const CoreMaterial& material) {
    if (!is_light(material.emission) || !std::isfinite(material.emission_weight)) {
        return Status::invalid("its emission is not a number from 0 to " + shown(static_cast<double>(BRIGHTEST_LIGHT)));
    }
    const float factors[] = {material.base_color.x,
                             material.base_color.y,
                             material.base_color.z,
                             material.specular_color.x,
                             material.sheen_color.x,
                             material.sheen_color.y,
                             material.sheen_color.z,
                             material.sheen_roughness,
                             material.coat,
                             material.coat_roughness,
                             material.coat_normal_scale,
                             material.film,
                             material.film_ior,
                             material.film_thickness.x,
                             material.film_thickness.y,
                             material.anisotropy,
                             material.specular_color.y,
                             material.specular_color.z,
                             material.alpha,
                             material.alpha_cutoff,
                             material.metallic,
                             material.roughness,
                             material.ior,
                             material.specular,
                             material.transmission,
                             material.absorption.x,
                             material.absorption.y,
                             material.absorption.z};
    for (const float factor : factors) {
        if (!(factor >= 0.0f && std::isfinite(factor)))
            return Status::invalid("one of its factors is negative or not finite");
    }
    const bool bends = material.transmission > 0.0f && !material.thin_walled;
    if (bends && !(material.ior <= HIGHEST_IOR && material.ior >= 1.0f / HIGHEST_IOR)) {
        return Status::invalid("its index of refraction is " + shown(static_cast<double>(material.ior)) +
                               "; from 1e-4 to 1e4 light can be bent");
    }
    if (!std::isfinite(material.normal_scale)) return Status::invalid("the scale of its normal map is not finite");
    if (!std::isfinite(material.anisotropy_rotation))
        return Status::invalid("the rotation of its anisotropy is not finite");
    for (const auto slot : kTextureSlots) {
        const CoreTextureSlot& used = material.*slot;
        if (used.texture == NONE) continue;
        const double reach = std::max(largest_coordinate(used.row_u), largest_coordinate(used.row_v));
        if (reach <= static_cast<double>(FARTHEST_TEXTURE)) continue;
        return Status::invalid("a texture's transform reaches to " + shown(reach) + "; up to " +
                               shown(static_cast<double>(FARTHEST_TEXTURE)) + " can be looked up");
    }
    return Status::success();
}

bool is_invertible(const CoreTransform& transform) {
    // Inside the range of a float by a hundredfold either way, for the products on the way to the inverse.
    constexpr double SMALLEST = 1e-36, LARGEST = 1e36;
    // Rounding moves a determinant by some 1e-7 of its products.
    constexpr double CANCELLED = 1e-5;
    const Linear linear(transform);
    const double size = std::abs(linear.determinant);
    if (!(size > CANCELLED * linear.volume && size >= SMALLEST && linear.volume <= LARGEST)) return false;
    for (const auto& row : linear.cofactors) {
        for (const double cofactor : row) {
            if (!(cofactor <= LARGEST)) return false;
        }
    }
    return true;
}

bool is_scaled_to_nothing(const CoreTransform& transform) {
    constexpr double kLarge = 1e9;
    for (const glm::vec4& row : transform.rows) {
        if (!(largest_coordinate(glm::vec3(row)) <= kLarge)) return false;
    }
    return !is_invertible(transform);
}

Placement placement_of(const Box& box, const CoreTransform& transform) {
    Placement placement;
    for (const glm::vec4& row : transform.rows) {
        placement.offset = std::max(placement.offset, std::abs(static_cast<double>(row.w)));
    }
    const Linear linear(transform);
    for (int c = 0; c < 3 && is_invertible(transform); ++c) {  // without an inverse no ray is taken into that space
        double row = 0.0;
        for (int r = 0; r < 3; ++r) row += linear.cofactors[r][c];
        placement.inverse = std::max(placement.inverse, row / std::abs(linear.determinant));
    }
    if (box.empty()) return placement;
    const glm::dvec3 lower(box.lower), upper(box.upper);
    const glm::dvec3 middle = glm::abs(placed(transform, 0.5 * (lower + upper), false));
    const glm::dvec3 half = placed(transform, 0.5 * (upper - lower), true);
    for (int i = 0; i < 3; ++i) placement.reach = std::max(placement.reach, middle[i] + half[i]);
    return placement;
}

Status check_placement(const Placement& placement) {
    if (placement.reach <= static_cast<double>(FARTHEST_VERTEX)) return Status::success();
    return Status::invalid("reaches to a coordinate of " + shown(placement.reach) + "; up to " +
                           shown(static_cast<double>(FARTHEST_VERTEX)) + " can be rendered: scale the scene down");
}

Status check_rays_into(const Placement& placement, double reach) {
    const double local = placement.inverse * (reach + placement.offset);
    if (local <= FARTHEST_LOCAL && placement.inverse <= FARTHEST_LOCAL) return Status::success();
    return Status::invalid("its matrix scales so far down that a ray from a coordinate of " + shown(reach) +
                           " would start at " + shown(local) + " in the mesh's own space; up to " +
                           shown(FARTHEST_LOCAL) + " can be traced: apply the scale to the mesh itself");
}

Status check_view(const ViewPyramid& view) {
    if (Status status = check_eye(view.eye); !status.ok()) return status;
    double reach = 0.0;
    for (const glm::vec3& corner : {view.top_left, view.top_right, view.bottom_left}) {
        const double own = largest_coordinate(corner);
        if (!(own <= FARTHEST_LOCAL))
            return Status::invalid("the screen's corners are too far apart; take a smaller field of view");
        reach = std::max(reach, largest_coordinate(corner - view.eye));
    }
    if (!(reach > 0.0)) return Status::invalid("the screen's corners coincide with the eye");
    if (view.parallel && view.aperture > 0.0f) return Status::invalid("an orthographic camera has no lens");
    const glm::vec3 middle = 0.5f * (view.top_right + view.bottom_left) - view.eye;
    return check_lens(view.aperture, view.aperture > 0.0f ? glm::length(middle) : 1.0f);
}

Status check_camera(const Camera& camera) {
    if (Status status = check_eye(camera.position); !status.ok()) return status;
    for (const glm::vec3& direction : {camera.right, camera.up, camera.forward}) {
        if (!(largest_coordinate(direction) <= 2.0))
            return Status::invalid("the camera's directions are not of unit length");
    }
    if (!(camera.parallel_height >= 0.0f && camera.parallel_height <= FARTHEST_VERTEX))
        return Status::invalid("the orthographic camera's height is past 1e9");
    if (camera.parallel_height > 0.0f && camera.aperture > 0.0f)
        return Status::invalid("an orthographic camera has no lens; leave --aperture out, or give --fov");
    return check_lens(camera.aperture, camera.focus);
}

Status check_light_position(const glm::vec3& position) {
    const double reach = largest_coordinate(position);
    if (reach <= static_cast<double>(FARTHEST_EYE)) return Status::success();
    return Status::invalid("the light is at a coordinate of " + shown(reach) + "; up to " +
                           shown(static_cast<double>(FARTHEST_EYE)) + " can be rendered: scale the scene down");
}

Status check_scene_limits(const HostScene& scene, const ViewPyramid& view) {
    if (Status status = check_view(view); !status.ok()) return status;
    double reach = largest_coordinate(view.eye) + static_cast<double>(view.aperture);
    if (view.parallel) reach += 2.0 * largest_coordinate(view.top_left - view.eye);
    std::vector<std::pair<size_t, Placement>> placements;
    for (size_t i = 0; i < scene.instances().size(); ++i) {
        const HostInstance& instance = scene.instances()[i];
        if (instance.mesh == NONE) continue;
        if (!is_invertible(instance.transform)) {
            return Status::invalid(instance_name(scene, i) +
                                   "its matrix cannot be inverted; hide the instance instead");
        }
        const Placement placement = placement_of(scene.mesh_box(instance.mesh), instance.transform);
        Status status = check_placement(placement);
        if (!status.ok()) return Status::invalid(instance_name(scene, i) + status.message);
        reach = std::max(reach, placement.reach);
        placements.emplace_back(i, placement);
    }
    for (const auto& [i, placement] : placements) {
        Status status = check_rays_into(placement, reach);
        if (!status.ok()) return Status::invalid(instance_name(scene, i) + status.message);
    }
    for (const PunctualLight& light : scene.punctual_lights()) {
        Status status = check_light_position(light.position);
        if (!status.ok()) return Status::invalid("light \"" + light.name + "\": " + status.message);
    }
    return Status::success();
}

}  // namespace render_system
