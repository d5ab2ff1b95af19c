// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/pair_reading.h"

#include <algorithm>
#include <map>

#include "porttool/audit/around.h"
#include "porttool/audit/aside.h"
#include "porttool/audit/declaration_edit.h"
#include "porttool/audit/likeness.h"
#include "porttool/audit/replaced_statement.h"
#include "porttool/audit/said_otherwise.h"
#include "porttool/audit/same_value.h"
#include "porttool/audit/todays_difference.h"
#include "porttool/language/words.h"
#include "porttool/normal/statements.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

bool has_past(const UnitLineage& lineage) {
    return !lineage.removed().empty() ||
           std::any_of(lineage.statements().begin(), lineage.statements().end(), [](const StatementLineage& line) {
               return std::any_of(line.steps.begin(), line.steps.end(),
                                  [](const LineageStep& step) { return step.counts || !step.before.empty(); });
           });
}

constexpr float kFaint = 0.1f;        ///< of a place: below, it says nothing
constexpr float kOtherLoop = 0.3f;    ///< a loop went as another one came
constexpr float kOtherBranch = 0.3f;  ///< the other side says it in two branches of an `#if`, and one may have the edit

/// What two texts that are known say to each other's past.
class PairReader {
public:
    PairReader(const BySide<SideOfPair>& pair, const Dialect& dialect)
        : pair_(pair), dialect_(dialect), texts_(pair, dialect), otherwise_(texts_, pair), replaced_(texts_, pair) {
        for (const Side side : kBothSides) alone_[side] = without_twin(side);
    }

    PairReading run_for_slips() {
        PairReading out;
        out.alike = texts_.alike();
        out.slips = TodaysDifferences(texts_, otherwise_).slips();
        return out;
    }

    PairReading run(bool has_any_past) {
        PairReading out;
        out.alike = texts_.alike();
        if (has_any_past)
            for (const Side side : kBothSides) judge_side(side, out.missing);
        const TodaysDifferences today(texts_, otherwise_);
        if (out.missing.empty()) out.differs = today.few();
        out.slips = today.slips();
        drop_what_is_told(out);
        drop_what_the_other_undid(out.missing);
        return out;
    }

private:
    void judge_side(Side side, std::vector<MissingEdit>& out) {
        std::map<uint32_t, MissingEdit> by_commit;
        const auto note = [&](uint32_t commit, MissingPlace place) {
            MissingEdit& edit = by_commit
                                    .try_emplace(commit, MissingEdit{side,
                                                                     commit,
                                                                     {},
                                                                     pair_[other(side)].lineage->edited_in(commit),
                                                                     pair_[other(side)].lineage->edited_since(commit),
                                                                     pair_[other(side)].lineage->begun_after(commit),
                                                                     pair_[side].lineage->places_edited(commit)})
                                    .first->second;
            edit.places.push_back(std::move(place));
        };
        for (const StatementLineage& line : pair_[side].lineage->statements()) judge_line(side, line, note);
        for (const RemovedStatement& one : pair_[side].lineage->removed()) judge_removed(side, one, note);
        for (auto& [commit, edit] : by_commit) out.push_back(std::move(edit));
    }

    /// True if the statements of the own side say what that of the other says as often as the other side does: then it
    /// is the counterpart of one of those.
    bool is_explained(Side side, const WeighedWords& old_text, size_t there, float far, size_t own) const {
        const auto& others = texts_.sides[other(side)].weighed;
        const auto& here = texts_.sides[side].weighed;
        size_t there_count = 0, here_count = 0;
        for (size_t i = 0; i < others.size(); ++i)
            if (!texts_.sides[other(side)].repeats.contains(i) && std::abs(others[i].sum - old_text.sum) <= far &&
                distance(old_text, others[i]) <= far)
                ++there_count;
        for (size_t i = 0; i < here.size(); ++i)
            if (i != own && !texts_.sides[side].repeats.contains(i) &&
                std::abs(here[i].sum - others[there].sum) <= far && distance(here[i], others[there]) <= far)
                ++here_count;
        return here_count >= there_count;
    }

