// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/measure/passage_tracker.h"

#include <algorithm>
#include <future>

#include "porttool/measure/line_shares.h"
#include "porttool/text/parallel.h"

namespace porttool {
namespace {

using metrics::GrowingCoverage;
using Covered = GrowingCoverage::Covered;

constexpr metrics::WinnowingParameters kWinnowing;
constexpr size_t kDialect = static_cast<size_t>(Vocabulary::Dialect);

PreparedExcerpt prepared_excerpt(const SymbolTable& table, const std::vector<PlacedToken>& tokens) {
    PreparedExcerpt out;
    std::vector<uint32_t> line_of_token;
    for (size_t i = 0; i < tokens.size(); ++i) {
        if (i == 0 || tokens[i].line != tokens[i - 1].line) ++out.lines;
        line_of_token.push_back(out.lines - 1);
    }
    for (const Vocabulary vocabulary : {Vocabulary::Dialect, Vocabulary::Blind, Vocabulary::Raw}) {
        SymbolSequence sequence = table.sequence(tokens, vocabulary, 0);
        if (vocabulary == Vocabulary::Dialect)
            for (const uint32_t token : sequence.tokens) out.line_of.push_back(line_of_token[token]);
        out.sequences[static_cast<size_t>(vocabulary)] =
            std::make_shared<const metrics::PrintedSequence>(std::move(sequence.symbols), kWinnowing);
    }
    return out;
}

std::vector<LineShare> line_shares(const PreparedExcerpt& excerpt, const uint8_t* covered) {
    std::vector<LineShare> lines(excerpt.lines);
    for (size_t i = 0; i < excerpt.line_of.size(); ++i) {
        ++lines[excerpt.line_of[i]].tokens;
        lines[excerpt.line_of[i]].covered += covered[i];
    }
    return lines;
}

/// What is covered of at most one sequence on each side.
std::array<Covered, 2> covered_at_once(const GrowingCoverage::Members& a, const GrowingCoverage::Members& b) {
    std::vector<metrics::TokenMatch> matches;
    if (!a.empty() && !b.empty())
        matches = metrics::winnowing_matches(*a.front().sequence, *b.front().sequence, kWinnowing);
    std::array<Covered, 2> out;
    if (!a.empty()) out[0] = {metrics::covered_in_a(matches, a.front().sequence->symbols.size()), {0}};
    if (!b.empty()) out[1] = {metrics::covered_in_b(matches, b.front().sequence->symbols.size()), {0}};
    return out;
}

std::optional<double>& percent_of(SideMeasure& figures, Vocabulary vocabulary) {
    if (vocabulary == Vocabulary::Dialect) return figures.moss_percent;
    return vocabulary == Vocabulary::Blind ? figures.moss_percent_blind : figures.moss_percent_raw;
}

}  // namespace

std::shared_ptr<const PreparedPart> PartStore::part(const PassagePart& part) {
    std::weak_ptr<const PreparedPart>& known = known_[part.contents];
    if (auto found = known.lock()) return found;
    auto made = std::make_shared<PreparedPart>();
    const PartText text = part.read();
    for (const Excerpt& excerpt : text.passage) {
        const std::vector<PlacedToken> tokens = table_.place({excerpt});
        if (tokens.empty()) continue;
        made->moved |= table_.has_moved_word(tokens);
        made->excerpts.push_back(prepared_excerpt(table_, tokens));
    }
    known = made;
    return made;
}

bool PassageTracker::take(Side side, const PartedPassage& passage, PartStore& store) {
    Parts now;
    bool moved = false;
    order_[side].clear();
    for (const PassagePart& one : passage) {
        const std::pair<std::string, std::string> key(one.path, one.contents);
        Part& part = now[key];
        if (const auto known = parts_[side].find(key); known != parts_[side].end()) {
            part = known->second;
        } else {
            part = {store.part(one), numbers_[side]};
            numbers_[side] += static_cast<uint32_t>(part.prepared->excerpts.size());
        }
        moved |= part.prepared->moved;
        order_[side].push_back(&part);
    }
    parts_[side] = std::move(now);
    return !moved;
}

std::array<Covered, 2> PassageTracker::update(size_t vocabulary) {
    BySide<GrowingCoverage::Members> members;
    for (const Side side : kBothSides)
        for (const Part* part : order_[side])
            for (size_t i = 0; i < part->prepared->excerpts.size(); ++i)
                members[side].push_back(
                    {part->first + static_cast<uint32_t>(i), part->prepared->excerpts[i].sequences[vocabulary]});
    const bool is_small = members.source.size() <= 1 && members.target.size() <= 1;  // whatever changed, half has
    if (is_small) return covered_at_once(members.source, members.target);
    return coverage_[vocabulary].update(members.source, members.target);
}

/// The extents of both sides in one vocabulary.
BySide<PassageTracker::Extent> PassageTracker::extents(size_t vocabulary) const {
    BySide<Extent> out;
    for (const Side side : kBothSides)
        for (const Part* part : order_[side])
            for (const PreparedExcerpt& excerpt : part->prepared->excerpts) {
                const size_t size = excerpt.sequences[vocabulary]->symbols.size();
                out[side].symbols += size;
                out[side].longest = std::max(out[side].longest, size);
            }
    return out;
}

void PassageTracker::note_lines(Side side, const Covered& covered, PassageSide& out) const {
    size_t at = 0;
    for (const Part* part : order_[side])
        for (const PreparedExcerpt& excerpt : part->prepared->excerpts) {
            const std::vector<bool> shared =
                shared_lines(line_shares(excerpt, covered.symbols.data() + covered.first[at++]));
            out.shared.insert(out.shared.end(), shared.begin(), shared.end());
        }
    out.measure.lines = static_cast<uint32_t>(out.shared.size());
    out.measure.shared_lines = static_cast<uint32_t>(std::count(out.shared.begin(), out.shared.end(), true));
}

std::optional<BySide<PassageSide>> PassageTracker::measure(const BySide<const PartedPassage*>& passages,
                                                           PartStore& store) {
    bool usable = true;
    for (const Side side : kBothSides) usable = take(side, *passages[side], store) && usable;
    const BySide<Extent> all = extents(kDialect);
    const size_t symbols = all.source.symbols + all.target.symbols;
    constexpr size_t kMostSymbols = 4'000'000, kWorthAThread = 100'000;  // the tables stay in memory
    if (!usable || symbols > kMostSymbols) return std::nullopt;
    // The three vocabularies have nothing to do with each other; the last to be waited for is done here.
    const std::launch when = in_a_thread_if(symbols > kWorthAThread);
    std::array<std::future<std::array<Covered, 2>>, 3> covered;
    for (size_t vocabulary = 0; vocabulary < covered.size(); ++vocabulary)
        covered[vocabulary] = std::async(vocabulary == kDialect ? std::launch::deferred : when,
                                         [this, vocabulary] { return update(vocabulary); });
    BySide<PassageSide> out;
    for (size_t vocabulary = 0; vocabulary < covered.size(); ++vocabulary) {
        std::array<Covered, 2> found = covered[vocabulary].get();
        const BySide<Extent> extent = extents(vocabulary);
        const bool measured = std::min(extent.source.longest, extent.target.longest) >= kWinnowing.guarantee();
        for (const Side side : kBothSides) {
            Covered& own = found[side == Side::Source ? 0 : 1];
            SideMeasure& figures = out[side].measure;
            if (measured)
                percent_of(figures, static_cast<Vocabulary>(vocabulary)) =
                    100.0 * static_cast<double>(std::count(own.symbols.begin(), own.symbols.end(), 1)) /
                    static_cast<uint32_t>(extent[side].symbols);
            else
                std::fill(own.symbols.begin(), own.symbols.end(), uint8_t{0});
            if (vocabulary != kDialect) continue;
            figures.tokens = static_cast<uint32_t>(extent[side].symbols);
            note_lines(side, own, out[side]);
        }
    }
    return out;
}

}  // namespace porttool
