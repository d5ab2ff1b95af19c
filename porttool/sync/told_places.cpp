// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/told_places.h"

#include <algorithm>

namespace porttool {
namespace {

constexpr size_t kNothing = Alignment::kNone;

/// What a sentence quotes, without blanks and without the dots where it is cut.
std::vector<std::string> quoted(const std::string& sentence) {
    std::vector<std::string> out;
    for (size_t open = sentence.find('`'); open != std::string::npos; open = sentence.find('`', open + 1)) {
        const size_t close = sentence.find('`', open + 1);
        if (close == std::string::npos) break;
        std::string text = sentence.substr(open + 1, close - open - 1);
        std::erase(text, ' ');
        if (text.ends_with("...")) text.resize(text.size() - 3);
        out.push_back(std::move(text));
        open = close;
    }
    return out;
}

/// The first clause that begins with a text without blanks, or, where that is a name alone, that has it.
size_t clause_that_says(const AlignedText& text, const std::string& said) {
    for (size_t c = 0; c < text.clauses.size(); ++c) {
        std::string words;
        for (size_t i = text.clauses[c].first; i < text.clauses[c].end && words.size() < said.size(); ++i)
            words += text.words[i];
        if (!said.empty() && words.starts_with(said)) return c;
    }
    for (size_t c = 1; c < text.clauses.size(); ++c)
        for (size_t i = text.clauses[c].first; i < text.clauses[c].end; ++i)
            if (text.words[i] == said) return c;
    return kNothing;
}

/// The counterpart of a clause, or of the nearest before it.
size_t beside(const std::vector<size_t>& clause_of, size_t c) {
    for (++c; c-- > 0;)
        if (clause_of[c] != kNothing) return clause_of[c];
    return 0;
}

}  // namespace

std::vector<uint32_t> line_of_each(const ScannedFile& file, const UnitWords& words) {
    std::vector<uint32_t> out;
    out.reserve(words.size());
    for (size_t i = 0; i < words.size(); ++i) out.push_back(line_at(file, words, i));
    return out;
}

size_t ToldPlaces::now_beside(size_t was) const { return beside(edit.clause_of, was); }
size_t ToldPlaces::target_beside(size_t was) const { return beside(across.clause_of, was); }

std::pair<uint32_t, uint32_t> ToldPlaces::of(const std::string& sentence, const Transplant& found) const {
    for (const std::string& said : quoted(sentence)) {
        if (const size_t is = clause_that_says(now, said); is != kNothing) {
            if (const auto made = made_of(is, found)) return *made;
            size_t was = kNothing;  // of it, or of the nearest before it
            for (size_t c = 0; c < edit.clause_of.size(); ++c)
                if (edit.clause_of[c] != kNothing && edit.clause_of[c] <= is) was = c;
            const size_t there = clause_that_says(target, said);
            return at_clauses(is, there != kNothing ? there : was == kNothing ? 0 : target_beside(was));
        }
        if (const size_t was = clause_that_says(before, said); was != kNothing)
            return at_clauses(now_beside(was), target_beside(was));
        if (const size_t there = clause_that_says(target, said); there != kNothing) {
            size_t was = 0;
            for (size_t c = 0; c < across.clause_of.size(); ++c)
                if (across.clause_of[c] != kNothing && across.clause_of[c] <= there) was = c;
            return at_clauses(now_beside(was), there);
        }
    }
    return first_edit(found);
}

/// Where words of a clause of now went: a head of many lines has more than one.
std::optional<std::pair<uint32_t, uint32_t>> ToldPlaces::made_of(size_t is, const Transplant& found) const {
    for (const WordsReplaced& one : found.replaced)
        if (one.source_first >= now.clauses[is].first && one.source_first < now.clauses[is].end)
            return at(one.source_first, one.first);
    for (const ClausesAdded& one : found.added)
        for (const ClauseAdded& clause : one.clauses)
            if (clause.source == is) return at(now.clauses[is].first, one.before);
    return std::nullopt;
}

std::pair<uint32_t, uint32_t> ToldPlaces::first_edit(const Transplant& found) const {
    if (!found.replaced.empty()) return at(found.replaced.front().source_first, found.replaced.front().first);
    if (!found.added.empty())
        return at(now.clauses[found.added.front().clauses.front().source].first, found.added.front().before);
    return at_clauses(0, found.removed.empty() ? 0 : found.removed.front());
}

std::pair<uint32_t, uint32_t> ToldPlaces::at_clauses(size_t now_clause, size_t target_clause) const {
    const auto word = [](const AlignedText& text, size_t clause) {
        return clause < text.clauses.size() ? text.clauses[clause].first : 0;
    };
    return at(word(now, now_clause), word(target, target_clause));
}

std::pair<uint32_t, uint32_t> ToldPlaces::at(size_t now_word, size_t target_word) const {
    const auto line = [](const std::vector<uint32_t>& all, size_t word) {
        return all.empty() ? 0 : all[std::min(word, all.size() - 1)];
    };
    return {line(lines.first, now_word), line(lines.second, target_word)};
}

}  // namespace porttool
