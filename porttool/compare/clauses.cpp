// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/clauses.h"

#include <algorithm>
#include <string_view>

#include "porttool/language/words.h"
#include "porttool/normal/normal_text.h"

namespace porttool {
namespace {

class ClauseCutter {
public:
    ClauseCutter(const std::vector<std::string>& words, bool is_record) : words_(words), is_record_(is_record) {}

    std::vector<Clause> run() {
        for (at_ = 0; at_ < words_.size(); ++at_) {
            if (words_[at_] == "#" && depth_ <= 0) finish(at_);
            if (const size_t end = directive_end(); end > at_ && at_ == first_) {
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

    std::string_view word(size_t i) const {
        return i < words_.size() ? std::string_view(words_[i]) : std::string_view();
    }

    /// The end of the preprocessor line that begins here, where its words tell; else 0.
    size_t directive_end() const {
        if (word(at_) != "#") return 0;
        const std::string_view kind = word(at_ + 1);
        if (kind == "endif" || kind == "else") return at_ + 2;
        if (kind == "ifdef" || kind == "ifndef" || kind == "undef") return std::min(at_ + 3, words_.size());
        if (kind == "if" && word(at_ + 2) == "defined") return word(at_ + 3) == "(" ? at_ + 6 : at_ + 4;
        if (kind != "pragma") return 0;
        if (word(at_ + 2) == "unroll") return at_ + (is_number_token(word(at_ + 3)) ? 4 : 3);
        return word(at_ + 2) == "omp" || word(at_ + 2) == "acc" ? pragma_end(at_ + 3) : 0;
    }

    /// After the clauses of an OpenMP pragma: words of OpenMP's own, some with arguments.
    size_t pragma_end(size_t i) const {
        static constexpr std::string_view kWords =
            " parallel for simd target teams distribute atomic critical barrier single master masked ordered sections "
            "section task taskloop collapse reduction schedule num_threads private shared firstprivate lastprivate "
            "default map num_teams thread_limit nowait update read write capture data enter exit end declare flush "
            "loop "
            "is_device_ptr use_device_ptr if depend device safelen simdlen linear aligned to from kernels gang vector "
            "worker independent copy copyin copyout present seq async wait ";
        for (; i < words_.size(); ++i) {
            const std::string_view text = word(i);
            if (text == ",") continue;
            if (kWords.find(" " + std::string(text) + " ") == std::string_view::npos) break;
            const bool is_loop = (text == "for" || text == "if") && word(i + 1) == "(" && !takes_arguments(i);
            if (is_loop) break;
            if (word(i + 1) != "(") continue;
            int depth = 0;
            for (++i; i < words_.size(); ++i) {
                depth += word(i) == "(" ? 1 : word(i) == ")" ? -1 : 0;
                if (depth == 0) break;
            }
        }
        return std::min(i, words_.size());
    }

    /// OpenMP's `if ( ... )` goes on with another clause or ends before `{` or a loop; a statement's has a block.
    bool takes_arguments(size_t i) const {
        if (word(i) == "for") return false;
        int depth = 0;
        for (++i; i < words_.size(); ++i) {
            depth += word(i) == "(" ? 1 : word(i) == ")" ? -1 : 0;
            if (depth == 0) break;
        }
        return word(i + 1) == "for" || word(i + 1) == "map" || word(i + 1) == "schedule";
    }

    bool is_label() const {
        const std::string_view head = words_[first_];
        return head == "case" || head == "default" || (is_record_ && word_is(head, kLabel));
    }

    bool opens_block() const {
        if (at_ == first_) return true;
        const std::string_view before = words_[at_ - 1], head = words_[first_];
        if (is_record_ && depth_ <= 0 && blocks_.empty()) return true;
        if (before == ")" || before == "else" || before == "do" || before == "try" || before == "mutable" ||
            before == "noexcept" || before == "const" || before == "override" || before == "]")
            return before != "]" || is_capture(at_ - 1);
        return depth_ <= 0 && (word_is(head, kOpensType) || head == "namespace");
    }

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
