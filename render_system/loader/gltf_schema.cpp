// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/loader/gltf_schema.h"

#include <algorithm>
#include <cctype>
#include <cfloat>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "render_system/loader/load_error.h"

namespace render_system {

namespace {

using nlohmann::json;

enum class Kind {
    object,
    array,
    text,
    boolean,
    number,
    numbers,    // an array of `length` numbers; 0: any length
    integer,    // not negative, at most 2^53
    integer32,  // not negative, at most 2^31 - 1
    index,      // into the array at `target`
    indices,    // an array of them
    one_of,     // one of the words or numbers in `target`, separated by spaces
};

enum class Need { optional, required };

// One line of the schema. In a path, `name[]` stands for each element of an array and `*` for each member.
struct Rule {
    const char* path;
    Kind kind;
    const char* target = "";
    size_t length = 0;
    Need need = Need::optional;
};

constexpr Need REQUIRED = Need::required;
constexpr const char* COMPONENTS = "5120 5121 5122 5123 5125 5126";
constexpr const char* WRAPS = "10497 33071 33648";

// Order matters: a container stands before what is in it.
const Rule RULES[] = {
    {"asset", Kind::object, "", 0, REQUIRED},
    {"asset.version", Kind::text, "", 0, REQUIRED},
    {"asset.minVersion", Kind::text},
    {"extensionsUsed", Kind::array},
    {"extensionsUsed[]", Kind::text},
    {"extensionsRequired", Kind::array},
    {"extensionsRequired[]", Kind::text},
    {"extensions", Kind::object},
    {"extensions.KHR_lights_punctual", Kind::object},
    {"extensions.KHR_lights_punctual.lights", Kind::array, "", 0, REQUIRED},
    {"extensions.KHR_lights_punctual.lights[]", Kind::object},
    {"extensions.KHR_lights_punctual.lights[].type", Kind::one_of, "point spot directional", 0, REQUIRED},
    {"extensions.KHR_lights_punctual.lights[].name", Kind::text},
    {"extensions.KHR_lights_punctual.lights[].color", Kind::numbers, "", 3},
    {"extensions.KHR_lights_punctual.lights[].intensity", Kind::number},
    {"extensions.KHR_lights_punctual.lights[].range", Kind::number},
    {"extensions.KHR_lights_punctual.lights[].spot", Kind::object},
    {"extensions.KHR_lights_punctual.lights[].spot.innerConeAngle", Kind::number},
    {"extensions.KHR_lights_punctual.lights[].spot.outerConeAngle", Kind::number},

    {"extensions.EXT_lights_image_based", Kind::object},
    {"extensions.EXT_lights_image_based.lights", Kind::array, "", 0, REQUIRED},
    {"extensions.EXT_lights_image_based.lights[]", Kind::object},
    {"extensions.EXT_lights_image_based.lights[].intensity", Kind::number},
    {"extensions.EXT_lights_image_based.lights[].rotation", Kind::numbers, "", 4},
    {"extensions.EXT_lights_image_based.lights[].specularImages", Kind::array, "", 0, REQUIRED},
    {"extensions.EXT_lights_image_based.lights[].specularImages[]", Kind::indices, "images"},
    {"extensions.KHR_materials_variants", Kind::object},
    {"extensions.KHR_materials_variants.variants", Kind::array, "", 0, REQUIRED},
    {"extensions.KHR_materials_variants.variants[]", Kind::object},
    {"extensions.KHR_materials_variants.variants[].name", Kind::text, "", 0, REQUIRED},

    {"buffers", Kind::array},
    {"buffers[]", Kind::object},
    {"buffers[].byteLength", Kind::integer, "", 0, REQUIRED},
    {"buffers[].uri", Kind::text},
    {"bufferViews", Kind::array},
    {"bufferViews[]", Kind::object},
    {"bufferViews[].buffer", Kind::index, "buffers", 0, REQUIRED},
    {"bufferViews[].byteOffset", Kind::integer},
    {"bufferViews[].byteLength", Kind::integer, "", 0, REQUIRED},
    {"bufferViews[].byteStride", Kind::integer32},
    {"bufferViews[].extensions", Kind::object},
    {"bufferViews[].extensions.EXT_meshopt_compression", Kind::object},
    {"bufferViews[].extensions.EXT_meshopt_compression.buffer", Kind::index, "buffers", 0, REQUIRED},
    {"bufferViews[].extensions.EXT_meshopt_compression.byteOffset", Kind::integer},
    {"bufferViews[].extensions.EXT_meshopt_compression.byteLength", Kind::integer, "", 0, REQUIRED},
    {"bufferViews[].extensions.EXT_meshopt_compression.byteStride", Kind::integer32, "", 0, REQUIRED},
    {"bufferViews[].extensions.EXT_meshopt_compression.count", Kind::integer, "", 0, REQUIRED},
    {"bufferViews[].extensions.EXT_meshopt_compression.mode", Kind::one_of, "ATTRIBUTES TRIANGLES INDICES", 0,
     REQUIRED},
    {"bufferViews[].extensions.EXT_meshopt_compression.filter", Kind::one_of, "NONE OCTAHEDRAL QUATERNION EXPONENTIAL"},
    {"bufferViews[].extensions.KHR_meshopt_compression", Kind::object},
    {"bufferViews[].extensions.KHR_meshopt_compression.buffer", Kind::index, "buffers", 0, REQUIRED},
    {"bufferViews[].extensions.KHR_meshopt_compression.byteOffset", Kind::integer},
    {"bufferViews[].extensions.KHR_meshopt_compression.byteLength", Kind::integer, "", 0, REQUIRED},
    {"bufferViews[].extensions.KHR_meshopt_compression.byteStride", Kind::integer32, "", 0, REQUIRED},
    {"bufferViews[].extensions.KHR_meshopt_compression.count", Kind::integer, "", 0, REQUIRED},
    {"bufferViews[].extensions.KHR_meshopt_compression.mode", Kind::one_of, "ATTRIBUTES TRIANGLES INDICES", 0,
     REQUIRED},
    {"bufferViews[].extensions.KHR_meshopt_compression.filter", Kind::one_of, "NONE OCTAHEDRAL QUATERNION EXPONENTIAL"},
    {"accessors", Kind::array},
    {"accessors[]", Kind::object},
    {"accessors[].bufferView", Kind::index, "bufferViews"},
    {"accessors[].byteOffset", Kind::integer},
    {"accessors[].componentType", Kind::one_of, COMPONENTS, 0, REQUIRED},
    {"accessors[].normalized", Kind::boolean},
    {"accessors[].count", Kind::integer, "", 0, REQUIRED},
    {"accessors[].type", Kind::one_of, "SCALAR VEC2 VEC3 VEC4 MAT2 MAT3 MAT4", 0, REQUIRED},
    {"accessors[].min", Kind::numbers},
    {"accessors[].max", Kind::numbers},
    {"accessors[].sparse", Kind::object},
    {"accessors[].sparse.count", Kind::integer32, "", 0, REQUIRED},
    {"accessors[].sparse.indices", Kind::object, "", 0, REQUIRED},
    {"accessors[].sparse.indices.bufferView", Kind::index, "bufferViews", 0, REQUIRED},
    {"accessors[].sparse.indices.byteOffset", Kind::integer32},
    {"accessors[].sparse.indices.componentType", Kind::one_of, "5121 5123 5125", 0, REQUIRED},
    {"accessors[].sparse.values", Kind::object, "", 0, REQUIRED},
    {"accessors[].sparse.values.bufferView", Kind::index, "bufferViews", 0, REQUIRED},
    {"accessors[].sparse.values.byteOffset", Kind::integer32},

    {"images", Kind::array},
    {"images[]", Kind::object},
    {"images[].uri", Kind::text},
    {"images[].mimeType", Kind::text},
    {"images[].bufferView", Kind::index, "bufferViews"},
    {"samplers", Kind::array},
    {"samplers[]", Kind::object},
    {"samplers[].magFilter", Kind::one_of, "9728 9729"},
    {"samplers[].minFilter", Kind::one_of, "9728 9729 9984 9985 9986 9987"},
    {"samplers[].wrapS", Kind::one_of, WRAPS},
    {"samplers[].wrapT", Kind::one_of, WRAPS},
    {"textures", Kind::array},
    {"textures[]", Kind::object},
    {"textures[].sampler", Kind::index, "samplers"},
    {"textures[].source", Kind::index, "images"},
    {"textures[].extensions", Kind::object},
    {"textures[].extensions.EXT_texture_webp", Kind::object},
    {"textures[].extensions.EXT_texture_webp.source", Kind::index, "images", 0, REQUIRED},
    {"textures[].extensions.PORTTOOL_pack", Kind::object},
    {"textures[].extensions.PORTTOOL_pack.*", Kind::index, "images"},

    {"materials", Kind::array},
    {"materials[]", Kind::object},
    {"materials[].name", Kind::text},
    {"materials[].alphaMode", Kind::one_of, "OPAQUE MASK BLEND"},
    {"materials[].alphaCutoff", Kind::number},
    {"materials[].doubleSided", Kind::boolean},
    {"materials[].emissiveFactor", Kind::numbers, "", 3},
    {"materials[].pbrMetallicRoughness", Kind::object},
    {"materials[].pbrMetallicRoughness.baseColorFactor", Kind::numbers, "", 4},
    {"materials[].pbrMetallicRoughness.metallicFactor", Kind::number},
    {"materials[].pbrMetallicRoughness.roughnessFactor", Kind::number},
    {"materials[].extensions", Kind::object},
    {"materials[].extensions.*", Kind::object},
    {"materials[].extensions.KHR_materials_emissive_strength.emissiveStrength", Kind::number},
    {"materials[].extensions.KHR_materials_ior.ior", Kind::number},
    {"materials[].extensions.KHR_materials_transmission.transmissionFactor", Kind::number},
    {"materials[].extensions.KHR_materials_anisotropy.anisotropyStrength", Kind::number},
    {"materials[].extensions.KHR_materials_anisotropy.anisotropyRotation", Kind::number},
    {"materials[].extensions.KHR_materials_clearcoat.clearcoatFactor", Kind::number},
    {"materials[].extensions.KHR_materials_clearcoat.clearcoatRoughnessFactor", Kind::number},
    {"materials[].extensions.KHR_materials_iridescence.iridescenceFactor", Kind::number},
    {"materials[].extensions.KHR_materials_iridescence.iridescenceIor", Kind::number},
    {"materials[].extensions.KHR_materials_iridescence.iridescenceThicknessMinimum", Kind::number},
    {"materials[].extensions.KHR_materials_iridescence.iridescenceThicknessMaximum", Kind::number},
    {"materials[].extensions.KHR_materials_sheen.sheenColorFactor", Kind::numbers, "", 3},
    {"materials[].extensions.KHR_materials_sheen.sheenRoughnessFactor", Kind::number},
    {"materials[].extensions.KHR_materials_specular.specularFactor", Kind::number},
    {"materials[].extensions.KHR_materials_specular.specularColorFactor", Kind::numbers, "", 3},
    {"materials[].extensions.KHR_materials_volume.thicknessFactor", Kind::number},
    {"materials[].extensions.KHR_materials_volume.attenuationDistance", Kind::number},
    {"materials[].extensions.KHR_materials_volume.attenuationColor", Kind::numbers, "", 3},
    {"materials[].extensions.KHR_materials_pbrSpecularGlossiness.diffuseFactor", Kind::numbers, "", 4},
    {"materials[].extensions.KHR_materials_pbrSpecularGlossiness.specularFactor", Kind::numbers, "", 3},
    {"materials[].extensions.KHR_materials_pbrSpecularGlossiness.glossinessFactor", Kind::number},

    {"cameras", Kind::array},
    {"cameras[]", Kind::object},
    {"cameras[].name", Kind::text},
    {"cameras[].type", Kind::one_of, "perspective orthographic", 0, REQUIRED},
    {"cameras[].perspective", Kind::object},
    {"cameras[].perspective.yfov", Kind::number, "", 0, REQUIRED},
    {"cameras[].perspective.znear", Kind::number, "", 0, REQUIRED},
    {"cameras[].perspective.zfar", Kind::number},
    {"cameras[].perspective.aspectRatio", Kind::number},
    {"cameras[].orthographic", Kind::object},
    {"cameras[].orthographic.xmag", Kind::number, "", 0, REQUIRED},
    {"cameras[].orthographic.ymag", Kind::number, "", 0, REQUIRED},
    {"cameras[].orthographic.znear", Kind::number, "", 0, REQUIRED},
    {"cameras[].orthographic.zfar", Kind::number, "", 0, REQUIRED},
    {"meshes", Kind::array},
    {"meshes[]", Kind::object},
    {"meshes[].name", Kind::text},
    {"meshes[].primitives", Kind::array, "", 0, REQUIRED},
    {"meshes[].primitives[]", Kind::object},
    {"meshes[].primitives[].attributes", Kind::object, "", 0, REQUIRED},
    {"meshes[].primitives[].attributes.*", Kind::index, "accessors"},
    {"meshes[].primitives[].indices", Kind::index, "accessors"},
    {"meshes[].primitives[].material", Kind::index, "materials"},
    {"meshes[].primitives[].mode", Kind::one_of, "0 1 2 3 4 5 6"},
    {"meshes[].primitives[].targets", Kind::array},
    {"meshes[].primitives[].targets[]", Kind::object},
    {"meshes[].primitives[].targets[].*", Kind::index, "accessors"},
    {"meshes[].primitives[].extensions", Kind::object},
    {"meshes[].primitives[].extensions.KHR_draco_mesh_compression", Kind::object},
    {"meshes[].primitives[].extensions.KHR_draco_mesh_compression.bufferView", Kind::index, "bufferViews", 0, REQUIRED},
    {"meshes[].primitives[].extensions.KHR_draco_mesh_compression.attributes", Kind::object, "", 0, REQUIRED},
    {"meshes[].primitives[].extensions.KHR_draco_mesh_compression.attributes.*", Kind::integer32},
    {"meshes[].primitives[].extensions.KHR_materials_variants", Kind::object},
    {"meshes[].primitives[].extensions.KHR_materials_variants.mappings", Kind::array, "", 0, REQUIRED},
    {"meshes[].primitives[].extensions.KHR_materials_variants.mappings[]", Kind::object},
    {"meshes[].primitives[].extensions.KHR_materials_variants.mappings[].material", Kind::index, "materials", 0,
     REQUIRED},
    {"meshes[].primitives[].extensions.KHR_materials_variants.mappings[].variants", Kind::indices,
     "extensions.KHR_materials_variants.variants", 0, REQUIRED},
    {"meshes[].weights", Kind::numbers},
    {"skins", Kind::array},
    {"skins[]", Kind::object},
    {"skins[].joints", Kind::indices, "nodes", 0, REQUIRED},
    {"skins[].inverseBindMatrices", Kind::index, "accessors"},
    {"skins[].skeleton", Kind::index, "nodes"},
    {"animations", Kind::array},
    {"animations[]", Kind::object},
    {"animations[].name", Kind::text},
    {"animations[].samplers", Kind::array, "", 0, REQUIRED},
    {"animations[].samplers[]", Kind::object},
    {"animations[].samplers[].input", Kind::index, "accessors", 0, REQUIRED},
    {"animations[].samplers[].output", Kind::index, "accessors", 0, REQUIRED},
    {"animations[].samplers[].interpolation", Kind::one_of, "LINEAR STEP CUBICSPLINE"},
    {"animations[].channels", Kind::array, "", 0, REQUIRED},
    {"animations[].channels[]", Kind::object},
    {"animations[].channels[].sampler", Kind::integer32, "", 0, REQUIRED},
    {"animations[].channels[].target", Kind::object, "", 0, REQUIRED},
    {"animations[].channels[].target.node", Kind::index, "nodes"},
    {"animations[].channels[].target.path", Kind::text, "", 0, REQUIRED},
    {"animations[].channels[].target.extensions", Kind::object},
    {"animations[].channels[].target.extensions.KHR_animation_pointer", Kind::object},
    {"animations[].channels[].target.extensions.KHR_animation_pointer.pointer", Kind::text, "", 0, REQUIRED},
    {"nodes", Kind::array},
    {"nodes[]", Kind::object},
    {"nodes[].name", Kind::text},
    {"nodes[].children", Kind::indices, "nodes"},
    {"nodes[].mesh", Kind::index, "meshes"},
    {"nodes[].camera", Kind::index, "cameras"},
    {"nodes[].skin", Kind::index, "skins"},
    {"nodes[].weights", Kind::numbers},
    {"nodes[].matrix", Kind::numbers, "", 16},
    {"nodes[].translation", Kind::numbers, "", 3},
    {"nodes[].rotation", Kind::numbers, "", 4},
    {"nodes[].scale", Kind::numbers, "", 3},
    {"nodes[].extensions", Kind::object},
    {"nodes[].extensions.KHR_lights_punctual", Kind::object},
    {"nodes[].extensions.KHR_lights_punctual.light", Kind::index, "extensions.KHR_lights_punctual.lights", 0, REQUIRED},
    {"nodes[].extensions.KHR_node_visibility", Kind::object},
    {"nodes[].extensions.KHR_node_visibility.visible", Kind::boolean},
    {"nodes[].extensions.EXT_mesh_gpu_instancing", Kind::object},
    {"nodes[].extensions.EXT_mesh_gpu_instancing.attributes", Kind::object, "", 0, REQUIRED},
    {"nodes[].extensions.EXT_mesh_gpu_instancing.attributes.*", Kind::index, "accessors"},
    {"scenes", Kind::array},
    {"scenes[]", Kind::object},
    {"scenes[].nodes", Kind::indices, "nodes"},
    {"scenes[].extensions", Kind::object},
    {"scenes[].extensions.EXT_lights_image_based", Kind::object},
    {"scenes[].extensions.EXT_lights_image_based.light", Kind::index, "extensions.EXT_lights_image_based.lights", 0,
     REQUIRED},
    {"scene", Kind::index, "scenes"},
};

const char* const TEXTURE_INFOS[] = {
    "materials[].pbrMetallicRoughness.baseColorTexture",
    "materials[].pbrMetallicRoughness.metallicRoughnessTexture",
    "materials[].normalTexture",
    "materials[].occlusionTexture",
    "materials[].emissiveTexture",
    "materials[].extensions.KHR_materials_transmission.transmissionTexture",
    "materials[].extensions.KHR_materials_specular.specularTexture",
    "materials[].extensions.KHR_materials_anisotropy.anisotropyTexture",
    "materials[].extensions.KHR_materials_clearcoat.clearcoatTexture",
    "materials[].extensions.KHR_materials_clearcoat.clearcoatRoughnessTexture",
    "materials[].extensions.KHR_materials_clearcoat.clearcoatNormalTexture",
    "materials[].extensions.KHR_materials_iridescence.iridescenceTexture",
    "materials[].extensions.KHR_materials_iridescence.iridescenceThicknessTexture",
    "materials[].extensions.KHR_materials_sheen.sheenColorTexture",
    "materials[].extensions.KHR_materials_sheen.sheenRoughnessTexture",
    "materials[].extensions.KHR_materials_specular.specularColorTexture",
    "materials[].extensions.KHR_materials_volume.thicknessTexture",
    "materials[].extensions.KHR_materials_pbrSpecularGlossiness.diffuseTexture",
    "materials[].extensions.KHR_materials_pbrSpecularGlossiness.specularGlossinessTexture",
};

// What each of them may hold.
const Rule TEXTURE_INFO_RULES[] = {
    {"", Kind::object},
    {".index", Kind::index, "textures", 0, REQUIRED},
    {".texCoord", Kind::integer32},
    {".scale", Kind::number},
    {".strength", Kind::number},
    {".extensions", Kind::object},
    {".extensions.KHR_texture_transform", Kind::object},
    {".extensions.KHR_texture_transform.offset", Kind::numbers, "", 2},
    {".extensions.KHR_texture_transform.scale", Kind::numbers, "", 2},
    {".extensions.KHR_texture_transform.rotation", Kind::number},
    {".extensions.KHR_texture_transform.texCoord", Kind::integer32},
};

[[noreturn]] void fail(const std::string& place, const std::string& what) { fail_at(place, what + EXPORT_AGAIN); }

// What a value looks like in a message.
std::string shown(const json& value) {
    if (value.is_structured()) return value.is_array() ? "an array" : "an object";
    const std::string text = value.dump();
    return text.size() <= 40 ? text : text.substr(0, 37) + "...";
}

class Checker {
public:
    explicit Checker(json& document) : document_(document) {}

