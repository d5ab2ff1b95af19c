// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/code/winnowing.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "metrics/code/run_matchers.h"

namespace metrics {
namespace {

/// Spreads the bits of a word (SplitMix64's finaliser).
uint64_t spread(uint64_t x) {
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
    return x ^ (x >> 31);
}

using Prints = std::vector<std::pair<uint64_t, uint32_t>>;  // hashes with their places

/// A sequence with its hashes, and the places of its fingerprints by hash, then place.
struct Side {
    std::span<const uint32_t> symbols;
    std::span<const uint64_t> hashes;
    std::vector<uint32_t> by_hash;
};

std::vector<uint32_t> places_of(const Prints& prints) {
    std::vector<uint32_t> places;
    places.reserve(prints.size());
    for (const auto& [hash, place] : prints) places.push_back(place);
    return places;
}

/// The places of the fingerprints of all runs between separators.
std::vector<uint32_t> places_of(std::span<const uint32_t> text, std::span<const uint64_t> hashes,
                                const WinnowingParameters& parameters) {
    Prints prints;
    for (size_t first = 0; first < text.size();) {
        const auto end = static_cast<size_t>(std::find_if(text.begin() + static_cast<ptrdiff_t>(first), text.end(),
                                                          [](uint32_t s) { return s >= FIRST_SEPARATOR; }) -
                                             text.begin());
        if (end - first >= parameters.k)
            for (const uint32_t place : winnow(hashes.subspan(first, end - first + 1 - parameters.k), parameters.w))
                prints.emplace_back(hashes[first + place], static_cast<uint32_t>(first + place));
        first = end + 1;
    }
    std::sort(prints.begin(), prints.end());
    return places_of(prints);
}

/// The fingerprints of either side that have one hash: ranges of Side::by_hash.
struct Group {
    std::span<const uint32_t> a, b;
};

std::vector<Group> shared_groups(const Side& a, const Side& b) {
    std::vector<Group> groups;
    auto end_of_run = [](const Side& side, size_t first) {
        size_t end = first;
        while (end < side.by_hash.size() && side.hashes[side.by_hash[end]] == side.hashes[side.by_hash[first]]) ++end;
        return end;
    };
    size_t i = 0, k = 0;
    while (i < a.by_hash.size() && k < b.by_hash.size()) {
        const uint64_t left = a.hashes[a.by_hash[i]], right = b.hashes[b.by_hash[k]];
        const size_t i_end = left <= right ? end_of_run(a, i) : i;
        const size_t k_end = right <= left ? end_of_run(b, k) : k;
        if (left == right)
            groups.push_back({std::span(a.by_hash).subspan(i, i_end - i), std::span(b.by_hash).subspan(k, k_end - k)});
        i = i_end;
        k = k_end;
    }
    return groups;
}

/// The occurrences on one side, ascending.
std::vector<Place> places_in(const std::vector<Group>& groups, bool in_a) {
    std::vector<Place> places;
    for (const Group& group : groups) {
        const std::span<const uint32_t> own = in_a ? group.a : group.b;
        for (uint32_t rank = 0; rank < own.size(); ++rank)
            places.push_back({own[rank], rank, static_cast<uint32_t>(own.size()), in_a ? group.b : group.a});
    }
    std::sort(places.begin(), places.end(), [](const Place& x, const Place& y) { return x.at < y.at; });
    return places;
}

bool by_place(const TokenMatch& x, const TokenMatch& y) {
    if (x.a != y.a) return x.a < y.a;
    return x.b != y.b ? x.b < y.b : x.length < y.length;
}

std::vector<uint8_t> covered(std::span<const TokenMatch> matches, size_t size, uint32_t TokenMatch::*start) {
    std::vector<int32_t> change(size + 1, 0);
    for (const TokenMatch& match : matches) {
        ++change[match.*start];
        --change[match.*start + match.length];
    }
    std::vector<uint8_t> out(size);
    int32_t depth = 0;
    for (size_t i = 0; i < size; ++i) {
        depth += change[i];
        out[i] = depth > 0 ? 1 : 0;
    }
    return out;
}

/// Marks ranges and tells whether they held anything unmarked; skips what is marked in nearly constant time.
class Marker {
public:
    explicit Marker(size_t size) : next_(size + 1) { std::iota(next_.begin(), next_.end(), 0u); }

    bool mark(uint32_t first, uint32_t length) {
        bool fresh = false;
        for (uint32_t at = find(first); at < first + length; at = find(at)) {
            next_[at] = at + 1;
            fresh = true;
        }
        return fresh;
    }

private:
    uint32_t find(uint32_t at) {
        while (next_[at] != at) {
            next_[at] = next_[next_[at]];
            at = next_[at];
        }
        return at;
    }

