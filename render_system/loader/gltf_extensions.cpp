// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/loader/gltf_extensions.h"

#include <algorithm>
#include <string_view>

#include "render_system/loader/load_error.h"

namespace render_system {

namespace {

using nlohmann::json;

// What becomes of an extension that a file names.
enum class Treatment {
    supported,
    without_effect,  // nothing one sees in a still picture depends on it
    left_out,        // the picture lacks something, but is the scene's, unless the file says that it is not
    needed,          // without it there is no picture of the scene
};

struct ExtensionRow {
    std::string_view name;  // with a last `*`: all that begin so
    Treatment treatment;
    std::string_view remedy = {};
    std::string_view missing = {};  // left_out: of the picture
};

constexpr std::string_view kOtherImages = "export it with PNG, JPEG or WebP images";
constexpr std::string_view kWithoutIt = "export it without";

// The first row that fits counts.
constexpr ExtensionRow kExtensionRows[] = {
    {"EXT_lights_image_based", Treatment::supported},
    {"EXT_mesh_gpu_instancing", Treatment::supported},
    {"EXT_meshopt_compression", Treatment::supported},
    {"EXT_texture_webp", Treatment::supported},
    {"KHR_animation_pointer", Treatment::supported},
    {"KHR_draco_mesh_compression", Treatment::supported},
    {"KHR_lights_punctual", Treatment::supported},
    {"KHR_materials_anisotropy", Treatment::supported},
    {"KHR_materials_clearcoat", Treatment::supported},
    {"KHR_materials_emissive_strength", Treatment::supported},
    {"KHR_materials_ior", Treatment::supported},
    {"KHR_materials_iridescence", Treatment::supported},
    {"KHR_materials_pbrSpecularGlossiness", Treatment::supported},
    {"KHR_materials_sheen", Treatment::supported},
    {"KHR_materials_specular", Treatment::supported},
    {"KHR_materials_transmission", Treatment::supported},
    {"KHR_materials_unlit", Treatment::supported},
    {"KHR_materials_variants", Treatment::supported},
    {"KHR_materials_volume", Treatment::supported},
    {"KHR_mesh_quantization", Treatment::supported},
    {"KHR_meshopt_compression", Treatment::supported},
    {"KHR_node_visibility", Treatment::supported},
    {"KHR_texture_transform", Treatment::supported},

    {"AGI_*", Treatment::without_effect},
    {"CESIUM_primitive_outline", Treatment::without_effect},
    {"EXT_feature_metadata", Treatment::without_effect},
    {"EXT_instance_features", Treatment::without_effect},
    {"EXT_mesh_features", Treatment::without_effect},
    {"EXT_mesh_manifold", Treatment::without_effect},
    {"EXT_structural_metadata", Treatment::without_effect},
    {"FB_geometry_metadata", Treatment::without_effect},
    {"FB_ngon_encoding", Treatment::without_effect},
    {"GODOT_single_root", Treatment::without_effect},
    {"GRIFFEL_bim_data", Treatment::without_effect},
    {"KHR_audio*", Treatment::without_effect},
    {"KHR_collision_shapes", Treatment::without_effect},
    {"KHR_implicit_shapes", Treatment::without_effect},
    {"KHR_interactivity", Treatment::without_effect},
    {"KHR_node_hoverability", Treatment::without_effect},
    {"KHR_node_selectability", Treatment::without_effect},
    {"KHR_physics_rigid_bodies", Treatment::without_effect},
    {"KHR_xmp*", Treatment::without_effect},
    {"MOZ_hubs_components", Treatment::without_effect},
    {"MSFT_audio_emitter", Treatment::without_effect},
    {"MSFT_lod", Treatment::without_effect},  // the finest level is the one in the file's own place
    {"MSFT_packing_*", Treatment::without_effect},
    {"OMI_*", Treatment::without_effect},
    {"VRM", Treatment::without_effect},
    {"VRMC_node_constraint*", Treatment::without_effect},
    {"VRMC_springBone*", Treatment::without_effect},
    {"VRMC_vrm*", Treatment::without_effect},

    {"KHR_materials_diffuse_transmission", Treatment::left_out,
     "export it with KHR_materials_transmission, which lets light through", "no light comes through"},
    {"KHR_materials_dispersion", Treatment::left_out,
     "export it with KHR_materials_ior and KHR_materials_volume alone, which refract",
     "all colours are refracted alike"},
    {"KHR_materials_*", Treatment::left_out, kWithoutIt},
    {"ADOBE_materials_*", Treatment::left_out, kWithoutIt},
    {"EXT_lights_ies", Treatment::left_out, "export them as spots of KHR_lights_punctual",
     "such lights shine the same all round"},
    {"VRMC_materials_*", Treatment::left_out, kWithoutIt},

    {"EXT_texture_astc", Treatment::needed, kOtherImages},
    {"EXT_texture_avif", Treatment::needed, kOtherImages},
    {"KHR_texture_basisu", Treatment::needed, kOtherImages},
    {"MSFT_texture_dds", Treatment::needed, kOtherImages},
    {"*", Treatment::needed, kWithoutIt},
};

const ExtensionRow& row_of(std::string_view name) {
    const auto fits = [name](const ExtensionRow& row) {
        if (!row.name.ends_with('*')) return row.name == name;
        return name.starts_with(row.name.substr(0, row.name.size() - 1));
    };
    return *std::find_if(std::begin(kExtensionRows), std::end(kExtensionRows), fits);
}

// Whether each texture that names an image by this extension also has one that can be read.
bool has_other_images(const json& document, std::string_view name) {
    if (name.find("_texture_") == std::string_view::npos) return false;
    const json textures = document.value("textures", json::array());
    return std::all_of(textures.begin(), textures.end(), [name](const json& texture) {
        return texture.contains("source") || !texture.contains("extensions") || !texture["extensions"].contains(name) ||
               texture["extensions"].contains("EXT_texture_webp");
    });
}

bool is_missed(const ExtensionRow& row) {
    return row.treatment == Treatment::left_out || row.treatment == Treatment::needed;
}

std::vector<std::string> variant_names(const json& document) {
    std::vector<std::string> names;
    if (!document.contains("extensions") || !document["extensions"].contains("KHR_materials_variants")) return names;
    for (const json& variant : document["extensions"]["KHR_materials_variants"]["variants"]) {
        names.push_back(variant["name"]);
    }
    return names;
}

[[noreturn]] void fail_without_variant(const std::vector<std::string>& names, const std::string& variant) {
    constexpr size_t kShown = 10;
    if (names.empty()) fail_at("", "--variant: the file has no variants; leave the option out");
    std::string list;
    for (size_t i = 0; i < std::min(names.size(), kShown); ++i) list += (i > 0 ? ", \"" : "\"") + names[i] + "\"";
    if (names.size() > kShown) list += " and " + std::to_string(names.size() - kShown) + " more";
    fail_at("", "--variant: there is no variant \"" + variant + "\"; there are " + list);
}

// The material that a primitive has under a variant; the first mapping counts.
const json* mapped_material(const json& primitive, uint64_t variant) {
    if (!primitive.contains("extensions") || !primitive["extensions"].contains("KHR_materials_variants")) {
        return nullptr;
    }
    for (const json& mapping : primitive["extensions"]["KHR_materials_variants"]["mappings"]) {
        for (const json& index : mapping["variants"]) {
            if (index.get<uint64_t>() == variant) return &mapping["material"];
        }
    }
    return nullptr;
}

}  // namespace

void check_extensions(const json& document, Omissions& omissions) {
    const json required = document.value("extensionsRequired", json::array());
    for (size_t i = 0; i < required.size(); ++i) {
        const std::string name = required[i];
        const ExtensionRow& row = row_of(name);
        if (!is_missed(row) || has_other_images(document, name)) continue;
        const std::string instead = row.treatment == Treatment::left_out
                                        ? ", or take it out of extensionsRequired to see the picture that is left"
                                        : "";
        fail_at("/extensionsRequired/" + std::to_string(i), "the file cannot be shown without " + name +
                                                                ", which is not supported; " + std::string(row.remedy) +
                                                                instead);
    }
    for (const json& entry : document.value("extensionsUsed", json::array())) {
        const std::string name = entry;
        const ExtensionRow& row = row_of(name);
        if (!is_missed(row) || has_other_images(document, name)) continue;
        const std::string missing(row.missing), remedy(row.remedy);
        omissions.add("extension " + name, missing.empty() ? remedy : missing + "; " + remedy);
    }
}

void apply_variant(json& document, const std::string& variant) {
    if (variant.empty()) return;
    const std::vector<std::string> names = variant_names(document);
    const auto found = std::find(names.begin(), names.end(), variant);
    if (found == names.end()) fail_without_variant(names, variant);
    const uint64_t index = static_cast<uint64_t>(found - names.begin());
    if (!document.contains("meshes")) return;
    for (json& mesh : document["meshes"]) {
        for (json& primitive : mesh["primitives"]) {
            if (const json* material = mapped_material(primitive, index)) primitive["material"] = json(*material);
        }
    }
}

void take_webp_images(json& document) {
    if (!document.contains("textures")) return;
    for (json& texture : document["textures"]) {
        if (!texture.contains("extensions") || !texture["extensions"].contains("EXT_texture_webp")) continue;
        texture["source"] = json(texture["extensions"]["EXT_texture_webp"]["source"]);
    }
}

}  // namespace render_system
