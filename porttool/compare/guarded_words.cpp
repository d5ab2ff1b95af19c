// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/guarded_words.h"

#include <array>
#include <string_view>

#include "porttool/normal/declaration_words.h"
#include "porttool/scan/side.h"

namespace porttool {
namespace {

struct GuardedWord {
    std::string_view shown;
    bool (*is_there)(std::string_view word);
};

bool is_long_number(std::string_view word) {
    if (!is_number_token(word)) return false;
    const size_t end = word.find_last_not_of("uUlL");
    const std::string_view suffix = end == std::string_view::npos ? std::string_view() : word.substr(end + 1);
    return suffix.find("ll") != std::string_view::npos || suffix.find("LL") != std::string_view::npos;
}

constexpr std::array<GuardedWord, 2> kGuarded = {
    {{"`volatile`", [](std::string_view word) { return word == "volatile"; }},
     {"a number of 64 bits", is_long_number}}};

/// How many more of it a text has than the one before.
int64_t gain(const Words& before, const Words& now, const GuardedWord& guarded) {
    int64_t gained = 0;
    for (const std::string_view word : now) gained += guarded.is_there(word) ? 1 : 0;
    for (const std::string_view word : before) gained -= guarded.is_there(word) ? 1 : 0;
    return gained;
}

}  // namespace

std::string guarded_difference(const PairTexts& texts) {
    for (const GuardedWord& guarded : kGuarded) {
        const int64_t source = gain(texts.source_before, texts.source_now, guarded),
                      target = gain(texts.target_before, texts.target_now, guarded);
        if (source == target) continue;
        const bool source_has_more = source > target;
        return std::string(source_has_more ? "the source" : "the port") + " gained " + std::string(guarded.shown) +
               "; " + (source_has_more ? "the port" : "the source") + " did not";
    }
    return {};
}

}  // namespace porttool
