// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <map>
#include <random>

#include "render_system/core_checks.h"
#include "tests/render_system/gltf_file.h"

namespace render_system::testing::loader_geometry_test {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::vector<glm::vec3> SQUARE = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

glm::vec3 face_normal(const HostMesh& mesh, size_t triangle) {
    const glm::uvec4 t = mesh.triangles[triangle];
    return glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
}

// A mesh of one primitive with that position accessor, normals left out.
HostMesh mesh_of(GltfFile& file, const json& primitive) {
    file.add_mesh(primitive);
    file.add_node({{"mesh", 0}});
    const HostScene scene = loaded(file);
    EXPECT_EQ(scene.meshes().size(), 1u);
    if (scene.meshes().empty()) return HostMesh();
    EXPECT_TRUE(validate_mesh(scene.meshes()[0].view()).ok());
    return scene.meshes()[0];
}

template <class T>
std::vector<T> flattened(const std::vector<std::vector<T>>& rows) {
    std::vector<T> all;
    for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
    return all;
}

TEST(LoaderGeometry, ReadsAnIndexedTriangleAsItIs) {
    GltfFile file;
    const int positions = file.add(SQUARE);
    const int normals = file.add(std::vector<glm::vec3>(4, glm::vec3(0, 0, 1)));
    const int indices = file.add(std::vector<uint16_t>{0, 1, 2, 0, 2, 3});
    const HostMesh mesh =
        mesh_of(file, {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}, {"indices", indices}});
    EXPECT_EQ(mesh.positions, SQUARE);
    EXPECT_THAT(mesh.triangles, ElementsAre(glm::uvec4(0, 1, 2, 0), glm::uvec4(0, 2, 3, 0)));
    EXPECT_TRUE(mesh.tangents.empty());
    EXPECT_TRUE(mesh.uv0.empty());
    EXPECT_TRUE(mesh.colors.empty());
}

TEST(LoaderGeometry, ReadsIndicesOfEveryWidth) {
    for (int component : {UBYTE, USHORT, UINT}) {
        GltfFile file;
        const int positions = file.add(SQUARE);
        int view = 0;
        if (component == UBYTE) view = file.add_view(std::vector<uint8_t>{1, 2, 3});
        if (component == USHORT) view = file.add_view(std::vector<uint16_t>{1, 2, 3});
        if (component == UINT) view = file.add_view(std::vector<uint32_t>{1, 2, 3});
        const int indices = file.add_accessor(view, component, "SCALAR", 3);
        const HostMesh mesh = mesh_of(file, {{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
        EXPECT_THAT(mesh.positions, ElementsAre(SQUARE[1], SQUARE[2], SQUARE[3])) << component;
    }
}

TEST(LoaderGeometry, MakesFlatNormalsWithVerticesOfTheirOwn) {
    GltfFile file;
    const int positions = file.add(std::vector<glm::vec3>{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}});
    const int indices = file.add(std::vector<uint16_t>{0, 1, 2, 0, 2, 3});
    const HostMesh mesh = mesh_of(file, {{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    ASSERT_EQ(mesh.positions.size(), 6u);
    ASSERT_EQ(mesh.normals.size(), 6u);
    for (size_t i = 0; i < 3; ++i) EXPECT_EQ(mesh.normals[i], glm::vec3(0, 0, 1));
    for (size_t i = 3; i < 6; ++i) EXPECT_EQ(mesh.normals[i], glm::vec3(1, 0, 0));
}

TEST(LoaderGeometry, GivesADegenerateTriangleSomeUnitNormal) {
    GltfFile file;
    const int positions = file.add(std::vector<glm::vec3>(3, glm::vec3(1, 2, 3)));
    const HostMesh mesh = mesh_of(file, {{"attributes", {{"POSITION", positions}}}});
    for (const glm::vec3& normal : mesh.normals) EXPECT_FLOAT_EQ(glm::length(normal), 1.0f);
}

TEST(LoaderGeometry, TurnsStripsAndFansIntoTrianglesThatAllWindAlike) {
    // A strip zigzags, a fan goes round: both cover the square, front to +z.
    const std::vector<glm::vec3> zigzag = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}};
    for (int mode : {5, 6}) {
        GltfFile file;
        const int positions = file.add(mode == 5 ? zigzag : SQUARE);
        const HostMesh mesh = mesh_of(file, {{"attributes", {{"POSITION", positions}}}, {"mode", mode}});
        ASSERT_EQ(mesh.triangles.size(), mode == 5 ? 3u : 2u);
        for (size_t i = 0; i < mesh.triangles.size(); ++i) {
            EXPECT_EQ(face_normal(mesh, i), glm::vec3(0, 0, 1)) << "mode " << mode << ", triangle " << i;
        }
    }
}

TEST(LoaderGeometry, StripsAndFansMayBeIndexed) {
    GltfFile file;
    const int positions = file.add(SQUARE);
    const int normals = file.add(std::vector<glm::vec3>(4, glm::vec3(0, 0, 1)));
    const int indices = file.add(std::vector<uint16_t>{3, 0, 1, 2});
    const HostMesh mesh = mesh_of(
        file, {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}, {"indices", indices}, {"mode", 6}});
    EXPECT_THAT(mesh.triangles, ElementsAre(glm::uvec4(0, 1, 3, 0), glm::uvec4(1, 2, 3, 0)));
}

TEST(LoaderGeometry, ReadsInterleavedVerticesByTheirStride) {
    GltfFile file;
    const std::vector<float> interleaved = flattened<float>({
        {0, 0, 0, /**/ 0, 0, 1, /**/ 0.25f, 0.5f},
        {1, 0, 0, /**/ 0, 1, 0, /**/ 0.75f, 0.5f},
        {0, 1, 0, /**/ 1, 0, 0, /**/ 0.25f, 1.0f},
    });
    const int view = file.add_view(interleaved, 32);
    const int positions = file.add_accessor(view, FLOAT, "VEC3", 3);
    const int normals = file.add_accessor(view, FLOAT, "VEC3", 3);
    const int uvs = file.add_accessor(view, FLOAT, "VEC2", 3);
    file.root["accessors"][static_cast<size_t>(normals)]["byteOffset"] = 12;
    file.root["accessors"][static_cast<size_t>(uvs)]["byteOffset"] = 24;
    const HostMesh mesh =
        mesh_of(file, {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}}}});
    EXPECT_THAT(mesh.positions, ElementsAre(glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)));
    EXPECT_THAT(mesh.normals, ElementsAre(glm::vec3(0, 0, 1), glm::vec3(0, 1, 0), glm::vec3(1, 0, 0)));
    EXPECT_THAT(mesh.uv0, ElementsAre(glm::vec2(0.25f, 0.5f), glm::vec2(0.75f, 0.5f), glm::vec2(0.25f, 1.0f)));
}

