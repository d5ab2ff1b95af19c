// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/language/dialect.h"
#include "porttool/match/features.h"
#include "porttool/text/text_numbers.h"

namespace porttool {

/// What an identifier in a body counts as.
struct IdentifierTerms {
    enum class Kind : uint8_t {
        Silent,  ///< says nothing, as an address space
        Common,  ///< one of the words that all dialects share
        Syntax,  ///< `for`, `return`
        Name     ///< a project's own
    };
    Kind kind = Kind::Name;
    const std::string* common = nullptr;      ///< of what the dialect knows
    uint64_t shape = 0;                       ///< what it is in the shape of a body; of a name depends on what follows
    std::vector<uint32_t> words;              ///< of a name: its words (of bodies); else the common word, if any
    std::vector<uint32_t> called;             ///< of a name that is called somewhere: its words (of calls)
    uint32_t called_as = TextNumbers::kNone;  ///< the whole name (of calls), once asked for
};

/// Looks identifiers up, each text once: a body repeats the few that it has.
class IdentifierTable {
public:
    IdentifierTable(const Dialect& dialect, TermNumbers& terms) : dialect_(dialect), terms_(terms) {}

    const IdentifierTerms& find(std::string_view text) { return entry(text); }
    /// The words of a name that is called.
    const std::vector<uint32_t>& called_words(std::string_view text);
    /// The whole name of what is called.
    uint32_t called_as(std::string_view text);

private:
    IdentifierTerms& entry(std::string_view text);
    IdentifierTerms read(std::string_view text);

    const Dialect& dialect_;
    TermNumbers& terms_;
    TextNumbers texts_;
    std::vector<IdentifierTerms> entries_;  ///< by the number of the text
};

}  // namespace porttool
