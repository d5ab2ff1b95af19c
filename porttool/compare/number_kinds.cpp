// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/number_kinds.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "porttool/compare/brackets.h"
#include "porttool/compare/casts.h"
#include "porttool/compare/hints.h"
#include "porttool/compare/statement_edit.h"
#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/normal_form.h"

namespace porttool {
namespace {

using KindText = std::vector<std::string>;

/// What a value is, as far as a text tells. Whole numbers of other widths than 32 bits are none of these: narrower ones
/// become `int` first, and wider ones take in both signs.
enum class KindOfNumber : uint8_t { Unknown, Signed, Unsigned, Real };

KindOfNumber kind_of_type(std::string_view word, const Dialect& dialect) {
    if (!is_type_word(word)) return KindOfNumber::Unknown;
    const std::string type = common_word(word, dialect);
    if (type == "int" || type.starts_with("ivec")) return KindOfNumber::Signed;
    if (type == "uint" || type.starts_with("uvec")) return KindOfNumber::Unsigned;
    return is_one_of(type, {"float", "double", "half"}) || type.starts_with("vec") ? KindOfNumber::Real
                                                                                   : KindOfNumber::Unknown;
}

KindOfNumber kind_of_both(KindOfNumber a, KindOfNumber b) {
    if (a == KindOfNumber::Real || b == KindOfNumber::Real) return KindOfNumber::Real;
    if (a == KindOfNumber::Unknown || b == KindOfNumber::Unknown) return KindOfNumber::Unknown;
    return std::max(a, b);
}

/// The kinds of the names that a side declares, each once and for all; a pointer's or an array's is that of an element.
class KindsOfNames {
public:
    KindsOfNames(const Dialect& dialect, std::initializer_list<const Words*> texts) : dialect_(dialect) {
        for (const Words* text : texts) note(with_one_word_types(*text));
    }

    KindOfNumber of(const std::string& name, bool is_element) const {
        const auto found = of_.find(name);
        if (found == of_.end() || (found->second.has_elements && !is_element)) return KindOfNumber::Unknown;
        return found->second.kind;
    }

private:
    struct Declared {
        KindOfNumber kind;
        bool has_elements;
    };

    void note(const Words& text) {
        const auto word = [&](size_t i) { return i < text.size() ? text[i] : std::string_view(";"); };
        for (size_t i = 0; i < text.size(); ++i) {
            if (!is_type_word(text[i])) continue;
            const KindOfNumber kind = kind_of_type(text[i], dialect_);
            size_t at = i + 1;
            do {
                bool has_elements = false;
                for (; is_one_of(word(at), {"*", "&", "const", "restrict", "__restrict__"}); ++at)
                    has_elements = has_elements || word(at) == "*";
                const std::string_view next = word(at + 1);
                if (!is_word_token(word(at)) || is_type_word(word(at)) ||
                    !is_one_of(next, {"=", ";", ",", ")", "[", ":"}))
                    break;
                add(std::string(word(at)), {kind, has_elements || next == "["});
                at = after_value(text, at + 1);
            } while (word(at++) == ",");
        }
    }

    /// Where the value ends that a declared name may be given: at a comma, a semicolon or the bracket around all.
    static size_t after_value(const Words& text, size_t i) {
        constexpr size_t kLongest = 256;
        int depth = 0;
        for (const size_t most = i + kLongest; i < std::min(text.size(), most); ++i) {
            if (depth == 0 && is_one_of(text[i], {",", ";", ")", "}", ":"})) break;
            depth += deeper(text[i]);
        }
        return i;
    }

    void add(std::string name, Declared declared) {
        const auto [known, is_new] = of_.emplace(std::move(name), declared);
        if (!is_new && (known->second.kind != declared.kind || known->second.has_elements != declared.has_elements))
            known->second.kind = KindOfNumber::Unknown;
    }

    const Dialect& dialect_;
    std::map<std::string, Declared> of_;
};

/// A whole number of a statement, and what it is joined with.
struct JoinedNumber {
    std::string value, sign;
    bool is_marked;  ///< by `u`
    KindOfNumber other;
    bool is_index;
};

/// Reads the expressions of a statement for what their numbers are joined with. What it does not know it passes over.
class NumberReader {
public:
    NumberReader(const KindText& words, const KindsOfNames& names, const Dialect& dialect, Language language)
        : words_(words), names_(names), dialect_(dialect), language_(language) {
        while (at_ < words_.size()) {
            const size_t first = at_;
            const KindOfNumber left = joined(1);
            if (word(0) == "=" || is_update(word(0))) read_given(left, first == 0);
            if (at_ == first || at_ < words_.size()) ++at_;
        }
    }

    const std::vector<JoinedNumber>& numbers() const { return numbers_; }
    /// Of each call of `abs` or its like whether it cuts a real number off.
    const std::vector<bool>& cuts_off() const { return cuts_off_; }
    /// True if what is computed is kept as a whole number, whose bits are the same with a sign and without.
    bool keeps_whole() const { return kept_as_ == KindOfNumber::Signed || kept_as_ == KindOfNumber::Unsigned; }

private:
    static constexpr int kDeepest = 100;

