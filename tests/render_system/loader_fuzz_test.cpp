// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0

// Thousands of damaged files: each must load or be refused with one line, and what loads must keep the promises that
// cores build on. Most worth under ASan and UBSan.

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "render_system/core_checks.h"
#include "render_system/light_table.h"
#include "render_system/loader/image_reader.h"
#include "render_system/loader/load_error.h"
#include "render_system/loader/uri.h"
#include "render_system/scene_limits.h"
#include "tests/render_system/gltf_file.h"

namespace render_system::testing::loader_fuzz_test {
namespace {

using nlohmann::json;

// A small file that uses nearly everything the loader knows.
GltfFile seed_file() {
    GltfFile file;
    const int positions = file.add(std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    const int normals = file.add(std::vector<glm::vec3>(4, glm::vec3(0, 0, 1)));
    const int uvs = file.add(std::vector<glm::vec2>{{0, 1}, {1, 1}, {1, 0}, {0, 0}});
    const int colors = file.add_accessor(file.add_view(std::vector<uint8_t>(16, 200)), UBYTE, "VEC4", 4, true);
    const int quantized = file.add_accessor(file.add_view(std::vector<int16_t>(16, 7), 8), SHORT, "VEC3", 4);
    const int indices = file.add(std::vector<uint16_t>{0, 1, 2, 0, 2, 3});
    const int where = file.add_view(std::vector<uint8_t>{1});
    const int what = file.add_view(std::vector<glm::vec3>{{2, 0, 0}});
    const json sparse = {{"count", 1},
                         {"indices", {{"bufferView", where}, {"componentType", UBYTE}}},
                         {"values", {{"bufferView", what}}}};
    file.root["accessors"][static_cast<size_t>(positions)]["sparse"] = sparse;
    const std::string image = png(4, 2, 3, std::vector<uint8_t>(24, 90));
    file.root["images"].push_back({{"bufferView", file.add_view(image)}, {"mimeType", "image/png"}});
    file.root["images"].push_back({{"uri", "data:image/png;base64," + base64(image)}});
    file.root["samplers"] = {{{"magFilter", 9728}, {"minFilter", 9987}, {"wrapS", 33071}, {"wrapT", 33648}}};
    file.root["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 1}}};
    const json transform = {{"offset", {0.5, 0}}, {"rotation", 1}, {"scale", {2, 2}}, {"texCoord", 0}};
    const json info = {{"index", 1}, {"extensions", {{"KHR_texture_transform", transform}}}};
    file.root["materials"] = {
        {{"pbrMetallicRoughness",
          {{"baseColorFactor", {1, 0.5, 0.25, 1}}, {"baseColorTexture", info}, {"metallicFactor", 0.5}}},
         {"normalTexture", {{"index", 0}, {"scale", 2}}},
         {"emissiveFactor", {1, 1, 1}},
         {"emissiveTexture", {{"index", 0}}},
         {"alphaMode", "MASK"},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 5}}},
           {"KHR_materials_transmission", {{"transmissionFactor", 0.5}, {"transmissionTexture", info}}},
           {"KHR_materials_volume", {{"thicknessFactor", 1}}},
           {"KHR_materials_specular", {{"specularColorFactor", {1, 1, 1}}}},
           {"KHR_materials_ior", {{"ior", 1.4}}}}}}};
    const json attributes = {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}, {"COLOR_0", colors}};
    file.root["meshes"] = {
        {{"primitives",
          {{{"attributes", attributes}, {"indices", indices}, {"material", 0}},
           {{"attributes", {{"POSITION", quantized}}}, {"mode", 5}}}}},
        {{"primitives", {{{"attributes", {{"POSITION", positions}, {"TEXCOORD_1", uvs}}}, {"mode", 6}}}}}};
    file.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
    file.root["extensionsUsed"] = {"KHR_lights_punctual", "KHR_texture_transform"};
    file.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"color", {1, 1, 1}}, {"intensity", 3}, {"spot", {{"outerConeAngle", 0.5}}}}};
    file.add_node({{"children", {1, 2}}, {"scale", {1, -1, 1}}, {"rotation", {0, 0, 0, 1}}});
    file.add_node({{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1}}});
    file.add_node({{"mesh", 1}, {"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    file.root["scenes"][0]["nodes"] = {0};
    return file;
}

// The same damage on every run; PORTTOOL_FUZZ_SEED=N in the environment tries other files.
class Dice {
public:
    explicit Dice(uint32_t seed) {
        const char* more = std::getenv("PORTTOOL_FUZZ_SEED");
        generator_.seed(seed + 1000u * static_cast<uint32_t>(more ? std::atoi(more) : 0));
    }
    size_t below(size_t count) { return generator_() % std::max<size_t>(count, 1); }

private:
    std::mt19937 generator_;
};

// All values inside a document, the document included.
void collect(json& value, std::vector<json*>& all) {
    all.push_back(&value);
    if (!value.is_structured()) return;
    for (json& child : value) collect(child, all);
}

json odd_value(Dice& dice) {
    const json values[] = {
        0,       1,   -1,    2147483647, 2147483648u, 4294967295u, 9007199254740993, 1e300,
        -1e-300, 0.5, "",    "x",        true,        nullptr,     json::array(),    json::object(),
        {1, 2},  3,   65535, "data:,",   1e18,        1e-18,       "../../x",        "file:/etc/passwd"};
    return values[dice.below(std::size(values))];
}

// Damage to the document: values replaced, members lost or doubled.
json mutated(json document, Dice& dice) {
    for (size_t edits = 1 + dice.below(3); edits > 0; --edits) {
        std::vector<json*> all;
        collect(document, all);
        json& value = *all[dice.below(all.size())];
        const size_t kind = dice.below(8);
        if (kind == 0 && value.is_array() && !value.empty()) {
            value.push_back(json(value[dice.below(value.size())]));
        } else if (kind == 1 && value.is_structured() && !value.empty()) {
            auto member = value.begin();
            std::advance(member, static_cast<std::ptrdiff_t>(dice.below(value.size())));
            value.erase(member);
        } else if (kind == 2) {
            value = json(*all[dice.below(all.size())]);
        } else if (kind <= 4 && value.is_number_integer()) {
            value = value.get<int64_t>() + static_cast<int64_t>(dice.below(7)) - 3;
        } else if (&value != &document) {
            value = odd_value(dice);
        }
    }
    return document;
}

// Damage to the bytes: changed, cut out, doubled, cut off.
std::string mutated(std::string bytes, Dice& dice) {
    for (size_t edits = 1 + dice.below(4); edits > 0 && !bytes.empty(); --edits) {
        const size_t at = dice.below(bytes.size());
        const size_t length = 1 + dice.below(16);
        switch (dice.below(6)) {
            case 0:
                bytes[at] = static_cast<char>(dice.below(256));
                break;
            case 1:
                bytes[at] = static_cast<char>(bytes[at] ^ (1 << dice.below(8)));
                break;
            case 2:
                bytes.erase(at, length);
                break;
            case 3:
                bytes.insert(at, bytes.substr(dice.below(bytes.size()), length));
                break;
            case 4:
                bytes.replace(at, 1, dice.below(2) ? "\xFF" : std::string(1, '\0'));
                break;
            default:
                bytes.resize(dice.below(8) == 0 ? at : bytes.size());
                break;
        }
    }
    return bytes;
}

// What every core relies on.
void expect_sound(const HostScene& scene) {
    for (const HostMesh& mesh : scene.meshes()) {
        const Status status = validate_mesh(mesh.view());
        ASSERT_TRUE(status.ok()) << status.message;
        for (const glm::vec3& p : mesh.positions) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z));
        for (const glm::vec3& n : mesh.normals) ASSERT_NEAR(glm::length(n), 1.0f, 2e-3f);
        for (const glm::uvec4& t : mesh.triangles) ASSERT_LT(t.w, scene.materials().size());
    }
    for (const HostTexture& texture : scene.textures()) ASSERT_TRUE(validate_texture(texture.view()).ok());
    for (const HostInstance& instance : scene.instances()) {
        ASSERT_TRUE(instance.mesh == NONE || instance.mesh < scene.meshes().size());
        ASSERT_TRUE(validate_transform(instance.transform).ok());
        if (instance.mesh == NONE) continue;
        ASSERT_TRUE(is_invertible(instance.transform));
        ASSERT_TRUE(check_placement(placement_of(scene.mesh_box(instance.mesh), instance.transform)).ok());
    }
    for (const HostMaterial& material : scene.materials()) {
        const CoreMaterial& m = material.core;
        for (const CoreTextureSlot* slot : {&m.base_color_texture, &m.normal_texture, &m.emission_texture}) {
            ASSERT_TRUE(slot->texture == NONE || slot->texture < scene.textures().size());
            ASSERT_LE(slot->uv_set, 3u);
        }
    }
    const LightTable table = build_light_table(scene, 0.0);
    ASSERT_TRUE(validate_lights(table.view()).ok());
    for (const AliasEntry& entry : table.table) ASSERT_TRUE(entry.probability >= 0.0f && entry.probability <= 1.0f);
}

