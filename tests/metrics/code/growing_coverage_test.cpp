// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What is covered as sequences come and go, against all of it matched at once.
#include "metrics/code/growing_coverage.h"

#include <gtest/gtest.h>

#include <random>

namespace metrics::growing_coverage_test {
namespace {

using Symbols = std::vector<uint32_t>;

/// The sequences with separators between them, as winnowing_matches() takes them.
Symbols joined(const GrowingCoverage::Members& members, uint32_t side) {
    Symbols out;
    uint32_t separator = 0xFFFFFFFEu - side;
    for (const GrowingCoverage::Member& member : members) {
        if (!out.empty()) out.push_back(separator), separator -= 2;
        out.insert(out.end(), member.sequence->symbols.begin(), member.sequence->symbols.end());
    }
    return out;
}

/// Runs that come again and again, as lists of numbers have them, between words of which no two are alike.
Symbols some_text(std::mt19937& random, const std::vector<Symbols>& stock) {
    Symbols out;
    for (uint32_t pieces = random() % 12; pieces > 0; --pieces) {
        const Symbols& piece = stock[random() % stock.size()];
        if (random() % 3 == 0)
            for (uint32_t times = random() % 60; times > 0; --times) out.push_back(random() % 2);
        else
            out.insert(out.end(), piece.begin(), piece.end());
        for (uint32_t others = random() % 4; others > 0; --others) out.push_back(random() % 100000);
    }
    return out;
}

TEST(GrowingCoverage, IsThatOfAllSequencesMatchedAtOnce) {
    std::mt19937 random(5);
    const WinnowingParameters parameters;
    std::vector<Symbols> stock(20);
    for (Symbols& piece : stock)
        for (uint32_t size = 5 + random() % 60; size > 0; --size) piece.push_back(10 + random() % 40);
    GrowingCoverage coverage(parameters);
    std::array<GrowingCoverage::Members, 2> members;
    uint32_t next = 0;
    size_t covered = 0, all = 0;
    for (int round = 0; round < 150; ++round) {
        for (uint32_t edits = 1 + random() % 4; edits > 0; --edits) {
            GrowingCoverage::Members& side = members[random() % 2];
            const size_t at = random() % (side.size() + 1);
            if (at < side.size() && (side.size() > 60 || random() % 3 == 0))
                side.erase(side.begin() + static_cast<ptrdiff_t>(at));
            side.insert(side.begin() + static_cast<ptrdiff_t>(std::min(at, side.size())),
                        {next++, std::make_shared<PrintedSequence>(some_text(random, stock), parameters)});
        }
        const auto found = coverage.update(members[0], members[1]);
        const Symbols a = joined(members[0], 0), b = joined(members[1], 1);
        const auto matches = winnowing_matches(a, b, parameters);
        ASSERT_EQ(found[0].symbols, covered_in_a(matches, a.size())) << round;
        ASSERT_EQ(found[1].symbols, covered_in_b(matches, b.size())) << round;
        covered += static_cast<size_t>(std::count(found[0].symbols.begin(), found[0].symbols.end(), 1));
        all += a.size();
        ASSERT_EQ(found[0].first.size(), members[0].size());
        for (size_t i = 0; i < members[0].size(); ++i)
            if (const Symbols& text = members[0][i].sequence->symbols; !text.empty()) {
                ASSERT_EQ(a[found[0].first[i]], text.front());
            }
    }
    EXPECT_GT(covered, all / 4);
    EXPECT_LT(covered, all);
}

TEST(GrowingCoverage, OfNothingIsNothing) {
    GrowingCoverage coverage({});
    EXPECT_TRUE(coverage.update({}, {})[0].symbols.empty());
}

}  // namespace
}  // namespace metrics::growing_coverage_test
