// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/other_rounding.h"

#include <algorithm>
#include <utility>

#include "porttool/compare/brackets.h"
#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/normal_form.h"

namespace porttool {
namespace {

/// The words [first, end) of an argument.
using Argument = std::pair<size_t, size_t>;

class RoundingWriter {
public:
    RoundingWriter(const Words& text, const Dialect& dialect) : text_(text), dialect_(dialect) {}

    std::vector<std::string> run() {
        write(0, text_.size());
        return std::move(out_);
    }

private:
    static constexpr int kDeepest = 16;

    std::string_view word(size_t i) const { return i < text_.size() ? text_[i] : std::string_view(); }

    size_t behind_scope(size_t i) const { return is_word_token(word(i)) && word(i + 1) == "::" ? i + 2 : i; }

    std::string called(size_t i) const {
        const bool is_call = is_word_token(word(i)) && word(i + 1) == "(" && (i == 0 || !is_reach(text_[i - 1]));
        const std::string* known = is_call ? dialect_.meaning(text_[i]) : nullptr;
        return known != nullptr ? *known : is_call ? std::string(text_[i]) : std::string();
    }
    static bool is_reach(std::string_view before) { return before == "." || before == "->"; }

    void write(size_t first, size_t end) {
        if (++depth_ > kDeepest)
            for (; first < end; ++first) out_.emplace_back(text_[first]);
        while (first < end) first = write_one(first);
        --depth_;
    }

    void write_in_brackets(Argument argument) {
        const bool is_single = argument.second == argument.first + 1;
        if (!is_single) out_.emplace_back("(");
        write(argument.first, argument.second);
        if (!is_single) out_.emplace_back(")");
    }

    size_t write_one(size_t i) {
        const size_t name = behind_scope(i);
        const std::string call = called(name);
        if (call == "fma") {
            const auto [given, end] = call_arguments(text_, name + 1);
            if (given.size() == 3) return write_sum(given, end);
        }
        if (call == "pow") {
            const auto [given, end] = call_arguments(text_, name + 1);
            const bool is_square = given.size() == 2 && given[0].second == given[0].first + 1 &&
                                   is_word_token(text_[given[0].first]) && is_number(given[1], "2");
            if (is_square) {
                const std::string base(text_[given[0].first]);
                out_.insert(out_.end(), {"(", base, "*", base, ")"});
                return end;
            }
        }
        if (is_number({i, i + 1}, "1") && word(i + 1) == "/" && !is_joined_before(i)) {
            const size_t root = behind_scope(i + 2);
            if (called(root) == "sqrt") {
                const auto [given, end] = call_arguments(text_, root + 1);
                if (given.size() == 1 && !is_one_of(word(end), {".", "["})) {
                    out_.insert(out_.end(), {"rsqrt", "("});
                    write(given[0].first, given[0].second);
                    out_.emplace_back(")");
                    return end;
                }
            }
        }
        out_.emplace_back(text_[i]);
        return i + 1;
    }

    size_t write_sum(const std::vector<Argument>& given, size_t end) {
        out_.emplace_back("(");
        write_in_brackets(given[0]);
        out_.emplace_back("*");
        write_in_brackets(given[1]);
        const bool is_taken = word(given[2].first) == "-" && is_one_value({given[2].first + 1, given[2].second});
        out_.emplace_back(is_taken ? "-" : "+");
        write_in_brackets({given[2].first + (is_taken ? 1 : 0), given[2].second});
        out_.emplace_back(")");
        return end;
    }

    /// A name or number, with members of it or what stands in brackets behind it.
    bool is_one_value(Argument argument) const {
        int depth = 0;
        for (size_t i = argument.first; i < argument.second; ++i) {
            depth += is_one_of(text_[i], {"(", "["}) ? 1 : is_one_of(text_[i], {")", "]"}) ? -1 : 0;
            const bool is_plain = is_word_token(text_[i]) || is_number_token(text_[i]) ||
                                  is_one_of(text_[i], {".", "->", "::", ")", "]"});
            if (depth == 0 && !is_plain) return false;
        }
        return argument.first < argument.second;
    }

    bool is_number(Argument argument, std::string_view value) const {
        return argument.second == argument.first + 1 && is_number_token(word(argument.first)) &&
               number_value(text_[argument.first]) == value;
    }

    /// True where what stands before takes the number first.
    bool is_joined_before(size_t i) const { return i > 0 && is_one_of(text_[i - 1], {"*", "/", "%"}); }

    const Words& text_;
    const Dialect& dialect_;
    std::vector<std::string> out_;
    int depth_ = 0;
};

}  // namespace

std::vector<std::string> with_other_rounding(const Words& text, const Dialect& dialect) {
    return RoundingWriter(text, dialect).run();
}

}  // namespace porttool
