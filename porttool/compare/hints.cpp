// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/hints.h"

#include <algorithm>

#include "porttool/compare/brackets.h"
#include "porttool/normal/declaration_words.h"

namespace porttool {
namespace {

/// Reads the pragmas of a text. Normal form has no line ends, so a pragma ends where its grammar does.
class HintReader {
public:
    explicit HintReader(const Words& words) : words_(words) {
        for (const std::string_view word : words)
            order_matters_ = order_matters_ || is_one_of(word, {"nowait", "ordered", "omp_get_thread_num"});
    }

    Words run() {
        for (size_t i = 0; i < words_.size();) {
            const size_t taken = hint_at(i);
            if (taken == 0) out_.push_back(words_[i]);
            i += std::max<size_t>(1, taken);
        }
        return std::move(out_);
    }

private:
    std::string_view word(size_t i) const { return i < words_.size() ? words_[i] : std::string_view(); }
    bool is_loop(size_t i) const { return is_one_of(word(i), {"for", "while", "do", "#", "foreach", "__pragma"}); }

    size_t after_group(size_t open) const { return after_parentheses(words_, open); }

    /// How many words the hint at `i` takes; 0 if none is there.
    size_t hint_at(size_t i) {
        if (word(i) == "_Pragma" && word(i + 1) == "(" && word(i + 3) == ")") return is_hint_text(word(i + 2)) ? 4 : 0;
        if (word(i) != "#" || word(i + 1) != "pragma") return 0;
        const size_t end = after_hint(i + 2);
        return end > i + 2 ? end - i : 0;
    }

    static bool is_hint_text(std::string_view text) {
        for (const std::string_view hint : {"\"unroll", "\"nounroll", "\"ivdep", "\"GCC ivdep", "\"GCC unroll"})
            if (text.starts_with(hint)) return true;
        return text == "\"omp simd\"";
    }

    /// Behind the pragma whose first word is at `at`, or `at` if it is no hint.
    size_t after_hint(size_t at) {
        const std::string_view first = word(at), second = word(at + 1);
        if (is_one_of(first, {"unroll", "nounroll"})) return after_count(at + 1);
        if (first == "ivdep") return at + 1;
        if (is_one_of(first, {"diag_suppress", "nv_diag_suppress", "diag_default", "nv_diag_default"})) return at + 2;
        if (first == "warning" && second == "(") return after_group(at + 1);
        if (is_one_of(first, {"GCC", "clang"}) && second == "diagnostic")
            return is_one_of(word(at + 2), {"push", "pop"}) ? at + 3 : at + 4;
        if (first == "GCC" && second == "ivdep") return at + 2;
        if (first == "GCC" && second == "unroll") return after_count(at + 2);
        if (first == "clang" && second == "loop") return after_loop_hints(at);
        return first == "omp" ? after_omp(at) : at;
    }

    /// Behind how often to unroll, if that is there: a number, a name before the loop, or either in parentheses.
    size_t after_count(size_t at) const {
        if (is_number_token(word(at))) return at + 1;
        if (word(at) == "(") return after_group(at);
        return is_word_token(word(at)) && !is_loop(at) && is_loop(at + 1) ? at + 1 : at;
    }

    size_t after_loop_hints(size_t at) const {
        size_t end = at + 2;
        while (is_one_of(word(end), {"unroll", "unroll_count", "distribute", "pipeline"}) && word(end + 1) == "(")
            end = after_group(end + 1);
        return end > at + 2 && !is_one_of(word(end), {"vectorize", "interleave", "vectorize_width", "interleave_count",
                                                      "vectorize_predicate"})
                   ? end
                   : at;
    }

    /// `omp simd` goes whole; of `omp parallel for` and the like only the clauses that schedule.
    size_t after_omp(size_t at) {
        size_t end = at + 1;
        while (is_one_of(word(end), {"parallel", "simd"}) || (word(end) == "for" && word(end + 1) != "(")) ++end;
        const size_t clauses = end;
        if (clauses == at + 1) return at;
        Words kept;
        const bool loop = std::find(at_word(at), at_word(clauses), "for") != at_word(clauses);
        while (is_clause(end, loop) || (word(end) == "," && is_clause(end + 1, loop))) {
            if (word(end) == ",") ++end;
            const size_t next = word(end + 1) == "(" ? after_group(end + 1) : end + 1;
            if (!only_schedules(word(end))) kept.insert(kept.end(), at_word(end), at_word(next));
            end = next;
        }
        if (order_matters_) {
            out_.insert(out_.end(), at_word(at - 2), at_word(end));
            return end;
        }
        const bool simd_alone = clauses == at + 2 && word(at + 1) == "simd";
        if (simd_alone && kept.empty()) return end;
        out_.insert(out_.end(), {"#", "pragma", "omp"});
        for (size_t i = at + 1; i < clauses; ++i)
            if (word(i) != "simd" || simd_alone || !kept.empty()) out_.push_back(word(i));
        out_.insert(out_.end(), kept.begin(), kept.end());
        return end;
    }

    Words::const_iterator at_word(size_t i) const { return words_.begin() + static_cast<std::ptrdiff_t>(i); }

    /// `loop`: the directive says `for`, so that an `if` after it is a clause and no statement.
    bool is_clause(size_t i, bool loop) const {
        if (word(i) == "nowait" || (loop && word(i) == "if" && word(i + 1) == "(")) return true;
        if (word(i) == "ordered" && word(i + 1) != "{") return true;
        return word(i + 1) == "(" &&
               is_one_of(word(i), {"schedule", "num_threads", "collapse", "private", "firstprivate", "lastprivate",
                                   "shared", "reduction", "default", "copyin", "proc_bind", "linear", "aligned",
                                   "safelen", "simdlen", "nontemporal", "allocate", "order"});
    }
    static bool only_schedules(std::string_view clause) {
        return is_one_of(clause, {"schedule", "proc_bind", "simdlen", "nontemporal"});
    }

    const Words& words_;
    Words out_;
    bool order_matters_ = false;  ///< somewhere in the text it shows which thread takes what
};

}  // namespace

Words without_hints(const Words& tokens) {
    if (std::find(tokens.begin(), tokens.end(), "pragma") == tokens.end() &&
        std::find(tokens.begin(), tokens.end(), "_Pragma") == tokens.end())
        return tokens;
    return HintReader(tokens).run();
}

}  // namespace porttool
