// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/elsewhere_changes.h"

#include <algorithm>
#include <optional>

#include "porttool/normal/normal_text.h"
#include "porttool/sync/operands.h"

namespace porttool {

bool ElsewhereChanger::change_elsewhere(const std::vector<Hunk>& hunks, size_t was) {
    const std::optional<size_t> there = only_statement(was);
    return there && change_there(hunks, before(was).first, target(*there).first);
}

bool ElsewhereChanger::change_result(size_t was, size_t is) {
    const std::optional<size_t> there = only_result(texts_.target);
    if (only_result(texts_.before) != was || !there || stands_for_something(*there)) return false;
    const Clause old = value_of(texts_.before.words, before(was)), made = value_of(texts_.now.words, now(is));
    const Clause port = value_of(texts_.target.words, target(*there));
    if (made.size() <= old.size() || !is_operand(texts_.before.words, old.first, old.end) || port.size() == 0)
        return false;
    const auto word = [](const AlignedText& text, size_t i) {
        return text.exact.begin() + static_cast<std::ptrdiff_t>(i);
    };
    const auto found = std::search(word(texts_.now, made.first), word(texts_.now, made.end),
                                   word(texts_.before, old.first), word(texts_.before, old.end));
    if (found == word(texts_.now, made.end)) return false;
    const size_t at = static_cast<size_t>(found - texts_.now.exact.begin());
    const size_t after = at + old.size();
    if (at > made.first && is_accessor(texts_.now.words[at - 1])) return false;
    if (after < made.end && goes_on(texts_.now.words[after])) return false;
    CarriedWords front = carry_new(made.first, at);
    const CarriedWords back = carry_new(after, made.end);
    if (!front.unknown.empty() || !back.unknown.empty()) return false;
    if (!uses_.doubt_within(front.words, at, port.first).empty() ||
        !uses_.doubt_within(back.words, made.end, port.first).empty())
        return false;
    const bool bare = is_operand(texts_.target.words, port.first, port.end);
    if (!bare) front.words.push_back({"(", CarriedWord::kNoSource});
    for (size_t i = port.first; i < port.end; ++i)
        front.words.push_back({translator_.written_there(texts_.target.words[i]), CarriedWord::kNoSource});
    if (!bare) front.words.push_back({")", CarriedWord::kNoSource});
    front.words.insert(front.words.end(), back.words.begin(), back.words.end());
    out_.replaced.push_back({port.first, port.end, std::move(front.words), made.first, made.end});
    return true;
}

bool ElsewhereChanger::change_value(const std::vector<Hunk>& hunks, size_t was) {
    constexpr size_t kShortest = 7;
    const Clause value = value_of(texts_.before.words, before(was)), named = with_name(value, before(was));
    if (value.size() == 0 || hunks.front().first < value.first || hunks.back().end > value.end) return false;
    if (named.first < value.first)
        if (const std::optional<size_t> at = only_counterpart(named); at && ends_there(*at, named.size()))
            return change_there(hunks, named.first, *at);
    const std::optional<size_t> at = value.size() < kShortest ? std::nullopt : only_counterpart(value);
    return at && change_there(hunks, value.first, *at);
}

bool ElsewhereChanger::change_there(const std::vector<Hunk>& hunks, size_t first, size_t at) {
    const size_t made = out_.replaced.size();
    for (const Hunk& hunk : hunks) {
        const CarriedWords words = carry_new(hunk.now_first, hunk.now_end);
        const size_t place = at + (hunk.first - first);
        if (!words.unknown.empty() || !uses_.doubt_within(words.words, hunk.now_end, place).empty()) {
            out_.replaced.resize(made);
            return false;
        }
        out_.replaced.push_back({place, at + (hunk.end - first), words.words, hunk.now_first, hunk.now_end});
    }
    return true;
}

Clause ElsewhereChanger::with_name(Clause value, const Clause& clause) const {
    const std::vector<std::string>& words = texts_.before.words;
    const bool named = value.first >= clause.first + 3 && words[value.first - 1] == "=" &&
                       is_name(words[value.first - 2]) && is_word_token(words[value.first - 3]);
    if (named) value.first -= 2;
    return value;
}

bool ElsewhereChanger::ends_there(size_t at, size_t size) const {
    const std::vector<std::string>& words = texts_.target.words;
    return at > 0 && at + size < words.size() && !is_accessor(words[at - 1]) &&
           (words[at + size] == ";" || words[at + size] == ",");
}

bool ElsewhereChanger::change_type(const std::vector<Hunk>& hunks, size_t was) {
    const Clause& here = before(was);
    const auto declares_at = [](const std::vector<std::string>& words, const Clause& clause) {
        size_t i = clause.first;
        while (i + 1 < clause.end && is_word_token(words[i]) && words[i + 1] != "=") ++i;
        return i > clause.first && i + 1 < clause.end && words[i + 1] == "=" ? i : kNothing;
    };
    const size_t name = declares_at(texts_.before.words, here);
    if (name == kNothing || hunks.size() != 1 || hunks.back().end > name) return false;
    const CarriedWords said = carry_old(here.first, name + 1);
    const CarriedWords made = carry_new(hunks[0].now_first, hunks[0].now_end);
    if (!said.unknown.empty() || !made.unknown.empty() || said.words.size() != name + 1 - here.first) return false;
    std::optional<size_t> place;
    for (const Clause& clause : texts_.target.clauses) {
        const size_t there = declares_at(texts_.target.words, clause);
        if (there == kNothing || !says(clause.first, there + 1, said.words)) continue;
        if (place) return false;
        place = clause.first;
    }
    if (!place) return false;
    out_.replaced.push_back({*place + (hunks[0].first - here.first), *place + (hunks[0].end - here.first), made.words,
                             hunks[0].now_first, hunks[0].now_end});
    return true;
}

}  // namespace porttool
