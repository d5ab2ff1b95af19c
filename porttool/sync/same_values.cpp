// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/same_values.h"

#include <algorithm>

#include "porttool/normal/declaration_words.h"
#include "porttool/normal/normal_form.h"
#include "porttool/normal/normal_text.h"
#include "porttool/normal/statements.h"

namespace porttool {
namespace {

/// What of a value counts whatever the manner: its operators and numbers.
std::vector<std::string> parts_of(const std::vector<std::string>& words) {
    std::vector<std::string> out;
    const auto is_value = [&](size_t i) { return is_word_token(words[i]) || is_number_token(words[i]); };
    for (size_t i = 0; i < words.size(); ++i) {
        if (is_number_token(words[i])) out.push_back(number_value(words[i]));
        if (is_value(i) || is_one_of(words[i], {"(", ")", "[", "]", "{", "}", ",", ".", "->", "::"})) continue;
        const bool is_prefix = i == 0 || !(is_value(i - 1) || is_one_of(words[i - 1], {")", "]"}));
        if (!is_prefix || !is_one_of(words[i], {"*", "&", "+"})) out.push_back(words[i]);
    }
    std::sort(out.begin(), out.end());
    return out;
}

std::vector<std::string> written_words(const AlignedText& text, size_t first, size_t end) {
    return {text.words.begin() + static_cast<std::ptrdiff_t>(first),
            text.words.begin() + static_cast<std::ptrdiff_t>(end)};
}

/// True for a value that is something else unchanged: `settings . scale`, `in [ i ]`.
bool is_taken_as_is(const AlignedText& text, const std::vector<VariableWrite>& writes) {
    return writes.size() == 1 && writes[0].op == "=" && writes[0].end > writes[0].first &&
           parts_of(written_words(text, writes[0].first, writes[0].end)).empty();
}

bool is_one(const AlignedText& text, const VariableWrite& write) {
    return write.first == write.end ||
           (write.end == write.first + 1 && number_value(text.words[write.first]) == number_value("1"));
}

}  // namespace

std::string SameValues::difference(const Names& names, const Clauses& here, const Clauses& there, int depth) const {
    Clauses alone, alone_there = there;
    std::vector<std::pair<size_t, size_t>> both;
    for (const size_t clause : here) {
        const size_t other = clause == 0 ? 0 : counterpart(clause);
        if (alone_there.erase(other) != 0)
            both.emplace_back(clause, other);
        else
            alone.insert(clause);
    }
    if (alone.size() == 1 && alone_there.size() == 1) {
        both.emplace_back(*alone.begin(), *alone_there.begin());
        alone.clear(), alone_there.clear();
    }
    const auto shown_clause = [](const AlignedText& text, size_t clause) {
        return "`" + shown(text.words, text.clauses[clause].first, text.clauses[clause].end) + "`";
    };
    if (!alone.empty())
        return "the port's `" + names.there + "` goes without what " + shown_clause(texts_.before, *alone.begin()) +
               " makes of `" + names.here + "`";
    if (!alone_there.empty())
        return "the port's `" + names.there + "` is what " + shown_clause(texts_.target, *alone_there.begin()) +
               " makes of it, `" + names.here + "` is not";
    for (const auto& [was, other] : both)
        if (std::string why = difference_of(names, was, other, depth); !why.empty()) return why;
    return {};
}

std::string SameValues::difference_of(const Names& names, size_t here) const {
    const size_t there = here == 0 ? 0 : counterpart(here);
    if (there != kNothing && (there == 0 || !there_.writes(there, names.there, names.part_there).empty()))
        return difference_of(names, here, there, 0);
    return "the port's `" + names.there + "` goes without what `" +
           shown(texts_.before.words, before(here).first, before(here).end) + "` makes of `" + names.here + "`";
}

std::string SameValues::difference_of(const Names& names, size_t here, size_t there, int depth) const {
    const auto [told, is_new] =
        told_.try_emplace({names.here, names.there, names.part_here, names.part_there, here, there, depth});
    // A value that leads back to itself is asked for while it is told: so far nothing differs.
    if (is_new) told->second = written_otherwise(names, here, there, depth);
    return told->second;
}

bool SameValues::say_it_each_their_way(const Names& names, size_t here, size_t there) const {
    constexpr double kAlike = 0.6;
    return names.here == names.there && counterpart(here) == there && texts_.across.likeness[here] >= kAlike;
}

std::string SameValues::written_otherwise(const Names& names, size_t here, size_t there, int depth) const {
    if (here != 0 && say_it_each_their_way(names, here, there)) return {};
    const std::string why = "the port's `" + names.there + "` is not what `" + names.here + "` is: it has `" +
                            shown(texts_.target.words, target(there).first, target(there).end) + "`";
    if (here == 0 && there == 0) return is_other_parameter(names) ? why : std::string();
    if (is_by_thread(texts_.before, here) || is_by_thread(texts_.target, there))
        return counts_alike(here, there) ? std::string() : why;
    const std::vector<VariableWrite> was = before_.writes(here, names.here, names.part_here),
                                     is = there_.writes(there, names.there, names.part_there);
    if (was.empty() || is.empty()) return {};
    if (here == 0 || there == 0)
        return is_taken_as_is(here == 0 ? texts_.target : texts_.before, here == 0 ? is : was) ? std::string() : why;
    const auto by_address = [](const VariableWrite& write) { return write.op == VariableWrite::kAddress; };
    if (std::any_of(was.begin(), was.end(), by_address) || std::any_of(is.begin(), is.end(), by_address)) return {};
    if (was.size() != is.size()) return why;
    for (size_t i = 0; i < was.size(); ++i)
        if (std::string inner = differ(was[i], is[i], depth); !inner.empty()) return inner == " " ? why : inner;
    return {};
}

/// True if the head has another parameter in the place of the source's.
bool SameValues::is_other_parameter(const Names& names) const {
    if (folded(names.here) == folded(names.there)) return false;
    for (size_t i = before(0).first; i < before(0).end; ++i)
        if (texts_.before.words[i] == names.here && before_.local(i) != 0)
            return word_of(i) != kNothing && there_.local(word_of(i)) != 0 &&
                   texts_.target.words[word_of(i)] != names.there;
    return false;
}

bool SameValues::is_by_thread(const AlignedText& text, size_t clause) const {
    for (size_t i = text.clauses[clause].first; i < text.clauses[clause].end; ++i)
        if (translator_.is_of_thread(text.words[i])) return true;
    return false;
}

/// A thread's index is whatever the port counts by, an item's or a loop's, but no multiple of it.
bool SameValues::counts_alike(size_t here, size_t there) const {
    return thread_numbers(texts_.before, here) == thread_numbers(texts_.target, there);
}

/// The numbers of a clause, but for which of the dimensions a thread asks for, and where a loop begins and steps to.
std::vector<std::string> SameValues::thread_numbers(const AlignedText& text, size_t clause) const {
    std::vector<std::string> out;
    const Clause& one = text.clauses[clause];
    for (size_t i = one.first; i < one.end; ++i) {
        if (!is_number_token(text.words[i])) continue;
        const bool is_argument = i > one.first + 1 && is_one_of(text.words[i - 1], {"(", "["}) &&
                                 translator_.is_of_thread(text.words[i - 2]);
        const bool is_plain = number_value(text.words[i]) == number_value("0") ||
                              (one.opens && number_value(text.words[i]) == number_value("1"));
        if (!is_argument && !is_plain) out.push_back(number_value(text.words[i]));
    }
    std::sort(out.begin(), out.end());
    return out;
}

std::string SameValues::differ(const VariableWrite& here, const VariableWrite& there, int depth) const {
    if (here.op != there.op) return " ";
    if (here.first == here.end || there.first == there.end)
        return is_one(texts_.before, here) != is_one(texts_.target, there) ? " " : "";
    const std::vector<CarriedWord> said = carry_old(here.first, here.end).words;
    if (said.size() != there.end - there.first) return differ_in_parts(there, said) ? " " : "";
    for (size_t i = 0; i < said.size(); ++i) {
        const size_t from = said[i].from, to = there.first + i;
        const size_t next = i + 1 < said.size() ? said[i + 1].from : here.end;
        const bool is_one_word = from != CarriedWord::kNoSource && next == from + 1;
        const LocalPart read = is_one_word ? before_.part(from) : LocalPart(), other = there_.part(to);
        const bool is_said = says(to, to + 1, {said[i]}, true);
        if (read.local == 0 || other.local == 0) {
            if (is_said) continue;
            return differ_in_parts(there, said) ? " " : "";
        }
        if (depth >= (is_said ? kDeepest : kDeepestOther)) continue;
        std::string why = difference({texts_.before.words[from], texts_.target.words[to], read.part, other.part},
                                     before_.reaching(from), there_.reaching(to), depth + 1);
        if (!why.empty()) return why;
    }
    return {};
}

/// The same in other words is still the same: with the same operators, numbers and variables.
bool SameValues::differ_in_parts(const VariableWrite& there, const std::vector<CarriedWord>& said) const {
    if (parts_of(texts_of(said)) != parts_of(written_words(texts_.target, there.first, there.end))) return true;
    std::multiset<std::string> mine, others;
    for (const CarriedWord& word : said)
        if (word.from != CarriedWord::kNoSource && before_.local(word.from) != 0) mine.insert(word.text);
    for (size_t i = there.first; i < there.end; ++i)
        if (there_.local(i) != 0) others.insert(texts_.target.words[i]);
    return mine != others;
}

}  // namespace porttool
