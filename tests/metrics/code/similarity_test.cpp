// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <string_view>
#include <tuple>

#include "metrics/code/line_divergence.h"
#include "metrics/code/string_tiling.h"
#include "metrics/code/token_edit.h"
#include "metrics/code/tree_distance.h"
#include "metrics/portability/performance_portability.h"

namespace metrics::similarity_test {
namespace {

using Symbols = std::vector<uint32_t>;

Symbols letters(std::string_view text) { return {text.begin(), text.end()}; }

Symbols random_symbols(std::mt19937& random, size_t size, uint32_t alphabet) {
    Symbols out(size);
    for (uint32_t& symbol : out) symbol = random() % alphabet;
    return out;
}

// --- greedy string tiling

/// Greedy string tiling as Wise wrote it down: all pairs of places in each round.
std::vector<TokenMatch> tiles_by_looking(const Symbols& a, const Symbols& b, uint32_t minimum) {
    std::vector<uint8_t> taken_a(a.size()), taken_b(b.size());
    std::vector<TokenMatch> tiles;
    for (;;) {
        TokenMatch best;
        for (uint32_t i = 0; i < a.size(); ++i)
            for (uint32_t j = 0; j < b.size(); ++j) {
                uint32_t n = 0;
                while (i + n < a.size() && j + n < b.size() && a[i + n] == b[j + n] && !taken_a[i + n] &&
                       !taken_b[j + n])
                    ++n;
                if (n > best.length) best = {i, j, n};
            }
        if (best.length < minimum) break;
        std::fill_n(taken_a.begin() + best.a, best.length, uint8_t{1});
        std::fill_n(taken_b.begin() + best.b, best.length, uint8_t{1});
        tiles.push_back(best);
    }
    std::sort(tiles.begin(), tiles.end(), [](const auto& x, const auto& y) { return x.a < y.a; });
    return tiles;
}

TEST(StringTiling, WorkedExample) {
    // docs/metrics.md: the longest run goes first, each symbol counts once, and tiles may change their order.
    const Symbols a = letters("abcdefgh-12345-abcd"), b = letters("12345+abcdefgh");
    const auto tiles = greedy_tiles(a, b, {4});
    ASSERT_TRUE(tiles);
    EXPECT_EQ(*tiles, (std::vector<TokenMatch>{{0, 6, 8}, {9, 0, 5}}));
    EXPECT_DOUBLE_EQ(tiling_similarity(*tiles, a.size(), b.size()), 26.0 / 33);
}

TEST(StringTiling, AgreesWithTheCubicAlgorithm) {
    std::mt19937 random(1);
    for (int round = 0; round < 200; ++round) {
        const uint32_t alphabet = 1 + random() % 4;
        const Symbols a = random_symbols(random, random() % 50, alphabet),
                      b = random_symbols(random, random() % 50, alphabet);
        const auto tiles = greedy_tiles(a, b, {3});
        ASSERT_TRUE(tiles);
        ASSERT_EQ(*tiles, tiles_by_looking(a, b, 3)) << "round " << round;
    }
}

TEST(StringTiling, RangeIdentityAndLimit) {
    std::mt19937 random(2);
    const Symbols a = random_symbols(random, 3000, 4), b = random_symbols(random, 2000, 4);
    EXPECT_DOUBLE_EQ(tiling_similarity(*greedy_tiles(a, a), a.size(), a.size()), 1);
    const double similarity = tiling_similarity(*greedy_tiles(a, b, {4}), a.size(), b.size());
    EXPECT_GT(similarity, 0);
    EXPECT_LT(similarity, 1);
    EXPECT_FALSE(greedy_tiles(Symbols(10'000, 1), Symbols(10'000, 1))) << "1e8 pairs of equal runs";
}

// --- token edit similarity

uint64_t edit_distance_by_table(const Symbols& a, const Symbols& b) {
    std::vector<uint64_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), uint64_t{0});
    for (size_t i = 1; i <= a.size(); ++i) {
        uint64_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b.size(); ++j) {
            const uint64_t above = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
            diagonal = above;
        }
    }
    return row.back();
}

