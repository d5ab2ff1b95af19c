// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "porttool/language/dialect.h"
#include "porttool/language/language.h"

namespace porttool {

/// The texts of a pair when it was last in step, and now, as tokens in normal form.
struct PairTexts {
    const std::vector<std::string>&source_before, &source_now, &target_before, &target_now;
};

/// Translates the statements of one pair so that equal words mean the same: where two names could be meant, they stay
/// apart. The words that measures and the matcher go by (common_word()) fold more.
class Meaning {
public:
    enum Side : uint8_t { Source, Target };

    /// `literals`: Shading if one side at least is of that kind.
    Meaning(const PairTexts& texts, const Dialect& dialect, Literals literals);

    /// A statement's words. `in_body`: not the function's head, so that storage (`static`, group-shared memory) counts.
    std::vector<std::string> translate(const std::vector<std::string>& statement, Side side, bool in_body) const;

private:
    using Spellings = std::map<std::string, std::set<std::string>>;

    void note_names(const std::vector<std::string>& tokens, Side side);
    void note_scopes(const std::vector<std::string>& source, const std::vector<std::string>& target);
    std::string word(const std::string& token) const;
    std::string number(const std::string& token) const;
    std::string scoped(const std::string& scope, const std::string& name, Side side) const;

    const Dialect& dialect_;
    Literals literals_;
    Spellings spellings_[2];                      ///< by folded name
    Spellings scopes_[2];                         ///< by name
    std::map<std::string, std::string> renamed_;  ///< the source's scope for one of the port's
};

}  // namespace porttool
