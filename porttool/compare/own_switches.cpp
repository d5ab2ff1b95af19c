// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/own_switches.h"

#include <map>
#include <set>
#include <string_view>

#include "porttool/language/words.h"
#include "porttool/normal/directive_end.h"
#include "porttool/text/is_one_of.h"

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

/// The words of the lines of switches whose macros are not among `known`, and what each of the others is under: the
/// condition of such a switch, or "".
struct OwnSwitches {
    std::vector<bool> are_lines;
    std::vector<std::string> under;

    OwnSwitches(const Words& words, const Names& known);
};

OwnSwitches::OwnSwitches(const Words& words, const Names& known) : are_lines(words.size()), under(words.size()) {
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
            for (size_t k = last.first; k < last.end; ++k) are_lines[k] = true;
            are_lines[i] = are_lines[i + 1] = true;
            std::string condition;
            for (size_t k = last.first + 2; k < last.end; ++k)
                if (!is_one_of(words[k], {"defined", "(", ")"})) (condition += words[k]) += ' ';
            for (size_t k = last.end; k < i; ++k)
                if (under[k].empty()) under[k] = condition;
        }
    }
}

/// A text without the lines of switches whose macros are not among `known`.
std::vector<std::string> without_switches(const Words& words, const Names& known) {
    const OwnSwitches own(words, known);
    std::vector<std::string> out;
    for (size_t i = 0; i < words.size(); ++i)
        if (!own.are_lines[i]) out.emplace_back(words[i]);
    return out;
}

Names names_of(const Words& before, const Words& now) {
    Names out(before.begin(), before.end());
    out.insert(now.begin(), now.end());
    return out;
}

struct SideTexts {
    const Words &before, &now;
    Names there;  ///< the other side's
};

SideTexts texts_of(const PairTexts& texts, Side side) {
    if (side == Side::Source)
        return {texts.source_before, texts.source_now, names_of(texts.target_before, texts.target_now)};
    return {texts.target_before, texts.target_now, names_of(texts.source_before, texts.source_now)};
}

}  // namespace

std::vector<std::string_view> lone_own_switches(const PairTexts& texts, Side side) {
    const SideTexts own = texts_of(texts, side);
    const Names then(own.before.begin(), own.before.end());
    const OwnSwitches switches(own.now, own.there);
    std::map<std::string_view, size_t> asked;
    for (size_t i = 1; i < own.now.size(); ++i) {
        const std::string_view word = own.now[i];
        const bool is_macro =
            switches.are_lines[i] && own.now[i - 1] != "#" && is_word_token(word) && word != "defined";
        if (is_macro && !then.contains(word)) ++asked[word];
    }
    std::vector<std::string_view> out;
    for (const auto& [macro, times] : asked)
        if (times == 1) out.push_back(macro);
    return out;
}

bool own_switches_disagree(const PairTexts& texts, Side side) {
    const SideTexts own = texts_of(texts, side);
    const Names then(own.before.begin(), own.before.end());
    const OwnSwitches switches(own.now, own.there);
    std::map<std::string_view, std::string_view> under;
    for (size_t i = 0; i < own.now.size(); ++i) {
        const std::string_view word = own.now[i];
        const bool is_member = i > 0 && (own.now[i - 1] == "." || own.now[i - 1] == "->");
        const bool came = is_word_token(word) && !is_member && !then.contains(word) && !is_type_word(word);
        if (!came || switches.are_lines[i] || switches.under[i].empty() || word_is(word, kKeyword)) continue;
        const auto [known, is_first] = under.emplace(word, switches.under[i]);
        if (!is_first && known->second != switches.under[i]) return true;
    }
    return false;
}

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