    void check(const Rule& rule, std::string_view path) { walk(document_, path, "", rule); }

private:
    // Goes down `path` from `value`, which is at `place`, and holds all that it finds against the rule.
    void walk(json& value, std::string_view path, const std::string& place, const Rule& rule) {
        if (path.empty()) return check_value(value, place, rule);
        if (!value.is_object()) return;  // another rule has said so, or the branch is none of ours
        const size_t dot = path.find('.');
        std::string_view name = path.substr(0, dot);
        const std::string_view rest = dot == std::string_view::npos ? "" : path.substr(dot + 1);
        if (name == "*") {
            for (auto& [key, member] : value.items()) walk(member, rest, place + "/" + key, rule);
            return;
        }
        const bool each = name.size() > 2 && name.substr(name.size() - 2) == "[]";
        if (each) name.remove_suffix(2);
        const auto found = value.find(name);
        const std::string below = place + "/" + std::string(name);
        if (found == value.end()) {
            if (rest.empty() && !each && rule.need == Need::required) fail(below, "is missing");
        } else if (!each) {
            walk(*found, rest, below, rule);
        } else if (found->is_array()) {
            for (size_t i = 0; i < found->size(); ++i) walk((*found)[i], rest, below + "/" + std::to_string(i), rule);
        }
    }