TEST(TokenEdit, WorkedExample) {
    // docs/metrics.md: kitten to sitting takes 3 edits over 7 letters. Over the shorter side it were 1 - 3/6, with a
    // replacement as two edits 1 - 5/7.
    EXPECT_EQ(edit_distance(letters("kitten"), letters("sitting")), 3u);
    EXPECT_DOUBLE_EQ(edit_similarity(letters("kitten"), letters("sitting")), 4.0 / 7);
}

TEST(TokenEdit, AgreesWithTheTableAcrossBlocksOf64) {
    std::mt19937 random(3);
    for (int round = 0; round < 300; ++round) {
        const uint32_t alphabet = 1 + random() % 6;
        const Symbols a = random_symbols(random, random() % 300, alphabet);
        Symbols b = round % 3 == 0 ? random_symbols(random, random() % 300, alphabet) : a;
        for (int edit = 0; edit < 10 && !b.empty(); ++edit) {
            const auto at = b.begin() + static_cast<ptrdiff_t>(random() % b.size());
            if (edit % 2 == 0)
                b.erase(at);
            else
                b.insert(at, random() % alphabet);
        }
        ASSERT_EQ(edit_distance(a, b), edit_distance_by_table(a, b)) << a.size() << " and " << b.size();
        ASSERT_EQ(edit_distance(b, a), edit_distance(a, b));
    }
    for (const size_t size : {63, 64, 65, 128, 129}) {
        const Symbols a = random_symbols(random, size, 3), b = random_symbols(random, 100, 3);
        EXPECT_EQ(edit_distance(a, b), edit_distance_by_table(a, b)) << size;
        EXPECT_DOUBLE_EQ(edit_similarity(a, a), 1);
    }
}

TEST(TokenEdit, ABandHoldsEveryEditOfItsWidthAndSaysWhereOneIsWider) {
    std::mt19937 random(5);
    for (int round = 0; round < 60; ++round) {
        const Symbols a = random_symbols(random, 400 + random() % 700, round % 2 == 0 ? 3 : 300);
        Symbols b = round % 5 == 0 ? random_symbols(random, 400 + random() % 700, 300) : a;
        for (size_t edits = random() % 600; edits > 0 && b.size() > 200; --edits) {  // also blocks that moved far
            const auto at = static_cast<ptrdiff_t>(random() % (b.size() - 100));
            if (random() % 40 == 0)
                std::rotate(b.begin() + at, b.begin() + at + 50, b.begin() + at + 100);
            else if (random() % 3 == 0)
                b.insert(b.begin() + at, random() % 300);
            else
                b.erase(b.begin() + at);
        }
        const uint64_t exact = edit_distance_by_table(a, b);
        ASSERT_EQ(edit_distance(a, b), exact) << a.size() << " and " << b.size();
        ASSERT_EQ(edit_distance_within(a, b, exact), exact);
        EXPECT_TRUE(exact == 0 || !edit_distance_within(a, b, exact - 1));
    }
    EXPECT_EQ(edit_distance_within({}, letters("four"), 4), 4u);
    EXPECT_EQ(edit_distance_within({}, letters("four"), 3), std::nullopt);
    EXPECT_EQ(edit_distance(letters("four"), {}), 4u);
    EXPECT_EQ(edit_distance({}, {}), 0u);
}

// --- tree edit distance

/// f(d(a c(b)) e) and the like: a letter is a node, its children stand in parentheses behind it.
Tree tree(std::string_view text) {
    Tree out;
    size_t at = 0;
    auto node = [&](const auto& self) -> void {
        const char label = text[at++];
        const auto first = static_cast<uint32_t>(out.size());
        if (at < text.size() && text[at] == '(') {
            ++at;
            while (text[at] != ')') self(self);
            ++at;
        }
        out.close(first, static_cast<uint64_t>(label));
    };
    if (!text.empty()) node(node);
    return out;
}

