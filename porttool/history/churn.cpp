// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/history/churn.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace porttool {
namespace {

std::vector<double> ranks_of(const std::vector<double>& values) {
    std::vector<size_t> order(values.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::sort(order.begin(), order.end(), [&](size_t x, size_t y) { return values[x] < values[y]; });
    std::vector<double> ranks(values.size());
    for (size_t first = 0; first < order.size();) {
        size_t end = first;
        while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
        for (size_t i = first; i < end; ++i) ranks[order[i]] = static_cast<double>(first + end - 1) / 2;
        first = end;
    }
    return ranks;
}

}  // namespace

std::optional<double> rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
    if (a.size() < 3 || a.size() != b.size()) return std::nullopt;
    const std::vector<double> x = ranks_of(a), y = ranks_of(b);
    const double mean = static_cast<double>(a.size() - 1) / 2;
    double both = 0, of_x = 0, of_y = 0;
    for (size_t i = 0; i < x.size(); ++i) {
        both += (x[i] - mean) * (y[i] - mean);
        of_x += (x[i] - mean) * (x[i] - mean);
        of_y += (y[i] - mean) * (y[i] - mean);
    }
    if (of_x == 0 || of_y == 0) return std::nullopt;
    return both / std::sqrt(of_x * of_y);
}

void ChurnCount::add(const BlockFigures& figures) {
    for (size_t i = 0; i < figures.blocks.size(); ++i) {
        const std::string& name = figures.blocks[i].name;
        const auto [last, is_new] = last_.try_emplace(name, figures.contents[i]);
        if (is_new || last->second == figures.contents[i]) continue;
        last->second = figures.contents[i];
        ++commits_[name];
    }
}

std::vector<BlockChurn> ChurnCount::of(const std::vector<MeasuredBlock>& blocks) const {
    std::vector<BlockChurn> out;
    for (const MeasuredBlock& block : blocks) {
        const auto found = commits_.find(block.name);
        const uint32_t lines = block.found.source.measure.lines + block.found.target.measure.lines;
        BlockChurn churn;
        churn.commits = found == commits_.end() ? 0 : found->second;
        if (lines > 0) churn.per_100_lines = 100.0 * static_cast<double>(churn.commits) / lines;
        out.push_back(churn);
    }
    return out;
}

std::optional<double> churn_and_likeness(const std::vector<BlockChurn>& churn,
                                         const std::vector<MeasuredBlock>& blocks) {
    std::vector<double> changes, likeness;
    for (size_t i = 0; i < blocks.size(); ++i)
        if (const auto& percent = blocks[i].found.target.measure.moss_percent) {
            changes.push_back(churn[i].per_100_lines);
            likeness.push_back(*percent);
        }
    return rank_correlation(changes, likeness);
}

}  // namespace porttool
