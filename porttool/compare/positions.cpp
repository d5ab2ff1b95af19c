// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/positions.h"

#include <algorithm>
#include <set>
#include <utility>

#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/diff.h"

namespace porttool {
namespace {

/// What two statements are laid side by side by: the words, or for a closing brace what it closes.
std::vector<std::string> anchor_keys(const std::vector<Statement>& statements) {
    std::vector<std::string> out;
    for (const Statement& statement : statements) {
        out.push_back(statement.key);
        if (!statement.is_brace() || statement.head == Statement::kNoHead) continue;
        const std::vector<std::string>& head = statements[statement.head].common;
        if (!head.empty() && word_is(head[0], kBlockHead)) out.back() += head[0];
    }
    return out;
}

/// A statement of the source beside the one of the port that stands for it.
struct Anchor {
    size_t source, target;
};

std::vector<Anchor> anchors(const std::vector<Statement>& source, const std::vector<Statement>& target) {
    std::vector<Anchor> out;
    for (const DiffStep& step : diff(anchor_keys(source), anchor_keys(target)))
        if (step.kind == DiffStep::Keep) out.push_back({step.before, step.now});
    return out;
}

/// The anchors that neither edit took away, by where they stand now.
std::vector<Anchor> still_there(const std::vector<Anchor>& before, const StatementEdit& source,
                                const StatementEdit& target) {
    const std::vector<size_t> source_now = source.kept(), target_now = target.kept();
    std::vector<Anchor> out;
    for (const auto& [here, there] : before)
        if (source_now[here] != StatementEdit::kGone && target_now[there] != StatementEdit::kGone)
            out.push_back({source_now[here], target_now[there]});
    return out;
}

bool same_position(const std::vector<Anchor>& shared, size_t source, size_t target) {
    const auto in_source = std::partition_point(shared.begin(), shared.end(),
                                                [&](const Anchor& anchor) { return anchor.source < source; });
    const auto in_target = std::partition_point(shared.begin(), shared.end(),
                                                [&](const Anchor& anchor) { return anchor.target < target; });
    return in_source == in_target;
}

/// What a statement is to those that stand beside it: the head of a loop or of a branch, the end of one, or none.
enum class Shape : uint8_t { Plain, Loop, Branch, LoopEnd, BranchEnd, Other };
constexpr Shape kShapes[] = {Shape::Plain, Shape::Loop, Shape::Branch, Shape::LoopEnd, Shape::BranchEnd};

Shape shape_of(const std::vector<Statement>& statements, size_t i) {
    const Statement& statement = statements[i];
    const bool ends = statement.is_brace();
    if (ends && statement.head == Statement::kNoHead) return Shape::Other;
    const std::vector<std::string>& words = (ends ? statements[statement.head] : statement).common;
    const std::string_view first = words.empty() ? std::string_view() : std::string_view(words[0]);
    const bool loops = word_is(first, kLoop), branches = first == "if" || first == "cif";
    if (ends) return loops ? Shape::LoopEnd : branches ? Shape::BranchEnd : Shape::Other;
    return loops ? Shape::Loop : branches ? Shape::Branch : Shape::Plain;
}

/// True if at least half of the names of the one statement with fewer are the other's.
bool name_much_the_same(const Statement& one, const Statement& other) {
    const auto names = [](const Statement& statement) {
        std::set<std::string_view> out;
        for (const std::string& word : statement.common)
            if (is_word_token(word) && !word_is(word, kControls)) out.insert(word);
        return out;
    };
    const std::set<std::string_view> here = names(one), there = names(other);
    const auto common = std::count_if(here.begin(), here.end(), [&](auto word) { return there.contains(word); });
    return common > 0 && 2 * static_cast<size_t>(common) >= std::min(here.size(), there.size());
}

/// A place of one text, and what is not held against the other's there: what was edited.
struct PlaceOfText {
    const std::vector<Statement>& statements;
    size_t at;
    const std::vector<size_t>& edited;  ///< in order

