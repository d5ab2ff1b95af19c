// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <meshoptimizer.h>

#include <cmath>

#include "tests/render_system/gltf_file.h"

namespace render_system::testing::loader_extensions_test {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string as_string(const std::vector<unsigned char>& bytes) { return {bytes.begin(), bytes.end()}; }

// A grid of n x n quads with points off the lattice, so that the packed form is no accident.
std::vector<glm::vec3> grid_points(int n) {
    std::vector<glm::vec3> points;
    for (int y = 0; y <= n; ++y) {
        for (int x = 0; x <= n; ++x)
            points.emplace_back(0.37f * x, 0.41f * y, std::sin(0.7f * static_cast<float>(x + y)));
    }
    return points;
}

std::vector<uint16_t> grid_corners(int n) {
    std::vector<uint16_t> corners;
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            const int a = y * (n + 1) + x, b = a + n + 1;
            for (int i : {a, a + 1, b, b, a + 1, b + 1}) corners.push_back(static_cast<uint16_t>(i));
        }
    }
    return corners;
}

std::string packed_vertices(const void* data, size_t count, size_t size) {
    std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(count, size));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), data, count, size));
    return as_string(bytes);
}

std::string packed_triangles(const std::vector<uint16_t>& corners, size_t vertices) {
    meshopt_encodeIndexVersion(1);
    const std::vector<unsigned> wide(corners.begin(), corners.end());
    std::vector<unsigned char> bytes(meshopt_encodeIndexBufferBound(wide.size(), vertices));
    bytes.resize(meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), wide.data(), wide.size()));
    return as_string(bytes);
}

std::string packed_sequence(const std::vector<uint16_t>& corners, size_t vertices) {
    meshopt_encodeIndexVersion(1);
    const std::vector<unsigned> wide(corners.begin(), corners.end());
    std::vector<unsigned char> bytes(meshopt_encodeIndexSequenceBound(wide.size(), vertices));
    bytes.resize(meshopt_encodeIndexSequence(bytes.data(), bytes.size(), wide.data(), wide.size()));
    return as_string(bytes);
}

// A view of what `bytes` unpack to; the plain bytes stand in buffer 1, which is not there.
int add_packed_view(GltfFile& file, const std::string& bytes, const std::string& mode, size_t count, size_t stride,
                    const std::string& filter = "NONE", const char* name = "EXT_meshopt_compression") {
    const int plain = file.add_view(bytes);
    json& view = file.root["bufferViews"][static_cast<size_t>(plain)];
    view["extensions"][name] = {{"buffer", 0},
                                {"byteOffset", view["byteOffset"]},
                                {"byteLength", bytes.size()},
                                {"byteStride", stride},
                                {"mode", mode},
                                {"count", count},
                                {"filter", filter}};
    view["buffer"] = 1;
    view["byteOffset"] = 0;
    view["byteLength"] = count * stride;
    return plain;
}

// The file as text, with the buffer that packed views stand for.
HostScene loaded_packed(const GltfFile& file) {
    GltfFile whole = file;
    json document = json::parse(file.text_embedded());
    document["buffers"].push_back({{"byteLength", 1 << 20}});
    document["extensionsRequired"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
    const TempFolder folder;
    write_file(folder / "packed.gltf", document.dump());
    Result<LoadedScene> result = load_scene(folder / "packed.gltf");
    EXPECT_TRUE(result.ok()) << result.status.message;
    if (!result.ok()) return HostScene();
    EXPECT_THAT(result->warnings, ElementsAre());
    return std::move(result->scene);
}

std::string refusal_packed(const GltfFile& file) {
    json document = json::parse(file.text_embedded());
    document["buffers"].push_back({{"byteLength", 1 << 20}});
    const TempFolder folder;
    write_file(folder / "packed.gltf", document.dump());
    return load_scene(folder / "packed.gltf").status.message;
}

TEST(LoaderMeshopt, UnpacksVerticesAndTriangles) {
    const auto points = grid_points(20);
    const auto corners = grid_corners(20);
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        GltfFile file;
        const int positions = add_packed_view(file, packed_vertices(points.data(), points.size(), 12), "ATTRIBUTES",
                                              points.size(), 12, "NONE", name);
        const int indices =
            add_packed_view(file, packed_triangles(corners, points.size()), "TRIANGLES", corners.size(), 2);
        file.add_mesh({{"attributes", {{"POSITION", file.add_accessor(positions, FLOAT, "VEC3", points.size())}}},
                       {"indices", file.add_accessor(indices, USHORT, "SCALAR", corners.size())}});
        file.add_node({{"mesh", 0}});
        const HostScene scene = loaded_packed(file);
        ASSERT_EQ(scene.triangle_count(), 800u);
        // The codec may turn a triangle's corners, but not the triangle; flat normals gave each corner its own vertex.
        const HostMesh& mesh = scene.meshes()[0];
        for (size_t i = 0; i < 800; ++i) {
            glm::vec3 sum(0.0f), wanted(0.0f);
            for (size_t c = 0; c < 3; ++c) {
                sum += mesh.positions[mesh.triangles[i][static_cast<int>(c)]];
                wanted += points[corners[3 * i + c]];
            }
            ASSERT_LT(glm::length(sum - wanted), 1e-5f) << i;
        }
    }
}

