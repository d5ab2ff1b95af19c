// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/swept_names.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <string_view>
#include <unordered_map>

#include "porttool/judge/own_names.h"
#include "porttool/language/words.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/locals.h"
#include "porttool/scan/declared_words.h"
#include "porttool/scan/scan.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

constexpr size_t kSeveral = 2;     ///< units that were edited by nothing else
constexpr size_t kMostNames = 64;  ///< of a side: each is looked for in all of its files

/// The words that took the place of others, each with its own, where that is all that happened; else nothing.
std::set<std::pair<std::string, std::string>> exchanged_names(const Words& before, const Words& now) {
    std::set<std::pair<std::string, std::string>> out;
    if (before.size() != now.size()) return out;
    for (size_t i = 0; i < before.size(); ++i) {
        if (before[i] == now[i]) continue;
        if (!is_word_token(before[i]) || !is_word_token(now[i])) return {};
        out.emplace(before[i], now[i]);
    }
    return out;
}

/// The names, with their scopes, that took the place of others, where that is all that an edit did.
struct ExchangedPaths {
    std::map<std::string, std::string> names;  ///< before, now; none where more was edited
    std::set<std::string> had, left;           ///< that stood in the text, and that stand there now

    ExchangedPaths(const Words& before, const Words& now) {
        const std::vector<std::string> old_ones = with_whole_paths(before), new_ones = with_whole_paths(now);
        if (old_ones.size() != new_ones.size()) return;
        for (size_t i = 0; i < old_ones.size(); ++i) {
            if (is_word_token(old_ones[i])) had.insert(old_ones[i]);
            if (is_word_token(new_ones[i])) left.insert(new_ones[i]);
            if (old_ones[i] == new_ones[i]) continue;
            const bool is_name = is_word_token(old_ones[i]) && is_word_token(new_ones[i]) &&
                                 roles_of(old_ones[i]) == 0 && roles_of(new_ones[i]) == 0;
            if (!is_name || names.emplace(old_ones[i], new_ones[i]).first->second != new_ones[i]) {
                names.clear();
                return;
            }
        }
    }

private:
    /// `a::b::c` of `a :: b :: c`.
    static std::vector<std::string> with_whole_paths(const Words& words) {
        std::vector<std::string> out;
        for (size_t i = 0; i < words.size(); ++i) {
            const bool goes_on =
                i >= 2 && words[i - 1] == "::" && is_word_token(words[i - 2]) && is_word_token(words[i]);
            if (goes_on)
                (out.back() += "::") += words[i];
            else if (words[i] != "::" || i == 0 || i + 1 >= words.size() || !is_word_token(words[i - 1]))
                out.emplace_back(words[i]);
        }
        return out;
    }
};

/// What an edit added, by places of the new text, each from where an item begins: text within an expression may change
/// a value beside a new name, as `n + 1 - 1, fuse` for `n + 1` does. None where it did anything else.
std::vector<std::pair<size_t, size_t>> added_items(const Words& before, const Words& now) {
    std::vector<std::pair<size_t, size_t>> out;
    for (const DiffStep& step : diff(before, now)) {
        if (step.kind == DiffStep::Remove) return {};
        if (step.kind == DiffStep::Keep) continue;
        if (out.empty() || out.back().second != step.now) out.emplace_back(step.now, step.now);
        ++out.back().second;
    }
    const auto begins_item = [&](size_t at) {
        const auto sets_apart = [](std::string_view word) {
            return is_one_of(word, {";", "{", "}", "(", ",", ":", "#"});
        };
        return at == 0 || sets_apart(now[at]) || sets_apart(now[at - 1]);
    };
    for (auto& [first, end] : out) {
        // `) , g ( x` between `f ( x` and `)` is as well `, g ( x )` behind it.
        while (!begins_item(first) && end < now.size() && now[first] == now[end]) ++first, ++end;
        if (!begins_item(first)) return {};
    }
    return out;
}

/// True if some added text leaves, repeats, writes to something or is a call for itself: more than to hand a name on.
bool does_more(const Words& text, size_t first, size_t end) {
    const auto is_statement = [&](size_t i) { return i > 0 && is_one_of(text[i - 1], {";", "{", "}", ")"}); };
    for (size_t i = first; i < end; ++i) {
        if (is_one_of(text[i], {"return", "break", "continue", "goto", "throw", "discard", "for", "while", "do", "=",
                                "+=", "-=", "*=", "/=", "++", "--"}))
            return true;
        if (is_statement(i) && is_word_token(text[i]) && i + 1 < end && text[i + 1] == "(") return true;
    }
    return false;
}

