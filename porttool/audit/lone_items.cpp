// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/lone_items.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "porttool/audit/lone_slips.h"
#include "porttool/audit/odd_members.h"

namespace porttool {
namespace {

/// Of those that were read one by one nearly all were real; they are few.
constexpr double kLoneText = 0.6;

/// What is wrong, as it goes on from "the source", and what to do about it.
struct LoneFinding {
    std::string what, remedy;
    bool is_sure = false;  ///< whatever the other side says

    bool operator==(const LoneFinding& other) const { return what == other.what; }
};

class LoneTexts {
public:
    LoneTexts(const Lineages& lineages, const TodaysPairs& today)
        : lineages_(lineages), today_(today), odd_members_(lineages, today.snapshot.states) {
        for (const TodaysPair& pair : today.pairs)
            for (const Side side : kBothSides)
                if (!pair.stray) pair_of_.try_emplace(pair.id[side], pair.id);
    }

    std::vector<AuditItem> run() const {
        std::vector<AuditItem> out;
        std::map<std::pair<Side, std::string>, size_t> told;  // an item by what it says
        for (const Side side : kBothSides)
            for (const auto& [id, unit] : today_.snapshot.states[side])
                for (const LoneFinding& one : findings_of(id, side)) {
                    AuditItem item = item_of(id, side, one);
                    const auto [known, is_new] = told.try_emplace({side, item.summary}, out.size());
                    if (is_new)
                        out.push_back(std::move(item));
                    else
                        out[known->second].same.emplace_back(item.id.source, item.id.target);
                }
        return out;
    }

private:
    std::vector<LoneFinding> read(const std::string& id) const {
        std::vector<LoneFinding> out;
        for (const OddMember& odd : odd_members_.of(id))
            out.push_back({"reads `" + odd.group + "." + odd.member + "` among members of `" + odd.wanted +
                               "`, which has a `" + odd.member + "`, too",
                           "read the member of `" + odd.wanted + "`, or leave it", false});
        const auto lineage = lineages_.find(id);
        if (lineage == lineages_.end()) return out;
        for (LoneSlip& slip : lone_slips(lineage->second.today()))
            out.push_back({std::move(slip.what), std::move(slip.remedy), slip.is_sure});
        return out;
    }

    /// Without what the other side of its pair says, too: that is meant, or it is told of the source alone.
    std::vector<LoneFinding> findings_of(const std::string& id, Side side) const {
        std::vector<LoneFinding> out = read(id);
        const auto pair = pair_of_.find(id);
        if (out.empty() || pair == pair_of_.end()) return out;
        for (const LoneFinding& there : read(pair->second[other(side)]))
            std::erase_if(
                out, [&](const LoneFinding& one) { return one == there && !(one.is_sure && side == Side::Source); });
        return out;
    }

    AuditItem item_of(const std::string& id, Side side, const LoneFinding& found) const {
        AuditItem item;
        item.id[side] = id;
        if (const auto pair = pair_of_.find(id); pair != pair_of_.end()) item.id = pair->second;
        for (const Side one : kBothSides)
            if (!item.id[one].empty()) item.line[one] = today_.snapshot.states[one].at(item.id[one]).start_line;
        item.edited = side;
        item.summary = "the " + std::string(side == Side::Source ? "source" : "target") + " " + found.what;
        item.certainty = kLoneText;
        item.remedy = found.remedy;
        return item;
    }

    const Lineages& lineages_;
    const TodaysPairs& today_;
    OddMembersOfSides odd_members_;
    std::map<std::string, BySide<std::string>> pair_of_;  ///< by id of either side
};

}  // namespace

std::vector<AuditItem> items_of_lone_texts(const Lineages& lineages, const TodaysPairs& today) {
    return LoneTexts(lineages, today).run();
}

}  // namespace porttool
