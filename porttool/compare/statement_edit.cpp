// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/statement_edit.h"

#include <array>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>

#include "porttool/normal/diff.h"

namespace porttool {
namespace {

Words keys(const std::vector<Statement>& statements) {
    Words out;
    for (const Statement& statement : statements) out.push_back(statement.key);
    return out;
}

}  // namespace

std::vector<size_t> StatementEdit::kept() const {
    std::vector<size_t> out(before.size(), kGone);
    size_t k = 0;
    auto next_lost = lost.begin(), next_gained = gained.begin();
    for (size_t i = 0; i < before.size(); ++i) {
        if (next_lost != lost.end() && *next_lost == i) {
            ++next_lost;
            continue;
        }
        for (; next_gained != gained.end() && *next_gained == k; ++next_gained) ++k;
        out[i] = k++;
    }
    return out;
}

Translator translated_once(Translator translator) {
    using Translations = std::unordered_map<std::string, std::vector<std::string>>;
    const auto known = std::make_shared<std::array<Translations, 2>>();
    return [translator = std::move(translator), known](const Words& statement, bool in_body) {
        std::string text;
        for (const std::string_view word : statement) text.append(word) += '\n';
        const auto [found, is_new] = (*known)[in_body ? 1 : 0].try_emplace(std::move(text));
        if (is_new) found->second = translator(statement, in_body);
        return found->second;
    };
}

StatementEdit statement_edit(const Words& before, const Words& now, const Translator& translator) {
    StatementEdit edit{split_statements(before, translator), split_statements(now, translator), {}, {}};
    for (const DiffStep& step : diff(keys(edit.before), keys(edit.now))) {
        if (step.kind == DiffStep::Remove) edit.lost.push_back(step.before);
        if (step.kind == DiffStep::Add) edit.gained.push_back(step.now);
    }
    return edit;
}

std::string block_of(const std::vector<Statement>& statements, size_t i) {
    const size_t head = statements[i].head;
    if (head == Statement::kNoHead) return "the head";
    if (statements[head].head == Statement::kNoHead) return "the function's body";
    return quoted(statements[head]);
}

std::string quoted(const Statement& statement) {
    constexpr size_t kLongest = 500;
    return "`" + (statement.shown.size() > kLongest ? statement.shown.substr(0, kLongest) + " ..." : statement.shown) +
           "`";
}

}  // namespace porttool
