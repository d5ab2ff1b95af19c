// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/casts.h"

#include <algorithm>

namespace porttool {
namespace {

using Words = std::vector<std::string>;

bool is_letter(char c) { return c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

bool is_name(const std::string& word) { return !word.empty() && is_letter(word[0]); }

bool is_value(const std::string& word) {
    return is_name(word) || (!word.empty() && word[0] >= '0' && word[0] <= '9') || word == "(";
}

/// Behind the bracket that closes the one at `i`.
size_t behind_group(const Words& words, size_t i) {
    int depth = 0;
    for (; i < words.size(); ++i) {
        if (words[i] == "(" || words[i] == "[") ++depth;
        if ((words[i] == ")" || words[i] == "]") && --depth == 0) return i + 1;
    }
    return i;
}

/// Behind what a cast at `i` applies to: signs, further casts, a value and its members, indices and arguments.
size_t behind_operand(const Words& words, size_t i, const Dialect& dialect) {
    while (i < words.size() && (words[i] == "-" || words[i] == "!" || words[i] == "~" || words[i] == "+")) ++i;
    if (i >= words.size()) return i;
    if (words[i] == "(") {
        const bool cast = i + 3 < words.size() && words[i + 2] == ")" && dialect.is_number_type(words[i + 1]);
        if (cast) return behind_operand(words, i + 3, dialect);
        i = behind_group(words, i);
    } else {
        ++i;
    }
    while (i < words.size()) {
        if (words[i] == "(" || words[i] == "[")
            i = behind_group(words, i);
        else if (words[i] == "." && i + 1 < words.size())
            i += 2;
        else
            break;
    }
    return i;
}

/// True if a cast `(type) operand` stands at `i`, not a call's argument list or a size.
bool is_cast(const Words& words, size_t i, const Dialect& dialect) {
    if (i + 3 >= words.size() || words[i] != "(" || words[i + 2] != ")") return false;
    if (!dialect.is_number_type(words[i + 1])) return false;
    if (i > 0 && words[i - 1] != "return" && (is_name(words[i - 1]) || words[i - 1] == ")" || words[i - 1] == "]"))
        return false;
    const std::string& next = words[i + 3];
    return is_value(next) || next == "-" || next == "!" || next == "~" || next == "+";
}

Words slice(const Words& words, size_t first, size_t last) {
    return {words.begin() + static_cast<std::ptrdiff_t>(first), words.begin() + static_cast<std::ptrdiff_t>(last)};
}

}  // namespace

Words with_one_word_types(const Words& tokens) {
    Words out;
    for (size_t i = 0; i < tokens.size();) {
        size_t end = i, longs = 0;
        bool is_unsigned = false, is_signed = false, is_short = false, is_char = false;
        for (; end < tokens.size(); ++end) {
            const std::string& token = tokens[end];
            is_unsigned |= token == "unsigned";
            is_signed |= token == "signed";
            is_short |= token == "short";
            is_char |= token == "char";
            longs += token == "long" ? 1 : 0;
            if (token != "unsigned" && token != "signed" && token != "short" && token != "char" && token != "long" &&
                token != "int")
                break;
        }
        const bool is_double = end < tokens.size() && tokens[end] == "double";
        if (end == i || is_double || (end == i + 1 && !is_unsigned && !is_signed)) {
            out.push_back(tokens[i++]);
            continue;
        }
        if (is_char)
            out.emplace_back(is_unsigned ? "uint8" : "int8");
        else if (is_short)
            out.emplace_back(is_unsigned ? "uint16" : "short");
        else if (longs > 0)
            out.emplace_back(is_unsigned ? "uint64" : longs > 1 ? "int64" : "long");
        else
            out.emplace_back(is_unsigned ? "uint" : "int");
        i = end;
    }
    return out;
}

Words with_functional_casts(const Words& words, const Dialect& dialect) {
    Words out;
    for (size_t i = 0; i < words.size();) {
        const bool named = words[i] == "staticcast" && i + 4 < words.size() && words[i + 1] == "<" &&
                           words[i + 3] == ">" && dialect.is_number_type(words[i + 2]);
        if (named) {
            out.push_back(words[i + 2]);
            i += 4;
            continue;
        }
        if (!is_cast(words, i, dialect)) {
            out.push_back(words[i++]);
            continue;
        }
        const size_t first = i + 3, end = behind_operand(words, first, dialect);
        const bool bracketed = words[first] == "(" && behind_group(words, first) == end && first + 1 < end &&
                               !is_cast(words, first, dialect);
        Words operand = bracketed ? slice(words, first + 1, end - 1) : slice(words, first, end);
        operand = with_functional_casts(operand, dialect);
        out.push_back(words[i + 1]);
        out.emplace_back("(");
        out.insert(out.end(), operand.begin(), operand.end());
        out.emplace_back(")");
        i = end;
    }
    return out;
}

}  // namespace porttool
