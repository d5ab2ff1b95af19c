// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/transplant.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "porttool/sync/added_clauses.h"
#include "porttool/sync/bare_declaration.h"
#include "porttool/sync/changed_clauses.h"
#include "porttool/sync/edit_reading.h"
#include "porttool/sync/old_uses.h"
#include "porttool/sync/operands.h"

namespace porttool {
namespace {

class EditCarrier : EditReading {
public:
    using EditReading::EditReading;

    Transplant run(bool is_method) {
        const InsertedUses uses(*this, is_method);
        std::vector<WordsReplaced> respelled = carry_changed_clauses(*this, uses, out_);
        added_ = carry_added_clauses(*this, uses, out_);
        for (size_t c = 0; c < texts_.before.clauses.size(); ++c)
            if (texts_.edit.clause_of[c] == kNothing && !added_.held.contains(c)) remove(c);
        keep_own_calls();
        keep_blocks_around_own();
        keep_blocks_from_emptying();
        leave_lost();
        drop_blocks_around_nothing();
        drop_open_blocks();
        while (drop_moved_end() || keep_lone_end()) {
        }
        drop_open_blocks();
        leave_old_uses(*this, out_);
        move_beside_launches();
        doubt_other_heads();
        // In the order of the source's text, whatever came upon it.
        std::stable_sort(out_.left.begin(), out_.left.end(),
                         [](const LeftOver& a, const LeftOver& b) { return a.source_word < b.source_word; });
        // An edit of spelling alone is due beside what else is written, and beside nothing where somebody asks for it.
        if (out_.left.empty() && (!out_.empty() || out_.already == 0))
            std::move(respelled.begin(), respelled.end(), std::back_inserter(out_.replaced));
        for (const size_t was : origin_) out_.stands_for.push_back(was == kNothing ? kNothing : counterpart(was));
        return std::move(out_);
    }

private:
    void remove(size_t was) {
        const Clause& clause = before(was);
        const size_t there = counterpart(was);
        if (!added_.moved.contains(was) && stays_in_port(was)) {
            ++out_.already;
            return;
        }
        // What is declared together with others now goes where the port declares it so, and is nothing to one that
        // gives it a value at once.
        if (const auto old = bare_declaration(texts_.before, clause); there != kNothing && old &&
                                                                      declares_all(texts_.now, *old) &&
                                                                      !bare_declaration(texts_.target, target(there))) {
            ++out_.already;
            return;
        }
        if (there == kNothing) {
            const std::optional<size_t> elsewhere = goes_for_good(was) ? only_statement(was) : std::nullopt;
            if (elsewhere)
                out_.removed.push_back(*elsewhere);
            else if (!clause.closes && !only_declared(was))
                lost_.push_back(was);
            else if (!clause.closes)
                ++out_.already;
            return;
        }
        if (!clause.closes &&
            (is_said_more_often(was, there) || is_doubtful(clause.inside) || is_doubtful_directive(was)))
            return leave("the source lost `" + shown(texts_.before.words, clause.first, clause.end) +
                             "`; the port says that in more places, or under another condition",
                         place_now(was), target(there).first);
        if (!clause.closes) {
            const CarriedWords old = carry_old(clause.first, clause.end);
            if (texts_.across.likeness[was] < 0.8 && !added_.moved.contains(was) &&
                !says(target(there).first, target(there).end, old.words, true)) {
                leave("the source lost `" + shown(texts_.before.words, clause.first, clause.end) +
                          "`; whether the port's `" +
                          shown(texts_.target.words, target(there).first, target(there).end) +
                          "` is to go is not certain",
                      place_now(was), target(there).first);
                out_.left.back().was = was;
                return;
            }
        }
        out_.removed.push_back(there);
    }

    /// True for a declaration that gave no value, of names that are declared together with others now, or that the port
    /// never had.
    bool only_declared(size_t was) const {
        const auto old = bare_declaration(texts_.before, before(was));
        if (!old) return false;
        if (declares_all(texts_.now, *old)) return true;
        const std::vector<std::string>& words = texts_.target.words;
        return old->is_plain && std::none_of(words.begin(), words.end(),
                                             [&](const std::string& word) { return old->names.contains(word); });
    }

