// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/withdrawn.h"

#include <algorithm>

#include "porttool/sync/operands.h"

namespace porttool {
namespace {

class Withdrawer {
public:
    Withdrawer(std::set<std::string> names, const AlignedText& now, const AlignedText& target, const Transplant& found)
        : names_(std::move(names)), now_(now), target_(target), left_(found) {}

    bool run(Transplant& found) {
        const size_t size = left_.size();
        while (take_replaced() || take_added() || take_removed()) {
        }
        if (left_.size() == size || parts_a_block()) return false;
        found = std::move(left_);
        return true;
    }

private:
    template <class Words>
    bool has_name(const Words& words) const {
        return std::any_of(words.begin(), words.end(),
                           [&](const CarriedWord& word) { return names_.contains(word.text); });
    }
    bool has_name_there(size_t first, size_t end) const {
        const auto word = target_.words.begin();
        return std::any_of(word + static_cast<std::ptrdiff_t>(first), word + static_cast<std::ptrdiff_t>(end),
                           [&](const std::string& text) { return names_.contains(text); });
    }

    /// What came with words that are taken back comes no more.
    void lose(const std::vector<CarriedWord>& words) {
        for (const CarriedWord& word : words)
            if (is_name(word.text) &&
                std::find(target_.words.begin(), target_.words.end(), word.text) == target_.words.end())
                names_.insert(word.text);
    }

    /// A clause is changed as a whole or not at all.
    bool take_replaced() {
        for (const WordsReplaced& one : left_.replaced) {
            if (!has_name(one.words) && !has_name_there(one.first, one.end)) continue;
            const Clause clause = clause_at(one.first);
            if (clause.first == 0) continue;  // callers have the new head
            std::erase_if(left_.replaced, [&](const WordsReplaced& other) {
                const bool is_of_it = clause.first <= other.first && other.first < std::max(clause.end, one.first + 1);
                if (is_of_it) lose(std::vector(other.words));
                return is_of_it;
            });
            return true;
        }
        return false;
    }

    Clause clause_at(size_t word) const {
        Clause out;
        for (const Clause& clause : target_.clauses)
            if (clause.first <= word && word < clause.end) out = clause;
        return out.size() == 0 ? Clause{word, word + 1} : out;
    }

    bool take_added() {
        const auto found = std::find_if(left_.added.begin(), left_.added.end(), [&](const ClausesAdded& one) {
            return std::any_of(one.clauses.begin(), one.clauses.end(),
                               [&](const ClauseAdded& clause) { return has_name(clause.words); });
        });
        if (found == left_.added.end()) return false;
        for (const ClauseAdded& clause : found->clauses) lose(clause.words);
        left_.added.erase(found);
        return true;
    }

    bool take_removed() {
        return std::erase_if(left_.removed, [&](size_t clause) {
                   const Clause& one = target_.clauses[clause];
                   return !one.closes && !one.opens && has_name_there(one.first, one.end);
               }) > 0;
    }

    /// True if one end of a block came, or went, without the other.
    bool parts_a_block() const {
        std::set<size_t> added;
        for (const ClausesAdded& one : left_.added)
            for (const ClauseAdded& clause : one.clauses) added.insert(clause.source);
        const bool parts_new = std::any_of(added.begin(), added.end(), [&](size_t c) {
            const Clause& clause = now_.clauses[c];
            return clause.partner != Clause::kNone && !added.contains(clause.partner) &&
                   left_.stands_for[clause.partner] == Alignment::kNone;
        });
        return parts_new || !stays_balanced();
    }

    /// True if as many blocks open as close in what comes and goes.
    bool stays_balanced() const {
        int depth = 0;
        for (const ClausesAdded& one : left_.added)
            for (const ClauseAdded& clause : one.clauses) {
                const Clause& made = now_.clauses[clause.source];
                depth += (made.opens ? 1 : 0) - (made.closes ? 1 : 0);
            }
        for (const size_t clause : left_.removed)
            depth -= (target_.clauses[clause].opens ? 1 : 0) - (target_.clauses[clause].closes ? 1 : 0);
        return depth == 0;
    }

    std::set<std::string> names_;
    const AlignedText &now_, &target_;
    Transplant left_;
};

}  // namespace

bool withdraw(std::set<std::string> names, const AlignedText& now, const AlignedText& target, Transplant& found) {
    return Withdrawer(std::move(names), now, target, found).run(found);
}

}  // namespace porttool
