// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/review.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "porttool/compare/paired_names.h"
#include "porttool/judge/assess.h"
#include "porttool/judge/settle.h"
#include "porttool/match/match_sets.h"
#include "porttool/read/lock_lines.h"

namespace porttool {
namespace {

constexpr float kSure = 0.9f;  ///< of a pair, from which on nobody need look at it

using Found = std::map<std::string, std::vector<ReviewCandidate>>;

/// What a matching suggests for the units of one side, best first.
Found suggested(const Matching& matching, Side side) {
    Found out;
    for (const MatchedPair& pair : matching.pairs)
        if (pair.state == PairState::Suggested)
            out[side == Side::Source ? pair.source : pair.target].push_back(
                {side == Side::Source ? pair.target : pair.source, pair.score});
    for (auto& [id, candidates] : out)
        std::stable_sort(candidates.begin(), candidates.end(),
                         [](const auto& a, const auto& b) { return a.score > b.score; });
    return out;
}

class Review {
public:
    explicit Review(const CheckedProject& checked)
        : checked_(checked), dialect_(dialect_of_edits(checked.project.map)), sets_(checked.project.map) {}

    std::vector<ReviewItem> run() {
        add_pairs();
        add_units();
        return std::move(out_);
    }

private:
    SetMatching matched(const Settled& settled) const {
        return match_sets(checked_.project.source, checked_.project.target, settled, dialect_, sets_);
    }

    void add_pairs() {
        const LinesByPair lines(checked_.lock);
        std::vector<const JudgedPair*> open;
        CompareBudget budget;
        for (const JudgedPair& pair : checked_.judgement.pairs) {
            if (pair.unit.source == nullptr || pair.unit.target == nullptr) continue;
            const LockedPair* line = lines.find(pair.id.source, pair.id.target);
            const bool verified = line != nullptr && line->state == kVerified;
            if (verified || pair.standing == PairStanding::Ignored || pair.standing == PairStanding::Deferred) continue;
            if (line == nullptr || !says_the_same(assess(*pair.unit.source, *pair.unit.target, dialect_, budget)))
                open.push_back(&pair);
        }
        if (open.empty()) return;
        const Found found = suggested(matched({{}, settled_by(checked_.project.map).ignored}), Side::Source);
        for (const JudgedPair* pair : open)
            add_pair(*pair, found, lines.find(pair->id.source, pair->id.target) == nullptr);
        std::stable_sort(out_.begin(), out_.end(), [](const auto& a, const auto& b) { return a.score < b.score; });
    }

    /// `found`: what the matcher would pair, had nobody said anything.
    void add_pair(const JudgedPair& pair, const Found& found, bool is_new) {
        ReviewItem item{true, Side::Source, pair.id.source, pair.id.target, 0, {}};
        const auto candidates = found.find(pair.unit.source->id);
        if (candidates != found.end())
            for (const ReviewCandidate& one : candidates->second) {
                if (one.id == pair.unit.target->id)
                    item.score = one.score;
                else
                    item.candidates.push_back(one);
            }
        if (is_new || item.score < kSure) out_.push_back(std::move(item));
    }

    void add_units() {
        std::vector<ReviewItem> units;
        std::set<std::string> seen;
        const SetMatching matching = matched(settled_by(checked_.project.map));
        const BySide<Found> found{suggested(matching, Side::Source), suggested(matching, Side::Target)};
        for (const LoneUnit& one : checked_.judgement.lone) {
            const bool said = one.excuse && (!one.line || !checked_.lock.baseline[*one.line].reason.empty());
            if (said || !seen.insert(one.unit->id).second) continue;
            ReviewItem item{false, one.side, "", "", 0, {}};
            (one.side == Side::Source ? item.source : item.target) = one.unit->id;
            if (const auto candidates = found[one.side].find(one.unit->id); candidates != found[one.side].end())
                item.candidates = candidates->second;
            if (!item.candidates.empty()) item.score = item.candidates.front().score;
            units.push_back(std::move(item));
        }
        const auto rank = [&](const ReviewItem& item) {
            const std::string& id = item.side == Side::Source ? item.source : item.target;
            return std::tuple(checked_.states[item.side].at(id).kind != UnitKind::Kernel, -item.score, id);
        };
        std::sort(units.begin(), units.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
        out_.insert(out_.end(), units.begin(), units.end());
    }

    const CheckedProject& checked_;
    Dialect dialect_;
    TargetSets sets_;
    std::vector<ReviewItem> out_;
};

}  // namespace

std::vector<ReviewItem> review_items(const CheckedProject& checked) { return Review(checked).run(); }

}  // namespace porttool
