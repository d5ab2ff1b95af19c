// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/casts.h"

#include <algorithm>
#include <array>

#include "porttool/language/words.h"

namespace porttool {
namespace {

using Text = std::vector<std::string>;

/// A name, a number, a bracket, or a local as NumberedText writes it: `%1`.
bool is_value(const std::string& word) {
    return is_word_token(word) || is_number_token(word) || word == "(" || (word.size() > 1 && word[0] == '%');
}

bool is_sign(const std::string& word) { return word == "-" || word == "!" || word == "~" || word == "+"; }

/// Where each opening bracket of a text is closed: the place after it, the end if nothing closes it.
std::vector<size_t> closings(const Text& words) {
    std::vector<size_t> after(words.size(), words.size()), open;
    for (size_t i = 0; i < words.size(); ++i) {
        if (words[i] == "(" || words[i] == "[") open.push_back(i);
        if (open.empty() || (words[i] != ")" && words[i] != "]")) continue;
        after[open.back()] = i + 1;
        open.pop_back();
    }
    return after;
}

/// Writes C casts as functional ones. One pass: casts in casts and in brackets are kept on a stack, and where a chain
/// of casts ends is found once for all of it.
class CastWriter {
public:
    CastWriter(const Text& words, const Dialect& dialect)
        : words_(words), dialect_(dialect), after_(closings(words)), operand_ends_(words.size(), 0) {}

    Text run() {
        operands_.push_back({0, words_.size(), words_.size()});
        for (size_t i = 0; i < words_.size() || operands_.size() > 1;) {
            if (operands_.size() > 1 && i >= operands_.back().end) {
                out_.emplace_back(")");
                i = std::max(i, operands_.back().after);
                operands_.pop_back();
                continue;
            }
            i = step(i);
        }
        return std::move(out_);
    }

private:
    /// What a cast that is being written applies to; `after` is where the text goes on, past its brackets.
    struct Operand {
        size_t first, end, after;
    };

    size_t step(size_t i) {
        const bool named = words_[i] == "staticcast" && i + 4 < end() && words_[i + 1] == "<" && words_[i + 3] == ">" &&
                           dialect_.is_number_type(words_[i + 2]);
        if (named) {
            out_.push_back(words_[i + 2]);
            return i + 4;
        }
        if (!is_cast(i)) {
            out_.push_back(words_[i]);
            return i + 1;
        }
        out_.push_back(words_[i + 1]);
        out_.emplace_back("(");
        const size_t first = i + 3, last = std::min(after_operand(first), end());
        const bool bracketed = words_[first] == "(" && std::min(after_[first], end()) == last && first + 1 < last &&
                               !is_cast(first, first, last);
        operands_.push_back(bracketed ? Operand{first + 1, last - 1, last} : Operand{first, last, last});
        return operands_.back().first;
    }

    size_t end() const { return operands_.back().end; }

    /// True if a cast `(type) operand` stands at `i`, not a call's argument list or a size.
    bool is_cast(size_t i) const { return is_cast(i, operands_.back().first, end()); }
    bool is_cast(size_t i, size_t first, size_t end) const {
        if (i + 3 >= end || words_[i] != "(" || words_[i + 2] != ")") return false;
        if (!dialect_.is_number_type(words_[i + 1])) return false;
        if (i > first && words_[i - 1] != "return" &&
            (is_word_token(words_[i - 1]) || words_[i - 1] == ")" || words_[i - 1] == "]"))
            return false;
        return is_value(words_[i + 3]) || is_sign(words_[i + 3]);
    }

    /// Behind what a cast applies to that stands before `i`: signs, further casts, a value and its members, indices and
    /// arguments.
    size_t after_operand(size_t i) {
        const size_t first = i;
        if (i < words_.size() && operand_ends_[i] > 0) return operand_ends_[i];
        for (;;) {
            while (i < words_.size() && is_sign(words_[i])) ++i;
            const bool cast = i + 3 < words_.size() && words_[i] == "(" && words_[i + 2] == ")" &&
                              dialect_.is_number_type(words_[i + 1]);
            if (!cast) break;
            i += 3;
            if (i < words_.size() && operand_ends_[i] > 0) return remember(first, i, operand_ends_[i]);
        }
        const size_t last = i;
        if (i < words_.size()) i = words_[i] == "(" ? after_[i] : i + 1;
        while (i < words_.size()) {
            if (words_[i] == "(" || words_[i] == "[")
                i = after_[i];
            else if (words_[i] == "." && i + 1 < words_.size())
                i += 2;
            else
                break;
        }
        return remember(first, last, i);
    }

    /// All operands of one chain of casts end alike.
    size_t remember(size_t first, size_t last, size_t end) {
        for (size_t i = first; i <= last && i < words_.size(); ++i)
            if (i == first || words_[i - 1] == ")") operand_ends_[i] = end;
        return end;
    }

    const Text& words_;
    const Dialect& dialect_;
    std::vector<size_t> after_;         ///< of each opening bracket, after the one that closes it
    std::vector<size_t> operand_ends_;  ///< where the operand that begins at a word ends, once it is known
    std::vector<Operand> operands_;
    Text out_;
};

/// Writes named casts as C casts, and takes parentheses away around an operand that needs none.
class CCastWriter {
public:
    CCastWriter(const Text& words, const Dialect& dialect)
        : words_(words), dialect_(dialect), after_(closings(words)), dropped_(words.size(), false) {}

    Text run() {
        for (size_t i = 0; i < words_.size();) i = step(i);
        return std::move(out_);
    }

private:
    std::string_view word(size_t i) const { return i < words_.size() ? words_[i] : std::string_view(); }

