// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/code/token_edit.h"

#include <algorithm>
#include <unordered_map>
#include <vector>

namespace metrics {
namespace {

constexpr size_t kRows = 64;

/// 64 rows of the table of distances, as the differences between neighbours: bits of `up` and `down` are rows whose
/// value is one more or one less than that of the row before.
class Strip {
public:
    explicit Strip(size_t rows) : last_(rows - 1) {}

    /// Goes one column on. `equal` has the rows whose symbol is that of the column; `above` is the step between columns
    /// in the row above the strip. Returns the step in the strip's last row.
    int advance(uint64_t equal, int above) {
        const uint64_t vertical = equal | down_;
        if (above < 0) equal |= 1;
        const uint64_t diagonal = (((equal & up_) + up_) ^ up_) | equal;
        uint64_t more = down_ | ~(diagonal | up_);
        uint64_t less = up_ & diagonal;
        const int step = static_cast<int>((more >> last_) & 1) - static_cast<int>((less >> last_) & 1);
        more = (more << 1) | (above > 0 ? 1 : 0);
        less = (less << 1) | (above < 0 ? 1 : 0);
        up_ = less | ~(vertical | more);
        down_ = more & vertical;
        return step;
    }

private:
    size_t last_;
    uint64_t up_ = ~0ull;
    uint64_t down_ = 0;
};

/// The symbols of both sides as 0, 1, 2 ...
struct Renumbered {
    Renumbered(std::span<const uint32_t> x, std::span<const uint32_t> y) {
        a = number(x);
        b = number(y);
    }
    std::vector<uint32_t> number(std::span<const uint32_t> symbols) {
        std::vector<uint32_t> out;
        out.reserve(symbols.size());
        for (const uint32_t symbol : symbols)
            out.push_back(numbers.try_emplace(symbol, static_cast<uint32_t>(numbers.size())).first->second);
        return out;
    }
    std::unordered_map<uint32_t, uint32_t> numbers;
    std::vector<uint32_t> a, b;
};

/// The two sequences without what both begin and end with, which no shortest edit touches.
void trim(std::span<const uint32_t>& a, std::span<const uint32_t>& b) {
    const size_t same = static_cast<size_t>(std::ranges::mismatch(a, b).in1 - a.begin());
    a = a.subspan(same);
    b = b.subspan(same);
    while (!a.empty() && !b.empty() && a.back() == b.back()) {
        a = a.first(a.size() - 1);
        b = b.first(b.size() - 1);
    }
}

/// The distance by the cells that an edit of at most `most` steps can touch (Ukkonen 1985): with n symbols more in b
/// than in a, at most (most + n) / 2 of the steps go right of the diagonal and (most - n) / 2 below it. Outside of that
/// band each cell is taken for one more than its neighbour within, which none exceeds: so the result is never too
/// small, and exact where it is `most` at most. |b| - |a| must be between -most and most.
uint64_t distance_in_band(const Renumbered& text, uint64_t most) {
    const std::vector<uint32_t>&a = text.a, &b = text.b;
    const int64_t longer = static_cast<int64_t>(b.size()) - static_cast<int64_t>(a.size());
    const auto right = static_cast<size_t>((static_cast<int64_t>(most) + longer) / 2);
    const auto below = static_cast<size_t>((static_cast<int64_t>(most) - longer) / 2);
    std::vector<uint64_t> rows_of(text.numbers.size(), 0);  // of each symbol, within the strip
    std::vector<int8_t> steps(b.size(), 1);                 // between columns, in the last row so far
    int64_t distance = 0;                                   // in the last row so far, left of the strip
    size_t begin = 0;
    for (size_t first = 0; first < a.size(); first += kRows) {
        const size_t rows = std::min(kRows, a.size() - first);
        const size_t end = std::min(b.size(), first + rows + right);
        for (; begin + below < first; ++begin) distance += steps[begin];
        for (size_t row = 0; row < rows; ++row) rows_of[a[first + row]] |= 1ull << row;
        Strip strip(rows);
        for (size_t column = begin; column < end; ++column)
            steps[column] = static_cast<int8_t>(strip.advance(rows_of[b[column]], steps[column]));
        for (size_t row = 0; row < rows; ++row) rows_of[a[first + row]] = 0;
        distance += static_cast<int64_t>(rows);
    }
    for (size_t column = begin; column < b.size(); ++column) distance += steps[column];
    return static_cast<uint64_t>(distance);
}

}  // namespace

std::optional<uint64_t> edit_distance_within(std::span<const uint32_t> a, std::span<const uint32_t> b, uint64_t most) {
    constexpr uint64_t kFirstGuess = 256, kNextGuess = 4;  // a guess that was too small cost a quarter of the next
    trim(a, b);
    const uint64_t longer = std::max(a.size(), b.size());
    const uint64_t difference = longer - std::min(a.size(), b.size());
    if (difference > most) return std::nullopt;
    if (longer == difference) return difference;  // one side has nothing left
    const Renumbered text(a, b);
    for (uint64_t guess = std::max(difference, kFirstGuess);; guess *= kNextGuess) {
        const uint64_t within = std::min({guess, most, longer});
        const uint64_t found = distance_in_band(text, within);
        if (found <= within) return found;
        if (within == most) return std::nullopt;
    }
}

uint64_t edit_distance(std::span<const uint32_t> a, std::span<const uint32_t> b) {
    return *edit_distance_within(a, b, std::max(a.size(), b.size()));
}

double edit_similarity(std::span<const uint32_t> a, std::span<const uint32_t> b) {
    return 1.0 - static_cast<double>(edit_distance(a, b)) / static_cast<double>(std::max(a.size(), b.size()));
}

}  // namespace metrics
