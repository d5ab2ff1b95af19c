// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/plain_choices.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "porttool/compare/brackets.h"
#include "porttool/compare/declared_parts.h"
#include "porttool/compare/plain_comparison.h"
#include "porttool/language/words.h"
#include "porttool/normal/normal_form.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

using ChoiceText = std::vector<std::string>;

void append(ChoiceText& to, const ChoiceText& more) { to.insert(to.end(), more.begin(), more.end()); }

class ChoiceWriter {
public:
    ChoiceWriter(const Words& text, Language language)
        : text_(text),
          declared_(text),
          language_(language),
          is_shading_(traits_of(language).literals == Literals::Shading) {
        find_closing();
    }

    ChoiceText run() { return is_closed_ ? statements(0, text_.size()) : ChoiceText(text_.begin(), text_.end()); }

private:
    std::string_view word(size_t i) const { return i < text_.size() ? text_[i] : std::string_view(); }

    void find_closing() {
        closing_.assign(text_.size(), 0);
        std::vector<size_t> open;
        for (size_t i = 0; i < text_.size() && is_closed_; ++i) {
            const int step = deeper(text_[i]);
            if (step > 0) open.push_back(i);
            if (step >= 0) continue;
            is_closed_ = !open.empty();
            if (open.empty()) break;
            closing_[open.back()] = i;
            open.pop_back();
        }
        is_closed_ = is_closed_ && open.empty();
    }

    ChoiceText as_written(size_t first, size_t end) const {
        return {text_.begin() + static_cast<std::ptrdiff_t>(first), text_.begin() + static_cast<std::ptrdiff_t>(end)};
    }

    /// The first of these words at the level of `first`, or `end`.
    size_t find_at_level(size_t first, size_t end, std::initializer_list<std::string_view> words) const {
        for (size_t i = first; i < end; ++i) {
            if (is_one_of(text_[i], words)) return i;
            if (deeper(text_[i]) > 0) i = closing_[i];
        }
        return end;
    }

    ChoiceText statements(size_t first, size_t end) {
        ChoiceText out;
        while (first < end) {
            if (text_[first] == "if" && word(first + 1) == "(" && word(closing_[first + 1] + 1) == "{") {
                first = choose_statements(first, out);
            } else if (text_[first] == "{") {
                out.emplace_back("{");
                append(out, statements(first + 1, closing_[first]));
                out.emplace_back("}");
                first = closing_[first] + 1;
            } else {
                const size_t stop = find_at_level(first, end, {";", "{"});
                append(out, statement(first, stop));
                if (stop < end && text_[stop] == ";") out.emplace_back(";");
                first = stop + (stop < end && text_[stop] == ";" ? 1 : 0);
            }
        }
        return out;
    }

    /// `if ( c ) { A } else { B }` at `first`; gives the place behind it.
    size_t choose_statements(size_t first, ChoiceText& out) {
        const size_t open = first + 1, block = closing_[open] + 1, behind = closing_[block] + 1;
        const bool has_other = word(behind) == "else" && word(behind + 1) == "{";
        const std::optional<PlainComparison> asked = comparison(open + 1, closing_[open], has_other);
        ChoiceText then = statements(block + 1, closing_[block]);
        ChoiceText otherwise = has_other ? statements(behind + 2, closing_[behind + 1]) : ChoiceText();
        const size_t next = has_other ? closing_[behind + 1] + 1 : behind;
        if (asked && asked->is_opposite) std::swap(then, otherwise);
        if (asked && write_as_value(*asked, then, otherwise, has_other, out)) return next;
        out.insert(out.end(), {"if", "("});
        append(out, asked ? asked->written() : expressions(open + 1, closing_[open]));
        out.insert(out.end(), {")", "{"});
        append(out, then);
        out.emplace_back("}");
        if (has_other) {
            out.insert(out.end(), {"else", "{"});
            append(out, otherwise);
            out.emplace_back("}");
        }
        return next;
    }

