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

}  // namespace

uint64_t edit_distance(std::span<const uint32_t> a, std::span<const uint32_t> b) {
    const Renumbered text(a, b);
    std::vector<uint64_t> rows_of(text.numbers.size(), 0);  // of each symbol, within the strip
    std::vector<int8_t> steps(b.size(), 1);                 // between columns, in the last row so far
    for (size_t first = 0; first < a.size(); first += kRows) {
        const size_t rows = std::min(kRows, a.size() - first);
        for (size_t row = 0; row < rows; ++row) rows_of[text.a[first + row]] |= 1ull << row;
        Strip strip(rows);
        for (size_t column = 0; column < b.size(); ++column)
            steps[column] = static_cast<int8_t>(strip.advance(rows_of[text.b[column]], steps[column]));
        for (size_t row = 0; row < rows; ++row) rows_of[text.a[first + row]] = 0;
    }
    int64_t distance = static_cast<int64_t>(a.size());
    for (const int8_t step : steps) distance += step;
    return static_cast<uint64_t>(distance);
}

double edit_similarity(std::span<const uint32_t> a, std::span<const uint32_t> b) {
    return 1.0 - static_cast<double>(edit_distance(a, b)) / static_cast<double>(std::max(a.size(), b.size()));
}

}  // namespace metrics
