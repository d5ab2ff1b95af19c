// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/alias_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace render_system::testing::alias_table_test {
namespace {

// What the table really chooses: each entry's own threshold, plus what aliases send its way, over all entries.
std::vector<double> chosen(const std::vector<AliasEntry>& table) {
    std::vector<double> probability(table.size(), 0.0);
    const double share = 1.0 / static_cast<double>(table.size());
    for (size_t i = 0; i < table.size(); ++i) {
        const double threshold = static_cast<double>(table[i].threshold);
        probability[i] += share * threshold;
        probability[table[i].alias] += share * (1.0 - threshold);
    }
    return probability;
}

void expect_exact(const std::vector<double>& weights) {
    const std::vector<AliasEntry> table = build_alias_table(weights);
    ASSERT_EQ(table.size(), weights.size());
    double sum = 0.0;
    for (double weight : weights) sum += weight;
    const std::vector<double> probability = chosen(table);
    for (size_t i = 0; i < weights.size(); ++i) {
        ASSERT_LT(table[i].alias, table.size());
        EXPECT_NEAR(probability[i], weights[i] / sum, 1e-7) << i;
        EXPECT_NEAR(static_cast<double>(table[i].probability), weights[i] / sum, 1e-7) << i;
        if (weights[i] == 0.0) {
            EXPECT_EQ(probability[i], 0.0) << i;
        }
    }
}

TEST(AliasTable, ChoosesInProportion) {
    expect_exact({1});
    expect_exact({1, 1, 1, 1});
    expect_exact({1, 2, 3, 4});
    expect_exact({0, 5, 0, 0, 1e-3});
    expect_exact({1e12, 1e-12, 3e11});
    expect_exact({0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1});
}

TEST(AliasTable, ChoosesInProportionAmongThousands) {
    std::mt19937 generator(1);
    std::vector<double> weights;
    for (int i = 0; i < 5000; ++i) {
        const double u = static_cast<double>(generator()) / 4294967296.0;
        weights.push_back(i % 7 == 0 ? 0.0 : std::exp(20.0 * u));
    }
    expect_exact(weights);
}

TEST(AliasTable, WithoutAnyWeightAllAreAlike) {
    const std::vector<AliasEntry> table = build_alias_table(std::vector<double>(3, 0.0));
    for (double probability : chosen(table)) EXPECT_DOUBLE_EQ(probability, 1.0 / 3.0);
    EXPECT_TRUE(build_alias_table({}).empty());
}

}  // namespace
}  // namespace render_system::testing::alias_table_test
