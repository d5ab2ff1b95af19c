// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/compare_pair.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "porttool/compare/call_forms.h"
#include "porttool/compare/caught_up.h"
#include "porttool/compare/flow_places.h"
#include "porttool/compare/half_port.h"
#include "porttool/compare/item_ends.h"
#include "porttool/compare/learned_words.h"
#include "porttool/compare/lone_edit.h"
#include "porttool/compare/number_kinds.h"
#include "porttool/compare/own_fields.h"
#include "porttool/compare/own_parts.h"
#include "porttool/compare/statement_patterns.h"
#include "porttool/compare/struct_fields.h"
#include "porttool/compare/switch_cases.h"
#include "porttool/compare/values.h"
#include "porttool/compare/whole_vectors.h"
#include "porttool/normal/prelude.h"

namespace porttool {
namespace {

class PairComparer {
public:
    PairComparer(const BySide<PairedUnit>& pair, const Dialect& dialect) : pair_(pair), dialect_(dialect) {
        for (const Side side : kBothSides)
            out_.changes[side] = classify(pair[side].prints_before, pair[side].prints_now);
    }

    PairComparison run(CompareBudget& budget) {
        if (!changed(Side::Source) && !changed(Side::Target)) return std::move(out_);
        out_.standing = standing();
        out_.size = size();
        out_.not_compared = budget.refusal({pair_.source.id, pair_.target.id}, out_.size);
        if (!out_.not_compared.empty()) return std::move(out_);
        read_texts();
        out_.standing = standing();
        if (out_.standing == Standing::Idle || settled_by_values() || out_.text_missing) return std::move(out_);
        if (changed_both())
            compare_both();
        else if (has_caught_up())
            out_.standing = Standing::CaughtUp;
        return std::move(out_);
    }

private:
    using Text = std::vector<std::string>;

    bool edited(Side side) const { return is_edit(out_.changes[side]); }
    bool changed(Side side) const { return edited(side) && !out_.idle[side]; }
    bool changed_both() const { return changed(Side::Source) && changed(Side::Target); }

    Standing standing() const {
        if (changed_both()) return Standing::EditsDiffer;
        if (!changed(Side::Source) && !changed(Side::Target)) return Standing::Idle;
        return changed(Side::Source) ? Standing::SourceChanged : Standing::TargetChanged;
    }

    CompareSize size() const {
        CompareSize out;
        for (const Side side : kBothSides) {
            out.add(pair_[side].now.size());
            if (edited(side)) out.add(pair_[side].before.size());
        }
        return out;
    }

    /// The text alone does not tell which macros its file has; its prints were taken with them.
    static bool names_count(const PairedUnit& unit) {
        return prints_of_text(unit.now).renamed != unit.prints_now.renamed;
    }

    void read_texts() {
        for (const Side side : kBothSides) {
            now_[side] = pair_[side].now.words();
            if (!edited(side)) continue;
            before_[side] = pair_[side].before.words();
            if (before_[side].empty()) {
                out_.text_missing = true;
                continue;
            }
            LoneEdit lone = lone_edit(before_[side], now_[side], pair_[side].kind, pair_[side].language, dialect_,
                                      names_count(pair_[side]));
            out_.idle[side] = lone.means_nothing;
            out_.respelled[side] = lone.respells;
            out_.edits[side] = std::move(lone.edit);
        }
    }

