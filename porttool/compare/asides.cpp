// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
//
// An edit of asides alone is a note, so nobody may hide anything else in one: what is called an aside must not write
// what the rest of the function uses, nor end it. `printf("%f", y *= 2)` is none, and neither is `y += elapsed * x`,
// unless `y` is used in asides alone.
#include "porttool/compare/asides.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "porttool/normal/statements.h"
#include "porttool/text/name_words.h"

namespace porttool {
namespace {

constexpr std::array<std::string_view, 8> kClocks = {"gettimeofday", "tvsec",   "tvusec", "clockgettime",
                                                     "steadyclock",  "elapsed", "chrono", "profil"};
constexpr std::array<std::string_view, 6> kMacros = {"timing", "timer", "debug", "verbose", "profil", "bench"};
/// Words of names: those that may go on (`println`, `assertion`), and those that may not (`logic`).
constexpr std::array<std::string_view, 4> kSayings = {"print", "assert", "warn", "debug"};
constexpr std::array<std::string_view, 5> kWholeSayings = {"log", "logger", "logging", "cout", "cerr"};
/// What holds a group's threads together, in whatever build.
constexpr std::array<std::string_view, 6> kBarriers = {"__syncthreads",      "barrier",
                                                       "work_group_barrier", "threadgroup_barrier",
                                                       "group_barrier",      "GroupMemoryBarrierWithGroupSync"};
/// What leaves a function, or a program, and what nobody sees through.
constexpr std::array<std::string_view, 14> kLeaves = {"return", "goto",  "throw",      "discard", "co_return",
                                                      "exit",   "_Exit", "abort",      "longjmp", "terminate",
                                                      "asm",    "_exit", "quick_exit", "__trap"};

/// Words of names that say that something is done, not asked: `assert(init(&p) == 0)` is no mere check.
constexpr std::array<std::string_view, 44> kDeeds = {
    "init",   "initialize", "alloc",   "allocate", "malloc", "free",    "next",   "push",  "pop",
    "add",    "insert",     "erase",   "remove",   "set",    "reset",   "read",   "write", "load",
    "store",  "step",       "run",     "advance",  "update", "execute", "launch", "open",  "close",
    "create", "build",      "destroy", "send",     "recv",   "receive", "apply",  "swap",  "copy",
    "memcpy", "fill",       "acquire", "atomic",   "fetch",  "release", "solve",  "rand"};

/// Words of names of what is reckoned.
constexpr std::array<std::string_view, 36> kReckonings = {
    "softmax", "sum",  "add",   "mul",     "exp",   "clamp",  "clip",      "density",   "likelihood",
    "prob",    "norm", "scale", "normal",  "gamma", "det",    "normalize", "smooth",    "apply",
    "mean",    "max",  "min",   "sigmoid", "grad",  "matrix", "mod",       "mix",       "gradient",
    "filter",  "blur", "bias",  "weight",  "cdf",   "pdf",    "sample",    "posterior", "variance"};

template <size_t N>
bool names_one_of(const std::array<std::string_view, N>& parts, std::string_view word) {
    const std::string name = folded(word);
    return std::any_of(parts.begin(), parts.end(),
                       [&](std::string_view part) { return name.find(part) != std::string::npos; });
}

/// How sure a name says that something is told to people.
enum class Speaks : uint8_t { No, Perhaps, Surely };

/// `print`, names that end in `assert`, and macros that do (`LIB_CASSERT`), tell; `log` and `warn` may be a part of
/// something else (`log_softmax`), and what is asserted may be made so (`assert_finite_or_zero`). A short name with
/// `log` in it is a logarithm.
Speaks speaks_by_name(std::string_view name) {
    constexpr size_t kLongestLogarithm = 5;
    Speaks out = Speaks::No;
    const std::vector<std::string> words = words_of_name(name);
    const bool is_macro = std::none_of(name.begin(), name.end(), [](char c) { return c >= 'a' && c <= 'z'; });
    for (std::string_view word : words) {
        if (name.size() > kLongestLogarithm || word.find("log") == std::string_view::npos)
            if (std::find(kWholeSayings.begin(), kWholeSayings.end(), word) != kWholeSayings.end())
                out = std::max(out, Speaks::Perhaps);
        const bool is_last = word == words.back();
        word.remove_prefix(std::min(word.find_first_not_of("vf"), word.size()));  // vfprintf
        if (word.starts_with("print") || (is_last && word.starts_with("assert"))) return Speaks::Surely;
        if (is_last && is_macro && word.ends_with("assert")) return Speaks::Surely;
        if (std::any_of(kSayings.begin(), kSayings.end(),
                        [&](std::string_view saying) { return word.starts_with(saying); }))
            out = std::max(out, Speaks::Perhaps);
    }
    return out;
}

template <size_t N>
bool has_word_of(const std::array<std::string_view, N>& list, std::string_view name) {
    const std::vector<std::string> words = words_of_name(name);
    return std::any_of(words.begin(), words.end(),
                       [&](std::string_view word) { return std::find(list.begin(), list.end(), word) != list.end(); });
}

bool does_by_name(std::string_view name) { return has_word_of(kDeeds, name); }

/// True for a name that says that something is reckoned: `log_softmax`, `apply_density_profile`.
bool reckons_by_name(std::string_view name) { return has_word_of(kReckonings, name); }

template <size_t N>
bool is_in(const std::array<std::string_view, N>& list, std::string_view word) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

/// Tokens that stand side by side.
struct Stretch {
    enum class Kind : uint8_t { Plain, Saying, Timing, Guarded };
    size_t first = 0, end = 0;
    Kind kind = Kind::Plain;
};

class AsideReader {
public:
    explicit AsideReader(const Words& tokens) : tokens_(tokens) {
        find_guards();
        for (size_t i = 0; i + 1 < tokens.size(); ++i)
            if (tokens[i + 1] == "[" && is_word_token(tokens[i])) arrays_.insert(tokens[i]);
        cut();
    }

