// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/sarif_fixes.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "porttool/normal/diff.h"
#include "porttool/sync/unified_diff.h"
#include "porttool/text/sink/sarif.h"
#include "porttool/text/utf8.h"

namespace porttool {
namespace {

using nlohmann::ordered_json;

/// Whole lines that others take the place of; null where that cannot be said so.
ordered_json replacements(const ProposedFile& file) {
    if (!is_utf8(file.before) || !is_utf8(file.now)) return nullptr;
    const Words before = lines_with_ends(file.before), now = lines_with_ends(file.now);
    const std::vector<DiffStep> steps = diff(before, now);
    ordered_json out = ordered_json::array();
    for (size_t i = 0; i < steps.size(); ++i) {
        if (steps[i].kind == DiffStep::Keep) continue;
        const size_t first = steps[i].before;
        size_t end = first;
        std::string text;
        for (; i < steps.size() && steps[i].kind != DiffStep::Keep; ++i) {
            if (steps[i].kind == DiffStep::Remove) end = steps[i].before + 1;
            if (steps[i].kind == DiffStep::Add) text += now[steps[i].now];
        }
        const bool open_end = end > first && before[end - 1].back() != '\n';
        const bool behind_all = first > 0 && first == before.size() && before.back().back() != '\n';
        if (open_end || behind_all) return nullptr;
        ordered_json one = {
            {"deletedRegion", {{"startLine", first + 1}, {"startColumn", 1}, {"endLine", end + 1}, {"endColumn", 1}}}};
        if (!text.empty()) one["insertedContent"] = {{"text", text}};
        out.push_back(std::move(one));
    }
    return out;
}

bool is_due(const JudgedPair& pair) {
    const bool unsettled = pair.standing == PairStanding::Drifted || pair.standing == PairStanding::Review;
    return unsettled && pair.changed && !pair.equivalent;
}

}  // namespace

bool any_fix_is_due(const Judgement& judgement) {
    return std::any_of(judgement.pairs.begin(), judgement.pairs.end(), is_due);
}

std::vector<ProposedFix> proposed_fixes(const CheckedProject& checked, const Disk& disk) {
    constexpr size_t kMost = 20;
    std::vector<ProposedFix> out;
    size_t tried = 0;
    for (size_t i = 0; i < checked.judgement.pairs.size() && tried < kMost; ++i) {
        const JudgedPair& pair = checked.judgement.pairs[i];
        if (!is_due(pair)) continue;
        ++tried;
        try {
            SyncResult result = propose(checked, {i}, WriteSide::Other, disk);
            const Proposal& one = result.proposals.front();
            if (one.state != ProposalState::Proposed || !one.record_patch.empty()) continue;
            ProposedFix fix{pair.id.source, pair.id.target, {}};
            for (auto& [place, file] : result.files)
                fix.files[place.is_elsewhere ? target_path(checked.project.map, place.path) : place.path] =
                    std::move(file);
            out.push_back(std::move(fix));
        } catch (const CannotDo&) {
            continue;  // a check goes on without
        }
    }
    return out;
}

ordered_json sarif_fix(const ProposedFix& fix, const std::string& folder) {
    ordered_json changes = ordered_json::array();
    for (const auto& [path, file] : fix.files) {
        ordered_json all = replacements(file);
        if (all.is_null() || all.empty()) return nullptr;
        const std::string place = std::filesystem::path(folder + path).lexically_normal().generic_string();
        changes.push_back({{"artifactLocation", {{"uri", uri_path(place)}, {"uriBaseId", "%SRCROOT%"}}},
                           {"replacements", std::move(all)}});
    }
    if (changes.empty()) return nullptr;
    return {{"description", {{"text", "The port of this edit, as porttool sync proposes it"}}},
            {"artifactChanges", std::move(changes)}};
}

}  // namespace porttool
