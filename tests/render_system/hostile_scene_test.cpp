// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0

// Scenes that somebody made to do harm: what they may name, and how large and far off they may be.

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <memory>

#include "render_system/null_core.h"
#include "render_system/render_system.h"
#include "render_system/scene_limits.h"
#include "tests/render_system/gltf_file.h"

namespace render_system::testing::hostile_scene_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class HostileScene : public ::testing::Test {
protected:
    void SetUp() override {
        fs::create_directories(folder_ / "scene/sub");
        write_file(folder_ / "outside.bin", triangle_.buffer);
        write_file(folder_ / "scene/inside.bin", triangle_.buffer);
        write_file(folder_ / "scene/sub/deep.bin", triangle_.buffer);
    }

    /// Why the scene is refused; empty where it is not.
    std::string refusal(const std::string& text, bool allow_outside = false) {
        write_file(folder_ / "scene/a.gltf", text);
        const Result<LoadedScene> result = load_scene(folder_ / "scene/a.gltf", {.allow_outside = allow_outside});
        if (!result.ok()) {
            EXPECT_THAT(result.status.message, HasSubstr((folder_ / "scene/a.gltf").string() + ": "));
            EXPECT_EQ(result.status.message.find('\n'), std::string::npos) << result.status.message;
        }
        return result.status.message;
    }

    /// The scene with that image, which no material uses.
    static std::string with_image(GltfFile file, const std::string& uri) {
        file.root["images"] = {{{"uri", uri}}};
        return file.text_embedded();
    }

    /// The scene with that image as its colour.
    static std::string with_texture(GltfFile file, const std::string& uri) {
        const int texture = file.add_texture(uri);
        const json color = {{"baseColorTexture", {{"index", texture}}}};
        file.root["meshes"][0]["primitives"][0]["material"] = file.add_material({{"pbrMetallicRoughness", color}});
        return file.text_embedded();
    }

    const TempFolder folder_;
    const GltfFile triangle_ = one_triangle();
};

struct Uri {
    const char* text;
    bool leaves;
};

TEST_F(HostileScene, UrisThatLeaveItsFolderAreRefusedUnlessAllowed) {
    fs::create_symlink("../outside.bin", folder_.path() / "scene/link_out.bin");
    fs::create_symlink("..", folder_.path() / "scene/folder_out");
    fs::create_symlink("sub/deep.bin", folder_.path() / "scene/link_in.bin");
    fs::create_symlink(folder_.path() / "scene/inside.bin", folder_.path() / "scene/absolute_link_in.bin");
    fs::create_symlink("/proc/self/cwd", folder_.path() / "scene/magic");
    const std::string absolute = (folder_.path() / "scene/inside.bin").string();
    const std::string file_uri = "file://" + absolute, upper = "FILE:" + absolute;
    const Uri uris[] = {
        {"inside.bin", false},
        {"./inside.bin", false},
        {"sub/../inside.bin", false},
        {"sub/deep.bin", false},
        {"../scene/inside.bin", false},
        {"%69nside.bin", false},
        {"link_in.bin", false},
        {"absolute_link_in.bin", false},
        {"../outside.bin", true},
        {"..%2foutside.bin", true},
        {"%2e%2e/outside.bin", true},
        {"%2E%2E%2Foutside.bin", true},
        {"sub/../../outside.bin", true},
        {"../no_such_file.bin", true},
        {"no_such_folder/../../outside.bin", true},
        {"link_out.bin", true},
        {"folder_out/outside.bin", true},
        {"magic/outside.bin", true},
        {"..\\outside.bin", true},
        {"sub\\..\\..\\outside.bin", true},
        {"%2e%2e%5coutside.bin", true},
        {"C:\\outside.bin", true},
        {"c:/outside.bin", true},
        {"//host/share/outside.bin", true},
        {"\\\\host\\share\\outside.bin", true},
        {"/etc/passwd", true},
        {"%2Fetc/passwd", true},
        {"../../../../../../../../../../etc/passwd", true},
        {"file:../outside.bin", true},
        {"file:inside.bin", true},
        {absolute.c_str(), true},
        {file_uri.c_str(), true},
        {upper.c_str(), true},
    };
    for (const Uri& uri : uris) {
        SCOPED_TRACE(uri.text);
        const std::string buffer = refusal(triangle_.text_external(uri.text));
        const std::string image = refusal(with_image(triangle_, uri.text));
        if (uri.leaves) {
            const std::string what = std::string("/uri: \"") + uri.text + "\" leads out of the scene's folder";
            EXPECT_THAT(buffer, HasSubstr("/buffers/0" + what));
            EXPECT_THAT(image, HasSubstr("/images/0" + what));
            EXPECT_THAT(buffer, HasSubstr("--allow-outside"));
        } else {
            EXPECT_THAT(buffer, IsEmpty());
            EXPECT_THAT(image, IsEmpty());
        }
    }
    for (const std::string& uri :
         {std::string("../outside.bin"), std::string("link_out.bin"), absolute, file_uri, upper}) {
        EXPECT_THAT(refusal(triangle_.text_external(uri), true), IsEmpty());
    }
}