    void check_value(json& value, const std::string& place, const Rule& rule) {
        switch (rule.kind) {
            case Kind::object:
                return expect(value.is_object(), value, place, "an object");
            case Kind::array:
                return expect(value.is_array(), value, place, "an array");
            case Kind::text:
                return expect(value.is_string(), value, place, "a string");
            case Kind::boolean:
                return expect(value.is_boolean(), value, place, "true or false");
            case Kind::number:
                return check_number(value, place);
            case Kind::numbers:
                return check_numbers(value, place, rule.length);
            case Kind::integer:
                return check_integer(value, place, uint64_t{1} << 53);
            case Kind::integer32:
                return check_integer(value, place, std::numeric_limits<int32_t>::max());
            case Kind::index:
                return check_index(value, place, rule.target);
            case Kind::indices:
                expect(value.is_array(), value, place, "an array");
                for (size_t i = 0; i < value.size(); ++i) {
                    check_index(value[i], place + "/" + std::to_string(i), rule.target);
                }
                return;
            case Kind::one_of:
                return check_one_of(value, place, rule.target);
        }
    }

    static void expect(bool good, const json& value, const std::string& place, const char* what) {
        if (!good) fail(place, "is " + shown(value) + " where " + what + " should be");
    }

    // Leaves a floating-point number: tinygltf cuts integers to 32 bits.
    static void check_number(json& value, const std::string& place) {
        expect(value.is_number(), value, place, "a number");
        if (!(std::abs(value.get<double>()) <= static_cast<double>(FLT_MAX))) {
            fail(place, "is " + shown(value) + ", past the range of a float");
        }
        value = value.get<double>();
    }

