// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/importer/obj_materials.h"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "render_system/importer/texture_name.h"

namespace importer {

namespace {

using nlohmann::json;
using tinyobj::material_t;
using tinyobj::texture_option_t;

bool is_black(const float* color) { return color[0] <= 0.0f && color[1] <= 0.0f && color[2] <= 0.0f; }

float unit(float value) { return value >= 0.0f ? std::min(value, 1.0f) : 0.0f; }  // NaN: 0

json unit_color(const float* color) { return {unit(color[0]), unit(color[1]), unit(color[2])}; }

// Beckmann's distribution for Blinn and Phong's exponent: alpha^2 = 2 / (n + 2), and alpha is roughness squared.
float roughness_of(float exponent) { return std::pow(2.0f / (std::max(exponent, 0.0f) + 2.0f), 0.25f); }

bool names_normals(std::string name) {
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
    for (const char* mark : {"norm", "nrm", "_n.", "_ddn", "_nm."}) {
        if (name.find(mark) != std::string::npos) return true;
    }
    return false;
}

class MtlConverter {
public:
    MtlConverter(const material_t& source, const std::filesystem::path& folder, GlbBuilder& builder)
        : source_(source), folder_(folder), builder_(builder) {}

    json convert() {
        material_ = {{"name", source_.name}, {"doubleSided", true}};  // MTL knows no sides
        add_base();
        add_emission();
        add_normals();
        note_left_out();
        return material_;
    }

private:
    bool is_pbr() const {
        return source_.roughness > 0.0f || source_.metallic > 0.0f || !source_.roughness_texname.empty() ||
               !source_.metallic_texname.empty();
    }

    void add_base() {
        const bool refracts = source_.illum == 6 || source_.illum == 7;
        json& pbr = material_["pbrMetallicRoughness"];
        pbr["baseColorFactor"] = unit_color(source_.diffuse);
        pbr["baseColorFactor"].push_back(refracts ? 1.0f : unit(source_.dissolve));
        pbr["metallicFactor"] = 0.0f;
        const bool covers = !refracts && (source_.dissolve < 1.0f || !source_.alpha_texname.empty());
        if (covers) material_["alphaMode"] = "BLEND";
        add_base_texture(pbr);
        if (is_pbr())
            add_pbr(pbr);
        else
            add_phong(pbr);
        if (refracts) add_glass();
    }

    // Coverage is the fourth channel of the colours' texture.
    void add_base_texture(json& pbr) {
        const std::string &color = source_.diffuse_texname, &alpha = source_.alpha_texname;
        if (color.empty() && alpha.empty()) return;
        const texture_option_t& option = color.empty() ? source_.alpha_texopt : source_.diffuse_texopt;
        json pack = nullptr;
        if (!alpha.empty() && alpha != color) pack = {{"alpha", image(alpha)}};
        pbr["baseColorTexture"] = info(color.empty() ? -1 : image(color), option, pack);
        if (is_black(source_.diffuse)) pbr["baseColorFactor"] = {1.0f, 1.0f, 1.0f, unit(source_.dissolve)};
    }

    void add_pbr(json& pbr) {
        const std::string &rough = source_.roughness_texname, &metal = source_.metallic_texname;
        pbr["roughnessFactor"] = rough.empty() ? unit(source_.roughness) : 1.0f;
        pbr["metallicFactor"] = metal.empty() ? unit(source_.metallic) : 1.0f;
        if (rough.empty() && metal.empty()) return;
        json pack = json::object();
        if (!rough.empty()) pack["green"] = image(rough);
        if (!metal.empty()) pack["blue"] = image(metal);
        pbr["metallicRoughnessTexture"] =
            info(-1, rough.empty() ? source_.metallic_texopt : source_.roughness_texopt, pack);
    }

