// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/grouping.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/compare/casts.h"
#include "porttool/compare/hints.h"
#include "porttool/compare/phrases.h"
#include "porttool/compare/side_by_side.h"
#include "porttool/compare/statement_edit.h"
#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/normal_form.h"
#include "porttool/normal/statements.h"

namespace porttool {
namespace {

using Text = std::vector<std::string>;

/// The types of numbers that are no matter of manner; whole ones are one here. "" for others.
std::string_view kind_of_number(std::string_view type) {
    if (is_one_of(type, {"float", "double", "half", "bool"})) return type;
    return is_one_of(type, {"int", "uint", "unsigned", "long", "ulong", "short", "ushort", "char", "uchar", "size_t",
                            "int8_t", "uint8_t", "int16_t", "uint16_t", "int32_t", "uint32_t", "int64_t", "uint64_t"})
               ? "int"
               : "";
}

constexpr std::string_view kCast = "cast_";

/// A statement as it puts its names, numbers and signs together.
struct GroupedStatement {
    Text bare;     ///< these alone
    Text grouped;  ///< with brackets, those of casts of more than one value among them
    Text loose;    ///< without those
    Text types;    ///< of numbers, and "&" where a name is declared to stand for another value

    GroupedStatement(const Text& words, const Dialect& dialect) {
        const Text plain = without_scopes(words);
        grouped = in_common_words(without_idle_parentheses(without_casts(plain, true)), dialect);
        types.clear();
        loose = in_common_words(without_idle_parentheses(without_casts(plain, false)), dialect);
        std::copy_if(loose.begin(), loose.end(), std::back_inserter(bare), [](const std::string& word) {
            return !is_one_of(word, {"(", ")", "[", "]", ",", ":"});
        });
    }

private:
    static Text in_common_words(const Text& words, const Dialect& dialect) {
        Text out;
        for (size_t i = 0; i < words.size(); ++i) {
            std::string said = is_word_token(words[i]) ? common_word(words[i], dialect) : words[i];
            if (said.empty()) said = words[i];
            if (is_number_token(said)) said = number_value(said);
            if (is_name_or_number(said) || is_operator(words, i, 0) || is_one_of(said, {"(", ")", "[", "]", ",", ":"}))
                out.push_back(std::move(said));
        }
        return out;
    }

    static Text without_scopes(const Text& words) {
        Text out;
        for (size_t i = 0; i < words.size(); ++i) {
            if (words[i] == "::") {
                if (!out.empty() && is_word_token(out.back())) out.pop_back();
                continue;
            }
            out.push_back(words[i]);
        }
        return out;
    }

    /// True if the type at `i` is that of a cast of more than one value: `int ( x * y )`.
    static bool is_cast_of_more(const Text& words, size_t i) {
        if (i + 1 >= words.size() || words[i + 1] != "(") return false;
        for (size_t k = i + 2; k < words.size() && words[k] != ")"; ++k)
            if (words[k] == "(" || is_operator(words, k, 0)) return true;
        return false;
    }

    /// Without types, and casts of more than one value marked, if that is wanted.
    Text without_casts(const Text& words, bool marks_casts) {
        Text out;
        bool is_constant = false;
        for (size_t i = 0; i < words.size(); ++i) {
            if (words[i] == "const") is_constant = true;
            if (word_is(words[i], kPromise) || words[i] == "const") continue;
            if (!is_type_word(words[i])) {
                out.push_back(words[i]);
                continue;
            }
            if (const std::string_view kind = kind_of_number(words[i]); !kind.empty()) types.emplace_back(kind);
            if (marks_casts && is_cast_of_more(words, i)) out.emplace_back(kCast);
            const bool refers = i + 1 < words.size() && words[i + 1] == "&";
            if (refers && !is_constant) types.emplace_back("&");
            if (refers || (i + 1 < words.size() && words[i + 1] == "*")) ++i;
        }
        return out;
    }
};

/// The statements that an edit brought, or all of a text.
std::vector<GroupedStatement> grouped(const std::vector<Statement>& statements, const std::vector<size_t>* chosen,
                                      const Dialect& dialect) {
    constexpr size_t kMost = 2000;
    std::vector<GroupedStatement> out;
    const size_t size = chosen != nullptr ? chosen->size() : statements.size();
    for (size_t k = 0; k < std::min(size, kMost); ++k) {
        const Statement& statement = statements[chosen != nullptr ? (*chosen)[k] : k];
        if (!statement.is_brace()) out.emplace_back(statement.common, dialect);
    }
    return out;
}

StatementEdit edit_with_casts(const Words& before, const Words& now, const Dialect& dialect) {
    return statement_edit(without_hints(before), without_hints(now), [&](const Words& statement, bool) {
        const Words words = with_one_word_types(statement);
        return with_functional_casts(with_c_casts({words.begin(), words.end()}, dialect), dialect);
    });
}

/// `own`: types of which each side has its own, throughout.
Grouping worst_of(const std::vector<GroupedStatement>& here, const std::vector<GroupedStatement>& there,
                  const std::set<std::string>& own) {
    constexpr size_t kLeast = 3;  // words that are the same by no chance
    std::map<Text, std::vector<const GroupedStatement*>> by_words;
    for (const GroupedStatement& one : there) by_words[one.bare].push_back(&one);
    const auto counted = [&](const Text& types) {
        Text out;
        for (const std::string& type : types)
            if (!own.contains(type)) out.push_back(type);
        return out;
    };
    Grouping out = Grouping::Alike;
    for (const GroupedStatement& one : here) {
        const auto found = by_words.find(one.bare);
        if (one.bare.size() < kLeast || found == by_words.end()) continue;
        Grouping best = Grouping::OtherBrackets;
        for (const GroupedStatement* other : found->second) {
            const bool is_one = other->grouped == one.grouped;
            const bool lacks_casts = other->types.size() != one.types.size() && other->loose == one.loose;
            if (is_one || lacks_casts)
                best = std::min(best, is_one && counted(one.types) == counted(other->types) ? Grouping::Alike
                                                                                            : Grouping::OtherTypes);
        }
        out = std::max(out, best);
    }
    return out;
}

/// Types of numbers that one of two texts has and the other has not.
std::set<std::string> own_types(const Words& here, const Words& there) {
    const auto types_in = [](const Words& text) {
        std::set<std::string> out;
        for (const std::string_view word : text)
            if (const std::string_view kind = kind_of_number(word); !kind.empty()) out.emplace(kind);
        return out;
    };
    const std::set<std::string> a = types_in(here), b = types_in(there);
    std::set<std::string> out;
    std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::inserter(out, out.end()));
    return out;
}

}  // namespace

Grouping grouping_of_edits(const PairTexts& texts, const Dialect& dialect) {
    const StatementEdit source = edit_with_casts(texts.source_before, texts.source_now, dialect),
                        target = edit_with_casts(texts.target_before, texts.target_now, dialect);
    return worst_of(grouped(source.now, &source.gained, dialect), grouped(target.now, &target.gained, dialect),
                    own_types(texts.source_before, texts.target_before));
}

Grouping grouping_of_edit(const LoneTexts& texts, const Dialect& dialect) {
    const StatementEdit edit = edit_with_casts(texts.before, texts.now, dialect),
                        other = edit_with_casts(texts.other, texts.other, dialect);
    return worst_of(grouped(edit.now, &edit.gained, dialect), grouped(other.now, nullptr, dialect),
                    own_types(texts.before, texts.other));
}

}  // namespace porttool