// glTF 2.0, table of 3.6.2.2, worked by hand for the ends of each range.
template <class T>
HostMesh with_uv(int component, const std::vector<T>& values, bool normalized) {
    GltfFile file;
    const int positions = file.add(std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int uvs = file.add_accessor(file.add_view(values), component, "VEC2", 3, normalized);
    return mesh_of(file, {{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}}});
}

TEST(LoaderGeometry, MapsNormalizedIntegersToTheirRange) {
    EXPECT_THAT(with_uv<uint8_t>(UBYTE, {0, 255, 51, 0, 0, 0}, true).uv0,
                ElementsAre(glm::vec2(0, 1), glm::vec2(51.0f / 255.0f, 0), glm::vec2(0)));
    EXPECT_THAT(with_uv<int8_t>(BYTE, {-128, 127, -127, 0, 64, 0}, true).uv0,
                ElementsAre(glm::vec2(-1, 1), glm::vec2(-1, 0), glm::vec2(64.0f / 127.0f, 0)));
    EXPECT_THAT(with_uv<uint16_t>(USHORT, {0, 65535, 13107, 0, 0, 0}, true).uv0,
                ElementsAre(glm::vec2(0, 1), glm::vec2(0.2f, 0), glm::vec2(0)));
    EXPECT_THAT(with_uv<int16_t>(SHORT, {-32768, 32767, -32767, 0, 0, 0}, true).uv0,
                ElementsAre(glm::vec2(-1, 1), glm::vec2(-1, 0), glm::vec2(0)));
}