    /// True for a statement that stands elsewhere in the source's new text, and was not carried there: the port has it
    /// where it is to be, or that is left.
    bool stays_in_port(size_t was) const {
        constexpr size_t kShortest = 4;
        if (before(was).closes || before(was).opens || before(was).size() < kShortest) return false;
        for (size_t is = 0; is < origin_.size(); ++is) {
            if (origin_[is] != kNothing || now(is).size() != before(was).size() || is_added(is)) continue;
            const auto first = texts_.now.exact.begin();
            if (std::equal(first + static_cast<std::ptrdiff_t>(now(is).first),
                           first + static_cast<std::ptrdiff_t>(now(is).end),
                           texts_.before.exact.begin() + static_cast<std::ptrdiff_t>(before(was).first)))
                return true;
        }
        return false;
    }

    /// Where the source calls another function that nothing in the port has, and the port called one of its own all
    /// along, which it would call now is not told: `image -> set ( data , n ) ;` for `setSize ( n ) ;`.
    void keep_own_calls() {
        for (size_t was = 0; was < texts_.before.clauses.size(); ++was) {
            const size_t there = counterpart(was), is = clause_behind_kept(was);
            const auto gone = std::find(out_.removed.begin(), out_.removed.end(), there);
            if (there == kNothing || gone == out_.removed.end() || texts_.edit.clause_of[was] != kNothing) continue;
            if (is >= origin_.size() || origin_[is] != kNothing || !is_added(is)) continue;
            const size_t here = called_in(texts_.before, before(was)), other = called_in(texts_.target, target(there)),
                         made = called_in(texts_.now, now(is));
            if (here == kNothing || other == kNothing || made == kNothing) continue;
            const std::string& name = texts_.now.words[made];
            const std::vector<std::string>& port = texts_.target.words;
            const bool is_known =
                std::find(port.begin(), port.end(), name) != port.end() || translator_.is_declared(name);
            if (is_known || texts_.before.common[here] == texts_.target.common[other]) continue;
            leave("the source has `" + shown(texts_.now.words, now(is).first, now(is).end) + "` for `" +
                      shown(texts_.before.words, before(was).first, before(was).end) + "`; the port calls `" +
                      port[other] + "` there",
                  now(is).first, target(there).first);
            out_.removed.erase(gone);
            out_.added.erase(out_.added.begin() + static_cast<std::ptrdiff_t>(added_with(is).first));
        }
    }

    /// The first function that a statement calls.
    static size_t called_in(const AlignedText& text, const Clause& clause) {
        if (clause.opens || clause.closes) return kNothing;
        for (size_t i = clause.first; i + 1 < clause.end; ++i)
            if (is_name(text.words[i]) && text.words[i + 1] == "(") return i;
        return kNothing;
    }

    /// A block that went with all that the source had in it stays around what the port has of its own there.
    void keep_blocks_around_own() {
        const auto went = [&](size_t c) { return texts_.edit.clause_of[c] == kNothing; };
        const auto goes = [&](size_t c) { return is_removed(c); };
        for (size_t c = 0; c < texts_.before.clauses.size(); ++c) {
            const size_t end = before(c).opens ? before(c).partner : Clause::kNone;
            const size_t there = counterpart(c);
            if (end == Clause::kNone || !went(c) || there == kNothing || !goes(there)) continue;
            const size_t end_there = target(there).partner;
            if (end_there == Clause::kNone || !goes(end_there)) continue;
            bool all = true, any_own = false;
            for (size_t i = c; i <= end; ++i) all &= went(i);
            for (size_t i = there; i <= end_there; ++i) any_own |= !goes(i);
            if (!all || !any_own) continue;
            std::erase_if(out_.removed, [&](size_t i) { return i == there || i == end_there; });
            leave("the source lost `" + shown(texts_.before.words, before(c).first, before(c).end) +
                      "` with all within it; the port has statements of its own there",
                  place_now(c), target(there).first);
        }
    }

