// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/statements.h"

#include <algorithm>

#include "porttool/compare/normal_form.h"

namespace porttool {
namespace {

bool is_word_start(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::vector<std::string> translate(const std::vector<std::string>& tokens, const Dialect& dialect) {
    std::vector<std::string> out;
    for (size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i] == "::") {  // scopes come and go: a::b is b
            if (!out.empty() && i > 0 && is_word_start(tokens[i - 1][0]) &&
                out.back() == common_word(tokens[i - 1], dialect))
                out.pop_back();
            continue;
        }
        std::string word = common_word(tokens[i], dialect);
        if (!word.empty()) out.push_back(std::move(word));
    }
    return out;
}

std::string readable(const std::vector<std::string>& tokens) {
    std::string out;
    for (size_t i = 0; i < tokens.size(); ++i) {
        const std::string& token = tokens[i];
        const std::string before = i > 0 ? tokens[i - 1] : "";
        const bool tight = i == 0 || token == ")" || token == "," || token == ";" || token == "." || token == "->" ||
                           token == "::" || token == "[" || token == "]" || before == "(" || before == "." ||
                           before == "->" || before == "::" || before == "[" ||
                           (token == "(" && before != "if" && before != "for" && before != "while" && before != "=" &&
                            before != "return" && before.find_first_of("+-*/<>&|,?:") == std::string::npos);
        if (!tight) out += ' ';
        out += token;
    }
    return out;
}

Statement make_statement(const std::vector<std::string>& tokens, std::vector<std::string> common, size_t head) {
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

}  // namespace

std::string folded(const std::string& word) {
    std::string out;
    for (const char c : word)
        if (c != '_') out += c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
    return out.empty() ? word : out;
}

std::string common_word(const std::string& token, const Dialect& dialect) {
    if (token.empty()) return token;
    if (const std::string* known = dialect.find(token)) return *known;
    if (is_digit(token[0]) || (token[0] == '.' && token.size() > 1 && is_digit(token[1]))) return number_value(token);
    return is_word_start(token[0]) ? folded(token) : token;
}

std::vector<Statement> split_statements(const std::vector<std::string>& tokens, const Translator& translator) {
    std::vector<Statement> out;
    std::vector<std::string> current;
    std::vector<size_t> heads;  // of the blocks that are open
    int parens = 0;
    bool in_body = false;
    auto head = [&] { return heads.empty() ? Statement::kNoHead : heads.back(); };
    auto finish = [&] {
        if (!current.empty()) out.push_back(make_statement(current, translator(current, in_body), head()));
        current.clear();
    };
    for (const std::string& token : tokens) {
        if (token == "(") ++parens;
        if (token == ")") --parens;
        if (parens > 0 || (token != ";" && token != "{" && token != "}")) {
            current.push_back(token);
            continue;
        }
        const bool headless = current.empty();
        finish();
        if (token == "{") {
            heads.push_back(headless ? head() : out.size() - 1);
            in_body = true;
        } else if (token == "}") {
            // A closing brace counts: a statement moved out of a block is another program.
            out.push_back({"}", {"}"}, "}", head()});
            if (!heads.empty()) heads.pop_back();
        }
    }
    finish();
    return out;
}

std::vector<Statement> split_statements(const std::vector<std::string>& tokens, const Dialect& dialect) {
    return split_statements(
        tokens, [&](const std::vector<std::string>& statement, bool) { return translate(statement, dialect); });
}

std::vector<DiffStep> diff(const std::vector<std::string>& before, const std::vector<std::string>& now) {
    size_t head = 0;
    while (head < before.size() && head < now.size() && before[head] == now[head]) ++head;
    size_t tail = 0;
    while (tail < before.size() - head && tail < now.size() - head &&
           before[before.size() - 1 - tail] == now[now.size() - 1 - tail])
        ++tail;
    std::vector<DiffStep> steps;
    for (size_t i = 0; i < head; ++i) steps.push_back({DiffStep::Keep, i, i});
    const size_t rows = before.size() - head - tail, columns = now.size() - head - tail;
    constexpr size_t kMostCells = 9'000'000;
    size_t i = 0, k = 0;
    if (rows > 0 && columns > 0 && rows * columns <= kMostCells) {
        std::vector<uint32_t> common((rows + 1) * (columns + 1), 0);
        auto cell = [&](size_t a, size_t b) -> uint32_t& { return common[a * (columns + 1) + b]; };
        for (size_t a = rows; a-- > 0;)
            for (size_t b = columns; b-- > 0;)
                cell(a, b) = before[head + a] == now[head + b] ? cell(a + 1, b + 1) + 1
                                                               : std::max(cell(a + 1, b), cell(a, b + 1));
        while (i < rows && k < columns) {
            if (before[head + i] == now[head + k])
                steps.push_back({DiffStep::Keep, head + i++, head + k++});
            else if (cell(i + 1, k) >= cell(i, k + 1))
                steps.push_back({DiffStep::Remove, head + i++, head + k});
            else
                steps.push_back({DiffStep::Add, head + i, head + k++});
        }
    }
    while (i < rows) steps.push_back({DiffStep::Remove, head + i++, head + k});
    while (k < columns) steps.push_back({DiffStep::Add, head + i, head + k++});
    for (size_t t = 0; t < tail; ++t)
        steps.push_back({DiffStep::Keep, before.size() - tail + t, now.size() - tail + t});
    return steps;
}

}  // namespace porttool