    template <class Note>
    void judge_line(Side side, const StatementLineage& line, const Note& note) {
        const WrittenStatement& today = texts_.sides[side].written[line.index];
        const bool bare = is_bare_declaration(words_of_statement(today));
        if (line.steps.empty() || line.index == 0 || (says_nothing(words_of_statement(today)) && !bare)) return;
        if (texts_.sides[side].repeats.contains(line.index)) return;  // the one before says it
        const auto& others = texts_.sides[other(side)].weighed;
        const WeighedWords& now = texts_.sides[side].weighed[line.index];
        const Nearest of_now = nearest(now, others);
        if (of_now.any && of_now.distance <= 0) judge_widened(side, line, of_now.index, note);
        if (!of_now.any || of_now.distance <= 0 || texts_.other_had(side, line.index)) return;
        const std::vector<std::string> whole = texts_.written_out(texts_.sides[side].words[line.index], side);
        if (texts_.said[other(side)].contains(whole)) return;
        size_t best = line.steps.size();
        Nearest found;
        WeighedWords old_text;
        for (size_t k = 0; k < line.steps.size(); ++k) {
            if (line.steps[k].before.empty()) continue;
            WeighedWords past = texts_.weighed_past_of(line.index, line.steps[k].before, side);
            const Nearest near = nearest(past, others);
            if (near.any && near.distance < of_now.distance &&
                (best == line.steps.size() || near.distance < found.distance)) {
                best = k;
                found = near;
                old_text = std::move(past);
            }
        }
        if (best == line.steps.size()) {
            if (!bare) judge_added(side, line, note);
            return;
        }
        if (bare && !declares_another_value(words_of_statement(line.steps[best].before), words_of_statement(today)))
            return;
        size_t told = best;  // the step that counts
        while (!line.steps[told].counts && told > 0) --told;
        if (!line.steps[told].counts) return;
        const float changed = distance(old_text, now);
        const WeighedWords& there = others[found.index];
        if (changed <= 0) return;
        const float leaning = (of_now.distance - found.distance) / changed;
        const float near = 1 - found.distance / (old_text.sum + there.sum);
        if (leaning < 0.5f || near < 0.55f || has_elsewhere(side, line.index)) return;
        if (is_explained(side, old_text, found.index, found.distance, line.index)) return;
        MissingPlace place;
        place.kind = MissingPlace::Kind::Replaced;
        place.before = line.steps[best].before;
        place.now = today;
        place.there = texts_.sides[other(side)].written[found.index];
        if (is_aside(words_of_statement(place.before)) || is_aside(words_of_statement(place.there))) return;
        const std::vector<std::string> was = texts_.past_of(line.index, place.before, side);
        if (texts_.written_out(was, side) == whole) return;  // a value got a name
        if (give_the_same_value(was, texts_.sides[side].words[line.index], has_real_number(words_of_statement(today))))
            return;
        if (give_the_same_value(texts_.sides[other(side)].words[found.index], texts_.sides[side].words[line.index],
                                has_real_number(words_of_statement(today))))
            return;
        if (replaced_.is_one_component(side, texts_.sides[side].words[line.index],
                                       texts_.sides[other(side)].words[found.index]))
            return;
        constexpr float kWrittenOut = 0.5f;  // what a new local holds may stand there in other words
        float substance = substance_of(was, texts_.sides[side].words[line.index], texts_.known_there(side));
        if (texts_.uses_new_local(side, texts_.sides[side].words[line.index]))
            substance = std::max(
                substance, kWrittenOut * substance_of(texts_.written_out(was, side), whole, texts_.known_there(side)));
        place.strength =
            std::min(1.0f, (leaning - 0.3f) / 0.7f) * std::min(1.0f, (near - 0.3f) / 0.7f) * told_by(old_text.sum) *
            substance * still_itself(likeness(old_text, now)) *
            replaced_.missing(side, place, was, texts_.sides[side].words[line.index], line.steps[told].commit);
        if (place.strength < kFaint) return;
        place.strength *=
            anchored(was, texts_.sides[side].words[line.index], texts_.sides[other(side)].words[found.index]);
        if (place.strength < kFaint) return;
        if (is_alternative(texts_.sides[other(side)], found.index, texts_.sides[side])) place.strength *= kOtherBranch;
        place.constants_only = numbers_alone(place.before, place.now);
        place.around = around(side, line.index);
        note(line.steps[told].commit, std::move(place));
    }

    float around(Side side, size_t index) const {
        const auto shared = shared_around(texts_.sides[side], index, texts_.sides[other(side)]);
        return shared ? *shared : texts_.alike();
    }

    bool stands_in_file_of(Side side, const WrittenStatement& statement) const {
        const std::set<std::string>* there = pair_[side].elsewhere;
        return there != nullptr && there->contains(statement_key(statement, dialect_));
    }