TEST(LoaderMeshopt, UnpacksSequencesOfIndices) {
    GltfFile file = one_triangle();
    const std::vector<uint16_t> strip{0, 1, 2, 0};
    const int view = add_packed_view(file, packed_sequence(strip, 3), "INDICES", strip.size(), 2);
    json& primitive = file.root["meshes"][0]["primitives"][0];
    primitive["mode"] = 5;
    primitive["indices"] = file.add_accessor(view, USHORT, "SCALAR", strip.size());
    const HostScene scene = loaded_packed(file);
    EXPECT_THAT(scene.meshes()[0].triangles, ElementsAre(glm::uvec4(0, 1, 2, 0), glm::uvec4(1, 0, 2, 0)));
}

TEST(LoaderMeshopt, AppliesTheFilters) {
    // A unit normal, turns by 90 degrees about z, and a position, each as its filter's encoder packs it.
    const float h = std::sqrt(0.5f);
    const std::vector<glm::vec4> normals(3, glm::vec4(0.6f, 0.0f, 0.8f, 0.0f));
    const std::vector<glm::vec4> turns{{0.0f, 0.0f, -h, h}, {0.0f, 0.0f, h, h}};
    const std::vector<glm::vec3> places{{0.1f, 0.2f, 0.3f}, {1.5f, 0.25f, -3.0f}, {7.0f, 100.0f, 0.5f}};
    std::vector<int8_t> oct(12);
    std::vector<int16_t> quat(8);
    std::vector<uint32_t> exp(9);
    meshopt_encodeFilterOct(oct.data(), 3, 4, 8, &normals[0].x);
    meshopt_encodeFilterQuat(quat.data(), 2, 8, 12, &turns[0].x);
    meshopt_encodeFilterExp(exp.data(), 3, 12, 16, &places[0].x);
    GltfFile file;
    const int positions = add_packed_view(file, packed_vertices(exp.data(), 3, 12), "ATTRIBUTES", 3, 12, "EXPONENTIAL");
    const int directions = add_packed_view(file, packed_vertices(oct.data(), 3, 4), "ATTRIBUTES", 3, 4, "OCTAHEDRAL");
    const int rotations = add_packed_view(file, packed_vertices(quat.data(), 2, 8), "ATTRIBUTES", 2, 8, "QUATERNION");
    file.root["bufferViews"][static_cast<size_t>(directions)]["byteStride"] = 4;
    file.add_mesh({{"attributes",
                    {{"POSITION", file.add_accessor(positions, FLOAT, "VEC3", 3)},
                     {"NORMAL", file.add_accessor(directions, BYTE, "VEC3", 3, true)}}}});
    const int turn = file.add_accessor(rotations, SHORT, "VEC4", 2, true);
    file.add_node({{"mesh", 0}, {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"ROTATION", turn}}}}}}}});
    const HostScene scene = loaded_packed(file);
    const HostMesh& mesh = scene.meshes()[0];
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_LT(glm::length(mesh.positions[i] - places[i]), 0.002f * glm::length(places[i]));
        EXPECT_LT(glm::length(mesh.normals[i] - glm::vec3(normals[i])), 0.02f);
    }
    ASSERT_EQ(scene.instances().size(), 2u);
    EXPECT_LT(glm::length(transform_point(scene.instances()[1].transform, {1, 2, 3}) - glm::vec3(-2, 1, 3)), 0.01f);
}