    void add_phong(json& pbr) {
        const bool shines = !is_black(source_.specular);
        pbr["roughnessFactor"] = shines ? roughness_of(source_.shininess) : 1.0f;
        if (!shines) {
            material_["extensions"]["KHR_materials_specular"] = {{"specularFactor", 0.0f}};
        } else if (is_black(source_.diffuse) && source_.diffuse_texname.empty()) {
            // Nothing but a coloured reflection: a metal.
            const json color = unit_color(source_.specular);
            pbr["baseColorFactor"] = {color[0], color[1], color[2], unit(source_.dissolve)};
            pbr["metallicFactor"] = 1.0f;
        }
    }

    void add_glass() {
        const float ior = source_.ior > 1.0f ? std::min(source_.ior, 10.0f) : 1.5f;
        const json color = is_black(source_.transmittance) ? json{1, 1, 1} : unit_color(source_.transmittance);
        json& pbr = material_["pbrMetallicRoughness"];
        pbr["baseColorFactor"] = {color[0], color[1], color[2], 1.0f};
        pbr["metallicFactor"] = 0.0f;
        material_["extensions"] = {{"KHR_materials_transmission", {{"transmissionFactor", 1.0f}}},
                                   {"KHR_materials_volume", {{"thicknessFactor", 1.0f}}},
                                   {"KHR_materials_ior", {{"ior", ior}}}};
    }

    void add_emission() {
        const bool textured = !source_.emissive_texname.empty();
        json color = json::array();
        for (float part : source_.emission) color.push_back(part > 0.0f && std::isfinite(part) ? part : 0.0f);
        if (textured && is_black(source_.emission)) color = {1.0f, 1.0f, 1.0f};
        material_["emissiveFactor"] = color;
        if (textured) material_["emissiveTexture"] = info(image(source_.emissive_texname), source_.emissive_texopt);
    }

    void add_normals() {
        if (!source_.normal_texname.empty()) {
            material_["normalTexture"] = info(image(source_.normal_texname), source_.normal_texopt);
        } else if (names_normals(source_.bump_texname)) {
            material_["normalTexture"] = info(image(source_.bump_texname), source_.bump_texopt);
        } else if (!source_.bump_texname.empty()) {
            builder_.leave_out("bump maps (normal maps are read: norm)");
        }
    }

    void note_left_out() {
        if (!source_.specular_texname.empty()) builder_.leave_out("map_Ks");
        if (!source_.specular_highlight_texname.empty()) builder_.leave_out("map_Ns");
        if (!source_.displacement_texname.empty()) builder_.leave_out("displacement (disp)");
        if (!source_.reflection_texname.empty()) builder_.leave_out("reflection maps (refl)");
        if (source_.sheen > 0.0f || source_.clearcoat_thickness > 0.0f || source_.anisotropy > 0.0f) {
            builder_.leave_out("sheen, clearcoat and anisotropy of MTL");
        }
    }

    int image(const std::string& name) { return static_cast<int>(builder_.add_image(texture_uri(name, folder_))); }

    // MTL's v grows upwards, as its texture coordinates did before they were turned over.
    json info(int source, const texture_option_t& option, const json& pack = nullptr) {
        json info = {{"index", builder_.add_texture(source, option.clamp, pack)}};
        const float *scale = option.scale, *offset = option.origin_offset;
        const bool moved = scale[0] != 1.0f || scale[1] != 1.0f || offset[0] != 0.0f || offset[1] != 0.0f;
        if (moved && std::isfinite(scale[0] + scale[1] + offset[0] + offset[1])) {
            info["extensions"]["KHR_texture_transform"] = {{"scale", {scale[0], scale[1]}},
                                                           {"offset", {offset[0], 1.0f - scale[1] - offset[1]}}};
        }
        return info;
    }

    const material_t& source_;
    const std::filesystem::path& folder_;
    GlbBuilder& builder_;
    json material_;
};

}  // namespace

json gltf_material(const material_t& source, const std::filesystem::path& folder, GlbBuilder& builder) {
    return MtlConverter(source, folder, builder).convert();
}

}  // namespace importer
