// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/computed_values.h"

#include <algorithm>
#include <map>
#include <set>

#include "porttool/compare/hints.h"
#include "porttool/compare/meaning.h"
#include "porttool/compare/numbered_text.h"
#include "porttool/compare/plain_references.h"
#include "porttool/compare/plain_statement.h"
#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/locals.h"
#include "porttool/normal/prelude.h"
#include "porttool/normal/statements.h"
#include "porttool/value_graph/same_values.h"

namespace porttool {
namespace {

constexpr size_t kMostComputed = 5'000;  ///< of each text

bool is_shading(Language language) { return traits_of(language).literals == Literals::Shading; }

/// What a function reads, calls, promises and how it is made: its words but for locals, the types of numbers and what
/// heads a branch. Other statements for one value bring none and take none.
std::set<std::string_view> words_that_count(const Words& text) {
    const std::vector<size_t> locals = local_numbers(text);
    std::set<std::string_view> out;
    for (size_t i = 0; i < text.size(); ++i) {
        const bool counts = is_word_token(text[i]) || is_number_token(text[i]) || text[i] == "#";
        const bool is_local = !locals.empty() && locals[i] != 0;
        if (counts && !is_local && !is_type_word(text[i]) && !word_is(text[i], kControls) &&
            !is_one_of(text[i], {"else", "const"}))
            out.insert(text[i]);
    }
    return out;
}

/// How many jumps stand before the first read of each array, by its name; what is left by then is not read.
std::map<std::string_view, size_t> jumps_before_reads(const Words& text, size_t& jumps) {
    std::map<std::string_view, size_t> out;
    jumps = 0;
    for (size_t i = 0; i < text.size(); ++i) {
        if (is_one_of(text[i], {"return", "break", "continue", "goto", "discard"})) ++jumps;
        if (is_word_token(text[i]) && i + 1 < text.size() && text[i + 1] == "[") out.emplace(text[i], jumps);
    }
    return out;
}

/// True if an array is read before a jump now that was read behind it: what the jump kept from being read may be out of
/// bounds.
bool reads_before_guards(const Words& before, const Words& now) {
    size_t jumps_then = 0, jumps_now = 0;
    const auto then = jumps_before_reads(before, jumps_then), today = jumps_before_reads(now, jumps_now);
    if (jumps_then != jumps_now) return false;  // guards that became one, or a block
    return std::any_of(today.begin(), today.end(), [&](const auto& read) {
        const auto was = then.find(read.first);
        return was != then.end() && read.second < was->second;
    });
}

}  // namespace

bool compute_alike(const BySide<Words>& texts, const Dialect& dialect, const BySide<Language>& languages) {
    if (texts.source.size() > kMostComputed || texts.target.size() > kMostComputed) return false;
    const NumberedText source(without_hints(without_prelude(texts.source))),
        target(without_hints(without_prelude(texts.target)));
    const BySide<Words> plain = with_plain_references({source.words(), target.words()});
    const Words none;
    const Meaning meaning({none, plain.source, none, plain.target}, dialect, languages);
    const auto statements = [&](const Words& words, Side side) {
        return split_statements(words, [&meaning, side](const Words& statement, bool in_body) {
            return meaning.translate(statement, side, in_body);
        });
    };
    const std::vector<Statement> here = statements(plain.source, Side::Source),
                                 there = statements(plain.target, Side::Target);
    const bool shading = is_shading(languages.source) || is_shading(languages.target);
    const ReadingManner manner{dialect, shading, {}};
    // Whose classes stand for whose vectors is asked from the side that has vectors.
    return give_the_same({here, manner}, {there, manner}) || give_the_same({there, manner}, {here, manner});
}

bool computes_as_before(const Words& before, const Words& now, const Dialect& dialect, Language language) {
    if (words_that_count(before) != words_that_count(now) || reads_before_guards(before, now)) return false;
    if (before.size() > kMostComputed || now.size() > kMostComputed) return false;
    const NumberedText then(without_hints(without_prelude(before))), today(without_hints(without_prelude(now)));
    PlainStatements plain(UnitKind::Function, language, dialect);
    plain.note_vectors_of(then.words());
    plain.note_vectors_of(today.words());
    const auto statements = [&](const Words& words) {
        return split_statements(
            words, [&](const Words& statement, bool in_body) { return plain.translate(statement, in_body); });
    };
    const ReadingManner manner{dialect, is_shading(language), {}, true};
    const std::vector<Statement> old_one = statements(then.words()), new_one = statements(today.words());
    return give_the_same({old_one, manner}, {new_one, manner});
}

}  // namespace porttool
