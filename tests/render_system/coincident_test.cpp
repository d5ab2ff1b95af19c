// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/coincident.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

using namespace render_system;

namespace {

// A parallelogram cut into columns * lines quads of two triangles each.
struct Sheet {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec4> triangles;
    glm::vec4 transform[3] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};

    Sheet(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v, uint32_t columns, uint32_t lines) {
        for (uint32_t y = 0; y <= lines; ++y) {
            for (uint32_t x = 0; x <= columns; ++x) {
                positions.push_back(corner + u * (static_cast<float>(x) / static_cast<float>(columns)) +
                                    v * (static_cast<float>(y) / static_cast<float>(lines)));
            }
        }
        for (uint32_t y = 0; y < lines; ++y) {
            for (uint32_t x = 0; x < columns; ++x) {
                const uint32_t a = y * (columns + 1) + x, b = a + columns + 1;
                triangles.push_back({a, a + 1, b + 1, 0});
                triangles.push_back({a, b + 1, b, 0});
            }
        }
    }
    PlacedMesh placed() const {
        return {&positions[0].x, static_cast<uint32_t>(positions.size()), &triangles[0].x,
                static_cast<uint32_t>(triangles.size()), transform};
    }
    glm::vec3 corner(uint32_t primitive, int k) const {
        const glm::vec3& p = positions[triangles[primitive][k]];
        return {p.x + transform[0].w, p.y + transform[1].w, p.z + transform[2].w};
    }
};

std::vector<PlacedMesh> placed(const std::vector<Sheet>& sheets) {
    std::vector<PlacedMesh> scene;
    for (const Sheet& sheet : sheets) scene.push_back(sheet.placed());
    return scene;
}

CoincidentSurfaces found_in(const std::vector<Sheet>& sheets) {
    CoincidentSurfaces surfaces;
    surfaces.find(placed(sheets));
    return surfaces;
}

// Barycentric coordinates by areas.
glm::dvec2 coordinates(const Sheet& sheet, uint32_t primitive, const glm::dvec3& p) {
    const glm::dvec3 a = sheet.corner(primitive, 0), b = sheet.corner(primitive, 1), c = sheet.corner(primitive, 2);
    const glm::dvec3 area = glm::cross(b - a, c - a);
    const double whole = glm::dot(area, area);
    return {glm::dot(glm::cross(p - a, c - a), area) / whole, glm::dot(glm::cross(b - a, p - a), area) / whole};
}

bool contains(const CoincidentSurfaces& surfaces, const TriangleName& upper, const glm::dvec2& at,
              const TriangleName& lower) {
    for (const CoincidentSurfaces::Entry& entry : surfaces.entries()) {
        if (entry.triangle != upper) continue;
        const auto x = static_cast<uint32_t>(at.x * entry.side), y = static_cast<uint32_t>(at.y * entry.side);
        const std::vector<TriangleName>& bin = entry.bins[size_t{y} * entry.side + x];
        return std::find(bin.begin(), bin.end(), lower) != bin.end();
    }
    return false;
}

// Of each triangle that shares its place, the lowest that it does so with. What lies between the two is not told: of
// copies it depends on which came last.
std::map<TriangleName, TriangleName> lowest_of(const CoincidentSurfaces& surfaces) {
    std::map<TriangleName, TriangleName> lowest;
    for (const CoincidentSurfaces::Entry& entry : surfaces.entries()) {
        for (const std::vector<TriangleName>& bin : entry.bins) {
            if (bin.empty()) continue;
            const auto at = lowest.emplace(entry.triangle, bin[0]).first;
            at->second = std::min(at->second, bin[0]);
            EXPECT_TRUE(std::is_sorted(bin.begin(), bin.end()));
            EXPECT_EQ(std::adjacent_find(bin.begin(), bin.end()), bin.end());
        }
    }
    return lowest;
}

}  // namespace

// Whatever point of a plane one takes: the triangle of the lower sheet that has it is among those of the upper one's.
TEST(CoincidentSurfaces, AreFoundAtEveryPointThatTwoSheetsShare) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> spread(-1.0f, 1.0f), share(0.02f, 0.98f);
    for (int round = 0; round < 20; ++round) {
        const auto vector = [&] { return glm::vec3(spread(random), spread(random), spread(random)); };
        const glm::vec3 u = vector(), v = glm::cross(u, vector()) * 1.3f, corner = vector() * 3.0f;
        const uint32_t lines = 1 + round % 7, columns = 1 + round % 5;
        // The second within the first's plane, the first of many triangles and the second of few, and the other way.
        const Sheet one(corner, u, v, round % 2 == 0 ? 30 : 1, lines);
        const Sheet two(corner + u * 0.21f + v * 0.13f, u * 0.7f, v * 0.6f, columns, round % 2 == 0 ? 1 : 25);
        const CoincidentSurfaces surfaces = found_in({one, two});
        for (int i = 0; i < 200; ++i) {
            const float s = share(random), t = share(random);
            const glm::dvec3 p = two.positions[0] + u * 0.7f * s + v * 0.6f * t;
            for (uint32_t upper = 0; upper < two.triangles.size(); ++upper) {
                const glm::dvec2 on_upper = coordinates(two, upper, p);
                if (std::min({on_upper.x, on_upper.y, 1.0 - on_upper.x - on_upper.y}) < 1e-3) continue;
                for (uint32_t lower = 0; lower < one.triangles.size(); ++lower) {
                    const glm::dvec2 on_lower = coordinates(one, lower, p);
                    if (std::min({on_lower.x, on_lower.y, 1.0 - on_lower.x - on_lower.y}) < 1e-3) continue;
                    EXPECT_TRUE(contains(surfaces, {1, upper}, on_upper, {0, lower})) << round << " " << s << " " << t;
                }
            }
        }
    }
}