    Words run() {
        settle();
        Words out;
        for (const Stretch& one : stretches_) {
            if (one.kind != Stretch::Kind::Plain) continue;
            out.insert(out.end(), at(one.first), at(one.end));
            drop_empty_branches(out);
        }
        return out;
    }

private:
    using Kind = Stretch::Kind;

    /// Takes `# ifdef A # endif` and `# ifdef A # else # endif` from the end: what stood in there was an aside.
    static void drop_empty_branches(Words& text) {
        const auto ends_with = [&](size_t before, std::string_view word) {
            return text.size() > before + 1 && text[text.size() - before - 1] == word &&
                   text[text.size() - before - 2] == "#";
        };
        if (!ends_with(0, "endif")) return;
        const size_t branch = ends_with(2, "else") ? 4 : 2;
        if (ends_with(branch + 1, "ifdef") || ends_with(branch + 1, "ifndef")) text.resize(text.size() - branch - 3);
    }

    Words::const_iterator at(size_t i) const { return tokens_.begin() + static_cast<std::ptrdiff_t>(i); }
    std::string_view word(size_t i) const { return i < tokens_.size() ? tokens_[i] : std::string_view(); }

    /// Where the lines end that such a macro guards, by where they begin. Those with an `# else` stay.
    void find_guards() {
        struct Open {
            size_t place = 0;
            bool has_else = false;
        };
        std::vector<Open> open;
        for (size_t k = 0; k + 1 < tokens_.size(); ++k) {
            if (tokens_[k] != "#") continue;
            const std::string_view kind = tokens_[k + 1];
            if (kind.starts_with("if")) open.push_back({k});
            if (open.empty()) continue;
            if (kind.starts_with("el")) open.back().has_else = true;
            if (kind != "endif") continue;
            const Open guard = open.back();
            open.pop_back();
            if (!guard.has_else && word(guard.place + 1) == "ifdef" && names_one_of(kMacros, word(guard.place + 2)))
                guards_[guard.place] = k + 2;
        }
    }

    void cut() {
        for (size_t i = 0; i < tokens_.size();) {
            Stretch next{i, i, Kind::Guarded};
            if (const auto guard = guards_.find(i); guard != guards_.end()) {
                next.end = guard->second;
            } else if (tokens_[i] == "#") {
                next.end = std::min(tokens_.size(), i + words_of_line(word(i + 1)));
                next.kind = Kind::Plain;
            } else {
                next.end = std::max(end_of_statement(i), i + 1);
                next.kind = tokens_[next.end - 1] == ";" ? kind_of_statement(i, next.end) : Kind::Plain;
            }
            stretches_.push_back(next);
            i = next.end;
        }
    }

    /// Of a line of the preprocessor, as far as words tell.
    static size_t words_of_line(std::string_view kind) {
        if (kind == "ifdef" || kind == "ifndef") return 3;
        return kind == "else" || kind == "endif" ? 2 : 1;
    }

    /// Behind the semicolon of the statement without a block that begins at `i`, or where something else comes first.
    size_t end_of_statement(size_t i) const {
        int depth = 0;
        for (size_t k = i; k < tokens_.size(); ++k) {
            if (tokens_[k] == "{" || tokens_[k] == "}" || tokens_[k] == "#") return k;
            depth += tokens_[k] == "(" ? 1 : tokens_[k] == ")" ? -1 : 0;
            if (depth == 0 && tokens_[k] == ";") return k + 1;
        }
        return tokens_.size();
    }