TEST(LoaderGeometry, ReadsIntegersThatAreNotNormalizedAsNumbers) {
    EXPECT_THAT(with_uv<uint8_t>(UBYTE, {0, 255, 2, 0, 0, 0}, false).uv0,
                ElementsAre(glm::vec2(0, 255), glm::vec2(2, 0), glm::vec2(0)));
    EXPECT_THAT(with_uv<int8_t>(BYTE, {-128, 127, 1, 0, 0, 0}, false).uv0,
                ElementsAre(glm::vec2(-128, 127), glm::vec2(1, 0), glm::vec2(0)));
    EXPECT_THAT(with_uv<int16_t>(SHORT, {-32768, 32767, 0, 0, 0, 0}, false).uv0,
                ElementsAre(glm::vec2(-32768, 32767), glm::vec2(0), glm::vec2(0)));
    EXPECT_THAT(with_uv<uint16_t>(USHORT, {65535, 0, 0, 0, 0, 0}, false).uv0,
                ElementsAre(glm::vec2(65535, 0), glm::vec2(0), glm::vec2(0)));
    EXPECT_THAT(with_uv<uint32_t>(UINT, {70000, 0, 0, 0, 0, 0}, false).uv0,
                ElementsAre(glm::vec2(70000, 0), glm::vec2(0), glm::vec2(0)));
}

TEST(LoaderGeometry, ReadsQuantizedPositions) {
    GltfFile file;
    file.root["extensionsUsed"] = {"KHR_mesh_quantization"};
    file.root["extensionsRequired"] = {"KHR_mesh_quantization"};
    const std::vector<int16_t> corners = {0, 0, 0, 0, 100, 0, 0, 0, 0, -200, 0, 0};  // padded to 8 bytes a vertex
    const int positions = file.add_accessor(file.add_view(corners, 8), SHORT, "VEC3", 3);
    const HostMesh mesh = mesh_of(file, {{"attributes", {{"POSITION", positions}}}});
    EXPECT_THAT(mesh.positions, ElementsAre(glm::vec3(0), glm::vec3(100, 0, 0), glm::vec3(0, -200, 0)));
}

TEST(LoaderGeometry, OverlaysSparseValues) {
    GltfFile file;
    const int positions = file.add(SQUARE);
    const int where = file.add_view(std::vector<uint8_t>{1, 3});
    const int what = file.add_view(std::vector<glm::vec3>{{7, 0, 0}, {0, 9, 0}});
    file.root["accessors"][static_cast<size_t>(positions)]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", where}, {"componentType", UBYTE}}},
        {"values", {{"bufferView", what}}}};
    const int normals = file.add(std::vector<glm::vec3>(4, glm::vec3(0, 0, 1)));
    const int indices = file.add(std::vector<uint16_t>{0, 1, 3});
    const HostMesh mesh =
        mesh_of(file, {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}, {"indices", indices}});
    EXPECT_THAT(mesh.positions, ElementsAre(SQUARE[0], glm::vec3(7, 0, 0), SQUARE[2], glm::vec3(0, 9, 0)));
}

TEST(LoaderGeometry, SparseValuesMayStandAloneOverZeros) {
    GltfFile file;
    const int positions = file.add_accessor(-1, FLOAT, "VEC3", 3);
    const int where = file.add_view(std::vector<uint16_t>{1, 2});
    const int what = file.add_view(std::vector<glm::vec3>{{1, 0, 0}, {0, 1, 0}});
    file.root["accessors"][static_cast<size_t>(positions)]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", where}, {"componentType", USHORT}}},
        {"values", {{"bufferView", what}}}};
    // Indices too: 0 0 0, overlaid with 1 and 2.
    const int indices = file.add_accessor(-1, UINT, "SCALAR", 3);
    const int values = file.add_view(std::vector<uint32_t>{1, 2});
    file.root["accessors"][static_cast<size_t>(indices)]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", where}, {"componentType", USHORT}}},
        {"values", {{"bufferView", values}}}};
    const HostMesh mesh = mesh_of(file, {{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    EXPECT_THAT(mesh.positions, ElementsAre(glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)));
}

TEST(LoaderGeometry, PutsAllPrimitivesOfAMeshIntoOneWithTheirMaterials) {
    GltfFile file;
    const int positions = file.add(std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int normals = file.add(std::vector<glm::vec3>(3, glm::vec3(0, 0, 1)));
    const int uvs = file.add(std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}});
    file.add_material({{"name", "first"}});
    file.add_material({{"name", "second"}});
    const json plain = {{"POSITION", positions}, {"NORMAL", normals}};
    const json with_uvs = {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}};
    const json flat = {{"POSITION", positions}};
    file.root["meshes"].push_back({{"primitives",
                                    {{{"attributes", plain}, {"material", 1}},
                                     {{"attributes", with_uvs}, {"material", 0}},
                                     {{"attributes", flat}}}}});
    file.add_node({{"mesh", 0}});
    const HostScene scene = loaded(file);
    ASSERT_EQ(scene.meshes().size(), 1u);
    const HostMesh& mesh = scene.meshes()[0];
    EXPECT_THAT(mesh.triangles, ElementsAre(glm::uvec4(0, 1, 2, 1), glm::uvec4(3, 4, 5, 0), glm::uvec4(6, 7, 8, 2)));
    EXPECT_TRUE(validate_mesh(mesh.view()).ok());
    ASSERT_EQ(mesh.uv0.size(), 9u);
    EXPECT_EQ(mesh.uv0[1], glm::vec2(0));
    EXPECT_EQ(mesh.uv0[4], glm::vec2(1, 0));
    EXPECT_EQ(mesh.uv0[7], glm::vec2(0));
    ASSERT_EQ(scene.materials().size(), 3u);
    EXPECT_EQ(scene.materials()[2].name, "default");
    EXPECT_EQ(scene.materials()[2].core.base_color, glm::vec3(1));
    EXPECT_EQ(scene.materials()[2].core.metallic, 1.0f);
    EXPECT_EQ(scene.materials()[2].core.roughness, 1.0f);
}

