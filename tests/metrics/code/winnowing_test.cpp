// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/code/winnowing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <random>

namespace metrics::winnowing_test {
namespace {

using Symbols = std::vector<uint32_t>;

Symbols random_symbols(std::mt19937& random, size_t size, uint32_t alphabet) {
    std::uniform_int_distribution<uint32_t> any(0, alphabet - 1);
    Symbols out(size);
    for (uint32_t& symbol : out) symbol = any(random);
    return out;
}

/// Length of the run that both sides have from (i, j) on, by looking.
size_t common_run(const Symbols& a, size_t i, const Symbols& b, size_t j) {
    size_t length = 0;
    while (i + length < a.size() && j + length < b.size() && a[i + length] == b[j + length]) ++length;
    return length;
}

/// 1 for each symbol of `a` that lies in a run of at least `shortest` symbols that `b` has too: every pair of places is
/// looked at.
std::vector<uint8_t> covered_by_runs(const Symbols& a, const Symbols& b, size_t shortest) {
    std::vector<uint8_t> out(a.size(), 0);
    for (size_t i = 0; i < a.size(); ++i)
        for (size_t j = 0; j < b.size(); ++j)
            if (const size_t length = common_run(a, i, b, j); length >= shortest)
                std::fill_n(out.begin() + static_cast<ptrdiff_t>(i), length, uint8_t{1});
    return out;
}

/// Nothing below the guarantee t is missed and nothing below k is claimed.
void expect_between_bounds(const Symbols& a, const Symbols& b, const WinnowingParameters& parameters) {
    const std::vector<TokenMatch> matches = winnowing_matches(a, b, parameters);
    for (const TokenMatch& match : matches) {
        ASSERT_LE(match.a + match.length, a.size());
        ASSERT_LE(match.b + match.length, b.size());
        ASSERT_TRUE(std::equal(a.begin() + match.a, a.begin() + match.a + match.length, b.begin() + match.b));
        ASSERT_GE(match.length, parameters.k);
    }
    const auto check = [&](const Symbols& own, const Symbols& other, const std::vector<uint8_t>& covered) {
        const std::vector<uint8_t> least = covered_by_runs(own, other, parameters.guarantee());
        const std::vector<uint8_t> most = covered_by_runs(own, other, parameters.k);
        for (size_t i = 0; i < own.size(); ++i) {
            ASSERT_GE(covered[i], least[i]) << "missed at " << i;
            ASSERT_LE(covered[i], most[i]) << "claimed at " << i;
        }
    };
    check(a, b, covered_in_a(matches, a.size()));
    check(b, a, covered_in_b(matches, b.size()));
}

size_t count(const std::vector<uint8_t>& flags) { return std::accumulate(flags.begin(), flags.end(), size_t{0}); }

TEST(Winnowing, SelectsThePapersFingerprints) {
    // Schleimer, Wilkerson, Aiken 2003, figure 2: the hashes of the 5-grams of "adorunrunrunadorunrun", windows of 4,
    // and the fingerprints 17 17 8 39 17.
    const std::vector<uint64_t> hashes = {77, 74, 42, 17, 98, 50, 17, 98, 8, 88, 67, 39, 77, 74, 42, 17, 98};
    const std::vector<uint32_t> expected = {3, 6, 8, 11, 15};
    EXPECT_EQ(winnow(hashes, 4), expected);
}

TEST(Winnowing, TakesTheFirstFingerprintFromAFullWindow) {
    // The printed pseudo-code starts with an empty window and so selects the first hash, 5, for the head alone.
    const std::vector<uint64_t> hashes = {5, 3, 9, 1, 7};
    EXPECT_EQ(winnow(hashes, 4), (std::vector<uint32_t>{3}));
    EXPECT_EQ(winnow(hashes, 3), (std::vector<uint32_t>{1, 3}));
}

TEST(Winnowing, KeepsOneFingerprintAWindowInARunOfEqualHashes) {
    // Plain winnowing takes the rightmost of equal hashes and so each of them; the robust one takes every w-th.
    const std::vector<uint64_t> hashes(100, 7);
    EXPECT_EQ(winnow(hashes, 4).size(), 25u);
    EXPECT_EQ(winnow(hashes, 4).front(), 3u);
    EXPECT_EQ(winnow(hashes, 4)[1], 7u);
}

TEST(Winnowing, SelectsFromEachWindowAndNothingFromNoHashes) {
    std::mt19937 random(7);
    std::vector<uint64_t> hashes(2000);
    for (uint64_t& hash : hashes) hash = random() % 50;
    for (const uint32_t w : {1u, 2u, 8u, 33u}) {
        const std::vector<uint32_t> selected = winnow(hashes, w);
        for (size_t first = 0; first + w <= hashes.size(); ++first) {
            const auto inside = std::lower_bound(selected.begin(), selected.end(), first);
            ASSERT_TRUE(inside != selected.end() && *inside < first + w) << "window " << first << " of " << w;
            const uint64_t least = *std::min_element(hashes.begin() + static_cast<ptrdiff_t>(first),
                                                     hashes.begin() + static_cast<ptrdiff_t>(first + w));
            ASSERT_TRUE(std::any_of(inside, selected.end(),
                                    [&](uint32_t at) { return at < first + w && hashes[at] == least; }));
        }
    }
    EXPECT_TRUE(winnow({}, 8).empty());
    EXPECT_EQ(winnow(std::vector<uint64_t>{4, 2, 3}, 8), (std::vector<uint32_t>{1}));
}

TEST(Winnowing, DensityOnRandomTextIsTwoOverWPlusOne) {
    std::mt19937 random(1);
    const Symbols text = random_symbols(random, 100'000, 1000);
    for (const uint32_t w : {4u, 8u, 16u}) {
        const std::vector<uint64_t> hashes = kgram_hashes(text, {12, w});
        const double density = static_cast<double>(winnow(hashes, w).size()) / static_cast<double>(hashes.size());
        EXPECT_NEAR(density, 2.0 / (w + 1), 0.02 * 2.0 / (w + 1)) << w;  // w = 8: 0.222, where 2 / w is 0.25
    }
}

TEST(Winnowing, AgreesWithEveryPairOfPlacesLookedAt) {
    std::mt19937 random(3);
    for (int round = 0; round < 300; ++round) {
        const uint32_t alphabet = std::array{2u, 3u, 8u, 50u}[static_cast<size_t>(round) % 4];
        Symbols a = random_symbols(random, random() % 300, alphabet),
                b = random_symbols(random, random() % 300, alphabet);
        for (int piece = 0; piece < 4 && !a.empty(); ++piece) {  // pieces of a planted into b
            const size_t from = random() % a.size(), length = std::min<size_t>(random() % 60, a.size() - from);
            const size_t at = b.empty() ? 0 : random() % b.size();
            b.insert(b.begin() + static_cast<ptrdiff_t>(at), a.begin() + static_cast<ptrdiff_t>(from),
                     a.begin() + static_cast<ptrdiff_t>(from + length));
        }
        // With a small k the same k-gram often comes twice in one window, and the sides select different ones. (Two or
        // three symbols would make very common fingerprints of it, of which not all pairs are looked at.)
        const std::array<WinnowingParameters, 4> parameters = {{{}, {5, 4}, {2, 6}, {3, 9}}};
        ASSERT_NO_FATAL_FAILURE(expect_between_bounds(a, b, parameters[random() % (alphabet < 8 ? 2 : 4)]))
            << "round " << round;
    }
}

TEST(Winnowing, FindsEveryPlantedRunOfTheGuaranteedLength) {
    std::mt19937 random(11);
    const WinnowingParameters parameters;
    ASSERT_EQ(parameters.guarantee(), 19u);
    for (int round = 0; round < 300; ++round) {
        Symbols a = random_symbols(random, 400, 1000), b = random_symbols(random, 400, 1000);
        const uint32_t from = random() % 380, to = random() % 380;
        // Every other run repeats itself, so that one window holds equal hashes and either side may choose another one.
        const uint32_t period = 1 + random() % 7;
        for (uint32_t i = from + period; round % 2 == 1 && i < from + 19; ++i) a[i] = a[i - period];
        std::copy_n(a.begin() + from, 19, b.begin() + to);
        const std::vector<TokenMatch> matches = winnowing_matches(a, b, parameters);
        ASSERT_TRUE(std::any_of(matches.begin(), matches.end(),
                                [&](const TokenMatch& match) {
                                    return match.a <= from && from + 19 <= match.a + match.length &&
                                           from - match.a == to - match.b;
                                }))
            << "round " << round;
    }
}

TEST(Winnowing, NeverFindsARunShorterThanK) {
    Symbols a(40), b(40);
    std::iota(a.begin(), a.end(), 0u);
    std::iota(b.begin(), b.end(), 100u);
    std::copy_n(a.begin() + 10, 11, b.begin() + 20);
    EXPECT_TRUE(winnowing_matches(a, b).empty());
    EXPECT_FALSE(winnowing_matches(a, b, {11, 1}).empty());
}

TEST(Winnowing, ACollisionOfHashesNeverCounts) {
    std::mt19937 random(5);
    const Symbols a = random_symbols(random, 600, 100), b = random_symbols(random, 600, 100);
    EXPECT_TRUE(winnowing_matches(a, b, {12, 8, 1}).empty());  // two hashes in all: each fingerprint collides
    Symbols c = b;
    std::copy_n(a.begin() + 100, 40, c.begin() + 300);
    for (const uint32_t bits : {6u, 12u, 64u}) expect_between_bounds(a, c, {12, 8, bits});
    // Runs that are one symbol too short collide as well.
    const Symbols d = random_symbols(random, 600, 2), e = random_symbols(random, 600, 2);
    expect_between_bounds(d, e, {12, 8, 3});
}

TEST(Winnowing, ExchangingTheSidesExchangesTheMatches) {
    std::mt19937 random(9);
    for (int round = 0; round < 20; ++round) {
        const Symbols a = random_symbols(random, 3000, 2 + static_cast<uint32_t>(round) % 3);
        const Symbols b = random_symbols(random, 2000, 2);
        std::vector<TokenMatch> there = winnowing_matches(a, b, {6, 4}), back = winnowing_matches(b, a, {6, 4});
        for (TokenMatch& match : back) std::swap(match.a, match.b);
        EXPECT_EQ(covered_in_a(there, a.size()), covered_in_a(back, a.size()));
        EXPECT_EQ(covered_in_b(there, b.size()), covered_in_b(back, b.size()));
    }
}

TEST(Winnowing, ATextCoversItself) {
    std::mt19937 random(2);
    for (const uint32_t alphabet : {1u, 2u, 30u}) {
        const Symbols a = random_symbols(random, 5000, alphabet);
        EXPECT_EQ(count(covered_in_a(winnowing_matches(a, a), a.size())), a.size()) << alphabet;
    }
}

TEST(Winnowing, ManyEqualLinesAreCoveredWithoutLookingAtAllPairs) {
    const Symbols line = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
    auto repeated = [&](size_t times) {
        Symbols out;
        for (size_t i = 0; i < times; ++i) out.insert(out.end(), line.begin(), line.end());
        return out;
    };
    const Symbols a = repeated(50'000), b = repeated(40'000);  // 2.6e8 pairs of fingerprints, at least
    const std::vector<TokenMatch> matches = winnowing_matches(a, b);
    EXPECT_EQ(count(covered_in_a(matches, a.size())), a.size());
    EXPECT_EQ(count(covered_in_b(matches, b.size())), b.size());
    EXPECT_LT(matches.size(), 100u);
}

TEST(Winnowing, CoverageIsOfTheOwnSide) {
    // The worked example of docs/metrics.md: 24 of a's 30 symbols and the same 24 of b's 60 are shared.
    Symbols a(30), b(60);
    std::iota(a.begin(), a.end(), 0u);
    std::iota(b.begin(), b.end(), 1000u);
    std::copy_n(a.begin() + 6, 24, b.begin() + 20);
    const std::vector<TokenMatch> matches = winnowing_matches(a, b);
    EXPECT_EQ(matches, (std::vector<TokenMatch>{{6, 20, 24}}));
    EXPECT_DOUBLE_EQ(100.0 * static_cast<double>(count(covered_in_a(matches, 30))) / 30, 80);
    EXPECT_DOUBLE_EQ(100.0 * static_cast<double>(count(covered_in_b(matches, 60))) / 60, 40);
}

TEST(Winnowing, PreparedSequencesMatchAsTheirSymbols) {
    std::mt19937 random(8);
    for (int round = 0; round < 200; ++round) {
        const WinnowingParameters parameters{
            .k = 1 + round % 9u, .w = 1 + round % 5u, .hash_bits = round % 2 ? 64u : 5u};
        const Symbols a = random_symbols(random, random() % 300, 3), b = random_symbols(random, random() % 300, 3);
        EXPECT_EQ(winnowing_matches(PrintedSequence(a, parameters), PrintedSequence(b, parameters), parameters),
                  winnowing_matches(a, b, parameters));
    }
}

TEST(Winnowing, EssentialMatchesCoverTheSame) {
    std::mt19937 random(4);
    const Symbols a = random_symbols(random, 2000, 3), b = random_symbols(random, 1500, 3);
    const std::vector<TokenMatch> all = winnowing_matches(a, b, {6, 4});
    const std::vector<TokenMatch> few = essential_matches(all, a.size(), b.size());
    EXPECT_LT(few.size(), all.size());
    EXPECT_EQ(covered_in_a(few, a.size()), covered_in_a(all, a.size()));
    EXPECT_EQ(covered_in_b(few, b.size()), covered_in_b(all, b.size()));
}

}  // namespace
}  // namespace metrics::winnowing_test