    /// Equal values settle edits of both sides. They leave open what an edit of one side alone is: it may be to the
    /// alignment, the bases or the type. Constants that were not the same before are two of their own, to all
    /// appearance: that they differ is no news, and edits of both are held against each other. Structs that had other
    /// fields before, as a class and what a kernel needs of it, are held against each other by their edits.
    bool settled_by_values() {
        const UnitKind kind = pair_.source.kind;
        if (kind != pair_.target.kind || (kind != UnitKind::Constant && kind != UnitKind::Struct)) return false;
        const bool were_same = had_same_values();
        if (kind == UnitKind::Struct && !were_same) return false;
        ComparedValues values = compare_values(kind, now_.source, now_.target, dialect_);
        if (values.same || (changed_both() && same_but_for_own_parts(now_))) {
            if (changed_both()) out_.standing = Standing::Equivalent;
            return changed_both();
        }
        out_.differed_before = !were_same;
        if (changed_both() && !were_same) {
            compare_both();
            if (out_.standing == Standing::Equivalent) return true;
            out_.missing.clear();
        }
        out_.standing = list_has_caught_up() ? Standing::CaughtUp : Standing::ValuesDiffer;
        out_.values = std::move(values.says);
        return true;
    }

    /// True if both have one value, each in names with a part of its own: `SIZE_CUDA` and `SIZE_HIP`.
    bool same_but_for_own_parts(const BySide<Words>& texts) const {
        const OwnParts parts = own_parts({{std::string(pair_.source.id)}, {std::string(pair_.target.id)}});
        const Words source = with_parts_there(texts.source, texts.target, parts);
        return compare_values(pair_.source.kind, source, texts.target, dialect_).same;
    }

    /// True if the lists differed before, and an edit of one side alone made them differ less.
    bool list_has_caught_up() const {
        if (pair_.source.kind != UnitKind::Constant || changed_both()) return false;
        const Side side = changed(Side::Source) ? Side::Source : Side::Target;
        return list_draws_nearer(before_[side], now_[side], now_[other(side)]);
    }

    /// True if both had the same value or fields when they were last in step.
    bool had_same_values() const {
        const auto then = [&](Side side) { return before_[side].empty() ? now_[side] : before_[side]; };
        const BySide<Words> texts{then(Side::Source), then(Side::Target)};
        return compare_values(pair_.source.kind, texts.source, texts.target, dialect_).same ||
               same_but_for_own_parts(texts);
    }

    void compare_both() {
        const bool structs = pair_.source.kind == UnitKind::Struct && pair_.target.kind == UnitKind::Struct;
        const auto text = [&](const Words& words) {
            return structs ? data_fields(without_prelude(words)) : without_prelude(words);
        };
        const Words source_before = text(before_.source), source_now = text(now_.source),
                    target_before = text(before_.target), target_now = text(now_.target);
        const PairTexts texts{source_before, source_now, target_before, target_now};
        const BySide<Language> languages{pair_.source.language, pair_.target.language};
        EditComparison edits = compare_edits(texts, dialect_, languages);
        const EditsByParts by_parts(texts);
        if (!edits.equivalent && structs) edits.equivalent = gain_the_same_fields(texts);
        std::optional<LearnedWords> learned;  // what edits that differ as they are written are looked at with
        if (!edits.equivalent) {
            learned.emplace(learned_words(texts));
            edits.equivalent =
                alike_in_words_of_pair(texts, *learned, languages) || alike_without_order_of_cases(texts, languages) ||
                alike_in_ends_of_items(texts, languages) || alike_in_one_part(by_parts, languages) ||
                alike_in_statements_of_pair(texts, languages) || (!structs && alike_in_whole_vectors(texts, languages));
        }
        if (std::string said = surely_differs(texts, structs ? nullptr : &by_parts); !said.empty()) {
            edits.differences.insert(edits.differences.begin(), std::move(said));
            edits.equivalent = false;
            edits.displaced = true;
        }
        if (!edits.equivalent && !edits.displaced && !structs) {
            if (std::string said = other_local_in_flow(texts, learned->before); !said.empty()) {
                edits.differences.insert(edits.differences.begin(), std::move(said));
                edits.displaced = true;
            }
        }
        if (!edits.displaced && !structs)
            if (std::string said = other_kinds_of_numbers(texts, dialect_, languages); !said.empty()) {
                edits.differences.insert(edits.differences.begin(), std::move(said));
                edits.equivalent = false;
                edits.displaced = true;
            }
        if (edits.equivalent && declared_alike()) out_.standing = Standing::Equivalent;
        out_.missing = std::move(edits.differences);
        out_.left = edits.left;
        out_.displaced = edits.displaced && !edits.equivalent;
        if (edits.equivalent && out_.standing != Standing::Equivalent)
            out_.missing = {
                "the two sides declare what they use, or how they are called, otherwise than before, and "
                "not alike"};
    }

