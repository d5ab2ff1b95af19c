// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0

// What comes in by way of pathtracer-import: OBJ, FBX, Draco.

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>

#include "render_system/loader/uri.h"
#include "tests/render_system/gltf_file.h"

namespace render_system::testing::loader_import_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A sheet of 4 x 4 squares of 0.5 x 0.25 in two triangles each, normals +z, uv (x / 4, y / 4), colours (50 x, 50 y, 7,
// 255), as draco 1.5.5 packs it: sequentially without loss, and by edgebreaker with 11, 8 and 10 bits.
const char* const kSequential =
    "RFJBQ08CAgEAAAAgGQEAAQICAQMBBAMDBAUEBgUFBgcGCAcHCAkCAwoKAwsDBQsLBQwFBwwMBw0HCQ0NCQ4KCw8PCxALDBAQDBEMDRERDRINDhIS"
    "DhMPEBQUEBUQERUVERYREhYWEhcSExcXExgBBAAJAwAAAQkDAAEDCQIAAgICBAADAAAAAQAAAAAAAAAAAAAAAAAAAD8AAAAAAAAAAAAAAAAAAIA+"
    "AAAAAAAAAD8AAIA+AAAAAAAAgD8AAAAAAAAAAAAAgD8AAIA+AAAAAAAAwD8AAAAAAAAAAAAAwD8AAIA+AAAAAAAAAEAAAAAAAAAAAAAAAEAAAIA+"
    "AAAAAAAAAAAAAAA/AAAAAAAAAD8AAAA/AAAAAAAAgD8AAAA/AAAAAAAAwD8AAAA/AAAAAAAAAEAAAAA/AAAAAAAAAAAAAEA/AAAAAAAAAD8AAEA/"
    "AAAAAAAAgD8AAEA/AAAAAAAAwD8AAEA/AAAAAAAAAEAAAEA/AAAAAAAAAAAAAIA/AAAAAAAAAD8AAIA/AAAAAAAAgD8AAIA/AAAAAAAAwD8AAIA/"
    "AAAAAAAAAEAAAIA/AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAAAA"
    "AACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAAAA"
    "AACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAAAA"
    "AACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAACAPgAAAAAAAAAA"
    "AACAPgAAgD4AAIA+AAAAPwAAAAAAAAA/AACAPgAAQD8AAAAAAABAPwAAgD4AAIA/AAAAAAAAgD8AAIA+AAAAAAAAAD8AAIA+AAAAPwAAAD8AAAA/"
    "AABAPwAAAD8AAIA/AAAAPwAAAAAAAEA/AACAPgAAQD8AAAA/AABAPwAAQD8AAEA/AACAPwAAQD8AAAAAAACAPwAAgD4AAIA/AAAAPwAAgD8AAEA/"
    "AACAPwAAgD8AAIA/AAEBAQJx4SqkL6T/T5ECXQ8r7QETAdJeZSb16w72KO7PHus/zucmpQAAAAD/AAAA";
const char* const kEdgebreaker =
    "RFJBQ08CAgEBAAAAGSADIAMACu/T6lOt6lPVqhr/ARH/AsxC/wLMQv8CzEIE/wAAAAAAAQAAAgAAAQAJAwAAAgEBCQMAAQMBAwkCAAICAQICBAAD"
    "AQEBAQAMAzEzIQUXkQKRApECBpiKI5cfg/8HIAD+BxAAAP8BAEAAAAAiAAAgAAAAAAD/BwAAAAAAAAAAAAAAAAAAAAAAQAsAAwEBAYABuT7/90kB"
    "AyLfnv8AAAB/AAAACAEBAQALAxUuPQoXIQWRAgaopnTq/6H////fP4D+ICQAkIAgAgAAAAD/AwAAAAAAAAAAAAAAAIA/CgEBAQECyQGFO6QvpP9P"
    "SQGk/4tJAQksXphw8Pzn/4MAAAAA/wAAAA==";

std::string bytes_of(const char* base64_text) {
    const auto bytes = decode_data_uri(std::string("data:;base64,") + base64_text, "");
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

GltfFile draco_file(const std::string& stream) {
    GltfFile file;
    const int view = file.add_view(stream);
    const json attributes = {{"POSITION", file.add_accessor(-1, FLOAT, "VEC3", 25)},
                             {"NORMAL", file.add_accessor(-1, FLOAT, "VEC3", 25)},
                             {"TEXCOORD_0", file.add_accessor(-1, FLOAT, "VEC2", 25)},
                             {"COLOR_0", file.add_accessor(-1, UBYTE, "VEC4", 25, true)}};
    const json part = {{"bufferView", view},
                       {"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}, {"COLOR_0", 3}}}};
    file.add_mesh({{"attributes", attributes},
                   {"indices", file.add_accessor(-1, USHORT, "SCALAR", 96)},
                   {"extensions", {{"KHR_draco_mesh_compression", part}}}});
    file.add_node({{"mesh", 0}});
    file.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return file;
}

TEST(LoaderDraco, DecodesBothConnectivitiesAndAllAttributes) {
    for (const char* text : {kSequential, kEdgebreaker}) {
        const HostScene scene = loaded(draco_file(bytes_of(text)));
        ASSERT_EQ(scene.meshes().size(), 1u);
        const HostMesh& mesh = scene.meshes()[0];
        ASSERT_EQ(mesh.positions.size(), 25u);
        ASSERT_EQ(mesh.triangles.size(), 32u);
        double area = 0.0;
        for (const glm::uvec4& t : mesh.triangles) {
            const glm::vec3 way =
                glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
            area += 0.5 * static_cast<double>(way.z);  // all wind the same way
        }
        EXPECT_NEAR(area, 2.0, 1e-2);
        for (size_t i = 0; i < 25; ++i) {
            const float x = mesh.positions[i].x / 0.5f, y = mesh.positions[i].y / 0.25f;
            EXPECT_NEAR(x, std::round(x), 5e-3f);
            EXPECT_NEAR(y, std::round(y), 5e-3f);
            EXPECT_NEAR(mesh.uv0[i].x, x / 4, 2e-3f);
            EXPECT_NEAR(mesh.uv0[i].y, y / 4, 2e-3f);
            EXPECT_GT(mesh.normals[i].z, 0.99f);
            EXPECT_NEAR(255.0f * mesh.colors[i].x, 50.0f * std::round(x), 1e-4f);
            EXPECT_NEAR(255.0f * mesh.colors[i].z, 7.0f, 1e-4f);
        }
    }
}

TEST(LoaderDraco, PrefersWhatTheFileHoldsPlain) {
    GltfFile file = one_triangle();
    const int view = file.add_view("no Draco stream at all");
    file.root["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", view}, {"attributes", {{"POSITION", 0}}}};
    EXPECT_EQ(loaded(file).triangle_count(), 1u);
}

TEST(LoaderDraco, RefusesDamage) {
    const std::string good = bytes_of(kEdgebreaker);
    EXPECT_THAT(refusal(draco_file("x")), HasSubstr("its Draco data are damaged"));
    EXPECT_THAT(refusal(draco_file(good.substr(0, 100))), HasSubstr("its Draco data are damaged"));
    std::string huge = bytes_of(kSequential);  // faces and points, as varints after 11 bytes of header
    huge.replace(11, 2, "\xFF\xFF\xFF\xFF\x0F\xFF\xFF\xFF\xFF\x0F");
    EXPECT_THAT(refusal(draco_file(huge)), HasSubstr("export"));
    GltfFile file = draco_file(good);
    file.root["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]["NORMAL"] = 9;
    EXPECT_THAT(refusal(file), HasSubstr("/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression: has no "
                                         "attribute 9 for NORMAL"));
    file = draco_file(good);
    file.root["accessors"][0]["count"] = 24;
    std::vector<std::string> warnings;
    EXPECT_EQ(loaded(file, &warnings).triangle_count(), 32u);
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("their Draco streams contradict (/meshes/0/primitives/0/ext")));
    file = draco_file(good);
    file.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 2;
    EXPECT_THAT(refusal(file), HasSubstr("its POSITION has 3 components, unlike the accessor"));
}

Result<LoadedScene> load_text(const TempFolder& folder, const std::string& name, const std::string& text) {
    write_file(folder / name, text);
    return load_scene(folder / name);
}

const CoreMaterial& material_of(const HostScene& scene, const std::string& name) {
    const auto& all = scene.materials();
    const auto found = std::find_if(all.begin(), all.end(), [&](const HostMaterial& m) { return m.name == name; });
    EXPECT_NE(found, all.end()) << name;
    return found == all.end() ? all.front().core : found->core;
}

const char* const kQuad = R"(mtllib a.mtl
o sheet
v 0 0 0
v 2 0 0
v 2 1 0
v 0 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
usemtl paint
f 1/1 2/2 3/3 4/4
f -4 -3 -2
)";

TEST(LoaderObj, ReadsFacesCoordinatesAndMaterials) {
    const TempFolder folder;
    write_file(folder / "map.png", png(1, 1, 3, {10, 20, 30}));
    write_file(folder / "hole.png", png(1, 1, 1, {64}));
    write_file(folder / "a.mtl", R"(newmtl paint
Kd 0.5 0.25 0.125
Ks 1 1 1
Ns 30
Ke 0 2 0
map_Kd .\maps\..\map.png
map_d hole.png
norm C:\elsewhere\map.png
newmtl metal
Kd 0 0 0
Ks 0.9 0.6 0.3
newmtl glass
Ni 1.4
illum 7
newmtl veil
Kd 1 1 1
d 0.25
newmtl pbr
Kd 1 1 1
Pr 0.25
Pm 1
)");
    const auto result = load_text(folder, "a.obj", kQuad);
    ASSERT_TRUE(result.ok()) << result.status.message;
    EXPECT_THAT(result->warnings,
                ElementsAre(HasSubstr("textures whose coordinates a mesh does not have")));  // kQuad's
    const HostScene& scene = result->scene;
    EXPECT_EQ(scene.triangle_count(), 3u);
    const HostMesh& mesh = scene.meshes()[0];
    ASSERT_EQ(mesh.positions.size(), 9u);
    for (size_t i = 3; i < 9; ++i) {  // of the square, which has coordinates: v turned over
        EXPECT_NEAR(mesh.uv0[i].x, mesh.positions[i].x / 2.0f, 1e-6f);
        EXPECT_NEAR(mesh.uv0[i].y, 1.0f - mesh.positions[i].y, 1e-6f);
        EXPECT_EQ(mesh.normals[i], glm::vec3(0, 0, 1));
    }
    const CoreMaterial& paint = material_of(scene, "paint");
    EXPECT_EQ(paint.base_color, glm::vec3(0.5f, 0.25f, 0.125f));
    EXPECT_NEAR(paint.roughness, 0.5f, 1e-6f);  // (2 / 32)^(1/4)
    EXPECT_EQ(paint.emission, glm::vec3(0, 2, 0));
    EXPECT_FALSE(paint.opaque);
    ASSERT_NE(paint.base_color_texture.texture, NONE);
    EXPECT_EQ(scene.textures()[paint.base_color_texture.texture].texels[0], 0x401E140Au);  // coverage in alpha
    EXPECT_NE(paint.normal_texture.texture, NONE);
}

TEST(LoaderObj, ReadsTheOtherKindsOfMaterial) {
    const TempFolder folder;
    write_file(folder / "a.mtl",
               "newmtl metal\nKd 0 0 0\nKs 0.9 0.6 0.3\nnewmtl glass\nNi 1.4\nillum 7\nnewmtl veil\nKd 1 1 1\nd 0.25\n"
               "newmtl pbr\nKd 1 1 1\nPr 0.25\nPm 1\n");
    std::string text = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (const char* name : {"metal", "glass", "veil", "pbr"}) text += std::string("usemtl ") + name + "\nf 1 2 3\n";
    const auto result = load_text(folder, "a.obj", text);
    ASSERT_TRUE(result.ok()) << result.status.message;
    EXPECT_EQ(material_of(result->scene, "metal").metallic, 1.0f);
    EXPECT_EQ(material_of(result->scene, "metal").base_color, glm::vec3(0.9f, 0.6f, 0.3f));
    EXPECT_EQ(material_of(result->scene, "glass").transmission, 1.0f);
    EXPECT_EQ(material_of(result->scene, "glass").ior, 1.4f);
    EXPECT_FALSE(material_of(result->scene, "glass").thin_walled);
    EXPECT_EQ(material_of(result->scene, "veil").alpha, 0.25f);
    EXPECT_EQ(material_of(result->scene, "veil").specular, 0.0f);
    EXPECT_EQ(material_of(result->scene, "pbr").roughness, 0.25f);
    EXPECT_EQ(material_of(result->scene, "pbr").metallic, 1.0f);
}

TEST(LoaderObj, SmoothsWhatAGroupAsksFor) {
    const TempFolder folder;
    // A roof: two squares at right angles over a ridge along y.
    const std::string roof = "v -1 0 0\nv 0 0 1\nv 0 1 1\nv -1 1 0\nv 1 0 0\nv 1 1 0\n";
    const auto normal_at_the_ridge = [&](const std::string& group) {
        const auto result = load_text(folder, "roof.obj", roof + "s " + group + "\nf 1 2 3 4\nf 2 5 6 3\n");
        EXPECT_TRUE(result.ok()) << result.status.message;
        const HostMesh& mesh = result->scene.meshes()[0];
        for (size_t i = 0; i < mesh.positions.size(); ++i) {
            if (mesh.positions[i] == glm::vec3(0, 0, 1)) return mesh.normals[i];
        }
        return glm::vec3(0.0f);
    };
    EXPECT_NEAR(std::abs(normal_at_the_ridge("off").x), std::sqrt(0.5f), 1e-5f);
    EXPECT_GT(normal_at_the_ridge("1").z, 0.94f);  // twice the one half, once the other: (1, 0, 3) at the least
}

TEST(LoaderObj, RefusesOrNamesWhatIsWrong) {
    const TempFolder folder;
    const auto message = [&](const std::string& text) { return load_text(folder, "a.obj", text).status.message; };
    EXPECT_THAT(message("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"), HasSubstr("a.obj: a face names v 9 of 3; export"));
    EXPECT_THAT(message("v 0 1e999 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), HasSubstr("v number 1 is not finite"));
    EXPECT_THAT(message("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n"), HasSubstr("is no OBJ that can be read"));
    const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    EXPECT_THAT(message("v 0 0 0\nv 1 nan 0\n"), HasSubstr("a.obj: line 2: v has \"nan\" where a finite number"));
    EXPECT_THAT(message("v 0 0\n"), HasSubstr("line 1: v has 2 of at least 3 numbers"));
    EXPECT_THAT(message(points + "f 1 2 4294967299\n"),
                HasSubstr("line 4: f names \"4294967299\", past the 2147483647"));
    EXPECT_THAT(message(points + "f 1 2 3x\n"), HasSubstr("line 4: f has \"3x\" where a corner"));
    std::string round = points + "f";
    for (int i = 0; i <= 10000; ++i) round += i % 2 == 0 ? " 1" : " 2";
    EXPECT_THAT(message(round + "\n"), HasSubstr("line 4: a face of 10001 corners; 10000 are the most"));
    EXPECT_THAT(message("nothing of use\n"), HasSubstr("the scene has no triangles"));
    EXPECT_THAT(message(""), HasSubstr("the file is empty"));
    EXPECT_THAT(load_scene(folder / "none.obj").status.message, HasSubstr("there is no such file"));
    const auto lacking = load_text(folder, "a.obj", kQuad);  // and no a.mtl
    ASSERT_TRUE(lacking.ok());
    EXPECT_THAT(lacking->warnings,
                ElementsAre(HasSubstr("left out: materials of MTL files (a.mtl: there is no such file; ")));
    EXPECT_EQ(material_of(lacking->scene, "default").metallic, 0.0f);
    EXPECT_EQ(material_of(lacking->scene, "default").base_color, glm::vec3(0.8f));
}

TEST(LoaderObj, NamesWhatItTakesOtherwiseThanWritten) {
    const TempFolder folder;
    write_file(folder / "a.mtl",
               "newmtl grey\nKd 0.25\nNs nan\nnewmtl lost\nKd nan 1 0\nnewmtl ray\nKd spectral a.rfl\nKs xyz 1 1 1\n");
    write_file(folder / "b.mtl", "newmtl cloud\nKd 1 1 1\nd -halo 0.5\n");
    std::string text = "mtllib a.mtl b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvn nan 0 1\nf 1 2\n";
    for (const char* name : {"grey", "lost", "ray", "cloud", "none\x1B[2J"})
        text += std::string("usemtl ") + name + "\nf 1 \\\n2 3\n";
    const auto result = load_text(folder, "a.obj", text);
    ASSERT_TRUE(result.ok()) << result.status.message;
    EXPECT_EQ(result->scene.triangle_count(), 5u);
    EXPECT_EQ(material_of(result->scene, "grey").base_color, glm::vec3(0.25f));
    EXPECT_EQ(material_of(result->scene, "lost").base_color, glm::vec3(0.8f));
    EXPECT_EQ(material_of(result->scene, "cloud").alpha, 0.5f);
    EXPECT_THAT(result->warnings,
                ElementsAre(AllOf(HasSubstr("values of MTL that are no numbers (a.mtl line 3, a.mtl line 5)"),
                                  HasSubstr("spectra or by CIE XYZ (a.mtl line 7, a.mtl line 8)"),
                                  HasSubstr("(d -halo), which have the same coverage all over (b.mtl line 3)"),
                                  HasSubstr("faces of fewer than three corners (line 6)"),
                                  HasSubstr("coordinates that are no numbers (line 5)"),
                                  HasSubstr("materials that no MTL file defines (none\x1B[2J in line 19)"))));
    std::filesystem::remove(folder / "a.mtl");
    ASSERT_EQ(mkfifo((folder / "a.mtl").c_str(), 0600), 0);
    EXPECT_THAT(load_scene(folder / "a.obj").status.message,
                HasSubstr("a.obj: mtllib: a.mtl is not a regular file but a pipe"));
}

// Shapes as Pixar's OpenSubdiv has them in its examples: the faces name normals that the file leaves out.
TEST(LoaderObj, ShowsShapesWhoseNormalsAndCoordinatesAreMissing) {
    const TempFolder folder;
    const auto result = load_text(folder, "a.obj",
                                  "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\nvt 0.5 0\nvt 0 0.5\n"
                                  "f 1/1/1 2/2/2 3/3/9\nf 1/1/1 2/7/1 3/3/1\nf 1/1/1 2/2/1 3/3/1\n");
    ASSERT_TRUE(result.ok()) << result.status.message;
    EXPECT_EQ(result->scene.triangle_count(), 3u);
    EXPECT_THAT(result->warnings,
                ElementsAre(HasSubstr("that faces name and the file does not have (vn 9 of 1, vt 7 of 3)")));
    const HostMesh& mesh = result->scene.meshes()[0];
    for (const glm::vec3& normal : mesh.normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
    EXPECT_EQ(std::count(mesh.uv0.begin(), mesh.uv0.end(), glm::vec2(0.5f, 1.0f)),
              2);  // by the first face and the last
}

TEST(LoaderObj, TakesCornersThatEndInSlashes) {
    const TempFolder folder;
    const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n# 1/2/\n";
    const auto result = load_text(folder, "a.obj", text + "f 1/1/ 2/2/\t3/3/\r\nf 1// 3// 2//\nf 1/1 3/3 2/2/");
    ASSERT_TRUE(result.ok()) << result.status.message;
    EXPECT_EQ(result->scene.triangle_count(), 3u);
    EXPECT_THAT(result->warnings, ElementsAre());
    EXPECT_THAT(load_text(folder, "a.obj", text + "f / 2/2/ 3/3/\n").status.message,
                HasSubstr("line 8: f has \"/\" where a corner"));
}

TEST(LoaderObj, PassesOverTheMarkBeforeUtf8) {
    const TempFolder folder;
    const std::string mark = "\xEF\xBB\xBF";
    write_file(folder / "a.mtl", mark + "newmtl paint\nKd 1 0 0\n");
    const auto result = load_text(folder, "a.obj", mark + kQuad);
    ASSERT_TRUE(result.ok()) << result.status.message;
    EXPECT_EQ(material_of(result->scene, "paint").base_color, glm::vec3(1, 0, 0));
}

TEST(LoaderObj, StaysInItsFolder) {
    const TempFolder folder;
    std::filesystem::create_directory(folder / "scene");
    write_file(folder / "a.mtl", "newmtl paint\nKd 1 0 0\n");
    const std::string text = "mtllib ../a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl paint\nf 1 2 3\n";
    EXPECT_THAT(load_text(folder, "scene/a.obj", text).status.message,
                AllOf(HasSubstr("mtllib: \"../a.mtl\" leads out"), HasSubstr("--allow-outside")));
    const auto allowed = load_scene(folder / "scene/a.obj", {.allow_outside = true});
    ASSERT_TRUE(allowed.ok()) << allowed.status.message;
    EXPECT_EQ(material_of(allowed->scene, "paint").base_color, glm::vec3(1, 0, 0));
}

// Its light is what FBX cannot say enough of.
const char* const kLamp =
    "\tNodeAttribute: 40, \"NodeAttribute::lamp\", \"Light\" {\n\t\tTypeFlags: \"Light\"\n\t}\n"
    "\tModel: 21, \"Model::lamp\", \"Light\" {\n\t\tVersion: 232\n\t}\n";

std::string fbx_with_a_lamp() {
    std::string text = read_file(FORMATS "/sheet.fbx");
    text.insert(text.find("\tMaterial: 30"), kLamp);
    text.insert(text.find("\tC: \"OO\",20,0"), "\tC: \"OO\",21,0\n\tC: \"OO\",40,21\n");
    return text;
}

TEST(LoaderFbx, ReadsMeshesNodesAndMaterialsInMetres) {
    const TempFolder folder;
    const auto result = load_text(folder, "a.FBX", fbx_with_a_lamp());
    ASSERT_TRUE(result.ok()) << result.status.message;
    EXPECT_THAT(result->warnings, ElementsAre(HasSubstr("left out: lights, which FBX gives no unit (1)")));
    const HostScene& scene = result->scene;
    EXPECT_EQ(scene.triangle_count(), 2u);
    const HostMesh& mesh = scene.meshes()[0];
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        EXPECT_EQ(mesh.uv0[i], glm::vec2(mesh.positions[i].x / 2.0f, 1.0f - mesh.positions[i].y));
        EXPECT_EQ(transform_point(scene.instances()[0].transform, mesh.positions[i]).z, 5.0f);
    }
    const CoreMaterial& paint = material_of(scene, "paint");
    EXPECT_EQ(paint.base_color, glm::vec3(0.5f, 0.25f, 0.125f));
    EXPECT_NEAR(paint.roughness, 1.0f - std::sqrt(0.3f), 1e-6f);  // Assimp's rule, which is Blender's
    EXPECT_EQ(paint.emission, glm::vec3(0, 1, 0));
}

TEST(LoaderFbx, StaysInItsFolder) {
    const TempFolder folder;
    std::filesystem::create_directory(folder / "scene");
    const auto message_of = [&](const std::string& picture) {
        std::string text = read_file(FORMATS "/sheet.fbx");
        text.insert(text.find("\tMaterial: 30"), "\tTexture: 50, \"Texture::t\", \"\" {\n\t\tFileName: \"" + picture +
                                                     "\"\n\t\tRelativeFilename: \"" + picture + "\"\n\t}\n");
        text.insert(text.find("\tC: \"OO\",20,0"), "\tC: \"OP\",50,30,\"DiffuseColor\"\n");
        return load_text(folder, "scene/a.fbx", text).status.message;
    };
    write_file(folder / "a.png", "not shown");
    std::filesystem::create_symlink("../a.png", folder / "scene/link.png");
    for (const char* const out : {"../a.png", "..\\a.png", "link.png"})
        EXPECT_THAT(message_of(out), AllOf(HasSubstr("leads out"), HasSubstr("--allow-outside"))) << out;
    ASSERT_EQ(mkfifo((folder / "scene/pipe.png").c_str(), 0600), 0);
    EXPECT_THAT(message_of("pipe.png"), HasSubstr("not a regular file but a pipe"));
}

TEST(LoaderFbx, RefusesDamageInOneLine) {
    const TempFolder folder;
    const std::string whole = read_file(FORMATS "/sheet.fbx");
    for (const std::string& text : {std::string("Kaydara FBX Binary  \0\x1A\0", 23) + std::string(100, '\xFF'),
                                    whole.substr(0, 700), std::string("not at all")}) {
        const std::string message = load_text(folder, "a.fbx", text).status.message;
        EXPECT_THAT(message, HasSubstr("a.fbx: "));
        EXPECT_EQ(message.find('\n'), std::string::npos);
    }
}

}  // namespace
}  // namespace render_system::testing::loader_import_test
