// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/scan/constants.h"

#include "porttool/language/words.h"

namespace porttool {
namespace {

class ConstantReader {
public:
    ConstantReader(const HeadContext& context, uint32_t first, uint32_t end)
        : context_(context), first_(first), end_(end) {}

    std::vector<ConstantDeclaration> read() {
        if (!first_declarator()) return {};
        further_declarators();
        return std::move(out_);
    }

private:
    std::string_view word(uint32_t at) const { return context_.lexed.view(context_.structure.tokens[at]); }
    bool is_name(uint32_t at) const {
        return context_.lexed.tokens[context_.structure.tokens[at]].kind == TokenKind::Identifier;
    }
    /// Steps over a bracketed group.
    uint32_t next(uint32_t at) const {
        const uint32_t close = context_.structure.match[at];
        return close != kNoMatch && close > at && close < end_ ? close + 1 : at + 1;
    }

    bool first_declarator() {
        if (word_is(word(first_), kNoConstant)) return false;
        bool is_const = false;
        uint32_t name = kNoMatch;
        uint32_t at = first_;
        while (at < end_ && word(at) != "=" && word(at) != "{") {
            const std::string_view text = word(at);
            if ((text == "template" || text == "<") && at + 1 < end_) {
                const uint32_t open = text == "<" ? at : at + 1;
                const uint32_t after = word(open) == "<" ? context_.angles.skip(open, end_) : kNoMatch;
                at = after == kNoMatch ? at + 1 : after;
                continue;
            }
            // `virtual const X f() const = 0` declares a function
            if (text == "(" && (at == first_ || !word_is(word(at - 1), kTakesArguments))) return false;
            if ((roles_of(text, context_.language) & kConstant) != 0)
                is_const = true;
            else if (is_name(at))
                name = at;
            at = next(at);
        }
        if (!is_const || name == kNoMatch || at >= end_) return false;
        out_.push_back({std::string(word(name)), name, first_, end_});
        at_ = at;
        return true;
    }

    void further_declarators() {
        constexpr size_t kMost = 64;
        for (uint32_t at = at_; at + 2 < end_ && out_.size() < kMost; at = next(at)) {
            if (word(at) != "," || !is_name(at + 1)) continue;
            uint32_t after = at + 2;
            while (after < end_ && word(after) == "[") after = next(after);
            if (after >= end_ || (word(after) != "=" && word(after) != "{")) continue;
            out_.back().end = at;
            out_.push_back({std::string(word(at + 1)), at + 1, at + 1, end_});
        }
    }

    const HeadContext& context_;
    uint32_t first_;
    uint32_t end_;
    uint32_t at_ = 0;
    std::vector<ConstantDeclaration> out_;
};

bool carries_value(const LexedText& lexed, uint32_t first, uint32_t end) {
    for (uint32_t i = first; i < end; ++i) {
        const TokenKind kind = lexed.tokens[i].kind;
        if (kind != TokenKind::Identifier && kind != TokenKind::Punctuator) return true;
        const std::string_view text = lexed.view(i);
        if (text == "true" || text == "false") return true;
    }
    return false;
}

}  // namespace

std::vector<ConstantDeclaration> read_constants(const HeadContext& context, uint32_t first, uint32_t end) {
    if (first >= end) return {};
    return ConstantReader(context, first, end).read();
}

std::vector<Unit> find_macro_units(const LexedText& lexed) {
    std::vector<Unit> units;
    for (const Directive& directive : lexed.directives) {
        const uint32_t name = directive.first_token + 2;
        if (directive.kind != DirectiveKind::Define || directive.end_token <= name) continue;
        if ((lexed.tokens[name].flags & kDead) != 0) continue;
        const bool function_like = directive.end_token > name + 1 && is_function_like(lexed, name);
        uint32_t value = name + 1;
        if (function_like)
            while (value < directive.end_token && lexed.view(value++) != ")") {
            }
        if (!redefines_word(lexed.view(name))) {
            if (value >= directive.end_token) continue;
            if (!function_like && !carries_value(lexed, value, directive.end_token)) continue;
        }
        Unit unit;
        unit.kind = UnitKind::Constant;
        unit.name = std::string(lexed.view(name));
        unit.tokens = {directive.first_token, directive.end_token};
        unit.start_line = directive.line;
        unit.end_line = lexed.tokens[directive.end_token - 1].line;
        unit.name_token = name;
        unit.body = {value, directive.end_token};
        units.push_back(std::move(unit));
    }
    return units;
}

}  // namespace porttool
