// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/candidates.h"

#include <algorithm>

#include "porttool/text/parallel.h"

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

/// What one thread looks for candidates with.
class CandidateSearch {
public:
    std::vector<Candidate> run(uint32_t s, const UnitFeatures& source, const std::vector<UnitFeatures>& target,
                               const InvertedIndex& index, size_t most) {
        likeness_.resize(target.size(), 0);
        touched_.clear();
        for (const Bag& bag : source.bags)
            for (const Term& term : bag)
                index.visit(term.id, [&](const Posting& posting) {
                    if (likeness_[posting.unit] == 0) touched_.push_back(posting.unit);
                    likeness_[posting.unit] += term.weight * posting.weight;
                });
        std::erase_if(touched_, [&](uint32_t t) {
            // A constructor is no function's port, nor a destructor's.
            if (target[t].group == source.group && target[t].lifecycle == source.lifecycle) return false;
            likeness_[t] = 0;
            return true;
        });
        const auto better = [&](uint32_t a, uint32_t b) {
            return likeness_[a] != likeness_[b] ? likeness_[a] > likeness_[b] : a < b;
        };
        const size_t kept = std::min(most, touched_.size());
        std::partial_sort(touched_.begin(), touched_.begin() + static_cast<std::ptrdiff_t>(kept), touched_.end(),
                          better);
        std::vector<Candidate> found;
        found.reserve(kept);
        for (size_t i = 0; i < kept; ++i) found.push_back({s, touched_[i], compare_units(source, target[touched_[i]])});
        std::stable_sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
            return a.resemblance.score > b.resemblance.score;
        });
        for (const uint32_t t : touched_) likeness_[t] = 0;
        return found;
    }

private:
    std::vector<float> likeness_;  ///< of each target unit; 0 between runs
    std::vector<uint32_t> touched_;
};

}  // namespace

std::vector<std::vector<Candidate>> find_candidates(const std::vector<UnitFeatures>& source,
                                                    const std::vector<UnitFeatures>& target,
                                                    const std::vector<FixedPair>& fixed, size_t most) {
    const InvertedIndex index(target, count_terms(source, target));
    std::vector<std::vector<Candidate>> all(source.size());
    for (const FixedPair& pair : fixed)
        all[pair.source].push_back({pair.source, pair.target, compare_units(source[pair.source], target[pair.target])});
    constexpr size_t kWorthThreads = 500;
    in_parallel_with<CandidateSearch>(
        source.size(), source.size() > kWorthThreads, [&](size_t s, CandidateSearch& search) {
            if (all[s].empty()) all[s] = search.run(static_cast<uint32_t>(s), source[s], target, index, most);
        });
    return all;
}

}  // namespace porttool
