// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/bare_declaration.h"

#include <algorithm>
#include <utility>

#include "porttool/language/words.h"
#include "porttool/normal/normal_text.h"
#include "porttool/sync/operands.h"

namespace porttool {
namespace {

/// Behind the brackets that begin at `i`; `end` if they do not close.
size_t behind_brackets(const std::vector<std::string>& words, size_t i, size_t end) {
    int depth = 0;
    for (; i < end; ++i) {
        depth += words[i] == "[" ? 1 : words[i] == "]" ? -1 : 0;
        if (depth == 0) return i + 1;
    }
    return end;
}

}  // namespace

std::optional<BareDeclaration> bare_declaration(const AlignedText& text, const Clause& clause) {
    const std::vector<std::string>& words = text.words;
    if (clause.opens || clause.closes || clause.size() < 3 || words[clause.end - 1] != ";") return std::nullopt;
    size_t i = clause.first;
    while (i < clause.end && is_word_token(words[i])) ++i;
    if (i < clause.first + 1) return std::nullopt;
    // The last word is a name already, unless a `*` comes between.
    if (i < clause.end && words[i] != "*") --i;
    BareDeclaration out;
    out.type.assign(words.begin() + static_cast<std::ptrdiff_t>(clause.first),
                    words.begin() + static_cast<std::ptrdiff_t>(i));
    if (out.type.empty() || is_one_of(out.type.front(), {"return", "goto", "delete", "throw", "using", "typedef"}))
        return std::nullopt;
    out.is_plain = is_type_word(out.type.back()) || out.type.back() == "dim3";
    bool all_pointers = true;
    while (i < clause.end) {
        const bool is_pointer = words[i] == "*";
        while (i < clause.end && words[i] == "*") ++i;
        if (i >= clause.end || !is_name(words[i])) return std::nullopt;
        all_pointers &= is_pointer;
        out.names.insert(words[i++]);
        while (i < clause.end && words[i] == "[") i = behind_brackets(words, i, clause.end);
        if (i >= clause.end || !is_one_of(words[i], {",", ";"})) return std::nullopt;
        if (words[i++] == ";") break;
    }
    out.is_plain |= all_pointers;
    return i == clause.end ? std::optional(std::move(out)) : std::nullopt;
}

bool declares_all(const AlignedText& text, const BareDeclaration& declaration) {
    std::set<std::string> missing = declaration.names;
    for (const Clause& clause : text.clauses)
        if (const auto one = bare_declaration(text, clause); one && one->type == declaration.type)
            for (const std::string& name : one->names) missing.erase(name);
    return missing.empty();
}

}  // namespace porttool