class LoaderFuzz : public ::testing::Test {
protected:
    void try_file(const std::string& content, int number) { try_file(folder_ / "fuzzed.glb", content, number); }

    void try_file(const std::filesystem::path& file, const std::string& content, int number) {
        write_file(file, content);
        const Result<LoadedScene> result = load_scene(file);
        if (result.ok()) {
            ++loaded_;
            expect_sound(result->scene);
        } else {
            ASSERT_FALSE(result.status.message.empty()) << number;
            ASSERT_EQ(result.status.message.find('\n'), std::string::npos) << result.status.message;
        }
    }

    TempFolder folder_;
    int loaded_ = 0;
};

TEST_F(LoaderFuzz, TheSeedItselfLoads) {
    try_file(seed_file().glb(), 0);
    EXPECT_EQ(loaded_, 1);
}

TEST_F(LoaderFuzz, DamagedDocuments) {
    Dice dice(1);
    const GltfFile seed = seed_file();
    for (int i = 0; i < 3000 && !HasFatalFailure(); ++i) {
        GltfFile file = seed;
        file.root = mutated(seed.root, dice);
        std::string content;
        try {
            content = i % 2 == 0 ? file.glb() : file.text_embedded();
        } catch (const json::exception&) {
            continue;  // no longer an object: nothing to write
        }
        try_file(content, i);
    }
    EXPECT_GT(loaded_, 100);  // else the damage is too coarse to reach the later stages
}

