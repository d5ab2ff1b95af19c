// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/sibling_slips.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>
#include <string_view>

#include "porttool/audit/operands.h"
#include "porttool/language/words.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

using Text = std::vector<std::string>;

bool is_decimal(char c) { return c >= '0' && c <= '9'; }

/// True for letters that count on: of components, axes, loops, corners.
bool is_letter_of(char a, char b) {
    static constexpr std::string_view kFamilies[] = {"xyzw", "rgba", "uvw", "ijkl", "abcd",
                                                     "XYZW", "RGBA", "UVW", "IJKL"};
    return std::any_of(std::begin(kFamilies), std::end(kFamilies), [&](std::string_view family) {
        return family.find(a) != std::string_view::npos && family.find(b) != std::string_view::npos;
    });
}

/// The place of the one letter or digit by which two words differ, and that counts: `i0` and `i1`, `x` and `y`, `minX`
/// and `minY`; none for `sad` and `bad`.
std::optional<size_t> counting_place(const std::string& a, const std::string& b) {
    if (a.size() != b.size() || a == b) return std::nullopt;
    const size_t at = static_cast<size_t>(std::mismatch(a.begin(), a.end(), b.begin()).first - a.begin());
    if (a.compare(at + 1, std::string::npos, b, at + 1, std::string::npos) != 0) return std::nullopt;
    if (is_decimal(a[at]) && is_decimal(b[at])) return at;
    if (!is_letter_of(a[at], b[at])) return std::nullopt;
    constexpr size_t kShort = 3;
    const bool stands_apart = a.size() < kShort || (at > 0 && a[at - 1] == '_') ||
                              (at + 1 < a.size() && a[at + 1] == '_') || std::isupper(a[at]) != 0;
    return stands_apart ? std::optional(at) : std::nullopt;
}

/// The word with another letter or digit where it counts, as `from` -> `to` has it in some other word.
std::optional<std::string> counted_on(const std::string& word, char from, char to) {
    constexpr size_t kLongest = 256;  // letters: a longer name counts nothing
    std::optional<std::string> out;
    for (size_t at = 0; at < word.size() && word.size() <= kLongest; ++at) {
        if (word[at] != from) continue;
        std::string other = word;
        other[at] = to;
        if (!counting_place(word, other)) continue;
        if (out) return std::nullopt;  // which one?
        out = std::move(other);
    }
    return out;
}

/// True for a name, and for the number of an element: other numbers are what they are.
bool may_count(StatementWords words, size_t at) {
    if (is_word_token(words[at])) return true;
    return is_number_token(words[at]) && at > 0 && at + 1 < words.size() && words[at - 1] == "[" &&
           words[at + 1] == "]";
}

/// The word with the two before it, for a reader.
std::string with_words_before(StatementWords words, size_t at) {
    constexpr size_t kBefore = 2;
    std::string out;
    for (size_t i = at - std::min(at, kBefore); i <= at; ++i) (out.empty() ? out : out += ' ') += words[i];
    return "`" + out + "`";
}

/// A word of one of several texts that does not go along with the others.
struct OddWord {
    size_t text = 0, at = 0, along = 0;  ///< `along`: how many words of it go along
    std::string wanted;
};

/// Which of three words is another one's, where two of them are as the marks want them; 3 for none.
size_t odd_of_three(const StatementWords (&all)[3], size_t at, const std::string& marks) {
    for (size_t odd = 0; odd < 3; ++odd) {
        const std::string& one = all[odd == 0 ? 1 : 0][at];
        const std::string& two = all[odd == 2 ? 1 : 2][at];
        const auto word = counted_on(one, marks[odd == 0 ? 1 : 0], marks[odd == 2 ? 1 : 2]);
        if (word && *word == two && (all[odd][at] == one || all[odd][at] == two)) return odd;
    }
    return 3;
}

