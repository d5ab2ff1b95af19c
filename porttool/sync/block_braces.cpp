// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/block_braces.h"

#include <algorithm>

#include "porttool/language/words.h"

namespace porttool {
namespace {

constexpr size_t kNoClause = Clause::kNone;

/// How often a unit has braces around a single statement that is controlled, and how often none.
struct BracesOfBlocks {
    size_t with = 0, without = 0;
    bool any() const { return with + without > 0; }
    /// 1 where there always are some, -1 where never, 0 where both are found.
    int style() const { return with > 0 && without == 0 ? 1 : without > 0 && with == 0 ? -1 : 0; }
};

template <class Counts>
BracesOfBlocks brace_manner(const PlacedUnit& unit, const Counts& counts) {
    BracesOfBlocks out;
    for (size_t c = 0; c < unit.clauses.size(); ++c) {
        const Clause& one = unit.clauses[c];
        const std::string& head = unit.words.words[one.first];
        if (!one.opens || one.partner != c + 2 || !(word_is(head, kControls) || head == "else") || !counts(c)) continue;
        ++(unit.words.is_added(one.end - 1) ? out.without : out.with);
    }
    return out;
}

/// The manner of the source as it was, where it had any; else that of what came.
int style_of_source(const PlacedUnit& source, const Transplant& transplant) {
    const BraceEdits& edits = transplant.braces;
    BracesOfBlocks was = brace_manner(source, [&](size_t c) {
        const bool is_old = c < transplant.stands_for.size() && transplant.stands_for[c] != kNoClause;
        return is_old && !edits.came.contains(c) && !edits.went.contains(c);
    });
    was.with += edits.went.size();
    was.without += edits.came.size();
    return (was.any() ? was : brace_manner(source, [](size_t) { return true; })).style();
}

class BracePlanner {
public:
    BracePlanner(const std::vector<ResultClause>& result, const Transplant& transplant, const PlacedUnit& source,
                 const PlacedUnit& target)
        : result_(result), source_(source), target_(target), edited_(transplant.braces) {
        // Of two manners that both sides keep to, the target's; else what the source has.
        const int style = brace_manner(target, [](size_t) { return true; }).style();
        style_ = style_of_source(source, transplant) * style < 0 ? style : 0;
        origin_.assign(target.clauses.size(), kNoClause);
        for (size_t c = 0; c < transplant.stands_for.size(); ++c)
            if (transplant.stands_for[c] != kNoClause) origin_[transplant.stands_for[c]] = c;
        for (const size_t clause : transplant.removed) changed_.insert(target.clauses[clause].inside);
    }

    BlockBraces run() {
        for (size_t head = 0; head < result_.size(); ++head)
            if (clause(head).opens && result_[head].partner != kNoClause) write(head, result_[head].partner);
        return std::move(out_);
    }

private:
    const PlacedUnit& side(size_t at) const { return result_[at].is_new ? source_ : target_; }
    const Clause& clause(size_t at) const { return side(at).clauses[result_[at].clause]; }
    const std::string& head_word(size_t at) const { return side(at).words.words[clause(at).first]; }
    bool has_brace(size_t at) const {
        return !side(at).words.is_added(clause(at).opens ? clause(at).end - 1 : clause(at).first);
    }

    bool has_brace_in_source(size_t head) const { return !source_.words.is_added(source_.clauses[head].end - 1); }

    struct Content {
        size_t statements = 0, blocks = 0;  ///< an `if` with its `else` is one block
        bool any_new = false;
    };
    Content content_of(size_t head, size_t end) const {
        Content out;
        for (size_t at = head + 1; at < end; ++at) {
            out.any_new |= result_[at].is_new;
            if (!clause(at).opens || result_[at].partner == kNoClause) {
                ++out.statements;
                continue;
            }
            if (at == head + 1 || head_word(at) != "else") ++out.blocks;
            at = result_[at].partner;
            out.any_new |= result_[at].is_new;
        }
        return out;
    }