    static bool is_update(std::string_view sign) {
        return sign.size() > 1 && sign.back() == '=' && !is_one_of(sign, {"==", "<=", ">=", "!="});
    }

    /// What a name is given behind the sign at hand. `is_bare`: the name begins the statement.
    void read_given(KindOfNumber left, bool is_bare) {
        const std::string sign(word(0));
        const std::string name(word_before());
        if (kept_as_ == KindOfNumber::Unknown) kept_as_ = is_bare ? left : names_.of(name, false);
        if (sign == "=") return;
        const size_t value = ++at_;
        joined(1);
        note(value, at_, sign.substr(0, sign.size() - 1), left);
    }

    std::string_view word(size_t ahead) const {
        return at_ + ahead < words_.size() ? std::string_view(words_[at_ + ahead]) : std::string_view();
    }
    std::string_view word_before() const { return at_ > 0 ? std::string_view(words_[at_ - 1]) : std::string_view(); }

    /// How tightly the operator at hand binds; 0 if none is there.
    int binds(size_t& size) const {
        const std::string_view here = word(0), next = word(1);
        size = 1;
        if ((here == "<" || here == ">") && next == here) {
            size = 2;
            return 8;
        }
        if ((here == "<" && next == "<=") || (here == ">" && next == ">=")) return 0;
        if (is_one_of(here, {"*", "/", "%"})) return 10;
        if (is_one_of(here, {"+", "-"})) return 9;
        if (is_one_of(here, {"<", ">", "<=", ">="})) return 7;
        if (is_one_of(here, {"==", "!="})) return 6;
        return here == "&" ? 5 : here == "^" ? 4 : here == "|" ? 3 : here == "&&" ? 2 : here == "||" ? 1 : 0;
    }

    KindOfNumber joined(int least) {
        if (++depth_ > kDeepest) {
            at_ = words_.size();
            return KindOfNumber::Unknown;
        }
        const size_t first = at_;
        KindOfNumber left = operand();
        size_t size = 1;
        for (int tight = binds(size); at_ > first && tight >= least && tight > 0; tight = binds(size)) {
            const size_t middle = at_;
            const std::string sign = size == 2 ? std::string(word(0)) + std::string(word(0)) : std::string(word(0));
            at_ += size;
            const size_t second = at_;
            const KindOfNumber right = joined(tight + 1);
            if (at_ == second) break;
            note(first, middle, sign, right);
            note(second, at_, sign, left);
            const bool is_truth = tight == 6 || tight == 7 || tight < 3;
            left = is_truth ? KindOfNumber::Unknown : tight == 8 ? left : kind_of_both(left, right);
        }
        --depth_;
        return left;
    }

    KindOfNumber operand() {
        if (++depth_ > kDeepest) at_ = words_.size();
        const KindOfNumber out = operand_at_hand();
        --depth_;
        return out;
    }

    KindOfNumber operand_at_hand() {
        const std::string_view here = word(0);
        if (is_one_of(here, {"-", "+", "~", "++", "--"})) {
            ++at_;
            return operand_behind(operand());
        }
        if (is_one_of(here, {"!", "*", "&"})) {
            ++at_;
            operand();
            return KindOfNumber::Unknown;
        }
        if (here == "(") return operand_behind(in_brackets(")"));
        if (is_number_token(here)) {
            ++at_;
            return kind_of_number(here);
        }
        return is_word_token(here) ? operand_behind(named()) : KindOfNumber::Unknown;
    }

    static KindOfNumber kind_of_number(std::string_view number) {
        const bool is_hexadecimal = number.starts_with("0x") || number.starts_with("0X");
        if (!is_hexadecimal && number.find_first_of(".eEfFhH") != std::string_view::npos) return KindOfNumber::Real;
        if (number.find_first_of("lL") != std::string_view::npos) return KindOfNumber::Unknown;
        return number.back() == 'u' || number.back() == 'U' ? KindOfNumber::Unsigned : KindOfNumber::Signed;
    }

    /// Members, elements and steps behind an operand.
    KindOfNumber operand_behind(KindOfNumber kind) {
        for (;;) {
            if (word(0) == "[") {
                ++indices_;
                in_brackets("]");
                --indices_;
            } else if (word(0) == "." || word(0) == "->") {
                const bool is_component = word(1).size() == 1 && word(1).find_first_of("xyzw") == 0;
                at_ += 2;
                if (!is_component) kind = KindOfNumber::Unknown;
                if (word(0) == "(") {
                    in_brackets(")");
                    kind = KindOfNumber::Unknown;
                }
            } else if (word(0) == "++" || word(0) == "--") {
                ++at_;
            } else {
                return kind;
            }
        }
    }