    std::vector<uint32_t> next_;
};

std::vector<TokenMatch> matches_of(const Side& left, const Side& right, const WinnowingParameters& parameters) {
    std::vector<Group> common, rare;
    for (const Group& group : shared_groups(left, right))
        (group.a.size() * group.b.size() > MOST_PAIRS ? common : rare).push_back(group);
    Matcher matcher(parameters);
    matcher.start({left.symbols, left.hashes}, {right.symbols, right.hashes});
    for (const Place& place : places_in(rare, true))
        for (const uint32_t partner : place.partners) matcher.run(place.at, partner);
    std::vector<TokenMatch> matches = matcher.take();
    if (!common.empty()) {
        CommonMatcher in_a(left.symbols, right.symbols, parameters.k, covered_in_a(matches, left.symbols.size()));
        CommonMatcher in_b(right.symbols, left.symbols, parameters.k, covered_in_b(matches, right.symbols.size()));
        in_a.run(places_in(common, true));
        in_b.run(places_in(common, false));
        matches.insert(matches.end(), in_a.matches.begin(), in_a.matches.end());
        for (const TokenMatch& match : in_b.matches) matches.push_back({match.b, match.a, match.length});
    }
    std::sort(matches.begin(), matches.end(), by_place);
    matches.erase(std::unique(matches.begin(), matches.end()), matches.end());
    return matches;
}

}  // namespace

std::vector<uint64_t> kgram_hashes(std::span<const uint32_t> symbols, const WinnowingParameters& parameters) {
    const uint32_t k = parameters.k;
    if (k == 0 || symbols.size() < k) return {};
    constexpr uint64_t kBase = 0x9E3779B97F4A7C15ull;
    uint64_t highest = 1;
    for (uint32_t i = 1; i < k; ++i) highest *= kBase;
    const uint32_t shift = 64 - std::clamp(parameters.hash_bits, 1u, 64u);
    std::vector<uint64_t> hashes(symbols.size() - k + 1);
    uint64_t hash = 0;
    for (size_t i = 0; i < symbols.size(); ++i) {
        if (i >= k) hash -= spread(symbols[i - k] + 1ull) * highest;
        hash = hash * kBase + spread(symbols[i] + 1ull);
        if (i + 1 >= k) hashes[i + 1 - k] = spread(hash) >> shift;
    }
    return hashes;
}

std::vector<uint32_t> winnow(std::span<const uint64_t> hashes, uint32_t w) {
    std::vector<uint32_t> selected;
    if (hashes.empty() || w == 0) return selected;
    const size_t window = std::min<size_t>(w, hashes.size());
    auto rightmost_least = [&](size_t first, size_t end) {
        size_t least = first;
        for (size_t i = first + 1; i < end; ++i)
            if (hashes[i] <= hashes[least]) least = i;
        return least;
    };
    size_t at = rightmost_least(0, window);
    selected.push_back(static_cast<uint32_t>(at));
    for (size_t end = window + 1; end <= hashes.size(); ++end) {
        const bool left_behind = at < end - window;
        if (!left_behind && hashes[end - 1] >= hashes[at]) continue;
        at = left_behind ? rightmost_least(end - window, end) : end - 1;
        selected.push_back(static_cast<uint32_t>(at));
    }
    return selected;
}

PrintedSequence::PrintedSequence(std::vector<uint32_t> text, const WinnowingParameters& parameters)
    : symbols(std::move(text)), hashes(kgram_hashes(symbols, parameters)) {
    for (const uint32_t place : winnow(hashes, parameters.w)) prints.emplace_back(hashes[place], place);
    std::sort(prints.begin(), prints.end());
}

std::vector<TokenMatch> winnowing_matches(std::span<const uint32_t> a, std::span<const uint32_t> b,
                                          const WinnowingParameters& parameters) {
    const std::vector<uint64_t> in_a = kgram_hashes(a, parameters), in_b = kgram_hashes(b, parameters);
    return matches_of({a, in_a, places_of(a, in_a, parameters)}, {b, in_b, places_of(b, in_b, parameters)}, parameters);
}

std::vector<TokenMatch> winnowing_matches(const PrintedSequence& a, const PrintedSequence& b,
                                          const WinnowingParameters& parameters) {
    return matches_of({a.symbols, a.hashes, places_of(a.prints)}, {b.symbols, b.hashes, places_of(b.prints)},
                      parameters);
}

std::vector<uint8_t> covered_in_a(std::span<const TokenMatch> matches, size_t size) {
    return covered(matches, size, &TokenMatch::a);
}

std::vector<uint8_t> covered_in_b(std::span<const TokenMatch> matches, size_t size) {
    return covered(matches, size, &TokenMatch::b);
}

std::vector<TokenMatch> essential_matches(std::vector<TokenMatch> matches, size_t size_a, size_t size_b) {
    std::stable_sort(matches.begin(), matches.end(),
                     [](const TokenMatch& x, const TokenMatch& y) { return x.length > y.length; });
    Marker in_a(size_a), in_b(size_b);
    std::erase_if(matches, [&](const TokenMatch& match) {
        const bool fresh_a = in_a.mark(match.a, match.length);
        const bool fresh_b = in_b.mark(match.b, match.length);
        return !fresh_a && !fresh_b;
    });
    std::sort(matches.begin(), matches.end(), by_place);
    return matches;
}

}  // namespace metrics
