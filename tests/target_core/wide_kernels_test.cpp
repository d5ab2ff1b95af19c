// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The kernel text runs eight and sixteen paths at a time, unchanged and with the bits of the one-lane build.
#include <gtest/gtest.h>
#include <sys/mman.h>

#include <cmath>
#include <cstring>

#include "target_core/core_mesh.h"
#include "target_core/core_tables.h"
#include "target_core/device/bindings.h"
#include "target_core/device/embree_callbacks.h"
#include "target_core/device/embree_scene.h"
#include "target_core/device/float_mode.h"
#include "target_core/device/kernel_table.h"
#include "target_core/device/surface_order.h"
#include "target_core/kernels/trace.h"

using namespace target_core;

namespace {

// A bumpy, textured, coloured sheet of many materials under a light and a sky map: every branch of shade.
class WideKernelsScene : public testing::Test {
protected:
    void SetUp() override {
        make_textures();
        make_materials();
        make_lights();
        std::string message;
        ASSERT_TRUE(embree_.open(1, message)) << message;
        set_sheet(0, 0, 24);
        meshes_.set_instance(0, 0, {});
        build();
    }
    void TearDown() override { bound = {}; }

    void build() {
        meshes_.place(materials_);
        std::string message;
        ASSERT_TRUE(embree_.build(meshes_.geometry(), false, false, message)) << message;
        make_frame();
    }

    void make_textures() {
        constexpr uint kTexels = 64 + 16 + 4 + 1;
        for (uint i = 0; i < 2 * kTexels; ++i) {
            texels_.push_back(0xFF000000u | ((i * 2654435761u) >> 8));
        }
        render_system::CoreTexture texture;
        texture.width = 8;
        texture.height = 8;
        texture.levels = 4;
        texture.texels = std::span(texels_).first(kTexels);
        render_system::CoreTexture curved = texture;
        curved.format = render_system::TexelFormat::rgba8_srgb;
        curved.wrap_s = render_system::TextureWrap::mirrored_repeat;
        render_system::CoreTexture deep = texture;
        deep.format = render_system::TexelFormat::rgba16_srgb;
        deep.texels = texels_;
        render_system::CoreTexture textures[] = {texture, curved, deep};
        pack_textures(textures, tables_);
    }

    void make_materials() {
        for (uint i = 0; i < 24; ++i) {
            render_system::CoreMaterial material;
            material.base_color = {0.9f, 0.2f + 0.03f * static_cast<float>(i), 0.5f};
            material.metallic = i % 3 == 0 ? 1.0f : 0.1f * static_cast<float>(i % 4);
            material.roughness = 0.25f * static_cast<float>(i % 5);
            material.transmission = i % 4 == 1 ? 0.7f : 0.0f;
            material.thin_walled = i % 8 != 1;
            material.absorption = glm::vec3(0.1f, 0.4f, 0.0f) * static_cast<float>(i % 3);
            material.emission = glm::vec3(i % 7 == 0 ? 0.5f : 0.0f);
            material.emission_weight = material.emission.x;
            material.double_sided = i % 2 == 0;
            material.base_color_texture.texture = i % 2 == 0 ? 1 + i / 2 % 2 : render_system::NONE;
            material.normal_texture.texture = i % 3 == 1 ? 0 : render_system::NONE;
            material.metallic_roughness_texture.texture = i % 5 == 2 ? 0 : render_system::NONE;
            material.metallic_roughness_texture.uv_set = 1;
            material.emission_texture.texture = i % 14 == 0 ? 1 : render_system::NONE;
            material.sheen_color = glm::vec3(i % 6 == 2 ? 0.6f : 0.0f);
            material.sheen_roughness = 0.1f * static_cast<float>(i % 9);
            material.sheen_color_texture.texture = i % 12 == 2 ? 1 : render_system::NONE;
            material.sheen_roughness_texture.texture = i % 12 == 2 ? 0 : render_system::NONE;
            material.film = i % 4 == 3 ? 0.7f : 0.0f;
            material.film_texture.texture = i % 8 == 3 ? 0 : render_system::NONE;
            material.film_thickness_texture.texture = i % 8 == 7 ? 0 : render_system::NONE;
            material.base_color_texture.uv_set = i % 4;
            material.coat = i % 5 == 3 ? 0.8f : 0.0f;
            material.coat_roughness = 0.08f * static_cast<float>(i % 9);
            material.coat_texture.texture = i % 10 == 3 ? 0 : render_system::NONE;
            material.coat_roughness_texture.texture = i % 10 == 3 ? 0 : render_system::NONE;
            material.coat_normal_texture.texture = i % 10 == 8 ? 0 : render_system::NONE;
            material.anisotropy = i % 5 == 1 ? 0.6f : 0.0f;
            material.anisotropy_rotation = 0.3f * static_cast<float>(i);
            material.anisotropy_texture.texture = i % 10 == 1 ? 0 : render_system::NONE;
            materials_.push_back(material);
        }
        // Tables of stretched lobes behind glass take a second: all tests have those of the first.
        static const render_system::LobeEnergy energies = [this] {
            SceneTables first;
            pack_materials(materials_, first);
            return first.energies;
        }();
        tables_.energies = energies;
        pack_materials(materials_, tables_);
    }

