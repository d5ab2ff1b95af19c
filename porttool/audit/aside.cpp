// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/aside.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/normal_form.h"
#include "porttool/normal/statements.h"
#include "porttool/text/letters.h"

namespace porttool {
namespace {

using Text = std::vector<std::string>;

/// True if what stands from there on is nothing but the way to a value: `& p -> box . min [ 0 ]`.
bool is_path(const Text& words, size_t first) {
    for (size_t i = first; i < words.size(); ++i) {
        const bool mark = words[i] == "." || words[i] == "->" || words[i] == "[" || words[i] == "]" || words[i] == "::";
        const bool points = i == first && (words[i] == "&" || words[i] == "*");
        if (!mark && !points && !is_word_token(words[i]) && !is_number_token(words[i])) return false;
    }
    return true;
}

constexpr std::array<std::string_view, 9> kClocks = {"gettimeofday", "tvsec",  "tvusec",  "clock", "timer",
                                                     "elapsed",      "chrono", "gettime", "profil"};
constexpr std::array<std::string_view, 12> kAsides = {"print", "log",   "assert", "cout", "cerr",  "trace",
                                                      "debug", "debug", "error",  "warn", "throw", "abort"};

/// What a host asks of a runtime, each in its own way.
constexpr std::array<std::string_view, 11> kRuntime = {"memcpy",    "memset",       "malloc", "synchron",
                                                       "enqueue",   "createbuffer", "setarg", "setkernelarg",
                                                       "lasterror", "cudafree",     "hipfree"};

/// What locals are called that say how a kernel is launched.
constexpr std::array<std::string_view, 11> kLaunch = {"blocksize",  "worksize",  "localsize", "groupsize",
                                                      "numthreads", "wgsize",    "teamsize",  "threadsper",
                                                      "blockdim",   "sharedmem", "gridsize"};

/// True for the head of the unit, be it behind lines of attributes.
bool is_head(const Text& words) {
    for (size_t i = 0; i + 1 < words.size() && words[i] != "="; ++i)
        if (words[i] == "@" && words[i + 1] == "(") return i > 0 && is_word_token(words[i - 1]);
    return false;
}

}  // namespace

bool is_bare_return(const Text& written) { return !written.empty() && written[0] == "return" && is_path(written, 1); }

bool is_bare_declaration(const Text& written) {
    if (written.empty() || written[0] == "return" || word_is(written[0], kGoesOn)) return false;
    size_t names = 0, end = 0;  // of the words before the value, without those of an index or a size
    int depth = 0;
    std::string name;
    for (; end < written.size(); ++end) {
        const std::string& word = written[end];
        depth += word == "[" ? 1 : word == "]" ? -1 : 0;
        if (depth > 0 || word == "]") continue;
        if (word == "=" || word == "(") break;
        if (word == "." || word == "->" || word == "++" || word == "--" || word.ends_with("=")) return false;
        if (!is_word_token(word)) continue;
        name = word;
        ++names;
    }
    if (names < 2) return false;
    if (end == written.size()) return true;
    if (written[end] == "=" && is_path(written, end + 1)) return true;
    bool numbers = true;
    for (size_t i = end + 1; i < written.size(); ++i) {
        if (i > end + 1 && written[i] == name) return true;
        const bool makes = is_type_word(written[i]) || folded(written[i]).starts_with("make");
        numbers = numbers && (!is_word_token(written[i]) || makes);
    }
    return numbers;
}

bool moves_memory(const Text& words) {
    for (size_t i = 0; i + 1 < words.size(); ++i) {
        if (words[i + 1] != "(" || !is_word_token(words[i])) continue;
        const std::string small = folded(words[i]);
        if (is_one_of(small, {"free", "wait"}) || std::any_of(kRuntime.begin(), kRuntime.end(), [&](auto part) {
                return small.find(part) != std::string::npos;
            }))
            return true;
    }
    return false;
}

bool sizes_launch(const Text& words) {
    if (words.size() < 3 || words[1] != "=" || !is_word_token(words[0])) return false;
    const std::string plain = folded(words[0]);
    return std::any_of(kLaunch.begin(), kLaunch.end(),
                       [&](auto part) { return plain.find(part) != std::string::npos; });
}

bool is_aside(const Text& words) {
    if (words.empty() || words[0] == "#" || words[0] == "return") return !words.empty() && words[0] == "#";
    if (words[0] == "template" || words[0] == "&&" || words[0] == "||") return true;  // the rest of an `#if`
    const bool says = std::any_of(words.begin(), words.end(),
                                  [](const std::string& word) { return !word.empty() && word[0] == '"'; });
    const bool measures = std::any_of(words.begin(), words.end(), [](const std::string& word) {
        const std::string small = folded(word);
        return is_word_token(word) && std::any_of(kClocks.begin(), kClocks.end(), [&](std::string_view clock) {
                   return small.find(clock) != std::string::npos;
               });
    });
    if (says || measures) return true;
    for (size_t i = 0; i < words.size() && i < 4; ++i) {
        std::string small = folded(words[i]);
        const bool calls = i + 1 < words.size() && (words[i + 1] == "(" || words[i + 1] == "<<" || words[i + 1] == "<");
        if ((calls || words[i] == "throw") && std::any_of(kAsides.begin(), kAsides.end(), [&](std::string_view aside) {
                return small.find(aside) != std::string::npos && !(aside == "log" && small.size() <= 5);
            }))
            return true;
    }
    return false;
}

bool says_nothing(const Text& written) {
    const bool lone_else = written.size() == 1 && written[0] == "else";
    return is_aside(written) || is_bare_declaration(written) || is_head(written) || lone_else;
}

}  // namespace porttool
