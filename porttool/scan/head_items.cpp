// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/scan/head_items.h"

#include "porttool/language/words.h"

namespace porttool {

HeadItems::HeadItems(const HeadContext& context, uint32_t first, uint32_t end)
    : context_(context), first_(first), end_(end) {
    for (uint32_t at = first; at < end;) {
        const std::string_view text = word_at(at);
        const uint32_t close = context.structure.match[at];
        const bool closes = close != kNoMatch && close < end;
        if ((text == "template" || text == "__generic") && at + 1 < end && word_at(at + 1) == "<") {
            const uint32_t after = context.angles.skip(at + 1, end);
            at = after == kNoMatch ? at + 1 : after;
        } else if (text == "[" && closes) {
            add_brackets(at, close);
            at = close + 1;
        } else if (text == "(" && closes) {
            items_.push_back({at, close});
            at = close + 1;
        } else {
            items_.push_back({at++, kNoMatch});
        }
    }
}

void HeadItems::add_brackets(uint32_t open, uint32_t close) {
    for (uint32_t at = open; at < close; ++at)
        kernel_attribute_ = kernel_attribute_ || word_is(word_at(at), kKernelAttribute);
    const bool of_operator =
        (size() >= 1 && word(size() - 1) == "operator") || (size() >= 2 && word(size() - 2) == "operator");
    if (of_operator) items_.push_back({open, close});
}

size_t HeadItems::after_angles(size_t item) const {
    const uint32_t after = context_.angles.skip(position(item), end_);
    if (after == kNoMatch) return item + 1;
    while (item < size() && position(item) < after) ++item;
    return item;
}

size_t HeadItems::open_angle(size_t close) const {
    int depth = 0;
    for (size_t i = close + 1; i-- > 0;) {
        if (word(i) == ">") ++depth;
        if (word(i) == "<" && --depth == 0) return i;
    }
    return size();
}

std::vector<std::string> HeadItems::arguments(size_t item) const {
    std::vector<std::string> out(1);
    for (uint32_t at = position(item) + 1; at < close(item); ++at) {
        if (word_at(at) == ",")
            out.emplace_back();
        else
            out.back() += word_at(at);
    }
    return out;
}

uint32_t HeadItems::signature_start(size_t name) const {
    uint32_t start = first_;
    for (size_t i = 0; i < name;) {
        const bool has_arguments = i + 1 < name && is_paren(i + 1);
        const size_t next = i + (has_arguments ? 2 : 1);
        if (!is_name(i) || next > name) break;
        if (has_arguments ? word_is(word(i), kTakesArguments) : !is_macro_like(word(i))) break;
        const uint32_t after = (has_arguments ? close(i + 1) : position(i)) + 1;
        const bool apart = token_at(after).line > token_at(after - 1).line + 1;
        if (apart || defines_something(context_.macros, word(i))) start = after;
        i = next;
    }
    return start;
}

bool is_macro_like(std::string_view word) {
    bool letter = false;
    for (const char c : word) {
        if (c >= 'a' && c <= 'z') return false;
        letter = letter || (c >= 'A' && c <= 'Z');
    }
    return letter && word.size() > 1;
}

bool is_trailer(std::string_view word) { return word == "&" || word == "&&" || word_is(word, kTrailer); }

}  // namespace porttool