TEST(CoincidentSurfaces, AreNotWhatTouchesCrossesOrLiesApart) {
    const glm::vec3 corner(0.3f, 0.2f, 5.0f), u(1, 0.2f, 0.1f), v(-0.1f, 0.9f, 0.3f);
    const Sheet sheet(corner, u, v, 4, 4);
    const glm::vec3 normal = glm::normalize(glm::cross(u, v));
    EXPECT_TRUE(found_in({sheet, Sheet(corner + u, u, v, 3, 3)}).empty()) << "they share an edge";
    EXPECT_TRUE(found_in({sheet, Sheet(corner + normal * 1e-3f, u, v, 3, 3)}).empty()) << "one above the other";
    EXPECT_TRUE(found_in({sheet, Sheet(corner, u, normal, 3, 3)}).empty()) << "upright";
    EXPECT_TRUE(found_in({sheet, Sheet(corner, u, v + normal * 0.05f, 3, 3)}).empty()) << "opened like a book";
    EXPECT_FALSE(found_in({sheet, Sheet(corner + u * 0.9f, u, v, 3, 3)}).empty()) << "a tenth in common";
    EXPECT_TRUE(found_in({sheet}).empty()) << "triangles of one sheet lie side by side";
    Sheet doubled = sheet;
    doubled.triangles.push_back({doubled.triangles[5].z, doubled.triangles[5].x, doubled.triangles[5].y, 0});
    ASSERT_EQ(found_in({doubled}).entries().size(), 1u) << "one triangle twice";
    EXPECT_EQ(found_in({doubled}).entries()[0].triangle, (TriangleName{0, 32}));
}

// Where a coordinate is worth 1/128, quads of less than one: all that overlap are found, those that only touch are not.
TEST(CoincidentSurfaces, OfSmallTrianglesAreFoundFarOff) {
    const auto far_off = [](Sheet sheet) {
        for (int axis = 0; axis < 3; ++axis) sheet.transform[axis].w = axis == 1 ? 10.0f : 1e5f;
        return sheet;
    };
    const glm::vec3 corner(-3, 0, -3), u(6, 0, 0), v(0, 0, 6);
    const Sheet one = far_off({corner, u, v, 8, 8}), two = far_off({corner, u, v, 7, 9});
    const CoincidentSurfaces surfaces = found_in({one, two});
    std::mt19937 random(3);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    size_t looked_at = 0;
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 p = glm::dvec3(1e5 - 3, 10, 1e5 - 3) + 6.0 * glm::dvec3(share(random), 0, share(random));
        for (uint32_t upper = 0; upper < two.triangles.size(); ++upper) {
            const glm::dvec2 on_upper = coordinates(two, upper, p);
            if (std::min({on_upper.x, on_upper.y, 1.0 - on_upper.x - on_upper.y}) < 0.1) continue;
            for (uint32_t lower = 0; lower < one.triangles.size(); ++lower) {
                const glm::dvec2 on_lower = coordinates(one, lower, p);
                if (std::min({on_lower.x, on_lower.y, 1.0 - on_lower.x - on_lower.y}) < 0.1) continue;
                EXPECT_TRUE(contains(surfaces, {1, upper}, on_upper, {0, lower})) << p.x << " " << p.z;
                ++looked_at;
            }
        }
    }
    EXPECT_GT(looked_at, 50u);
    EXPECT_TRUE(found_in({one, far_off({corner + u, u, v, 7, 5})}).empty()) << "side by side";
}

// Moves of all kinds: onto another, along it, off it, and of one of many copies.
TEST(CoincidentSurfaces, FollowedFindWhatIsFoundAnew) {
    const glm::vec3 corner(0, 0, 1), u(1, 0, 0.2f), v(0, 1, 0.1f);
    std::vector<Sheet> sheets(12, Sheet(corner, u, v, 3, 2));
    sheets.push_back(Sheet(corner, u * 1.5f, v, 5, 4));
    sheets.push_back(Sheet(corner + u * 4.0f, u, v, 2, 2));
    CoincidentSurfaces followed = found_in(sheets);
    EXPECT_FALSE(followed.empty());
    std::mt19937 random(7);
    for (int step = 0; step < 40; ++step) {
        const auto changed = static_cast<uint32_t>(random() % sheets.size());
        const glm::vec3 places[] = {{0, 0, 0}, u * 0.4f, u * -4.0f, {0, 0, 3}};
        const glm::vec3 to = places[random() % 4];
        for (int axis = 0; axis < 3; ++axis) sheets[changed].transform[axis].w = to[axis];
        followed.follow(placed(sheets), std::span(&changed, 1));
        EXPECT_EQ(lowest_of(followed), lowest_of(found_in(sheets))) << step;
    }
}