TEST(LoaderGeometry, ReadsColoursInFullDepth) {
    GltfFile file;
    const int positions = file.add(std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int rgb = file.add(std::vector<glm::vec3>{{1, 0, 0}, {0, 0.001f, 0}, {0, 0, 2.0f}});
    const HostMesh mesh = mesh_of(file, {{"attributes", {{"POSITION", positions}, {"COLOR_0", rgb}}}});
    EXPECT_THAT(mesh.colors, ElementsAre(glm::vec4(1, 0, 0, 1), glm::vec4(0, 0.001f, 0, 1), glm::vec4(0, 0, 1, 1)));

    GltfFile bytes;
    const int corners = bytes.add(std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const std::vector<uint8_t> values = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    const int rgba = bytes.add_accessor(bytes.add_view(values), UBYTE, "VEC4", 3, true);
    const HostMesh exact = mesh_of(bytes, {{"attributes", {{"POSITION", corners}, {"COLOR_0", rgba}}}});
    const auto shares = [](float r, float g, float b, float a) { return glm::vec4(r, g, b, a) / 255.0f; };
    EXPECT_THAT(exact.colors, ElementsAre(shares(1, 2, 3, 4), shares(5, 6, 7, 8), shares(9, 10, 11, 12)));
}

TEST(LoaderGeometry, ReadsTwoUvSetsAndPassesOverAThirdThatNobodyReads) {
    GltfFile file;
    const int positions = file.add(std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int first = file.add(std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}});
    const int second = file.add(std::vector<glm::vec2>{{0, 0}, {0.5f, 0}, {0, 0.5f}});
    file.add_mesh({{"attributes",
                    {{"POSITION", positions}, {"TEXCOORD_0", first}, {"TEXCOORD_1", second}, {"TEXCOORD_2", first}}}});
    file.add_node({{"mesh", 0}});
    const HostScene scene = loaded(file);
    EXPECT_EQ(scene.meshes()[0].uv0[1], glm::vec2(1, 0));
    EXPECT_EQ(scene.meshes()[0].uv1[1], glm::vec2(0.5f, 0));
}

TEST(LoaderGeometry, MakesNormalsAnewWhereTheyHaveNoLength) {
    GltfFile file;
    const int positions = file.add(std::vector<glm::vec3>{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}});
    const int normals = file.add(std::vector<glm::vec3>{{0, 0, 0}, {0, 5, 0}, {0, 1, 0}});
    file.add_mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}});
    file.add_node({{"mesh", 0}});
    std::vector<std::string> warnings;
    const HostScene scene = loaded(file, &warnings);
    for (const glm::vec3& normal : scene.meshes()[0].normals) EXPECT_EQ(normal, glm::vec3(0, 1, 0));
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("normals of no length")));
}