    /// True if a block without braces would take the `else` that follows for its own.
    bool would_take_else(size_t head, size_t end) const {
        return head_word(head) != "else" && end + 1 < result_.size() && clause(end + 1).opens &&
               head_word(end + 1) == "else";
    }

    bool wanted(size_t head, size_t end) const {
        const Content content = content_of(head, end);
        const size_t there = result_[head].is_new ? kNoClause : origin_[result_[head].clause];
        // A block that ends elsewhere now is the source's, in its manner.
        const bool remade = there != kNoClause && result_[end].is_new;
        const bool written = remade ? has_brace_in_source(there) : has_brace(head);
        const bool is_new = result_[head].is_new || remade;
        if (!is_new && there != kNoClause && edited_.came.contains(there)) return true;
        if (!is_new && there != kNoClause && edited_.went.contains(there) && content.statements == 1 &&
            content.blocks == 0)
            return false;
        if (!is_new &&
            (written || !(content.any_new || result_[end].is_new || changed_.contains(result_[head].clause))))
            return written;
        if (content.statements == 1 && content.blocks == 0) return is_new && (style_ == 0 ? written : style_ > 0);
        if (content.statements > 0 || content.blocks != 1 || would_take_else(head, end)) return true;
        if (is_new) return written;
        return there == kNoClause || has_brace_in_source(there);
    }

    void write(size_t head, size_t end) {
        const bool written = wanted(head, end);
        if (written != has_brace(head)) {
            if (result_[head].is_new)
                (written ? out_.source_written : out_.source_hidden).insert(clause(head).end - 1);
            else
                (written ? out_.opened : out_.unopened).push_back(result_[head].clause);
        }
        if (written == has_brace(end)) return;
        if (result_[end].is_new)
            (written ? out_.source_written : out_.source_hidden).insert(clause(end).first);
        else
            (written ? out_.closed : out_.dropped).push_back(result_[end].clause);
    }

    const std::vector<ResultClause>& result_;
    const PlacedUnit &source_, &target_;
    const BraceEdits& edited_;
    int style_ = 0;
    std::vector<size_t> origin_;  ///< of each clause of the target the one of the source's new text
    std::set<size_t> changed_;    ///< heads of the target that lose a clause of their block
    BlockBraces out_;
};

}  // namespace

std::vector<ResultClause> result_clauses(const Transplant& transplant, const PlacedUnit& source,
                                         const PlacedUnit& target) {
    std::vector<const ClausesAdded*> added;
    for (const ClausesAdded& one : transplant.added) added.push_back(&one);
    std::stable_sort(added.begin(), added.end(),
                     [](const ClausesAdded* a, const ClausesAdded* b) { return a->before < b->before; });
    const std::set<size_t> removed(transplant.removed.begin(), transplant.removed.end());
    std::vector<ResultClause> out;
    auto next = added.begin();
    const auto add_before = [&](size_t word) {
        for (; next != added.end() && (*next)->before <= word; ++next)
            for (const ClauseAdded& clause : (*next)->clauses) out.push_back({true, clause.source});
    };
    for (size_t c = 0; c < target.clauses.size(); ++c) {
        add_before(target.clauses[c].first);
        if (!removed.contains(c)) out.push_back({false, c});
    }
    add_before(Clause::kNone);
    std::vector<size_t> open;
    for (size_t at = 0; at < out.size(); ++at) {
        const Clause& clause = (out[at].is_new ? source : target).clauses[out[at].clause];
        if (clause.opens) open.push_back(at);
        if (!clause.closes || open.empty()) continue;
        out[at].partner = open.back();
        out[open.back()].partner = at;
        open.pop_back();
    }
    return out;
}

BlockBraces block_braces(const std::vector<ResultClause>& result, const Transplant& transplant,
                         const PlacedUnit& source, const PlacedUnit& target) {
    return BracePlanner(result, transplant, source, target).run();
}

}  // namespace porttool