    /// The place and the value of `x = a ;`; nothing of other statements.
    static std::optional<std::pair<ChoiceText, ChoiceText>> assigned(const ChoiceText& block) {
        const auto sign = std::find(block.begin(), block.end(), "=");
        const bool is_one = sign != block.end() && std::count(block.begin(), block.end(), ";") == 1 &&
                            block.back() == ";" && std::find(block.begin(), block.end(), "{") == block.end();
        if (!is_one || sign == block.begin()) return std::nullopt;
        const bool is_declared = std::adjacent_find(block.begin(), sign, [](const auto& a, const auto& b) {
                                     return is_word_token(a) && is_word_token(b);
                                 }) != sign;
        if (is_declared) return std::nullopt;
        return std::pair(ChoiceText(block.begin(), sign), ChoiceText(sign + 1, block.end() - 1));
    }

    bool write_as_value(const PlainComparison& asked, const ChoiceText& then, const ChoiceText& otherwise,
                        bool has_other, ChoiceText& out) {
        const auto yes = assigned(then), no = assigned(otherwise);
        if (!yes || (has_other && (!no || no->first != yes->first))) return false;
        const ChoiceText value = choice(asked, yes->second, has_other ? no->second : yes->first);
        if (!has_other && value.front() == "(") return false;  // no limit
        append(out, yes->first);
        out.emplace_back("=");
        append(out, value);
        out.emplace_back(";");
        return true;
    }

    /// A statement without its semicolon, or the head of a block.
    ChoiceText statement(size_t first, size_t end) {
        const size_t sign = find_at_level(
            first, end, {"=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>=", "return", "#"});
        if (sign < end && text_[sign] == "#") return as_written(first, end);
        if (sign == end) return expressions(first, end);
        ChoiceText out = as_written(first, sign + 1);
        append(out, expressions(sign + 1, end));
        return out;
    }

    /// What commas and semicolons set apart.
    ChoiceText expressions(size_t first, size_t end) {
        ChoiceText out;
        while (first < end) {
            const size_t stop = find_at_level(first, end, {",", ";"});
            append(out, expression(first, stop));
            if (stop < end) out.emplace_back(text_[stop]);
            first = stop + 1;
        }
        return out;
    }

    ChoiceText expression(size_t first, size_t end) {
        if (++depth_ > kDeepest) {
            --depth_;
            return as_written(first, end);
        }
        ChoiceText out;
        const size_t mark = find_at_level(first, end, {"?"});
        const size_t colon = mark < end ? find_at_level(mark + 1, end, {":", "?"}) : end;
        const std::optional<PlainComparison> asked =
            colon < end && text_[colon] == ":" ? comparison(first, mark, true) : std::nullopt;
        if (asked) {
            ChoiceText yes = expression(mark + 1, colon), no = expression(colon + 1, end);
            if (asked->is_opposite) std::swap(yes, no);
            out = choice(*asked, yes, no);
        } else if (mark == end) {
            out = mixed(first, end);
            if (out.empty()) out = dot_of_parts(first, end);
        }
        if (out.empty()) out = operations(first, end);
        --depth_;
        return out;
    }

    ChoiceText operations(size_t first, size_t end) {
        ChoiceText out;
        for (size_t i = first; i < end;) {
            if (deeper(text_[i]) > 0) {
                i = bracketed(i, out);
                continue;
            }
            const size_t name = text_[i] == "std" && word(i + 1) == "::" ? i + 2 : i;
            const bool is_call = name < end && is_word_token(word(name)) && word(name + 1) == "(" &&
                                 (i == first || !is_one_of(text_[i - 1], {".", "->", "::"}));
            if (!is_call) {
                out.emplace_back(text_[i++]);
                continue;
            }
            i = call(i, name, out);
        }
        return out;
    }

