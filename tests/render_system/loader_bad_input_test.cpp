// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <limits>

#include "tests/render_system/gltf_file.h"

namespace render_system::testing::loader_bad_input_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

Status load_status(const std::string& name, const std::string& content) {
    const TempFolder folder;
    write_file(folder / name, content);
    const Result<LoadedScene> result = load_scene(folder / name);
    EXPECT_FALSE(result.ok());
    EXPECT_THAT(result.status.message, HasSubstr(name + ": "));
    EXPECT_EQ(result.status.message.find('\n'), std::string::npos) << result.status.message;
    return result.status;
}

std::string message(const std::string& name, const std::string& content) { return load_status(name, content).message; }

// The message for one triangle after an edit.
template <class Edit>
std::string refusal_after(const Edit& edit) {
    GltfFile file = one_triangle();
    edit(file.root);
    return refusal(file);
}

TEST(LoaderContainer, ReadsEmbeddedExternalAndBinaryFilesAlike) {
    const TempFolder folder;
    const GltfFile file = one_triangle();
    write_file(folder / "embedded.gltf", file.text_embedded());
    write_file(folder / "external.gltf", file.text_external("sub%20folder/my%2Bdata.bin"));
    std::filesystem::create_directory(folder / "sub folder");
    write_file(folder / "sub folder/my+data.bin", file.buffer + "longer than needed");
    write_file(folder / "binary.glb", file.glb());
    write_file(folder / "misnamed.gltf", file.glb());
    for (const char* name : {"embedded.gltf", "external.gltf", "binary.glb", "misnamed.gltf"}) {
        const Result<LoadedScene> result = load_scene(folder / name);
        ASSERT_TRUE(result.ok()) << result.status.message;
        EXPECT_EQ(result->scene.meshes()[0].positions[1], glm::vec3(1, 0, 0)) << name;
    }
}

TEST(LoaderContainer, TakesWholeNumbersWrittenWithAPoint) {
    GltfFile file = one_triangle();
    file.root["accessors"][0]["count"] = 3.0;
    file.root["nodes"][0]["mesh"] = 0.0;
    EXPECT_EQ(loaded(file).triangle_count(), 1u);
}

TEST(LoaderContainer, FilesMayLieOutsideTheScenesFolderWhereAllowed) {
    const LoadOptions allowed{.allow_outside = true};
    const TempFolder folder;
    std::filesystem::create_directory(folder / "scenes");
    const GltfFile file = one_triangle();
    write_file(folder / "data.bin", file.buffer);
    write_file(folder / "scenes/scene.gltf", file.text_external("../data.bin"));
    EXPECT_TRUE(load_scene(folder / "scenes/scene.gltf", allowed).ok());
    write_file(folder / "scenes/absolute.gltf", file.text_external("file://" + (folder / "data.bin").string()));
    EXPECT_TRUE(load_scene(folder / "scenes/absolute.gltf", allowed).ok());
}

TEST(LoaderBadInput, AMissingFile) {
    const TempFolder folder;
    const Result<LoadedScene> result = load_scene(folder / "nothing.gltf");
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.status.code, StatusCode::not_found);
    EXPECT_EQ(result.status.message, (folder / "nothing.gltf").string() + ": there is no such file; check the path");
}

TEST(LoaderBadInput, AFolder) {
    const TempFolder folder;
    const Result<LoadedScene> result = load_scene(folder.path());
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.status.code, StatusCode::unreadable);
    EXPECT_THAT(result.status.message, HasSubstr("is not a regular file"));
}

TEST(LoaderBadInput, AnEmptyFile) { EXPECT_THAT(message("a.gltf", ""), HasSubstr("the file is empty")); }