TEST_F(HostileScene, OtherSchemesAreRefusedWhateverIsAllowed) {
    for (const char* uri : {"https://example.com/a.bin", "ftp:a.bin", "smb://host/a"}) {
        EXPECT_THAT(refusal(triangle_.text_external(uri), true), HasSubstr("is not a local file")) << uri;
    }
}

void make_socket(const fs::path& place) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    ASSERT_LT(place.string().size(), sizeof(address.sun_path));
    std::strcpy(address.sun_path, place.c_str());
    const int number = socket(AF_UNIX, SOCK_STREAM, 0);
    ASSERT_EQ(bind(number, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
    close(number);
}

TEST_F(HostileScene, APictureIsCalledOne) {
    for (const std::string start : {"\x89PNG\r\n", "v/1\x01", "\xff\xd8\xff", "#?RADIANCE\n"}) {
        const fs::path file = folder_.path() / "scene" / "picture";
        write_file(file, start + "more");
        EXPECT_THAT(load_scene(file).status.message, HasSubstr("is a picture, no scene"));
        EXPECT_THAT(load_camera_file(file).status.message, HasSubstr("is no camera file (parse error at"));
    }
}

// A pipe without a writer would be waited for without end, which the test's time limit finds.
TEST_F(HostileScene, WhatIsNoFileIsRefusedAtOnceWhereverAFileIsRead) {
    ASSERT_EQ(mkfifo((folder_ / "scene/pipe").c_str(), 0600), 0);
    make_socket(folder_ / "scene/socket");
    const std::pair<std::string, std::string> kinds[] = {
        {"pipe", "a pipe"}, {"socket", "a socket"}, {"sub", "a folder"}, {"/dev/zero", "a device"}};
    for (const auto& [name, kind] : kinds) {
        SCOPED_TRACE(name);
        const fs::path file = folder_.path() / "scene" / name;
        const std::string what = file.string() + ": is not a regular file but " + kind;
        EXPECT_THAT(load_scene(file).status.message, HasSubstr(what));
        EXPECT_THAT(load_sky(file).status.message, HasSubstr(what));
        EXPECT_THAT(load_camera_file(file).status.message, HasSubstr(what));
        EXPECT_THAT(refusal(triangle_.text_external(name), true), HasSubstr("/buffers/0: " + what));
        EXPECT_THAT(refusal(with_texture(triangle_, name), true), HasSubstr("/images/0: " + what));
    }
}

/// A change to the scene of one triangle, and the words of the refusal; none where it renders.
struct Extreme {
    const char* patch;
    std::vector<std::string> words;
};

const Extreme EXTREMES[] = {
    {R"([{"op": "add", "path": "/nodes/0/translation", "value": [9.9e8, 0, -9.9e8]}])", {}},
    {R"([{"op": "add", "path": "/nodes/0/scale", "value": [9.9e8, 9.9e8, 9.9e8]}])", {}},
    {R"([{"op": "add", "path": "/nodes/0/scale", "value": [1e-11, 1e-11, 1e-11]}])", {}},
    {R"([{"op": "add", "path": "/nodes/0/translation", "value": [1.1e9, 0, 0]}])",
     {"/nodes/0", "1.1e+09", "up to 1e+09"}},
    {R"([{"op": "add", "path": "/nodes/0/translation", "value": [0, -2e18, 0]}])",
     {"/nodes/0", "2e+18", "scale the scene"}},
    {R"([{"op": "add", "path": "/nodes/0/scale", "value": [1.1e9, 1, 1]}])", {"/nodes/0", "1.1e+09"}},
    {R"([{"op": "add", "path": "/nodes/0/scale", "value": [1e18, 1e18, 1e18]}])", {"/nodes/0", "too large for floats"}},
    {R"([{"op": "add", "path": "/nodes/0/scale", "value": [3e38, 3e38, 3e38]}])", {"/nodes/0"}},
    {R"([{"op": "add", "path": "/nodes/0/scale", "value": [1e-18, 1e-18, 1e-18]}])", {"/nodes/0", "scaled to nothing"}},
    {R"([{"op": "add", "path": "/nodes/0/scale", "value": [1e-40, 1, 1]}])", {"/nodes/0", "scaled to nothing"}},
    // A mesh used twice is traced in its own space.
    {R"([{"op": "add", "path": "/nodes/1", "value": {"mesh": 0, "scale": [1e-15, 1, 1]}},
         {"op": "add", "path": "/scenes/0/nodes/1", "value": 1}])",
     {}},
    {R"([{"op": "add", "path": "/nodes/1", "value": {"mesh": 0, "scale": [1e-15, 1, 1], "translation": [5e8, 0, 0]}},
         {"op": "add", "path": "/scenes/0/nodes/1", "value": 1}])",
     {"/nodes/1", "scales so far down", "1e+18"}},
    {R"([{"op": "add", "path": "/nodes/1", "value": {"mesh": 0, "scale": [1e-15, 1, 1]}},
         {"op": "add", "path": "/nodes/0/translation", "value": [9e8, 0, 0]},
         {"op": "add", "path": "/scenes/0/nodes/1", "value": 1}])",
     {"instance 1", "scales so far down"}},
    // Cameras and lights.
    {R"([{"op": "add", "path": "/cameras", "value": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}]},
         {"op": "add", "path": "/nodes/1", "value": {"camera": 0, "translation": [0, 0, 9.9e11]}},
         {"op": "add", "path": "/scenes/0/nodes/1", "value": 1}])",
     {}},
    {R"([{"op": "add", "path": "/cameras", "value": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}]},
         {"op": "add", "path": "/nodes/1", "value": {"camera": 0, "translation": [0, 0, 1.1e12]}},
         {"op": "add", "path": "/scenes/0/nodes/1", "value": 1}])",
     {"the eye is at 0, 0, 1.1e+12", "up to 1e+12"}},
    {R"([{"op": "add", "path": "/extensions", "value": {"KHR_lights_punctual": {"lights": [{"type": "point", "range": 3e38}]}}},
         {"op": "add", "path": "/nodes/0/extensions", "value": {"KHR_lights_punctual": {"light": 0}}},
         {"op": "add", "path": "/nodes/1", "value":
             {"translation": [9.9e11, 0, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}}},
         {"op": "add", "path": "/scenes/0/nodes/1", "value": 1}])",
     {}},
    {R"([{"op": "add", "path": "/extensions", "value": {"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {}}]}}},
         {"op": "add", "path": "/nodes/1", "value":
             {"translation": [1.1e12, 0, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}}},
         {"op": "add", "path": "/scenes/0/nodes/1", "value": 1}])",
     {"/nodes/1", "the light is at a coordinate of 1.1e+12"}},
};