    /// Brackets that hold a choice alone are its own.
    size_t bracketed(size_t i, ChoiceText& out) {
        const size_t end = closing_[i];
        if (text_[i] == "{") {
            append(out, as_written(i, end + 1));
            return end + 1;
        }
        ChoiceText inner = expressions(i + 1, end);
        const bool is_choice = text_[i] == "(" && inner.size() > 2 && inner.front() == "(" && is_one_bracket(inner) &&
                               (i == 0 || !is_word_token(text_[i - 1]));
        if (!is_choice) out.emplace_back(text_[i]);
        append(out, inner);
        if (!is_choice) out.emplace_back(text_[end]);
        return end + 1;
    }

    static bool is_one_bracket(const ChoiceText& words) {
        int depth = 0;
        for (size_t i = 0; i < words.size(); ++i) {
            depth += deeper(words[i]);
            if (depth == 0) return i + 1 == words.size();
        }
        return false;
    }

    /// A call, of a built-in perhaps that is written otherwise; gives the place behind it. What it is given is looked
    /// at once, since it may hold calls in turn.
    size_t call(size_t first, size_t name, ChoiceText& out) {
        const size_t end = closing_[name + 1];
        std::vector<ChoiceText> given;
        for (size_t at = name + 2; at < end;) {
            const size_t stop = find_at_level(at, end, {",", ";"});
            given.push_back(expression(at, stop));
            if (stop < end && text_[stop] == ";") given.back().emplace_back(";");
            at = stop + 1;
        }
        const ChoiceText said = built_in(text_[name], given, name);
        if (said.empty()) {
            append(out, as_written(first, name));
            append(out, call_of(text_[name], given));
        } else {
            append(out, said);
        }
        return end + 1;
    }

    ChoiceText built_in(std::string_view name, const std::vector<ChoiceText>& given, size_t at) const {
        const bool is_max = is_one_of(name, {"max", "fmax", "fmaxf"}),
                   is_min = is_one_of(name, {"min", "fmin", "fminf"});
        if ((is_max || is_min) && given.size() == 2) return limited(is_max ? "max" : "min", given[0], given[1]);
        const bool saturates = name == "saturate" && given.size() == 1;
        if (saturates || (name == "clamp" && given.size() == 3))
            return limited("min", limited("max", given[0], saturates ? ChoiceText{number('0')} : given[1]),
                           saturates ? ChoiceText{number('1')} : given[2]);
        if (name == "step" && given.size() == 2)
            return choice({given[1], given[0], "<", false}, {number('0')}, {number('1')});
        if (is_one_of(name, {"mix", "lerp"}) && given.size() == 3) return mix_of(given[0], given[1], given[2]);
        if (name == "dot" && given.size() == 2) return dot_of(given[0], given[1]);
        if (is_one_of(name, {"sqrt", "sqrtf"}) && given.size() == 1) return length_of(given[0]);
        const bool is_abs =
            (is_one_of(name, {"fabs", "fabsf"}) || (name == "abs" && takes_real(at))) && given.size() == 1;
        if (is_abs && is_real(at + 2, closing_[at + 1])) return call_of("fabs", {given[0]});
        return {};
    }

    static ChoiceText call_of(std::string_view name, const std::vector<ChoiceText>& given) {
        ChoiceText out = {std::string(name), "("};
        for (size_t i = 0; i < given.size(); ++i) {
            if (i > 0 && out.back() != ";") out.emplace_back(",");
            append(out, given[i]);
        }
        out.emplace_back(")");
        return out;
    }

    static ChoiceText limited(const char* name, const ChoiceText& a, const ChoiceText& b) {
        return a < b ? call_of(name, {a, b}) : call_of(name, {b, a});
    }

    static ChoiceText mix_of(const ChoiceText& a, const ChoiceText& b, const ChoiceText& t) {
        return call_of("mix", {a, b, t});
    }

    static ChoiceText dot_of(const ChoiceText& a, const ChoiceText& b) {
        return a < b ? call_of("dot", {a, b}) : call_of("dot", {b, a});
    }