TEST(LoaderMeshopt, RefusesDamage) {
    const auto points = grid_points(8);
    const std::string good = packed_vertices(points.data(), points.size(), 12);
    const auto refused = [&](const std::string& bytes, size_t count, size_t stride, const std::string& filter) {
        GltfFile file = one_triangle();
        const int view = add_packed_view(file, bytes, "ATTRIBUTES", count, stride, filter);
        file.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
            file.add_accessor(view, FLOAT, "VEC3", count);
        return refusal_packed(file);
    };
    EXPECT_THAT(refused("", 81, 12, "NONE"), HasSubstr("has 0 bytes for 81 elements; it is cut off"));
    EXPECT_THAT(refused(good.substr(0, good.size() / 2), 81, 12, "NONE"), HasSubstr("its packed data are damaged"));
    EXPECT_THAT(refused(std::string(good.size(), '\0'), 81, 12, "NONE"), HasSubstr("its packed data are damaged"));
    EXPECT_THAT(refused(good, 1 << 30, 12, "NONE"), HasSubstr("bytes for 1073741824 elements"));
    EXPECT_THAT(refused(good, 81, 13, "NONE"), HasSubstr("a byteStride of 13 does not go with mode ATTRIBUTES"));
    GltfFile other = one_triangle();
    add_packed_view(other, good, "ATTRIBUTES", 81, 13, "NONE", "KHR_meshopt_compression");
    EXPECT_THAT(refusal_packed(other), HasSubstr("/extensions/KHR_meshopt_compression: a byteStride of 13"));
    EXPECT_THAT(refused(good, 81, 12, "QUATERNION"), HasSubstr("does not go with mode ATTRIBUTES and filter QUATERN"));
}

TEST(LoaderExtensions, LetsThroughWhatHasNoEffect) {
    GltfFile file = one_triangle();
    file.root["extensionsUsed"] = {"KHR_xmp_json_ld", "KHR_materials_variants", "EXT_mesh_features"};
    file.root["extensionsRequired"] = file.root["extensionsUsed"];
    EXPECT_EQ(loaded(file).triangle_count(), 1u);
}

TEST(LoaderExtensions, SaysWhatIsLeftOutAndWhatCannotBe) {
    struct LeftOut {
        std::string name, said, remedy;
    };
    const LeftOut rows[] = {
        {"KHR_materials_dispersion", "all colours are refracted alike; ",
         "export it with KHR_materials_ior and KHR_materials_volume alone, which refract"},
        {"KHR_materials_diffuse_transmission", "no light comes through; ",
         "export it with KHR_materials_transmission, which lets light through"},
        {"EXT_lights_ies", "such lights shine the same all round; ", "export them as spots of KHR_lights_punctual"},
        {"KHR_materials_of_tomorrow", "", "export it without"},
    };
    for (const LeftOut& row : rows) {
        GltfFile file = one_triangle();
        file.root["extensionsUsed"] = {"KHR_texture_transform", row.name};
        std::vector<std::string> warnings;
        loaded(file, &warnings);
        EXPECT_THAT(warnings, ElementsAre(HasSubstr("extension " + row.name + " (" + row.said + row.remedy + ")")));
        // What says itself that it is not the scene without is refused.
        file.root["extensionsRequired"] = file.root["extensionsUsed"];
        EXPECT_THAT(refusal(file), HasSubstr("/extensionsRequired/1: the file cannot be shown without " + row.name +
                                             ", which is not supported; " + row.remedy +
                                             ", or take it out of extensionsRequired to see the picture that is left"));
    }
    GltfFile file = one_triangle();
    file.root["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}};
    file.root["extensionsRequired"] = {"KHR_texture_basisu"};
    const std::string without_images = refusal(file);
    EXPECT_THAT(without_images, HasSubstr("without KHR_texture_basisu, which is not supported; export it with PNG"));
    EXPECT_THAT(without_images, Not(HasSubstr("take it out")));
    // With an image of another kind for every texture nothing is missing.
    file.root["images"] = {{{"uri", "x.png"}}};
    file.root["textures"][0]["source"] = 0;
    std::vector<std::string> warnings;
    EXPECT_EQ(loaded(file, &warnings).triangle_count(), 1u);
}

TEST(LoaderExtensions, ReadsWebpInPlaceOfTheOtherImage) {
    const TempFolder folder;
    const std::string image = folder / "a.webp";
    const auto output = OIIO::ImageOutput::create(image);
    ASSERT_TRUE(output);
    const OIIO::ImageSpec spec(2, 2, 3, OIIO::TypeDesc::UINT8);
    const std::vector<uint8_t> pixels(12, 200);
    ASSERT_TRUE(output->open(image, spec) && output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) &&
                output->close());
    GltfFile file = textured_triangle();
    const int texture = file.add_texture("fallback_that_is_not_there.png");
    file.root["images"].push_back({{"uri", "data:image/webp;base64," + base64(read_file(image))}});
    file.root["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 1;
    file.root["extensionsRequired"] = {"EXT_texture_webp"};
    file.add_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}}}}}});
    file.root["meshes"][0]["primitives"][0]["material"] = 0;
    const HostScene scene = loaded(file);
    ASSERT_EQ(scene.textures().size(), 1u);
    EXPECT_EQ(scene.textures()[0].width, 2u);
    EXPECT_NEAR(scene.textures()[0].texels[0] & 255u, 200.0, 2.0);  // the format loses some
}