// A unit square seen from +z with u to the right and v downwards, as a picture hangs.
GltfFile normal_mapped_square(const std::vector<glm::vec2>& uv, const json& texture_info = json::object()) {
    GltfFile file;
    const int positions = file.add(SQUARE);
    const int normals = file.add(std::vector<glm::vec3>(4, glm::vec3(0, 0, 1)));
    const int uvs = file.add(uv);
    const int indices = file.add(std::vector<uint16_t>{0, 1, 2, 0, 2, 3});
    json info = texture_info;
    info["index"] = file.add_texture(png_uri(1, 1, 3, {128, 128, 255}));
    file.add_material({{"normalTexture", info}});
    file.add_mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}}},
                   {"indices", indices},
                   {"material", 0}});
    file.add_node({{"mesh", 0}});
    return file;
}

TEST(LoaderGeometry, MakesTangentsWhereANormalMapNeedsThem) {
    const HostScene upright = loaded(normal_mapped_square({{0, 1}, {1, 1}, {1, 0}, {0, 0}}));
    ASSERT_EQ(upright.meshes()[0].tangents.size(), 4u);
    // The bitangent, cross(normal, tangent) * w, points up in the picture, to smaller v.
    for (const glm::vec4& t : upright.meshes()[0].tangents) EXPECT_EQ(t, glm::vec4(1, 0, 0, 1));

    const HostScene mirrored = loaded(normal_mapped_square({{1, 1}, {0, 1}, {0, 0}, {1, 0}}));
    for (const glm::vec4& t : mirrored.meshes()[0].tangents) EXPECT_EQ(t, glm::vec4(-1, 0, 0, -1));

    const HostScene turned = loaded(normal_mapped_square({{1, 1}, {1, 0}, {0, 0}, {0, 1}}));
    for (const glm::vec4& t : turned.meshes()[0].tangents) EXPECT_EQ(t, glm::vec4(0, -1, 0, 1));
}

TEST(LoaderGeometry, TangentsFollowTheTexturesTransform) {
    const json transform = {{"extensions", {{"KHR_texture_transform", {{"scale", {-1, 1}}}}}}};
    const HostScene scene = loaded(normal_mapped_square({{0, 1}, {1, 1}, {1, 0}, {0, 0}}, transform));
    for (const glm::vec4& t : scene.meshes()[0].tangents) EXPECT_EQ(t, glm::vec4(-1, 0, 0, -1));
}

TEST(LoaderGeometry, SplitsVerticesThatMirroredTrianglesShare) {
    // The second triangle runs back in u: the two share an edge but not a handedness.
    const HostScene scene = loaded(normal_mapped_square({{0, 1}, {1, 1}, {1, 0}, {1.5f, 0}}));
    const HostMesh& mesh = scene.meshes()[0];
    ASSERT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.positions.size(), 6u);
    EXPECT_TRUE(validate_mesh(mesh.view()).ok());
    for (const glm::uvec4& t : mesh.triangles) {
        EXPECT_EQ(mesh.tangents[t.x].w, mesh.tangents[t.y].w);
        EXPECT_EQ(mesh.tangents[t.x].w, mesh.tangents[t.z].w);
    }
    EXPECT_NE(mesh.tangents[mesh.triangles[0].x].w, mesh.tangents[mesh.triangles[1].x].w);
}