/// Three texts that say the same but for what counts on, and for one word of one of them.
std::optional<OddWord> odd_word_of_three(const StatementWords (&all)[3]) {
    const size_t size = all[0].size();
    if (all[1].size() != size || all[2].size() != size) return std::nullopt;
    std::string marks;  // of each text, by the first word that counts
    OddWord out;
    for (size_t p = 0; p < size; ++p) {
        const std::string &a = all[0][p], &b = all[1][p], &c = all[2][p];
        if (a == b && b == c) continue;
        if (!may_count(all[0], p)) return std::nullopt;
        const auto ab = counting_place(a, b), ac = counting_place(a, c), bc = counting_place(b, c);
        if (ab && ac && bc && *ab == *ac) {
            const std::string now{a[*ab], b[*ab], c[*ab]};
            if (marks.empty()) marks = now;
            if (now != marks) return std::nullopt;
            ++out.along;
            continue;
        }
        if (marks.empty() || !out.wanted.empty()) return std::nullopt;
        out.text = odd_of_three(all, p, marks);
        if (out.text == 3) return std::nullopt;
        out.at = p;
        const size_t good = out.text == 0 ? 1 : 0;
        const auto word = counted_on(all[good][p], marks[good], marks[out.text]);
        if (!word) return std::nullopt;
        out.wanted = *word;
    }
    return out.wanted.empty() ? std::nullopt : std::optional(out);
}

bool is_sum_or_question(const std::string& word) { return is_one_of(word, {"+", "&&", "||"}); }

/// True where a chain of operators may begin behind the word. No chain goes on over such a word, so that chains of one
/// pair of brackets have no words in common.
bool begins_chain(const std::string& word) { return is_one_of(word, {"(", "=", "return", ",", "+="}); }

bool closes_round_or_square(const std::string& word) { return is_one_of(word, {")", "]"}); }

/// Steps over what stands in brackets: the last word of it, all others as they are.
size_t stepped_over(StatementWords words, const BracketPartners& partners, size_t at) {
    if (!is_one_of(words[at], {"(", "["})) return at;
    const size_t close = partners.of(at);
    return close == at ? words.size() - 1 : close;
}

/// The terms of a sum, or the questions of a condition, one list for each pair of brackets and the whole.
std::vector<std::vector<StatementWords>> chains_of(StatementWords words, const BracketPartners& partners) {
    std::vector<std::vector<StatementWords>> out;
    for (size_t first = 0; first < words.size(); ++first) {
        if (first > 0 && !begins_chain(words[first - 1])) continue;
        std::vector<StatementWords> terms;
        std::string joint;
        size_t begin = first, i = first;
        for (; i < words.size(); ++i) {
            if (closes_round_or_square(words[i]) || is_one_of(words[i], {",", "?", ";", "=", "-", "return", "+="}))
                break;
            if (is_sum_or_question(words[i]) && (joint.empty() || joint == words[i])) {
                joint = words[i];
                terms.push_back(words.subspan(begin, i - begin));
                begin = i + 1;
            }
            i = stepped_over(words, partners, i);
        }
        terms.push_back(words.subspan(begin, i - begin));
        if (terms.size() > 2) out.push_back(std::move(terms));
    }
    return out;
}

/// The operands of a plain chain of operators, and those; no operands where it is none.
struct Chain {
    std::vector<StatementWords> operands;
    std::vector<std::string> operators;
};

Chain chain_from(StatementWords words, const BracketPartners& partners, size_t first) {
    Chain out;
    size_t begin = first, i = first;
    for (; i < words.size(); ++i) {
        if (closes_round_or_square(words[i]) || is_one_of(words[i], {",", ";", "=", "return", "+="})) break;
        if (is_one_of(words[i], {"+", "-", "*", "/", "&&", "||", "&", "|", "<", ">", "=="})) {
            out.operators.push_back(words[i]);
            out.operands.push_back(words.subspan(begin, i - begin));
            begin = i + 1;
        }
        i = stepped_over(words, partners, i);
    }
    out.operands.push_back(words.subspan(begin, i - begin));
    const bool is_whole =
        std::none_of(out.operands.begin(), out.operands.end(), [](StatementWords one) { return one.empty(); });
    return is_whole ? out : Chain();
}