    /// What makes edits in the same words another program. The fields of structs are alike by nature: of these nothing
    /// is asked of parts.
    static std::string surely_differs(const PairTexts& texts, const EditsByParts* by_parts) {
        std::string out = other_ends_of_items(texts);
        if (out.empty() && by_parts != nullptr) out = other_place_in_flow(texts);
        return out.empty() && by_parts != nullptr ? by_parts->half_of_a_port() : out;
    }

    /// True if the edits are one where the side that loops over items goes on with the next one as the other returns.
    bool alike_in_ends_of_items(const PairTexts& texts, const BySide<Language>& languages) const {
        const size_t here = loops_of(texts.source_before), there = loops_of(texts.target_before);
        if (here == there) return false;
        const bool in_source = here > there;
        const Words &before = in_source ? texts.source_before : texts.target_before,
                    &now = in_source ? texts.source_now : texts.target_now;
        const Text said_before = with_returns_for_items(before), said_now = with_returns_for_items(now);
        const Words old_text(said_before.begin(), said_before.end()), new_text(said_now.begin(), said_now.end());
        if (old_text == before && new_text == now) return false;
        return in_source ? are_alike({old_text, new_text, texts.target_before, texts.target_now}, languages)
                         : are_alike({texts.source_before, texts.source_now, old_text, new_text}, languages);
    }

    /// True if the edits are one as they are written, or in the words of the pair.
    bool are_alike(const PairTexts& texts, const BySide<Language>& languages) const {
        return compare_edits(texts, dialect_, languages).equivalent ||
               alike_in_words_of_pair(texts, learned_words(texts), languages);
    }

    /// True if one side says part by part, each part alike, what the other says of all parts at once.
    bool alike_in_one_part(const EditsByParts& by_parts, const BySide<Language>& languages) const {
        const auto words = [](const Text& text) { return Words(text.begin(), text.end()); };
        const std::vector<EditOfOnePart> ways = by_parts.of_one_part();
        return std::any_of(ways.begin(), ways.end(), [&](const EditOfOnePart& one) {
            const Words source_before = words(one.source_before), source_now = words(one.source_now),
                        target_before = words(one.target_before), target_now = words(one.target_now);
            return are_alike({source_before, source_now, target_before, target_now}, languages);
        });
    }

    /// True if the edits are one where what is said of each part of a value is said of the whole.
    bool alike_in_whole_vectors(const PairTexts& texts, const BySide<Language>& languages) const {
        const WholeVectors here({&texts.source_before, &texts.source_now}, {&texts.target_before, &texts.target_now}),
            there({&texts.target_before, &texts.target_now}, {&texts.source_before, &texts.source_now});
        const Text written[] = {here.written(texts.source_before), here.written(texts.source_now),
                                there.written(texts.target_before), there.written(texts.target_now)};
        const auto words = [&](size_t i) { return Words(written[i].begin(), written[i].end()); };
        const Words source_before = words(0), source_now = words(1), target_before = words(2), target_now = words(3);
        if (source_before == texts.source_before && source_now == texts.source_now &&
            target_before == texts.target_before && target_now == texts.target_now)
            return false;
        return are_alike({source_before, source_now, target_before, target_now}, languages);
    }

