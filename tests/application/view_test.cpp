// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What the window does, without one: the camera that a person moves, picking, how two pictures become one, what becomes
// of a finding.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "application/view/camera_text.h"
#include "application/view/composition.h"
#include "application/view/drift_panel.h"
#include "application/view/picking.h"
#include "application/view/view_camera.h"
#include "render_system/scene_loader.h"

namespace application {
namespace view_test {
namespace {

using render_system::Box;
using render_system::Camera;
using render_system::view_pyramid;
using render_system::ViewPyramid;

const Box BOX{{-1.0f, -1.0f, -1.0f}, {1.0f, 1.0f, 1.0f}};
constexpr float RIGHT_ANGLE = 1.57079633f;

Camera front() { return render_system::look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, RIGHT_ANGLE); }

/// Where a point stands in the picture, by shares of its sides from the top left: a plain perspective projection.
glm::dvec2 place_of(const Camera& camera, const glm::dvec3& point, double aspect) {
    const glm::dvec3 way = point - glm::dvec3(camera.position);
    const double depth = glm::dot(way, glm::dvec3(camera.forward)),
                 half = depth * std::tan(0.5 * static_cast<double>(camera.vertical_fov));
    return {0.5 + 0.5 * glm::dot(way, glm::dvec3(camera.right)) / (half * aspect),
            0.5 - 0.5 * glm::dot(way, glm::dvec3(camera.up)) / half};
}

void expect_near(const glm::vec3& a, const glm::vec3& b, float within = 1e-4f) {
    EXPECT_LT(glm::length(a - b), within)
        << a.x << " " << a.y << " " << a.z << " for " << b.x << " " << b.y << " " << b.z;
}

TEST(ViewCamera, IsTheCameraItWasMadeOfUntilItMoves) {
    Camera rolled = front();
    std::swap(rolled.up, rolled.right);
    rolled.aperture = 0.25f;
    const Camera same = ViewCamera(rolled, BOX).camera();
    EXPECT_EQ(same.up, rolled.up);
    EXPECT_EQ(same.aperture, 0.25f);
}

TEST(ViewCamera, OrbitsAtOneDistanceAroundThePointLookedAt) {
    ViewCamera camera(front(), BOX);
    camera.orbit(RIGHT_ANGLE, 0.0);
    expect_near(camera.camera().position, {5, 0, 0});
    expect_near(camera.camera().forward, {-1, 0, 0});
    camera.orbit(0.0, 10.0);  // no farther than straight above
    EXPECT_GT(camera.camera().position.y, 4.99f);
    EXPECT_NEAR(glm::length(camera.camera().position), 5.0f, 1e-4f);
    EXPECT_NEAR(glm::length(camera.camera().right), 1.0f, 1e-5f);
    for (int i = 0; i < 1000; ++i) camera.orbit(0.7, i % 2 ? 0.3 : -0.3);
    EXPECT_NEAR(glm::length(camera.camera().position), 5.0f, 1e-3f);
}

TEST(ViewCamera, LooksAroundItsEyeFliesAndZooms) {
    ViewCamera camera(front(), BOX);
    camera.look(RIGHT_ANGLE, 0.0);
    expect_near(camera.camera().position, {0, 0, 5});
    expect_near(camera.camera().forward, {1, 0, 0});
    camera.fly(0.5, 0.0, 0.2);
    expect_near(camera.camera().position, {2.5f, 1.0f, 5.0f});
    ViewCamera zoomed(front(), BOX);
    zoomed.zoom(0.5);
    expect_near(zoomed.camera().position, {0, 0, 2.5f});
    for (int i = 0; i < 1000; ++i) zoomed.zoom(0.5);  // never through what it looks at
    EXPECT_GT(zoomed.camera().position.z, 0.0f);
}

TEST(ViewCamera, PansSoThatWhatIsLookedAtStaysUnderTheMouse) {
    ViewCamera camera(front(), BOX);
    camera.orbit(0.4, 0.3);
    const double aspect = 16.0 / 9.0;
    camera.pan(0.25, -0.125);  // shares of the height, to the right and down
    const glm::dvec2 place = place_of(camera.camera(), {0, 0, 0}, aspect);
    EXPECT_NEAR(place.x, 0.5 + 0.25 / aspect, 1e-4);
    EXPECT_NEAR(place.y, 0.5 + 0.125, 1e-4);
}

TEST(ViewCamera, FramesABoxSoThatAllOfItIsSeenAndLittleElse) {
    for (const double aspect : {16.0 / 9.0, 1.0, 0.4}) {
        ViewCamera camera(front(), BOX);
        camera.orbit(1.0, 0.5);
        const Box box{{10.0f, -3.0f, 4.0f}, {30.0f, 2.0f, 5.0f}};
        camera.frame(box, aspect);
        double widest = 0.0;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 point((corner & 1) != 0 ? 30 : 10, (corner & 2) != 0 ? 2 : -3, (corner & 4) != 0 ? 5 : 4);
            const glm::dvec2 off = glm::abs(place_of(camera.camera(), point, aspect) - 0.5);
            widest = std::max({widest, off.x, off.y});
        }
        EXPECT_LT(widest, 0.5) << aspect;
        EXPECT_GT(widest, 0.15) << aspect;
    }
    ViewCamera camera(front(), BOX);
    camera.frame(Box(), 1.0);  // nothing to frame
    EXPECT_EQ(camera.camera().position, front().position);
}

/// Two triangles, one before the other, of one material each.
render_system::HostScene two_triangles() {
    render_system::HostScene scene;
    for (const char* name : {"near", "far"}) scene.add_material({name, {}});
    for (uint32_t i = 0; i < 2; ++i) {
        render_system::HostMesh mesh;
        const float z = i == 0 ? 1.0f : -1.0f, size = i == 0 ? 0.5f : 2.0f;
        mesh.name = i == 0 ? "front" : "back";
        mesh.positions = {{-size, -size, z}, {size, -size, z}, {0.0f, size, z}};
        mesh.triangles = {{0, 1, 2, i}};
        const uint32_t id = scene.add_mesh(std::move(mesh));
        render_system::HostNode node;
        node.name = i == 0 ? "" : "the far node";
        node.instance = scene.add_instance(id, {});
        scene.add_node(node);
    }
    return scene;
}

TEST(Picking, FindsTheNearestInstanceAndItsMaterial) {
    const render_system::HostScene scene = two_triangles();
    render_system::RayProbe probe(scene);
    const ViewPyramid view = view_pyramid(front(), 160, 90);
    const auto middle = pick(scene, probe, view, 0.5, 0.5);
    ASSERT_TRUE(middle);
    EXPECT_EQ(middle->instance, 0u);
    EXPECT_EQ(middle->node, "front");
    EXPECT_EQ(middle->material_name, "near");
    EXPECT_NEAR(middle->distance, 4.0, 1e-5);
    // (1.5, -1.8, -1) lies in the far triangle alone.
    const glm::dvec2 place = place_of(front(), {1.5, -1.8, -1.0}, 160.0 / 90.0);
    const auto beside = pick(scene, probe, view, place.x, place.y);
    ASSERT_TRUE(beside);
    EXPECT_EQ(beside->node, "the far node");
    EXPECT_EQ(beside->material_name, "far");
    EXPECT_FALSE(pick(scene, probe, view, 0.0, 0.0));
}

TEST(Picking, TakesParallelRaysOfAnOrthographicCamera) {
    Camera camera = front();
    camera.parallel_height = 4.0f;
    const PictureRay ray = ray_through(view_pyramid(camera, 200, 100), 0.75, 0.25);
    EXPECT_LT(glm::length(ray.direction - glm::dvec3(0, 0, -1)), 1e-6);
    EXPECT_LT(glm::length(ray.origin - glm::dvec3(2, 1, 5)), 1e-5);
}

TEST(CameraText, ComesBackThroughTheFileThatTheOptionTakes) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "view_test.camera.json";
    std::ofstream(file) << R"({"position": [9, 9, 9], "target": [0, 0, 0], "up": [0, 1, 0], "vfov_degrees": 9,
                               "sky_radiance": [0.25, 0.5, 1]})";
    for (const float reach : {0.0f, 1.0f, 30000.0f}) {
        const Camera camera = render_system::look_at({reach, 2.0f, 3.0f}, {reach - 1.0f, 1.0f, -2.0f}, {0, 1, 0}, 0.7f);
        const auto text = camera_text(camera, file.string());
        ASSERT_TRUE(text.ok()) << text.status.message;
        std::ofstream(file) << *text;
        const auto back = render_system::load_camera_file(file);
        ASSERT_TRUE(back.ok()) << back.status.message;
        EXPECT_EQ(back->camera.position, camera.position);
        EXPECT_LT(glm::length(back->camera.forward - camera.forward), 1e-6f) << reach;
        EXPECT_LT(glm::length(back->camera.up - camera.up), 1e-6f) << reach;
        EXPECT_NEAR(back->camera.vertical_fov, 0.7f, 1e-6f);
        EXPECT_EQ(back->sky_radiance, glm::vec3(0.25f, 0.5f, 1.0f));
    }
    Camera parallel = front();
    parallel.parallel_height = 4.0f;
    EXPECT_FALSE(camera_text(parallel, "").ok());
    std::filesystem::remove(file);
    EXPECT_EQ(camera_text(front(), file.string()).status.code, render_system::StatusCode::unreadable);
}

