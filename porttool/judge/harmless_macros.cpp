// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/harmless_macros.h"

#include <algorithm>
#include <string>
#include <vector>

#include "porttool/compare/runtime_calls.h"
#include "porttool/language/words.h"
#include "porttool/normal/normal_text.h"
#include "porttool/scan/macros.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

/// A macro's definition, token by token.
struct Definition {
    bool has_parameters = false;
    std::vector<std::string_view> parameters;
    std::vector<std::string_view> body;

    bool is_parameter(std::string_view word) const {
        return std::find(parameters.begin(), parameters.end(), word) != parameters.end();
    }
    std::string_view at(size_t i) const { return i < body.size() ? body[i] : std::string_view(); }
};

Definition definition_of(const NewWord& macro) {
    const LexedText& lexed = macro.file->lexed;
    uint32_t at = macro.said.name_token;
    Definition out;
    out.has_parameters = at + 1 < macro.said.tokens.end && is_function_like(lexed, at);
    ++at;
    if (out.has_parameters) {
        for (; at < macro.said.tokens.end && lexed.view(at) != ")"; ++at) {
            if (is_word_token(lexed.view(at))) out.parameters.push_back(lexed.view(at));
            if (lexed.view(at) == "...") out.parameters.emplace_back("__VA_ARGS__");
        }
        ++at;
    }
    for (; at < macro.said.tokens.end; ++at) out.body.push_back(lexed.view(at));
    return out;
}

/// The bracket that closes the one at `i`, or the end.
size_t closing(const std::vector<std::string_view>& body, size_t i) {
    int depth = 0;
    for (; i < body.size(); ++i) {
        depth += is_one_of(body[i], {"(", "[", "{"}) ? 1 : is_one_of(body[i], {")", "]", "}"}) ? -1 : 0;
        if (depth == 0) return i;
    }
    return i;
}

bool is_idle_attribute(std::string_view word) {
    if (word.size() > 4 && word.starts_with("__") && word.ends_with("__")) word = word.substr(2, word.size() - 4);
    return word_is(word, kIdleAttribute);
}

/// True for a word that only says how a function is called or linked, or where it runs or a value lies.
bool is_promise(std::string_view word, bool in_body) {
    if (in_body && is_one_of(word, {"static", "extern"})) return false;
    const bool is_place = word.starts_with("__") && word_is(word, kDropped) && !word_is(word, kSharedStorage);
    return is_place || word_is(word, kPromise | kHeadPromise) || is_one_of(word, {"highp", "mediump", "lowp"});
}

constexpr int kMostDefinitions = 256;      ///< that one question leads to
constexpr uint32_t kLongestPromise = 256;  ///< tokens
constexpr size_t kMostParameters = 64;

/// What is asked of other macros.
struct Within {
    bool in_body = false;
    const MacrosNamed& macros;
    int& left;  ///< definitions that may be looked at yet
};

bool only_promises_in(const std::vector<std::string_view>& body, const Within& where);

/// True for a macro that stands for promises alone, wherever it is defined.
bool is_macro_of_promises(std::string_view word, const Within& where) {
    const std::vector<NewWord>& all = where.macros(word);
    return !all.empty() && std::all_of(all.begin(), all.end(), [&](const NewWord& one) {
        if (--where.left < 0 || one.said.tokens.end - one.said.tokens.first > kLongestPromise) return false;
        const Definition macro = definition_of(one);
        return !macro.has_parameters && only_promises_in(macro.body, where);
    });
}

/// True for promises and attributes alone.
bool only_promises_in(const std::vector<std::string_view>& body, const Within& where) {
    for (size_t i = 0; i < body.size(); ++i) {
        const bool is_group = is_one_of(body[i], {"__attribute__", "__attribute", "__declspec"});
        if (is_group || (body[i] == "[" && i + 1 < body.size() && body[i + 1] == "[")) {
            const size_t open = is_group ? i + 1 : i, end = open < body.size() ? closing(body, open) : body.size();
            if (end >= body.size() || (is_group && body[open] != "(")) return false;
            for (i = open; i < end; ++i)
                if (is_word_token(body[i]) && !is_idle_attribute(body[i]) && !is_one_of(body[i], {"gnu", "clang"}))
                    return false;
        } else if (body[i] == "__launch_bounds__" && i + 1 < body.size() && body[i + 1] == "(") {
            i = closing(body, i + 1);
        } else if (!(body[i] == "\"C\"" && i > 0 && body[i - 1] == "extern") && !is_promise(body[i], where.in_body) &&
                   !is_macro_of_promises(body[i], where)) {
            return false;
        }
    }
    return true;
}