/// Another function is another thing, whoever else calls it.
bool are_no_calls(const Words& now, const std::set<std::pair<std::string, std::string>>& names) {
    for (size_t i = 0; i + 1 < now.size(); ++i)
        if (now[i + 1] == "(" &&
            std::any_of(names.begin(), names.end(), [&](const auto& name) { return name.second == now[i]; }))
            return false;
    return true;
}

/// True for `typedef double real ;` and `using real = half ;`: another name of one thing, of which nobody knows whether
/// it is what the old name was.
bool is_bare_alias(const ScannedFile& file, const DeclaredWord& said) {
    size_t words = 0;
    bool is_made = false;
    for (uint32_t i = said.tokens.first; i < said.tokens.end; ++i) {
        const std::string_view word = file.lexed.view(file.lexed.tokens[i]);
        words += is_word_token(word) ? 1 : 0;
        is_made = is_made || word == "<" || word == "struct" || word == "class";
    }
    constexpr size_t kBare = 4;  // `typedef unsigned long word`
    return !is_made && words <= kBare;
}

bool has_name(const UnitText& text, std::string_view name) {
    bool out = false;
    text.each_name([&](std::string_view one) { out = out || one == name; });
    return out;
}

/// The prints of a side's recorded units, by their ids.
std::unordered_map<std::string_view, Print> recorded_texts(const Case& facts, Side side) {
    std::unordered_map<std::string_view, Print> out;
    for (const LockedPair& line : facts.lock.pairs)
        out.emplace(side == Side::Source ? line.source : line.target,
                    (side == Side::Source ? line.source_prints : line.target_prints).written);
    for (const LockedUnit& line : facts.lock.baseline)
        if (line.side == side_word(side)) out.emplace(line.id, line.prints.written);
    return out;
}

}  // namespace

std::string SweptNames::say(Side side, const Words& before, const Words& now) {
    const auto names = exchanged_names(before, now);
    if (!facts_.files || names.empty()) return {};
    if (std::all_of(names.begin(), names.end(), [&](const Name& name) { return is_swept_type(side, name); }))
        return "it only gives a type its new name, as all of that side does";
    if (are_no_calls(now, names) &&
        std::all_of(names.begin(), names.end(), [&](const Name& name) { return is_swept_on_both(name); }))
        return "it only gives things the new names that both sides gave them throughout";
    return {};
}

std::vector<std::string> SweptNames::causes(Side side, const std::string& file, const Words& before, const Words& now) {
    constexpr size_t kOneForOne = 2;  // such a slip may be made in several places
    if (!facts_.files || words_edited(before, now) <= kOneForOne) return {};
    std::vector<std::string> out = new_names(side, file, before, now);
    return out.empty() ? brought_names(side, before, now) : out;
}

std::vector<std::string> SweptNames::new_names(Side side, const std::string& file, const Words& before,
                                               const Words& now) {
    constexpr size_t kUnits = 3;
    std::vector<std::string> out;
    const auto names = exchanged_names(before, now);
    if (!are_no_calls(now, names)) return out;
    for (const Name& name : names) {
        size_t units = 0;
        bool is_gone = roles_of(name.first) == 0 && roles_of(name.second) == 0;
        for (const auto& [other, times] : exchanges(side)) {
            if (other.second == name.second) units += times.in_all;
            if (other.first == name.first && other.second != name.second) is_gone = false;
        }
        if (!is_gone || is_in_code_of(facts_, side, file, name.first)) return {};
        if (units >= kUnits) out.push_back(name.second);
    }
    return out;
}

/// Locals of a body do not count: many have one name by chance.
std::vector<std::string> SweptNames::brought_names(Side side, const Words& before, const Words& now) {
    const std::vector<size_t> numbers = local_numbers(now);
    const auto body = static_cast<size_t>(std::find(now.begin(), now.end(), "{") - now.begin());
    std::set<std::string_view> taken, own;
    for (size_t i = 0; i < now.size(); ++i)
        if (i < numbers.size() && numbers[i] != 0) (i < body ? taken : own).insert(now[i]);
    std::vector<std::string> out;
    for (const auto& [first, end] : added_items(before, now)) {
        bool has_name = false;
        if (does_more(now, first, end)) return {};
        for (size_t i = first; i < end; ++i) {
            if ((own.contains(now[i]) && !taken.contains(now[i])) || !is_brought(side, now[i])) continue;
            has_name = true;
            out.push_back("+ " + std::string(now[i]));
        }
        if (!has_name) return {};
    }
    return out;
}

/// True for a name that no unit has which is as it was recorded.
bool SweptNames::is_brought(Side side, std::string_view name) {
    if (!is_word_token(name) || roles_of(name) != 0) return false;
    const auto known = brought_[side].find(name);
    if (known != brought_[side].end()) return known->second;
    if (brought_[side].size() >= kMostNames) return false;
    return brought_[side][std::string(name)] = is_new(side, std::string(name));
}

