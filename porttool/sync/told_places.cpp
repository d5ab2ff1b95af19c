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

size_t clause_at(const AlignedText& text, size_t word) {
    for (size_t c = 0; c < text.clauses.size(); ++c)
        if (word < text.clauses[c].end) return c;
    return text.clauses.empty() ? 0 : text.clauses.size() - 1;
}

/// The counterpart of a clause, or of the nearest before it.
size_t beside(const std::vector<size_t>& clause_of, size_t c) {
    for (++c; c-- > 0;)
        if (clause_of[c] != kNothing) return clause_of[c];
    return 0;
}

}  // namespace

std::vector<uint32_t> line_of_each(const ScannedFile& file, const UnitWords& words, const AlignedText& text) {
    std::vector<uint32_t> out;
    out.reserve(text.clauses.size());
    for (const Clause& clause : text.clauses) out.push_back(line_at(file, words, clause.first));
    return out;
}

size_t ToldPlaces::now_beside(size_t was) const { return beside(edit.clause_of, was); }
size_t ToldPlaces::target_beside(size_t was) const { return beside(across.clause_of, was); }

std::pair<uint32_t, uint32_t> ToldPlaces::of(const std::string& sentence, const Transplant& found) const {
    for (const std::string& said : quoted(sentence)) {
        if (const size_t is = clause_that_says(now, said); is != kNothing) {
            if (const size_t made = made_of(is, found); made != kNothing) return at(is, made);
            size_t was = kNothing;  // of it, or of the nearest before it
            for (size_t c = 0; c < edit.clause_of.size(); ++c)
                if (edit.clause_of[c] != kNothing && edit.clause_of[c] <= is) was = c;
            const size_t there = clause_that_says(target, said);
            return at(is, there != kNothing ? there : was == kNothing ? 0 : target_beside(was));
        }
        if (const size_t was = clause_that_says(before, said); was != kNothing)
            return at(now_beside(was), target_beside(was));
        if (const size_t there = clause_that_says(target, said); there != kNothing) {
            size_t was = 0;
            for (size_t c = 0; c < across.clause_of.size(); ++c)
                if (across.clause_of[c] != kNothing && across.clause_of[c] <= there) was = c;
            return at(now_beside(was), there);
        }
    }
    return first_edit(found);
}

/// The clause of the target that words of a clause of now went into.
size_t ToldPlaces::made_of(size_t is, const Transplant& found) const {
    for (const WordsReplaced& one : found.replaced)
        if (one.source_first >= now.clauses[is].first && one.source_first < now.clauses[is].end)
            return clause_at(target, one.first);
    for (const ClausesAdded& one : found.added)
        for (const ClauseAdded& clause : one.clauses)
            if (clause.source == is) return clause_at(target, one.before);
    return kNothing;
}

std::pair<uint32_t, uint32_t> ToldPlaces::first_edit(const Transplant& found) const {
    if (!found.replaced.empty())
        return at(clause_at(now, found.replaced.front().source_first), clause_at(target, found.replaced.front().first));
    if (!found.added.empty())
        return at(found.added.front().clauses.front().source, clause_at(target, found.added.front().before));
    return at(0, found.removed.empty() ? 0 : found.removed.front());
}

std::pair<uint32_t, uint32_t> ToldPlaces::at(size_t now_clause, size_t target_clause) const {
    const auto line = [](const std::vector<uint32_t>& all, size_t clause) {
        return clause < all.size() ? all[clause] : 0;
    };
    return {line(lines.first, now_clause), line(lines.second, target_clause)};
}

}  // namespace porttool
