// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// A scene that plays while a user edits it shows, at each time, what it would show had it been loaded, brought to that
// time at once and edited then. Edits are of what no animation moves; everything between a glTF file and the pixels
// takes part: skins, morphs, nodes that are scaled to nothing, pointers, removals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <random>
#include <vector>

#include "render_system/camera.h"
#include "render_system/render_system.h"
#include "render_system/texture.h"
#include "target_core/render_core.h"
#include "tests/render_system/gltf_file.h"

namespace render_system::testing::scene_edits_test {
namespace {

using nlohmann::json;
using Floats = std::vector<float>;

constexpr uint32_t WIDTH = 32, HEIGHT = 24;
constexpr double DURATION = 2;

// The numbers of the file's meshes and materials. One material, one light and the deforming meshes are animated.
enum Mesh : uint32_t { PLAIN, GLOWING, BENDING, SKINNED };
enum Material : uint32_t { MOVING, GLOW, STILL };

class AnimatedFile {
public:
    GltfFile file;

    AnimatedFile() {
        const int texture = file.add_texture(png_uri(2, 1, 3, {255, 64, 64, 64, 255, 64}));
        file.add_material({{"pbrMetallicRoughness", {{"metallicFactor", 0}}}});
        file.add_material({{"emissiveFactor", {1, 1, 0.5}}});
        file.add_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}}}}}});
        file.add_mesh(quad(STILL));
        file.add_mesh(quad(GLOW));
        json bending = quad(MOVING);
        bending["targets"] = {
            {{"POSITION", file.add(std::vector<glm::vec3>{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, {1, 0, 0}})}}};
        file.add_mesh(bending);
        json skinned = quad(STILL);
        skinned["attributes"]["JOINTS_0"] = file.add_accessor(
            file.add_view(std::vector<uint8_t>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}), UBYTE, "VEC4", 4);
        skinned["attributes"]["WEIGHTS_0"] =
            file.add(std::vector<glm::vec4>{{1, 0, 0, 0}, {0, 1, 0, 0}, {0.5, 0.5, 0, 0}, {0.25, 0.75, 0, 0}});
        file.add_mesh(skinned);
        add_nodes();
        add_animation();
    }

private:
    json quad(Material material) {
        return {{"attributes",
                 {{"POSITION", file.add(std::vector<glm::vec3>{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}})},
                  {"NORMAL", file.add(std::vector<glm::vec3>(4, glm::vec3(0, 0, 1)))},
                  {"TEXCOORD_0", file.add(std::vector<glm::vec2>{{0, 1}, {1, 1}, {1, 0}, {0, 0}})}}},
                {"indices", file.add(std::vector<uint16_t>{0, 1, 2, 0, 2, 3})},
                {"material", material}};
    }

    void add_nodes() {
        file.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 20}}};
        file.add_node({{"mesh", PLAIN}, {"translation", {-1, 0, -2}}});   // 0 wanders
        file.add_node({{"mesh", GLOWING}, {"translation", {2, 1, -1}}});  // 1 vanishes
        file.add_node({{"mesh", BENDING}, {"translation", {0, -1, 0}}});  // 2 bends
        file.add_node({{"mesh", SKINNED}, {"skin", 0}});                  // 3
        file.add_node({{"translation", {0, 1, 1}}});                      // 4 a joint
        file.add_node({{"translation", {0, 0, 1}}});                      // 5 a joint
        file.add_node({{"translation", {1, 2, 3}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});  // 6
        file.add_node({{"mesh", PLAIN}, {"scale", {4, 4, 1}}, {"translation", {0, 0, -4}}});  // 7 still
        file.root["skins"] = {{{"joints", {4, 5}}}};
    }

    void add_animation() {
        file.root["animations"] = {{{"channels", json::array()}, {"samplers", json::array()}}};
        const float h = std::sqrt(0.5f);
        move(node(0, "translation"), "VEC3", 3, {-1, 0, -2, 1, 0, -2, -1, 1, 0});
        move(node(1, "scale"), "VEC3", 3, {1, 1, 1, 0, 0, 0, 1, 1, 1}, "STEP");
        move(node(2, "weights"), "SCALAR", 1, {0, 1, 0.5});
        move(node(5, "rotation"), "VEC4", 4, {0, 0, 0, 1, 0, h, 0, h, 0, 0, 0, 1});
        move(pointer("/materials/0/pbrMetallicRoughness/baseColorFactor"), "VEC4", 4,
             {1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1});
        move(pointer("/extensions/KHR_lights_punctual/lights/0/intensity"), "SCALAR", 1, {20, 0, 30});
    }

    static json node(int number, const char* path) { return {{"node", number}, {"path", path}}; }
    static json pointer(const char* text) {
        return {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", text}}}}}};
    }

    void move(const json& target, const char* type, size_t width, const Floats& values,
              const char* interpolation = "LINEAR") {
        const auto add = [&](const Floats& floats, const char* kind, size_t each) {
            return file.add_accessor(file.add_view(floats), FLOAT, kind, floats.size() / each);
        };
        json& animation = file.root["animations"][0];
        animation["channels"].push_back({{"sampler", animation["samplers"].size()}, {"target", target}});
        animation["samplers"].push_back({{"input", add({0, DURATION / 2, DURATION}, "SCALAR", 1)},
                                         {"output", add(values, type, width)},
                                         {"interpolation", interpolation}});
    }
};

