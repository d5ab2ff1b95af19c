// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0

// docs/formats.md says what becomes of what scenes hold; each row names a model that shows it.

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "tests/render_system/gltf_file.h"

namespace render_system::testing::formats_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

struct FormatRow {
    std::string what, state, model;
};

std::string trimmed(const std::string& text) {
    const size_t first = text.find_first_not_of(" "), last = text.find_last_not_of(" ");
    return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// What stands between the first two backticks, else all of it.
std::string in_backticks(const std::string& text) {
    const size_t first = text.find('`');
    return first == std::string::npos ? text : text.substr(first + 1, text.find('`', first + 1) - first - 1);
}

std::vector<FormatRow> rows_of_the_page() {
    std::vector<FormatRow> rows;
    std::istringstream page(read_file(FORMATS_PAGE));
    for (std::string line; std::getline(page, line);) {
        std::vector<std::string> cells;
        std::istringstream row(line);
        for (std::string cell; std::getline(row, cell, '|');) cells.push_back(trimmed(cell));
        if (cells.size() != 4 || cells[3].front() != '`') continue;
        rows.push_back({cells[1], cells[2], in_backticks(cells[3])});
    }
    return rows;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

// Whether cores would be told the same of both.
bool same_scene(const HostScene& a, const HostScene& b) {
    const auto all = [](const auto& these, const auto& those, const auto& same) {
        return std::equal(these.begin(), these.end(), those.begin(), those.end(), same);
    };
    const auto material = [](const HostMaterial& x, const HostMaterial& y) {
        return x.core == y.core && x.unlit == y.unlit;
    };
    const auto mesh = [](const HostMesh& x, const HostMesh& y) {
        return x.positions == y.positions && x.normals == y.normals && x.tangents == y.tangents && x.uv0 == y.uv0 &&
               x.uv1 == y.uv1 && x.uv2 == y.uv2 && x.uv3 == y.uv3 && x.colors == y.colors && x.triangles == y.triangles;
    };
    const auto texture = [](const HostTexture& x, const HostTexture& y) {
        return x.width == y.width && x.height == y.height && x.format == y.format && x.texels == y.texels &&
               x.wrap_s == y.wrap_s && x.wrap_t == y.wrap_t && x.nearest == y.nearest;
    };
    const auto instance = [](const HostInstance& x, const HostInstance& y) {
        return x.mesh == y.mesh && x.transform == y.transform;
    };
    const auto light = [](const PunctualLight& x, const PunctualLight& y) {
        return x.kind == y.kind && x.position == y.position && x.direction == y.direction && x.emission == y.emission &&
               x.inner_cone == y.inner_cone && x.outer_cone == y.outer_cone;
    };
    const auto camera = [](const HostCamera& x, const HostCamera& y) {
        return x.camera.position == y.camera.position && x.camera.forward == y.camera.forward &&
               x.camera.vertical_fov == y.camera.vertical_fov && x.camera.parallel_height == y.camera.parallel_height;
    };
    return all(a.materials(), b.materials(), material) && all(a.meshes(), b.meshes(), mesh) &&
           all(a.textures(), b.textures(), texture) && all(a.instances(), b.instances(), instance) &&
           all(a.punctual_lights(), b.punctual_lights(), light) && all(a.cameras(), b.cameras(), camera) &&
           a.sky().radiance == b.sky().radiance && a.sky().texels == b.sky().texels;
}

// Of all that is placed.
float area_of(const HostScene& scene) {
    float sum = 0.0f;
    for (const HostInstance& instance : scene.instances()) {
        if (instance.mesh == NONE) continue;
        const HostMesh& mesh = scene.meshes()[instance.mesh];
        for (const glm::uvec4& t : mesh.triangles) {
            const glm::vec3& p = mesh.positions[t.x];
            sum += 0.5f * glm::length(glm::cross(mesh.positions[t.y] - p, mesh.positions[t.z] - p));
        }
    }
    return sum;
}

// Animated ones stand where they are after half a second.
Result<LoadedScene> loaded_at_half(const std::filesystem::path& path, const std::string& variant = "") {
    Result<LoadedScene> result = load_scene(path, {.variant = variant});
    if (result.ok()) {
        EXPECT_TRUE(result->scene.play(0.5).ok()) << path;
    }
    return result;
}

// The extension that the row is about, if it is about one.
std::string extension_of(const FormatRow& row) {
    const std::string name = in_backticks(row.what);
    return name.starts_with("KHR_") || name.starts_with("EXT_") ? name : "";
}

void erase_members(json& value, const std::string& name) {
    if (value.is_object()) value.erase(name);
    if (!value.is_structured()) return;
    for (json& part : value) erase_members(part, name);
}

// What a model is without its feature: a patch (RFC 6902) where that is no extension's object.
const std::map<std::string, const char*> kPatches = {
    {"triangles.gltf", R"([{"op": "remove", "path": "/meshes/0/primitives/2"},
                           {"op": "remove", "path": "/meshes/0/primitives/1"}])"},
    {"sparse.gltf", R"([{"op": "remove", "path": "/accessors/0/sparse"}])"},
    {"vertex_colours.gltf", R"([{"op": "remove", "path": "/meshes/0/primitives/0/attributes/COLOR_0"}])"},
    {"quantized.gltf", R"([{"op": "replace", "path": "/meshes/0/primitives/0/attributes/POSITION", "value": 0}])"},
    {"perspective.gltf", R"([{"op": "replace", "path": "/cameras/0/perspective/yfov", "value": 0.9}])"},
    {"orthographic.gltf", R"([{"op": "replace", "path": "/cameras/0/orthographic/ymag", "value": 0.9}])"},
    {"uv_sets.gltf", R"([{"op": "replace", "path": "/materials/0/emissiveTexture/texCoord", "value": 3}])"},
    {"sixteen_bits.gltf", R"([{"op": "remove", "path": "/materials/0/pbrMetallicRoughness/baseColorTexture"}])"},
    {"basisu_fallback.gltf", R"([{"op": "remove", "path": "/materials/0/pbrMetallicRoughness/baseColorTexture"}])"},
    {"animation.gltf", R"([{"op": "remove", "path": "/animations"}])"},
    {"animation_pointer.gltf", R"([{"op": "remove", "path": "/animations"}])"},
    {"skin.gltf", R"([{"op": "remove", "path": "/nodes/0/skin"}])"},
    {"morph_targets.gltf", R"([{"op": "remove", "path": "/meshes/0/primitives/0/targets"},
                               {"op": "remove", "path": "/meshes/0/weights"}])"},
};