    static void check_numbers(json& value, const std::string& place, size_t length) {
        expect(value.is_array(), value, place, "an array of numbers");
        if (length > 0 && value.size() != length) {
            fail(place,
                 "has " + std::to_string(value.size()) + " numbers where " + std::to_string(length) + " should be");
        }
        for (size_t i = 0; i < value.size(); ++i) check_number(value[i], place + "/" + std::to_string(i));
    }

    static void check_integer(json& value, const std::string& place, uint64_t largest) {
        if (value.is_number_float()) {
            const double number = value.get<double>();
            if (number >= 0.0 && number <= static_cast<double>(largest) && number == std::floor(number)) {
                value = static_cast<uint64_t>(number);
            }
        }
        const bool good = value.is_number_unsigned() || (value.is_number_integer() && value.get<int64_t>() >= 0);
        expect(good, value, place, "an integer of at least 0");
        if (value.get<uint64_t>() > largest) {
            fail(place, "is " + shown(value) + ", but " + std::to_string(largest) + " is the largest possible");
        }
    }

    void check_index(json& value, const std::string& place, const char* target) const {
        check_integer(value, place, std::numeric_limits<int32_t>::max());
        const size_t count = elements(target);
        if (value.get<uint64_t>() < count) return;
        fail(place, "is " + shown(value) + ", but " + target + " has " + std::to_string(count) + " elements");
    }

