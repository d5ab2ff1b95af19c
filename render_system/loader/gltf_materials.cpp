// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/loader/gltf_materials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <string>

#include "render_system/loader/gltf_animations.h"
#include "render_system/loader/gltf_textures.h"
#include "render_system/loader/load_error.h"
#include "render_system/scene_limits.h"

namespace render_system {

namespace {

using tinygltf::Value;

const Value* find(const tinygltf::ExtensionMap& extensions, const char* name) {
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

float number(const Value& object, const char* key, float fallback) {
    return object.Has(key) ? static_cast<float>(object.Get(key).GetNumberAsDouble()) : fallback;
}

glm::vec3 numbers(const Value& object, const char* key, const glm::vec3& fallback) {
    if (!object.Has(key)) return fallback;
    const Value& array = object.Get(key);
    glm::vec3 result(0.0f);
    for (int i = 0; i < std::min(3, static_cast<int>(array.ArrayLen())); ++i) {
        result[i] = static_cast<float>(array.Get(static_cast<size_t>(i)).GetNumberAsDouble());
    }
    return result;
}

// Either of tinygltf's two forms of a reference to a texture.
struct TextureInfo {
    int texture = -1;
    int uv_set = 0;
    const Value* transform = nullptr;
};

template <class Info>
TextureInfo info_of(const Info& info) {
    return {info.index, info.texCoord, find(info.extensions, "KHR_texture_transform")};
}

TextureInfo info_in(const Value& object, const char* key) {
    TextureInfo info;
    if (!object.Has(key)) return info;
    const Value& source = object.Get(key);
    info.texture = source.Get("index").GetNumberAsInt();
    if (source.Has("texCoord")) info.uv_set = source.Get("texCoord").GetNumberAsInt();
    if (source.Has("extensions") && source.Get("extensions").Has("KHR_texture_transform")) {
        info.transform = &source.Get("extensions").Get("KHR_texture_transform");
    }
    return info;
}

class MaterialReader {
public:
    MaterialReader(GltfDocument& document, HostScene& scene)
        : document_(document), textures_(document, scene), animated_(animated_materials(document)) {}

    CoreMaterial read(size_t index) {
        const tinygltf::Material& source = document_.model.materials[index];
        place_ = "/materials/" + std::to_string(index);
        material_ = CoreMaterial();
        // What is nothing now need not be read, unless an animation may make it something.
        changes_ = animated_.contains(static_cast<int>(index));
        read_alpha(source);
        if (find(source.extensions, "KHR_materials_unlit")) {
            read_unlit(source);
        } else {
            if (const Value* glossy = find(source.extensions, "KHR_materials_pbrSpecularGlossiness"))
                read_specular_glossiness(*glossy);
            else
                read_base(source);
            read_surface(source);
            read_emission(source);
            read_transmission(source);
            read_specular(source);
            read_sheen(source);
            read_coat(source);
            read_film(source);
            read_anisotropy(source);
        }
        document_.uv_sets[index] = resolve_uv_sets();
        // Index 0 stands for one past all bounds: all light is reflected, and nothing behind is ever seen.
        if (material_.ior == 0.0f) material_.transmission = 0.0f;
        if (Status status = check_material(material_); !status.ok()) fail_at(place_, status.message + EXPORT_AGAIN);
        return material_;
    }

private:
    void read_base(const tinygltf::Material& source) {
        const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
        for (int i = 0; i < 3; ++i) material_.base_color[i] = unit(pbr.baseColorFactor[static_cast<size_t>(i)]);
        material_.alpha = unit(pbr.baseColorFactor[3]);
        material_.metallic = unit(pbr.metallicFactor);
        material_.roughness = unit(pbr.roughnessFactor);
        material_.base_color_texture = slot(info_of(pbr.baseColorTexture), TextureRole::color);
        material_.metallic_roughness_texture = slot(info_of(pbr.metallicRoughnessTexture), TextureRole::data);
    }

    void read_surface(const tinygltf::Material& source) {
        material_.normal_texture = slot(info_of(source.normalTexture), TextureRole::data);
        material_.normal_scale = static_cast<float>(source.normalTexture.scale);
    }

    // KHR_materials_specular, "Conversions": such a material is one without metal whose index of refraction stands past
    // all bounds, so that the specular colour alone is what it reflects at normal incidence.
    void read_specular_glossiness(const Value& source) {
        const float glossiness = unit(static_cast<double>(number(source, "glossinessFactor", 1.0f)));
        const glm::vec3 diffuse = numbers(source, "diffuseFactor", glm::vec3(1.0f));
        const glm::vec3 specular = numbers(source, "specularFactor", glm::vec3(1.0f));
        for (int i = 0; i < 3; ++i) {
            material_.base_color[i] = unit(static_cast<double>(diffuse[i]));
            material_.specular_color[i] = unit(static_cast<double>(specular[i]));
        }
        if (source.Has("diffuseFactor")) material_.alpha = unit(source.Get("diffuseFactor").Get(3).GetNumberAsDouble());
        material_.base_color_texture = slot(info_in(source, "diffuseTexture"), TextureRole::color);
        material_.metallic = 0.0f;
        material_.roughness = 1.0f - glossiness;
        material_.ior = 0.0f;
        const TextureInfo packed = info_in(source, "specularGlossinessTexture");
        if (packed.texture < 0) return;
        material_.specular_color_texture = slot(packed, TextureRole::color);
        material_.metallic_roughness_texture = slot(packed, TextureRole::data, glossiness);
        if (material_.metallic_roughness_texture.texture != NONE) material_.roughness = 1.0f;
    }

    // Its colour is what one sees, whatever light there is: here, what it gives off. It reflects nothing.
    void read_unlit(const tinygltf::Material& source) {
        read_base(source);
        material_.emission = material_.base_color;
        material_.emission_texture = material_.base_color_texture;
        material_.base_color = glm::vec3(0.0f);
        material_.metallic = 0.0f;
        material_.specular = 0.0f;
        material_.metallic_roughness_texture = CoreTextureSlot();
        if (material_.opaque) material_.base_color_texture = CoreTextureSlot();  // else it has the coverage
    }

    void read_alpha(const tinygltf::Material& source) {
        const float cutoff = std::max(0.0f, static_cast<float>(source.alphaCutoff));
        // A mask that everything passes is opaque.
        material_.opaque = source.alphaMode == "OPAQUE" || (source.alphaMode == "MASK" && cutoff == 0.0f);
        if (source.alphaMode == "MASK") material_.alpha_cutoff = cutoff;
        material_.double_sided = source.doubleSided;
    }

    void read_emission(const tinygltf::Material& source) {
        for (int i = 0; i < 3; ++i) {
            material_.emission[i] = not_negative(source.emissiveFactor[static_cast<size_t>(i)], "emissiveFactor");
        }
        if (const Value* strength = find(source.extensions, "KHR_materials_emissive_strength")) {
            material_.emission *= not_negative(static_cast<double>(number(*strength, "emissiveStrength", 1.0f)),
                                               "extensions/KHR_materials_emissive_strength/emissiveStrength");
        }
        for (int i = 0; i < 3; ++i) {
            if (!std::isfinite(material_.emission[i])) fail_at(place_, "its emission is past the range of a float");
        }
        if (material_.emission == glm::vec3(0.0f) && !changes_) return;
        material_.emission_texture = slot(info_of(source.emissiveTexture), TextureRole::color);
    }

    void read_transmission(const tinygltf::Material& source) {
        if (const Value* extension = find(source.extensions, "KHR_materials_transmission")) {
            material_.transmission = unit(static_cast<double>(number(*extension, "transmissionFactor", 0.0f)));
            material_.transmission_texture = slot(info_in(*extension, "transmissionTexture"), TextureRole::data);
        }
        const Value* volume = find(source.extensions, "KHR_materials_volume");
        if (!volume) return;
        material_.thin_walled = !(number(*volume, "thicknessFactor", 0.0f) > 0.0f);
        read_attenuation(*volume);
        if (volume->Has("thicknessTexture")) document_.omissions.add("thickness textures", place_);
    }

    // Beer's law: of each channel its colour is left after one distance. Of black, in truth, nothing: here a millionth.
    void read_attenuation(const Value& volume) {
        if (!volume.Has("attenuationDistance")) return;  // infinitely far
        constexpr float kBlack = 1e-6f, kMost = 1e30f;
        const float distance = number(volume, "attenuationDistance", 0.0f);
        const glm::vec3 color = numbers(volume, "attenuationColor", glm::vec3(1.0f));
        for (int i = 0; i < 3; ++i) {
            const float left = std::max(unit(static_cast<double>(color[i])), kBlack);
            if (distance > 0.0f) material_.absorption[i] = std::min(-std::log(left) / distance, kMost);
        }
        if (!(distance > 0.0f)) document_.omissions.add("attenuation over a distance that is not above 0", place_);
    }

    void read_specular(const tinygltf::Material& source) {
        if (const Value* extension = find(source.extensions, "KHR_materials_ior")) {
            const float ior =
                not_negative(static_cast<double>(number(*extension, "ior", 1.5f)), "extensions/KHR_materials_ior/ior");
            if (ior > 0.0f && ior < 1.0f)
                document_.omissions.add("indices of refraction below 1, which were kept", place_);
            material_.ior = ior > 0.0f ? std::clamp(ior, 1.0f / HIGHEST_IOR, HIGHEST_IOR) : 0.0f;
        }
        if (const Value* extension = find(source.extensions, "KHR_materials_specular")) {
            material_.specular = unit(static_cast<double>(number(*extension, "specularFactor", 1.0f)));
            const glm::vec3 color = numbers(*extension, "specularColorFactor", glm::vec3(1.0f));
            for (int i = 0; i < 3; ++i) {
                material_.specular_color[i] = not_negative(static_cast<double>(color[i]),
                                                           "extensions/KHR_materials_specular/specularColorFactor");
            }
            material_.specular_texture = slot(info_in(*extension, "specularTexture"), TextureRole::data);
            material_.specular_color_texture = slot(info_in(*extension, "specularColorTexture"), TextureRole::color);
        }
    }

    void read_sheen(const tinygltf::Material& source) {
        const Value* extension = find(source.extensions, "KHR_materials_sheen");
        if (!extension) return;
        const glm::vec3 color = numbers(*extension, "sheenColorFactor", glm::vec3(0.0f));
        for (int i = 0; i < 3; ++i) material_.sheen_color[i] = unit(static_cast<double>(color[i]));
        if (material_.sheen_color == glm::vec3(0.0f) && !changes_) return;
        material_.sheen_roughness = unit(static_cast<double>(number(*extension, "sheenRoughnessFactor", 0.0f)));
        material_.sheen_color_texture = slot(info_in(*extension, "sheenColorTexture"), TextureRole::color);
        material_.sheen_roughness_texture = slot(info_in(*extension, "sheenRoughnessTexture"), TextureRole::data);
    }

    void read_coat(const tinygltf::Material& source) {
        const Value* extension = find(source.extensions, "KHR_materials_clearcoat");
        if (!extension) return;
        material_.coat = unit(static_cast<double>(number(*extension, "clearcoatFactor", 0.0f)));
        if (material_.coat == 0.0f && !changes_) return;
        material_.coat_roughness = unit(static_cast<double>(number(*extension, "clearcoatRoughnessFactor", 0.0f)));
        material_.coat_texture = slot(info_in(*extension, "clearcoatTexture"), TextureRole::data);
        material_.coat_roughness_texture = slot(info_in(*extension, "clearcoatRoughnessTexture"), TextureRole::data);
        material_.coat_normal_texture = slot(info_in(*extension, "clearcoatNormalTexture"), TextureRole::data);
        if (extension->Has("clearcoatNormalTexture"))
            material_.coat_normal_scale = number(extension->Get("clearcoatNormalTexture"), "scale", 1.0f);
    }

    void read_film(const tinygltf::Material& source) {
        const Value* extension = find(source.extensions, "KHR_materials_iridescence");
        if (!extension) return;
        const auto length = [&](const char* key, float fallback) {
            return not_negative(static_cast<double>(number(*extension, key, fallback)),
                                (std::string("extensions/KHR_materials_iridescence/") + key).c_str());
        };
        material_.film = unit(static_cast<double>(number(*extension, "iridescenceFactor", 0.0f)));
        if (material_.film == 0.0f && !changes_) return;
        material_.film_ior = std::clamp(length("iridescenceIor", 1.3f), 1.0f, HIGHEST_IOR);
        material_.film_thickness = {length("iridescenceThicknessMinimum", 100.0f),
                                    length("iridescenceThicknessMaximum", 400.0f)};
        if (material_.film_thickness.x > material_.film_thickness.y)
            document_.omissions.add("least thicknesses above the greatest, which were kept", place_);
        material_.film_texture = slot(info_in(*extension, "iridescenceTexture"), TextureRole::data);
        material_.film_thickness_texture = slot(info_in(*extension, "iridescenceThicknessTexture"), TextureRole::data);
    }

    void read_anisotropy(const tinygltf::Material& source) {
        const Value* extension = find(source.extensions, "KHR_materials_anisotropy");
        if (!extension) return;
        material_.anisotropy = unit(static_cast<double>(number(*extension, "anisotropyStrength", 0.0f)));
        if (material_.anisotropy == 0.0f && !changes_) return;
        material_.anisotropy_rotation = number(*extension, "anisotropyRotation", 0.0f);
        material_.anisotropy_texture = slot(info_in(*extension, "anisotropyTexture"), TextureRole::data);
    }

    // With a `glossiness` the texture's roughness is 1 minus that times its alpha. The slot's set of coordinates is the
    // file's number until resolve_uv_sets has seen all of the material's.
    CoreTextureSlot slot(const TextureInfo& info, TextureRole role, std::optional<float> glossiness = {}) {
        CoreTextureSlot slot;
        if (info.texture < 0) return slot;
        int uv_set = info.uv_set;
        if (info.transform) {
            apply_transform(*info.transform, slot);
            if (info.transform->Has("texCoord")) uv_set = info.transform->Get("texCoord").GetNumberAsInt();
        }
        slot.uv_set = static_cast<uint32_t>(uv_set);
        slot.texture = textures_.add(info.texture, role, glossiness);
        return slot;
    }

    // A mesh has four sets of coordinates; which of the file's they are is each material's choice.
    std::array<int, 4> resolve_uv_sets() {
        std::set<uint32_t> used;
        for (const auto member : kTextureSlots) {
            if ((material_.*member).texture != NONE) used.insert((material_.*member).uv_set);
        }
        std::array<int, 4> sets{0, 1, -1, -1};
        if (used.empty() || *used.rbegin() <= 1) return sets;
        sets.fill(-1);
        std::copy_n(used.begin(), std::min(used.size(), sets.size()), sets.begin());
        if (used.size() > sets.size()) document_.omissions.add("a fifth uv set in one material", place_);
        for (const auto member : kTextureSlots) {
            CoreTextureSlot& slot = material_.*member;
            const auto found = std::find(sets.begin(), sets.end(), static_cast<int>(slot.uv_set));
            slot.uv_set = found == sets.end() ? 0 : static_cast<uint32_t>(found - sets.begin());
        }
        return sets;
    }

    // KHR_texture_transform: translation * rotation * scale. Angles turn counter-clockwise as seen in the picture,
    // where v grows downwards; the extension's own example (a lower left quadrant, turned) is only right this way.
    static void apply_transform(const Value& transform, CoreTextureSlot& slot) {
        const double angle = transform.Has("rotation") ? transform.Get("rotation").GetNumberAsDouble() : 0.0;
        const float c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
        const glm::vec3 offset = numbers(transform, "offset", glm::vec3(0.0f));
        const glm::vec3 scale = numbers(transform, "scale", glm::vec3(1.0f));
        slot.row_u = {c * scale.x, s * scale.y, offset.x};
        slot.row_v = {-s * scale.x, c * scale.y, offset.y};
    }

    float unit(double value) {
        if (value < 0.0 || value > 1.0) document_.omissions.add("factors outside 0 to 1, which were clamped", place_);
        return static_cast<float>(std::clamp(value, 0.0, 1.0));
    }

    float not_negative(double value, const char* what) const {
        if (value < 0.0) fail_at(place_ + "/" + what, "is negative" + EXPORT_AGAIN);
        return static_cast<float>(value);
    }

    GltfDocument& document_;
    GltfTextures textures_;
    const std::set<int> animated_;
    CoreMaterial material_;
    std::string place_;
    bool changes_ = false;  // the material at hand is animated
};

}  // namespace

void add_materials(GltfDocument& document, const std::vector<bool>& used, HostScene& scene) {
    MaterialReader reader(document, scene);
    const size_t count = document.model.materials.size();
    document.uv_sets.assign(count + 1, {0, 1, -1, -1});
    for (size_t i = 0; i < count; ++i) {
        const tinygltf::Material& source = document.model.materials[i];
        const bool unlit = source.extensions.contains("KHR_materials_unlit");
        scene.add_material({source.name, used[i] ? reader.read(i) : CoreMaterial(), used[i] && unlit});
    }
    if (used[count]) scene.add_material({"default", CoreMaterial(), false});
}

}  // namespace render_system