// The same in the text of formats that are no glTF.
struct TextEdit {
    std::string from, to;
};
const std::map<std::string, TextEdit> kTextEdits = {
    {"sheet.obj", {"usemtl paint", "usemtl metal"}},
    {"sheet.fbx", {"0.5,0.25,0.125", "0.5,0.25,0.5"}},
};

std::string without_feature(const FormatRow& row) {
    std::string text = read_file(FORMATS "/" + row.model);
    if (const auto edit = kTextEdits.find(row.model); edit != kTextEdits.end()) {
        const size_t at = text.find(edit->second.from);
        EXPECT_NE(at, std::string::npos) << row.model;
        return text.replace(at, edit->second.from.size(), edit->second.to);
    }
    json document = json::parse(text);
    const auto patch = kPatches.find(row.model);
    if (patch != kPatches.end())
        document = document.patch(json::parse(patch->second));
    else
        erase_members(document, extension_of(row));
    return document.dump();
}

// That it loads without a warning says little: the cores are told something else of the same file without the feature.
void expect_shown(const FormatRow& row, const HostScene& scene) {
    EXPECT_GT(area_of(scene), 0.0f);
    if (row.model == "variants.gltf") {
        EXPECT_FALSE(same_scene(scene, loaded_at_half(FORMATS "/" + row.model, "blue")->scene));
        return;
    }
    if (row.model == "sheet_binary.fbx") {
        EXPECT_TRUE(same_scene(scene, loaded_at_half(FORMATS "/sheet.fbx")->scene));
        return;
    }
    const TempFolder folder;
    std::filesystem::copy_file(FORMATS "/sheet.mtl", folder / "sheet.mtl");
    write_file(folder / row.model, without_feature(row));
    const Result<LoadedScene> without = loaded_at_half(folder / row.model);
    const bool has_effect = !row.what.starts_with("extensions without effect");
    EXPECT_NE(without.ok() && same_scene(scene, without->scene), has_effect);
}

TEST(Formats, ThePageSaysWhatBecomesOfEachModel) {
    const std::vector<FormatRow> rows = rows_of_the_page();
    EXPECT_GT(rows.size(), 30u);
    for (const FormatRow& row : rows) {
        SCOPED_TRACE(row.model);
        const auto result = loaded_at_half(FORMATS "/" + row.model);
        if (row.state == "refused") {
            ASSERT_FALSE(result.ok());
            EXPECT_THAT(result.status.message, HasSubstr(in_backticks(row.what)));
            continue;
        }
        ASSERT_TRUE(result.ok()) << result.status.message;
        const std::string said = joined(result->warnings);
        if (row.state == "shown") {
            EXPECT_EQ(said, "");
            expect_shown(row, result->scene);
            continue;
        }
        EXPECT_EQ(row.state, "left out");
        EXPECT_THAT(said, HasSubstr(in_backticks(row.what)));
        if (extension_of(row).empty()) continue;
        const TempFolder folder;
        write_file(folder / row.model, without_feature(row));
        EXPECT_TRUE(same_scene(result->scene, loaded_at_half(folder / row.model)->scene));
    }
}

// What the model's one texel says, in 16 bits.
TEST(Formats, AnImageOfSixteenBitsKeepsThem) {
    const auto result = load_scene(FORMATS "/sixteen_bits.gltf");
    ASSERT_TRUE(result.ok()) << result.status.message;
    EXPECT_EQ(result->scene.textures()[0].texels, (std::vector<uint32_t>{0x05231234u, 0xFFFF8001u}));
}

TEST(Formats, ThePageNamesEachModel) {
    std::set<std::string> named;
    for (const FormatRow& row : rows_of_the_page()) named.insert(row.model);
    for (const auto& entry : std::filesystem::directory_iterator(FORMATS)) {
        const std::string ending = entry.path().extension();
        if (ending != ".gltf" && ending != ".obj" && ending != ".fbx") continue;
        EXPECT_TRUE(named.contains(entry.path().filename())) << entry.path();
    }
}

}  // namespace
}  // namespace render_system::testing::formats_test
