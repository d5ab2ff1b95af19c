// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>

#include <limits>

#include "tests/render_system/gltf_file.h"

namespace render_system::testing::camera_file_test {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

json complete() {
    return {{"description", "ignored"},
            {"position", {0, 0, 5}},
            {"target", {0, 0, 0}},
            {"up", {0, 1, 0}},
            {"vfov_degrees", 60},
            {"sky_radiance", {1, 2, 3}},
            {"area_lights",
             {{{"corners", {{-1, 9, -1}, {1, 9, -1}, {1, 9, 1}, {-1, 9, 1}}},
               {"normal", {0, -1, 0}},
               {"radiance", {4, 5, 6}}}}}};
}

std::string message_after(const std::function<void(json&)>& edit) {
    const TempFolder folder;
    json document = complete();
    edit(document);
    write_file(folder / "camera.json", document.dump());
    const Result<CameraFile> file = load_camera_file(folder / "camera.json");
    EXPECT_FALSE(file.ok());
    EXPECT_THAT(file.status.message, HasSubstr("camera.json: "));
    EXPECT_EQ(file.status.message.find('\n'), std::string::npos);
    return file.status.message;
}

TEST(CameraFile, ReadsCameraSkyAndAreaLights) {
    const TempFolder folder;
    write_file(folder / "camera.json", complete().dump());
    const Result<CameraFile> file = load_camera_file(folder / "camera.json");
    ASSERT_TRUE(file.ok()) << file.status.message;
    EXPECT_EQ(file->camera.position, glm::vec3(0, 0, 5));
    EXPECT_EQ(file->camera.forward, glm::vec3(0, 0, -1));
    EXPECT_NEAR(file->camera.vertical_fov, 1.0471976f, 1e-6f);
    EXPECT_TRUE(file->has_sky);
    EXPECT_EQ(file->sky_radiance, glm::vec3(1, 2, 3));
    ASSERT_EQ(file->area_lights.size(), 1u);
    EXPECT_EQ(file->area_lights[0].corners[2], glm::vec3(1, 9, 1));
    EXPECT_EQ(file->area_lights[0].radiance, glm::vec3(4, 5, 6));
}

TEST(CameraFile, SkyAndLightsMayBeLeftOut) {
    const TempFolder folder;
    json document = complete();
    document.erase("sky_radiance");
    document.erase("area_lights");
    write_file(folder / "camera.json", document.dump());
    const Result<CameraFile> file = load_camera_file(folder / "camera.json");
    ASSERT_TRUE(file.ok());
    EXPECT_FALSE(file->has_sky);
    EXPECT_TRUE(file->area_lights.empty());
}

TEST(CameraFile, RefusesWhatItCannotUse) {
    EXPECT_THAT(message_after([](json& d) { d.erase("position"); }), HasSubstr("/position: is missing"));
    EXPECT_THAT(message_after([](json& d) { d["up"] = {0, 1}; }), HasSubstr("/up: must be an array of three"));
    EXPECT_THAT(message_after([](json& d) { d["vfov_degrees"] = "wide"; }),
                HasSubstr("/vfov_degrees: must be a number"));
    EXPECT_THAT(message_after([](json& d) { d["vfov_degrees"] = 180; }), HasSubstr("between 0 and 180"));
    EXPECT_THAT(message_after([](json& d) { d["target"] = d["position"]; }), HasSubstr("/target"));
    EXPECT_THAT(message_after([](json& d) { d["sky_radiance"][1] = -1; }), HasSubstr("/sky_radiance: must not be neg"));
    EXPECT_THAT(message_after([](json& d) {
                    d["area_lights"][0]["normal"] = {0, 1, 0};
                }),
                HasSubstr("/area_lights/0/normal: points away"));
    EXPECT_THAT(message_after([](json& d) { d["area_lights"][0]["corners"].erase(0); }), HasSubstr("four points"));
    EXPECT_THAT(message_after([](json& d) { d = json::array(); }), HasSubstr("/: is no object; write {...}"));
    EXPECT_THAT(message_after([](json& d) { d["position"][0] = 1e300; }), HasSubstr("/position/0: must be a number"));
}

std::vector<std::string> warnings_after(const std::function<void(json&)>& edit) {
    const TempFolder folder;
    json document = complete();
    edit(document);
    write_file(folder / "camera.json", document.dump());
    std::vector<std::string> warnings;
    EXPECT_TRUE(load_camera_file(folder / "camera.json", &warnings).ok());
    return warnings;
}

TEST(CameraFile, NamesWhatItDoesNotKnow) {
    EXPECT_THAT(warnings_after([](json&) {}), IsEmpty());
    EXPECT_THAT(warnings_after([](json& d) { d["emitters_in_gltf"] = {{{"power", 1}}}; }), IsEmpty());
    EXPECT_THAT(warnings_after([](json& d) {
                    d["sky_radance"] = {9, 9, 9};
                    d["vfov"] = 60;
                    d["area_lights"][0]["radience"] = {1, 1, 1};
                }),
                ElementsAre(HasSubstr("camera.json: not known and left out: /sky_radance, /vfov, "
                                      "/area_lights/0/radience; a camera file has position,")));
    EXPECT_THAT(warnings_after([](json& d) {
                    for (const char* key : {"a1", "a2", "a3", "a4", "a5", "a6"}) d[key] = 0;
                }),
                ElementsAre(HasSubstr("left out: /a1, /a2, /a3, /a4 and 2 more; a camera file")));
    EXPECT_THAT(message_after([](json& d) {  // what is missing is told first
                    d["positon"] = d["position"];
                    d.erase("position");
                }),
                HasSubstr("/position: is missing"));
}

TEST(CameraFile, RefusesFilesThatAreMissingOrNoJson) {
    const TempFolder folder;
    EXPECT_EQ(load_camera_file(folder / "nothing.json").status.code, StatusCode::not_found);
    write_file(folder / "empty.json", "");
    EXPECT_THAT(load_camera_file(folder / "empty.json").status.message, HasSubstr("the file is empty"));
    write_file(folder / "text.json", "position: 1");
    EXPECT_THAT(load_camera_file(folder / "text.json").status.message, HasSubstr("; name one that the key K"));
}

TEST(CameraFile, RefusesWhatIsGivenTwice) {
    const TempFolder folder;
    const std::string text = complete().dump(), light = R"("radiance":[4,5,6])";
    const size_t place = text.find(light);
    ASSERT_NE(place, std::string::npos);
    write_file(folder / "camera.json", text.substr(0, text.size() - 1) + R"(,"up":[0,1,0]})");
    EXPECT_THAT(load_camera_file(folder / "camera.json").status.message, HasSubstr("\"up\": is given twice"));
    write_file(folder / "light.json", text.substr(0, place) + R"("radiance":[1,1,1],)" + text.substr(place));
    EXPECT_THAT(load_camera_file(folder / "light.json").status.message, HasSubstr("\"radiance\": is given twice"));
    json lights = complete();  // of one name in two objects nothing is given twice
    lights["area_lights"].push_back(lights["area_lights"][0]);
    write_file(folder / "lights.json", lights.dump());
    EXPECT_TRUE(load_camera_file(folder / "lights.json").ok());
}

// A 2x1 map with these six numbers.
void write_map(const std::filesystem::path& path, const std::vector<float>& rgb) {
    const auto output = OIIO::ImageOutput::create(path.string());
    const OIIO::ImageSpec spec(2, 1, 3, OIIO::TypeDesc::FLOAT);
    ASSERT_TRUE(output->open(path.string(), spec) && output->write_image(OIIO::TypeDesc::FLOAT, rgb.data()) &&
                output->close());
}

TEST(SkyFile, ReadsHdrAndExrMaps) {
    const TempFolder folder;
    for (const char* name : {"sky.hdr", "sky.exr"}) {
        write_map(folder / name, {1, 2, 4, 0.5f, 0.25f, 8});
        std::vector<std::string> warnings;
        const Result<Sky> sky = load_sky(folder / name, &warnings);
        ASSERT_TRUE(sky.ok()) << sky.status.message;
        EXPECT_THAT(warnings, IsEmpty());
        EXPECT_EQ(sky->width, 2u);
        EXPECT_EQ(sky->height, 1u);
        EXPECT_EQ(glm::vec3(sky->texels[0]), glm::vec3(1, 2, 4));
    }
}

TEST(SkyFile, RepairsTexelsThatLightCannotHave) {
    const TempFolder folder;
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    write_map(folder / "sky.exr", {-1, nan, inf, 1, 2, 3});
    std::vector<std::string> warnings;
    const Result<Sky> sky = load_sky(folder / "sky.exr", &warnings);
    ASSERT_TRUE(sky.ok()) << sky.status.message;
    EXPECT_EQ(glm::vec3(sky->texels[0]), glm::vec3(0, 0, 65504));
    EXPECT_EQ(glm::vec3(sky->texels[1]), glm::vec3(1, 2, 3));
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("sky.exr: 1 texels are negative, infinite or NaN")));
}

TEST(SkyFile, RefusesOtherFiles) {
    const TempFolder folder;
    EXPECT_EQ(load_sky(folder / "nothing.hdr").status.code, StatusCode::not_found);
    write_file(folder / "sky.png", png(1, 1, 3, {1, 2, 3}));
    EXPECT_THAT(load_sky(folder / "sky.png").status.message, HasSubstr("sky.png: is no HDR image"));
    write_file(folder / "sky.hdr", "#?RADIANCE\nnothing");
    EXPECT_THAT(load_sky(folder / "sky.hdr").status.message, HasSubstr("sky.hdr: cannot be decoded"));
}

}  // namespace
}  // namespace render_system::testing::camera_file_test