/// What counts on from one operand to another that is otherwise the same: '0' and '1' of `i0` and `i1`.
std::optional<std::string> counts_on(StatementWords a, StatementWords b) {
    if (a.size() != b.size()) return std::nullopt;
    std::string marks;
    for (size_t p = 0; p < a.size(); ++p) {
        if (a[p] == b[p]) continue;
        const auto at = may_count(a, p) ? counting_place(a[p], b[p]) : std::nullopt;
        if (!at || !marks.empty()) return std::nullopt;
        marks = {a[p][*at], b[p][*at]};
    }
    return marks.empty() ? std::nullopt : std::optional(marks);
}

/// Which operator of a chain stands between two terms where all others have another one: `*` of
/// `a0 * b0 + a1 * b1 * a2 * b2`. 0 for none: the first operator is within a term.
size_t operator_between(const Chain& chain) {
    constexpr size_t kFewest = 6;
    const size_t count = chain.operands.size();
    if (count < kFewest || count % 2 != 0) return 0;
    size_t odd = 0;
    std::string between;
    for (size_t k = 0; k + 1 < count; ++k) {
        const std::string& one = chain.operators[k];
        if (k % 2 == 0) {
            if (one != chain.operators[0]) return 0;
        } else if (one == chain.operators[0]) {
            if (odd != 0) return 0;
            odd = k;
        } else {
            if (!between.empty() && between != one) return 0;
            between = one;
        }
    }
    if (odd == 0 || between.empty()) return 0;
    for (size_t k = 2; k < count; k += 2) {
        const auto first = counts_on(chain.operands[k - 2], chain.operands[k]),
                   second = counts_on(chain.operands[k - 1], chain.operands[k + 1]);
        if (!first || !second || *first != *second) return 0;
    }
    return odd;
}

class Siblings {
public:
    explicit Siblings(const std::vector<Text>& statements) : statements_(statements) {
        for (const Text& words : statements) known_.insert(words.begin(), words.end());
    }

    std::vector<LoneSlip> run() const {
        std::vector<LoneSlip> out;
        for (size_t i = 1; i < statements_.size(); ++i) {
            if (!says_enough(statements_[i])) continue;
            std::optional<LoneSlip> slip = of_three(i);
            if (!slip) slip = of_two(i);
            const BracketPartners partners(statements_[i], false);
            if (!slip) slip = within(i, partners);
            if (!slip) slip = between(i, partners);
            if (slip) out.push_back(std::move(*slip));
        }
        return out;
    }

private:
    static bool says_enough(const Text& words) {
        constexpr size_t kLeast = 7;
        return words.size() >= kLeast && words[0] != "#" && !is_one_of(words[0], {"case", "for"});
    }

    bool is_known(const std::string& word) const {
        return known_.contains(word) || (word.size() == 1 && !is_decimal(word[0]));
    }

    static LoneSlip slip(size_t statement, StatementWords words, size_t at, const std::string& wanted,
                         const char* beside) {
        return {statement,
                "has " + with_words_before(words, at) + " where " + beside + " beside it go along to `" + wanted + "`",
                "say `" + wanted + "`, or leave it", false};
    }

    /// True where two statements set what counts on.
    static bool set_next(StatementWords a, StatementWords b) {
        const auto sets = std::find_if(a.begin(), a.end(), [](const std::string& word) {
            return is_one_of(word, {"=", "+=", "-=", "*=", "/="});
        });
        const auto size = sets - a.begin();
        return sets != a.end() && !std::equal(a.begin(), sets, b.begin(), b.begin() + size);
    }