TEST_F(HostileScene, ScenesPastTheLimitsAreRefusedByName) {
    for (const Extreme& extreme : EXTREMES) {
        SCOPED_TRACE(extreme.patch);
        GltfFile file = triangle_;
        file.root = file.root.patch(json::parse(extreme.patch));
        write_file(folder_ / "scene/a.gltf", file.text_embedded());
        Result<LoadedScene> result = load_scene(folder_ / "scene/a.gltf");
        std::string message = result.status.message;
        if (result.ok()) {
            // As the program does it: the scene's own camera or one that frames it, and a core that sees what is sent.
            const HostScene& scene = result->scene;
            const Camera camera = scene.cameras().empty() ? framing_camera(scene) : scene.cameras()[0].camera;
            RenderSystem system(std::move(result->scene));
            system.use_core(create_null_core());
            ASSERT_TRUE(system.core().Init({}).ok());
            std::vector<glm::vec4> pixels(16 * 9);
            ASSERT_TRUE(system.core().SetTarget({16, 9, pixels}).ok());
            message = system.render(view_pyramid(camera, 16, 9), Convergence::Restart, 1).message;
        }
        if (extreme.words.empty()) {
            EXPECT_THAT(message, IsEmpty());
        }
        for (const std::string& word : extreme.words) EXPECT_THAT(message, HasSubstr(word));
    }
}