    bool alike_without_order_of_cases(const PairTexts& texts, const BySide<Language>& languages) const {
        const Words source_before = with_sorted_cases(texts.source_before),
                    source_now = with_sorted_cases(texts.source_now),
                    target_before = with_sorted_cases(texts.target_before),
                    target_now = with_sorted_cases(texts.target_now);
        if (source_now == texts.source_now && target_now == texts.target_now) return false;
        return compare_edits({source_before, source_now, target_before, target_now}, dialect_, languages).equivalent;
    }

    LearnedWords learned_words(const PairTexts& texts) const {
        return in_words_of_target(texts, dialect_, {pair_.source.id, pair_.target.id});
    }

    /// True if the edits are one in the words that the pair itself teaches, and in functions for the other's methods.
    bool alike_in_words_of_pair(const PairTexts& texts, const LearnedWords& said,
                                const BySide<Language>& languages) const {
        const PairTexts learned{said.before, said.now, texts.target_before, texts.target_now};
        if (said.any && compare_edits(learned, dialect_, languages).equivalent) return true;
        CalledForms of_source, of_target;
        for (const Words* text : {&learned.source_before, &learned.source_now}) of_source.add(*text);
        for (const Words* text : {&learned.target_before, &learned.target_now}) of_target.add(*text);
        bool any = false;
        const auto plain = [&](const Words& text, const CalledForms& there) {
            Reworded out = with_functions_for_methods(text, there);
            any = any || out.any;
            return std::move(out.words);
        };
        const Text texts_now[] = {plain(learned.source_before, of_target), plain(learned.source_now, of_target),
                                  plain(learned.target_before, of_source), plain(learned.target_now, of_source)};
        if (!any) return false;
        const auto words = [&](size_t i) { return Words(texts_now[i].begin(), texts_now[i].end()); };
        const Words before = words(0), now = words(1), there = words(2), there_now = words(3);
        return compare_edits({before, now, there, there_now}, dialect_, languages).equivalent;
    }

    /// True if the edits are one where statements are said as the pair says all others that differ from them in a name.
    bool alike_in_statements_of_pair(const PairTexts& texts, const BySide<Language>& languages) const {
        const PatternedTexts said = in_statements_of_target(texts, dialect_);
        if (!said.any) return false;
        const Words before(said.before.begin(), said.before.end()), now(said.now.begin(), said.now.end());
        return are_alike({before, now, texts.target_before, texts.target_now}, languages);
    }

    /// An edit of one side alone that says what the other side says. Beside the text, how the file declares what the
    /// unit uses may have changed, which the other side's text does not tell.
    bool has_caught_up() {
        const Side side = changed(Side::Source) ? Side::Source : Side::Target;
        const UnitKind kind = pair_[side].kind;
        const bool structs = kind == UnitKind::Struct && pair_[other(side)].kind == kind;
        if (kind != UnitKind::Function && kind != UnitKind::Kernel && !structs) return false;
        const PlainStatements plain(kind, pair_[side].language, dialect_);
        if (!declaration_changes(before_[side], now_[side], plain).empty()) return false;
        const LoneTexts texts{without_prelude(before_[side]), without_prelude(now_[side]),
                              without_prelude(now_[other(side)])};
        return (structs ? now_has_fields_of_other : now_says_what_other_says)(
            texts, side, dialect_, {pair_.source.language, pair_.target.language});
    }

    /// The files of both changed how they declare what the units use in one way.
    bool declared_alike() const {
        BySide<std::vector<std::string>> changes;
        for (const Side side : kBothSides)
            changes[side] = declaration_changes(before_[side], now_[side],
                                                PlainStatements(pair_[side].kind, pair_[side].language, dialect_));
        return changes.source == changes.target;
    }

    const BySide<PairedUnit>& pair_;
    const Dialect& dialect_;
    BySide<Words> before_, now_;
    PairComparison out_;
};

}  // namespace

PairComparison compare_pair(const BySide<PairedUnit>& pair, const Dialect& dialect, CompareBudget& budget) {
    return PairComparer(pair, dialect).run(budget);
}

}  // namespace porttool
