// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/asides.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "porttool/normal/statements.h"

namespace porttool {
namespace {

constexpr std::array<std::string_view, 8> kClocks = {"gettimeofday", "tvsec",   "tvusec", "clockgettime",
                                                     "steadyclock",  "elapsed", "chrono", "profil"};
constexpr std::array<std::string_view, 7> kSayings = {"print", "log", "assert", "cout", "cerr", "warn", "debug"};
constexpr std::array<std::string_view, 6> kMacros = {"timing", "timer", "debug", "verbose", "profil", "bench"};

template <size_t N>
bool names_one_of(const std::array<std::string_view, N>& parts, std::string_view word) {
    const std::string name = folded(word);
    return std::any_of(parts.begin(), parts.end(), [&](std::string_view part) {
        constexpr size_t kLongestLogarithm = 5;  // `log2f` is no message
        return name.find(part) != std::string::npos && !(part == "log" && name.size() <= kLongestLogarithm);
    });
}

class AsideReader {
public:
    explicit AsideReader(const Words& tokens) : tokens_(tokens) {}

    Words run() {
        Words out;
        for (size_t i = 0; i < tokens_.size();) {
            if (const size_t end = end_of_guarded(i); end > i) {
                i = end;
                continue;
            }
            const size_t end = end_of_statement(i);
            if (end == i || !is_aside(i, end)) out.insert(out.end(), at(i), at(std::max(end, i + 1)));
            i = std::max(end, i + 1);
        }
        return out;
    }

private:
    Words::const_iterator at(size_t i) const { return tokens_.begin() + static_cast<std::ptrdiff_t>(i); }
    std::string_view word(size_t i) const { return i < tokens_.size() ? tokens_[i] : std::string_view(); }

    /// Behind the `# endif` of such a macro whose lines begin at `i`, or `i`. One with an `# else` stays.
    size_t end_of_guarded(size_t i) const {
        const bool guarded = word(i) == "#" && word(i + 1) == "ifdef" && names_one_of(kMacros, word(i + 2));
        if (!guarded) return i;
        int depth = 0;
        for (size_t k = i; k + 1 < tokens_.size(); ++k) {
            if (tokens_[k] != "#") continue;
            const std::string_view kind = tokens_[k + 1];
            if (kind.starts_with("if")) ++depth;
            if (kind == "endif" && --depth == 0) return k + 2;
            if (depth == 1 && kind.starts_with("el")) return i;
        }
        return i;
    }

    /// Behind the semicolon of the statement without a block that begins at `i`, or `i`.
    size_t end_of_statement(size_t i) const {
        int depth = 0;
        for (size_t k = i; k < tokens_.size(); ++k) {
            if (tokens_[k] == "{" || tokens_[k] == "}" || tokens_[k] == "#") return i;
            depth += tokens_[k] == "(" ? 1 : tokens_[k] == ")" ? -1 : 0;
            if (depth == 0 && tokens_[k] == ";") return k + 1;
        }
        return i;
    }

    bool is_aside(size_t first, size_t end) const {
        if (word(first) == "return") return false;
        for (size_t i = first; i < end; ++i)
            if (is_word_token(tokens_[i]) && names_one_of(kClocks, tokens_[i])) return true;
        size_t name = first;
        while (word(name + 1) == "::" && name + 2 < end) name += 2;
        const bool speaks = word(name + 1) == "(" || word(name + 1) == "<<";
        return speaks && is_word_token(word(name)) && names_one_of(kSayings, word(name));
    }

    const Words& tokens_;
};

}  // namespace

Words without_asides(const Words& tokens) { return AsideReader(tokens).run(); }

}  // namespace porttool