    bool has_elsewhere(Side side, size_t index) const {
        return texts_.sides[side].weighed[index].sum >= 3 &&
               stands_in_file_of(other(side), texts_.sides[side].written[index]);
    }

    /// A statement in which a commit made an integer wider, where the other side's, which says the same, has a narrow
    /// one.
    template <class Note>
    void judge_widened(Side side, const StatementLineage& line, size_t there, const Note& note) {
        constexpr float kMayOverflow = 0.45f;
        MissingPlace place;
        place.now = texts_.sides[side].written[line.index];
        place.there = texts_.sides[other(side)].written[there];
        const size_t wide = wide_integers_in(words_of_statement(place.now));
        if (wide == 0 || wide_integers_in(words_of_statement(place.there)) > 0) return;
        const auto step = std::find_if(line.steps.begin(), line.steps.end(), [&](const LineageStep& one) {
            return !one.before.empty() && wide_integers_in(words_of_statement(one.before)) == 0;
        });
        if (step == line.steps.end() || !can_overflow(words_of_statement(place.there))) return;
        place.before = step->before;
        place.strength = kMayOverflow;
        place.widens = true;
        place.around = around(side, line.index);
        note(step->commit, std::move(place));
    }

    /// Those of the other side's statements that do not stand on this side as they are.
    std::vector<WeighedWords> without_twin(Side side) const {
        std::map<std::vector<uint32_t>, size_t> here;
        for (const WeighedWords& own : texts_.sides[side].weighed) ++here[own.words];
        std::vector<WeighedWords> out;
        const ReadSide& others = texts_.sides[other(side)];
        for (size_t i = 0; i < others.weighed.size(); ++i) {
            if (others.repeats.contains(i)) continue;
            const WeighedWords& there = others.weighed[i];
            const auto twin = here.find(there.words);
            if (twin == here.end() || twin->second == 0)
                out.push_back(there);
            else
                --twin->second;
        }
        return out;
    }

    /// How alike the statement is to the nearest of those.
    float likeness_to_others(Side side, const WeighedWords& one) const {
        const Nearest near = nearest(one, alone_[side]);
        return near.any ? 1 - near.distance / (one.sum + alone_[side][near.index].sum) : 0;
    }

    /// The statement before that one which tells a reader where it stands; "" for none.
    WrittenStatement statement_before(Side side, size_t index) const {
        for (size_t i = index; i-- > 1;) {
            const std::vector<std::string> words = words_of_statement(texts_.sides[side].written[i]);
            if (!words.empty() && !is_one_of(words[0], {"#", "else", "break", "continue", "default"}))
                return texts_.sides[side].written[i];
        }
        return "";
    }

    /// A statement that a commit brought in, where the other side has none like it.
    template <class Note>
    void judge_added(Side side, const StatementLineage& line, const Note& note) {
        const LineageStep& born = line.steps.back();
        if (!born.before.empty() || is_bare_return(words_of_statement(texts_.sides[side].written[line.index]))) return;
        const auto step =
            std::find_if(line.steps.rbegin(), line.steps.rend(), [](const auto& one) { return one.counts; });
        if (step == line.steps.rend()) return;
        const WeighedWords& now = texts_.sides[side].weighed[line.index];
        const float there = likeness_to_others(side, now);
        if (there > 0.6f || has_elsewhere(side, line.index) || otherwise_.is_said(side, line.index)) return;
        MissingPlace place;
        place.kind = MissingPlace::Kind::Added;
        place.now = texts_.sides[side].written[line.index];
        place.behind = statement_before(side, line.index);
        place.strength = 0.8f * std::min(1.0f, (1 - there) / 0.6f) * otherwise_.lacking(side, line.index);
        if (place.strength < kFaint || otherwise_.is_said_in_call(side, line.index)) return;
        place.around = around(side, line.index);
        note(born.commit, std::move(place));
    }

