// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/loader/gltf_pointers.h"

#include <algorithm>
#include <cfloat>
#include <charconv>
#include <cmath>

#include "render_system/scene_limits.h"

namespace render_system {

namespace {

using Numbers = std::span<const double>;

// A single factor, held to a range.
struct FactorRow {
    const char* property;
    float CoreMaterial::*factor;
    double low = 0.0;
    double high = 1.0;
};

const FactorRow kFactorRows[] = {
    {"pbrMetallicRoughness/metallicFactor", &CoreMaterial::metallic},
    {"pbrMetallicRoughness/roughnessFactor", &CoreMaterial::roughness},
    {"normalTexture/scale", &CoreMaterial::normal_scale, -1e6, 1e6},
    {"extensions/KHR_materials_transmission/transmissionFactor", &CoreMaterial::transmission},
    {"extensions/KHR_materials_specular/specularFactor", &CoreMaterial::specular},
    {"extensions/KHR_materials_sheen/sheenRoughnessFactor", &CoreMaterial::sheen_roughness},
    {"extensions/KHR_materials_anisotropy/anisotropyStrength", &CoreMaterial::anisotropy},
    {"extensions/KHR_materials_anisotropy/anisotropyRotation", &CoreMaterial::anisotropy_rotation, -1e6, 1e6},
    {"extensions/KHR_materials_clearcoat/clearcoatFactor", &CoreMaterial::coat},
    {"extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor", &CoreMaterial::coat_roughness},
    {"extensions/KHR_materials_clearcoat/clearcoatNormalTexture/scale", &CoreMaterial::coat_normal_scale, 0.0, 1e6},
    {"extensions/KHR_materials_iridescence/iridescenceFactor", &CoreMaterial::film},
    {"extensions/KHR_materials_iridescence/iridescenceIor", &CoreMaterial::film_ior, 1.0, HIGHEST_IOR},
};

// A texture of a material: in which extension (empty: none), under which name, and its place in kTextureSlots.
struct SlotRow {
    const char* extension;
    const char* name;
    CoreTextureSlot CoreMaterial::*slot;
};

const SlotRow kSlotRows[] = {
    {"", "pbrMetallicRoughness/baseColorTexture", &CoreMaterial::base_color_texture},
    {"", "pbrMetallicRoughness/metallicRoughnessTexture", &CoreMaterial::metallic_roughness_texture},
    {"", "normalTexture", &CoreMaterial::normal_texture},
    {"", "emissiveTexture", &CoreMaterial::emission_texture},
    {"KHR_materials_transmission", "transmissionTexture", &CoreMaterial::transmission_texture},
    {"KHR_materials_specular", "specularTexture", &CoreMaterial::specular_texture},
    {"KHR_materials_specular", "specularColorTexture", &CoreMaterial::specular_color_texture},
    {"KHR_materials_sheen", "sheenColorTexture", &CoreMaterial::sheen_color_texture},
    {"KHR_materials_sheen", "sheenRoughnessTexture", &CoreMaterial::sheen_roughness_texture},
    {"KHR_materials_anisotropy", "anisotropyTexture", &CoreMaterial::anisotropy_texture},
    {"KHR_materials_clearcoat", "clearcoatTexture", &CoreMaterial::coat_texture},
    {"KHR_materials_clearcoat", "clearcoatRoughnessTexture", &CoreMaterial::coat_roughness_texture},
    {"KHR_materials_clearcoat", "clearcoatNormalTexture", &CoreMaterial::coat_normal_texture},
    {"KHR_materials_iridescence", "iridescenceTexture", &CoreMaterial::film_texture},
    {"KHR_materials_iridescence", "iridescenceThicknessTexture", &CoreMaterial::film_thickness_texture},
};

size_t slot_index(CoreTextureSlot CoreMaterial::*slot) {
    return static_cast<size_t>(std::find(std::begin(kTextureSlots), std::end(kTextureSlots), slot) -
                               std::begin(kTextureSlots));
}

std::string slot_pointer(const SlotRow& row) {
    return (*row.extension == '\0' ? std::string() : std::string("extensions/") + row.extension + "/") + row.name;
}

float held(double value, double low, double high) { return static_cast<float>(std::clamp(value, low, high)); }

glm::vec3 held_color(Numbers value, double high) {
    return {held(value[0], 0.0, high), held(value[1], 0.0, high), held(value[2], 0.0, high)};
}

bool is_unlit_material(const tinygltf::Material& material) {
    return material.extensions.contains("KHR_materials_unlit");
}

std::optional<AnimatedProperty<MaterialState>> color_property(const std::string& property, bool unlit) {
    if (property == "pbrMetallicRoughness/baseColorFactor")
        return AnimatedProperty<MaterialState>{4, [unlit](MaterialState& state, Numbers value) {
                                                   (unlit ? state.emission : state.core.base_color) =
                                                       held_color(value, 1.0);
                                                   state.core.alpha = held(value[3], 0.0, 1.0);
                                               }};
    if (unlit) return {};
    if (property == "emissiveFactor")
        return AnimatedProperty<MaterialState>{
            3, [](MaterialState& state, Numbers value) { state.emission = held_color(value, FLT_MAX); }};
    if (property == "extensions/KHR_materials_specular/specularColorFactor")
        return AnimatedProperty<MaterialState>{
            3, [](MaterialState& state, Numbers value) { state.core.specular_color = held_color(value, FLT_MAX); }};
    if (property == "extensions/KHR_materials_sheen/sheenColorFactor")
        return AnimatedProperty<MaterialState>{
            3, [](MaterialState& state, Numbers value) { state.core.sheen_color = held_color(value, 1.0); }};
    return {};
}

std::optional<AnimatedProperty<MaterialState>> other_property(const std::string& property, bool masked) {
    const auto single = [](void (*put)(MaterialState&, double)) {
        return AnimatedProperty<MaterialState>{1, [put](MaterialState& state, Numbers value) { put(state, value[0]); }};
    };
    if (property == "extensions/KHR_materials_emissive_strength/emissiveStrength")
        return single([](MaterialState& state, double value) { state.emission_strength = held(value, 0.0, FLT_MAX); });
    if (property == "extensions/KHR_materials_ior/ior")
        return single([](MaterialState& state, double value) {
            const double lowest = 1.0 / static_cast<double>(HIGHEST_IOR);
            state.core.ior = value > 0.0 ? held(value, lowest, HIGHEST_IOR) : 0.0f;
        });
    if (property == "extensions/KHR_materials_iridescence/iridescenceThicknessMinimum")
        return single(
            [](MaterialState& state, double value) { state.core.film_thickness.x = held(value, 0.0, FLT_MAX); });
    if (property == "extensions/KHR_materials_iridescence/iridescenceThicknessMaximum")
        return single(
            [](MaterialState& state, double value) { state.core.film_thickness.y = held(value, 0.0, FLT_MAX); });
    if (property == "alphaCutoff" && masked)
        return single([](MaterialState& state, double value) {
            state.core.alpha_cutoff = held(value, 0.0, FLT_MAX);
            state.core.opaque = state.core.alpha_cutoff == 0.0f;  // a mask that everything passes
        });
    return {};
}

std::optional<AnimatedProperty<MaterialState>> transform_property(const std::string& property) {
    for (const SlotRow& row : kSlotRows) {
        const std::string start = slot_pointer(row) + "/extensions/KHR_texture_transform/";
        if (!property.starts_with(start)) continue;
        const size_t slot = slot_index(row.slot);
        const std::string part = property.substr(start.size());
        if (part == "rotation")
            return AnimatedProperty<MaterialState>{1, [slot](MaterialState& state, Numbers value) {
                                                       state.transforms[slot].rotation = value[0];
                                                       state.moves[slot] = true;
                                                   }};
        if (part != "offset" && part != "scale") return {};
        const auto member = part == "offset" ? &TextureTransform::offset : &TextureTransform::scale;
        return AnimatedProperty<MaterialState>{2, [slot, member](MaterialState& state, Numbers value) {
                                                   state.transforms[slot].*member = {value[0], value[1]};
                                                   state.moves[slot] = true;
                                               }};
    }
    return {};
}

const tinygltf::Value* extension_of(const tinygltf::ExtensionMap& extensions, const char* name) {
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

// The KHR_texture_transform of one of a material's textures, null where it has none.
const tinygltf::Value* transform_value(const tinygltf::Material& material, const SlotRow& row) {
    constexpr const char* kTransform = "KHR_texture_transform";
    const tinygltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
    if (row.slot == &CoreMaterial::base_color_texture) return extension_of(pbr.baseColorTexture.extensions, kTransform);
    if (row.slot == &CoreMaterial::metallic_roughness_texture)
        return extension_of(pbr.metallicRoughnessTexture.extensions, kTransform);
    if (row.slot == &CoreMaterial::normal_texture) return extension_of(material.normalTexture.extensions, kTransform);
    if (row.slot == &CoreMaterial::emission_texture)
        return extension_of(material.emissiveTexture.extensions, kTransform);
    const tinygltf::Value* extension = extension_of(material.extensions, row.extension);
    if (!extension || !extension->Has(row.name) || !extension->Get(row.name).Has("extensions")) return nullptr;
    const tinygltf::Value& own = extension->Get(row.name).Get("extensions");
    return own.Has(kTransform) ? &own.Get(kTransform) : nullptr;
}

TextureTransform read_transform(const tinygltf::Value& value) {
    TextureTransform transform;
    const auto pair = [&value](const char* key, glm::dvec2& out) {
        if (!value.Has(key)) return;
        for (int i = 0; i < 2; ++i) out[i] = value.Get(key).Get(static_cast<size_t>(i)).GetNumberAsDouble();
    };
    pair("offset", transform.offset);
    pair("scale", transform.scale);
    if (value.Has("rotation")) transform.rotation = value.Get("rotation").GetNumberAsDouble();
    return transform;
}

}  // namespace

std::optional<PointedProperty> split_pointer(std::string_view pointer) {
    for (const char* list : {"/nodes", "/materials", "/cameras", "/extensions/KHR_lights_punctual/lights"}) {
        const std::string start = std::string(list) + "/";
        if (!pointer.starts_with(start)) continue;
        const std::string_view rest = pointer.substr(start.size());
        PointedProperty pointed{list, 0, {}};
        const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), pointed.index);
        if (error != std::errc{} || pointed.index < 0 || end == rest.data() + rest.size() || *end != '/') return {};
        pointed.property = std::string(end + 1, rest.data() + rest.size());
        return pointed;
    }
    return {};
}