/// Edits a scene; answers whether it let itself be edited.
using Edit = std::function<bool(HostScene&)>;

/// Makes up edits that a scene must take, knowing what has been removed from it.
class Editor {
public:
    explicit Editor(uint32_t seed) : random_(seed) {}

    /// What is done next to `scene`, which is as the last edit left it.
    Edit next(const HostScene& scene) {
        switch (below(13)) {
            case 0:
                return turn_material(scene);
            case 1:
                return place_still_node();
            case 2:
            case 3:
                return show_another(scene);
            case 4:
                return add_instance(scene);
            case 5:
                return move_added(scene);
            case 6:
                return add_mesh();
            case 7:
                return reshape(scene);
            case 8:
                return add_material();
            case 9:
                return remove(scene);
            case 10:
                return light(scene);
            case 11:
                return sky();
            default:
                return paint(scene);
        }
    }

private:
    uint32_t below(size_t count) { return static_cast<uint32_t>(random_() % count); }
    float unit() { return static_cast<float>(below(1024)) / 1024; }
    glm::vec3 somewhere() { return {4 * unit() - 2, 4 * unit() - 2, 4 * unit() - 2}; }

    CoreTransform place() {
        return core_transform(glm::dmat4(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 1 + unit(), 0, 0),
                                         glm::dvec4(unit(), 0, 1, 0), glm::dvec4(somewhere(), 1)));
    }

    CoreMaterial material(const HostScene& scene) {
        CoreMaterial out;
        out.base_color = glm::vec3(unit(), unit(), unit());
        out.metallic = unit();
        out.roughness = unit();
        if (below(3) == 0) out.emission = glm::vec3(unit());
        if (below(2) == 0 && !scene.textures().empty() && has_texture_) out.base_color_texture.texture = 0;
        return out;
    }

    /// A mesh with triangles of a material that is there.
    HostMesh mesh(uint32_t material) {
        HostMesh out;
        for (int i = 0; i < 3; ++i) out.positions.push_back(somewhere());
        out.normals.assign(3, glm::vec3(0, 0, 1));
        out.triangles = {{0, 1, 2, material}};
        return out;
    }

    uint32_t some_material(const HostScene& scene) {
        uint32_t id = below(scene.materials().size());
        while (scene.is_removed_material(id)) id = below(scene.materials().size());
        return id;
    }

    Edit turn_material(const HostScene& scene) {
        const uint32_t id = 1 + below(scene.materials().size() - 1);  // 0 is animated; one that was removed comes back
        return [id, core = material(scene)](HostScene& edited) { return edited.set_material(id, core), true; };
    }

    Edit place_still_node() {
        const uint32_t id = still_nodes_[below(std::size(still_nodes_))];
        const glm::dmat4 local(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 1, 0, 0), glm::dvec4(0, 0, 1, 0),
                               glm::dvec4(somewhere(), 1));
        return [id, local](HostScene& edited) { return edited.set_node_transform(id, local), true; };
    }

    /// One that was removed comes back: no node carries it any more, so it is put somewhere, too.
    Edit show_another(const HostScene& scene) {
        const uint32_t id = below(scene.instances().size());
        const uint32_t mesh = below(4) == 0 ? NONE : some_mesh(scene);
        if (is_carried(scene, id))
            return [id, mesh](HostScene& edited) { return edited.set_instance_mesh(id, mesh), true; };
        return [id, mesh, to = place()](HostScene& edited) {
            edited.set_instance_mesh(id, mesh);
            edited.set_instance_transform(id, to);
            return true;
        };
    }

    static bool is_carried(const HostScene& scene, uint32_t instance) {
        const std::vector<HostNode>& nodes = scene.nodes();
        return std::any_of(nodes.begin(), nodes.end(), [&](const HostNode& node) { return node.instance == instance; });
    }

    uint32_t some_mesh(const HostScene& scene) {
        uint32_t id = below(scene.meshes().size());
        while (scene.meshes()[id].triangles.empty()) id = below(scene.meshes().size());
        return id;
    }

    Edit add_instance(const HostScene& scene) {
        return
            [mesh = some_mesh(scene), to = place()](HostScene& edited) { return edited.add_instance(mesh, to), true; };
    }

    /// Of the instances that no node carries: those that came later, and the skinned one.
    Edit move_added(const HostScene& scene) {
        uint32_t id = below(scene.instances().size());
        while (is_carried(scene, id)) id = below(scene.instances().size());
        return [id, to = place()](HostScene& edited) { return edited.set_instance_transform(id, to), true; };
    }

    Edit add_mesh() {
        return [mesh = mesh(STILL)](HostScene& edited) { return edited.add_mesh(mesh), true; };
    }

    /// A mesh gets other triangles, which nothing deforms; one that was removed comes back.
    Edit reshape(const HostScene& scene) {
        const uint32_t id = below(scene.meshes().size());
        return [id, mesh = mesh(some_material(scene))](HostScene& edited) { return edited.set_mesh(id, mesh), true; };
    }

    Edit add_material() {
        HostMaterial made;
        made.core.base_color = glm::vec3(unit());
        return [made](HostScene& edited) { return edited.add_material(made), true; };
    }

    /// Whether it can be removed depends on what uses it, and the scene's answer must not depend on the time. What
    /// animations move stays, and so does the material that new meshes take.
    Edit remove(const HostScene& scene) {
        const uint32_t instance = below(scene.instances().size()), mesh = below(scene.meshes().size());
        const uint32_t material = below(scene.materials().size());
        switch (below(4)) {
            case 0:
                return [instance](HostScene& edited) { return edited.remove_instance(instance).ok(); };
            case 1:
                return [mesh](HostScene& edited) { return edited.remove_mesh(mesh).ok(); };
            case 2:
                if (material == MOVING || material == STILL) return place_still_node();
                return [material](HostScene& edited) { return edited.remove_material(material).ok(); };
            default:
                return [this](HostScene& edited) {
                    const bool removed = edited.remove_texture(0).ok();
                    has_texture_ = has_texture_ && !removed;
                    return removed;
                };
        }
    }

    Edit light(const HostScene& scene) {
        PunctualLight made;
        made.kind = below(2) == 0 ? LightKind::point : LightKind::directional;
        made.position = somewhere();
        made.emission = glm::vec3(5 * unit());
        const uint32_t id = below(scene.punctual_lights().size());
        if (id == 0) return [made](HostScene& edited) { return edited.add_punctual_light(made), true; };
        if (below(3) == 0) return [id](HostScene& edited) { return edited.remove_punctual_light(id).ok(); };
        return [id, made](HostScene& edited) { return edited.set_punctual_light(id, made), true; };
    }

    Edit sky() {
        Sky made;
        made.radiance = glm::vec3(unit(), unit(), unit());
        if (below(2) == 0) {
            made.width = 4;
            made.height = 2;
            for (int i = 0; i < 8; ++i) made.texels.emplace_back(unit(), unit(), unit(), 1);
        }
        return [made](HostScene& edited) { return edited.set_sky(made), true; };
    }

    Edit paint(const HostScene& scene) {
        Image image;
        image.width = image.height = 1;
        image.bytes = {0xFF000000u | below(1u << 24)};
        if (scene.textures().empty()) return sky();
        has_texture_ = true;
        return [texture = build_texture(image, TextureRole::color)](HostScene& edited) {
            return edited.set_texture(0, texture), true;
        };
    }

    std::mt19937 random_;
    bool has_texture_ = true;
    static constexpr uint32_t still_nodes_[] = {3, 4, 6, 7};
};

