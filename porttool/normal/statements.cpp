// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/normal/statements.h"

#include <algorithm>

#include "porttool/language/words.h"
#include "porttool/normal/directive_end.h"
#include "porttool/normal/literal.h"
#include "porttool/normal/normal_form.h"
#include "porttool/text/letters.h"

namespace porttool {
namespace {

std::vector<std::string> translate(const Words& tokens, const Dialect& dialect) {
    std::vector<std::string> out;
    for (size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i] == "::") {  // scopes come and go: a::b is b
            if (!out.empty() && i > 0 && is_word_token(tokens[i - 1]) &&
                out.back() == common_word(tokens[i - 1], dialect))
                out.pop_back();
            continue;
        }
        std::string word = common_word(tokens[i], dialect);
        if (!word.empty()) out.push_back(std::move(word));
    }
    return out;
}

/// True for a token of one letter that is one of these.
bool is_any_of(std::string_view token, std::string_view letters) {
    return token.size() == 1 && letters.find(token[0]) != std::string_view::npos;
}

/// True for a bracket that stands without a space behind this token: that of a call.
bool opens_call(std::string_view bracket, std::string_view before) {
    return bracket == "(" && before.find_first_of("+-*/<>&|,?:") == std::string_view::npos && before != "=" &&
           before != "if" && before != "for" && before != "while" && before != "return";
}

std::string readable(const Words& tokens) {
    std::string out;
    for (size_t i = 0; i < tokens.size(); ++i) {
        const std::string_view token = tokens[i], before = i > 0 ? tokens[i - 1] : "";
        const bool tight = i == 0 || is_any_of(token, "),;.[]") || token == "->" || token == "::" ||
                           is_any_of(before, "(.[") || before == "->" || before == "::" || opens_call(token, before);
        if (!tight) out += ' ';
        out += token;
    }
    return out;
}

Statement make_statement(const Words& tokens, std::vector<std::string> common, size_t head) {
    Statement statement;
    statement.shown = readable(tokens);
    statement.common = std::move(common);
    statement.head = head;
    for (const std::string& word : statement.common) {
        statement.key += word;
        statement.key += ' ';
    }
    return statement;
}

/// True for a text that ends as what stands before a lambda's body: `[&](int i)`, `[=]`, `[this]() mutable`.
bool ends_lambda_head(const Words& words) {
    size_t end = words.size();
    while (end > 0 && (words[end - 1] == "mutable" || words[end - 1] == "noexcept")) --end;
    if (end > 0 && words[end - 1] == ")") {
        int depth = 0;
        while (end > 0) {
            --end;
            depth += words[end] == ")" ? 1 : words[end] == "(" ? -1 : 0;
            if (depth == 0) break;
        }
    }
    if (end == 0 || words[end - 1] != "]") return false;
    while (end > 0 && words[end - 1] != "[") --end;
    // What stands before the bracket tells a capture from an index.
    return end > 1 && !is_word_token(words[end - 2]) && words[end - 2] != "]" && words[end - 2] != ")";
}

/// True for words that stop behind the colon of a `? :`: what it gives otherwise is still to come.
bool stops_at_choice(const Words& words) {
    if (words.empty() || words[words.size() - 1] != ":") return false;
    int open = 0;
    for (const std::string_view word : words) open += word == "?" ? 1 : word == ":" ? -1 : 0;
    return open == 0 && words[0] != "case" && words.size() > 2;
}

/// True if a statement's words end, with this one more, as what controls another statement: `if ( a )`, `else`.
bool ends_control_head(const Words& words, std::string_view next) {
    if (words.empty()) return next == "else";
    return next == ")" && word_is(words[0], kControls);
}

}  // namespace

std::string folded(std::string_view word) {
    std::string out;
    for (const char c : word)
        if (c != '_') out += small_letter(c);
    return out.empty() ? std::string(word) : out;
}

std::string common_word(std::string_view token, const Dialect& dialect) {
    if (token.empty()) return {};
    if (const std::string* known = dialect.find(token)) return *known;
    if (is_number_token(token)) return number_value(token);
    return is_word_token(token) ? folded(token) : std::string(token);
}

