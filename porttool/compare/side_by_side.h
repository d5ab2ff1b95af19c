// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "porttool/compare/alignment.h"
#include "porttool/normal/normal_text.h"
#include "porttool/scan/side.h"

namespace porttool {

inline bool is_name_or_number(std::string_view word) { return is_word_token(word) || is_number_token(word); }

/// What is computed in a unit's text, other than by names: a sign between two values, an assignment, a comparison. In
/// the unit's head `*` and `&` belong to types.
bool is_operator(const std::vector<std::string>& words, size_t i, size_t end_of_head);

/// The place of the brace that opens a unit's body.
size_t end_of_head(const std::vector<std::string>& words);

/// A text laid beside another: which of its names, numbers and operators have their like there. Names may differ where
/// they stand for each other throughout, or as three others do.
///
///     here      r = damp(x, lim) * k + 1;
///     there     s = damp(x, lim) * k;          `r` is `s`; `+` and `1` stand alone here
class SideBySide {
public:
    /// All must outlive it.
    SideBySide(const std::vector<std::string>& here, const std::vector<std::string>& there, const AlignedText& a,
               const AlignedText& b);

    /// Names, numbers and operators of both texts that have no like in the other.
    size_t unlike() const;

    /// How often each number and operator stands here that has no like in the other text.
    std::map<std::string_view, size_t> alone() const;

    /// The same of the other text.
    std::map<std::string_view, size_t> alone_there() const;

    /// True if a word here has its like in the other text.
    bool has_like(size_t i) const { return alike_[i]; }

    /// True if its whole clause has one there that is mostly the same: words that many statements have say little.
    bool has_like_clause(size_t i) const { return alike_[i] && in_like_clause_[i]; }

    /// Names without their like at their place that have it elsewhere, or are names of both texts: these are not words
    /// of one side's own, but in the wrong place. The places here, and there.
    ///
    ///     here      launch(n, lim); y = lim;
    ///     there     launch(n, y);   y = lim;         `lim`, and `y` there
    BySide<std::vector<size_t>> misplaced() const;

    /// Names without their like at their place of which the other text has another spelling elsewhere, or that stand
    /// for two names of it; or of which that is so of the name there. The places here.
    ///
    ///     here      f(lo, hi); y = hi - fminf(lo);
    ///     there     g(a, b);   y = a - max(min(b));          the two names behind `=`, those before it, and `fminf`
    std::vector<size_t> crossed() const;

    /// Names without their like at their place, here and there, that stand for each other.
    std::vector<std::pair<size_t, size_t>> other_names() const;

    /// The words of the other text that have their like here.
    std::set<size_t> covered() const;

private:
    bool same(size_t i, size_t k) const;
    void learn();
    bool is_alike(size_t i) const;

    const std::vector<std::string>&here_, &there_;
    const AlignedText &a_, &b_;
    Alignment laid_;
    std::map<std::string_view, std::string_view> names_;     ///< that stand for each other wherever they stand
    std::set<std::pair<std::string, std::string>> manners_;  ///< in which many names differ
    std::vector<bool> alike_, in_like_clause_;
    size_t head_, other_head_;  ///< where they end
};

}  // namespace porttool
