// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/port_patch.h"

#include <algorithm>

#include "porttool/judge/first_record.h"
#include "porttool/read/clock.h"
#include "porttool/sync/propose.h"

namespace porttool {
namespace {

/// Where a statement stands in a text; the end if it does not, or stands there twice.
size_t only_place(const std::vector<std::string>& text, const std::vector<std::string>& statement) {
    const auto begins = [&](size_t i) {
        return i == 0 || text[i - 1] == ";" || text[i - 1] == "{" || text[i - 1] == "}" || text[i - 1] == ":" ||
               text[i - 1] == ")" || text[i - 1] == "else";
    };
    size_t found = text.size();
    for (size_t i = 0; i + statement.size() <= text.size(); ++i) {
        if (!begins(i) || !std::equal(statement.begin(), statement.end(), text.begin() + static_cast<ptrdiff_t>(i)))
            continue;
        if (found != text.size()) return text.size();
        found = i;
    }
    return found;
}

/// Takes back what was done in one place. False where that cannot be told.
bool take_back(std::vector<std::string>& text, const MissingPlace& place) {
    if (place.now.empty()) return false;
    const std::vector<std::string> now = words_of_statement(place.now), before = words_of_statement(place.before);
    const size_t at = only_place(text, now);
    if (at == text.size()) return false;
    size_t end = at + now.size();
    if (before.empty() && now.back() != ":") {  // a statement of its own, not the head of a block
        if (end >= text.size() || text[end] != ";") return false;
        ++end;
    }
    text.erase(text.begin() + static_cast<ptrdiff_t>(at), text.begin() + static_cast<ptrdiff_t>(end));
    text.insert(text.begin() + static_cast<ptrdiff_t>(at), before.begin(), before.end());
    return true;
}

}  // namespace

NormalText text_without(const UnitState& unit, const std::vector<MissingPlace>& places) {
    const Words words = unit.text.words();
    std::vector<std::string> text(words.begin(), words.end());
    NormalText out;
    size_t taken = 0;
    for (const MissingPlace& place : places) taken += take_back(text, place) ? 1 : 0;
    if (taken == 0) return out;
    for (const std::string& word : text) out.add(word);
    return out;
}

PortPatches::PortPatches(TodaysPairs& today, const Disk& disk) : checked_{std::move(today.snapshot)}, disk_(disk) {
    checked_.project.map.pairs.clear();
    for (const TodaysPair& pair : today.pairs) checked_.project.map.pairs.push_back({pair.id.source, {pair.id.target}});
    checked_.project.map.rules.clear();
    checked_.recorded = true;
}

bool PortPatches::add_to(AuditItem& item) {
    if (!item.commit) return true;  // which side is right, nobody knows
    const UnitState& unit = checked_.states[item.edited].at(item.id[item.edited]);
    const NormalText before = text_without(unit, item.places);
    if (before.empty()) return true;
    checked_.lock = first_lock(checked_.project.map, checked_.states);
    const Fingerprints prints = prints_of_text(before);
    checked_.texts = {{prints.written, before}};
    for (LockedPair& line : checked_.lock.pairs)
        if (line.source == item.id.source && line.target == item.id.target)
            (item.edited == Side::Source ? line.source_prints : line.target_prints) = prints;
    const auto text_of = [&](Print print) {
        const auto found = checked_.texts.find(print);
        return found == checked_.texts.end() ? NormalText() : found->second.get();
    };
    checked_.judgement = judge(
        {checked_.project.map, checked_.lock, checked_.states.source, checked_.states.target, {}, text_of, today()});
    for (size_t i = 0; i < checked_.judgement.pairs.size(); ++i) {
        const JudgedPair& pair = checked_.judgement.pairs[i];
        if (pair.id != item.id || !pair.changed) continue;
        const WriteSide side = item.edited == Side::Source ? WriteSide::Target : WriteSide::Source;
        const SyncResult result = propose(checked_, {i}, side, disk_);
        const Proposal& proposal = result.proposals.front();
        const bool widens =
            std::any_of(item.places.begin(), item.places.end(), [](const MissingPlace& place) { return place.widens; });
        if (proposal.state == ProposalState::Already) return widens;  // a type may differ where no value seems to
        const bool in_place = std::all_of(item.places.begin(), item.places.end(), [](const MissingPlace& place) {
            return place.kind == MissingPlace::Kind::Replaced;
        });
        if (proposal.state == ProposalState::Proposed || (proposal.state == ProposalState::Partial && in_place))
            item.patch = proposal.patch;
        if (!item.patch.empty() && !proposal.left.empty())
            item.why.push_back("the patch is no whole port: " + proposal.left.front().message);
        return true;
    }
    return true;
}

}  // namespace porttool