    void make_lights() {
        render_system::CoreLight triangle;
        triangle.kind = render_system::LightKind::triangle;
        triangle.vertices[0] = {-1, 3, -1};
        triangle.vertices[1] = {1, 3, -1};
        triangle.vertices[2] = {0, 3, 1};
        triangle.emission = glm::vec3(7.0f);
        triangle.emission_texture.texture = 1;
        triangle.uv[1] = {1, 0};
        triangle.uv[2] = {0, 1};
        render_system::CoreLight spot;
        spot.kind = render_system::LightKind::spot;
        spot.vertices[0] = {1, 2, 0};
        spot.direction = {0, -1, 0};
        spot.emission = glm::vec3(3.0f);
        spot.spot_scale = 2.0f;
        spot.spot_offset = -0.5f;
        render_system::CoreLight sky;
        sky.kind = render_system::LightKind::sky;
        lights_ = {triangle, spot, sky};
        light_table_ = {{0.9f, 2, 0.3f}, {0.5f, 2, 0.2f}, {1.0f, 0, 0.5f}};
        render_system::CoreLights lights{lights_, light_table_, 10.0f};
        pack_lights(lights, tables_);
        light_features_ = light_features(lights);
        for (uint i = 0; i < 32; ++i) {
            sky_texels_.push_back(glm::vec4(0.1f * static_cast<float>(i), 0.5f, 1.0f, 1.0f));
            sky_table_.push_back({0.5f, (i * 7) % 32, 1.0f / 32.0f});
        }
        pack_sky({glm::vec3(0.0f), 8, 4, sky_texels_, sky_table_, 0.5f}, tables_);
    }

    // A mesh whose triangles have the materials from `first` on.
    void set_sheet(uint mesh, uint first, uint material_count) {
        constexpr uint N = 20;
        std::vector<glm::vec3> positions, normals;
        std::vector<glm::vec4> tangents;
        std::vector<glm::vec2> uv, turned;
        std::vector<glm::vec4> colors;
        std::vector<glm::uvec4> triangles;
        for (uint i = 0; i < N * N; ++i) {
            float x = static_cast<float>(i % N) * 0.2f - 2.0f;
            float z = static_cast<float>(i / N) * 0.2f - 2.0f;
            positions.push_back({x, 0.3f * std::sin(3.0f * x) * std::cos(2.0f * z), z});
            normals.push_back(glm::normalize(glm::vec3(-0.5f * std::cos(3.0f * x), 1.0f, 0.3f * std::sin(2.0f * z))));
            tangents.push_back({1, 0, 0, i % 2 == 0 ? 1.0f : -1.0f});
            uv.push_back({x * 1.7f, z * 0.9f});
            turned.push_back({z * 0.7f, x * 1.3f});
            colors.push_back(
                {0.5f + 0.1f * static_cast<float>(i % 5), 0.9f, 0.51f + 0.07f * static_cast<float>(i % 7), 1.0f});
        }
        for (uint i = 0; i + N < N * N; ++i) {
            if (i % N + 1 < N) {
                triangles.push_back({i, i + N, i + 1, first + i % material_count});
                triangles.push_back({i + 1, i + N, i + N + 1, first + (i * 5) % material_count});
            }
        }
        meshes_.set_mesh(mesh, {positions, normals, tangents, uv, uv, turned, uv, colors, triangles});
    }