    /// A block of the port's own, as a launch around a kernel's call, does not stay without all that it had: it would
    /// have to go as well.
    void keep_blocks_from_emptying() {
        const auto goes = [&](size_t c) { return is_removed(c); };
        for (size_t c = 1; c < texts_.target.clauses.size(); ++c) {
            const size_t end = target(c).opens ? target(c).partner : Clause::kNone;
            if (end == Clause::kNone || end == c + 1 || goes(c) || stands_for_something(c) || gets_any(c, end))
                continue;
            bool all = true;
            for (size_t i = c + 1; i < end; ++i) all &= goes(i);
            if (!all) continue;
            std::erase_if(out_.removed, [&](size_t i) { return c < i && i < end; });
            for (size_t was = 0; was < texts_.before.clauses.size(); ++was)
                if (counterpart(was) == c + 1)
                    leave("the source lost `" + shown(texts_.before.words, before(was).first, before(was).end) +
                              "`; the port would keep an empty block around it",
                          place_now(was), target(c + 1).first);
        }
    }

    /// True if clauses come into a block of the target.
    bool gets_any(size_t head, size_t end) const {
        return std::any_of(out_.added.begin(), out_.added.end(), [&](const ClausesAdded& one) {
            return target(head).end <= one.before && one.before <= target(end).first;
        });
    }

    /// True if the source has nothing new in the place of a clause that it lost.
    bool goes_for_good(size_t was) const {
        const size_t next = clause_behind_kept(was);
        return next < origin_.size() && origin_[next] != kNothing;
    }

    /// What the source has now behind the nearest clause before one that it kept.
    size_t clause_behind_kept(size_t was) const {
        for (size_t i = was; i-- > 0;)
            if (texts_.edit.clause_of[i] != kNothing) return texts_.edit.clause_of[i] + 1;
        return 0;
    }

    /// Statements that the source lost side by side, and that the port has nothing for at one place, are one item.
    void leave_lost() {
        for (size_t i = 0; i < lost_.size();) {
            const size_t place = place_now(lost_[i]);
            const auto [there, is_alike] = near(lost_[i]);
            size_t end = i + 1;
            while (end < lost_.size() && place_now(lost_[end]) == place && near(lost_[end]).word == there) ++end;
            leave("the source lost `" + shown(texts_.before.words, before(lost_[i]).first, before(lost_[end - 1]).end) +
                      "`; the port has nothing that clearly stands for it",
                  place, there);
            out_.left.back().statements = end - i;
            out_.left.back().was = lost_[i];
            out_.left.back().is_sure = is_alike && !only_speaks(i, end);
            i = end;
        }
    }

    /// True for lost statements that speak to people alone, of which a port without them owes nothing for sure.
    bool only_speaks(size_t first, size_t end) const {
        return std::all_of(lost_.begin() + static_cast<std::ptrdiff_t>(first),
                           lost_.begin() + static_cast<std::ptrdiff_t>(end),
                           [&](size_t was) { return speaks_to_people(texts_.before, before(was)); });
    }

    /// A word of the source's new text near where a clause of its old one stood.
    size_t place_now(size_t was) const {
        for (size_t i = was; i-- > 0;)
            if (texts_.edit.clause_of[i] != kNothing) return now(texts_.edit.clause_of[i]).first;
        return 0;
    }

    /// A new block that comes around what the source had comes where the port has some of that.
    void drop_blocks_around_nothing() {
        for (size_t head = 0; head < origin_.size(); ++head) {
            if (origin_[head] != kNothing || !now(head).opens || now(head).partner == Clause::kNone) continue;
            if (!is_added(head) || !is_around_nothing(head)) continue;
            const auto [one, before] = added_with(head);
            leave("the source gained `" + shown(texts_.now.words, now(head).first, now(head).end) +
                      "`; the port has nothing that clearly stands for what it comes around",
                  now(head).first, std::min(before, texts_.target.words.size() - 1));
            out_.added.erase(out_.added.begin() + static_cast<std::ptrdiff_t>(one));
            if (is_added(now(head).partner))
                out_.added.erase(out_.added.begin() + static_cast<std::ptrdiff_t>(added_with(now(head).partner).first));
        }
    }

    bool is_around_nothing(size_t head) const {
        constexpr double kAlike = 0.45;  // less may stand for something else
        bool any = false;
        for (size_t c = head + 1; c < now(head).partner; ++c) {
            if (origin_[c] == kNothing || now(c).closes) continue;
            any = true;
            const size_t was = origin_[c];
            const bool is_launched = std::any_of(texts_.launches.begin(), texts_.launches.end(), [&](const auto& one) {
                return one.here.first <= was && was <= one.here.last;
            });
            const bool stands =
                counterpart(was) != kNothing && (before(was).opens || texts_.across.likeness[was] >= kAlike);
            if (is_launched || stands) return false;
        }
        return any;
    }