    KindOfNumber named() {
        while (word(0) == "std" && word(1) == "::") at_ += 2;
        const std::string name(word(0));
        if (!is_word_token(name)) return KindOfNumber::Unknown;
        ++at_;
        if (word(0) == "::") return KindOfNumber::Unknown;
        if (word(0) != "(") return names_.of(name, word(0) == "[");
        const bool is_type = is_type_word(name);
        if (!is_type && word_is(name, kControls | kLoopHead)) {
            in_brackets(")");
            return KindOfNumber::Unknown;
        }
        const size_t calls = cuts_off_.size();
        const KindOfNumber given = in_brackets(")");
        const std::string known = common_word(name, dialect_);
        if (is_type) return kind_of_type(name, dialect_);
        if (known == "abs" || known == "fabs") {
            const bool is_of_c = language_ == Language::C || language_ == Language::OpenCl;
            cuts_off_.insert(cuts_off_.begin() + static_cast<std::ptrdiff_t>(calls),
                             is_of_c && name == "abs" && given == KindOfNumber::Real);
            return known == "fabs" ? KindOfNumber::Real : given;
        }
        return is_one_of(known, {"min", "max", "clamp"}) ? given : KindOfNumber::Unknown;
    }

    /// What stands in brackets, of which the first is at hand; the kind of all values in it together.
    KindOfNumber in_brackets(std::string_view closing) {
        ++at_;
        KindOfNumber out = KindOfNumber::Unknown;
        bool is_first = true;
        while (at_ < words_.size() && word(0) != closing) {
            const size_t first = at_;
            const KindOfNumber kind = joined(1);
            out = is_first ? kind : kind_of_both(out, kind);
            is_first = false;
            if (word(0) == closing) break;
            if (word(0) != ",") out = KindOfNumber::Unknown;
            if (is_one_of(word(0), {"?", ":", "=", ";"}) || at_ == first || word(0) == ",")
                ++at_;
            else if (at_ < words_.size() && !is_word_token(word(0)) && !is_number_token(word(0)))
                ++at_;
        }
        if (at_ < words_.size()) ++at_;
        return out;
    }

    /// Takes in [first, end) if it is one whole number.
    void note(size_t first, size_t end, std::string sign, KindOfNumber other) {
        if (end != first + 1 || !is_number_token(words_[first])) return;
        const KindOfNumber kind = kind_of_number(words_[first]);
        if (kind == KindOfNumber::Real || kind == KindOfNumber::Unknown) return;
        numbers_.push_back(
            {number_value(words_[first]), std::move(sign), kind == KindOfNumber::Unsigned, other, indices_ > 0});
    }

    const KindText& words_;
    const KindsOfNames& names_;
    const Dialect& dialect_;
    Language language_;
    size_t at_ = 0;
    int depth_ = 0, indices_ = 0;
    KindOfNumber kept_as_ = KindOfNumber::Unknown;
    std::vector<JoinedNumber> numbers_;
    std::vector<bool> cuts_off_;
};

/// True if the mark of one of two numbers makes the operation one of numbers without a sign.
bool is_marked_otherwise(const JoinedNumber& here, const JoinedNumber& there, bool keeps_whole) {
    if (here.is_marked == there.is_marked || here.value != there.value || here.sign != there.sign) return false;
    if (here.other != KindOfNumber::Signed || there.other != KindOfNumber::Signed) return false;
    if (is_one_of(here.sign, {"+", "-", "*"})) return !keeps_whole && !here.is_index;
    return is_one_of(here.sign, {"/", "%", "<", ">", "<=", ">="});
}

StatementEdit edit_of_numbers(const Words& before, const Words& now, const Dialect& dialect) {
    return statement_edit(without_hints(before), without_hints(now), [&](const Words& statement, bool) {
        const Words words = with_one_word_types(statement);
        return with_functional_casts(with_c_casts({words.begin(), words.end()}, dialect), dialect);
    });
}

}  // namespace

std::string other_kinds_of_numbers(const PairTexts& texts, const Dialect& dialect, const BySide<Language>& languages) {
    constexpr size_t kMostGained = 64, kMostWords = 24'000;
    if (texts.source_now.size() + texts.target_now.size() > kMostWords) return {};
    const StatementEdit source = edit_of_numbers(texts.source_before, texts.source_now, dialect),
                        target = edit_of_numbers(texts.target_before, texts.target_now, dialect);
    if (source.gained.size() != target.gained.size() || source.gained.size() > kMostGained) return {};
    const KindsOfNames here(dialect, {&texts.source_now}), there(dialect, {&texts.target_now});
    for (size_t k = 0; k < source.gained.size(); ++k) {
        const Statement &one = source.now[source.gained[k]], &other = target.now[target.gained[k]];
        if (one.is_brace() || other.is_brace()) continue;
        const NumberReader a(one.common, here, dialect, languages.source),
            b(other.common, there, dialect, languages.target);
        const auto both = [&] { return quoted(one) + ", and the port " + quoted(other) + ", "; };
        if (a.numbers().size() == b.numbers().size())
            for (size_t i = 0; i < a.numbers().size(); ++i)
                if (is_marked_otherwise(a.numbers()[i], b.numbers()[i], a.keeps_whole() && b.keeps_whole()))
                    return "the source says " + both() + "one of numbers with a sign, the other of such without";
        if (a.cuts_off() != b.cuts_off() && a.cuts_off().size() == b.cuts_off().size())
            return "the source says " + both() + "of which one cuts real numbers off";
    }
    return {};
}

}  // namespace porttool