TEST(LoaderBadInput, TextThatIsNoGltf) {
    EXPECT_THAT(message("a.gltf", "# a heading\n"), AllOf(HasSubstr("is not JSON"), HasSubstr("line 1, column 1")));
    EXPECT_THAT(message("a.gltf", "[]"), HasSubstr("not a glTF object"));
    EXPECT_THAT(message("a.gltf", "{}"), HasSubstr("/asset: is missing"));
    EXPECT_THAT(message("a.gltf", R"({"asset": {"version": "1.0"}})"), HasSubstr("convert the file to glTF 2.0"));
    EXPECT_THAT(message("a.gltf", R"({"asset": {"version": 2.0}})"),
                HasSubstr("/asset/version: is 2.0 where a string"));
    EXPECT_THAT(message("a.gltf", R"({"asset": {"version": "2.0"}})"), HasSubstr("there is no scene"));
    EXPECT_THAT(message("a.gltf", R"({"asset": {"version": "2.0", "minVersion": "2.1"}})"),
                HasSubstr("asks for glTF 2.1"));
    EXPECT_THAT(message("a.gltf", std::string(100000, '[')), HasSubstr("nested too deeply"));
    EXPECT_THAT(message("a.gltf", "{\"asset\": \"\xFF\"}"), HasSubstr("is not JSON"));
}

TEST(LoaderBadInput, AGlbCutOffAnywhere) {
    const std::string whole = one_triangle().glb();
    for (size_t length = 1; length < whole.size(); length += 7) {
        const std::string text = message("a.glb", whole.substr(0, length));
        if (length >= 12) {
            EXPECT_THAT(text, HasSubstr("cut off")) << length;
        }
    }
    std::string old = whole;
    old[4] = 1;
    EXPECT_THAT(message("a.glb", old), HasSubstr("version 1"));
    std::string swapped = whole;
    swapped[16] = 'X';
    EXPECT_THAT(message("a.glb", swapped), HasSubstr("another chunk where its JSON chunk"));
}

TEST(LoaderBadInput, ChunksOfOtherKindsArePassedOver) {
    const auto word = [](uint32_t value) { return std::string(reinterpret_cast<const char*>(&value), 4); };
    const std::string whole = one_triangle().glb(), extra = word(8) + "PLUS" + std::string(8, 'x');
    uint32_t json_bytes = 0;
    std::memcpy(&json_bytes, whole.data() + 12, 4);
    for (const size_t place : {size_t{20} + json_bytes, whole.size()}) {
        std::string longer = whole;
        longer.insert(place, extra);
        longer.replace(8, 4, word(static_cast<uint32_t>(longer.size())));
        const TempFolder folder;
        write_file(folder / "a.glb", longer);
        EXPECT_EQ(load_scene(folder / "a.glb").status.message, "") << place;
        if (place == whole.size()) continue;  // what follows the BIN chunk is never looked at
        longer.replace(place, 4, word(1000));
        longer.resize(place + 8);
        longer.replace(8, 4, word(static_cast<uint32_t>(longer.size())));
        EXPECT_THAT(message("a.glb", longer), HasSubstr("needs 1000 bytes")) << place;
    }
}

TEST(LoaderBadInput, ANumberPastADoubleIsNamed) {
    EXPECT_THAT(message("a.gltf", R"({"asset": {"version": "2.0"}, "scene": 1e999})"),
                AllOf(HasSubstr("a.gltf: line 1, column 40: "), HasSubstr("past the range of its type"),
                      HasSubstr("'1e999'"), Not(HasSubstr("is not JSON"))));
    const std::string within =
        R"({"asset": {"version": "2.0", "generator": "a \" b)" + std::string(300, '[') + R"("}})";
    EXPECT_THAT(message("a.gltf", within), HasSubstr("there is no scene")) << "brackets in a string nest nothing";
}

TEST(LoaderBadInput, BuffersThatAreMissingShortOrRemote) {
    const GltfFile file = one_triangle();
    EXPECT_THAT(message("a.gltf", file.text_external("missing.bin")),
                AllOf(HasSubstr("/buffers/0"), HasSubstr("missing.bin: there is no such file")));
    EXPECT_THAT(message("a.gltf", file.text_external("https://example.com/data.bin")),
                AllOf(HasSubstr("/buffers/0/uri"), HasSubstr("https is not supported: download it")));
    EXPECT_THAT(message("a.gltf", file.text_external("data:;base64,AAAA")),
                AllOf(HasSubstr("its data URI has 3 bytes, but byteLength is 72")));
    EXPECT_THAT(message("a.gltf", file.text_external("data:;base64,%%%%")), HasSubstr("is not base64"));
    EXPECT_THAT(message("a.gltf", file.text_external("data:nothing")), HasSubstr("no comma"));
    const TempFolder folder;
    write_file(folder / "short.bin", file.buffer.substr(0, 50));
    write_file(folder / "a.gltf", file.text_external("short.bin"));
    const Result<LoadedScene> result = load_scene(folder / "a.gltf");
    EXPECT_THAT(result.status.message, AllOf(HasSubstr("a.gltf: /buffers/0"), HasSubstr("short.bin has 50 bytes"),
                                             HasSubstr("byteLength is 72; it is cut off")));
}