    std::optional<LoneSlip> of_three(size_t first) const {
        constexpr size_t kGoAlong = 2;
        if (first + 2 >= statements_.size()) return std::nullopt;
        const StatementWords all[] = {statements_[first], statements_[first + 1], statements_[first + 2]};
        const auto odd = odd_word_of_three(all);
        if (!odd || odd->along < kGoAlong || !is_known(odd->wanted) || !set_next(all[0], all[1])) return std::nullopt;
        return slip(first + odd->text, all[odd->text], odd->at, odd->wanted, "the statements");
    }

    /// Two statements, of which the second keeps one name of the first and changes all others that count.
    std::optional<LoneSlip> of_two(size_t first) const {
        constexpr size_t kGoAlong = 4;
        if (first + 1 >= statements_.size()) return std::nullopt;
        const Text &a = statements_[first], &b = statements_[first + 1];
        if (a.size() != b.size() || !set_next(a, b)) return std::nullopt;
        char from = 0, to = 0;
        size_t along = 0;
        for (size_t p = 0; p < a.size(); ++p) {
            if (a[p] == b[p]) continue;
            const auto at = may_count(a, p) ? counting_place(a[p], b[p]) : std::nullopt;
            if (!at || (from != 0 && (a[p][*at] != from || b[p][*at] != to))) return std::nullopt;
            from = a[p][*at];
            to = b[p][*at];
            ++along;
        }
        if (along < kGoAlong) return std::nullopt;
        std::optional<size_t> kept;
        std::string wanted;
        for (size_t p = 0; p < a.size(); ++p) {
            if (a[p] != b[p] || !is_word_token(a[p])) continue;
            if (counted_on(a[p], to, from)) return std::nullopt;  // each says something of the other's
            const auto word = counted_on(a[p], from, to);
            if (!word || !is_known(*word)) continue;
            if (kept) return std::nullopt;
            kept = p;
            wanted = *word;
        }
        return kept ? std::optional(slip(first + 1, b, *kept, wanted, "the words")) : std::nullopt;
    }

    /// Terms of one sum: `a . x * b . x + a . y * b . y + a . z * b . y`.
    std::optional<LoneSlip> within(size_t index, const BracketPartners& partners) const {
        constexpr size_t kFewestWords = 5;
        for (const std::vector<StatementWords>& terms : chains_of(statements_[index], partners))
            for (size_t k = 0; k + 2 < terms.size(); ++k) {
                const StatementWords all[] = {terms[k], terms[k + 1], terms[k + 2]};
                const auto odd = odd_word_of_three(all);
                if (odd && terms[k].size() >= kFewestWords && is_known(odd->wanted))
                    return slip(index, all[odd->text], odd->at, odd->wanted, "the terms");
            }
        return std::nullopt;
    }

    /// Terms of one sum that are joined in two ways.
    std::optional<LoneSlip> between(size_t index, const BracketPartners& partners) const {
        const Text& words = statements_[index];
        for (size_t first = 1; first < words.size(); ++first) {
            if (!begins_chain(words[first - 1])) continue;
            const Chain chain = chain_from(words, partners, first);
            const size_t odd = operator_between(chain);
            if (odd == 0) continue;
            const std::string wanted = chain.operators[odd == 1 ? 3 : 1];
            return LoneSlip{index,
                            "has `" + chain.operators[odd] + "` before the term with " +
                                with_words_before(chain.operands[odd + 1], chain.operands[odd + 1].size() - 1) +
                                ", where the terms beside it have `" + wanted + "`",
                            "say `" + wanted + "`, or leave it", false};
        }
        return std::nullopt;
    }

    const std::vector<Text>& statements_;
    std::set<std::string> known_;
};

}  // namespace

std::vector<LoneSlip> sibling_slips(const std::vector<Text>& statements) { return Siblings(statements).run(); }

}  // namespace porttool
