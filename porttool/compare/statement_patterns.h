// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "porttool/compare/alignment.h"
#include "porttool/compare/meaning.h"

namespace porttool {

/// Statements that say the same of one name each, however else the two sides say it: where `a ( job ) ;`, `b ( job ) ;`
/// and `c ( job ) ;` are `each < a > ( n ) ;` and so on, `d ( job ) ;` is `each < d > ( n ) ;`.
class StatementPatterns {
public:
    void learn(const AlignedText& source, const AlignedText& target, const Alignment& alignment);
    bool empty() const { return patterns_.empty(); }

    /// A statement as the target says it.
    struct Said {
        size_t name = 0;                  ///< the word of the source that it is about
        std::vector<std::string> target;  ///< "" in the place of the name; none if nothing is known
    };
    Said said(const std::vector<std::string>& words, size_t first, size_t end) const;

private:
    /// By the source's statement without its name, and the target's: the names.
    std::map<std::string, std::map<std::string, std::set<std::string>>> patterns_;
};

/// The source's texts with each such statement as the target says it, as far as the two texts before tell.
struct PatternedTexts {
    std::vector<std::string> before, now;
    bool any = false;  ///< a statement became another one
};
PatternedTexts in_statements_of_target(const PairTexts& texts, const Dialect& dialect);

}  // namespace porttool
