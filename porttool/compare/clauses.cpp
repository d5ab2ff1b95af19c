// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/clauses.h"

#include <algorithm>
#include <string_view>

#include "porttool/language/words.h"
#include "porttool/normal/directive_end.h"
#include "porttool/normal/literal.h"

namespace porttool {
namespace {

class ClauseCutter {
public:
    ClauseCutter(const std::vector<std::string>& words, bool is_record)
        : words_(words), texts_(words.begin(), words.end()), is_record_(is_record) {}

    std::vector<Clause> run() {
        for (at_ = 0; at_ < words_.size(); ++at_) {
            if (words_[at_] == "#" && depth_ <= 0) finish(at_);
            if (const size_t end = directive_end(texts_, at_); end > at_ && at_ == first_) {
                at_ = end - 1;
                finish(end);
                continue;
            }
            take(words_[at_]);
        }
        finish(words_.size());
        return std::move(out_);
    }

private:
    void take(std::string_view word) {
        if (word == "(" || word == "[") ++depth_;
        if (word == ")" || word == "]") --depth_;
        if (word == "{" && opens_block()) return open();
        if (word == "{") {
            ++depth_;
            ++expression_braces_;
        } else if (word == "}" && expression_braces_ > 0) {
            --depth_;
            --expression_braces_;
        } else if (word == "}") {
            close();
        } else if (word == ";" && depth_ <= 0) {
            finish(at_ + 1);
        } else if (word == ":" && depth_ <= 0 && is_label()) {
            finish(at_ + 1);
        }
    }

    bool is_label() const {
        const std::string_view head = words_[first_];
        return head == "case" || head == "default" || (is_record_ && word_is(head, kLabel));
    }

    bool opens_block() const {
        if (at_ == first_) return true;
        const std::string_view before = words_[at_ - 1], head = words_[first_];
        if (is_record_ && depth_ <= 0 && blocks_.empty()) return true;
        if (is_literal()) return false;
        if (before == ")" || before == "else" || before == "do" || before == "try" || before == "mutable" ||
            before == "noexcept" || before == "const" || before == "override" || before == "]")
            return before != "]" || is_capture(at_ - 1);
        return depth_ <= 0 && (word_is(head, kOpensType) || head == "namespace");
    }

    /// True after `( float4 )` where a value stands: C's literal of a whole struct or vector.
    bool is_literal() const { return opens_literal(texts_, first_, at_); }

    /// True for `]` of a lambda's `[=]` or `[&]`, and not of `float a[2] {`.
    bool is_capture(size_t at) const {
        while (at > first_ && words_[at] != "[") --at;
        return at > 0 && !is_word_token(words_[at - 1]) && words_[at - 1] != "]" && words_[at - 1] != ")";
    }

    void finish(size_t end) {
        if (end > first_) {
            out_.push_back({first_, end, blocks_.empty() ? Clause::kNone : blocks_.back()});
            first_ = end;
        }
        if (expression_braces_ == 0) depth_ = 0;
    }

    void open() {
        finish(at_ + 1);
        out_.back().opens = true;
        blocks_.push_back(out_.size() - 1);
    }

    void close() {
        finish(at_);
        const size_t head = blocks_.empty() ? Clause::kNone : blocks_.back();
        if (!blocks_.empty()) blocks_.pop_back();
        finish(at_ + 1);
        out_.back().closes = true;
        out_.back().partner = head;
        if (head != Clause::kNone) out_[head].partner = out_.size() - 1;
    }

    const std::vector<std::string>& words_;
    Words texts_;  ///< the same
    bool is_record_;
    std::vector<Clause> out_;
    std::vector<size_t> blocks_;  ///< heads of the blocks around what is read
    size_t at_ = 0, first_ = 0;
    int depth_ = 0, expression_braces_ = 0;
};

}  // namespace

std::vector<Clause> clauses_of(const std::vector<std::string>& words, bool is_record) {
    return ClauseCutter(words, is_record).run();
}

}  // namespace porttool
