// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/compare_pair.h"

#include "porttool/compare/lone_edit.h"
#include "porttool/compare/values.h"

namespace porttool {
namespace {

/// Whether a number's suffix tells its type on both sides.
Literals literals_of(const BySide<PairedUnit>& pair) {
    const auto is_shading = [](Language language) { return traits_of(language).literals == Literals::Shading; };
    return is_shading(pair.source.language) || is_shading(pair.target.language) ? Literals::Shading : Literals::C;
}

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
        if (out_.standing != Standing::Idle && !settled_by_values() && changed_both() && !out_.text_missing)
            compare_both();
        return std::move(out_);
    }

private:
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

    void read_texts() {
        for (const Side side : kBothSides) {
            now_[side] = pair_[side].now.words();
            if (!edited(side)) continue;
            before_[side] = pair_[side].before.words();
            if (before_[side].empty()) {
                out_.text_missing = true;
                continue;
            }
            LoneEdit lone = lone_edit(before_[side], now_[side], pair_[side].kind, pair_[side].language, dialect_);
            out_.idle[side] = lone.means_nothing;
            out_.edits[side] = std::move(lone.edit);
        }
    }

    /// Equal values settle edits of both sides. They leave open what an edit of one side alone is: it may be to the
    /// alignment, the bases or the type.
    bool settled_by_values() {
        const UnitKind kind = pair_.source.kind;
        if (kind != pair_.target.kind || (kind != UnitKind::Constant && kind != UnitKind::Struct)) return false;
        ComparedValues values = compare_values(kind, now_.source, now_.target, dialect_);
        if (values.same) {
            if (changed_both()) out_.standing = Standing::Equivalent;
            return changed_both();
        }
        out_.standing = Standing::ValuesDiffer;
        out_.values = std::move(values.says);
        return true;
    }

    void compare_both() {
        EditComparison edits =
            compare_edits({before_.source, now_.source, before_.target, now_.target}, dialect_, literals_of(pair_));
        if (edits.equivalent) out_.standing = Standing::Equivalent;
        out_.missing = std::move(edits.differences);
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
