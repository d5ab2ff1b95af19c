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
#include "porttool/normal/diff.h"
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
            if (word_is(words[i], kDropped) && i + 1 < words.size() && is_type_word(words[i + 1])) continue;
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

BySide<StatementEdit> edits_with_casts(const PairTexts& texts, const Dialect& dialect) {
    return {edit_with_casts(texts.source_before, texts.source_now, dialect),
            edit_with_casts(texts.target_before, texts.target_now, dialect)};
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

/// All that came on one side, as one.
struct AllGrouped {
    Text bare, loose, types;

    AllGrouped(const StatementEdit& edit, const Dialect& dialect) {
        for (const size_t i : edit.gained) {
            if (edit.now[i].is_brace()) {
                loose.push_back(edit.now[i].key);
                continue;
            }
            const GroupedStatement one(edit.now[i].common, dialect);
            bare.insert(bare.end(), one.bare.begin(), one.bare.end());
            loose.insert(loose.end(), one.loose.begin(), one.loose.end());
            loose.emplace_back(";");
            types.insert(types.end(), one.types.begin(), one.types.end());
        }
    }

    /// How it puts names and numbers together, whatever these are.
    Text shape() const {
        Text out;
        for (const std::string& word : loose)
            out.emplace_back(is_name_or_number(word) ? "n" : word == "[" ? "(" : word == "]" ? ")" : word);
        return out;
    }
};

/// Reads what came on one side beside what came on the other.
class Contradictions {
public:
    Contradictions(const PairTexts& texts, const Dialect& dialect)
        : here_(names_in(texts.source_before, dialect)), there_(names_in(texts.target_before, dialect)) {}

    bool are_between(const Text& here, const Text& there) {
        Text lost, gained;
        std::set<std::string> all_lost, all_gained;
        bool any = false;
        const auto end_hunk = [&] {
            for (size_t k = 0; lost.size() == gained.size() && k < lost.size(); ++k)
                any = any || contradict(lost[k], gained[k]);
            is_in_turn_ = is_in_turn_ && lost.size() == gained.size();
            lost.clear();
            gained.clear();
        };
        for (const DiffStep& step : diff(here, there)) {
            if (step.kind == DiffStep::Keep) {
                end_hunk();
            } else if (step.kind == DiffStep::Remove) {
                all_lost.insert(lost.emplace_back(here[step.before]));
            } else {
                all_gained.insert(gained.emplace_back(there[step.now]));
            }
        }
        end_hunk();
        return any || std::any_of(all_lost.begin(), all_lost.end(),
                                  [&](const std::string& word) { return all_gained.contains(word); });
    }

    /// True if each word of one side has its own of the other's beside it.
    bool is_in_turn() const { return is_in_turn_; }

private:
    static std::set<std::string> names_in(const Words& text, const Dialect& dialect) {
        std::set<std::string> out;
        for (const std::string_view word : text) {
            if (!is_word_token(word)) continue;
            std::string said = common_word(word, dialect);
            out.insert(said.empty() ? std::string(word) : std::move(said));
        }
        return out;
    }

    bool contradict(const std::string& here, const std::string& there) {
        if (!is_name_or_number(here) && !is_name_or_number(there)) return true;
        if (!is_word_token(here) || !is_word_token(there)) return false;
        if (!here_.contains(here) || !there_.contains(there)) return false;  // new, or of the language
        if (there_.contains(here) || here_.contains(there)) return true;
        return stands_for_.emplace(here, there).first->second != there ||
               stood_for_.emplace(there, here).first->second != here;
    }

    std::set<std::string> here_, there_;
    std::map<std::string, std::string> stands_for_, stood_for_;
    bool is_in_turn_ = true;
};

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

/// True if an edit puts the words of a statement into other brackets.
bool puts_in_other_brackets(const StatementEdit& edit, const Dialect& dialect) {
    return worst_of(grouped(edit.now, &edit.gained, dialect), grouped(edit.before, &edit.lost, dialect), {}) ==
           Grouping::OtherBrackets;
}

}  // namespace

Grouping grouping_of_edits(const PairTexts& texts, const Dialect& dialect) {
    const auto [source, target] = edits_with_casts(texts, dialect);
    return worst_of(grouped(source.now, &source.gained, dialect), grouped(target.now, &target.gained, dialect),
                    own_types(texts.source_before, texts.target_before));
}

bool edits_contradict(const PairTexts& learned, const Dialect& dialect) {
    const auto [source, target] = edits_with_casts(learned, dialect);
    if (puts_in_other_brackets(source, dialect) != puts_in_other_brackets(target, dialect)) return true;
    const AllGrouped here(source, dialect), there(target, dialect);
    Contradictions found(learned, dialect);
    if (found.are_between(here.bare, there.bare)) return true;
    if (!found.is_in_turn()) return here.bare.size() == there.bare.size();
    if (here.shape() != there.shape()) return true;
    const std::set<std::string> own = own_types(learned.source_before, learned.target_before);
    return here.types.size() == there.types.size() &&
           !std::equal(here.types.begin(), here.types.end(), there.types.begin(),
                       [&](const std::string& a, const std::string& b) {
                           return a == b || (own.contains(a) && own.contains(b));
                       });
}

Grouping grouping_of_edit(const LoneTexts& texts, const Dialect& dialect) {
    const StatementEdit edit = edit_with_casts(texts.before, texts.now, dialect),
                        other = edit_with_casts(texts.other, texts.other, dialect);
    return worst_of(grouped(edit.now, &edit.gained, dialect), grouped(other.now, nullptr, dialect),
                    own_types(texts.before, texts.other));
}

}  // namespace porttool