GltfFile two_variants() {
    GltfFile file = one_triangle();
    for (float red : {0.1f, 0.5f, 0.9f}) {
        file.add_material({{"pbrMetallicRoughness", {{"baseColorFactor", {red, 0, 0, 1}}}}});
    }
    json& primitive = file.root["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    primitive["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 2}, {"variants", {1}}}};
    file.root["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "beach"}}, {{"name", "street"}}};
    return file;
}

TEST(LoaderExtensions, ShowsTheVariantAskedFor) {
    const TempFolder folder;
    write_file(folder / "scene.gltf", two_variants().text_embedded());
    const auto red_of = [&](const std::string& variant) {
        const auto result = load_scene(folder / "scene.gltf", {.variant = variant});
        EXPECT_TRUE(result.ok()) << result.status.message;
        const HostScene& scene = result->scene;
        return scene.materials()[scene.meshes()[0].triangles[0].w].core.base_color.x;
    };
    EXPECT_EQ(red_of(""), 0.1f);
    EXPECT_EQ(red_of("beach"), 0.1f);  // nothing mapped
    EXPECT_EQ(red_of("street"), 0.9f);
    EXPECT_THAT(load_scene(folder / "scene.gltf", {.variant = "Street"}).status.message,
                HasSubstr("--variant: there is no variant \"Street\"; there are \"beach\", \"street\""));
}

TEST(LoaderExtensions, RefusesVariantsThatAreNotThere) {
    const TempFolder folder;
    write_file(folder / "scene.gltf", one_triangle().text_embedded());
    EXPECT_THAT(load_scene(folder / "scene.gltf", {.variant = "x"}).status.message,
                HasSubstr("--variant: the file has no variants; leave the option out"));
    GltfFile file = two_variants();
    file.root["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"][0]["variants"] = {2};
    EXPECT_THAT(refusal(file), HasSubstr("/mappings/0/variants/0: is 2, but"));
}

TEST(LoaderExtensions, PlacesInstancesBelowTheirNode) {
    GltfFile file = one_triangle();
    const int moves = file.add(std::vector<glm::vec3>{{1, 0, 0}, {0, 5, 0}});
    const int sizes = file.add(std::vector<glm::vec3>{{1, 1, 1}, {2, 3, 4}});
    json& node = file.root["nodes"][0];
    node["translation"] = {0, 0, 10};
    node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", moves}, {"SCALE", sizes}};
    // A view that reaches out of its buffer does no harm where nobody reads it.
    const int ids = file.add(std::vector<uint16_t>{7, 8});
    file.root["bufferViews"].back()["byteLength"] = 1000;
    node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["_ID"] = ids;
    const HostScene scene = loaded(file);
    ASSERT_EQ(scene.instances().size(), 2u);
    EXPECT_EQ(transform_point(scene.instances()[0].transform, {1, 1, 1}), glm::vec3(2, 1, 11));
    EXPECT_EQ(transform_point(scene.instances()[1].transform, {1, 1, 1}), glm::vec3(2, 8, 14));
    node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] = file.add(std::vector<glm::vec3>{{1, 1, 1}});
    EXPECT_THAT(refusal(file), HasSubstr("attributes: differ in their numbers of elements"));
}

