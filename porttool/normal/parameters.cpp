// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/normal/parameters.h"

#include <algorithm>

#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"

namespace porttool {
namespace {

class ParameterReader {
public:
    ParameterReader(const BracketedTokens& tokens, size_t end, Declared& out)
        : tokens_(tokens), end_(end), out_(out), last_(end), type_(end) {}

    void run(size_t first) {
        for (size_t i = first; i < end_; ++i) {
            const std::string_view text = tokens_.word(i);
            if (text == ",")
                finish();
            else if (is_one_of(text, {"=", "[", ":"}))
                i = end_of_declarator(i);
            else if (is_one_of(text, {"(", "{"}))
                i = group(i);
            else if (text == "<" && !closed_)
                i = arguments(i);
            else if (text == "::" && !closed_)
                i = scoped_type(i);
            else if (tokens_.is_name(i) && !closed_)
                word(i);
        }
        finish();
    }

private:
    size_t before(size_t i) const { return std::min(i, end_) - 1; }

    void finish() {
        if (last_ < end_ && typed_) {
            out_.add(tokens_, last_);
            if (type_ < end_) out_.types.number(tokens_.word(type_));
        }
        typed_ = closed_ = false;
        last_ = type_ = end_;
    }

    size_t end_of_declarator(size_t i) {
        const bool bracket = tokens_.word(i) == "[", attribute = bracket && tokens_.word(i + 1) == "[";
        if (!attribute || last_ < end_ || typed_) closed_ = true;
        return bracket ? before(tokens_.after_group(i)) : i;
    }

    size_t group(size_t i) {
        const auto word = [&](size_t ahead) { return tokens_.word(i + ahead); };
        const bool function_pointer = word(0) == "(" && !closed_ && is_one_of(word(1), {"*", "&", "^"}) &&
                                      word(3) == ")" && word(4) == "(" && tokens_.may_be_declared(i + 2);
        if (function_pointer) {
            typed_ = typed_ || last_ < end_;
            last_ = i + 2;
            closed_ = true;
        } else if (!closed_) {
            if (last_ < end_ && word_is(tokens_.word(last_), kTypeOfValue)) typed_ = true;
            last_ = end_;
        }
        return before(tokens_.after_group(i));
    }

    size_t arguments(size_t i) const {
        const size_t after = tokens_.after_arguments(i);
        return after > i ? before(after) : i;
    }

    /// `A::B` is a type.
    size_t scoped_type(size_t i) {
        last_ = end_;
        typed_ = true;
        return type_ = i + 1;
    }

    void word(size_t i) {
        const std::string_view text = tokens_.word(i);
        if (word_is(text, kQualifier | kRecord)) return;
        if (last_ < end_) {
            typed_ = typed_ || !word_is(tokens_.word(last_), kSoftQualifier);
            type_ = last_;
        }
        last_ = end_;
        if (is_type_word(text))
            typed_ = true;
        else if (!word_is(text, kNoType))
            last_ = i;
    }

    const BracketedTokens& tokens_;
    size_t end_;
    Declared& out_;
    bool typed_ = false, closed_ = false;  ///< a type was read; so was all that can name the parameter
    size_t last_, type_;                   ///< the word that may name it, and that of its type; the end for none
};

}  // namespace

void read_parameters(const BracketedTokens& tokens, size_t first, size_t end, Declared& out) {
    ParameterReader(tokens, end, out).run(first);
}

}  // namespace porttool
