// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/code/growing_coverage.h"

#include <algorithm>

#include "metrics/code/run_matchers.h"

namespace metrics {

std::array<GrowingCoverage::Covered, 2> GrowingCoverage::update(const Members& a, const Members& b) {
    const std::array<const Members*, 2> lists = {&a, &b};
    for (size_t side = 0; side < 2; ++side) list(side, *lists[side]);
    regroup();
    for (const Pair& pair : changed_) match_again(pair);
    touched_.clear();
    added_ = {};
    changed_.clear();
    std::array<Covered, 2> covered;
    std::array<std::vector<uint32_t>, 2> texts;
    for (size_t side = 0; side < 2; ++side) {
        uint32_t separator = 0xFFFFFFFEu - static_cast<uint32_t>(side);
        for (const Member& member : *lists[side]) {
            Known& known = known_[side].at(member.number);
            if (known.stale) cover(known);
            if (!texts[side].empty()) {
                texts[side].push_back(separator);
                covered[side].symbols.push_back(0);
                separator -= 2;
            }
            covered[side].first.push_back(texts[side].size());
            texts[side].insert(texts[side].end(), known.sequence->symbols.begin(), known.sequence->symbols.end());
            covered[side].symbols.insert(covered[side].symbols.end(), known.covered.begin(), known.covered.end());
        }
    }
    if (!common_.empty()) add_common_matches(texts, covered);
    return covered;
}

void GrowingCoverage::list(size_t side, const Members& members) {
    constexpr uint32_t kGone = 0xFFFFFFFFu;
    for (auto& [number, known] : known_[side]) known.order = kGone;
    std::vector<const Member*> fresh;
    for (uint32_t order = 0; order < members.size(); ++order)
        if (const auto known = known_[side].find(members[order].number); known != known_[side].end())
            known->second.order = order;
        else
            fresh.push_back(&members[order]);
    std::vector<uint32_t> gone;
    for (const auto& [number, known] : known_[side])
        if (known.order == kGone) gone.push_back(number);
    for (const uint32_t number : gone) remove(side, number);
    for (const Member* member : fresh) {
        add(side, *member);
        known_[side].at(member->number).order = static_cast<uint32_t>(member - members.data());
    }
}

void GrowingCoverage::remove(size_t side, uint32_t number) {
    const auto gone = known_[side].find(number);
    uint64_t before = 0;
    bool first = true;
    for (const auto& [hash, place] : gone->second.sequence->prints) {
        if (!first && hash == before) continue;
        first = false;
        before = hash;
        const auto group = groups_.find(hash);
        std::erase_if(group->second.places[side], [&](const Occurrence& one) { return one.number == number; });
        touched_.push_back(hash);
    }
    for (const uint32_t partner : gone->second.partners) {
        const auto matches = matches_.find(side == 0 ? Pair(number, partner) : Pair(partner, number));
        count(1 - side, partner, matches->second, -1);
        matches_.erase(matches);
        known_[1 - side].at(partner).partners.erase(number);
    }
    known_[side].erase(gone);
}

void GrowingCoverage::add(size_t side, const Member& member) {
    Known& known = known_[side][member.number];
    known.sequence = member.sequence;
    known.steps.resize(member.sequence->symbols.size() + 1);
    for (const auto& [hash, place] : member.sequence->prints) {
        groups_[hash].places[side].push_back({member.number, place});
        touched_.push_back(hash);
    }
    added_[side].push_back(member.number);
}

/// Finds the pairs of sequences whose matches of rare fingerprints may be others now: those with a new sequence, and
/// those with a fingerprint that became rare, or common.
void GrowingCoverage::regroup() {
    for (const uint64_t hash : touched_) {
        const auto at = groups_.find(hash);
        if (at == groups_.end()) continue;
        Group& group = at->second;
        if (group.common != group.is_common()) {
            group.common = !group.common;
            if (group.common)
                common_.insert(hash);
            else
                common_.erase(hash);
            note_turned(group);
        }
        if (group.places[0].empty() && group.places[1].empty()) groups_.erase(at);
    }
    for (size_t side = 0; side < 2; ++side)
        for (const uint32_t number : added_[side]) note_fresh(side, number);
    std::sort(changed_.begin(), changed_.end());
    changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
}

void GrowingCoverage::note_turned(const Group& group) {
    std::array<std::set<uint32_t>, 2> numbers;
    for (size_t side = 0; side < 2; ++side)
        for (const Occurrence& one : group.places[side]) numbers[side].insert(one.number);
    for (const uint32_t one : numbers[0])
        for (const uint32_t other : numbers[1]) changed_.emplace_back(one, other);
}

void GrowingCoverage::note_fresh(size_t side, uint32_t number) {
    std::vector<uint32_t> partners;
    for (const auto& [hash, place] : known_[side].at(number).sequence->prints) {
        const Group& group = groups_.at(hash);
        if (!group.common)
            for (const Occurrence& one : group.places[1 - side]) partners.push_back(one.number);
    }
    std::sort(partners.begin(), partners.end());
    partners.erase(std::unique(partners.begin(), partners.end()), partners.end());
    for (const uint32_t partner : partners)
        changed_.push_back(side == 0 ? Pair(number, partner) : Pair(partner, number));
}

void GrowingCoverage::match_again(const Pair& pair) {
    Known &a = known_[0].at(pair.first), &b = known_[1].at(pair.second);
    const PrintedSequence &left = *a.sequence, &right = *b.sequence;
    matcher_.start({left.symbols, left.hashes}, {right.symbols, right.hashes});
    for (size_t i = 0, k = 0; i < left.prints.size() && k < right.prints.size();) {
        const uint64_t hash = left.prints[i].first;
        if (hash != right.prints[k].first) {
            ++(hash < right.prints[k].first ? i : k);
            continue;
        }
        size_t i_end = i, k_end = k;
        while (i_end < left.prints.size() && left.prints[i_end].first == hash) ++i_end;
        while (k_end < right.prints.size() && right.prints[k_end].first == hash) ++k_end;
        if (!common_.contains(hash))
            for (size_t x = i; x < i_end; ++x)
                for (size_t y = k; y < k_end; ++y) matcher_.run(left.prints[x].second, right.prints[y].second);
        i = i_end;
        k = k_end;
    }
    const auto known = matches_.find(pair);
    if (known != matches_.end()) {
        for (size_t side = 0; side < 2; ++side) count(side, side == 0 ? pair.first : pair.second, known->second, -1);
        matches_.erase(known);
    }
    std::vector<TokenMatch> found = matcher_.take();
    if (found.empty()) {
        a.partners.erase(pair.second);
        b.partners.erase(pair.first);
        return;
    }
    for (size_t side = 0; side < 2; ++side) count(side, side == 0 ? pair.first : pair.second, found, 1);
    matches_.emplace(pair, std::move(found));
    a.partners.insert(pair.second);
    b.partners.insert(pair.first);
}

/// Takes matches in (by = 1), or out again (-1).
void GrowingCoverage::count(size_t side, uint32_t number, const std::vector<TokenMatch>& matches, int32_t by) {
    Known& known = known_[side].at(number);
    known.stale = true;
    for (const TokenMatch& match : matches) {
        const uint32_t first = side == 0 ? match.a : match.b;
        known.steps[first] += by;
        known.steps[first + match.length] -= by;
    }
}

void GrowingCoverage::cover(Known& known) {
    known.covered.resize(known.sequence->symbols.size());
    int32_t depth = 0;
    for (size_t i = 0; i < known.covered.size(); ++i) {
        depth += known.steps[i];
        known.covered[i] = depth > 0 ? 1 : 0;
    }
    known.stale = false;
}

void GrowingCoverage::add_common_matches(const std::array<std::vector<uint32_t>, 2>& texts,
                                         std::array<Covered, 2>& covered) {
    std::array<std::vector<std::vector<uint32_t>>, 2> at;  // of each common fingerprint, ascending
    for (const uint64_t hash : common_)
        for (size_t side = 0; side < 2; ++side) {
            std::vector<uint32_t>& places = at[side].emplace_back();
            for (const Occurrence& one : groups_.at(hash).places[side])
                places.push_back(static_cast<uint32_t>(covered[side].first[known_[side].at(one.number).order]) +
                                 one.at);
            std::sort(places.begin(), places.end());
        }
    std::array<std::vector<TokenMatch>, 2> found;
    for (size_t side = 0; side < 2; ++side) {
        std::vector<Place> places;
        for (size_t group = 0; group < at[side].size(); ++group) {
            const std::vector<uint32_t>& own = at[side][group];
            for (uint32_t rank = 0; rank < own.size(); ++rank)
                places.push_back({own[rank], rank, static_cast<uint32_t>(own.size()), at[1 - side][group]});
        }
        std::sort(places.begin(), places.end(), [](const Place& x, const Place& y) { return x.at < y.at; });
        CommonMatcher matcher(texts[side], texts[1 - side], parameters_.k, covered[side].symbols);
        matcher.run(places);
        found[side] = std::move(matcher.matches);
    }
    for (size_t side = 0; side < 2; ++side)
        for (const TokenMatch& match : found[side]) {
            std::fill_n(covered[side].symbols.begin() + match.a, match.length, uint8_t{1});
            std::fill_n(covered[1 - side].symbols.begin() + match.b, match.length, uint8_t{1});
        }
}

}  // namespace metrics