std::optional<AnimatedProperty<MaterialState>> material_property(const std::string& property,
                                                                 const tinygltf::Material& material) {
    const bool unlit = is_unlit_material(material);
    const bool glossy = material.extensions.contains("KHR_materials_pbrSpecularGlossiness");
    if (auto transform = transform_property(property)) return transform;
    if (glossy && property != "emissiveFactor") return {};
    if (auto color = color_property(property, unlit)) return color;
    if (unlit) return {};
    if (auto other = other_property(property, material.alphaMode == "MASK")) return other;
    for (const FactorRow& row : kFactorRows) {
        if (property != row.property) continue;
        return AnimatedProperty<MaterialState>{1, [row](MaterialState& state, Numbers value) {
                                                   state.core.*row.factor = held(value[0], row.low, row.high);
                                               }};
    }
    return {};
}

std::optional<AnimatedProperty<LightState>> light_property(const std::string& property) {
    constexpr double kWidest = 1.5707963267948966;
    if (property == "color")
        return AnimatedProperty<LightState>{3, [](LightState& state, Numbers value) {
                                                state.color = {value[0], value[1], value[2]};
                                            }};
    if (property == "intensity")
        return AnimatedProperty<LightState>{1, [](LightState& state, Numbers value) { state.intensity = value[0]; }};
    if (property == "spot/innerConeAngle")
        return AnimatedProperty<LightState>{
            1, [](LightState& state, Numbers value) { state.inner_cone = held(value[0], 0.0, kWidest); }};
    if (property == "spot/outerConeAngle")
        return AnimatedProperty<LightState>{
            1, [](LightState& state, Numbers value) { state.outer_cone = held(value[0], 0.0, kWidest); }};
    return {};
}