    void make_frame() {
        settings_.eye = target_core::vec4(0.0f, 2.5f, 4.0f, 0.02f);
        settings_.screen = target_core::vec4(-1.0f, 0.2f, -1.5f, 0.0f);
        settings_.screen_right = target_core::vec4(2.0f, 0.0f, 0.0f, 0.0f);
        settings_.screen_down = target_core::vec4(0.0f, -1.6f, 0.0f, 0.0f);
        settings_.width = 32;
        settings_.height = 32;
        settings_.max_path_length = 8;
        settings_.russian_roulette = 1;
        settings_.next_event_estimation = 1;
        settings_.light_count = 3;
        settings_.sky_width = 8;
        settings_.sky_height = 4;
        settings_.sky_light_probability = 0.5f;
        settings_.light_weight_scale = 0.1f;
        settings_.features = material_features(materials_) | tables_.texture_features | light_features_ |
                             meshes_.features(materials_) | FEATURE_SKY_MAP;
        pass_.path_count = TILE_PATHS;
        bindings_.mesh_triangles = meshes_.mesh_triangles().data();
        bindings_.vertices = meshes_.vertices().data();
        bindings_.instances = meshes_.instances().data();
        bindings_.materials = tables_.materials.data();
        bindings_.texture_slots = tables_.texture_slots.data();
        bindings_.textures = tables_.textures.data();
        bindings_.texels = tables_.texels.data();
        bindings_.lights = tables_.lights.data();
        bindings_.light_table = tables_.light_table.data();
        bindings_.sky_texels = tables_.sky_texels.data();
        bindings_.sky_table = tables_.sky_table.data();
        bindings_.lobe_energy = tables_.lobe_energy.data();
        opacities_.clear();
        for (const render_system::CoreMaterial& material : materials_) {
            opacities_.push_back(opacity_code(material, meshes_.has_colors()));
        }
        bindings_.opacities = opacities_.data();
        bindings_.geometry = meshes_.geometry().data();
        bindings_.scene = embree_.scene();
    }

    void use(Tile& tile) {
        bound = bindings_;
        bound.tile = &tile;
        settings = settings_;
        pass = pass_;
    }

    template <class Row>
    static bool same_bits(const TileRows<Row>& a, const TileRows<Row>& b, uint count = TILE_PATHS) {
        return std::memcmp(a.get(), b.get(), count * sizeof(Row)) == 0;
    }

    static void copy_state(const Tile& from, Tile& to) {
        std::copy_n(from.origin.get(), TILE_PATHS, to.origin.get());
        std::copy_n(from.direction.get(), TILE_PATHS, to.direction.get());
        std::copy_n(from.throughput.get(), TILE_PATHS, to.throughput.get());
        std::copy_n(from.radiance.get(), TILE_PATHS, to.radiance.get());
        std::copy_n(from.surfaces.get(), TILE_PATHS, to.surfaces.get());
        to.surface_count = from.surface_count;
        std::copy_n(from.current.paths.get(), TILE_PATHS, to.current.paths.get());
        to.current.count = from.current.count;
    }

    static void copy_shadow_rays(const Tile& from, Tile& to) {
        std::copy_n(from.shadow_origin.get(), TILE_PATHS, to.shadow_origin.get());
        std::copy_n(from.shadow_direction.get(), TILE_PATHS, to.shadow_direction.get());
        std::copy_n(from.shadow_contribution.get(), TILE_PATHS, to.shadow_contribution.get());
        to.shadow_count = from.shadow_count;
    }

    std::vector<uint32_t> texels_;
    std::vector<render_system::CoreMaterial> materials_;
    std::vector<render_system::CoreLight> lights_;
    std::vector<render_system::AliasEntry> light_table_;
    std::vector<glm::vec4> sky_texels_;
    std::vector<render_system::AliasEntry> sky_table_;
    uint light_features_ = 0;
    SceneTables tables_;
    std::vector<float> opacities_;
    CoreMeshes meshes_;
    EmbreeScene embree_;
    Settings settings_{};
    Pass pass_{};
    Bindings bindings_;
};

class WideKernels : public WideKernelsScene, public testing::WithParamInterface<uint> {
protected:
    void SetUp() override {
        if (GetParam() + 1 >= runnable_.count) {
            GTEST_SKIP() << "this CPU has fewer kinds of lanes";
        }
        WideKernelsScene::SetUp();
    }
    const KernelTable& lanes() const { return *runnable_.tables[GetParam()]; }