/// The one type that words name, under its common name; "" for what is not known.
std::string type_named(const std::vector<std::string_view>& words, const Dialect& dialect) {
    std::string joined;
    for (size_t i = 0; i < words.size(); ++i) {
        if (is_one_of(words[i], {"std", "glm", "::"}) || is_promise(words[i], true)) continue;
        if (words[i] == "int" && words.size() > 1 && word_is(joined.substr(joined.rfind(' ') + 1), kTypePart)) continue;
        joined += (joined.empty() ? "" : " ") + std::string(words[i]);
    }
    constexpr std::pair<std::string_view, std::string_view> kLong[] = {
        {"unsigned char", "uint8_t"}, {"signed char", "int8_t"},          {"unsigned short", "uint16_t"},
        {"long long", "int64_t"},     {"unsigned long long", "uint64_t"}, {"unsigned long", "uint64_t"},
        {"long", "int64_t"},          {"signed long long", "int64_t"},    {"signed short", "short"}};
    for (const auto& [spelled, type] : kLong)
        if (joined == spelled) joined = type;
    const std::string* known = dialect.meaning(joined);
    return known == nullptr ? joined : *known;
}

bool names_same_type(std::string_view word, const std::vector<std::string_view>& words, const Dialect& dialect) {
    const std::string same = type_named({word}, dialect);
    return !same.empty() && type_named(words, dialect) == same;
}

/// `typedef unsigned int uint32_t`, `using uint32_t = unsigned int`, `using std::uint32_t`: without the word itself.
std::vector<std::string_view> aliased(const NewWord& said) {
    std::vector<std::string_view> out;
    for (uint32_t at = said.said.tokens.first; at < said.said.tokens.end; ++at) {
        const std::string_view word = said.file->lexed.view(at);
        const bool is_name = at == said.said.name_token && said.said.kind == DeclaredWord::Kind::Type;
        if (!is_name && !is_one_of(word, {"typedef", "using", "=", ";"})) out.push_back(word);
    }
    return out;
}

bool is_other_name(const std::vector<std::string_view>& body, LeftOutAs as) {
    return body.size() == 1 && is_word_token(body[0]) &&
           (as == LeftOutAs::Check ? says_that_it_checks(body[0]) : !word_is(body[0], ~Roles{0}));
}

/// False where something else than a variable of the macro's own is given a value, or the caller is left.
bool keeps_values(const Definition& macro, bool may_leave) {
    for (size_t i = 0; i < macro.body.size(); ++i) {
        const std::string_view word = macro.body[i];
        if (is_one_of(word, {"++", "--", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>=", "goto", "break",
                             "continue"}) ||
            (!may_leave && word == "return"))
            return false;
        if (word != "=") continue;
        const auto is_name = [&](size_t k) { return k < i && is_word_token(macro.at(k)); };
        const bool declares = i >= 2 && is_name(i - 1) && !macro.is_parameter(macro.at(i - 1)) &&
                              (is_name(i - 2) || (i >= 3 && is_one_of(macro.at(i - 2), {"*", "&"}) && is_name(i - 3)));
        if (!declares) return false;
    }
    return true;
}

/// The place of a parameter that stands in a body once, but for where it is spelled, `#x`; the end of the body else.
size_t only_use(const Definition& macro, std::string_view parameter) {
    size_t out = macro.body.size(), count = 0;
    for (size_t i = 0; i < macro.body.size(); ++i)
        if (macro.body[i] == parameter && (i == 0 || macro.body[i - 1] != "#")) out = i, ++count;
    return count == 1 ? out : macro.body.size();
}

/// True if what a parameter stands for is called.
bool calls_parameter(const Definition& macro) {
    for (size_t i = 0; i < macro.body.size(); ++i)
        if (macro.is_parameter(macro.body[i]) &&
            (macro.at(i + 1) == "(" || (macro.at(i + 1) == ")" && macro.at(i + 2) == "(")))
            return true;
    return false;
}

