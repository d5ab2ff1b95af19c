// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "porttool/scan/unit.h"

namespace porttool {

/// What a declaration says of one name, in words, with `@` for the name, and as it is written.
struct HeadWords {
    std::vector<std::string> words;
    std::string text;
    std::string name;  ///< "" where it has none
    TokenRange tokens;
};

/// The head of a function of its own, or of a constant, in parts. Not of methods.
struct HeadParts {
    TokenRange template_prefix;         ///< `template <...>`, or empty
    HeadWords marks;                    ///< what comes before the type: `static inline`
    HeadWords type;                     ///< what it gives back; of a constant all that comes before its name
    std::vector<HeadWords> parameters;  ///< of a function
};

/// None for what is no function or constant outside of classes, or has a head with more than that.
std::optional<HeadParts> read_head_parts(const ScannedFile& file, const Unit& unit);

/// How the heads of one side are written on the other, learned from pairs.
class HeadManners {
public:
    void learn(const ScannedFile& source, const Unit& unit, const ScannedFile& target, const Unit& port);

    /// As most ports have it; "" in `text` is a sure answer, too. None where ports disagree or none is known.
    std::optional<std::string> marks(const HeadWords& source) const { return usual(marks_, source); }
    std::optional<std::string> type(const HeadWords& source) const { return usual(types_, source); }
    std::optional<std::string> parameter(const HeadWords& source) const { return usual(parameters_, source); }
    std::optional<std::string> constant(const HeadWords& source) const { return usual(constants_, source); }
    /// The same of a parameter of whatever type, with `$` for the type, where it is one word.
    std::optional<std::string> shape(const HeadWords& source) const;
    /// The place of that word among a declaration's; none where the type has more words.
    static std::optional<size_t> type_word(const std::vector<std::string>& words);
    /// Whatever the source has before a function's type, what most ports have there.
    std::optional<std::string> any_marks() const;
    /// True if the ports say that of such words in several ways.
    bool disagree_on_marks(const HeadWords& source) const { return said(marks_, source) && !marks(source); }
    bool disagree_on_type(const HeadWords& source) const { return said(types_, source) && !type(source); }
    bool disagree_on_parameter(const HeadWords& source) const {
        return said(parameters_, source) && !parameter(source);
    }

private:
    using Texts = std::map<std::string, size_t>;
    using Said = std::map<std::vector<std::string>, Texts>;
    static std::optional<std::string> usual(const Said& all, const HeadWords& source);
    static std::optional<std::string> most_of(const Texts& texts);
    static bool said(const Said& all, const HeadWords& source) { return all.contains(source.words); }

    Said marks_, types_, parameters_, shapes_, constants_;
};

}  // namespace porttool