std::vector<Statement> split_statements(const Words& tokens, const Translator& translator) {
    std::vector<Statement> out;
    Words current;
    std::vector<size_t> heads;   // of the blocks that are open
    std::vector<int> outside;    // of each that is a lambda's body how many parentheses are open around it, else 0
    int parens = 0, braces = 0;  ///< that are open; braces of literals
    bool in_body = false;
    size_t early_braces = 0;    ///< that the normal form closed at the colon of a `? :`
    std::vector<bool> implied;  // of each open block: it has no braces
    auto head = [&] { return heads.empty() ? Statement::kNoHead : heads.back(); };
    auto finish = [&] {
        if (!current.empty()) out.push_back(make_statement(current, translator(current, in_body), head()));
        current.clear();
    };
    const auto open_block = [&](size_t head_of_block, int parens_around, bool is_implied) {
        heads.push_back(head_of_block);
        outside.push_back(parens_around);
        implied.push_back(is_implied);
    };
    // A closing brace counts: a statement moved out of a block is another program.
    const auto close_block = [&] {
        out.push_back({"}", {"}"}, "}", head()});
        if (heads.empty()) return;
        if (outside.back() > 0) parens = outside.back();
        heads.pop_back();
        outside.pop_back();
        implied.pop_back();
    };
    // Blocks without braces end with their statement; an `else` goes on with the innermost.
    const auto close_implied = [&](std::string_view next) {
        while (!implied.empty() && implied.back()) {
            const bool goes_on = next == "else" && out[heads.back()].shown.starts_with("if");
            close_block();
            if (goes_on) return;
        }
    };
    for (size_t i = 0; i < tokens.size(); ++i) {
        const std::string_view token = tokens[i];
        // `if (c) x = a ? b : d;` has got its braces as `if (c) { x = a ? b : } d;`.
        if (token == "}" && parens == 0 && early_braces < implied.size() && stops_at_choice(current)) {
            implied[implied.size() - ++early_braces] = true;
            continue;
        }
        // A line of the preprocessor is no part of the statement that follows.
        if (const size_t end = parens > 0 || !current.empty() ? 0 : directive_end(tokens, i); end > i) {
            current.assign(tokens.begin() + static_cast<std::ptrdiff_t>(i),
                           tokens.begin() + static_cast<std::ptrdiff_t>(end));
            finish();
            i = end - 1;
            continue;
        }
        if (token == "(") ++parens;
        if (token == ")") --parens;
        // The body of a lambda that is an argument is a block as any other.
        if (parens == 0 && token == "{" && opens_literal(tokens, i < current.size() ? 0 : i - current.size(), i)) {
            ++braces;
        } else if (braces > 0 && token == "{") {
            ++braces;
        }
        if (braces > 0) {
            braces -= token == "}" ? 1 : 0;
            current.push_back(token);
            continue;
        }
        // Within a lambda that is an argument the normal form gives no braces to a single statement.
        if (parens == 0 && in_body && i + 1 < tokens.size() && tokens[i + 1] != "{" && tokens[i + 1] != ";" &&
            ends_control_head(current, token)) {
            current.push_back(token);
            finish();
            open_block(out.size() - 1, 0, true);
            continue;
        }
        const bool opens_lambda = token == "{" && parens > 0 && ends_lambda_head(current);
        if (!opens_lambda && (parens > 0 || (token != ";" && token != "{" && token != "}"))) {
            current.push_back(token);
            continue;
        }
        const bool headless = current.empty();
        finish();
        const std::string_view next = i + 1 < tokens.size() ? tokens[i + 1] : std::string_view();
        if (token == "{") {
            open_block(headless ? head() : out.size() - 1, opens_lambda ? parens : 0, false);
            if (opens_lambda) parens = 0;
            in_body = true;
        } else if (token == ";") {
            early_braces = 0;
            close_implied(next);
        } else {
            const bool goes_on = next == "else" && !heads.empty() && heads.back() != Statement::kNoHead &&
                                 out[heads.back()].shown.starts_with("if");
            close_block();
            if (!goes_on) close_implied(next);
        }
    }
    finish();
    return out;
}

std::vector<Statement> split_statements(const Words& tokens, const Dialect& dialect) {
    return split_statements(tokens, [&](const Words& statement, bool) { return translate(statement, dialect); });
}

}  // namespace porttool
