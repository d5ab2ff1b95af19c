// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/argument_list.h"

#include <algorithm>
#include <iterator>

namespace porttool {
namespace {

/// True for a function that may be called with so many arguments.
bool takes(const Definition& function, const ArgumentCount& arguments) {
    const LexedText& lexed = function.file->lexed;
    const TokenRange list = function.unit->parameters;
    const bool is_empty = list.end == list.first + 1 && lexed.view(list.first) == "void";
    const size_t most = is_empty ? 0 : list_parts(lexed, list).size();
    size_t least = most;
    for (uint32_t i = list.first; i < list.end; ++i) {
        if (lexed.view(i) == "...") return true;
        if (lexed.view(i) == "=" && least > 0) --least;
    }
    return least <= arguments.most && arguments.least <= most;
}

}  // namespace

std::vector<TokenRange> list_parts(const LexedText& lexed, TokenRange range) {
    std::vector<TokenRange> out;
    int depth = 0, angles = 0;
    uint32_t first = range.first;
    for (uint32_t i = range.first; i < range.end; ++i) {
        const std::string_view word = lexed.view(i);
        if (word == "(" || word == "[" || word == "{") ++depth;
        if (word == ")" || word == "]" || word == "}") --depth;
        if (word == "<") ++angles;
        if (word == ">" && angles > 0) --angles;
        if (word != "," || depth != 0 || angles != 0) continue;
        out.push_back({first, i});
        first = i + 1;
    }
    if (first < range.end) out.push_back({first, range.end});
    return out;
}

std::optional<ArgumentCount> arguments_of_call(const LexedText& lexed, uint32_t i, uint32_t end) {
    if (i + 1 >= end || lexed.view(i + 1) != "(") return std::nullopt;
    int depth = 0;
    size_t commas = 0;
    for (uint32_t close = i + 1; close < end; ++close) {
        const std::string_view word = lexed.view(close);
        if (word == "," && depth == 1) ++commas;
        if (word == "(" || word == "[" || word == "{") ++depth;
        if ((word == ")" || word == "]" || word == "}") && --depth == 0)
            return close == i + 2 ? ArgumentCount{0, 0}
                                  : ArgumentCount{list_parts(lexed, {i + 2, close}).size(), commas + 1};
    }
    return std::nullopt;
}

std::vector<const Definition*> callable(const std::vector<const Definition*>& found,
                                        std::optional<ArgumentCount> arguments) {
    const auto fits = [&](const Definition* one) {
        return one->kind != Definition::Kind::Function || one->unit == nullptr || takes(*one, *arguments);
    };
    if (!arguments || found.size() < 2 || std::none_of(found.begin(), found.end(), fits)) return found;
    std::vector<const Definition*> out;
    std::copy_if(found.begin(), found.end(), std::back_inserter(out), fits);
    return out;
}

}  // namespace porttool
