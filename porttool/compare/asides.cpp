// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/asides.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

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
    explicit AsideReader(const Words& tokens) : tokens_(tokens) { find_guards(); }

    Words run() {
        Words out;
        for (size_t i = 0; i < tokens_.size();) {
            if (const size_t end = end_of_guarded(i); end > i) {
                i = end;
                continue;
            }
            const size_t stop = end_of_statement(i), end = std::max(stop, i + 1);
            if (tokens_[end - 1] != ";" || !is_aside(i, end)) out.insert(out.end(), at(i), at(end));
            i = end;
        }
        return out;
    }

private:
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

    /// Behind the `# endif` of such lines that begin at `i`, or `i`.
    size_t end_of_guarded(size_t i) const {
        const auto guard = guards_.find(i);
        return guard == guards_.end() ? i : guard->second;
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
    std::unordered_map<size_t, size_t> guards_;
};

}  // namespace

Words without_asides(const Words& tokens) { return AsideReader(tokens).run(); }

}  // namespace porttool