TEST(Composition, ShowsOneBothOrTheirDifference) {
    const Channels<uint8_t> a{4, 1, {0, 0, 0, 10, 10, 10, 20, 20, 20, 30, 30, 30}};
    const Channels<uint8_t> b{2, 1, {1, 1, 1, 22, 20, 35}};  // as a coarse pass: half the size
    EXPECT_EQ(composed(a, b, {Show::One, 0.5f, 16}).rgb, a.rgb);
    EXPECT_EQ(composed(a, b, {Show::Split, 0.5f, 16}).rgb,
              (std::vector<uint8_t>{0, 0, 0, 10, 10, 10, 22, 20, 35, 22, 20, 35}));
    EXPECT_EQ(composed(a, b, {Show::Split, 0.0f, 16}).rgb, resized(b, 4, 1).rgb);
    EXPECT_EQ(composed(a, b, {Show::Split, 7.0f, 16}).rgb, a.rgb);
    EXPECT_EQ(composed(a, b, {Show::Difference, 0.5f, 10}).rgb,
              (std::vector<uint8_t>{10, 10, 10, 90, 90, 90, 20, 0, 150, 80, 100, 50}));
}

TEST(Composition, TheSizeOfACoarsePictureIsSaid) {
    EXPECT_EQ(coarse_note(480, 270, 480, 270), "");
    EXPECT_EQ(coarse_note(480, 270, 3840, 2160),
              ", a coarse first picture of 480x270; save again once it is drawn at 3840x2160");
}