/// A scene on a core of its own.
class Stage {
public:
    Stage(const HostScene& scene, bool exact) : system_(scene) {
        std::unique_ptr<CoreAPI> core = target_core::create_core();
        CoreOptions options;
        options.exact = exact;
        expect_ok(core->Init(options));
        system_.use_core(std::move(core));
        expect_ok(system_.core().SetTarget({WIDTH, HEIGHT, pixels_}));
        expect_ok(system_.core().Setting({}));
    }

    HostScene& scene() { return system_.scene(); }

    const std::vector<glm::vec4>& picture() {
        const Camera camera = look_at({0, 1, 8}, {0, 0, 0}, {0, 1, 0}, 0.7f);
        expect_ok(system_.render(view_pyramid(camera, WIDTH, HEIGHT), Convergence::Restart, 2));
        return pixels_;
    }

private:
    static void expect_ok(const Status& status) { ASSERT_TRUE(status.ok()) << status.message; }

    std::vector<glm::vec4> pixels_ = std::vector<glm::vec4>(size_t{WIDTH} * HEIGHT);
    RenderSystem system_;
};

class SceneEdits : public ::testing::TestWithParam<uint32_t> {};

TEST_P(SceneEdits, ShowWhatTheyWouldHadTheSceneBeenBroughtToThatTimeAtOnce) {
    const HostScene as_loaded = loaded(AnimatedFile().file);
    const char* const wanted = std::getenv("EDITS");
    const int steps = wanted ? std::atoi(wanted) : 120;
    std::mt19937 random(GetParam());
    Editor editor(GetParam());
    const bool exact = GetParam() % 2 == 0;
    Stage stage(as_loaded, exact);
    std::vector<Edit> edits;
    std::vector<bool> taken;
    double time = 0;
    for (int step = 1; step <= steps; ++step) {
        edits.push_back(editor.next(stage.scene()));
        taken.push_back(edits.back()(stage.scene()));
        if (random() % 2 == 0) {
            time = DURATION * static_cast<double>(random() % 9) / 8;
            ASSERT_TRUE(stage.scene().play(time).ok());
        }
        if (random() % 3 == 0) stage.picture();
        if (step % std::max(1, steps / 6) != 0) continue;
        Stage at_once(as_loaded, exact);
        ASSERT_TRUE(at_once.scene().play(time).ok());
        for (size_t i = 0; i < edits.size(); ++i)
            ASSERT_EQ(edits[i](at_once.scene()), taken[i]) << "edit " << i + 1 << " after " << step << " steps";
        ASSERT_EQ(at_once.picture(), stage.picture()) << "after " << step << " steps, at " << time << " s";
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, SceneEdits, ::testing::Range(1u, 9u));

}  // namespace
}  // namespace render_system::testing::scene_edits_test
