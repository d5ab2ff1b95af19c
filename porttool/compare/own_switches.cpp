// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/own_switches.h"

#include <set>
#include <string_view>

#include "porttool/normal/directive_end.h"

namespace porttool {
namespace {

using Names = std::set<std::string_view>;

/// A line that opens a branch for the compiler, and what is known of it.
struct OpenSwitch {
    size_t first = 0, end = 0;  ///< the line's words
    bool is_own = false;
};

/// True for `ifdef A` and `if defined ( A ) && defined ( B )` of macros that are not among those names.
bool asks_for_own_macro(const Words& words, size_t first, size_t end, const Names& known) {
    if (words[first + 1] != "ifdef" && words[first + 1] != "if") return false;
    for (size_t i = first + 2; i < end; ++i)
        if (words[i] == "!" || (words[i] != "defined" && is_word_token(words[i]) && known.contains(words[i])))
            return false;
    return true;
}

/// A text without the lines of switches whose macros are not among `known`.
std::vector<std::string> without_switches(const Words& words, const Names& known) {
    std::vector<bool> goes(words.size());
    std::vector<OpenSwitch> open;
    for (size_t i = 0; i + 1 < words.size(); ++i) {
        if (words[i] != "#") continue;
        const std::string_view kind = words[i + 1];
        if (kind.starts_with("if")) {
            const size_t end = directive_end(words, i);
            open.push_back({i, end, end > i && asks_for_own_macro(words, i, end, known)});
        } else if (kind.starts_with("el") && !open.empty()) {
            open.back().is_own = false;
        } else if (kind == "endif" && !open.empty()) {
            const OpenSwitch last = open.back();
            open.pop_back();
            if (!last.is_own) continue;
            for (size_t k = last.first; k < last.end; ++k) goes[k] = true;
            goes[i] = goes[i + 1] = true;
        }
    }
    std::vector<std::string> out;
    for (size_t i = 0; i < words.size(); ++i)
        if (!goes[i]) out.emplace_back(words[i]);
    return out;
}

Names names_of(const Words& before, const Words& now) {
    Names out(before.begin(), before.end());
    out.insert(now.begin(), now.end());
    return out;
}

}  // namespace

std::optional<SwitchlessTexts> without_own_switches(const PairTexts& texts) {
    const Names of_source = names_of(texts.source_before, texts.source_now),
                of_target = names_of(texts.target_before, texts.target_now);
    if (!of_source.contains("#") && !of_target.contains("#")) return std::nullopt;
    SwitchlessTexts out{without_switches(texts.source_before, of_target), without_switches(texts.source_now, of_target),
                        without_switches(texts.target_before, of_source),
                        without_switches(texts.target_now, of_source)};
    const bool any =
        out.source_before.size() != texts.source_before.size() || out.source_now.size() != texts.source_now.size() ||
        out.target_before.size() != texts.target_before.size() || out.target_now.size() != texts.target_now.size();
    return any ? std::optional(std::move(out)) : std::nullopt;
}

}  // namespace porttool
