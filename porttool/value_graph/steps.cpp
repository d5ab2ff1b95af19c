// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/value_graph/steps.h"

#include <algorithm>

#include "porttool/normal/declaration_words.h"

namespace porttool {
namespace {

constexpr size_t kDeepest = 64;

/// Which statements head a block, each told by the one brace that closes it. A block without a head shows as a second
/// brace of that around it: then, and where a brace closes nothing, the list is empty.
std::vector<bool> heads_of_blocks(const std::vector<Statement>& statements) {
    std::vector<bool> out(statements.size());
    for (const Statement& statement : statements) {
        if (!statement.is_brace()) continue;
        if (statement.head >= out.size() || out[statement.head]) return {};
        out[statement.head] = true;
    }
    return out;
}

bool is_leaving(const Step& step) {
    if (!step.words.empty() && is_one_of(step.words[0], {"return", "break", "continue", "discard"})) return true;
    return std::any_of(step.block.begin(), step.block.end(), [](const Step& inner) { return inner.leaves; });
}

}  // namespace

std::vector<Step> as_tree(const std::vector<Statement>& statements) {
    const std::vector<bool> opens = heads_of_blocks(statements);
    if (opens.empty()) return {};
    std::vector<std::vector<Step>> open(1);  // the blocks that are being read, from the outermost
    for (size_t i = 0; i < statements.size(); ++i) {
        if (statements[i].is_brace()) {
            if (open.size() < 2) return {};
            std::vector<Step> block = std::move(open.back());
            open.pop_back();
            Step& head = open.back().back();
            head.block = std::move(block);
            head.leaves = is_leaving(head);
            continue;
        }
        Step step{statements[i].common, {}, opens[i], false};
        step.leaves = is_leaving(step);
        open.back().push_back(std::move(step));
        if (!opens[i]) continue;
        if (open.size() > kDeepest) return {};
        open.emplace_back();
    }
    return open.size() == 1 ? std::move(open[0]) : std::vector<Step>();
}

}  // namespace porttool