TEST(LoaderExtensions, BoundsTheNumberOfInstances) {
    GltfFile file = one_triangle();
    const int many = file.add_accessor(-1, FLOAT, "VEC3", 1 << 20);  // zeros, which cost the file nothing
    file.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", many}};
    std::vector<std::string> warnings;
    EXPECT_EQ(loaded(file, &warnings).triangle_count(), 1u);  // all in one place
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("instances in the place of another (/nodes/0)")));
    file.add_node(file.root["nodes"][0]);
    EXPECT_THAT(refusal(file), HasSubstr("makes 2097152 instances; 1048576 are the most, split the scene"));
}

TEST(LoaderExtensions, AnImageBasedLightIsTheSky) {
    // Six faces of one texel: face i has 40 i in red and 255 in green; the last, -z, an alpha of 128 (RGBD). All four
    // columns of a sky so small look up or down by 45 degrees.
    const TempFolder folder;
    json document = json::parse(read_file(FORMATS "/image_light.gltf"));
    const auto sky_turned = [&](const json& rotation) {
        document["extensions"]["EXT_lights_image_based"]["lights"][0]["rotation"] = rotation;
        write_file(folder / "a.gltf", document.dump());
        auto result = load_scene(folder / "a.gltf");
        EXPECT_TRUE(result.ok()) << result.status.message;
        return result->scene.sky();
    };
    const auto expect_rows = [](const Sky& sky, const glm::vec2& upper, const glm::vec2& lower) {
        ASSERT_EQ(sky.texels.size(), 8u);
        for (size_t i = 0; i < 8; ++i) {
            EXPECT_NEAR(sky.texels[i].x, i < 4 ? upper.x : lower.x, 1e-4f) << i;
            EXPECT_NEAR(sky.texels[i].y, i < 4 ? upper.y : lower.y, 1e-4f) << i;
        }
    };
    const auto linear = [](float red) { return std::pow((red / 255.0f + 0.055f) / 1.055f, 2.4f); };
    expect_rows(sky_turned({0, 0, 0, 1}), {2 * linear(80), 2}, {2 * linear(120), 2});
    // A quarter turn about x takes -z up and z down.
    const float h = std::sqrt(0.5f), more = 255.0f / 128.0f;
    expect_rows(sky_turned({h, 0, 0, h}), {2 * more * linear(200), 2 * more}, {2 * linear(160), 2});
}

TEST(LoaderExtensions, HidesNodesThatAreNotVisible) {
    GltfFile file = one_triangle();
    file.add_node({{"mesh", 0}});
    file.root["nodes"][1]["children"] = {2};
    file.root["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = false;
    file.root["nodes"].push_back({{"mesh", 0}});
    EXPECT_EQ(loaded(file).triangle_count(), 1u);
}

const CoreMaterial& first_material(const HostScene& scene) { return scene.materials()[0].core; }

TEST(LoaderExtensions, UnlitSurfacesGiveOffTheirColourAndReflectNothing) {
    GltfFile file = textured_triangle();
    const int texture = file.add_texture(png_uri(1, 1, 3, {255, 0, 0}));
    file.add_material(
        {{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 1, 1}}, {"baseColorTexture", {{"index", texture}}}}},
         {"emissiveFactor", {1, 1, 1}},
         {"extensions", {{"KHR_materials_unlit", json::object()}}}});
    file.root["meshes"][0]["primitives"][0]["material"] = 0;
    const HostScene scene = loaded(file);
    const CoreMaterial& material = first_material(scene);
    EXPECT_EQ(material.emission, glm::vec3(0.5f, 0.25f, 1.0f));
    EXPECT_NE(material.emission_texture.texture, NONE);
    EXPECT_EQ(material.base_color, glm::vec3(0.0f));
    EXPECT_EQ(material.specular, 0.0f);
    EXPECT_EQ(material.metallic, 0.0f);
    EXPECT_EQ(material.base_color_texture.texture, NONE);
    EXPECT_TRUE(scene.is_emissive(0));
}

