// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/normal/diff.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <unordered_map>

namespace porttool {
namespace {

// Beyond, two texts are not laid side by side but taken as other texts: all of one went, all of the other came.
constexpr size_t kMostCells = 9'010'000;

/// Two texts without what they begin and end with alike.
struct Middle {
    size_t head = 0, tail = 0, rows = 0, columns = 0;
};

template <class Text>
Middle middle_of(const std::vector<Text>& before, const std::vector<Text>& now) {
    Middle out;
    const size_t least = std::min(before.size(), now.size());
    while (out.head < least && before[out.head] == now[out.head]) ++out.head;
    while (out.tail < least - out.head && before[before.size() - 1 - out.tail] == now[now.size() - 1 - out.tail])
        ++out.tail;
    out.rows = before.size() - out.head - out.tail;
    out.columns = now.size() - out.head - out.tail;
    return out;
}

/// How many entries of two lists can be kept from a row and a column on, for all rows and columns: 64 columns at once,
/// since one column more keeps at most one entry more (Crochemore, Iliopoulos, Pinzon and Reid 2001, from behind).
class WholeTable {
public:
    void fill(const std::vector<size_t>& left, const std::vector<size_t>& right) {
        columns_ = right.size();
        width_ = (columns_ + 63) / 64;
        cells_.assign((left.size() + 1) * width_, {});
        const std::vector<uint64_t> places = places_of(right, 1 + *std::max_element(left.begin(), left.end()));
        for (size_t row = left.size(); row-- > 0;) {
            const Cell* const below = &cells_[(row + 1) * width_];
            const uint64_t* const equal = &places[left[row] * width_];
            Cell* const here = &cells_[row * width_];
            uint64_t carry = 0, kept = 0;
            for (size_t w = 0; w < width_; ++w) {
                const uint64_t same = ~below[w].steps, half = same + (same & equal[w]), sum = half + carry;
                carry = static_cast<uint64_t>(half < same) | static_cast<uint64_t>(sum < half);
                here[w] = {~(sum | (same & ~equal[w])), kept};
                kept += static_cast<uint64_t>(std::popcount(here[w].steps));
            }
        }
    }
    size_t kept(size_t row, size_t column) const {
        const size_t from_end = columns_ - column, word = from_end / 64;
        if (word == width_) return cells_[row * width_ + word - 1].all();
        const Cell& cell = cells_[row * width_ + word];
        return cell.behind + static_cast<size_t>(std::popcount(cell.steps & ((uint64_t{1} << from_end % 64) - 1)));
    }

private:
    /// 64 columns of a row, the last column first.
    struct Cell {
        uint64_t steps = 0;   ///< columns that keep one more than those behind them do
        uint64_t behind = 0;  ///< what is kept behind these columns
        size_t all() const { return behind + static_cast<size_t>(std::popcount(steps)); }
    };

    /// For each number the columns that it stands in.
    std::vector<uint64_t> places_of(const std::vector<size_t>& right, size_t numbers) const {
        std::vector<uint64_t> out(numbers * width_);
        for (size_t i = 0; i < columns_; ++i) out[right[columns_ - 1 - i] * width_ + i / 64] |= uint64_t{1} << i % 64;
        return out;
    }

    std::vector<Cell> cells_;
    size_t columns_ = 0, width_ = 0;
};

/// Lays the middles of two texts side by side, keeping as many entries as possible. What only one of them has takes no
/// part in the table, so that its size is that of what they share.
class Aligner {
public:
    template <class Text>
    Aligner(const std::vector<Text>& before, const std::vector<Text>& now, const Middle& middle) : head_(middle.head) {
        std::unordered_map<Text, Found> words;
        for (size_t i = 0; i < middle.rows; ++i) words.try_emplace(before[head_ + i]);
        for (size_t k = 0; k < middle.columns; ++k) {
            const auto found = words.find(now[head_ + k]);
            columns_.push_back({0, found != words.end()});
            if (columns_.back().shared) found->second.shared = true;
        }
        size_t shared = 0;  // these are numbered among themselves
        for (auto& [word, found] : words)
            if (found.shared) found.number = shared++;
        for (size_t i = 0; i < middle.rows; ++i) {
            const Found& found = words.find(before[head_ + i])->second;
            rows_.push_back({found.number, found.shared});
        }
        for (size_t k = 0; k < middle.columns; ++k)
            if (columns_[k].shared) columns_[k].number = words.find(now[head_ + k])->second.number;
    }

    void run(std::vector<DiffStep>& steps) {
        size_t i = 0, k = 0;
        if (fill()) trace(i, k, steps);
        while (i < rows_.size()) steps.push_back({DiffStep::Remove, head_ + i++, head_ + k});
        while (k < columns_.size()) steps.push_back({DiffStep::Add, head_ + i, head_ + k++});
    }

private:
    struct Found {
        size_t number = 0;
        bool shared = false;
    };
    struct Entry {
        size_t number;
        bool shared;
        bool equals(const Entry& other) const { return shared && other.shared && number == other.number; }
    };