// Facets that share no vertex, on a few points: the tangents are those of the same mesh with its vertices joined, here
// added up in double precision from Mikkelsen's definition.
TEST(LoaderGeometry, FacetsShareTheTangentsOfTheirPoints) {
    std::mt19937 random(5);
    const auto pick = [&random](uint32_t count) { return static_cast<float>(random() % count); };
    std::vector<glm::vec3> positions;
    std::vector<glm::vec2> uvs;
    while (positions.size() < 3 * 200) {
        const glm::vec3 corners[3] = {{pick(3), pick(3), 0.0f}, {pick(3), pick(3), 0.0f}, {pick(3), pick(3), 0.0f}};
        if (glm::cross(corners[1] - corners[0], corners[2] - corners[0]).z == 0.0f) continue;
        for (const glm::vec3& corner : corners) {
            positions.push_back(corner);
            uvs.emplace_back(pick(2), pick(3));
        }
    }
    GltfFile file;
    const int position = file.add(positions), uv = file.add(uvs);
    const int normal = file.add(std::vector<glm::vec3>(positions.size(), glm::vec3(0, 0, 1)));
    file.add_material({{"normalTexture", {{"index", file.add_texture(png_uri(1, 1, 3, {128, 128, 255}))}}}});
    file.add_mesh({{"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", uv}}}, {"material", 0}});
    file.add_node({{"mesh", 0}});
    const HostScene scene = loaded(file);
    const HostMesh& mesh = scene.meshes()[0];
    ASSERT_EQ(mesh.positions.size(), positions.size());

    using Point = std::array<float, 5>;  // x, y, u, v, handedness
    std::map<Point, glm::dvec2> sums;
    std::vector<Point> points;
    for (size_t i = 0; i < positions.size(); ++i) {
        const size_t first = i - i % 3, j = first + (i + 1) % 3, k = first + (i + 2) % 3;
        const glm::dvec2 e1(positions[j] - positions[i]), e2(positions[k] - positions[i]);
        const glm::dvec2 d1(uvs[j] - uvs[i]), d2(uvs[k] - uvs[i]);
        const double area = d1.x * d2.y - d1.y * d2.x;
        const float handedness = area > 0.0 ? -1.0f : 1.0f;
        points.push_back({positions[i].x, positions[i].y, uvs[i].x, uvs[i].y, handedness});
        const glm::dvec2 growing = (e1 * d2.y - e2 * d1.y) * (area > 0.0 ? 1.0 : -1.0);
        if (area == 0.0) continue;
        const double angle = std::acos(glm::dot(glm::normalize(e1), glm::normalize(e2)));
        sums[points.back()] += glm::normalize(growing) * angle;
    }
    int told = 0;
    for (size_t i = 0; i < positions.size(); ++i) {
        const glm::vec4& tangent = mesh.tangents[i];
        EXPECT_EQ(tangent.w, points[i][4]);
        EXPECT_NEAR(glm::length(glm::vec3(tangent)), 1.0f, 1e-5f);
        const auto sum = sums.find(points[i]);
        if (sum == sums.end() || glm::length(sum->second) < 1e-3) continue;
        EXPECT_LT(glm::length(glm::dvec2(tangent) - glm::normalize(sum->second)), 1e-3) << i;
        ++told;
    }
    EXPECT_GT(told, 300);
    EXPECT_GT(told, 2 * static_cast<int>(sums.size()));  // most are shared
}

TEST(LoaderGeometry, TangentsWithoutUvsAreStillPerpendicularUnits) {
    const HostScene scene = loaded(normal_mapped_square({{0, 0}, {0, 0}, {0, 0}, {0, 0}}));
    for (const glm::vec4& t : scene.meshes()[0].tangents) {
        EXPECT_NEAR(glm::length(glm::vec3(t)), 1.0f, 1e-6f);
        EXPECT_NEAR(t.z, 0.0f, 1e-6f);
    }
}

TEST(LoaderGeometry, TakesTangentsFromTheFile) {
    GltfFile file = one_triangle();
    const int tangents = file.add(std::vector<glm::vec4>{{0, 2, 0, -1}, {1, 0, 0, 1}, {0, 0, 0, 1}});
    file.root["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] = tangents;
    const HostScene scene = loaded(file);
    const std::vector<glm::vec4>& read = scene.meshes()[0].tangents;
    ASSERT_EQ(read.size(), 3u);
    EXPECT_EQ(read[0], glm::vec4(0, 1, 0, -1));
    EXPECT_EQ(read[1], glm::vec4(1, 0, 0, 1));
    EXPECT_FLOAT_EQ(glm::length(glm::vec3(read[2])), 1.0f);
}

TEST(LoaderGeometry, LeavesOutPointsAndLinesAndSaysSo) {
    GltfFile file = one_triangle();
    const json attributes = file.root["meshes"][0]["primitives"][0]["attributes"];
    for (int mode : {0, 1, 2, 3}) {
        file.root["meshes"][0]["primitives"].push_back({{"attributes", attributes}, {"mode", mode}});
    }
    std::vector<std::string> warnings;
    const HostScene scene = loaded(file, &warnings);
    EXPECT_EQ(scene.triangle_count(), 1u);
    EXPECT_THAT(warnings,
                ElementsAre(::testing::AllOf(HasSubstr("points (/meshes/0/primitives/1)"), HasSubstr("lines"))));
}

TEST(LoaderGeometry, DoesNotReadMeshesThatTheSceneLeavesOut) {
    GltfFile file = one_triangle();
    file.add_mesh(file.root["meshes"][0]["primitives"][0]);
    EXPECT_EQ(loaded(file).meshes().size(), 1u);
}

}  // namespace
}  // namespace render_system::testing::loader_geometry_test
