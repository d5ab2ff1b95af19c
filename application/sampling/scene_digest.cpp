// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/sampling/scene_digest.h"

#include <fmt/format.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <type_traits>
#include <vector>

namespace application {
namespace {

using namespace render_system;

template <class Value>
void add_value(Digest& digest, const Value& value) {
    static_assert(std::has_unique_object_representations_v<Value> || std::is_floating_point_v<Value>,
                  "its bytes would hold some that mean nothing");
    digest.add_bytes(&value, sizeof(value));
}

template <int Length>
void add_value(Digest& digest, const glm::vec<Length, float>& value) {
    for (int i = 0; i < Length; ++i) add_value(digest, value[i]);
}

/// An array of numbers or vectors of numbers, which have no bytes between them.
template <class Element>
void add_array(Digest& digest, const std::vector<Element>& values) {
    add_value(digest, values.size());
    digest.add_bytes(values.data(), values.size() * sizeof(Element));
}

void add_slot(Digest& digest, const CoreTextureSlot& slot) {
    static_assert(sizeof(CoreTextureSlot) == 32, "a member more goes into the digest");
    add_value(digest, slot.texture);
    add_value(digest, slot.uv_set);
    add_value(digest, slot.row_u);
    add_value(digest, slot.row_v);
}

void add_material(Digest& digest, const CoreMaterial& material) {
    static_assert(sizeof(CoreMaterial) == 624, "a member more goes into the digest");
    for (const glm::vec3& color :
         {material.base_color, material.specular_color, material.absorption, material.emission, material.sheen_color})
        add_value(digest, color);
    for (const float factor :
         {material.alpha, material.alpha_cutoff, material.metallic, material.roughness, material.ior, material.specular,
          material.transmission, material.normal_scale, material.sheen_roughness, material.coat,
          material.coat_roughness, material.coat_normal_scale, material.film, material.film_ior, material.anisotropy,
          material.anisotropy_rotation})
        add_value(digest, factor);
    add_value(digest, material.film_thickness);
    for (const bool flag : {material.opaque, material.double_sided, material.thin_walled})
        add_value(digest, static_cast<uint8_t>(flag));
    for (const auto slot : kTextureSlots) add_slot(digest, material.*slot);
}

void add_mesh(Digest& digest, const HostMesh& mesh) {
    add_array(digest, mesh.positions);
    add_array(digest, mesh.normals);
    add_array(digest, mesh.tangents);
    add_array(digest, mesh.uv0);
    add_array(digest, mesh.uv1);
    add_array(digest, mesh.uv2);
    add_array(digest, mesh.uv3);
    add_array(digest, mesh.colors);
    add_array(digest, mesh.triangles);
}

void add_texture(Digest& digest, const HostTexture& texture) {
    for (const uint32_t number : {texture.width, texture.height, texture.levels, static_cast<uint32_t>(texture.format),
                                  static_cast<uint32_t>(texture.wrap_s), static_cast<uint32_t>(texture.wrap_t),
                                  static_cast<uint32_t>(texture.nearest)})
        add_value(digest, number);
    add_array(digest, texture.texels);
}

void add_light(Digest& digest, const PunctualLight& light) {
    static_assert(sizeof(PunctualLight) == sizeof(std::string) + 48, "a member more goes into the digest");
    add_value(digest, static_cast<uint32_t>(light.kind));
    for (const glm::vec3& vector : {light.position, light.direction, light.emission}) add_value(digest, vector);
    add_value(digest, light.inner_cone);
    add_value(digest, light.outer_cone);
}

void add_sky(Digest& digest, const Sky& sky) {
    add_value(digest, sky.radiance);
    add_value(digest, sky.width);
    add_array(digest, sky.texels);
}

void add_geometry(Digest& digest, const HostScene& scene) {
    for (const HostMesh& mesh : scene.meshes()) add_mesh(digest, mesh);
    for (const HostInstance& instance : scene.instances()) {
        add_value(digest, instance.mesh);
        for (const glm::vec4& row : instance.transform.rows) add_value(digest, row);
    }
}

void add_materials(Digest& digest, const HostScene& scene) {
    for (const HostMaterial& material : scene.materials()) add_material(digest, material.core);
}

void add_textures(Digest& digest, const HostScene& scene) {
    for (const HostTexture& texture : scene.textures()) add_texture(digest, texture);
}

void add_lights(Digest& digest, const HostScene& scene) {
    for (const PunctualLight& light : scene.punctual_lights()) add_light(digest, light);
}

}  // namespace

void Digest::add_bytes(const void* bytes, size_t size) { value_ = XXH64(bytes, size, value_); }

void Digest::add(std::string_view text) { add_bytes(text.data(), text.size()); }

std::string Digest::hex() const { return fmt::format("{:016x}", value_); }

std::string scene_digest(const HostScene& scene) {
    Digest digest;
    add_geometry(digest, scene);
    add_materials(digest, scene);
    add_textures(digest, scene);
    add_lights(digest, scene);
    add_sky(digest, scene.sky());
    return digest.hex();
}

std::string pose_digest(const HostScene& scene) {
    Digest digest;
    add_geometry(digest, scene);
    add_materials(digest, scene);
    add_lights(digest, scene);
    return digest.hex();
}

std::string texture_digest(const HostScene& scene) {
    Digest digest;
    add_textures(digest, scene);
    return digest.hex();
}

std::string sky_digest(const Sky& sky) {
    Digest digest;
    add_sky(digest, sky);
    return digest.hex();
}

std::string view_digest(const ViewPyramid& view) {
    Digest digest;
    for (const glm::vec3& point : {view.eye, view.top_left, view.top_right, view.bottom_left}) add_value(digest, point);
    add_value(digest, view.aperture);
    add_value(digest, static_cast<uint8_t>(view.parallel));
    return digest.hex();
}

}  // namespace application