TEST(LoaderBadInput, ABufferShorterThanItsAccessors) {
    EXPECT_THAT(refusal_after([](json& root) { root["accessors"][0]["count"] = 4; }),
                AllOf(HasSubstr("/accessors/0: has 4 elements"), HasSubstr("room for 3")));
    EXPECT_THAT(refusal_after([](json& root) { root["accessors"][0]["count"] = 9007199254740992; }),
                HasSubstr("/accessors/0"));
    EXPECT_THAT(refusal_after([](json& root) { root["accessors"][0]["byteOffset"] = 9007199254740992; }),
                HasSubstr("room for 0"));
    EXPECT_THAT(refusal_after([](json& root) { root["bufferViews"][1]["byteLength"] = 100; }),
                AllOf(HasSubstr("/bufferViews/1: reaches to byte 136"), HasSubstr("buffer 0 has 72")));
    EXPECT_THAT(refusal_after([](json& root) { root["bufferViews"][0]["byteOffset"] = 9007199254740992; }),
                HasSubstr("/bufferViews/0"));
    EXPECT_THAT(refusal_after([](json& root) { root["bufferViews"][0]["byteStride"] = 4; }), HasSubstr("overlap"));
}

TEST(LoaderBadInput, AccessorsWithoutAViewAndWithoutEnd) {
    EXPECT_THAT(refusal_after([](json& root) {
                    root["accessors"][0].erase("bufferView");
                    root["accessors"][0]["count"] = 1000000000000;
                }),
                HasSubstr("but no buffer view"));
}

TEST(LoaderBadInput, AnIndexPastTheVertices) {
    GltfFile file = one_triangle();
    file.root["meshes"][0]["primitives"][0]["indices"] = file.add(std::vector<uint16_t>{0, 1, 3});
    EXPECT_THAT(refusal(file),
                AllOf(HasSubstr("/meshes/0/primitives/0/indices: index 3 (at 2) is past the 3 vertices")));
}

TEST(LoaderBadInput, PositionsThatAreNotFinite) {
    for (float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        GltfFile file;
        const int positions = file.add(std::vector<glm::vec3>{{0, 0, 0}, {1, bad, 0}, {0, 1, 0}});
        file.add_mesh({{"attributes", {{"POSITION", positions}}}});
        file.add_node({{"mesh", 0}});
        EXPECT_THAT(refusal(file), HasSubstr("/accessors/0: element 1 is not finite"));
    }
}

TEST(LoaderBadInput, SparseIndicesPastTheAccessor) {
    EXPECT_THAT(refusal_after([](json& root) {
                    root["accessors"][0]["sparse"] = {
                        {"count", 1},
                        {"indices", {{"bufferView", 1}, {"componentType", 5125}, {"byteOffset", 8}}},
                        {"values", {{"bufferView", 0}}}};
                }),
                HasSubstr("/accessors/0/sparse/indices: names element 1065353216 of 3"));
}

TEST(LoaderBadInput, AttributesThatDoNotFit) {
    EXPECT_THAT(refusal_after([](json& root) { root["accessors"][1]["count"] = 2; }),
                HasSubstr("/attributes/NORMAL: has 2 elements for 3 positions"));
    EXPECT_THAT(refusal_after([](json& root) { root["accessors"][0]["type"] = "VEC2"; }),
                HasSubstr("/accessors/0: is not of type VEC3"));
    EXPECT_THAT(refusal_after([](json& root) { root["meshes"][0]["primitives"][0]["attributes"].erase("POSITION"); }),
                HasSubstr("has no POSITION"));
    EXPECT_THAT(refusal_after([](json& root) { root["meshes"][0]["primitives"][0]["indices"] = 0; }),
                HasSubstr("/accessors/0: holds indices"));
}

