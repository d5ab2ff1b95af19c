// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/scan/macros.h"

#include <algorithm>
#include <set>
#include <unordered_map>

#include "porttool/language/words.h"

namespace porttool {
namespace {

constexpr size_t kLongestReplacement = 256;  // tokens; longer macros build code, not names

bool is_word_character(char c) {
    return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// The function's name in an expanded macro: the word before the first parenthesis, or the only word.
MadeHead head_in(const std::vector<std::string>& words, bool whole_head) {
    MadeHead head;
    for (size_t i = 0; i < words.size(); ++i) {
        head.kernel = head.kernel || word_is(words[i], kKernelMacro);
        if (i > 0 && words[i] == "(" && !word_is(words[i - 1], kTakesArguments)) {
            head.name = words[i - 1];
            return head;
        }
    }
    if (!whole_head && words.size() == 1) head.name = words[0];
    if (whole_head && words.size() == 2 && word_is(words[0], kOpensType)) head.name = words[1];
    return head;
}

}  // namespace

bool is_function_like(const LexedText& lexed, uint32_t name) {
    const Token& token = lexed.tokens[name];
    const Token& next = lexed.tokens[name + 1];
    return lexed.view(next) == "(" && next.offset == token.offset + token.length;
}

MacroTable read_macros(const LexedText& lexed) {
    MacroTable table;
    for (const Directive& directive : lexed.directives) {
        if (directive.kind != DirectiveKind::Define || directive.end_token < directive.first_token + 5) continue;
        const uint32_t name = directive.first_token + 2;
        if (directive.end_token - name > kLongestReplacement || !is_function_like(lexed, name)) continue;
        Macro macro;
        uint32_t at = name + 2;
        for (; at < directive.end_token && lexed.view(at) != ")"; ++at)
            if (lexed.tokens[at].kind == TokenKind::Identifier) macro.parameters.emplace_back(lexed.view(at));
        for (++at; at < directive.end_token; ++at) {
            // `##` arrives as two tokens
            if (lexed.view(at) == "#" && at + 1 < directive.end_token && lexed.view(at + 1) == "#") {
                macro.replacement.emplace_back("##");
                ++at;
            } else {
                macro.replacement.emplace_back(lexed.view(at));
            }
        }
        table.emplace(std::string(lexed.view(name)), std::move(macro));
    }
    return table;
}

std::vector<std::string_view> spelling_macros(const LexedText& lexed) {
    std::vector<const Directive*> defines;
    std::vector<std::string_view> found;
    const auto name_of = [&](const Directive& define) { return lexed.view(define.first_token + 2); };
    for (const Directive& directive : lexed.directives) {
        if (directive.kind != DirectiveKind::Define || directive.end_token < directive.first_token + 5 ||
            !is_function_like(lexed, directive.first_token + 2))
            continue;
        defines.push_back(&directive);
        for (uint32_t at = directive.first_token + 4; at < directive.end_token; ++at) {
            if (lexed.view(at) != "#") continue;
            found.push_back(name_of(directive));
            break;
        }
    }
    if (found.empty()) return found;
    std::unordered_map<std::string_view, std::vector<const Directive*>> users;  // by each word of their replacements
    for (const Directive* define : defines)
        for (uint32_t at = define->first_token + 4; at < define->end_token; ++at)
            if (lexed.tokens[at].kind == TokenKind::Identifier) users[lexed.view(at)].push_back(define);
    std::set<std::string_view> all(found.begin(), found.end());
    for (; !found.empty();) {
        const std::string_view macro = found.back();
        found.pop_back();
        for (const Directive* user : users[macro])
            if (all.insert(name_of(*user)).second) found.push_back(name_of(*user));
    }
    return {all.begin(), all.end()};
}

std::vector<std::string> expand(const Macro& macro, const std::vector<std::string>& arguments) {
    std::vector<std::string> out;
    bool paste = false;
    for (const std::string& word : macro.replacement) {
        if (word == "##") {
            paste = true;
            continue;
        }
        const auto parameter = std::find(macro.parameters.begin(), macro.parameters.end(), word);
        const auto index = static_cast<size_t>(parameter - macro.parameters.begin());
        const std::string& text = index < arguments.size() ? arguments[index] : word;
        if (paste && !out.empty())
            out.back() += text;
        else
            out.push_back(text);
        paste = false;
    }
    return out;
}

bool redefines_word(std::string_view macro) { return word_is(macro, kNoFunctionName | kShapeWord); }

bool defines_something(const MacroTable& macros, std::string_view macro) {
    const auto known = macros.find(macro);
    if (known == macros.end()) return false;
    const auto& words = known->second.replacement;
    return std::find(words.begin(), words.end(), "{") != words.end() || (!words.empty() && words.back() == ";");
}

bool opens_type(const MacroTable& macros, std::string_view macro) {
    const auto known = macros.find(macro);
    if (known == macros.end()) return false;
    const auto& words = known->second.replacement;
    return !words.empty() && word_is(words.front(), kOpensType) &&
           std::find(words.begin(), words.end(), "(") == words.end();
}

MadeHead head_made_by(const MacroTable& macros, std::string_view macro, const std::vector<std::string>& arguments,
                      bool whole_head) {
    MadeHead head;
    if (const auto known = macros.find(macro); known != macros.end())
        head = head_in(expand(known->second, arguments), whole_head);
    if (!head.name.empty()) return head;
    for (std::string text : arguments) {
        std::erase_if(text, [](char c) { return !is_word_character(c); });
        if (!text.empty()) head.name += (head.name.empty() ? "" : "_") + text;
    }
    if (head.name.empty()) head.name = macro;
    return head;
}

}  // namespace porttool
