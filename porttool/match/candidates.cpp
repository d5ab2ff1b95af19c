// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/candidates.h"

#include <algorithm>

namespace porttool {
namespace {

struct Posting {
    uint32_t unit;
    float weight;
};

/// Postings of all terms, one after the other.
class InvertedIndex {
public:
    InvertedIndex(const std::vector<UnitFeatures>& units, size_t terms) : starts_(terms + 2, 0) {
        for_each_term(units, [&](uint32_t, const Term& term, float) { ++starts_[term.id + 2]; });
        for (size_t i = 2; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
        postings_.resize(starts_.back());
        for_each_term(units, [&](uint32_t unit, const Term& term, float weight) {
            postings_[starts_[term.id + 1]++] = {unit, weight * term.weight};
        });
    }

    /// Calls visit(posting) for a term, unless it stands in so many units that it tells nothing apart.
    template <class Visit>
    void visit(uint32_t term, const Visit& visit) const {
        constexpr size_t kTooCommon = 400;
        const size_t first = starts_[term], end = starts_[term + 1];
        if (end - first > kTooCommon) return;
        for (size_t i = first; i < end; ++i) visit(postings_[i]);
    }

private:
    template <class Use>
    static void for_each_term(const std::vector<UnitFeatures>& units, const Use& use) {
        for (uint32_t unit = 0; unit < units.size(); ++unit)
            for (size_t family = 0; family < kFamilies; ++family)
                for (const Term& term : units[unit].bags[family]) use(unit, term, kFamilyWeights[family]);
    }

    std::vector<size_t> starts_;
    std::vector<Posting> postings_;
};

size_t count_terms(const std::vector<UnitFeatures>& a, const std::vector<UnitFeatures>& b) {
    uint32_t largest = 0;
    for (const auto* side : {&a, &b})
        for (const UnitFeatures& unit : *side)
            for (const Bag& bag : unit.bags)
                if (!bag.empty()) largest = std::max(largest, bag.back().id);
    return largest + 1;
}

}  // namespace

std::vector<std::vector<Candidate>> find_candidates(const std::vector<UnitFeatures>& source,
                                                    const std::vector<UnitFeatures>& target,
                                                    const std::vector<FixedPair>& fixed, size_t most) {
    const InvertedIndex index(target, count_terms(source, target));
    std::vector<std::vector<Candidate>> all(source.size());
    for (const FixedPair& pair : fixed)
        all[pair.source].push_back({pair.source, pair.target, compare_units(source[pair.source], target[pair.target])});
    std::vector<float> likeness(target.size(), 0);
    std::vector<uint32_t> touched;
    for (uint32_t s = 0; s < source.size(); ++s) {
        if (!all[s].empty()) continue;
        touched.clear();
        for (const Bag& bag : source[s].bags)
            for (const Term& term : bag)
                index.visit(term.id, [&](const Posting& posting) {
                    if (likeness[posting.unit] == 0) touched.push_back(posting.unit);
                    likeness[posting.unit] += term.weight * posting.weight;
                });
        std::erase_if(touched, [&](uint32_t t) {
            // A constructor is no function's port, nor a destructor's.
            if (target[t].group == source[s].group && target[t].lifecycle == source[s].lifecycle) return false;
            likeness[t] = 0;
            return true;
        });
        const auto better = [&](uint32_t a, uint32_t b) {
            return likeness[a] != likeness[b] ? likeness[a] > likeness[b] : a < b;
        };
        const size_t kept = std::min(most, touched.size());
        std::partial_sort(touched.begin(), touched.begin() + static_cast<std::ptrdiff_t>(kept), touched.end(), better);
        for (size_t i = 0; i < kept; ++i)
            all[s].push_back({s, touched[i], compare_units(source[s], target[touched[i]])});
        std::stable_sort(all[s].begin(), all[s].end(), [](const Candidate& a, const Candidate& b) {
            return a.resemblance.score > b.resemblance.score;
        });
        for (const uint32_t t : touched) likeness[t] = 0;
    }
    return all;
}

}  // namespace porttool
