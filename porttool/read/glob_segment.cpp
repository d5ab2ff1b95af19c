// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/glob_segment.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace porttool {
namespace {

/// Steps after which a greedy walk that goes back again and again is given up.
constexpr size_t kWorthStates = 64;

/// Matches `[...]` at `at`, which moves past it.
bool class_matches(std::string_view pattern, size_t& at, char c) {
    size_t i = at + 1;
    const bool negated = i < pattern.size() && (pattern[i] == '!' || pattern[i] == '^');
    if (negated) ++i;
    if (pattern.find(']', i + 1) == std::string_view::npos) {  // no end: a plain bracket
        ++at;
        return c == '[';
    }
    bool found = false;
    for (bool first = true; first || pattern[i] != ']'; first = false, ++i) {
        if (i + 2 < pattern.size() && pattern[i + 1] == '-' && pattern[i + 2] != ']') {
            found = found || (pattern[i] <= c && c <= pattern[i + 2]);
            i += 2;
        } else {
            found = found || pattern[i] == c;
        }
    }
    at = i + 1;
    return found != negated;
}

/// True for what takes itself alone.
bool is_itself_alone(char c) { return c != '*' && c != '?' && c != '[' && c != '\\'; }

/// How many plain characters both begin with. Most patterns are told apart from most names by these.
size_t plain_start(std::string_view pattern, std::string_view name) {
    size_t count = 0;
    while (count < pattern.size() && count < name.size() && pattern[count] == name[count] &&
           is_itself_alone(pattern[count]))
        ++count;
    return count;
}

/// Matches one place of a pattern that takes one character, at `at`, which moves past it.
bool place_matches(std::string_view pattern, size_t& at, char c) {
    if (pattern[at] == '[') return class_matches(pattern, at, c);
    const bool is_any = pattern[at] == '?';
    if (pattern[at] == '\\' && at + 1 < pattern.size()) ++at;
    return pattern[at++] == c || is_any;
}

/// All places of a pattern that a beginning of a name may have come to, one bit for each (Baeza-Yates and Gonnet 1992,
/// "A new approach to text searching"): nothing is walked twice, whatever stands behind the stars.
class SegmentStates {
public:
    explicit SegmentStates(std::string_view pattern) : pattern_(pattern) {
        std::vector<size_t> stars;
        size_t place = 0;
        for (size_t at = 0; at < pattern.size();) {
            if (pattern[at] == '*') {
                stars.push_back(place);
                ++at;
                continue;
            }
            starts_.push_back(at);
            place_matches(pattern, at, '\0');
            ++place;
        }
        words_ = place / kBits + 1;
        stays_.resize(words_);
        for (const size_t star : stars) set(stays_, star);
    }

    bool match(std::string_view name) {
        std::vector<uint64_t> reached(words_);
        set(reached, 0);
        for (const char c : name) {
            const std::vector<uint64_t>& takes = places_of(c);
            uint64_t carry = 0;
            for (size_t i = 0; i < words_; ++i) {
                const uint64_t went = reached[i] & takes[i];
                reached[i] = (reached[i] & stays_[i]) | went << 1 | carry;
                carry = went >> (kBits - 1);
            }
        }
        return (reached[starts_.size() / kBits] >> starts_.size() % kBits & 1) != 0;
    }

private:
    static constexpr size_t kBits = 64;
    using Places = std::vector<uint64_t>;

    static void set(Places& places, size_t place) { places[place / kBits] |= uint64_t{1} << place % kBits; }

    /// The places that a character may go on from.
    const Places& places_of(char c) {
        std::optional<Places>& known = places_[static_cast<unsigned char>(c)];
        if (!known) {
            known.emplace(words_);
            for (size_t place = 0; place < starts_.size(); ++place) {
                size_t at = starts_[place];
                if (place_matches(pattern_, at, c)) set(*known, place);
            }
        }
        return *known;
    }

    std::string_view pattern_;
    std::vector<size_t> starts_;  ///< of each place that takes one character
    size_t words_ = 1;
    Places stays_;  ///< where a star takes any character
    std::array<std::optional<Places>, 256> places_;
};

}  // namespace

bool segment_matches(std::string_view pattern, std::string_view name) {
    size_t p = plain_start(pattern, name), n = p, steps = 0;
    if (p < pattern.size() && is_itself_alone(pattern[p])) return false;
    size_t star = std::string_view::npos, star_name = 0;
    const size_t most_steps = kWorthStates + 4 * (pattern.size() + name.size());
    while (n < name.size()) {
        if (++steps > most_steps) return SegmentStates(pattern).match(name);
        bool fits = false;
        size_t next = p;
        if (p < pattern.size()) {
            if (pattern[p] == '*') {
                star = p++;
                star_name = n;
                continue;
            }
            fits = place_matches(pattern, next, name[n]);
            steps += next - p;
        }
        if (fits) {
            p = next;
            ++n;
        } else if (star != std::string_view::npos) {
            p = star + 1;
            n = ++star_name;
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == '*') ++p;
    return p == pattern.size();
}

}  // namespace porttool
