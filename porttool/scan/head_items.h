// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "porttool/language/language.h"
#include "porttool/scan/angles.h"
#include "porttool/scan/macros.h"

namespace porttool {

/// What a head is read with.
struct HeadContext {
    const LexedText& lexed;
    const Structure& structure;
    Language language;
    const MacroTable& macros;
    AngleTable& angles;
    bool in_class = false;
};

/// The tokens [first, end) of a head as items: plain tokens, and whole groups in brackets, without template prefixes
/// and attributes. Positions are those in Structure::tokens; past the last item all words are "".
class HeadItems {
public:
    HeadItems(const HeadContext& context, uint32_t first, uint32_t end);

    size_t size() const { return items_.size(); }
    std::string_view word(size_t item) const { return item < size() ? word_at(items_[item].at) : std::string_view(); }
    bool is_group(size_t item) const { return items_[item].close != kNoMatch; }
    bool is_paren(size_t item) const { return is_group(item) && word(item) == "("; }
    bool is_name(size_t item) const { return item < size() && is_name_at(items_[item].at); }
    bool is_string(size_t item) const { return token_at(items_[item].at).kind == TokenKind::String; }

    /// The item after the template arguments that begin at `item`, a `<`; the next one if they do not end.
    size_t after_angles(size_t item) const;
    /// The item of the `<` that the `>` at `close` closes; size() if there is none.
    size_t open_angle(size_t close) const;

    /// The arguments in the parentheses `item`, each without blanks.
    std::vector<std::string> arguments(size_t item) const;

    /// Where the signature starts whose name is `name`. Macro lines before it that have nothing to do with it are left
    /// out: a blank line or a comment stands between, or the macro is known to define something of its own.
    uint32_t signature_start(size_t name) const;

    /// Position of an item's token; of a group, its opening bracket.
    uint32_t position(size_t item) const { return items_[item].at; }
    /// Position of a group's closing bracket, kNoMatch for a plain token.
    uint32_t close(size_t item) const { return items_[item].close; }
    std::string_view word_at(uint32_t at) const { return context_.lexed.view(context_.structure.tokens[at]); }
    bool is_name_at(uint32_t at) const { return token_at(at).kind == TokenKind::Identifier; }

    const HeadContext& context() const { return context_; }
    /// True if an attribute in brackets says that the function is a kernel.
    bool kernel_attribute() const { return kernel_attribute_; }

private:
    struct Item {
        uint32_t at;
        uint32_t close;
    };

    const Token& token_at(uint32_t at) const { return context_.lexed.tokens[context_.structure.tokens[at]]; }
    /// Reads an attribute, or the brackets of `operator[]`.
    void add_brackets(uint32_t open, uint32_t close);

    const HeadContext& context_;
    uint32_t first_;
    uint32_t end_;
    std::vector<Item> items_;
    bool kernel_attribute_ = false;
};

/// True for words all in capitals, as macros are written.
bool is_macro_like(std::string_view word);

/// True for what may stand between a parameter list and the body.
bool is_trailer(std::string_view word);

}  // namespace porttool