    /// Where a clause is among those that are added, and before which word these come.
    std::pair<size_t, size_t> added_with(size_t clause) const {
        size_t i = 0;
        while (std::none_of(out_.added[i].clauses.begin(), out_.added[i].clauses.end(),
                            [&](const ClauseAdded& added) { return added.source == clause; }))
            ++i;
        return {i, out_.added[i].before};
    }

    /// A block comes whole or not at all: what opens one goes with what closes it.
    void drop_open_blocks() {
        const auto lacks_partner = [&](const ClausesAdded& one) {
            return std::any_of(one.clauses.begin(), one.clauses.end(), [&](const ClauseAdded& clause) {
                const size_t partner = now(clause.source).partner;
                return partner != Clause::kNone && origin_[partner] == kNothing && !is_added(partner);
            });
        };
        for (auto found = out_.added.begin();;) {
            found = std::find_if(out_.added.begin(), out_.added.end(), lacks_partner);
            if (found == out_.added.end()) return;
            const Clause& first = now(found->clauses.front().source);
            leave("the source gained `" + shown(texts_.now.words, first.first, first.end) +
                      "`; the other end of its block has no sure place in the port",
                  first.first, std::min(found->before, texts_.target.words.size() - 1));
            out_.added.erase(found);
        }
    }

    /// An end of a block that the source moved, which comes to the port where that gives up its own end of that block.
    bool drop_moved_end() {
        const auto stays = [&](const ClauseAdded& clause) {
            const size_t partner = now(clause.source).partner;
            if (partner == Clause::kNone || origin_[partner] == kNothing) return false;
            const size_t there = counterpart(origin_[partner]);
            return there == kNothing || !is_removed(target(there).partner);
        };
        for (auto one = out_.added.begin(); one != out_.added.end(); ++one)
            if (std::any_of(one->clauses.begin(), one->clauses.end(), stays)) {
                const Clause& first = now(one->clauses.front().source);
                leave("the source gained `" + shown(texts_.now.words, first.first, first.end) +
                          "`, and the block around it ends elsewhere; the port's goes on",
                      first.first, std::min(one->before, texts_.target.words.size() - 1));
                out_.added.erase(one);
                return true;
            }
        return false;
    }

    /// The other way round: an end that would go where no other comes for it.
    bool keep_lone_end() {
        for (const size_t c : out_.removed) {
            const size_t partner = target(c).partner;
            if (partner == Clause::kNone || is_removed(partner) || gets_end(partner)) continue;
            const bool is_told = std::any_of(out_.left.begin(), out_.left.end(),
                                             [&](const LeftOver& one) { return one.target_word == target(c).first; });
            for (size_t was = 0; was < texts_.before.clauses.size() && !is_told; ++was)
                if (counterpart(was) == c)
                    leave("the source lost `" + shown(texts_.before.words, before(was).first, before(was).end) +
                              "`; the other end of its block stays in the port",
                          place_now(was), target(c).first);
            std::erase(out_.removed, c);
            return true;
        }
        return false;
    }

    /// True if one end of a block of the target is added again, elsewhere.
    bool gets_end(size_t stays) const {
        for (const ClausesAdded& one : out_.added)
            for (const ClauseAdded& clause : one.clauses) {
                const size_t partner = now(clause.source).partner;
                if (partner != Clause::kNone && origin_[partner] != kNothing && counterpart(origin_[partner]) == stays)
                    return true;
            }
        return false;
    }

    bool is_removed(size_t there) const {
        return std::find(out_.removed.begin(), out_.removed.end(), there) != out_.removed.end();
    }

    bool is_added(size_t clause) const {
        return std::any_of(out_.added.begin(), out_.added.end(), [&](const ClausesAdded& one) {
            return std::any_of(one.clauses.begin(), one.clauses.end(),
                               [&](const ClauseAdded& added) { return added.source == clause; });
        });
    }

    void leave(std::string message, size_t source_word, size_t target_word) {
        out_.left.push_back({std::move(message), source_word, target_word});
    }

    /// What host code does stands beside what the port hands to its device, whatever in there resembles it: behind it
    /// what comes behind a launch in the source, and behind the blocks around it that end in between.
    void move_beside_launches() {
        if (!translator_.is_on_host()) return;
        const std::vector<Launch> here = launches_in(texts_.before), there = launches_in(texts_.target);
        if (here.empty() || there.empty()) return;
        for (LeftOver& one : out_.left) one.target_word = beside_launch(one, here, there);
    }

