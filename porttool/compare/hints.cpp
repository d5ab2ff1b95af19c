// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/hints.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <string>

#include "porttool/compare/brackets.h"
#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"

namespace porttool {
namespace {

/// Reads the pragmas of a text. Normal form has no line ends, so a pragma ends where its grammar does.
class HintReader {
public:
    explicit HintReader(Words words) : words_(std::move(words)) {
        for (const std::string_view word : words_)
            order_matters_ =
                order_matters_ || is_one_of(word, {"nowait", "ordered", "omp_get_thread_num", "omp_get_num_threads"});
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
    bool is_loop(size_t i) const { return word_is(word(i), kLoop) || is_one_of(word(i), {"#", "__pragma"}); }

    size_t after_group(size_t open) const { return after_parentheses(words_, open); }

    /// How many words the hint at `i` takes; 0 if none is there.
    size_t hint_at(size_t i) {
        if (word(i) != "#" || word(i + 1) != "pragma") return 0;
        const size_t end = after_hint(i + 2);
        return end > i + 2 ? end - i : 0;
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
            if (!only_schedules(end, loop)) kept.insert(kept.end(), at_word(end), at_word(next));
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
    bool only_schedules(size_t i, bool loop) const {
        if (word(i) == "num_threads") return loop && !knows_its_thread() && is_count_of_threads(i + 2);
        return is_one_of(word(i), {"schedule", "proc_bind", "simdlen", "nontemporal"});
    }

    /// How many threads share the turns of a loop is a matter of speed, as their schedule is; but one thread alone
    /// hides a race. True for a number from 2 on, and for what is asked of the machine: `omp_get_max_threads()`.
    bool is_count_of_threads(size_t i) const {
        const bool is_call = is_word_token(word(i)) && word(i + 1) == "(" && word(i + 2) == ")" && word(i + 3) == ")";
        if (is_call) return speaks_of(word(i), {"thread", "core", "cpu", "proc"});
        const size_t digits = word(i).find_first_not_of("0123456789");
        const std::string_view number = word(i).substr(0, digits), suffix = word(i).substr(number.size());
        return word(i + 1) == ")" && !number.empty() && suffix.find_first_not_of("uUlL") == suffix.npos &&
               number.front() != '0' && number != "1";
    }

    /// True if the text seems to ask elsewhere which thread does a turn: `partial[ThreadIndex()]`.
    bool knows_its_thread() const {
        for (size_t i = 0; i < words_.size(); ++i) {
            if (words_[i] == "num_threads")
                i = std::max(i + 1, after_group(i + 1)) - 1;
            else if (is_word_token(words_[i]) && speaks_of(words_[i], {"thread", "rank", "tid", "worker"}))
                return true;
        }
        return false;
    }

    static bool speaks_of(std::string_view name, std::initializer_list<std::string_view> parts) {
        std::string low(name);
        std::transform(low.begin(), low.end(), low.begin(), [](unsigned char c) { return std::tolower(c); });
        return std::any_of(parts.begin(), parts.end(),
                           [&](std::string_view part) { return low.find(part) != std::string::npos; });
    }

    Words words_;
    Words out_;
    bool order_matters_ = false;  ///< somewhere in the text it shows which thread takes what
};

/// The words of a pragma that stands as a string.
void add_words_of(std::string_view text, Words& out) {
    const auto part_of_word = [](char c) {
        return c == '_' || c == '.' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    };
    for (size_t i = 0; i < text.size();) {
        size_t end = i + 1;
        while (part_of_word(text[i]) && end < text.size() && part_of_word(text[end])) ++end;
        if (text[i] != ' ' && text[i] != '\t') out.push_back(text.substr(i, end - i));
        i = end;
    }
}

/// `_Pragma("omp simd")` is `#pragma omp simd`.
Words with_pragma_lines(const Words& words) {
    Words out;
    for (size_t i = 0; i < words.size(); ++i) {
        const bool is_pragma = words[i] == "_Pragma" && i + 3 < words.size() && words[i + 1] == "(" &&
                               words[i + 3] == ")" && words[i + 2].size() > 2 && words[i + 2].front() == '"' &&
                               words[i + 2].find('\\') == std::string_view::npos;
        if (!is_pragma) {
            out.push_back(words[i]);
            continue;
        }
        out.insert(out.end(), {"#", "pragma"});
        add_words_of(words[i + 2].substr(1, words[i + 2].size() - 2), out);
        i += 3;
    }
    return out;
}

}  // namespace

Words without_hints(const Words& tokens) {
    if (std::find(tokens.begin(), tokens.end(), "pragma") == tokens.end() &&
        std::find(tokens.begin(), tokens.end(), "_Pragma") == tokens.end())
        return tokens;
    return HintReader(with_pragma_lines(tokens)).run();
}

}  // namespace porttool
