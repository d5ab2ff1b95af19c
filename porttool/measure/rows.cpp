// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/measure/rows.h"

#include <algorithm>
#include <map>

#include "metrics/code/token_edit.h"
#include "porttool/measure/excuses.h"
#include "porttool/measure/symbols.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

RowSide side_of(const Excerpt& excerpt, std::string id, const char* name_without_unit) {
    RowSide side;
    side.id = std::move(id);
    side.file = excerpt.file->path;
    side.excerpt = excerpt;
    const Unit* unit = excerpt.unit;
    side.name = unit != nullptr ? unit->name : name_without_unit;
    side.kind = unit_kind_name(unit != nullptr ? unit->kind : UnitKind::File);
    side.span = unit != nullptr ? LineSpan{unit->start_line, unit->end_line}
                                : LineSpan{1, std::max(1u, excerpt.file->lexed.line_count)};
    return side;
}

/// Of texts too short for winnowing: how little of the one must be edited to become the other.
double short_likeness(const Passage& source, const Passage& target, const Dialect& dialect) {
    SymbolTable table(dialect);
    const auto left = table.place(source), right = table.place(target);
    const std::vector<uint32_t> x = table.sequence(left, Vocabulary::Dialect, 0).symbols,
                                y = table.sequence(right, Vocabulary::Dialect, 1).symbols;
    return x.empty() && y.empty() ? 1 : metrics::edit_similarity(x, y);
}

void measure_pair(RowReport& row, const Dialect& dialect) {
    constexpr double kPercent = 100;
    const BySide<Passage> passages = {{row.sides.source->excerpt}, {row.sides.target->excerpt}};
    const PassageMeasure found = measure_passages(passages.source, passages.target, dialect);
    for (const Side side : kBothSides) {
        row.measures[side] = found[side].measure;
        const std::vector<std::vector<CodeLine>> lines = measured_lines(passages[side], found[side]);
        std::vector<uint32_t> shared;
        for (const CodeLine& line : lines.front())
            if (line.shared) shared.push_back(line.line);
        row.sides[side]->shared = spans_of(shared);
    }
    const std::optional<double>&source = row.measures.source.moss_percent, &target = row.measures.target.moss_percent;
    row.likeness = source && target ? std::min(*source, *target)
                                    : kPercent * short_likeness(passages.source, passages.target, dialect);
    row.share = *row.likeness >= kTwinBound ? Share::Twin : Share::Rewritten;
}

class RowBuilder {
public:
    explicit RowBuilder(const PortabilityCase& facts)
        : facts_(facts), dialect_(facts.map.dialect), excuses_(facts.map, facts.judgement) {}

    Rows run() {
        take(Side::Source, facts_.source);
        take(Side::Target, facts_.target);
        add_pairs();
        add_singles(Side::Source);
        add_singles(Side::Target);
        return std::move(out_);
    }

private:
    void take(Side side, const std::vector<ScannedFile>& files) {
        for (const ScannedFile& file : files) {
            for (UnitCode& code : code_by_unit(file)) {
                const char* outside = file.units.empty() ? ":@file" : ":@outside";
                std::string id = code.excerpt.unit != nullptr ? unit_id(file, *code.excerpt.unit) : file.path + outside;
                by_id_[side].emplace(id, out_.code[side].size());
                out_.code[side].push_back({std::move(code), std::move(id)});
            }
            files_[side].emplace(file.path, &file);
        }
    }

    /// The side of a pair that a judged unit stands on; none if it is gone.
    std::optional<RowSide> judged_side(Side side, const UnitState* state) const {
        if (state == nullptr) return std::nullopt;
        if (state->kind == UnitKind::File)
            return side_of({files_[side].at(state->file), nullptr}, state->id, "whole file");
        return side_of(out_.code[side][by_id_[side].at(state->id)].code.excerpt, state->id, "");
    }

    void add_pairs() {
        for (const JudgedPair& pair : facts_.judgement.pairs) {
            RowReport row;
            row.key = pair.id.source + "=" + pair.id.target;
            row.sides = {judged_side(Side::Source, pair.unit.source), judged_side(Side::Target, pair.unit.target)};
            row.state = pair_standing_name(pair.standing);
            if (!row.sides.source && !row.sides.target) continue;  // only the ledger knows it
            if (row.sides.source && row.sides.target) measure_pair(row, dialect_);
            out_.rows.push_back(std::move(row));
        }
    }

    /// Gives code to the pairs of its side.
    void claim(Side side) {
        for (size_t r = 0; r < out_.rows.size(); ++r) {
            const auto& row_side = out_.rows[r].sides[side];
            if (!row_side || row_side->excerpt.unit == nullptr) continue;
            PlacedCode& one = out_.code[side][by_id_[side].at(row_side->id)];
            if (one.row < 0 || out_.rows[one.row].share > out_.rows[r].share) one.row = static_cast<int>(r);
        }
        for (size_t r = 0; r < out_.rows.size(); ++r) {
            const auto& row_side = out_.rows[r].sides[side];
            if (!row_side || row_side->excerpt.unit != nullptr) continue;
            for (PlacedCode& one : out_.code[side])
                if (one.row < 0 && one.code.excerpt.file == row_side->excerpt.file && !excuses_.find(one.id, side))
                    one.row = static_cast<int>(r);
        }
    }

    void add_singles(Side side) {
        claim(side);
        for (PlacedCode& one : out_.code[side]) {
            if (one.row >= 0) continue;
            RowReport row;
            const auto excuse = excuses_.find(one.id, side);
            row.share = excuse ? Share::OneSided : Share::Unmatched;
            row.reason = excuse.value_or("");
            row.key = one.id;
            const bool has_units = !one.code.excerpt.file->units.empty();
            row.sides[side] = side_of(one.code.excerpt, one.id, has_units ? "code outside units" : "whole file");
            one.row = static_cast<int>(out_.rows.size());
            out_.rows.push_back(std::move(row));
        }
    }

    const PortabilityCase& facts_;
    Dialect dialect_;
    Excuses excuses_;
    BySide<std::map<std::string, size_t>> by_id_;
    BySide<std::map<std::string, const ScannedFile*>> files_;
    Rows out_;
};

}  // namespace

Rows rows_of(const PortabilityCase& facts) { return RowBuilder(facts).run(); }

}  // namespace porttool