bool SweptNames::are_same_on_both(const PairTexts& texts) {
    // An exchange of one side alone may be of what the other calls otherwise: `fmaxf` for `fminf` beside `fmax`.
    const BySide<ExchangedPaths> sides{ExchangedPaths(texts.source_before, texts.source_now),
                                       ExchangedPaths(texts.target_before, texts.target_now)};
    if (sides.source.names.empty() || sides.source.names != sides.target.names) return false;
    std::set<std::string> came;
    for (const auto& [before, now] : sides.source.names) {
        if (!came.insert(now).second) return false;
        for (const Side side : kBothSides)
            if (sides[side].left.contains(before) || sides[side].had.contains(now)) return false;
    }
    return true;
}

bool SweptNames::is_swept_type(Side side, const Name& name) {
    if (times(side, name).alone < kSeveral) return false;
    if (types_[side].size() >= kMostNames && !types_[side].contains(name)) return false;
    const auto [known, is_first] = types_[side].try_emplace(name, false);
    if (is_first)
        known->second =
            !is_in_code(facts_, side, name.first) && is_type(side, name.second) && is_new(side, name.second);
    return known->second;
}

bool SweptNames::is_swept_on_both(const Name& name) {
    const size_t here = times(Side::Source, name).in_all, there = times(Side::Target, name).in_all;
    if (here == 0 || there == 0 || here + there <= kSeveral) return false;
    if (roles_of(name.first) != 0 || roles_of(name.second) != 0) return false;
    if (!is_one_to_one(Side::Source, name) || !is_one_to_one(Side::Target, name)) return false;
    if (of_both_.size() >= kMostNames && !of_both_.contains(name)) return false;
    const auto [known, is_first] = of_both_.try_emplace(name, false);
    if (is_first)
        known->second = std::all_of(std::begin(kBothSides), std::end(kBothSides), [&](Side side) {
            return !is_in_code(facts_, side, name.first) && is_new(side, name.second);
        });
    return known->second;
}

/// True if the first name gave way to the second alone, and the second took the place of the first alone.
bool SweptNames::is_one_to_one(Side side, const Name& name) {
    const auto& all = exchanges(side);
    return std::none_of(all.begin(), all.end(), [&](const auto& one) {
        return (one.first.first == name.first) != (one.first.second == name.second);
    });
}

/// True if the side declares a type, or another name of one, by that word.
bool SweptNames::is_type(Side side, const std::string& name) const {
    for (const auto& [id, unit] : facts_.units(side))
        if (unit.kind == UnitKind::Struct && bare_leaf_of(unit.name) == name) return true;
    const FilesOfSide& files = (*facts_.files)[side];
    for (size_t i = 0; i < files.size(); ++i) {
        if (!says_word(files.text(i), name)) continue;
        const std::vector<DeclaredWord> said = declared_words(files.scanned(i));
        if (std::any_of(said.begin(), said.end(), [&](const DeclaredWord& one) {
                return one.kind == DeclaredWord::Kind::Type && word_of(files.scanned(i), one) == name &&
                       !is_bare_alias(files.scanned(i), one);
            }))
            return true;
    }
    return false;
}

/// True if no unit that is as it was recorded has the word.
bool SweptNames::is_new(Side side, const std::string& name) const {
    const auto recorded = recorded_texts(facts_, side);
    for (const auto& [id, unit] : facts_.units(side)) {
        const auto then = recorded.find(id);
        if (then == recorded.end() || then->second != unit.prints.written) continue;
        if (has_name(unit.text, name)) return false;
    }
    return true;
}

SweptNames::Times SweptNames::times(Side side, const Name& name) {
    const auto& all = exchanges(side);
    const auto found = all.find(name);
    return found == all.end() ? Times() : found->second;
}

/// In how many watched units one name took another's place, where nothing else but the like was edited.
const std::map<SweptNames::Name, SweptNames::Times>& SweptNames::exchanges(Side side) {
    if (exchanges_[side]) return *exchanges_[side];
    std::map<Name, Times>& out = exchanges_[side].emplace();
    std::set<std::string_view> seen;
    for (const LockedPair& line : facts_.lock.pairs) {
        const std::string& id = side == Side::Source ? line.source : line.target;
        const Print then = (side == Side::Source ? line.source_prints : line.target_prints).written;
        const auto unit = facts_.units(side).find(id);
        if (unit == facts_.units(side).end() || unit->second.prints.written == then || !seen.insert(id).second)
            continue;
        const NormalText before = facts_.base_text(then);
        const auto names = exchanged_names(before.words(), unit->second.text.words());
        for (const Name& name : names) {
            ++out[name].in_all;
            out[name].alone += names.size() == 1 ? 1 : 0;
        }
    }
    return out;
}

}  // namespace porttool