std::optional<AnimatedProperty<CameraState>> camera_property(const std::string& property) {
    constexpr double kNarrowest = 1e-4, kWidest = 3.14;
    if (property == "perspective/yfov")
        return AnimatedProperty<CameraState>{
            1, [](CameraState& state, Numbers value) { state.vertical_fov = held(value[0], kNarrowest, kWidest); }};
    if (property == "orthographic/ymag")
        return AnimatedProperty<CameraState>{1, [](CameraState& state, Numbers value) {
                                                 state.parallel_height =
                                                     2.0f * held(std::abs(value[0]), 1e-9, FARTHEST_VERTEX / 4);
                                             }};
    return {};
}

MaterialState material_state(const tinygltf::Material& material, uint32_t id, const CoreMaterial& core) {
    MaterialState state;
    state.material = id;
    state.core = core;
    state.emission = core.emission;
    if (!is_unlit_material(material)) {
        for (int i = 0; i < 3; ++i)
            state.emission[i] = static_cast<float>(material.emissiveFactor[static_cast<size_t>(i)]);
        const tinygltf::Value* strength = extension_of(material.extensions, "KHR_materials_emissive_strength");
        if (strength && strength->Has("emissiveStrength"))
            state.emission_strength = static_cast<float>(strength->Get("emissiveStrength").GetNumberAsDouble());
    }
    for (const SlotRow& row : kSlotRows) {
        const tinygltf::Value* transform = transform_value(material, row);
        if (transform) state.transforms[slot_index(row.slot)] = read_transform(*transform);
    }
    return state;
}

}  // namespace render_system