TEST_F(LoaderFuzz, DamagedBytes) {
    Dice dice(2);
    const GltfFile seed = seed_file();
    const std::string binary = seed.glb(), text = seed.text_embedded();
    for (int i = 0; i < 2000 && !HasFatalFailure(); ++i) try_file(mutated(i % 2 == 0 ? binary : text, dice), i);
    EXPECT_GT(loaded_, 100);
}

TEST_F(LoaderFuzz, DamagedBuffers) {
    Dice dice(3);
    const GltfFile seed = seed_file();
    for (int i = 0; i < 1000 && !HasFatalFailure(); ++i) {
        GltfFile file = seed;
        const size_t size = file.buffer.size();
        file.buffer = mutated(file.buffer, dice);
        file.buffer.resize(size);
        try_file(file.glb(), i);
    }
    EXPECT_GT(loaded_, 100);
}

// How often more the damage is tried; PORTTOOL_FUZZ_ROUNDS=N in the environment.
int fuzz_rounds() {
    const char* more = std::getenv("PORTTOOL_FUZZ_ROUNDS");
    return more ? std::max(1, std::atoi(more)) : 1;
}

// The models of docs/formats.md: packed streams, instancing, variants; OBJ and FBX by way of the importer.
TEST_F(LoaderFuzz, DamagedModelsOfEachFormat) {
    Dice dice(5);
    const int rounds = 10 * fuzz_rounds();
    int tried = 0;
    for (const auto& entry : std::filesystem::directory_iterator(FORMATS)) {
        const std::string ending = entry.path().extension();
        if (ending == ".py") continue;
        const std::string seed = read_file(entry.path());
        const bool is_gltf = ending == ".gltf";
        const json document = is_gltf ? json::parse(seed) : json();
        const std::string packed = is_gltf ? document["buffers"][0]["uri"].get<std::string>() : "";
        for (int i = 0; i < rounds && !HasFatalFailure(); ++i, ++tried) {
            const std::filesystem::path file = folder_ / ("fuzzed" + (ending == ".mtl" ? ".obj" : ending));
            std::string content = is_gltf && i % 2 == 0 ? mutated(document, dice).dump() : mutated(seed, dice);
            if (is_gltf && i % 3 == 0) {  // the buffer, whose text is base64
                json other = document;
                const auto bytes = decode_data_uri(packed, "");
                std::string damaged =
                    mutated(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()), dice);
                damaged.resize(bytes.size());
                other["buffers"][0]["uri"] = "data:;base64," + base64(damaged);
                content = other.dump();
            }
            if (ending == ".mtl") {
                write_file(folder_ / "sheet.mtl", content);
                content = read_file(FORMATS "/sheet.obj");
            }
            try_file(file, content, i);
        }
    }
    EXPECT_GT(loaded_, tried / 10);
}

// A file of every format the reader knows.
std::string seed_image(const std::string& name) {
    const TempFolder folder;
    const std::string path = folder / name;
    const auto output = OIIO::ImageOutput::create(path);
    const bool is_hdr = name == "a.hdr" || name == "a.exr";
    const OIIO::ImageSpec spec(9, 5, 3, is_hdr ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
    std::vector<float> pixels(9 * 5 * 3);
    for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<float>(i % 17) / 16.0f;
    EXPECT_TRUE(output->open(path, spec) && output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) &&
                output->close());
    return read_file(path);
}

TEST(ImageFuzz, DamagedImages) {
    Dice dice(4);
    for (const char* name : {"a.png", "a.jpg", "a.tga", "a.hdr", "a.exr", "a.bmp", "a.webp"}) {
        const std::string seed = seed_image(name);
        int read = 0;
        for (int i = 0; i < 300; ++i) {
            const std::string content = mutated(seed, dice);
            try {
                const Image image =
                    read_image({reinterpret_cast<const std::byte*>(content.data()), content.size()}, name);
                const size_t count = static_cast<size_t>(image.width) * image.height;
                ASSERT_EQ(image.bytes.size() + image.shorts.size() + image.floats.size(), count);
                ++read;
            } catch (const LoadError& error) {
                ASSERT_FALSE(error.message.empty());
            }
        }
        EXPECT_GT(read, 10) << name;
    }
}

}  // namespace
}  // namespace render_system::testing::loader_fuzz_test