/// True if the first parameter is evaluated once, as it is, whatever else is seen of its value.
bool evaluates_once(const Definition& macro) {
    if (macro.parameters.empty() || calls_parameter(macro)) return false;
    const size_t place = only_use(macro, macro.parameters[0]);
    if (place >= macro.body.size() || !keeps_values(macro, true)) return false;
    for (size_t i = 0; i < place; ++i) {
        const std::string_view word = macro.body[i];
        if (is_one_of(word, {"?", "&&", "||", "[", "while", "for", "else", "switch", "sizeof", "decltype", "typeof",
                             "__typeof__", "alignof", "noexcept", "typeid", "return", "throw", "asm", "__asm__"}))
            return false;
        if (word == "if" && (macro.at(i + 1) != "(" || closing(macro.body, i + 1) < place)) return false;
    }
    size_t left = place, right = place + 1;  // around it and its parentheses
    const auto is_called = [&](size_t open) { return open > 0 && is_word_token(macro.at(open - 1)); };  // `report(x)`
    while (left > 0 && macro.at(left - 1) == "(" && macro.at(right) == ")" && !is_called(left - 1)) --left, ++right;
    const std::string_view before = left > 0 ? macro.at(left - 1) : "", after = macro.at(right);
    return (before.empty() || is_one_of(before, {"(", "=", "{", ";", ")", ",", ">"})) &&
           (after.empty() || is_one_of(after, {")", ";", ",", "}", "!=", "=="}));
}

/// `(void)(x)`, also of several, and what hides it from the compiler.
bool throws_away(const Definition& macro) {
    if (!macro.has_parameters) return false;
    for (size_t i = 0; i < macro.body.size(); ++i) {
        const std::string_view word = macro.body[i], next = macro.at(i + 1);
        const bool is_cast = word == ")" && i > 0 && macro.at(i - 1) == "void";
        const bool calls = next == "(" && (macro.is_parameter(word) || (word == ")" && !is_cast));
        const bool loops = word == "while" && macro.at(i + 2) != "0";
        const bool is_known =
            macro.is_parameter(word) || is_one_of(word, {"(", ")", "void", "do", "{", "}", "while", "0", ";", ",",
                                                         "static_cast", "<", ">", "sizeof"});
        if (!is_known || calls || loops) return false;
    }
    return true;
}

bool is_harmless_macro(const Definition& macro, LeftOutAs as, std::string_view word, const Within& where,
                       const Dialect& dialect) {
    if (macro.parameters.size() > kMostParameters) return false;
    switch (as) {
        case LeftOutAs::Unused:
            return throws_away(macro);
        case LeftOutAs::Check:
            return macro.has_parameters ? evaluates_once(macro) : is_other_name(macro.body, as);
        case LeftOutAs::Launch:
            return macro.has_parameters && keeps_values(macro, false) && macro.at(1) != "sizeof" &&
                   std::all_of(macro.parameters.begin(), macro.parameters.end(),
                               [&](std::string_view one) { return only_use(macro, one) < macro.body.size(); });
        case LeftOutAs::Aside:
            return macro.has_parameters ? keeps_values(macro, false) && !calls_parameter(macro)
                                        : is_other_name(macro.body, as);
        case LeftOutAs::Local:
            return false;
        case LeftOutAs::Word:
            break;
    }
    if (const std::string* known = dialect.meaning(word); known != nullptr && !known->empty())
        return !macro.has_parameters && names_same_type(word, macro.body, dialect);
    const bool counts_storage = where.in_body || is_one_of(word, {"static", "extern"});
    if (macro.body.empty()) return !word_is(word, ~Roles{0}) || is_promise(word, counts_storage);
    return only_promises_in(macro.body, {counts_storage, where.macros, where.left});
}

}  // namespace

bool is_harmless(const NewWord& said, LeftOutAs as, bool in_body, const Dialect& dialect, const MacrosNamed& macros) {
    int left = kMostDefinitions;
    if (said.said.kind == DeclaredWord::Kind::Macro)
        return is_harmless_macro(definition_of(said), as, said.word(), {in_body, macros, left}, dialect);
    return as == LeftOutAs::Word && names_same_type(said.word(), aliased(said), dialect);
}

bool is_harmless_within(const NewWord& said, LeftOutAs as, bool in_body, const Dialect& dialect,
                        const MacrosNamed& macros) {
    const Definition macro = definition_of(said);
    const bool has_words = std::any_of(macro.body.begin(), macro.body.end(), is_word_token);
    if (!macro.has_parameters && !macro.body.empty() && !has_words)
        return true;  // a number, whose edit is told as such
    int left = kMostDefinitions;
    if (as == LeftOutAs::Word || macro.has_parameters)
        return is_harmless_macro(macro, as, said.word(), {in_body, macros, left}, dialect);
    const bool evaluates = std::none_of(macro.body.begin(), macro.body.end(), [](std::string_view word) {
        return is_one_of(word, {"sizeof", "decltype", "typeof", "__typeof__", "alignof", "noexcept", "&&", "||", "?"});
    });
    return evaluates && keeps_values(macro, false);
}

}  // namespace porttool