    /// How many entries can be kept from a row and a column on.
    size_t kept(size_t row, size_t column) const {
        return is_whole_ ? whole_.kept(row, column) : kept_in_band(row, column);
    }
    uint32_t kept_in_band(size_t row, size_t column) const {
        const size_t first = first_column(row);
        return column < first || column - first >= width_ ? 0 : kept_[row * width_ + column - first];
    }
    size_t first_column(size_t row) const { return row > reach_ ? row - reach_ : 0; }

    /// Fills the table in. False if it would be too large.
    bool fill() {
        std::vector<size_t> left, right;
        for (const Entry& entry : rows_)
            if (entry.shared) left.push_back(entry.number);
        for (const Entry& entry : columns_)
            if (entry.shared) right.push_back(entry.number);
        if (left.empty()) return false;
        is_whole_ = left.size() + 1 <= kMostCells / (right.size() + 1);
        if (!is_whole_) return fill_narrow(left, right);
        whole_.fill(left, right);
        return true;
    }

    /// Of a table that is too large a band about the diagonal: where little was edited, a narrow one holds every
    /// shortest way; else it is made wider, while that is not too large.
    bool fill_narrow(const std::vector<size_t>& left, const std::vector<size_t>& right) {
        constexpr size_t kNarrowest = 32;
        const size_t longer = std::max(left.size(), right.size()), shorter = std::min(left.size(), right.size());
        for (size_t slack = kNarrowest;; slack *= 4) {
            reach_ = slack + (left.size() > right.size() ? longer - shorter : 0);
            width_ = std::min(right.size() + 1, 2 * slack + longer - shorter + 1);
            if ((left.size() + 1) > kMostCells / width_) return false;
            fill_band(left, right);
            const size_t edits = longer + shorter - 2 * size_t{kept_in_band(0, 0)};
            if (edits <= slack) return true;
        }
    }

    void fill_band(const std::vector<size_t>& left, const std::vector<size_t>& right) {
        kept_.assign((left.size() + 1) * width_, 0);
        for (size_t a = left.size(); a-- > 0;) {
            const size_t first = first_column(a);
            for (size_t b = std::min(right.size(), first + width_); b-- > first;)
                kept_[a * width_ + b - first] = left[a] == right[b]
                                                    ? kept_in_band(a + 1, b + 1) + 1
                                                    : std::max(kept_in_band(a + 1, b), kept_in_band(a, b + 1));
        }
    }

    void trace(size_t& i, size_t& k, std::vector<DiffStep>& steps) {
        size_t a = 0, b = 0;
        while (i < rows_.size() && k < columns_.size()) {
            const size_t next_a = a + (rows_[i].shared ? 1 : 0), next_b = b + (columns_[k].shared ? 1 : 0);
            if (rows_[i].equals(columns_[k])) {
                steps.push_back({DiffStep::Keep, head_ + i++, head_ + k++});
                a = next_a;
                b = next_b;
            } else if (kept(next_a, b) >= kept(a, next_b)) {
                steps.push_back({DiffStep::Remove, head_ + i++, head_ + k});
                a = next_a;
            } else {
                steps.push_back({DiffStep::Add, head_ + i, head_ + k++});
                b = next_b;
            }
        }
    }

    size_t head_;
    std::vector<Entry> rows_, columns_;
    bool is_whole_ = true;
    WholeTable whole_;
    std::vector<uint32_t> kept_;    ///< the band, row by row
    size_t reach_ = 0, width_ = 0;  ///< how far left of the diagonal a row begins, and its length
};

template <class Text>
std::vector<DiffStep> diff_of(const std::vector<Text>& before, const std::vector<Text>& now) {
    const Middle middle = middle_of(before, now);
    std::vector<DiffStep> steps;
    for (size_t i = 0; i < middle.head; ++i) steps.push_back({DiffStep::Keep, i, i});
    if (middle.rows > 0 || middle.columns > 0) Aligner(before, now, middle).run(steps);
    for (size_t t = middle.tail; t > 0; --t) steps.push_back({DiffStep::Keep, before.size() - t, now.size() - t});
    return steps;
}

}  // namespace

std::vector<DiffStep> diff(const Words& before, const Words& now) { return diff_of(before, now); }

std::vector<DiffStep> diff(const std::vector<uint32_t>& before, const std::vector<uint32_t>& now) {
    return diff_of(before, now);
}

size_t words_edited(const Words& before, const Words& now) {
    const std::vector<DiffStep> steps = diff(before, now);
    return static_cast<size_t>(
        std::count_if(steps.begin(), steps.end(), [](const DiffStep& step) { return step.kind != DiffStep::Keep; }));
}

}  // namespace porttool