    Kind kind_of_statement(size_t first, size_t end) const {
        if (says(first, end)) return Kind::Saying;
        const bool reads_clock = std::any_of(
            at(first), at(end), [](std::string_view one) { return is_word_token(one) && names_one_of(kClocks, one); });
        return reads_clock && !reckons(first, end) ? Kind::Timing : Kind::Plain;
    }

    /// True if what is called with a clock's word in its name reckons something: a profile is also a curve.
    bool reckons(size_t first, size_t end) const {
        for (size_t i = first; i + 1 < end; ++i)
            if (word(i + 1) == "(" && names_one_of(kClocks, word(i)) && reckons_by_name(word(i))) return true;
        return false;
    }

    /// True if a call whose name leaves it open tells something: it has a text, or is handed no whole array to write.
    bool may_tell(size_t name, size_t end) const {
        if (does_by_name(word(name)) || reckons_by_name(word(name))) return false;
        return std::any_of(at(name), at(end), [](std::string_view one) { return one.starts_with("\""); }) ||
               !hands_array(name + 1, end);
    }

    /// True if a whole array is among what a call takes between these places.
    bool hands_array(size_t first, size_t end) const {
        for (size_t i = first + 1; i < end; ++i) {
            const std::string_view before = word(i - 1), after = word(i + 1);
            const bool is_whole = (before == "(" || before == ",") && (after == ")" || after == ",");
            if (is_whole && arrays_.contains(word(i))) return true;
        }
        return false;
    }

    /// True for a statement that is one call which tells something, or hands something to a stream.
    bool says(size_t first, size_t end) const {
        size_t name = first;
        while (word(name + 1) == "::" && name + 2 < end) name += 2;
        const Speaks speaks = is_word_token(word(name)) ? speaks_by_name(word(name)) : Speaks::No;
        if (speaks == Speaks::No && !streams_a_text(name, end)) return false;
        for (size_t i = name + 1; i + 1 < end; ++i)
            if (word(i + 1) == "(" && is_word_token(word(i)) && does_by_name(word(i))) return false;
        size_t next = name + 1;
        if (word(next) == "(") next = behind_parentheses(next, end);
        if (is_shift(next)) return true;
        const bool is_call = next > name + 1 && word(next) == ";";
        return is_call && (speaks == Speaks::Surely || (speaks == Speaks::Perhaps && may_tell(name, end)));
    }

    /// `LOG(INFO) << "rows: " << n`, which is no logarithm.
    bool streams_a_text(size_t name, size_t end) const {
        return is_word_token(word(name)) && has_word_of(kWholeSayings, word(name)) &&
               std::any_of(at(name), at(end), [](std::string_view one) { return one.starts_with("\""); });
    }

    bool is_shift(size_t i) const { return word(i) == "<" && word(i + 1) == "<"; }

    size_t behind_parentheses(size_t i, size_t end) const {
        int depth = 0;
        for (; i < end; ++i) {
            depth += tokens_[i] == "(" ? 1 : tokens_[i] == ")" ? -1 : 0;
            if (depth == 0) return i + 1;
        }
        return end;
    }

    /// Calls plain what touches more than asides do, until that makes nothing else plain.
    void settle() {
        for (const Stretch& one : stretches_)
            if (one.kind == Kind::Plain) note_names(one);
        constexpr int kMostRounds = 8;
        for (int round = 0;; ++round) {
            bool is_settled = true;
            for (Stretch& one : stretches_) {
                if (one.kind == Kind::Plain || (round < kMostRounds && is_harmless(one))) continue;
                one.kind = Kind::Plain;
                note_names(one);
                is_settled = false;
            }
            if (is_settled) return;
        }
    }

    void note_names(const Stretch& stretch) {
        for (size_t i = stretch.first; i < stretch.end; ++i)
            if (is_word_token(tokens_[i])) rest_.insert(tokens_[i]);
    }

    /// True at a loop's own counter (`for (int i = 0; ...)`) that begins at `head`, up to the end of the loop.
    bool is_counter(const Stretch& stretch, size_t i) const {
        const auto is_loop_of = [&](size_t head, std::string_view name) {
            return word(head) == "for" && word(head + 1) == "(" && is_word_token(word(head + 2)) &&
                   word(head + 3) == name && word(head + 4) == "=";
        };
        const size_t name = tokens_[i] == "=" ? i - 1 : is_word_token(word(i + 1)) ? i + 1 : i - 1;
        if (i == 0 || tokens_[i] == "&" || (name > 0 && is_one_of_members(word(name - 1)))) return false;
        constexpr size_t kReach = 256;  // words
        for (size_t head = std::max(stretch.first, i - std::min(i, kReach)); head < i; ++head)
            if (is_loop_of(head, word(name)) && i < end_of_loop(head, stretch.end)) return true;
        return false;
    }