    /// The statements of a shape within the range, and how many of them stand before the place.
    std::pair<std::vector<size_t>, size_t> of_shape(Shape shape, size_t first, size_t end) const {
        std::pair<std::vector<size_t>, size_t> out;
        for (size_t i = first; i < end; ++i) {
            const bool counts =
                i != at && shape_of(statements, i) == shape && !std::binary_search(edited.begin(), edited.end(), i);
            if (!counts) continue;
            out.first.push_back(i);
            out.second += i < at ? 1 : 0;
        }
        return out;
    }
};

/// Between the statements that the sides share may stand some that each side says in its own way. Where there are as
/// many of a shape on both, each alike, the two places must have as many of them before: `a += b` before a loop is
/// another program than in it, though the loops' heads are not spelled alike.
bool same_among_others(const std::vector<Anchor>& shared, const PlaceOfText& source, const PlaceOfText& target) {
    const auto next = std::partition_point(shared.begin(), shared.end(),
                                           [&](const Anchor& anchor) { return anchor.source < source.at; });
    const Anchor first = next == shared.begin() ? Anchor{0, 0} : Anchor{(next - 1)->source + 1, (next - 1)->target + 1};
    const Anchor end = next == shared.end() ? Anchor{source.statements.size(), target.statements.size()} : *next;
    constexpr size_t kMostBetween = 128;  // statements; of more nothing is told
    if (end.source - first.source > kMostBetween || end.target - first.target > kMostBetween) return true;
    return std::all_of(std::begin(kShapes), std::end(kShapes), [&](Shape shape) {
        const auto [here, before_here] = source.of_shape(shape, first.source, end.source);
        const auto [there, before_there] = target.of_shape(shape, first.target, end.target);
        if (here.size() != there.size() || before_here == before_there) return true;
        for (size_t i = 0; i < here.size(); ++i) {
            const Statement &one = source.statements[here[i]], &other = target.statements[there[i]];
            const bool named = shape == Shape::Plain || shape == Shape::Branch;
            if (named && !name_much_the_same(one, other)) return true;
        }
        return false;
    });
}

/// Where a statement stands, for a reader: its block, or within the same block the statement before it.
std::string position_of(const std::vector<Statement>& statements, size_t i, bool by_block) {
    if (by_block) return "in " + block_of(statements, i);
    if (i == 0) return "first";
    const Statement& last = statements[i - 1];
    if (last.is_brace()) return "behind the block of " + block_of(statements, i - 1);
    return "behind " + quoted(last);
}

std::string both_positions(const std::vector<Statement>& source, size_t at, const std::vector<Statement>& target,
                           size_t other) {
    const bool by_block = block_of(source, at) != block_of(target, other);
    return position_of(source, at, by_block) + " in the source, " + position_of(target, other, by_block) +
           " in the port";
}

/// Names a statement that the two sides share and that now stands in another block on one of them.
std::string moved_block(const StatementEdit& source, const StatementEdit& target) {
    const std::vector<Anchor> before = anchors(source.before, target.before);
    const std::vector<size_t> source_now = source.kept(), target_now = target.kept();
    for (const Anchor& anchor : before) {
        if (source.before[anchor.source].is_brace()) continue;
        const size_t here = source_now[anchor.source], there = target_now[anchor.target];
        if (here == StatementEdit::kGone || there == StatementEdit::kGone) continue;
        const bool source_moved = block_of(source.before, anchor.source) != block_of(source.now, here);
        const bool target_moved = block_of(target.before, anchor.target) != block_of(target.now, there);
        if (source_moved != target_moved)
            return "`" + source.now[here].shown + "` stands " + both_positions(source.now, here, target.now, there);
    }
    return "";
}

}  // namespace

PositionDifferences other_positions(const StatementEdit& source, const StatementEdit& target) {
    PositionDifferences found;
    std::vector<std::string>& out = found.sentences;
    bool braces = false;
    const auto compare = [&](const std::vector<Anchor>& shared, const std::vector<Statement>& here,
                             const std::vector<size_t>& at, const std::vector<Statement>& there,
                             const std::vector<size_t>& other, const char* verb) {
        for (size_t k = 0; k < std::min(at.size(), other.size()); ++k) {
            const bool is_brace = here[at[k]].is_brace(), other_is_brace = there[other[k]].is_brace();
            if (is_brace == other_is_brace && same_position(shared, at[k], other[k])) {
                if (is_brace || same_among_others(shared, {here, at[k], at}, {there, other[k], other})) continue;
                found.is_sure = true;
            }
            if (is_brace || other_is_brace)
                braces = true;
            else
                out.push_back(std::string("both sides ") + verb + " `" + here[at[k]].shown +
                              "`, but at different places: " + both_positions(here, at[k], there, other[k]));
        }
    };
    const std::vector<Anchor> before = anchors(source.before, target.before);
    compare(still_there(before, source, target), source.now, source.gained, target.now, target.gained, "gained");
    compare(before, source.before, source.lost, target.before, target.lost, "lost");
    if (!braces || !out.empty()) return found;
    const std::string moved = moved_block(source, target);
    out.push_back(moved.empty() ? "the two sides closed a block at different places" : moved);
    return found;
}

}  // namespace porttool
