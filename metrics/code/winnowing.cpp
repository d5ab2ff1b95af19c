// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/code/winnowing.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace metrics {
namespace {

/// Spreads the bits of a word (SplitMix64's finaliser).
uint64_t spread(uint64_t x) {
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
    return x ^ (x >> 31);
}

/// A sequence with its hashes, and its fingerprints sorted by hash, then place.
struct Side {
    Side(std::span<const uint32_t> text, const WinnowingParameters& parameters)
        : symbols(text), hashes(kgram_hashes(text, parameters)) {
        std::vector<std::pair<uint64_t, uint32_t>> prints;
        for (size_t first = 0; first < text.size();) {
            const auto end = static_cast<size_t>(std::find_if(text.begin() + static_cast<ptrdiff_t>(first), text.end(),
                                                              [](uint32_t s) { return s >= FIRST_SEPARATOR; }) -
                                                 text.begin());
            if (end - first >= parameters.k) add_prints(first, end - first + 1 - parameters.k, parameters.w, prints);
            first = end + 1;
        }
        std::sort(prints.begin(), prints.end());
        by_hash.reserve(prints.size());
        for (const auto& [hash, place] : prints) by_hash.push_back(place);
    }

    std::span<const uint32_t> symbols;
    std::vector<uint64_t> hashes;
    std::vector<uint32_t> by_hash;

private:
    /// Winnows the hashes of one run.
    void add_prints(size_t first, size_t count, uint32_t w, std::vector<std::pair<uint64_t, uint32_t>>& prints) const {
        for (const uint32_t place : winnow(std::span(hashes).subspan(first, count), w))
            prints.emplace_back(hashes[first + place], static_cast<uint32_t>(first + place));
    }
};

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

/// An occurrence of a shared fingerprint on one side: where it stands, its rank among those of its side, and the
/// occurrences on the other side.
struct Place {
    uint32_t at;
    uint32_t rank, of;
    std::span<const uint32_t> partners;
};

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

/// Finds and extends matches; remembers on each diagonal (b - a) the last one, to extend nothing twice.
class Matcher {
public:
    Matcher(const Side& a, const Side& b, const WinnowingParameters& parameters)
        : a_(a), b_(b), k_(parameters.k), w_(parameters.w), last_(a.symbols.size() + b.symbols.size() + 1) {}

    std::vector<TokenMatch> matches;

    /// All pairs of each place, and the pairs beside them that have the same hash: where a k-gram comes twice in one
    /// window the two sides may have selected different ones of it, on different diagonals.
    void run(const std::vector<Place>& places) {
        for (const Place& place : places)
            for (const uint32_t partner : place.partners) {
                match(place.at, partner);
                match_beside(place.at, partner);
            }
    }

private:
    void match_beside(uint32_t i, uint32_t j) {
        const std::vector<uint64_t>&x = a_.hashes, &y = b_.hashes;
        for (uint32_t step = 1; step < w_; ++step) {
            if (j + step < y.size() && y[j + step] == y[j]) match(i, j + step);
            if (j >= step && y[j - step] == y[j]) match(i, j - step);
            if (i + step < x.size() && x[i + step] == x[i]) match(i + step, j);
            if (i >= step && x[i - step] == x[i]) match(i - step, j);
        }
    }

    void match(uint32_t i, uint32_t j) {
        TokenMatch& last = last_[j + a_.symbols.size() - i];
        if (i >= last.a && i < last.a + last.length) return;
        const std::span<const uint32_t> x = a_.symbols, y = b_.symbols;
        uint32_t end = 0;
        while (i + end < x.size() && j + end < y.size() && x[i + end] == y[j + end]) ++end;
        if (end < k_) return;  // a collision of hashes
        uint32_t before = 0;
        while (before < i && before < j && x[i - before - 1] == y[j - before - 1]) ++before;
        last = {i - before, j - before, before + end};
        matches.push_back(last);
    }

    const Side& a_;
    const Side& b_;
    uint32_t k_, w_;
    std::vector<TokenMatch> last_;
};

/// Holds the occurrences of very common fingerprints on one side against a few partners each, skipping what is covered.
class CommonMatcher {
public:
    CommonMatcher(const Side& own, const Side& other, uint32_t k, std::vector<uint8_t> covered)
        : own_(own), other_(other), k_(k), covered_(std::move(covered)) {}

    std::vector<TokenMatch> matches;  ///< a: own side

    void run(const std::vector<Place>& places) {
        int64_t diagonal = 0;
        for (const Place& place : places) {
            if (is_covered(place.at)) continue;
            TokenMatch best;
            auto attempt = [&](int64_t partner) {
                if (partner < 0 || partner >= static_cast<int64_t>(other_.hashes.size())) return;
                const TokenMatch found = extend(place.at, static_cast<uint32_t>(partner));
                if (found.length > best.length) best = found;
            };
            attempt(place.at + diagonal);
            const size_t count = place.partners.size();
            attempt(place.partners[std::min<size_t>(place.rank, count - 1)]);
            constexpr size_t kSpread = 6;
            for (size_t step = 0; step < kSpread; ++step)
                attempt(place.partners[(static_cast<size_t>(place.rank) * count / place.of + step * count / kSpread) %
                                       count]);
            if (best.length < k_) continue;
            diagonal = static_cast<int64_t>(best.b) - best.a;
            std::fill_n(covered_.begin() + best.a, best.length, uint8_t{1});
            matches.push_back(best);
        }
    }

private:
    bool is_covered(uint32_t at) const {
        return std::find(covered_.begin() + at, covered_.begin() + at + k_, 0) == covered_.begin() + at + k_;
    }

    /// To the right as far as it goes; to the left as far as nothing is covered yet, which keeps the time linear.
    TokenMatch extend(uint32_t i, uint32_t j) const {
        const std::span<const uint32_t> x = own_.symbols, y = other_.symbols;
        uint32_t end = 0;
        while (i + end < x.size() && j + end < y.size() && x[i + end] == y[j + end]) ++end;
        if (end < k_) return {};
        uint32_t before = 0;
        while (before < i && before < j && covered_[i - before - 1] == 0 && x[i - before - 1] == y[j - before - 1])
            ++before;
        return {i - before, j - before, before + end};
    }

    const Side& own_;
    const Side& other_;
    uint32_t k_;
    std::vector<uint8_t> covered_;
};

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

std::vector<TokenMatch> winnowing_matches(std::span<const uint32_t> a, std::span<const uint32_t> b,
                                          const WinnowingParameters& parameters) {
    const Side left(a, parameters), right(b, parameters);
    constexpr size_t kMostPairs = 1024;
    std::vector<Group> common, rare;
    for (const Group& group : shared_groups(left, right))
        (group.a.size() * group.b.size() > kMostPairs ? common : rare).push_back(group);
    Matcher matcher(left, right, parameters);
    matcher.run(places_in(rare, true));
    std::vector<TokenMatch> matches = std::move(matcher.matches);
    if (!common.empty()) {
        CommonMatcher in_a(left, right, parameters.k, covered_in_a(matches, a.size()));
        CommonMatcher in_b(right, left, parameters.k, covered_in_b(matches, b.size()));
        in_a.run(places_in(common, true));
        in_b.run(places_in(common, false));
        matches.insert(matches.end(), in_a.matches.begin(), in_a.matches.end());
        for (const TokenMatch& match : in_b.matches) matches.push_back({match.b, match.a, match.length});
    }
    std::sort(matches.begin(), matches.end(), by_place);
    matches.erase(std::unique(matches.begin(), matches.end()), matches.end());
    return matches;
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