// Of 500 things in one place each has the lowest to look at, not all that are below it.
TEST(CoincidentSurfaces, OfManyCopiesTheLowestStandsForAll) {
    const std::vector<Sheet> sheets(500, Sheet({0, 0, 1}, {1, 0, 0.2f}, {0, 1, 0.1f}, 3, 3));
    const CoincidentSurfaces surfaces = found_in(sheets);
    ASSERT_EQ(surfaces.entries().size(), 499u * 18);
    for (const CoincidentSurfaces::Entry& entry : surfaces.entries()) {
        for (const std::vector<TriangleName>& bin : entry.bins) {
            EXPECT_LE(bin.size(), 1u);
            if (bin.size() == 1) {
                EXPECT_EQ(bin[0], (TriangleName{0, entry.triangle.primitive}));
            }
        }
    }
}

TEST(CoincidentSurfaces, OfVeryManyInOnePlaceTheirBinsAreBounded) {
    constexpr uint32_t kSheets = 300;
    std::vector<Sheet> sheets;
    for (uint32_t i = 0; i < kSheets; ++i) {
        sheets.emplace_back(glm::vec3(0.001f * static_cast<float>(i), 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), 1,
                            1);
    }
    const CoincidentSurfaces surfaces = found_in(sheets);
    uint64_t pairs = 0, bin_tests = 0;
    for (const CoincidentSurfaces::Entry& entry : surfaces.entries()) {
        pairs += entry.lower.size();
        bin_tests += entry.lower.size() * entry.side * entry.side;
    }
    // Of two such sheets each triangle lies on the other's of its own half and on one of the other half.
    EXPECT_GE(pairs, uint64_t{kSheets} * (kSheets - 1) / 2 * 3);
    EXPECT_LE(bin_tests, (uint64_t{1} << 24) + pairs);  // a bin there is always
}

// hash_pair of the kernels.
uint32_t mixed(uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}
uint32_t key_of(uint32_t instance, uint32_t handle) { return mixed(instance ^ (mixed(handle) + 0x9e3779b9u)); }

// As the kernels ask before they look for an entry, once for each sixteenth of its u and v.
bool may_share(const std::vector<glm::uvec4>& rows, uint32_t key, const glm::vec2& at) {
    const uint32_t index = rows[0].z + (key & rows[0].w);
    const uint32_t word = rows[index / 4][static_cast<int>(index % 4)];
    const auto cell = static_cast<uint32_t>(at.y * 4) * 4 + static_cast<uint32_t>(at.x * 4);
    return (word >> cell & 1) != 0 && (word >> 16 == key >> 16 || word >> 16 == 0xffff);
}

// What has nothing in its place is let through seldom enough that it costs little, and what has something always.
TEST(CoincidentSurfaces, TheFilterLeavesOutNothing) {
    const CoincidentSurfaces surfaces = found_in({Sheet({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 9, 8),
                                                  Sheet({0.3f, 0.4f, 0}, {0.1f, 0, 0}, {0, 0.1f, 0}, 5, 5),
                                                  Sheet({0, 0, 0}, {3, 0, 0}, {0, 3, 0}, 1, 1)});
    const auto rows = pack_coincident(surfaces.entries(), [](const TriangleName& name) {
        return CoincidentTriangle{name.primitive * 7, 1.0f};
    });
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0.0f, 0.999f);
    uint32_t asked = 0, left_out = 0;
    for (const CoincidentSurfaces::Entry& entry : surfaces.entries()) {
        const uint32_t key = key_of(entry.triangle.instance, entry.triangle.primitive * 7);
        for (int i = 0; i < 400; ++i) {
            const glm::vec2 at(unit(random), unit(random));
            const auto side = static_cast<float>(entry.side);
            const auto x = static_cast<uint32_t>(at.x * side), y = static_cast<uint32_t>(at.y * side);
            if (entry.bins[size_t{y} * entry.side + x].empty()) {
                left_out += entry.side > 4 && !may_share(rows, key, at) ? 1 : 0;
            } else {
                ASSERT_TRUE(may_share(rows, key, at)) << at.x << ' ' << at.y;
                ++asked;
            }
        }
    }
    EXPECT_GT(asked, 1000u);
    EXPECT_GT(left_out, 100u) << "of the large triangles most has nothing on it";
    int let_through = 0;
    for (uint32_t other = 0; other < 10000; ++other) {
        let_through += may_share(rows, key_of(7, other), glm::vec2(unit(random), unit(random))) ? 1 : 0;
    }
    EXPECT_LT(let_through, 1500);
}