    /// A statement that a commit took away, and that the other side still has.
    template <class Note>
    void judge_removed(Side side, const RemovedStatement& one, const Note& note) {
        const auto& others = texts_.sides[other(side)].weighed;
        if (says_nothing(words_of_statement(one.text)) || is_bare_return(words_of_statement(one.text))) return;
        const WeighedWords old_text = texts_.weighed(one.text, side, true);
        const Nearest near = nearest(old_text, others), own = nearest(old_text, texts_.sides[side].weighed);
        if (!near.any || near.index == 0) return;
        if (own.any && likeness(old_text, texts_.sides[side].weighed[own.index]) > 0.6f) return;  // it became that
        if (stands_in_file_of(side, one.text)) return;                                            // it moved there
        const float there = 1 - near.distance / (old_text.sum + others[near.index].sum);
        if (there < 0.85f || is_explained(side, old_text, near.index, near.distance, texts_.sides[side].written.size()))
            return;
        MissingPlace place;
        place.kind = MissingPlace::Kind::Removed;
        place.before = one.text;
        place.there = texts_.sides[other(side)].written[near.index];
        place.strength =
            0.75f * there * told_by(old_text.sum) * (0.2f + 0.8f * otherwise_.neighbours(other(side), near.index));
        if (heads_loop(words_of_statement(one.text)) && brought_loop(side, one.commit)) place.strength *= kOtherLoop;
        if (place.strength < kFaint) return;
        place.around = around(other(side), near.index);
        note(one.commit, std::move(place));
    }

    static bool heads_loop(const std::vector<std::string>& words) {
        return !words.empty() && word_is(words[0], kLoopHead);
    }

    /// True if the commit brought in a loop that the side has today.
    bool brought_loop(Side side, uint32_t commit) const {
        const auto& lines = pair_[side].lineage->statements();
        return std::any_of(lines.begin(), lines.end(), [&](const StatementLineage& line) {
            return !line.steps.empty() && line.steps.back().before.empty() && line.steps.back().commit == commit &&
                   heads_loop(texts_.sides[side].words[line.index]);
        });
    }

    /// A slip that is among the few statements in which the two differ is told as that alone.
    static void drop_what_is_told(PairReading& out) {
        const auto key = [](const MissingPlace& place) { return place.now.empty() ? place.there : place.now; };
        std::set<std::string> slips;
        for (const MissingPlace& place : out.slips) slips.insert(key(place));
        std::erase_if(out.differs, [&](const MissingPlace& place) { return slips.contains(key(place)); });
    }

    /// Where both sides were edited apart in one place, only the newer edit is the one to follow.
    static void drop_what_the_other_undid(std::vector<MissingEdit>& edits) {
        std::map<std::pair<std::string, std::string>, uint32_t> newest;  // by the statements of source and target
        const auto key = [](const MissingEdit& edit, const MissingPlace& place) {
            const bool source = edit.side == Side::Source;
            return std::pair(source ? place.now : place.there, source ? place.there : place.now);
        };
        for (const MissingEdit& edit : edits)
            for (const MissingPlace& place : edit.places) {
                if (place.now.empty() || place.there.empty()) continue;
                const auto known = newest.emplace(key(edit, place), edit.commit).first;
                known->second = std::min(known->second, edit.commit);  // the walk begins with the newest
            }
        for (MissingEdit& edit : edits)
            std::erase_if(edit.places, [&](const MissingPlace& place) {
                const auto known = newest.find(key(edit, place));
                return known != newest.end() && known->second < edit.commit;
            });
        std::erase_if(edits, [](const MissingEdit& edit) { return edit.places.empty(); });
    }

    const BySide<SideOfPair>& pair_;
    const Dialect& dialect_;
    CommonTexts texts_;
    BySide<std::vector<WeighedWords>> alone_;  ///< as without_twin() has them
    SaidOtherwise otherwise_;
    ReplacedStatement replaced_;
};

}  // namespace

std::string statement_key(const WrittenStatement& statement, const Dialect& dialect) {
    std::string out;
    for (const std::string& word : words_of_statement(statement)) {
        const std::string common = common_word(word, dialect);
        if (!common.empty()) (out.empty() ? out : out += ' ') += common;
    }
    return out;
}

PairReading read_pair(const BySide<SideOfPair>& pair, const Dialect& dialect) {
    constexpr size_t kMostStatements = 300;   // of each side where nothing is known of the past
    constexpr size_t kMostTried = 4'000'000;  // each statement is held against each of the other side: 2 s
    const bool has_any_past = has_past(*pair.source.lineage) || has_past(*pair.target.lineage);
    for (const Side side : kBothSides)
        if (!has_any_past && pair[side].lineage->today().size() > kMostStatements) return {};
    if (pair.source.lineage->today().size() * pair.target.lineage->today().size() > kMostTried) return {};
    return PairReader(pair, dialect).run(has_any_past);
}

PairReading read_slips(const BySide<SideOfPair>& pair, const Dialect& dialect) {
    constexpr size_t kMostStatements = 600;
    for (const Side side : kBothSides)
        if (pair[side].lineage->today().size() > kMostStatements) return {};
    return PairReader(pair, dialect).run_for_slips();
}

}  // namespace porttool