    static bool is_one_of_members(std::string_view sign) { return sign == "." || sign == "->" || sign == "*"; }

    /// Behind the body of the loop that begins at `head`.
    size_t end_of_loop(size_t head, size_t end) const {
        size_t body = head;
        while (word(body) == "for") body = behind_parentheses(body + 1, end);
        int depth = 0;
        for (size_t i = body; i < end; ++i) {
            depth += tokens_[i] == "{" ? 1 : tokens_[i] == "}" ? -1 : 0;
            if (depth == 0 && (tokens_[i] == "}" || tokens_[i] == ";")) return i + 1;
        }
        return end;
    }

    /// `f ( rows , n ) ;` where `rows` is an array: nobody takes what it gives, so that it may write there.
    bool works_on_an_array(size_t i) const {
        const bool is_alone = i > 0 && (word(i - 1) == ";" || word(i - 1) == "{" || word(i - 1) == "}" ||
                                        (i > 1 && word(i - 2) == "ifdef"));
        if (!is_alone || word(i + 1) != "(" || !is_word_token(word(i)) || says(i, end_of_statement(i))) return false;
        const size_t end = behind_parentheses(i + 1, tokens_.size());
        return word(end) == ";" && !names_one_of(kClocks, word(i)) && hands_array(i + 1, end);
    }

    bool is_harmless(const Stretch& one) const {
        for (size_t i = one.first; i < one.end; ++i) {
            if (is_in(kLeaves, tokens_[i]) || is_in(kBarriers, tokens_[i])) return false;
            if (one.kind == Kind::Guarded && works_on_an_array(i)) return false;
            if (one.kind == Kind::Timing && takes_part(i)) return false;
            if (!writes(i, one.end) || (one.kind == Kind::Guarded && is_counter(one, i))) continue;
            if (one.kind == Kind::Saying || !writes_own(i)) return false;
        }
        return true;
    }

    /// True for a name of the rest that stands for a value here; one may be the type of what is declared, or is called.
    bool takes_part(size_t i) const {
        if (!is_word_token(tokens_[i]) || !rest_.contains(tokens_[i])) return false;
        const std::string_view after = word(i + 1);
        return !(is_word_token(after) || after == "::" || after == "(" || after == ">");
    }

    bool is_assignment(size_t i) const {
        const std::string_view sign = tokens_[i];
        if (sign == "=" || sign == "++" || sign == "--") return true;
        if (sign == "<=" || sign == ">=") return i > 0 && tokens_[i - 1].substr(0, 1) == sign.substr(0, 1);  // `<<=`
        return sign.size() == 2 && sign[1] == '=' && sign != "==" && sign != "!=";
    }

    /// True where something is written, or where its address or a reference to it is taken.
    bool writes(size_t i, size_t end) const {
        return i < end && (is_assignment(i) || (tokens_[i] == "&" && !is_binary(i)));
    }
    /// `a & b` of two values. `T & a` is a reference, which has a type and no value before it.
    bool is_binary(size_t i) const {
        return i > 0 && (tokens_[i - 1] == ")" || tokens_[i - 1] == "]") && !is_word_token(word(i + 1));
    }

    /// True for a place that only asides use: a name, or a member of one, that the rest does not have.
    bool writes_own(size_t i) const {
        const bool is_before = i > 0 && is_word_token(tokens_[i - 1]) && tokens_[i] != "&";
        if (tokens_[i] == "&" && !(i > 0 && (tokens_[i - 1] == "(" || tokens_[i - 1] == ","))) return false;
        size_t name = is_before ? i - 1 : i + 1;
        if (!is_before && tokens_[i] != "&" && tokens_[i] != "++" && tokens_[i] != "--") return false;
        while (is_before && name >= 2 && tokens_[name - 1] == "." && is_word_token(tokens_[name - 2])) name -= 2;
        const std::string_view before = is_before && name > 0 ? tokens_[name - 1] : std::string_view();
        return is_word_token(word(name)) && !rest_.contains(word(name)) && before != "*" && before != "->" &&
               before != "." && before != "&";
    }

    const Words& tokens_;
    std::unordered_map<size_t, size_t> guards_;
    std::vector<Stretch> stretches_;
    std::unordered_set<std::string_view> arrays_;  ///< names of which parts are read or written
    std::unordered_set<std::string_view> rest_;    ///< of what is no aside
};

}  // namespace

Words without_asides(const Words& tokens) { return AsideReader(tokens).run(); }

}  // namespace porttool