TEST_F(HostileScene, CameraFilesPastTheLimitsAreRefused) {
    const auto refusal_of = [&](const std::string& position, const std::string& more = "",
                                const std::string& degrees = "40") {
        write_file(folder_ / "c.json", R"({"position": )" + position +
                                           R"(, "target": [0, 0, 0], "up": [0, 1, 0], "vfov_degrees": )" + degrees +
                                           more + "}");
        return load_camera_file(folder_ / "c.json").status.message;
    };
    EXPECT_THAT(refusal_of("[0, 0, 9.9e11]"), IsEmpty());
    EXPECT_THAT(refusal_of("[0, 0, 1.1e12]"), HasSubstr("c.json: /position: the eye is at 0, 0, 1.1e+12"));
    EXPECT_THAT(refusal_of("[2e18, 0, 1]"), HasSubstr("up to 1e+12 can be rendered"));
    EXPECT_THAT(refusal_of("[1e39, 0, 1]"), HasSubstr("/position/0: must be a number"));
    EXPECT_THAT(refusal_of("[NaN, 0, 1]"), HasSubstr("is no camera file"));
    EXPECT_THAT(refusal_of("[0, 0, 0]"), HasSubstr("/target"));
    EXPECT_THAT(refusal_of("[0, 0, 3]", "", "0"), HasSubstr("/vfov_degrees"));
    EXPECT_THAT(refusal_of("[0, 0, 3]", R"(, "area_lights": [{"radiance": [1, 1, 1],
                    "corners": [[0, 0, 0], [2e18, 0, 0], [2e18, 1, 0], [0, 1, 0]]}])"),
                HasSubstr("/area_lights/0/corners/1: reaches to a coordinate of 2e+18; up to 1e+09"));
    const std::string deep = std::string(200000, '[') + std::string(200000, ']');
    EXPECT_THAT(refusal_of("[0, 0, 3]", ", \"x\": " + deep), IsEmpty());
}

// The same picture, whatever power of two the scene is enlarged by: what the limit on coordinates is taken from.
TEST(SceneLimits, AFarEyeKeepsItsView) {
    const Camera near = look_at({1, 2, 3}, {0, 0, 0}, {0, 1, 0}, 0.7f);
    const ViewPyramid expected = view_pyramid(near, 16, 9);
    for (const float scale : {0x1p14f, 0x1p30f, 0x1p38f}) {
        Camera far = near;
        far.position *= scale;
        const ViewPyramid view = view_pyramid(far, 16, 9);
        EXPECT_TRUE(check_view(view).ok());
        const glm::vec3 pairs[][2] = {{view.top_left, expected.top_left},
                                      {view.top_right, expected.top_right},
                                      {view.bottom_left, expected.bottom_left}};
        for (const auto& [corner, wanted] : pairs) {
            const glm::vec3 way = glm::normalize(corner - view.eye), same = glm::normalize(wanted - expected.eye);
            EXPECT_LT(glm::length(way - same), 2e-5f) << scale;
        }
    }
}

TEST(SceneLimits, AMatrixThatCancelsOutIsNotInvertible) {
    CoreTransform transform;
    EXPECT_TRUE(is_invertible(transform));
    transform.rows[1] = glm::vec4(1.0f, 1e-7f, 0.0f, 0.0f);  // rows 0 and 1 nearly parallel
    EXPECT_TRUE(is_invertible(transform)) << "a flattened column loses nothing";
    transform.rows[0] = glm::vec4(1.0f, 1.0f, 0.0f, 0.0f);
    transform.rows[1] = glm::vec4(1.0f, 1.0f + 0x1p-20f, 0.0f, 0.0f);
    EXPECT_FALSE(is_invertible(transform));
}

}  // namespace
}  // namespace render_system::testing::hostile_scene_test