TEST(LoaderExtensions, ConvertsSpecularGlossiness) {
    GltfFile file = textured_triangle();
    const int texture = file.add_texture(png_uri(1, 1, 4, {128, 64, 32, 51}));
    const json glossy = {{"diffuseFactor", {0.5, 0.25, 0.125, 0.75}},
                         {"specularFactor", {1, 0.75, 0.5}},
                         {"glossinessFactor", 0.5},
                         {"specularGlossinessTexture", {{"index", texture}}}};
    file.add_material({{"alphaMode", "BLEND"},
                       {"pbrMetallicRoughness", {{"metallicFactor", 1}}},
                       {"extensions", {{"KHR_materials_pbrSpecularGlossiness", glossy}}}});
    file.root["meshes"][0]["primitives"][0]["material"] = 0;
    const HostScene scene = loaded(file);
    const CoreMaterial& material = first_material(scene);
    EXPECT_EQ(material.base_color, glm::vec3(0.5f, 0.25f, 0.125f));
    EXPECT_EQ(material.alpha, 0.75f);
    EXPECT_EQ(material.specular_color, glm::vec3(1.0f, 0.75f, 0.5f));
    EXPECT_EQ(material.metallic, 0.0f);
    EXPECT_EQ(material.ior, 0.0f);
    EXPECT_EQ(material.roughness, 1.0f);
    ASSERT_EQ(scene.textures().size(), 2u);
    // Roughness in green: 1 - 0.5 * 51 / 255 = 0.9; the colour stays as it is.
    EXPECT_EQ(scene.textures()[material.metallic_roughness_texture.texture].texels[0] >> 8 & 255u, 230u);
    EXPECT_EQ(scene.textures()[material.specular_color_texture.texture].texels[0] & 0xFFFFFFu, 0x204080u);
}

TEST(LoaderExtensions, ReadsWhicheverFourUvSetsAMaterialNames) {
    GltfFile file = one_triangle();
    json& primitive = file.root["meshes"][0]["primitives"][0];
    for (int i = 0; i < 6; ++i) {
        const float f = static_cast<float>(i);
        primitive["attributes"]["TEXCOORD_" + std::to_string(i)] =
            file.add(std::vector<glm::vec2>{{f, 0.0f}, {f, 0.5f}, {f, 1.0f}});
    }
    primitive["material"] = 0;
    const int texture = file.add_texture(png_uri(1, 1, 3, {9, 9, 9}));
    file.add_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}, {"texCoord", 3}}}}},
                       {"normalTexture", {{"index", texture}, {"texCoord", 2}}}});
    const HostScene scene = loaded(file);
    const CoreMaterial& material = first_material(scene);
    const HostMesh& mesh = scene.meshes()[0];
    const auto u_read_by = [&](const CoreTextureSlot& slot) { return mesh.uv(slot.uv_set)[1].x; };
    EXPECT_EQ(u_read_by(material.base_color_texture), 3.0f);
    EXPECT_EQ(u_read_by(material.normal_texture), 2.0f);
    EXPECT_TRUE(mesh.uv2.empty() && mesh.uv3.empty());
    // Five: the fifth is left out.
    const auto info = [texture](int set) { return json{{"index", texture}, {"texCoord", set}}; };
    file.root["materials"][0]["extensions"] = {
        {"KHR_materials_clearcoat",
         {{"clearcoatFactor", 1}, {"clearcoatTexture", info(4)}, {"clearcoatRoughnessTexture", info(1)}}}};
    const HostScene four = loaded(file);
    const CoreMaterial& coated = first_material(four);
    const auto u_of_four = [&](const CoreTextureSlot& slot) { return four.meshes()[0].uv(slot.uv_set)[1].x; };
    EXPECT_EQ(u_of_four(coated.base_color_texture), 3.0f);
    EXPECT_EQ(u_of_four(coated.normal_texture), 2.0f);
    EXPECT_EQ(u_of_four(coated.coat_texture), 4.0f);
    EXPECT_EQ(u_of_four(coated.coat_roughness_texture), 1.0f);
    file.root["materials"][0]["emissiveFactor"] = {1, 1, 1};
    file.root["materials"][0]["emissiveTexture"] = info(5);
    std::vector<std::string> warnings;
    loaded(file, &warnings);
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("a fifth uv set in one material (/materials/0)")));
    file.root["materials"][0].erase("emissiveTexture");
    file.root["materials"][0].erase("extensions");
    // The only one there is, and it is the third.
    file.root["materials"][0].erase("normalTexture");
    const HostScene single = loaded(file);
    EXPECT_EQ(first_material(single).base_color_texture.uv_set, 0u);
    EXPECT_EQ(single.meshes()[0].uv0[1].x, 3.0f);
}

}  // namespace
}  // namespace render_system::testing::loader_extensions_test
