// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/code/growing_coverage.h"

#include <algorithm>

#include "metrics/code/run_matchers.h"

namespace metrics {

const size_t GrowingCoverage::kMostPairs = MOST_PAIRS;

PrintedSequence::PrintedSequence(std::vector<uint32_t> text, const WinnowingParameters& parameters)
    : symbols(std::move(text)), hashes(kgram_hashes(symbols, parameters)) {
    for (const uint32_t place : winnow(hashes, parameters.w)) prints.emplace_back(hashes[place], place);
    std::sort(prints.begin(), prints.end());
}

std::array<GrowingCoverage::Covered, 2> GrowingCoverage::update(const Members& a, const Members& b) {
    const std::array<const Members*, 2> lists = {&a, &b};
    for (size_t side = 0; side < 2; ++side) {
        std::set<uint32_t> gone;
        for (const auto& [number, known] : known_[side]) gone.insert(number);
        for (const Member& member : *lists[side]) gone.erase(member.number);
        for (const uint32_t number : gone) remove(side, number);
        for (uint32_t order = 0; order < lists[side]->size(); ++order) {
            const Member& member = (*lists[side])[order];
            if (!known_[side].contains(member.number)) add(side, member);
            known_[side].at(member.number).order = order;
        }
    }
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
            if (known.stale) cover(side, known, member.number);
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
        Known& other = known_[1 - side].at(partner);
        other.partners.erase(number);
        other.stale = true;
        matches_.erase(side == 0 ? Pair(number, partner) : Pair(partner, number));
    }
    known_[side].erase(gone);
}

void GrowingCoverage::add(size_t side, const Member& member) {
    known_[side][member.number].sequence = member.sequence;
    for (const auto& [hash, place] : member.sequence->prints) {
        groups_[hash].places[side].push_back({member.number, place});
        touched_.push_back(hash);
    }
    added_[side].insert(member.number);
}

/// Finds the pairs of sequences whose matches of rare fingerprints may be others now.
void GrowingCoverage::regroup() {
    std::sort(touched_.begin(), touched_.end());
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
    for (const uint64_t hash : touched_) {
        const auto at = groups_.find(hash);
        Group& group = at->second;
        const bool was_common = group.common;
        group.common = group.is_common();
        if (group.common)
            common_.insert(hash);
        else if (was_common)
            common_.erase(hash);
        // Pairs that both were there before have changed only where the fingerprint became rare, or common.
        const bool turned = was_common != group.common;
        std::array<std::set<uint32_t>, 2> fresh, old;
        if (!group.common || turned)
            for (size_t side = 0; side < 2; ++side)
                for (const Occurrence& one : group.places[side])
                    (added_[side].contains(one.number) ? fresh : old)[side].insert(one.number);
        const auto add_pairs = [&](const std::set<uint32_t>& in_a, const std::set<uint32_t>& in_b) {
            for (const uint32_t one : in_a)
                for (const uint32_t other : in_b) changed_.insert({one, other});
        };
        if (turned) add_pairs(old[0], old[1]);
        if (!group.common) {
            add_pairs(fresh[0], fresh[1]);
            add_pairs(fresh[0], old[1]);
            add_pairs(old[0], fresh[1]);
        }
        if (group.places[0].empty() && group.places[1].empty()) groups_.erase(at);
    }
}

void GrowingCoverage::match_again(const Pair& pair) {
    Known &a = known_[0].at(pair.first), &b = known_[1].at(pair.second);
    const PrintedSequence &left = *a.sequence, &right = *b.sequence;
    Matcher matcher({left.symbols, left.hashes}, {right.symbols, right.hashes}, parameters_);
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
                for (size_t y = k; y < k_end; ++y) matcher.run(left.prints[x].second, right.prints[y].second);
        i = i_end;
        k = k_end;
    }
    a.stale = b.stale = true;
    if (matcher.matches.empty()) {
        matches_.erase(pair);
        a.partners.erase(pair.second);
        b.partners.erase(pair.first);
    } else {
        matches_[pair] = std::move(matcher.matches);
        a.partners.insert(pair.second);
        b.partners.insert(pair.first);
    }
}

void GrowingCoverage::cover(size_t side, Known& known, uint32_t number) {
    std::vector<TokenMatch> all;
    for (const uint32_t partner : known.partners) {
        const std::vector<TokenMatch>& some = matches_.at(side == 0 ? Pair(number, partner) : Pair(partner, number));
        all.insert(all.end(), some.begin(), some.end());
    }
    const size_t size = known.sequence->symbols.size();
    known.covered = side == 0 ? covered_in_a(all, size) : covered_in_b(all, size);
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
