// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "porttool/scan/unit.h"

namespace porttool {

/// The live tokens of a range, without preprocessor lines, with the brackets that belong together.
class BracketedTokens {
public:
    BracketedTokens(const LexedText& lexed, TokenRange range);

    size_t size() const { return tokens_.size(); }
    /// Where the token stands in its file.
    uint32_t place(size_t i) const { return tokens_[i]; }
    /// The text of a token; "" past the end.
    std::string_view word(size_t i) const { return i < tokens_.size() ? lexed_.view(tokens_[i]) : std::string_view(); }
    bool is_name(size_t i) const { return is_a(i, TokenKind::Identifier); }
    /// True for a name that is no keyword of any kind.
    bool may_be_declared(size_t i) const;

    /// The token after the bracket that closes the one at `i`; the end if none does.
    size_t after_group(size_t i) const { return i < after_.size() ? after_[i] : tokens_.size(); }
    /// The token after the template arguments that begin with the `<` at `i`, or `i` if it is a comparison. Within
    /// bounds, so that the whole stays linear.
    size_t after_arguments(size_t i) const;

private:
    bool is_a(size_t i, TokenKind kind) const { return i < tokens_.size() && lexed_.tokens[tokens_[i]].kind == kind; }

    const LexedText& lexed_;
    std::vector<uint32_t> tokens_;
    std::vector<size_t> after_;  ///< for each opening bracket: the token after the one that closes it
};

}  // namespace porttool
