// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/two_sided_weight.h"

#include <algorithm>

#include "porttool/compare/alike_spots.h"
#include "porttool/compare/asides.h"
#include "porttool/compare/computed_values.h"
#include "porttool/compare/declared_otherwise.h"
#include "porttool/compare/grouping.h"
#include "porttool/compare/guarded_words.h"
#include "porttool/compare/laid_edit.h"
#include "porttool/compare/learned_words.h"
#include "porttool/compare/member_elements.h"
#include "porttool/compare/other_rounding.h"
#include "porttool/compare/owed_edit.h"
#include "porttool/compare/own_switches.h"
#include "porttool/compare/own_words.h"
#include "porttool/compare/plain_choices.h"
#include "porttool/compare/retyping.h"
#include "porttool/compare/runtime_calls.h"
#include "porttool/compare/same_names.h"
#include "porttool/compare/settled_edits.h"
#include "porttool/compare/statement_edit.h"
#include "porttool/compare/switch_cases.h"
#include "porttool/judge/pair_judge.h"
#include "porttool/judge/weaken.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/prelude.h"

namespace porttool {
namespace {

constexpr size_t kMostChosen = 24;  ///< differences, of which choices in another manner are all there is

/// True if the edits brought one side more statements than the other, and both texts are sure to compute the same now.
/// Statements that stand for each other one by one are held to their words.
bool compute_alike_now(const PairTexts& texts, const Dialect& dialect, const BySide<Language>& languages) {
    const auto gained = [](const Words& before, const Words& now) {
        const auto as_written = [](const Words& words, bool) {
            return std::vector<std::string>(words.begin(), words.end());
        };
        return statement_edit(before, now, as_written).gained.size();
    };
    if (gained(texts.source_before, texts.source_now) == gained(texts.target_before, texts.target_now)) return false;
    const Words none;
    const BySide<Words> now{texts.source_now, texts.target_now};
    return guarded_difference({none, now.source, none, now.target}).empty() && compute_alike(now, dialect, languages);
}

/// True if edits of both sides are one but for what is computed in one step or in several.
bool differ_in_rounding(const PairTexts& texts, const Dialect& dialect, const BySide<Language>& languages) {
    std::vector<std::string> said[4];
    Words words[4];
    const Words* texts_of_pair[] = {&texts.source_before, &texts.source_now, &texts.target_before, &texts.target_now};
    bool any = false;
    for (size_t i = 0; i < 4; ++i) {
        said[i] = with_other_rounding(*texts_of_pair[i], dialect);
        words[i].assign(said[i].begin(), said[i].end());
        any = any || words[i] != *texts_of_pair[i];
    }
    return any && compare_edits({words[0], words[1], words[2], words[3]}, dialect, languages).equivalent;
}

/// True if edits of both sides are one but for how they choose between values, and what is computed in one step or in
/// several.
bool choose_alike(const PairTexts& texts, const Dialect& dialect, const BySide<Language>& languages) {
    std::vector<std::string> said[4];
    Words words[4];
    const MemberElements elements(texts);
    const BySide<std::vector<std::string>> then{elements.written(texts.source_before),
                                                elements.written(texts.target_before)},
        now{elements.written(texts.source_now), elements.written(texts.target_now)};
    const Words in_members[] = {{then.source.begin(), then.source.end()},
                                {now.source.begin(), now.source.end()},
                                {then.target.begin(), then.target.end()},
                                {now.target.begin(), now.target.end()}};
    const Words* texts_of_pair[] = {&texts.source_before, &texts.source_now, &texts.target_before, &texts.target_now};
    bool any = false;
    for (size_t i = 0; i < 4; ++i) {
        const std::vector<std::string> plain =
            with_plain_choices(in_members[i], i < 2 ? languages.source : languages.target);
        const Words plain_words(plain.begin(), plain.end());
        any = any || plain_words != *texts_of_pair[i];
        said[i] = with_other_rounding(plain_words, dialect);
        words[i].assign(said[i].begin(), said[i].end());
    }
    return any && compare_edits({words[0], words[1], words[2], words[3]}, dialect, languages).equivalent;
}

/// True if both edits did nothing but give things another type, and the same one.
bool retype_alike(const PairTexts& texts) {
    const auto source = only_retypes(texts.source_before, texts.source_now);
    return source && source == only_retypes(texts.target_before, texts.target_now);
}

/// True if edits of both sides are for the most part one where branches for the compiler that only one side has are
/// taken for on.
bool are_one_without_switches(const SwitchlessTexts& said, const Dialect& dialect, const BySide<Language>& languages) {
    const auto words = [](const std::vector<std::string>& text) { return Words(text.begin(), text.end()); };
    const Words source_before = words(said.source_before), source_now = words(said.source_now),
                target_before = words(said.target_before), target_now = words(said.target_now);
    const PairTexts texts{source_before, source_now, target_before, target_now};
    return compare_edits(texts, dialect, languages).equivalent || edits_spot_by_spot(texts, dialect) ||
           (edits_in_own_words(texts, dialect) && grouping_of_edits(texts, dialect) == Grouping::Alike &&
            !edits_contradict(texts, dialect));
}

}  // namespace

/// True if the branches for the compiler that only one side has may be under a wrong switch: one that nothing else of
/// that side asks for, or another than what they use stands under.
bool TwoSidedWeight::has_doubtful_switch(const PairTexts& texts, const JudgedPair& pair) const {
    for (const Side side : kBothSides) {
        if (own_switches_disagree(texts, side)) return true;
        for (const std::string_view macro : lone_own_switches(texts, side)) {
            const auto& units = facts_.units(side);
            const bool is_known = std::any_of(units.begin(), units.end(), [&](const auto& one) {
                if (&one.second == pair.unit[side]) return false;
                const Words words = one.second.text.words();
                return std::find(words.begin(), words.end(), macro) != words.end();
            });
            if (!is_known) return true;
        }
    }
    return false;
}

/// What nothing settled: a port that did the source's edit and more has changed alone in that. Edits of which more than
/// half is not the other's cannot be held against each other, nor those of texts that say little alike, but for units
/// of one name; and where both say several statements that the other does not, they are not one wrong word or line.
///
///                 source                                   port
///     error       k = a * 2;  ->  k = a * 3;               k = a * 2;  ->  k = a * 4;
///     warning     load(a); f(a);  ->  prefetch(a); g(a);   read(b); go(b);  ->  Task t = plan(b); t.run(); log(t);
void TwoSidedWeight::weigh_what_is_left(const JudgedPair& pair, const PairComparison& found, const PairTexts& texts,
                                        Finding& finding) {
    constexpr size_t kMore = 3;     // statements that are no slip of the port's
    constexpr size_t kLeast = 5;    // statements of both sides that no wrong word or line leaves
    constexpr size_t kSeveral = 2;  // statements of each side that the other lacks
    const auto is_most = [&](Side side) {
        return 2 * found.left[side] >= found.edits[side].lost.size() + found.edits[side].gained.size();
    };
    const LoneTexts of_source{texts.source_before, texts.source_now, texts.target_before};
    LaidEdit laid(of_source, dialect_);
    const auto is_no_slip = [&] {
        return words_edited(texts.source_before, texts.source_now) >= kNoSlip &&
               words_edited(texts.target_before, texts.target_now) >= kNoSlip;
    };
    const size_t left = found.left.source + found.left.target;
    if (found.left.source == 0 && found.left.target >= kMore)
        weaken(pair, finding, Level::Warning, "the port did what the source did, and more");
    else if (left >= kLeast && is_most(Side::Source) && is_most(Side::Target) && is_no_slip())
        doubt(pair, finding, "hardly anything of one edit has its like in the other");
    else if (left >= kLeast && std::min(found.left.source, found.left.target) >= kSeveral && is_no_slip())
        weaken(pair, finding, Level::Warning, "both did more of their own than a slip leaves");
    else if (!own_names_.are_one(pair.unit) && !are_mostly_alike(laid))
        doubt(pair, finding, "the two texts say too little alike to tell whether the edits are one");
}

/// Edits of both sides of a function that seem to be one are a note. Beside the text, how the files declare what it
/// uses may have changed.
void TwoSidedWeight::weigh(const JudgedPair& pair, const PairComparison& found, const BySide<NormalText>& before,
                           Finding& finding) {
    BySide<Words> then, now;
    bool is_declared_alike = true;
    for (const Side side : kBothSides) {
        const UnitState& unit = *pair.unit[side];
        if (unit.kind != UnitKind::Function && unit.kind != UnitKind::Kernel) return;
        const Words old_text = before[side].words(), new_text = unit.text.words();
        if (prelude_of(old_text) != prelude_of(new_text)) is_declared_alike = false;
        then[side] = without_prelude(old_text);
        now[side] = without_prelude(new_text);
    }
    const PairTexts texts{then.source, now.source, then.target, now.target};
    if (is_declared_alike && without_asides(then.source) == without_asides(now.source) &&
        without_asides(then.target) == without_asides(now.target))
        return weaken(pair, finding, Level::Note, "both only change what is printed, checked or timed");
    const auto language = [&](Side side) { return language_of_path(pair.unit[side]->file); };
    const BySide<Language> languages{language(Side::Source), language(Side::Target)};
    const LearnedWords said = in_words_of_target(texts, dialect_, {pair.id.source, pair.id.target});
    const PairTexts learned{said.before, said.now, texts.target_before, texts.target_now};
    const auto weigh = [&](Level level, const std::string& why) {
        if (is_declared_otherwise(texts))
            weaken(pair, finding, Level::Warning, why + ", beside a type or a pragma that one side changed");
        else
            weaken(pair, finding, level, why);
    };
    if (!swept_names_.say(Side::Source, then.source, now.source).empty() &&
        !swept_names_.say(Side::Target, then.target, now.target).empty())
        weigh(Level::Note, "both only give things new names, as all of both sides does");
    else if (is_declared_alike && swept_names_.are_same_on_both(texts))
        weigh(Level::Note, "both only give the same things the same new names");
    else if (only_adds_labels_of_other(then.source, now.source, now.target) &&
             only_adds_labels_of_other(then.target, now.target, now.source))
        weigh(Level::Note, "the same labels joined an arm on both sides");
    else if (is_declared_alike && (edits_spot_by_spot(texts, dialect_) || edits_spot_by_spot(learned, dialect_)))
        weigh(Level::Note, "word for word the same came and went, at the same places");
    else if (is_declared_alike && compute_alike_now(texts, dialect_, languages))
        weigh(Level::Note, "both compute the same now");
    else if (is_declared_alike &&
             (differ_in_rounding(texts, dialect_, languages) || differ_in_rounding(learned, dialect_, languages)))
        weigh(Level::Note, "one side computes in several steps what the other computes in one");
    else if (is_declared_alike && finding.details.size() <= kMostChosen &&
             (choose_alike(texts, dialect_, languages) || choose_alike(learned, dialect_, languages)))
        weigh(Level::Note, "one side chooses or computes in another way what the other does");
    else if (is_declared_alike && retype_alike(texts))
        weigh(Level::Note, "both only give the same things another type, the same one");
    else if (const auto bare = without_own_switches(texts);
             bare && are_one_without_switches(*bare, dialect_, languages))
        weigh(has_doubtful_switch(texts, pair) ? Level::Warning : Level::Note,
              "each side says what the other does, one of them within branches for the compiler");
    else if (edits_in_own_words(texts, dialect_))
        weigh(grouping_of_edits(texts, dialect_) == Grouping::Alike && !edits_contradict(learned, dialect_) &&
                      !bring_other_members(texts, dialect_) && !one_takes_a_name(texts, dialect_)
                  ? Level::Note
                  : Level::Warning,
              "each side says for the most part what the other does");
    else if (is_declared_alike && (edits_leave_no_difference(texts, dialect_, languages) ||
                                   edits_leave_no_difference(learned, dialect_, languages)))
        weigh(Level::Note, "what came is the same, and what each had in its own words is gone");
    else if (bring_the_same_names(texts))
        weigh(Level::Note, "both bring the same names, each in the way of its runtime");
    else if (drives_device(then.source) && drives_device(then.target) &&
             words_edited(then.source, now.source) >= kNoSlip && words_edited(then.target, now.target) >= kNoSlip)
        weigh(Level::Warning, "both allocate, copy or launch, each in its own way");
    else
        weigh_what_is_left(pair, found, texts, finding);
}

}  // namespace porttool