TEST(LoaderBadInput, ReferencesThatLeadNowhere) {
    EXPECT_THAT(refusal_after([](json& root) { root["nodes"][0]["mesh"] = 1; }),
                HasSubstr("/nodes/0/mesh: is 1, but meshes has 1 elements"));
    EXPECT_THAT(refusal_after([](json& root) { root["nodes"][0]["mesh"] = -1; }), HasSubstr("/nodes/0/mesh"));
    EXPECT_THAT(refusal_after([](json& root) { root["nodes"][0]["mesh"] = "0"; }),
                HasSubstr("is \"0\" where an integer of at least 0 should be"));
    EXPECT_THAT(refusal_after([](json& root) { root["nodes"][0]["mesh"] = 0.5; }), HasSubstr("is 0.5 where"));
    EXPECT_THAT(refusal_after([](json& root) { root["meshes"][0]["primitives"][0]["material"] = 0; }),
                HasSubstr("materials has 0 elements"));
    EXPECT_THAT(refusal_after([](json& root) { root["scene"] = 3; }), HasSubstr("/scene: is 3"));
    EXPECT_THAT(refusal_after([](json& root) { root["scenes"][0]["nodes"] = {0, 9}; }), HasSubstr("/scenes/0/nodes/1"));
    EXPECT_THAT(refusal_after([](json& root) { root["accessors"][0]["componentType"] = 5124; }),
                HasSubstr("it can be one of: 5120"));
    EXPECT_THAT(refusal_after([](json& root) {
                    root["nodes"][0]["matrix"] = {1, 2, 3};
                }),
                HasSubstr("/nodes/0/matrix: has 3 numbers where 16 should be"));
    EXPECT_THAT(refusal_after([](json& root) {
                    root["nodes"][0]["scale"] = {1e39, 1, 1};
                }),
                HasSubstr("past the range of a float"));
    EXPECT_THAT(refusal_after([](json& root) {
                    root["nodes"][0]["rotation"] = {0, 0, 0, 0};
                }),
                HasSubstr("/nodes/0/rotation: has no length"));
}

TEST(LoaderBadInput, ARequiredExtensionThatIsNotSupported) {
    EXPECT_THAT(refusal_after([](json& root) { root["extensionsRequired"] = {"KHR_techniques_webgl"}; }),
                AllOf(HasSubstr("cannot be shown without KHR_techniques_webgl"), HasSubstr("export it without")));
}

TEST(LoaderBadInput, ASceneWithoutTriangles) {
    EXPECT_THAT(refusal_after([](json& root) { root["scenes"][0]["nodes"] = json::array(); }),
                HasSubstr("the scene has no triangles"));
    EXPECT_THAT(refusal_after([](json& root) { root["meshes"][0]["primitives"][0]["mode"] = 0; }),
                HasSubstr("the scene has no triangles"));
}

TEST(LoaderBadInput, LightsAndCamerasWithoutWhatTheyAre) {
    GltfFile spot = one_triangle();
    spot.root["extensions"]["KHR_lights_punctual"]["lights"] = json::parse(R"([{"type": "point"}, {"type": "spot"}])");
    EXPECT_THAT(refusal(spot), HasSubstr("/extensions/KHR_lights_punctual/lights/1/spot: is missing; export"));
    GltfFile camera = one_triangle();
    camera.root["cameras"] = json::parse(R"([{"type": "orthographic"}])");
    EXPECT_THAT(refusal(camera), HasSubstr("/cameras/0/orthographic: is missing; export"));
}

TEST(LoaderBadInput, LightsAndCamerasOutOfRange) {
    const auto with_light = [](const json& light) {
        return refusal_after([&](json& root) {
            root["extensions"]["KHR_lights_punctual"]["lights"] = {light};
            root["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
        });
    };
    EXPECT_THAT(with_light({{"type", "point"}, {"intensity", -1}}), HasSubstr("not a number of at least 0"));
    EXPECT_THAT(with_light({{"type", "spot"}, {"spot", {{"outerConeAngle", 3}}}}), HasSubstr("innerConeAngle"));
    EXPECT_THAT(with_light({{"type", "area"}}), HasSubstr("it can be one of: point spot directional"));
    EXPECT_THAT(refusal_after([](json& root) {
                    root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0}, {"znear", 0.1}}}}};
                    root["nodes"][0]["camera"] = 0;
                }),
                HasSubstr("/cameras/0/perspective/yfov: must be between 0 and pi"));
}

}  // namespace
}  // namespace render_system::testing::loader_bad_input_test
