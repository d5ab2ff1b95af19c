// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/text/suggest.h"

#include <algorithm>
#include <vector>

namespace metrics {
namespace {

/// Optimal string alignment distance: Levenshtein's with swaps of neighbours.
size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::vector<size_t>> cost(a.size() + 1, std::vector<size_t>(b.size() + 1));
    for (size_t i = 0; i <= a.size(); ++i) cost[i][0] = i;
    for (size_t j = 0; j <= b.size(); ++j) cost[0][j] = j;
    for (size_t i = 1; i <= a.size(); ++i) {
        for (size_t j = 1; j <= b.size(); ++j) {
            const size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
            cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, cost[i - 1][j - 1] + change});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
        }
    }
    return cost[a.size()][b.size()];
}

}  // namespace

std::optional<std::string> suggest(std::string_view word, std::span<const std::string> candidates) {
    constexpr size_t LONGEST = 256;  // an id with its path; nobody mistypes a longer one, and the table grows with it
    if (word.size() > LONGEST) return std::nullopt;
    std::optional<std::string> best;
    constexpr size_t SHORT = 4;  // below, two changes make any word of another
    size_t least = std::max<size_t>(word.size() < SHORT ? 1 : 2, word.size() / 3) + 1;
    for (const std::string& candidate : candidates) {
        // each letter of difference in length is a change by itself
        if (candidate.size() >= word.size() + least || word.size() >= candidate.size() + least) continue;
        const size_t changes = distance(word, candidate);
        if (changes >= least) continue;
        least = changes;
        best = candidate;
    }
    return best;
}

}  // namespace metrics