    size_t elements(std::string_view path) const {
        const json* value = &document_;
        while (!path.empty()) {
            const size_t dot = path.find('.');
            if (!value->is_object()) return 0;
            const auto found = value->find(path.substr(0, dot));
            if (found == value->end()) return 0;
            value = &*found;
            path = dot == std::string_view::npos ? "" : path.substr(dot + 1);
        }
        return value->is_array() ? value->size() : 0;
    }

    static void check_one_of(json& value, const std::string& place, std::string_view words) {
        if (value.is_number()) check_integer(value, place, std::numeric_limits<int32_t>::max());
        const std::string text = value.is_string() ? value.get<std::string>() : shown(value);
        const bool wants_text = std::isalpha(static_cast<unsigned char>(words.front()));
        std::string_view left = words;
        while (!left.empty() && value.is_string() == wants_text) {
            const std::string_view word = left.substr(0, left.find(' '));
            if (word == text) return;
            left.remove_prefix(std::min(left.size(), word.size() + 1));
        }
        fail(place, "is " + shown(value) + "; it can be one of: " + std::string(words));
    }

    json& document_;
};

// Rules that look at more than one value.
void check_nodes(const json& document) {
    if (!document.contains("nodes")) return;
    size_t index = 0;
    for (const json& node : document["nodes"]) {
        const bool has_parts = node.contains("translation") || node.contains("rotation") || node.contains("scale");
        if (node.contains("matrix") && has_parts) {
            fail("/nodes/" + std::to_string(index), "has a matrix and also a translation, rotation or scale");
        }
        ++index;
    }
}

void check_strides(const json& document) {
    if (!document.contains("bufferViews")) return;
    size_t index = 0;
    for (const json& view : document["bufferViews"]) {
        const std::string place = "/bufferViews/" + std::to_string(index++) + "/byteStride";
        if (!view.contains("byteStride")) continue;
        const uint64_t stride = view["byteStride"].get<uint64_t>();
        if (stride < 4 || stride > 252 || stride % 4 != 0) {
            fail(place, "is " + std::to_string(stride) + "; it must be a multiple of 4 from 4 to 252");
        }
    }
}

}  // namespace

void check_gltf_schema(json& document) {
    if (!document.is_object()) fail("", "is JSON, but not a glTF object");
    Checker checker(document);
    for (const Rule& rule : RULES) checker.check(rule, rule.path);
    for (const char* info : TEXTURE_INFOS) {
        for (const Rule& rule : TEXTURE_INFO_RULES) checker.check(rule, std::string(info) + rule.path);
    }
    check_nodes(document);
    check_strides(document);
}

}  // namespace render_system