    /// `length ( p )` of what stands in `sqrt ( dot ( p , p ) )`.
    static ChoiceText length_of(const ChoiceText& squared) {
        const size_t comma = squared.size() / 2;
        if (squared.size() < 6 || squared.size() % 2 != 0 || squared[0] != "dot" || squared[comma] != ",") return {};
        const auto middle = squared.begin() + static_cast<std::ptrdiff_t>(comma);
        const ChoiceText a(squared.begin() + 2, middle), b(middle + 1, squared.end() - 1);
        return a == b ? call_of("length", {a}) : ChoiceText();
    }

    std::string number(char digit) const { return digit + std::string(is_shading_ ? ".0" : "f"); }

    /// Of `abs`: C and what came of it have one of whole numbers alone.
    bool takes_real(size_t name) const {
        const bool of_std = name >= 2 && text_[name - 1] == "::" && text_[name - 2] == "std";
        const bool of_c = language_ == Language::C || language_ == Language::OpenCl || language_ == Language::Cpp ||
                          language_ == Language::Sycl;
        return of_std || !of_c;
    }

    /// True if nothing but declared real numbers, and numbers, is joined there.
    bool is_real(size_t first, size_t end) const {
        bool any = false;
        for (size_t i = first; i < end; ++i) {
            const bool is_sign = is_one_of(text_[i], {"+", "-", "*", "/", "(", ")"});
            if (is_word_token(text_[i])) any = true;
            if (!is_sign && !is_number_token(text_[i]) && !declared_.reals.contains(text_[i])) return false;
        }
        return any;
    }

    /// A value chosen by a comparison that is no opposite.
    static ChoiceText choice(const PlainComparison& asked, const ChoiceText& yes, const ChoiceText& no) {
        if (asked.sign != "==") {
            if (asked.left == no && asked.right == yes) return limited("max", no, yes);
            if (asked.left == yes && asked.right == no) return limited("min", yes, no);
        }
        ChoiceText out = {"("};
        append(out, asked.written());
        out.emplace_back("?");
        append(out, yes);
        out.emplace_back(":");
        append(out, no);
        out.emplace_back(")");
        return out;
    }

    /// The condition in [first, end), if it compares two values. With `has_both` what it decides on can be exchanged.
    std::optional<PlainComparison> comparison(size_t first, size_t end, bool has_both) {
        bool is_opposite = false;
        for (;;) {
            const bool is_not =
                first + 1 < end && text_[first] == "!" && text_[first + 1] == "(" && closing_[first + 1] + 1 == end;
            const bool is_bracket = first < end && text_[first] == "(" && closing_[first] + 1 == end;
            if (!is_not && !is_bracket) break;
            is_opposite = is_opposite != is_not;
            first += is_not ? 2 : 1;
            --end;
        }
        const size_t sign = find_at_level(first, end, {"<", ">", "<=", ">=", "==", "!="});
        const auto joins = {"<", ">", "<=", ">=", "==", "!=", "&&", "||", "?",
                            ":", "=", "&",  "|",  "^",  ",",  ";",  "<<", ">>"};
        for (size_t i = first; i < end; ++i) {
            if (i != sign && std::find(joins.begin(), joins.end(), text_[i]) != joins.end()) return std::nullopt;
            if (deeper(text_[i]) > 0) i = closing_[i];
        }
        if (sign == end || sign == first || sign + 1 == end) return std::nullopt;
        PlainComparison out{expression(first, sign), expression(sign + 1, end), std::string(text_[sign]), false};
        out.write_plain(is_opposite, has_both);
        return out;
    }

    /// Behind a name with its members and elements, a call, a number or brackets; `first` where none begins there.
    size_t behind_operand(size_t first, size_t end) const {
        size_t i = first;
        if (i < end && text_[i] == "(") return closing_[i] + 1;
        if (i >= end || (!is_word_token(text_[i]) && !is_number_token(text_[i]))) return first;
        for (++i; i < end;) {
            if (text_[i] == "(" || text_[i] == "[")
                i = closing_[i] + 1;
            else if (is_one_of(text_[i], {".", "->", "::"}) && i + 1 < end && is_word_token(text_[i + 1]))
                i += 2;
            else
                break;
        }
        return i;
    }

