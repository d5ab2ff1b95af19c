// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/edit_reading.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "porttool/compare/asides.h"
#include "porttool/normal/normal_form.h"
#include "porttool/normal/normal_text.h"
#include "porttool/sync/directive_regions.h"
#include "porttool/sync/operands.h"

namespace porttool {
namespace {

std::vector<std::string> numbers_of(const AlignedText& text, const Clause& clause) {
    std::vector<std::string> out;
    for (size_t i = clause.first; i < clause.end; ++i)
        if (is_number_token(text.words[i])) out.push_back(number_value(text.words[i]));
    return out;
}

/// How many indices follow a word: 2 for `m [ i ] [ j ]`.
template <class WordAt>
size_t indices_after(size_t i, size_t end, const WordAt& at) {
    size_t count = 0;
    for (++i; i < end && at(i) == "["; ++count) {
        int depth = 0;
        for (; i < end; ++i) {
            depth += at(i) == "[" ? 1 : at(i) == "]" ? -1 : 0;
            if (depth == 0) break;
        }
        ++i;
    }
    return count;
}

}  // namespace

EditReading::EditReading(const EditTexts& texts, const EditTranslator& translator,
                         const std::function<std::string(size_t)>& written)
    : texts_(texts), translator_(translator), written_(written), origin_(texts.now.clauses.size(), kNothing) {
    for (size_t c = 0; c < texts.before.clauses.size(); ++c)
        if (const size_t now = texts.edit.clause_of[c]; now != kNothing) origin_[now] = c;
    std::vector<bool> is_new;
    for (const size_t origin : origin_) is_new.push_back(origin == kNothing);
    named_values_ = NamedValues(texts.now, is_new);
    stands_for_.insert(texts.across.clause_of.begin(), texts.across.clause_of.end());
    find_doubtful();
}

CarriedWords EditReading::carry_old(size_t first, size_t end) const {
    return translator_.carry(texts_.before.words, first, end, [this](size_t i) { return texts_.before.words[i]; });
}

CarriedWords EditReading::carry_new(size_t first, size_t end) const {
    return translator_.carry(texts_.now.words, first, end, written_);
}

bool EditReading::says(size_t first, size_t end, const std::vector<CarriedWord>& words, bool values) const {
    if (end < first || end - first != words.size()) return false;
    for (size_t i = 0; i < words.size(); ++i) {
        const std::string &there = texts_.target.words[first + i], &here = words[i].text;
        if (there == here) continue;
        if (!is_number_token(there) || !is_number_token(here)) return false;
        if (values ? number_value(there) != number_value(here) : normal_number(there) != normal_number(here))
            return false;
    }
    return true;
}

bool EditReading::is_said_more_often(size_t was, size_t there) const {
    constexpr size_t kShortest = 3;
    if (before(was).opens || before(was).closes || before(was).size() < kShortest) return false;
    const auto times = [](const AlignedText& text, const Clause& clause) {
        return std::count_if(text.clauses.begin(), text.clauses.end(), [&](const Clause& other) {
            return other.size() == clause.size() &&
                   std::equal(text.exact.begin() + static_cast<std::ptrdiff_t>(other.first),
                              text.exact.begin() + static_cast<std::ptrdiff_t>(other.end),
                              text.exact.begin() + static_cast<std::ptrdiff_t>(clause.first));
        });
    };
    return times(texts_.target, target(there)) > times(texts_.before, before(was)) || is_one_of_like(was, there);
}

bool EditReading::is_one_of_like(size_t was, size_t there) const {
    constexpr size_t kShortest = 7;
    const auto is_like = [](const AlignedText& text, const Clause& a, const Clause& b) {
        if (a.size() != b.size() || a.opens || b.opens || a.inside != b.inside) return false;
        bool differs = false;
        for (size_t k = 0; k < a.size(); ++k) {
            const std::string &one = text.words[a.first + k], &other = text.words[b.first + k];
            const bool is_called = a.first + k + 1 < a.end && text.words[a.first + k + 1] == "(";
            if (one != other && (!is_name(one) || !is_name(other) || is_called)) return false;
            differs |= one != other;
        }
        return differs;
    };
    if (target(there).size() < kShortest) return false;
    const auto has_like_beside = [&](const AlignedText& text, size_t c, const auto& counts) {
        return (c > 0 && is_like(text, text.clauses[c], text.clauses[c - 1]) && counts(c - 1)) ||
               (c + 1 < text.clauses.size() && is_like(text, text.clauses[c], text.clauses[c + 1]) && counts(c + 1));
    };
    return has_like_beside(texts_.target, there, [&](size_t c) { return !stands_for_something(c); }) &&
           !has_like_beside(texts_.before, was, [](size_t) { return true; });
}

bool EditReading::stands_for_something(size_t there) const { return stands_for_.contains(there); }

std::optional<size_t> EditReading::only_counterpart(const Clause& old) const {
    const CarriedWords said = carry_old(old.first, old.end);
    if (!said.unknown.empty() || said.words.size() != old.size() || times_in_source(old) != 1) return std::nullopt;
    return only_place_of(said.words);
}

std::optional<size_t> EditReading::only_statement(size_t c) const {
    constexpr size_t kShortest = 5;
    const Clause& old = before(c);
    if (old.opens || old.closes || old.size() < kShortest) return std::nullopt;
    const std::optional<size_t> at = only_counterpart(old);
    if (!at) return std::nullopt;
    for (size_t i = 0; i < texts_.target.clauses.size(); ++i)
        if (target(i).first == *at && target(i).end == *at + old.size() && !stands_for_something(i)) return i;
    return std::nullopt;
}

std::optional<size_t> EditReading::only_place_of(const std::vector<CarriedWord>& words) const {
    std::optional<size_t> out;
    for (size_t i = 0; i + words.size() <= texts_.target.words.size(); ++i) {
        if (!says(i, i + words.size(), words, true)) continue;
        if (out) return std::nullopt;
        out = i;
    }
    return out;
}

size_t EditReading::times_in_source(const Clause& clause) const {
    const auto word = [&](size_t i) { return texts_.before.exact.begin() + static_cast<std::ptrdiff_t>(i); };
    size_t out = 0;
    for (auto at = texts_.before.exact.begin();; ++at, ++out) {
        at = std::search(at, texts_.before.exact.end(), word(clause.first), word(clause.end));
        if (at == texts_.before.exact.end()) return out;
    }
}

size_t EditReading::counterpart_of_same(size_t c) const {
    const Clause& mine = before(c);
    const auto distance = [&](size_t other) { return other > c ? other - c : c - other; };
    size_t best = kNothing;
    for (size_t other = 0; other < texts_.before.clauses.size(); ++other) {
        if (counterpart(other) == kNothing || before(other).closes || before(other).size() != mine.size()) continue;
        const auto words = texts_.before.exact.begin();
        const bool same =
            std::equal(words + static_cast<std::ptrdiff_t>(mine.first), words + static_cast<std::ptrdiff_t>(mine.end),
                       words + static_cast<std::ptrdiff_t>(before(other).first));
        if (same && (best == kNothing || distance(other) < distance(best))) best = other;
    }
    return best == kNothing ? best : counterpart(best);
}

EditReading::Nearby EditReading::near(size_t c) const {
    if (counterpart(c) != kNothing) return {target(counterpart(c)).first};
    if (const size_t same = counterpart_of_same(c); same != kNothing) return {target(same).first};
    size_t left = 0, right = texts_.target.clauses.size(), after_left = c, before_right = texts_.before.clauses.size();
    for (size_t i = c; i-- > 0;)
        if (counterpart(i) != kNothing) {
            left = counterpart(i);
            after_left = c - i;
            break;
        }
    for (size_t i = c + 1; i < texts_.before.clauses.size(); ++i)
        if (counterpart(i) != kNothing) {
            right = counterpart(i);
            before_right = i - c;
            break;
        }
    // What resembles it between its neighbours, or well anywhere, may stand for it in another form; a name that few
    // others there have tells more than a little resemblance.
    constexpr double kALittle = 0.2, kWell = 0.5;
    const auto most_alike = [&](size_t first, size_t end, double likeness) {
        size_t best = kNothing;
        for (size_t i = first; i < end; ++i)
            if (const double found = resemblance(c, i); found > likeness) likeness = found, best = i;
        return best;
    };
    if (const size_t said = says_rare_name_of(c, left, true); said != kNothing) return {target(said).first};
    const size_t all = texts_.target.clauses.size();
    const auto first_of = [&](size_t there) { return Nearby{target(there).first}; };
    if (const size_t best = most_alike(left + 1, right, kWell); best != kNothing) return first_of(best);
    if (const size_t said = says_rare_name_of(c, left); said != kNothing && left < said && said < right)
        return first_of(said);
    if (const size_t best = most_alike(left + 1, right, kALittle); best != kNothing) return first_of(best);
    if (const size_t best = most_alike(1, all, kWell); best != kNothing) return first_of(best);
    if (const size_t said = says_rare_name_of(c, left); said != kNothing) return first_of(said);
    const bool is_right = before_right < after_left && right < texts_.target.clauses.size();
    return {is_right ? target(right).first : target(left).end - 1, false};
}

/// The clause of the target, of those that stand for none, that has a name of clause c which few others there have; of
/// several the nearest to `place`. With `gone` of all its clauses and of the names that the source has no more.
size_t EditReading::says_rare_name_of(size_t c, size_t place, bool gone) const {
    constexpr size_t kFew = 2;
    std::map<uint32_t, std::vector<size_t>> clauses;
    for (size_t i = before(c).first; i < before(c).end; ++i)
        if (is_name(texts_.before.words[i]) && (!gone || std::find(texts_.now.words.begin(), texts_.now.words.end(),
                                                                   texts_.before.words[i]) == texts_.now.words.end()))
            clauses[texts_.before.common[i]];
    for (size_t there = 1; there < texts_.target.clauses.size(); ++there)
        for (size_t i = target(there).first; i < target(there).end; ++i) {
            const auto found = clauses.find(texts_.target.common[i]);
            if (found != clauses.end() && (found->second.empty() || found->second.back() != there))
                found->second.push_back(there);
        }
    const auto distance = [&](size_t there) { return there > place ? there - place : place - there; };
    size_t best = kNothing;
    for (const auto& [name, all] : clauses) {
        if (all.size() > kFew) continue;
        for (const size_t there : all)
            if ((gone || !stands_for_something(there)) && (best == kNothing || distance(there) < distance(best)))
                best = there;
    }
    return best;
}

/// The share of names and numbers that a clause of the source's old text and one of the target have in common, if that
/// stands for none; else 0.
double EditReading::resemblance(size_t c, size_t there) const {
    if (stands_for_something(there) || target(there).closes || before(c).closes) return 0;
    const auto telling = [](const AlignedText& text, const Clause& clause) {
        std::vector<uint32_t> out;
        for (size_t i = clause.first; i < clause.end; ++i)
            if (is_word_token(text.words[i]) || is_number_token(text.words[i])) out.push_back(text.common[i]);
        std::sort(out.begin(), out.end());
        return out;
    };
    const std::vector<uint32_t> mine = telling(texts_.before, before(c)),
                                others = telling(texts_.target, target(there));
    std::vector<uint32_t> both;
    std::set_intersection(mine.begin(), mine.end(), others.begin(), others.end(), std::back_inserter(both));
    const size_t all = mine.size() + others.size();
    return all == 0 ? 0 : 2.0 * static_cast<double>(both.size()) / static_cast<double>(all);
}

std::string EditReading::indexed_otherwise(const std::vector<CarriedWord>& words) const {
    const auto here = [&](size_t i) -> const std::string& { return words[i].text; };
    const auto there = [&](size_t i) -> const std::string& { return texts_.target.words[i]; };
    for (size_t i = 0; i + 1 < words.size(); ++i) {
        if (!is_word_token(words[i].text) || words[i + 1].text != "[") continue;
        const size_t count = indices_after(i, words.size(), here);
        bool any = false, same = false;
        for (size_t k = 0; k + 1 < texts_.target.words.size() && !same; ++k) {
            if (there(k) != words[i].text || there(k + 1) != "[") continue;
            any = true;
            same = indices_after(k, texts_.target.words.size(), there) == count;
        }
        if (any && !same) return words[i].text;
    }
    return {};
}

bool EditReading::is_doubtful(size_t c) const {
    if (c != Clause::kNone && in_doubtful_directive_[c]) return true;
    for (; c != Clause::kNone; c = before(c).inside)
        if (doubtful_[c]) return true;
    return false;
}

bool EditReading::is_doubtful_directive(size_t c) const { return in_doubtful_directive_[c]; }

std::string EditReading::shown(const std::vector<std::string>& words, size_t first, size_t end) {
    std::string out;
    constexpr size_t kMost = 12;
    for (size_t i = first; i < std::min(end, first + kMost); ++i) out += (i > first ? " " : "") + words[i];
    return end > first + kMost ? out + " ..." : out;
}

std::string EditReading::listed(std::vector<std::string> words) {
    std::sort(words.begin(), words.end());
    words.erase(std::unique(words.begin(), words.end()), words.end());
    std::string out;
    for (const std::string& word : words) out += (out.empty() ? "`" : ", `") + word + "`";
    return out;
}

std::vector<std::string> EditReading::comparisons(const AlignedText& text, const Clause& clause) {
    std::vector<std::string> out;
    for (size_t i = clause.first; i < clause.end; ++i)
        for (const std::string_view word : {"<", ">", "<=", ">=", "==", "!=", "&&", "||", "!", "?"})
            if (text.words[i] == word) out.emplace_back(word);
    return out;
}

std::vector<std::string> EditReading::texts_of(const std::vector<CarriedWord>& words) {
    std::vector<std::string> out;
    for (const CarriedWord& word : words) out.push_back(word.text);
    return out;
}

bool EditReading::speaks_to_people(const AlignedText& text, const Clause& clause) {
    if (clause.opens || clause.closes) return false;
    return without_asides(Words(text.words.begin() + static_cast<std::ptrdiff_t>(clause.first),
                                text.words.begin() + static_cast<std::ptrdiff_t>(clause.end)))
        .empty();
}

void EditReading::find_doubtful() {
    doubtful_.assign(texts_.before.clauses.size(), false);
    in_doubtful_directive_ = under_other_directives(texts_.before, texts_.target, texts_.across);
    for (size_t c = 0; c < doubtful_.size(); ++c) {
        const Clause& clause = before(c);
        if (!clause.opens || counterpart(c) == kNothing) continue;
        const std::string& head = texts_.before.words[clause.first];
        if (head == "else") {
            // Of the branch before it: that ends where this one begins.
            const size_t closing = c == 0 ? Clause::kNone : c - 1;
            const size_t branch = closing == Clause::kNone ? closing : before(closing).partner;
            doubtful_[c] = branch != Clause::kNone && before(closing).closes && doubtful_[branch];
        } else if (head == "if" || head == "while" || head == "switch") {
            const Clause& there = target(counterpart(c));
            constexpr double kAlike = 0.7;
            const bool asks_alike = texts_.across.likeness[c] >= kAlike &&
                                    numbers_of(texts_.before, clause) == numbers_of(texts_.target, there) &&
                                    comparisons(texts_.before, clause) == comparisons(texts_.target, there);
            doubtful_[c] =
                !asks_alike && !says(there.first, there.end, carry_old(clause.first, clause.end).words, true);
        }
    }
}

}  // namespace porttool
