// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/statement_patterns.h"

#include <algorithm>

#include "porttool/language/words.h"
#include "porttool/normal/normal_text.h"

namespace porttool {
namespace {

constexpr size_t kLongestPattern = 24;  ///< words
constexpr size_t kFewestNames = 3;      ///< that tell a pattern

bool names_a_thing(const std::string& word) {
    return is_word_token(word) && !is_type_word(word) && !word_is(word, kKeyword);
}

std::string joined_words(const std::vector<std::string>& words) {
    std::string out;
    for (const std::string& word : words) out += word + '\x1f';
    return out;
}

/// A statement with nothing in the place of one word; "" where the word stands there twice.
std::string without_word(const std::vector<std::string>& words, size_t first, size_t end, const std::string& name) {
    if (std::count(words.begin() + static_cast<std::ptrdiff_t>(first), words.begin() + static_cast<std::ptrdiff_t>(end),
                   name) != 1)
        return {};
    std::vector<std::string> out(words.begin() + static_cast<std::ptrdiff_t>(first),
                                 words.begin() + static_cast<std::ptrdiff_t>(end));
    std::replace(out.begin(), out.end(), name, std::string());
    return joined_words(out);
}

std::vector<std::string> parted(const std::string& text) {
    std::vector<std::string> out;
    for (size_t i = 0; i < text.size();) {
        const size_t cut = text.find('\x1f', i);
        out.push_back(text.substr(i, cut - i));
        i = cut + 1;
    }
    return out;
}

/// A text with the statements that patterns know as the target says them.
std::vector<std::string> with_patterns(const AlignedText& text, const StatementPatterns& patterns, bool& any) {
    std::vector<std::string> out;
    for (const Clause& clause : text.clauses) {
        const StatementPatterns::Said said = patterns.said(text.words, clause.first, clause.end);
        for (const std::string& word : said.target) out.push_back(word.empty() ? text.words[said.name] : word);
        any |= !said.target.empty();
        for (size_t i = clause.first; said.target.empty() && i < clause.end; ++i) out.push_back(text.words[i]);
    }
    return out;
}

}  // namespace

void StatementPatterns::learn(const AlignedText& source, const AlignedText& target, const Alignment& alignment) {
    for (size_t c = 1; c < source.clauses.size(); ++c) {
        if (alignment.clause_of[c] == Alignment::kNone) continue;
        const Clause &here = source.clauses[c], &there = target.clauses[alignment.clause_of[c]];
        if (here.opens || here.closes || here.size() > kLongestPattern || there.size() > kLongestPattern) continue;
        for (size_t i = here.first; i < here.end; ++i) {
            const std::string& name = source.words[i];
            if (!names_a_thing(name)) continue;
            const std::string statement = without_word(source.words, here.first, here.end, name),
                              said = without_word(target.words, there.first, there.end, name);
            if (!statement.empty() && !said.empty() && statement != said) patterns_[statement][said].insert(name);
        }
    }
}

StatementPatterns::Said StatementPatterns::said(const std::vector<std::string>& words, size_t first, size_t end) const {
    Said out;
    if (end - first > kLongestPattern || end == first || words[end - 1] != ";") return out;
    for (size_t i = first; i < end; ++i) {
        if (!names_a_thing(words[i])) continue;
        const auto found = patterns_.find(without_word(words, first, end, words[i]));
        if (found == patterns_.end() || found->second.size() != 1) continue;
        const auto& [statement, names] = *found->second.begin();
        if (names.size() < kFewestNames) continue;
        if (!out.target.empty()) return {};
        out = {i, parted(statement)};
    }
    return out;
}

PatternedTexts in_statements_of_target(const PairTexts& texts, const Dialect& dialect) {
    const auto words = [](const Words& text) { return std::vector<std::string>(text.begin(), text.end()); };
    const std::vector<std::string> before = words(texts.source_before), now = words(texts.source_now),
                                   there = words(texts.target_before);
    WordKeys keys(dialect);
    const AlignedText old_text = keys.text(before, false), new_text = keys.text(now, false),
                      port = keys.text(there, false);
    StatementPatterns patterns;
    patterns.learn(old_text, port, align(old_text, port, {}));
    PatternedTexts out;
    if (patterns.empty()) return out;
    out.before = with_patterns(old_text, patterns, out.any);
    out.now = with_patterns(new_text, patterns, out.any);
    return out;
}

}  // namespace porttool