/// The distance between forests by its definition, over all ways to remove or map the last root.
uint64_t forest_distance(const Tree& a, uint32_t a_first, uint32_t a_end, const Tree& b, uint32_t b_first,
                         uint32_t b_end,
                         std::map<std::tuple<uint32_t, uint32_t, uint32_t, uint32_t>, uint64_t>& known) {
    if (a_first == a_end) return b_end - b_first;
    if (b_first == b_end) return a_end - a_first;
    const auto key = std::tuple(a_first, a_end, b_first, b_end);
    if (const auto found = known.find(key); found != known.end()) return found->second;
    auto go = [&](uint32_t i, uint32_t i_end, uint32_t j, uint32_t j_end) {
        return forest_distance(a, i, i_end, b, j, j_end, known);
    };
    const uint32_t x = a_end - 1, y = b_end - 1;
    const uint64_t remove = go(a_first, x, b_first, b_end) + 1, insert = go(a_first, a_end, b_first, y) + 1;
    const uint64_t map = go(a_first, a.leftmost[x], b_first, b.leftmost[y]) + go(a.leftmost[x], x, b.leftmost[y], y) +
                         (a.labels[x] == b.labels[y] ? 0 : 1);
    return known[key] = std::min({remove, insert, map});
}

TEST(TreeDistance, WorkedExample) {
    // Zhang and Shasha's own example: c moves out of d's children, at the price of one deletion and one insertion.
    const Tree a = tree("f(d(ac(b))e)"), b = tree("f(c(d(ab))e)");
    EXPECT_EQ(tree_distance(a, b), 2u);
    EXPECT_DOUBLE_EQ(normalized_tree_distance(a, b), 2.0 * 2 / (6 + 6 + 2));  // 2/12 without the distance below
}

TEST(TreeDistance, AgreesWithItsDefinition) {
    std::mt19937 random(4);
    auto random_tree = [&](size_t nodes) {
        Tree out;
        auto grow = [&](const auto& self, size_t below) -> void {
            const auto first = static_cast<uint32_t>(out.size());
            while (below > 0) {
                const size_t child = 1 + random() % below;
                self(self, child - 1);
                below -= child;
            }
            out.close(first, random() % 3);
        };
        grow(grow, nodes - 1);
        return out;
    };
    for (int round = 0; round < 100; ++round) {
        const Tree a = random_tree(1 + random() % 9), b = random_tree(1 + random() % 9);
        std::map<std::tuple<uint32_t, uint32_t, uint32_t, uint32_t>, uint64_t> known;
        const uint64_t expected =
            forest_distance(a, 0, static_cast<uint32_t>(a.size()), b, 0, static_cast<uint32_t>(b.size()), known);
        ASSERT_EQ(tree_distance(a, b), expected);
        ASSERT_EQ(tree_distance(b, a), expected);
        ASSERT_EQ(tree_distance(a, a), 0u);
        ASSERT_LE(normalized_tree_distance(a, b), 1);
    }
    EXPECT_DOUBLE_EQ(normalized_tree_distance(tree("a(bc)"), tree("")), 1);
}

// --- line divergence

TEST(LineDivergence, WorkedExample) {
    // docs/metrics.md: two of the lines are common, 5 different ones are there in all. Dice's distance is 3/7; with
    // repeated lines counted once each, two are common of four.
    const std::vector<uint64_t> a = {1, 2, 9, 9}, b = {9, 3, 1};
    EXPECT_DOUBLE_EQ(line_divergence(a, b), 1 - 2.0 / 5);
    EXPECT_DOUBLE_EQ(line_divergence(b, a), 1 - 2.0 / 5);
    EXPECT_DOUBLE_EQ(line_divergence(a, a), 0);
    EXPECT_DOUBLE_EQ(line_divergence(a, {}), 1);
}

// --- performance portability

TEST(PerformancePortability, WorkedExample) {
    // docs/metrics.md: full speed on one platform, a quarter on the other. The mean would be 0.625, the geometric one
    // 0.5.
    const std::vector<std::optional<double>> two = {1.0, 0.25};
    EXPECT_DOUBLE_EQ(performance_portability(two), 0.4);
    const std::vector<std::optional<double>> unsupported = {1.0, 0.25, std::nullopt}, zero = {1.0, 0.0};
    EXPECT_EQ(performance_portability(unsupported), 0);
    EXPECT_EQ(performance_portability(zero), 0);
    const std::vector<std::optional<double>> one = {0.3};
    EXPECT_DOUBLE_EQ(performance_portability(one), 0.3);
}

}  // namespace
}  // namespace metrics::similarity_test