    /// How many surfaces of the two tiles are the same, place by place.
    static uint same_surfaces(const Tile& a, const Tile& b) {
        uint same = 0;
        for (uint i = 0; i < a.surface_count; ++i) {
            same += std::memcmp(&a.surfaces[i], &b.surfaces[i], sizeof(a.surfaces[i])) == 0 ? 1 : 0;
        }
        return same;
    }

    // What one sample leaves behind after each kernel. Hits come from the one-lane walk, so that ties between
    // coincident triangles do not hide a fault of the lanes.
    void expect_bits_of_one_lane() {
        SCOPED_TRACE(lanes().name);
        // A count that leaves lanes of the last job idle.
        pass_.path_count = TILE_PATHS - 21;
        Tile one;
        Tile wide;
        use(wide);
        lanes().generate();
        use(one);
        one_lane_kernels.generate();
        ASSERT_EQ(one.next.count, wide.next.count);
        ASSERT_TRUE(same_bits(one.next.paths, wide.next.paths, one.next.count));
        ASSERT_TRUE(same_bits(one.origin, wide.origin));
        ASSERT_TRUE(same_bits(one.direction, wide.direction));
        for (uint segment = 1; segment <= 3; ++segment) {
            SCOPED_TRACE("segment " + std::to_string(segment));
            pass_.segment = segment;
            std::swap(one.current, one.next);
            one.next.count = 0;
            one.surface_count = 0;
            one.shadow_count = 0;
            ASSERT_GT(one.current.count, 0u);
            use(one);
            one_lane_kernels.extend();
            copy_state(one, wide);
            wide.next.count = 0;
            wide.shadow_count = 0;
            one_lane_kernels.shade();
            use(wide);
            lanes().shade();
            ASSERT_EQ(one.next.count, wide.next.count);
            ASSERT_EQ(one.shadow_count, wide.shadow_count);
            EXPECT_GT(one.shadow_count, 0u);
            EXPECT_TRUE(same_bits(one.next.paths, wide.next.paths, one.next.count));
            EXPECT_TRUE(same_bits(one.origin, wide.origin));
            EXPECT_TRUE(same_bits(one.direction, wide.direction));
            EXPECT_TRUE(same_bits(one.throughput, wide.throughput));
            EXPECT_TRUE(same_bits(one.radiance, wide.radiance));
            EXPECT_TRUE(same_bits(one.shadow_origin, wide.shadow_origin, one.shadow_count));
            EXPECT_TRUE(same_bits(one.shadow_direction, wide.shadow_direction, one.shadow_count));
            EXPECT_TRUE(same_bits(one.shadow_contribution, wide.shadow_contribution, one.shadow_count));
            use(one);
            one_lane_kernels.connect();
            use(wide);
            lanes().connect();
            EXPECT_TRUE(same_bits(one.radiance, wide.radiance));
        }
        auto finish = [&](Tile& tile, const KernelTable& table) {
            std::vector<target_core::vec4> sum(TILE_PATHS, target_core::vec4(0.25f));
            use(tile);
            bound.accumulator = sum.data();
            pass.sample_scale = 0.5f;
            table.finalize();
            return sum;
        };
        const std::vector<target_core::vec4> sum = finish(one, one_lane_kernels);
        EXPECT_EQ(std::memcmp(sum.data(), finish(wide, lanes()).data(), TILE_PATHS * sizeof(sum[0])), 0);
        EXPECT_TRUE(same_bits(one.target, wide.target));
    }

private:
    const KernelTables runnable_ = runnable_kernels();
};

TEST_P(WideKernels, GiveTheBitsOfOneLane) { expect_bits_of_one_lane(); }

TEST_P(WideKernels, GiveTheBitsOfOneLaneInScenesWithoutLobes) {
    ASSERT_NE(settings_.features & LOBE_FEATURES, 0u);
    settings_.features &= ~LOBE_FEATURES;
    expect_bits_of_one_lane();
}

TEST_P(WideKernels, GiveTheBitsOfOneLaneWhereAllLanesWantTheSameRows) {
    for (uint material : {4u, 9u, 13u, 14u}) {
        SCOPED_TRACE("material " + std::to_string(material));
        set_sheet(0, material, 1);
        build();
        expect_bits_of_one_lane();
    }
}

// Two instances of one mesh stay in mesh space, one of them mirrored; a third, of a mesh of its own, is in world space.
TEST_P(WideKernels, GiveTheBitsOfOneLaneOnInstances) {
    set_sheet(1, 5, 3);
    render_system::CoreTransform left;
    left.rows[0] = {-0.6f, 0.1f, 0.0f, -1.3f};
    left.rows[1] = {0.0f, 1.1f, 0.2f, -0.2f};
    left.rows[2] = {0.1f, 0.0f, 0.9f, 0.3f};
    render_system::CoreTransform right;
    right.rows[0] = {0.5f, 0.0f, 0.0f, 1.2f};
    right.rows[1] = {0.0f, 0.8f, 0.0f, 0.1f};
    right.rows[2] = {0.0f, -0.3f, 1.0f, 0.0f};
    render_system::CoreTransform below;
    below.rows[1].w = -0.7f;
    meshes_.set_instance(0, 0, left);
    meshes_.set_instance(1, 0, right);
    meshes_.set_instance(2, 1, below);
    build();
    ASSERT_NE(settings_.features & FEATURE_INSTANCES, 0u);
    expect_bits_of_one_lane();
}

// Each ray decides for itself which triangles let it through: by a constant, a texture's alpha or vertex colours.
TEST_P(WideKernels, DecideAboutAlphaAsOneLaneDoes) {
    for (render_system::CoreMaterial& material : materials_) {
        material.opaque = false;
        material.alpha = 0.5f;
    }
    pack_materials(materials_, tables_);
    set_sheet(1, 5, 3);
    render_system::CoreTransform below;
    below.rows[1].w = -0.7f;
    render_system::CoreTransform lower;
    lower.rows[1].w = -1.1f;
    meshes_.set_instance(1, 1, below);
    meshes_.set_instance(2, 1, lower);
    build();
    ASSERT_NE(settings_.features & FEATURE_ALPHA, 0u);
    pass_.path_count = TILE_PATHS - 5;
    Tile one;
    Tile wide;
    use(one);
    one_lane_kernels.generate();
    uint passed = 0;
    for (uint segment = 1; segment <= 3; ++segment) {
        SCOPED_TRACE("segment " + std::to_string(segment));
        pass_.segment = segment;
        std::swap(one.current, one.next);
        one.next.count = one.surface_count = one.shadow_count = 0;
        copy_state(one, wide);
        use(wide);
        lanes().extend();
        use(one);
        one_lane_kernels.extend();
        ASSERT_EQ(one.surface_count, wide.surface_count);
        EXPECT_GT(one.surface_count, one.current.count / 16);
        EXPECT_GE(same_surfaces(one, wide) + 2, one.surface_count);
        for (uint i = 0; i < one.surface_count; ++i) passed += one.surfaces[i].y != 0 ? 1 : 0;
        one_lane_kernels.shade();
        copy_state(one, wide);
        copy_shadow_rays(one, wide);
        one_lane_kernels.connect();
        use(wide);
        lanes().connect();
        EXPECT_TRUE(same_bits(one.radiance, wide.radiance));
    }
    EXPECT_GT(passed, 100u) << "of the upper sheet";
}

// Embree may flush denormals while it walks camera rays; the kernels after it must not.
TEST_P(WideKernels, LeaveTheFloatModeAsItWas) {
    Tile tile;
    use(tile);
    KeepDenormals keep;
    const unsigned before = _mm_getcsr();
    lanes().generate();
    std::swap(tile.current, tile.next);
    for (uint segment : {1u, 2u}) {
        pass.segment = segment;
        tile.surface_count = 0;
        lanes().extend();
        EXPECT_EQ(_mm_getcsr() & 0x8040u, before & 0x8040u) << "segment " << segment;
    }
    EXPECT_EQ(before & 0x8040u, 0u);
}

// Packets of rays meet what single rays meet: the same triangles at the same places, but for ties.
TEST_P(WideKernels, TraceWhatOneLaneTraces) {
    pass_.path_count = TILE_PATHS - 5;
    Tile one;
    Tile wide;
    for (Tile* tile : {&one, &wide}) {
        use(*tile);
        one_lane_kernels.generate();
        std::swap(tile->current, tile->next);
        pass.segment = 1;
        (tile == &one ? one_lane_kernels : lanes()).extend();
    }
    ASSERT_EQ(one.surface_count, wide.surface_count);
    EXPECT_GT(one.surface_count, pass_.path_count / 4);
    EXPECT_GE(same_surfaces(one, wide), one.surface_count - 2);
    // What meets nothing ends in the sky.
    EXPECT_LT(one.surface_count, pass_.path_count);
    EXPECT_TRUE(same_bits(one.radiance, wide.radiance));
}

// Rows and columns of any pixel of a picture of any width: the lanes divide words as one lane does.
TEST_P(WideKernels, GenerateDividesAnyPixelByAnyWidth) {
    for (uint width : {1u, 3u, 641u, 65535u, 65537u, 0x7FFFFFFFu, 0xFFFFFFFEu, 0xFFFFFFFFu}) {
        for (uint first : {0u, 0x7FFFF800u, 0x80000000u, 0xFFFFFFFFu - TILE_PATHS}) {
            SCOPED_TRACE(std::to_string(first) + " by " + std::to_string(width));
            settings_.width = width;
            pass_.first_pixel = first;
            pass_.path_count = TILE_PATHS - 3;
            Tile one;
            Tile wide;
            use(one);
            one_lane_kernels.generate();
            use(wide);
            lanes().generate();
            EXPECT_TRUE(same_bits(one.direction, wide.direction, pass_.path_count));
        }
    }
}

// Rays that left a surface and meet nothing get the sky, weighted against the sky's own sampling.
TEST_P(WideKernels, ExtendEndsBouncesInTheSkyAsOneLaneDoes) {
    pass_.path_count = TILE_PATHS - 5;
    Tile one;
    Tile wide;
    use(one);
    one_lane_kernels.generate();
    std::swap(one.current, one.next);
    one.next.count = 0;
    pass.segment = 1;
    one_lane_kernels.extend();
    one_lane_kernels.shade();
    std::swap(one.current, one.next);
    one.surface_count = 0;
    ASSERT_NE(one.current.count % 16, 0u);
    copy_state(one, wide);
    pass_.segment = 2;
    use(one);
    one_lane_kernels.extend();
    use(wide);
    lanes().extend();
    EXPECT_LT(one.surface_count, one.current.count);
    ASSERT_EQ(one.surface_count, wide.surface_count);
    EXPECT_TRUE(same_bits(one.radiance, wide.radiance));
    EXPECT_GE(same_surfaces(one, wide) + 2, one.surface_count);
}

// The rows of a tile end where memory does: a lane that reads or writes past the spare rows stops the test.
template <class Row>
void move_to_the_edge(TileRows<Row>& rows, std::vector<std::pair<void*, size_t>>& maps) {
    size_t bytes = (TILE_PATHS + SPARE_ROWS) * sizeof(Row);
    size_t room = (bytes + 4095) / 4096 * 4096;
    char* at =
        static_cast<char*>(mmap(nullptr, room + 4096, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    mprotect(at + room, 4096, PROT_NONE);
    rows.rows.reset(reinterpret_cast<Row*>(at + room - bytes));
    maps.push_back({at, room + 4096});
}

TEST_P(WideKernels, StayInsideTheTile) {
    for (uint count : {1u, 7u, 8u, 9u, 15u, 16u, 17u, 31u, TILE_PATHS - 15, TILE_PATHS - 1, TILE_PATHS}) {
        SCOPED_TRACE(count);
        Tile tile;
        std::vector<std::pair<void*, size_t>> maps;
        auto each = [&](auto&& f) {
            f(tile.origin);
            f(tile.direction);
            f(tile.throughput);
            f(tile.radiance);
            f(tile.target);
            f(tile.current.paths);
            f(tile.next.paths);
            f(tile.surfaces);
            f(tile.ordered_surfaces);
            f(tile.shadow_origin);
            f(tile.shadow_direction);
            f(tile.shadow_contribution);
        };
        each([&](auto& rows) { move_to_the_edge(rows, maps); });
        pass_.path_count = count;
        use(tile);
        lanes().generate();
        for (uint segment = 1; segment <= 8; ++segment) {
            std::swap(tile.current, tile.next);
            tile.next.count = tile.surface_count = tile.shadow_count = 0;
            pass.segment = segment;
            lanes().extend();
            order_surfaces(tile);
            lanes().shade();
            lanes().connect();
            EXPECT_LE(tile.next.count, count);
        }
        std::vector<target_core::vec4> sum(TILE_PATHS);
        bound.accumulator = sum.data();
        lanes().finalize();
        each([](auto& rows) { (void)rows.rows.release(); });
        for (auto& [at, bytes] : maps) munmap(at, bytes);
    }
}

// A triangle so small that its triangle test is made of denormals, transparent at its first corner and met near the
// second: where denormals were flushed the hit would lie at the first.
TEST_F(WideKernelsScene, TheAlphaFilterKeepsDenormalsWhereEmbreeFlushesThem) {
    std::vector<uint32_t> texels = {0x00FFFFFFu, 0xFFFFFFFFu};
    render_system::CoreTexture texture;
    texture.width = 2;
    texture.height = 1;
    texture.nearest = true;
    texture.texels = texels;
    pack_textures({&texture, 1}, tables_);
    materials_.assign(1, {});
    materials_[0].opaque = false;
    materials_[0].alpha_cutoff = 0.5f;
    materials_[0].base_color_texture.texture = 0;
    pack_materials(materials_, tables_);
    constexpr float TINY = 5.0e-20f;  // twice its square is denormal, and the inverse of that still a number
    std::vector<glm::vec3> positions = {{0, 0, TINY}, {TINY, 0, TINY}, {0, TINY, TINY}};
    std::vector<glm::vec3> normals(3, glm::vec3(0, 0, -1));
    std::vector<glm::vec2> uv = {{0.25f, 0.5f}, {0.75f, 0.5f}, {0.25f, 0.5f}};
    std::vector<glm::uvec4> triangles = {{0, 1, 2, 0}};
    meshes_.set_mesh(0, {positions, normals, {}, uv, {}, {}, {}, {}, triangles});
    build();
    Tile tile;
    use(tile);
    kernels::Ray ray{{0.9f * TINY, 0.05f * TINY, 0.0f}, {0.0f, 0.0f, 1.0f}};
    uint path = 0;
    TraceContext context(ray, path, kernels::RAY_EXTENSION);
    RTCRay embree_ray = kernels::embree_ray(ray, 1.0f);
    RTCHit hit{};
    hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    int valid = -1;
    RTCFilterFunctionNArguments arguments{};
    arguments.valid = &valid;
    arguments.context = &context.embree;
    arguments.ray = reinterpret_cast<RTCRayN*>(&embree_ray);
    arguments.hit = reinterpret_cast<RTCHitN*>(&hit);
    arguments.N = 1;
    FlushDenormals flush;
    filter_by_alpha(&arguments);
    EXPECT_EQ(valid, -1) << "met where it is opaque";
    EXPECT_EQ(_mm_getcsr() & 0x8040u, 0x8040u) << "and Embree goes on as before";
}

// The footprint of a wide cone on a triangle seen from its edge, or without area, stays a number: it chooses a level.
TEST_F(WideKernelsScene, FootprintsAreFinite) {
    Tile tile;
    use(tile);
    kernels::PathRay path_ray;
    path_ray.ray.origin = {0.0f, 0.0f, 0.0f};
    path_ray.ray.direction = {1.0f, 0.0f, 0.0f};
    path_ray.cone_width = 1.0e6f;
    path_ray.cone_spread = 1.0f;
    kernels::TriangleVertices seen_from_its_edge{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, 0};
    kernels::TriangleVertices without_area{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, 0};
    for (const kernels::TriangleVertices& triangle : {seen_from_its_edge, without_area}) {
        kernels::Surface surface = kernels::make_surface(path_ray, 0, triangle);
        EXPECT_TRUE(std::isfinite(surface.coordinates.footprint0)) << surface.coordinates.footprint0;
        EXPECT_TRUE(std::isfinite(surface.coordinates.footprint1)) << surface.coordinates.footprint1;
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, WideKernels, testing::Values(0u, 1u));

}  // namespace