/// A project of one pair, and a panel on it. porttool lies beside this program.
class Drift : public testing::Test {
protected:
    using Step = DriftPanel::Step;

    void SetUp() override {
        std::string name = (std::filesystem::temp_directory_path() / "drift_XXXXXX").string();
        folder = ::mkdtemp(name.data());
        porttool = (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "porttool").string();
        ASSERT_TRUE(std::filesystem::exists(porttool));
        write("gpu/a.glsl", kSource);
        write("cpu/a.cpp", kTarget);
        ASSERT_EQ(run({"git", "init", "-q", "."}), 0);
        ASSERT_EQ(run({porttool, "init", "--source", "gpu/*", "--target", "cpu/*"}), 0);
        ASSERT_EQ(run({"git", "add", "."}), 0);
        ASSERT_EQ(run({"git", "-c", "user.name=a", "-c", "user.email=a@b", "commit", "-qm", "first"}), 0);
        ASSERT_TRUE(log.open((folder / "log").string()).ok());
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    void write(const char* name, const std::string& text) const {
        std::filesystem::create_directories((folder / name).parent_path());
        std::ofstream(folder / name) << text;
    }
    std::string read(const char* name) const {
        std::ifstream file(folder / name);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    int run(std::vector<std::string> words) const {
        words.insert(words.begin(), {"/usr/bin/env", "-C", folder.string()});
        SideProcess process(words);
        while (!process.exit_code()) {
            process.update();
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return *process.exit_code();
    }
    /// Runs the panel until it is so, or for ten seconds.
    template <class Holds>
    static bool until(DriftPanel& panel, Holds&& holds) {
        for (int i = 0; i < 5000; ++i) {
            panel.update();
            if (holds()) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        return false;
    }
    static bool until_step(DriftPanel& panel, Step step) {
        return until(panel, [&] { return panel.step() == step; });
    }
    // A file that is being written may be read twice: the finding that counts is of its last text.
    static bool until_it_shows(DriftPanel& panel, const char* factor) {
        return until(panel, [&] {
            const auto* finding = panel.selected();
            return finding && finding->source.text.find(std::string("x * ") + factor + ";") != std::string::npos;
        });
    }
    void edit_source(const char* factor) const {
        std::string text = kSource;
        write("gpu/a.glsl", text.replace(text.find("2.5"), 3, factor));
    }

    const std::string kSource = "float scale(float x, float y) {\n    float sum = x * 2.5;\n    return sum + y;\n}\n";
    const std::string kTarget = "float scale(float x, float y) {\n    float sum = x * 2.5f;\n    return sum + y;\n}\n";
    std::filesystem::path folder;
    std::string porttool;
    ViewLog log;
};

TEST_F(Drift, AFindingIsShownWithBothTextsItsPortIsSeenBeforeItIsWrittenAndThenItIsGone) {
    edit_source("3.5");
    DriftPanel panel(porttool, (folder / "gpu").string(), log);
    ASSERT_TRUE(until_it_shows(panel, "3.5")) << panel.standing();
    EXPECT_EQ(panel.selected()->rule, "source-changed");
    EXPECT_EQ(panel.selected()->source.id, "gpu/a.glsl:scale");
    EXPECT_THAT(panel.selected()->source.text, testing::HasSubstr("x * 3.5;"));
    EXPECT_EQ(panel.selected()->target.text, kTarget);
    panel.apply();  // nothing is shown yet
    EXPECT_EQ(panel.step(), Step::None);

    panel.propose();
    EXPECT_EQ(panel.step(), Step::Asked);
    ASSERT_TRUE(until_step(panel, Step::Shown)) << panel.said();
    EXPECT_THAT(panel.patch(), testing::HasSubstr("+    float sum = x * 3.5f;"));
    EXPECT_EQ(read("cpu/a.cpp"), kTarget) << "shown, not written";

    // Another edit meanwhile: what is shown is not what would be written.
    edit_source("4.5");
    ASSERT_TRUE(until(panel, [&] { return panel.step() != Step::Shown; }));
    panel.apply();
    EXPECT_NE(panel.step(), Step::Writing);
    ASSERT_TRUE(until_it_shows(panel, "4.5"));
    panel.propose();
    ASSERT_TRUE(until_step(panel, Step::Shown)) << panel.said();
    panel.apply();
    ASSERT_TRUE(until_step(panel, Step::Written)) << panel.said();
    EXPECT_THAT(read("cpu/a.cpp"), testing::HasSubstr("x * 4.5f;"));
    EXPECT_TRUE(until(panel, [&] { return panel.findings().empty(); })) << panel.standing();
    EXPECT_EQ(panel.selected(), nullptr);
    panel.propose();
    panel.select_next();  // there is nothing to ask about

    // The port is not committed: porttool writes over it only when told to.
    edit_source("5.5");
    ASSERT_TRUE(until_it_shows(panel, "5.5"));
    panel.propose();
    ASSERT_TRUE(until_step(panel, Step::Shown)) << panel.said();
    panel.apply();
    ASSERT_TRUE(until_step(panel, Step::Failed));
    EXPECT_TRUE(panel.wants_force()) << panel.said();
    panel.apply(true);
    ASSERT_TRUE(until_step(panel, Step::Written)) << panel.said();
    EXPECT_THAT(read("cpu/a.cpp"), testing::HasSubstr("x * 5.5f;"));
    EXPECT_THAT(read("log"), testing::HasSubstr("\"state\":\"gone\""));
}

TEST_F(Drift, AcceptAndDeferTakeAReason) {
    edit_source("3.5");
    DriftPanel panel(porttool, folder.string(), log);
    ASSERT_TRUE(until(panel, [&] { return panel.selected() != nullptr; })) << panel.standing();
    panel.accept("");
    panel.defer("later", "", "2999-12-31");
    EXPECT_EQ(panel.step(), Step::None);
    panel.defer("later", "a person", "no day");
    ASSERT_TRUE(until_step(panel, Step::Failed));
    EXPECT_THAT(panel.said(), testing::HasSubstr("YYYY-MM-DD"));
    panel.defer("later", "a person", "2999-12-31");
    ASSERT_TRUE(until_step(panel, Step::Written)) << panel.said();
    EXPECT_TRUE(until(panel, [&] { return panel.findings().empty(); }));
    EXPECT_THAT(read("portmap.lock"), testing::HasSubstr("a person"));

    edit_source("4.5");  // the deferral was for another text
    ASSERT_TRUE(until_it_shows(panel, "4.5"));
    panel.accept("the port needs none");
    ASSERT_TRUE(until_step(panel, Step::Written)) << panel.said();
    EXPECT_TRUE(until(panel, [&] { return panel.findings().empty(); }));
    EXPECT_THAT(read("portmap.lock"), testing::HasSubstr("the port needs none"));
}

TEST_F(Drift, SaysWhenThereIsNoPorttoolOrItEnds) {
    EXPECT_THAT(DriftPanel("", folder.string(), log).standing(), testing::HasSubstr("there is no porttool"));
    DriftPanel missing("/nonexistent/porttool", folder.string(), log);
    missing.update();
    EXPECT_THAT(missing.standing(), testing::HasSubstr("/nonexistent/porttool could not be started"));
    std::filesystem::remove(folder / "portmap.lock");
    DriftPanel ended(porttool, folder.string(), log);
    EXPECT_TRUE(until(ended, [&] { return ended.standing().find("porttool init") != std::string::npos; }))
        << ended.standing();
}

}  // namespace
}  // namespace view_test
}  // namespace application
