// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/scan/variables.h"

#include "porttool/language/words.h"
#include "porttool/scan/attributes.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

class VariableReader {
public:
    VariableReader(const HeadContext& context, std::vector<FileVariable>& out) : context_(context), out_(out) {}

    void read(uint32_t first, uint32_t end) {
        constexpr uint32_t kLongest = 256;  // words of a declaration that a person wrote
        if (first >= end || end - first > kLongest || word_is(word(first), kNoConstant | kBlockHead)) return;
        if (word(first) == "template" && word(first + 1) != "<") return read_instantiation(first + 1, end);
        if (word(first) == "template" || word(first) == "#") return;
        std::vector<uint32_t> names;
        uint32_t at = first, words = 0;
        for (; at < end && word(at) != "=" && word(at) != "{"; at = next(at, end)) {
            if (word(at) == "(" && (at == first || !word_is(word(at - 1), kTakesArguments)))
                return read_declaration(first, at, end);
            if (!is_name(at)) continue;
            ++words;
            const std::string_view after = at + 1 < end ? word(at + 1) : ";";
            const bool ends = after == ";" || after == "=" || after == "[" || after == "," || after == "{";
            if (ends && words > 1 && !is_type_word(word(at))) names.push_back(at);
        }
        const bool layout_alone = word(first) == "layout" && words == 2 && names.size() == 1 &&
                                  is_one_of(word(names[0]), {"in", "out", "uniform", "buffer"});
        const bool forward = words == 2 && word_is(word(first), kOpensType);
        if (forward) return;
        for (const uint32_t name : names) add(layout_alone ? first : name, first, at);
    }

    void read_member(uint32_t first, uint32_t end) {
        constexpr uint32_t kLongest = 256;
        if (first >= end || end - first > kLongest) return;
        for (uint32_t at = first; at < end && word(at) != "="; at = next(at, end))
            if (word(at) == "(" && at > first && !word_is(word(at - 1), kTakesArguments))
                return read_declaration(first, at, end);
    }

    void read_block(BlockPlace place) {
        constexpr size_t kMost = 256;
        const auto count = static_cast<uint32_t>(context_.structure.tokens.size());
        if (place.close + 1 < count && is_name(place.close + 1)) return add(place.close + 1, place.first, place.open);
        size_t members = 0;
        for (uint32_t at = place.open + 1; at + 1 < place.close && members < kMost; ++at)
            if (is_name(at) && (word(at + 1) == ";" || word(at + 1) == "[") && ++members > 0)
                add(at, place.first, place.open);
    }

private:
    /// `float f(float x, float s = 2.0f) __attribute__((weak))`: the declaration of a function, with arguments that
    /// have defaults, and with attributes.
    void read_declaration(uint32_t first, uint32_t open, uint32_t end) {
        const uint32_t close = context_.structure.match[open];
        if (open < first + 2 || close == kNoMatch || close >= end || !is_name(open - 1) || !is_name_or_sign(open - 2))
            return;
        read_attributes(open - 1, first, open - 1);
        read_attributes(open - 1, close + 1, end);
        for (uint32_t at = open + 1; at < close; at = next(at, close))
            if (word(at) == "=") return add(open - 1, open - 1, close + 1, FileVariable::SaysOfFunction);
    }

    /// Those at the positions [first, end) that may change what a function does: `__attribute__((target("fma")))`.
    void read_attributes(uint32_t name, uint32_t first, uint32_t end) {
        for (uint32_t at = first; at < end;) {
            const bool in_brackets = word(at) == "[" && at + 1 < end && word(at + 1) == "[";
            const uint32_t open = in_brackets ? at : at + 1;
            const bool has_word = !in_brackets && open < end && word(open) == "(" && opens_attributes(word(at));
            const uint32_t after = next(open, end);
            if ((in_brackets || has_word) && after > open + 1 && !is_idle(open + 1, after - 1))
                add(name, at, after, FileVariable::SaysOfFunction);
            at = in_brackets || has_word ? after : at + 1;
        }
    }

    bool is_idle(uint32_t first, uint32_t end) const {
        return are_idle_attributes(
            first, end, [&](uint32_t at) { return word(at); }, [&](uint32_t at) { return is_name(at); },
            [&](uint32_t at) { return next(at, end); });
    }

    /// `template __global__ void f<float, 4>(float*)`
    void read_instantiation(uint32_t first, uint32_t end) {
        for (uint32_t at = first; at + 1 < end; ++at)
            if (is_name(at) && at > first && (word(at + 1) == "<" || word(at + 1) == "("))
                return add(at, first - 1, end, FileVariable::SaysOfFunction);
    }

    bool is_name_or_sign(uint32_t at) const {
        return is_name(at) || word(at) == "*" || word(at) == "&" || word(at) == ">";
    }

    std::string_view word(uint32_t at) const { return context_.lexed.view(context_.structure.tokens[at]); }
    bool is_name(uint32_t at) const {
        return context_.lexed.tokens[context_.structure.tokens[at]].kind == TokenKind::Identifier;
    }
    /// Steps over a bracketed group.
    uint32_t next(uint32_t at, uint32_t end) const {
        const uint32_t close = context_.structure.match[at];
        return close != kNoMatch && close > at && close < end ? close + 1 : at + 1;
    }
    void add(uint32_t name, uint32_t first, uint32_t end, FileVariable::About about = FileVariable::Declares) {
        out_.push_back({context_.structure.tokens[name],
                        {context_.structure.tokens[first], context_.structure.tokens[end - 1] + 1},
                        about});
    }

    const HeadContext& context_;
    std::vector<FileVariable>& out_;
};

}  // namespace

void read_variables(const HeadContext& context, uint32_t first, uint32_t end, std::vector<FileVariable>& out) {
    VariableReader(context, out).read(first, end);
}

void read_member_defaults(const HeadContext& context, uint32_t first, uint32_t end, std::vector<FileVariable>& out) {
    VariableReader(context, out).read_member(first, end);
}

void read_block_variables(const HeadContext& context, BlockPlace place, std::vector<FileVariable>& out) {
    VariableReader(context, out).read_block(place);
}

}  // namespace porttool
