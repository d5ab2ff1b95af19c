// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/parts_of_port.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "porttool/language/words.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/statements.h"

namespace porttool {
namespace {

using Marks = std::set<std::string>;

std::vector<std::string> spelled(const Words& words) { return {words.begin(), words.end()}; }

/// What a passage is known by, whatever its locals are called: three words in a row with names as one word, and names
/// and numbers themselves.
Marks marks_of(const std::vector<std::string>& words, size_t first, size_t end, const Dialect& dialect) {
    Marks out;
    std::string before, last;
    for (size_t i = first; i < end; ++i) {
        const std::string common = common_word(words[i], dialect);
        if (common.empty()) continue;
        const bool is_plain = is_word_token(common) && !word_is(common, kControls) && !word_is(common, kType);
        const bool is_called = i + 1 < end && words[i + 1] == "(";
        if (is_plain || is_number_token(common)) out.insert("word " + common);
        const std::string shape = is_plain && !is_called ? "@" : common;
        if (!last.empty()) out.insert(before + ' ' + last + ' ' + shape);
        before = std::exchange(last, shape);
    }
    return out;
}

/// How much of the marks each original has, of those that not all have. A mark of few counts more.
class Likeness {
public:
    explicit Likeness(std::vector<Marks> originals) : originals_(std::move(originals)) {
        for (const Marks& marks : originals_)
            for (const std::string& mark : marks) ++times_[mark];
    }

    std::vector<double> of(const Marks& marks) const {
        std::vector<double> out(originals_.size());
        for (const std::string& mark : marks) {
            const auto found = times_.find(mark);
            if (found == times_.end() || found->second == originals_.size()) continue;
            for (size_t k = 0; k < out.size(); ++k)
                if (originals_[k].contains(mark)) out[k] += 1.0 / static_cast<double>(found->second);
        }
        return out;
    }

private:
    std::vector<Marks> originals_;
    std::map<std::string, size_t> times_;
};

/// The original that is the most like, if it is so by far.
std::optional<size_t> surely_most(const std::vector<double>& likeness) {
    constexpr double kLeast = 3, kTimesNext = 2;
    const auto best = std::max_element(likeness.begin(), likeness.end());
    double next = 0;
    for (auto one = likeness.begin(); one != likeness.end(); ++one)
        if (one != best) next = std::max(next, *one);
    if (best == likeness.end() || *best < kLeast || *best < kTimesNext * next) return std::nullopt;
    return static_cast<size_t>(best - likeness.begin());
}

std::vector<std::string> texts_of(const std::vector<std::string>& words, const std::vector<Clause>& clauses) {
    std::vector<std::string> out;
    for (const Clause& clause : clauses) {
        std::string text;
        for (size_t i = clause.first; i < clause.end; ++i) text += words[i] + ' ';
        out.push_back(std::move(text));
    }
    return out;
}

}  // namespace

/// Clauses that gave way to others, or a place between two where others came.
struct PartsOfPort::Hunk {
    size_t first, end;
    bool is_place() const { return first == end; }
    Hunk earlier(size_t by) const { return {first - by, end - by}; }
    Hunk later(size_t by) const { return {first + by, end + by}; }
};

/// What came, or went, as `moved` in the text may as well have done so earlier or later where the same statements
/// stand beside it: the farthest of these places.
void PartsOfPort::add_other_ways(const Hunk& at, const Hunk& moved, const std::vector<std::string>& text,
                                 std::vector<Hunk>& ways) {
    size_t by = 0;
    while (moved.first > by && at.first > by && text[moved.first - by - 1] == text[moved.end - by - 1]) ++by;
    if (by > 0) ways.push_back(at.earlier(by));
    by = 0;
    while (moved.end + by < text.size() && text[moved.first + by] == text[moved.end + by]) ++by;
    if (by > 0) ways.push_back(at.later(by));
}

PartsOfPort::PartsOfPort(const Words& port, const std::vector<Words>& originals, const Dialect& dialect)
    : words_(spelled(port)), clauses_(clauses_of(words_, false)) {
    constexpr size_t kMostOriginals = 64, kMostWords = 1 << 16;
    if (originals.size() > kMostOriginals || words_.size() > kMostWords) return;
    std::vector<Marks> known;
    for (const Words& original : originals) {
        if (original.size() > kMostWords) return;
        known.push_back(marks_of(spelled(original), 0, original.size(), dialect));
    }
    const Likeness likeness(known);
    const size_t body = static_cast<size_t>(
        std::find_if(clauses_.begin(), clauses_.end(), [](const Clause& clause) { return clause.opens; }) -
        clauses_.begin());
    std::vector<Block> blocks;
    std::vector<Marks> marks;
    for (size_t i = body + 1; i < clauses_.size(); ++i) {
        const Clause& clause = clauses_[i];
        if (!clause.opens || clause.partner == Clause::kNone) continue;
        blocks.push_back({i, clause.partner + 1});
        marks.push_back(marks_of(words_, clause.first, clauses_[clause.partner].end, dialect));
        if (const auto owner = surely_most(likeness.of(marks.back()))) blocks.back().owner = *owner;
    }
    // A block that holds another one's is of both.
    for (size_t i = 0; i < blocks.size(); ++i)
        for (size_t k = i + 1; k < blocks.size() && blocks[k].head < blocks[i].end; ++k)
            if (blocks[k].owner != kNobody && blocks[i].owner != kNobody && blocks[k].owner != blocks[i].owner)
                blocks[i].owner = kNobody;
    for (const Block& block : blocks)
        if (block.owner != kNobody) {
            owned_.push_back(block);
            with_parts_.insert(block.owner);
        }
}

/// Whose block holds all of it; the outermost one counts.
size_t PartsOfPort::owner_of(const Hunk& hunk) const {
    for (const Block& block : owned_)
        if (hunk.is_place() ? block.head < hunk.first && hunk.first < block.end
                            : block.head <= hunk.first && hunk.end <= block.end)
            return block.owner;
    return kNobody;
}

/// `ways`: the places that one edit may have had.
void PartsOfPort::note(const std::vector<Hunk>& ways, ReachedParts& out) const {
    std::set<size_t> owners;
    for (const Hunk& hunk : ways) owners.insert(owner_of(hunk));
    if (owners.size() == 1 && !owners.contains(kNobody)) {
        out.surely.insert(*owners.begin());
        return;
    }
    out.elsewhere = true;
    owners.erase(kNobody);
    out.perhaps.insert(owners.begin(), owners.end());
    for (const Block& block : owned_)
        for (const Hunk& hunk : ways)
            if (block.head < hunk.end && hunk.first < block.end) out.perhaps.insert(block.owner);
}

ReachedParts PartsOfPort::reached(const Words& now) const {
    ReachedParts out;
    const std::vector<std::string> words = spelled(now);
    const std::vector<std::string> before = texts_of(words_, clauses_),
                                   after = texts_of(words, clauses_of(words, false));
    const std::vector<DiffStep> steps = diff(before, after);
    for (size_t i = 0; i < steps.size(); ++i) {
        if (steps[i].kind == DiffStep::Keep) continue;
        Hunk gone{steps[i].before, steps[i].before}, came{steps[i].now, steps[i].now};
        for (; i < steps.size() && steps[i].kind != DiffStep::Keep; ++i)
            ++(steps[i].kind == DiffStep::Remove ? gone.end : came.end);
        std::vector<Hunk> ways = {gone};
        if (gone.is_place()) add_other_ways(gone, came, after, ways);
        if (came.is_place()) add_other_ways(gone, gone, before, ways);
        note(ways, out);
    }
    return out;
}

}  // namespace porttool