    size_t step(size_t i) {
        if (dropped_[i]) return i + 1;
        const bool is_static = words_[i] == "static_cast";
        if ((is_static || words_[i] == "reinterpret_cast") && word(i + 1) == "<") {
            const size_t type_end = after_type(i + 2);
            if (word(type_end) == ">" && word(type_end + 1) == "(") return write_cast(i, type_end, is_static);
        }
        if (words_[i] == "(" && can_cast_after(i) && word(after_[i]) == "(" && after_type(i + 1) + 1 == after_[i])
            open_operand(after_[i]);
        out_.push_back(words_[i]);
        return i + 1;
    }

    size_t write_cast(size_t i, size_t type_end, bool is_static) {
        const size_t open = type_end + 1;
        const bool is_number = type_end == i + 3 && dialect_.is_number_type(words_[i + 2]);
        const bool to_numbers = words_[type_end - 1] == "*" && dialect_.is_number_type(words_[i + 2]);
        if (is_static && is_number) {
            out_.emplace_back("staticcast");
            return i + 1;
        }
        if (has_postfix(after_[open]) || !(is_static || to_numbers)) {
            out_.push_back(words_[i]);
            return i + 1;
        }
        out_.emplace_back("(");
        for (size_t k = i + 2; k < type_end; ++k) out_.push_back(words_[k]);
        out_.emplace_back(")");
        open_operand(open);
        return open;
    }

    bool has_postfix(size_t i) const { return word(i) == "(" || word(i) == "[" || word(i) == "." || word(i) == "->"; }

    bool can_cast_after(size_t i) const {
        const std::string_view before = i > 0 ? word(i - 1) : "=";
        if (before == "return" || before == "else" || before == "case") return true;
        return !is_word_token(before) && before != ")" && before != "]" && before != ">";
    }

    /// Behind the words of a type that begins at `i`.
    size_t after_type(size_t i) const {
        const size_t first = i;
        while (i < words_.size() && i < first + 8 && is_word_token(words_[i])) i += word(i + 1) == "::" ? 2 : 1;
        while (i > first && word(i) == "*") ++i;
        return i;
    }

    /// The parentheses at `open` go if they hold a name, a number, or members, elements and calls of one.
    void open_operand(size_t open) {
        const size_t close = after_[open] - 1;
        if (close >= words_.size() || words_[close] != ")") return;
        size_t i = open + 1;
        if (!is_word_token(word(i)) && !is_number_token(word(i))) return;
        for (++i; i < close;) {
            if (words_[i] == "(" || words_[i] == "[")
                i = after_[i];
            else if ((words_[i] == "." || words_[i] == "->" || words_[i] == "::") && is_word_token(word(i + 1)))
                i += 2;
            else
                return;
        }
        if (i == close) dropped_[open] = dropped_[close] = true;
    }

    const Text& words_;
    const Dialect& dialect_;
    std::vector<size_t> after_;
    std::vector<bool> dropped_;
    Text out_;
};

}  // namespace

Words with_one_word_types(const Words& tokens) {
    constexpr std::array<std::array<std::string_view, 2>, 4> kSized = {
        {{"int8", "uint8"}, {"int16", "uint16"}, {"int32", "uint32"}, {"int64", "uint64"}}};
    Words out;
    for (size_t i = 0; i < tokens.size();) {
        size_t end = i, longs = 0;
        bool is_unsigned = false, is_signed = false, is_short = false, is_char = false;
        for (; end < tokens.size(); ++end) {
            const std::string_view token = tokens[end];
            is_unsigned |= token == "unsigned";
            is_signed |= token == "signed";
            is_short |= token == "short";
            is_char |= token == "char";
            longs += token == "long" ? 1 : 0;
            if (token == "__int64") longs += 2;
            if (!word_is(token, kTypePart) && token != "__int64") break;
        }
        const bool is_double = end < tokens.size() && tokens[end] == "double";
        if (end == i + 1 && end < tokens.size() && (is_unsigned || is_signed)) {  // ISPC's `unsigned int8`
            const std::string_view sized = tokens[end];
            const auto known = std::find_if(kSized.begin(), kSized.end(), [&](auto& row) { return row[0] == sized; });
            if (known != kSized.end()) {
                out.push_back((*known)[is_unsigned ? 1 : 0]);
                i = end + 1;
                continue;
            }
        }
        if (end == i) end = i + 1;
        if (end == i + 1 && !is_unsigned && !is_signed && longs < 2) {
            out.push_back(tokens[i++]);
            continue;
        }
        if (is_double) {
            for (; i < end; ++i) out.push_back(tokens[i]);
            continue;
        }
        if (is_char)
            out.emplace_back(is_unsigned ? "uint8_t" : "int8_t");
        else if (is_short)
            out.emplace_back(is_unsigned ? "uint16_t" : "short");
        else if (longs > 0)
            out.emplace_back(is_unsigned ? (longs > 1 ? "uint64_t" : "ulong") : longs > 1 ? "int64_t" : "long");
        else
            out.emplace_back(is_unsigned ? "uint" : "int");
        i = end;
    }
    return out;
}

Text with_c_casts(const Text& words, const Dialect& dialect) {
    if (std::find(words.begin(), words.end(), ")") == words.end()) return words;
    return CCastWriter(words, dialect).run();
}

Text with_functional_casts(const Text& words, const Dialect& dialect) {
    if (std::find(words.begin(), words.end(), ")") == words.end()) return words;
    return CastWriter(words, dialect).run();
}

}  // namespace porttool