    ChoiceText operand(size_t first, size_t end) {
        if (text_[first] == "(" && closing_[first] + 1 == end) {
            ++first;
            --end;
        }
        return expression(first, end);
    }

    bool is_one(size_t i) const { return is_number_token(word(i)) && number_value(text_[i]) == "1"; }

    /// `a + ( b - a ) * t` and `a * ( 1 - t ) + b * t`; "" for anything else.
    ChoiceText mixed(size_t first, size_t end) {
        const size_t a = behind_operand(first, end);
        if (a == first || a >= end || word(a + 1) != "(") {
            if (a == first || a >= end || text_[a] != "*" || word(a + 1) != "(") return {};
        }
        const size_t open = a + 1;
        if (open >= end || text_[open] != "(") return {};
        const size_t close = closing_[open], b = behind_operand(open + 1, close);
        if (close >= end || b == open + 1 || b >= close || text_[b] != "-") return {};
        const size_t c = behind_operand(b + 1, close);
        if (c != close) return {};
        if (text_[a] == "+") {
            const size_t t = close + 2 <= end && word(close + 1) == "*" ? behind_operand(close + 2, end) : end + 1;
            if (t != end || !is_said_twice(first, a, b + 1, c)) return {};
            return mix_of(operand(first, a), operand(open + 1, b), operand(close + 2, t));
        }
        if (text_[a] != "*" || !is_one(open + 1) || b != open + 2 || word(close + 1) != "+") return {};
        const size_t d = behind_operand(close + 2, end);
        if (d == close + 2 || d >= end || text_[d] != "*") return {};
        const size_t t = behind_operand(d + 1, end);
        if (t != end || !is_said_twice(b + 1, c, d + 1, t)) return {};
        return mix_of(operand(first, a), operand(close + 2, d), operand(b + 1, c));
    }

    bool is_said_twice(size_t first, size_t end, size_t again, size_t end_again) const {
        return as_written(first, end) == as_written(again, end_again);
    }

    /// `p . x * q . x + p . y * q . y + p . z * q . z` of two vectors of three parts; "" for anything else.
    ChoiceText dot_of_parts(size_t first, size_t end) const {
        constexpr std::array<std::string_view, 4> kParts = {"x", "y", "z", "w"};
        constexpr size_t kTerm = 7, kStep = 8;  // words
        const size_t count = (end - first + 1) / kStep;
        if (count < 2 || count > kParts.size() || end - first != count * kStep - 1) return {};
        std::string_view p, q;
        for (size_t k = 0; k < count; ++k) {
            const size_t at = first + k * kStep;
            const bool is_term = text_[at + 1] == "." && text_[at + 2] == kParts[k] && text_[at + 3] == "*" &&
                                 text_[at + 5] == "." && text_[at + 6] == kParts[k] &&
                                 (k + 1 == count || text_[at + kTerm] == "+");
            if (!is_term) return {};
            const bool is_turned = k > 0 && text_[at] != p;
            const std::string_view one = text_[at + (is_turned ? 4 : 0)], other = text_[at + (is_turned ? 0 : 4)];
            if (k > 0 && (one != p || other != q)) return {};
            p = one;
            q = other;
        }
        const auto has_parts = [&](std::string_view name) {
            const auto known = declared_.vectors.find(name);
            return known != declared_.vectors.end() && known->second == count;
        };
        if (!has_parts(p) || !has_parts(q)) return {};
        return dot_of({std::string(p)}, {std::string(q)});
    }

    static constexpr int kDeepest = 24;

    const Words& text_;
    DeclaredParts declared_;
    Language language_;
    bool is_shading_, is_closed_ = true;
    std::vector<size_t> closing_;  ///< of each bracket that opens
    int depth_ = 0;
};

}  // namespace

std::vector<std::string> with_plain_choices(const Words& text, Language language) {
    constexpr size_t kMost = 6'000;  // words
    if (text.size() > kMost) return {text.begin(), text.end()};
    return ChoiceWriter(text, language).run();
}

}  // namespace porttool
