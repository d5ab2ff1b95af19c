// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/alias_table.h"

#include <cstddef>

namespace render_system {

namespace {

// The fraction that is compared with a threshold is a float below 1; a threshold that rounds up to 1 must not send
// anything to the alias, one that is 0 must send everything there. Both hold for `fraction < threshold`.
void fill(std::vector<AliasEntry>& table, std::vector<double>& scaled) {
    std::vector<uint32_t> small;
    std::vector<uint32_t> large;
    for (size_t i = 0; i < scaled.size(); ++i) (scaled[i] < 1.0 ? small : large).push_back(static_cast<uint32_t>(i));
    while (!small.empty() && !large.empty()) {
        const uint32_t poor = small.back();
        const uint32_t rich = large.back();
        small.pop_back();
        table[poor].threshold = static_cast<float>(scaled[poor]);
        table[poor].alias = rich;
        scaled[rich] -= 1.0 - scaled[poor];
        if (scaled[rich] < 1.0) {
            large.pop_back();
            small.push_back(rich);
        }
    }
    // What is left differs from 1 by rounding alone, and keeps its threshold of 1. It has no entry of weight 0: what is
    // left always adds up to the number of entries left.
}

}  // namespace

std::vector<AliasEntry> build_alias_table(std::span<const double> weights) {
    std::vector<AliasEntry> table(weights.size());
    double sum = 0.0;
    for (double weight : weights) sum += weight;
    const double count = static_cast<double>(weights.size());
    std::vector<double> scaled(weights.size(), 1.0);
    for (size_t i = 0; i < weights.size(); ++i) {
        table[i].alias = static_cast<uint32_t>(i);
        table[i].probability = static_cast<float>(sum > 0.0 ? weights[i] / sum : 1.0 / count);
        if (sum > 0.0) scaled[i] = weights[i] / sum * count;
    }
    if (sum > 0.0) fill(table, scaled);
    return table;
}

}  // namespace render_system
