// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/certainty.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "porttool/audit/message.h"

namespace porttool {
namespace {

std::string shown_statement(const WrittenStatement& statement) {
    std::string out;
    for (const std::string& word : words_of_statement(statement)) (out.empty() ? out : out += ' ') += word;
    return out;
}

/// What stands in the place of what, for telling whether two edits are the same one.
std::string shape_of(const FoundEdit& found) {
    std::string out = found.edit.side == Side::Source ? "s" : "t";
    for (const MissingPlace& place : found.edit.places) out += "\n" + place.before + "\n" + place.now;
    return out;
}

float strength_of(const MissingEdit& edit) {
    float best = 0, rest = 0;
    for (const MissingPlace& place : edit.places) {
        best = std::max(best, place.strength);
        rest += place.strength;
    }
    return std::min(1.0f, best + 0.05f * std::min(2.0f, rest - best));
}

struct Judged {
    double certainty = 0;
    std::vector<std::string> why;
};

Judged judged(const FoundEdit& found, const WalkedPast& walked, const TodaysPairs& today) {
    Judged out;
    const GitStep& step = walked.steps[found.edit.commit];
    const MessageSays says = read_message(step.message);
    const TodaysPair& pair = today.pairs[found.pair];
    double z = -3.0 + 5.0 * static_cast<double>(strength_of(found.edit));
    if (says.fix) {
        z += 1.3;
        out.why.emplace_back("the commit message speaks of a fix");
    } else if (says.manner || says.speed) {
        z -= says.manner ? 0.8 : 1.0;
        out.why.emplace_back(says.manner ? "the commit message speaks of looks or structure"
                                         : "the commit message speaks of speed");
    }
    const auto replaced =
        std::any_of(found.edit.places.begin(), found.edit.places.end(),
                    [](const MissingPlace& place) { return place.kind == MissingPlace::Kind::Replaced; });
    if (replaced) out.why.emplace_back("the text from before the edit still stands on the other side");
    if (std::any_of(found.edit.places.begin(), found.edit.places.end(),
                    [](const MissingPlace& place) { return place.constants_only; })) {
        z += 0.4;
        out.why.emplace_back("constants differ");
    }
    const size_t places = found.edit.places.size();
    if (places > 4) z -= std::min(1.5, 0.15 * static_cast<double>(places - 4));
    const uint32_t units = walked.units[found.edit.commit];
    if (units > 8) {
        z -= std::min(2.5, 0.7 * std::log2(static_cast<double>(units) / 8));
        out.why.push_back("the commit edited " + std::to_string(units) + " units");
    }
    z += 2.0 * (static_cast<double>(found.alike) - 0.4);
    if (!pair.confirmed) z += 3 * (pair.score - 0.9);
    out.certainty = 1 / (1 + std::exp(-z));
    return out;
}

std::string summary_of(const MissingEdit& edit) {
    const MissingPlace& place =
        *std::max_element(edit.places.begin(), edit.places.end(),
                          [](const MissingPlace& a, const MissingPlace& b) { return a.strength < b.strength; });
    const std::string other = edit.side == Side::Source ? "the target" : "the source";
    switch (place.kind) {
        case MissingPlace::Kind::Replaced:
            return other + " still has `" + shown_statement(place.there) + "` where `" + shown_statement(place.before) +
                   "` became `" + shown_statement(place.now) + "`";
        case MissingPlace::Kind::Added:
            return other + " lacks `" + shown_statement(place.now) + "`";
        case MissingPlace::Kind::Removed:
            return other + " still has `" + shown_statement(place.there) + "`, which went";
    }
    return "";
}

}  // namespace

std::vector<AuditItem> ranked(std::vector<FoundEdit> found, const WalkedPast& walked, const TodaysPairs& today,
                              const Dialect&) {
    std::map<std::pair<uint32_t, std::string>, size_t> folded;  // by commit and what was done: an item
    std::vector<AuditItem> out;
    for (FoundEdit& one : found) {
        const Judged judgement = judged(one, walked, today);
        const TodaysPair& pair = today.pairs[one.pair];
        const auto [known, is_new] = folded.try_emplace({one.edit.commit, shape_of(one)}, out.size());
        if (!is_new) {
            AuditItem& first = out[known->second];
            first.same.emplace_back(pair.id.source, pair.id.target);
            first.certainty = std::max(first.certainty, judgement.certainty);
            continue;
        }
        AuditItem item;
        item.id = pair.id;
        for (const Side side : kBothSides) item.line[side] = today.unit(pair, side).start_line;
        item.edited = one.edit.side;
        item.commit = walked.steps[one.edit.commit].commit;
        item.summary = summary_of(one.edit);
        item.certainty = judgement.certainty;
        item.why = judgement.why;
        item.places = std::move(one.edit.places);
        item.remedy = "porttool ignore '" + pair.id.source + "=" + pair.id.target + "' --reason TEXT";
        out.push_back(std::move(item));
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const AuditItem& a, const AuditItem& b) { return a.certainty > b.certainty; });
    return out;
}

}  // namespace porttool