    size_t beside_launch(const LeftOver& one, const std::vector<Launch>& here, const std::vector<Launch>& there) const {
        constexpr double kSame = 0.6;
        const auto clause_at = [](const AlignedText& text, size_t word) {
            size_t c = 0;
            while (c + 1 < text.clauses.size() && text.clauses[c].end <= word) ++c;
            return c;
        };
        const size_t is = clause_at(texts_.now, one.source_word), stands = clause_at(texts_.target, one.target_word);
        const bool is_lost = one.was != kNothing, are_paired = here.size() == there.size();
        const auto around = std::find_if(there.begin(), there.end(), [&](const Launch& launch) {
            return (are_paired ? launch.first <= stands : launch.first < stands) && stands < launch.last;
        });
        size_t kept = is;
        while (kept > 0 && origin_[kept] == kNothing) --kept;
        if (around == there.end() || is == 0 || (!is_lost && origin_[kept] == kNothing)) return one.target_word;
        const size_t was = is_lost ? one.was : origin_[kept];
        const bool is_old = is_lost || kept == is;
        if (is_old && counterpart(was) == stands && texts_.across.likeness[was] >= kSame) return one.target_word;
        const auto runs = [&](const Launch& launch) { return launch.first <= was && was <= launch.last; };
        const auto launched = is_old ? std::find_if(here.begin(), here.end(), runs) : here.end();
        if (launched != here.end()) {  // behind `q . submit (` stands what is started, and how often
            const size_t head = (are_paired ? there[static_cast<size_t>(launched - here.begin())] : *around).first;
            return target(texts_.target.words[target(head).first] == "#" ? head : head + 1).first;
        }
        // The last launch before it.
        const auto next = std::find_if(here.begin(), here.end(), [&](const Launch& launch) {
            return is_old ? was < launch.first : was < launch.last;
        });
        if (next == here.begin()) return target(are_paired ? there.front().first : around->first).first;
        const Launch& last = *std::prev(next);
        const bool is_nearer_next = next != here.end() && next->first - was < was - last.last;
        if (!are_paired && is_nearer_next) return target(around->first).first;
        size_t end = are_paired ? there[static_cast<size_t>(next - here.begin()) - 1].last : around->last;
        for (size_t c = last.last + 1; c <= was; ++c)
            if (before(c).closes && before(c).partner < last.first && target(end).inside != Clause::kNone &&
                target(target(end).inside).partner != Clause::kNone)
                end = target(target(end).inside).partner;
        const bool goes_on = end + 1 < texts_.target.clauses.size() && !target(end + 1).closes;
        return target(goes_on ? end + 1 : end).first;
    }

    /// A head that shares no parameter with the port's is that of a function which the port has within another: what
    /// it has of these the port may not owe.
    void doubt_other_heads() {
        const auto named = [](const AlignedText& text) {
            std::set<uint32_t> out;
            const Clause& head = text.clauses.front();
            size_t i = head.first;
            while (i < head.end && text.words[i] != "(") ++i;
            for (++i; i + 1 < head.end; ++i)
                if (is_name(text.words[i]) && is_one_of(text.words[i + 1], {",", ")", "[", "="}))
                    out.insert(text.common[i]);
            return out;
        };
        if (texts_.before.clauses.empty() || texts_.target.clauses.empty() || !before(0).opens) return;
        const std::set<uint32_t> mine = named(texts_.before), theirs = named(texts_.target);
        const bool any_shared =
            std::any_of(mine.begin(), mine.end(), [&](uint32_t name) { return theirs.contains(name); });
        if (any_shared || mine.empty()) return;
        for (LeftOver& one : out_.left) one.is_sure &= one.source_word >= now(0).end;
    }

    Transplant out_;
    AddedSources added_;
    std::vector<size_t> lost_;  ///< clauses of the source's old text without a counterpart
};

}  // namespace

Transplant transplant(const EditTexts& texts, const EditTranslator& translator,
                      const std::function<std::string(size_t)>& written, bool is_method) {
    return EditCarrier(texts, translator, written).run(is_method);
}

}  // namespace porttool
