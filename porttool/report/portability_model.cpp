// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/portability_model.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include "metrics/code/token_edit.h"
#include "porttool/measure/port_cost.h"
#include "porttool/measure/symbols.h"
#include "porttool/read/glob.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

using Files = std::vector<ScannedFile>;

constexpr size_t kSource = 0, kTarget = 1;
constexpr double kPercent = 100;

Passage whole_files(const Files& files) {
    Passage passage;
    for (const ScannedFile& file : files) passage.push_back({&file, nullptr});
    return passage;
}

/// The lines of one side of a measurement, excerpts of one file together.
std::vector<FileLines> lines_by_file(const Passage& passage, const std::vector<std::vector<CodeLine>>& lines) {
    struct Found {
        std::set<uint32_t> code, shared;
    };
    std::map<std::string, Found> files;
    for (size_t i = 0; i < passage.size(); ++i) {
        Found& found = files[passage[i].file->path];
        for (const CodeLine& line : lines[i]) {
            found.code.insert(line.line);
            if (line.shared) found.shared.insert(line.line);
        }
    }
    const auto spans = [](const std::set<uint32_t>& set) { return spans_of({set.begin(), set.end()}); };
    std::vector<FileLines> out;
    for (const auto& [file, found] : files) out.push_back({file, spans(found.code), spans(found.shared)});
    return out;
}

/// None where a side is too short to be measured.
std::optional<metrics::Figure> degree_of(const SideMeasure& source, const SideMeasure& target,
                                         const metrics::LineWeights& weights) {
    if (source.lines == 0 || !target.moss_percent) return std::nullopt;
    return degree_of_portability(target, weights);
}

BlockReport measure_block(const std::string& name, const Passage& source, const Passage& target, const Dialect& dialect,
                          const metrics::LineWeights& weights) {
    const Similarity found = measure_shares(source, target, dialect);
    BlockReport block;
    block.name = name;
    block.measures = {found.a, found.b};
    block.lines = {lines_by_file(source, found.a_lines), lines_by_file(target, found.b_lines)};
    block.portability = degree_of(found.a, found.b, weights);
    return block;
}

/// What a person said about units without counterpart.
class Excuses {
public:
    explicit Excuses(const PortabilityCase& facts) {
        for (const MapIgnore& ignore : facts.map.ignores) globs_.push_back({Glob(ignore.id), ignore.reason});
        for (const LockedUnit& unit : facts.lock.baseline)
            if (unit.side == "source")
                reasons_.emplace(unit.id,
                                 unit.reason.empty() ? "had no port when the baseline was taken" : unit.reason);
        for (const Finding& finding : facts.judgement.findings)
            if (finding.rule == Rule::Unported && finding.verdict && finding.source)
                reasons_.emplace(finding.source->id, finding.verdict_reason);
    }

    /// Why the unit needs no counterpart; none if it does.
    std::optional<std::string> find(const std::string& id, bool is_source) const {
        for (const auto& [glob, reason] : globs_)
            if (glob.text() == id || glob.matches(id)) return reason;
        const auto found = reasons_.find(id);
        if (is_source && found != reasons_.end()) return found->second;
        return std::nullopt;
    }

private:
    std::vector<std::pair<Glob, std::string>> globs_;
    std::map<std::string, std::string> reasons_;
};

/// How a pair stands, as the judge counts it: settled findings weigh nothing if all are settled.
std::string state_of(const std::vector<const Finding*>& findings) {
    Level worst = Level::Off;
    bool open = findings.empty(), deferred = false;
    for (const Finding* finding : findings) {
        worst = std::max(worst, finding->level);
        open = open || !finding->verdict;
        deferred = deferred || finding->verdict == Verdict::Defer;
    }
    if (!open) return deferred ? "deferred" : "ignored";
    return worst == Level::Error ? "drifted" : worst == Level::Warning ? "review" : "in_step";
}

class Builder {
public:
    explicit Builder(const PortabilityCase& facts) : facts_(facts), dialect_(facts.map.dialect), excuses_(facts) {}

    PortabilityReport run() {
        cut(kSource, facts_.source);
        cut(kTarget, facts_.target);
        out_.blocks_are_file_pairs = facts_.blocks.are_file_pairs;
        for (const BlockText& block : facts_.blocks.blocks)
            out_.blocks.push_back(measure_block(block.name, block.source, block.target, dialect_, facts_.map.weights));
        out_.totals =
            measure_block("", whole_files(facts_.source), whole_files(facts_.target), dialect_, facts_.map.weights);
        add_pairs();
        add_singles(kSource);
        add_singles(kTarget);
        give_lines_to_rows();
        count();
        return std::move(out_);
    }

private:
    /// A piece with the row that its lines count in.
    struct Cut {
        Piece piece;
        std::string id;
        int row = -1;
    };

    void cut(size_t side, const Files& files) {
        for (const ScannedFile& file : files) {
            for (Piece& piece : pieces_of(file)) {
                const bool whole = piece.unit == nullptr && file.units.empty();
                std::string id =
                    piece.unit != nullptr ? unit_id(file, *piece.unit) : file.path + (whole ? ":@file" : ":@outside");
                by_id_[side].emplace(id, cuts_[side].size());
                cuts_[side].push_back({std::move(piece), std::move(id)});
            }
            files_[side].emplace(file.path, &file);
        }
    }

    RowSide side_of(const ScannedFile& file, const Unit* unit, std::string id) const {
        RowSide side;
        side.id = std::move(id);
        side.file = file.path;
        side.place = {&file, unit};
        side.name = unit != nullptr ? unit->name : file.units.empty() ? "whole file" : "code outside units";
        side.kind = unit != nullptr ? unit_kind_name(unit->kind) : unit_kind_name(UnitKind::File);
        side.span = unit != nullptr ? LineSpan{unit->start_line, unit->end_line}
                                    : LineSpan{1, std::max(1u, file.lexed.line_count)};
        return side;
    }

    /// The side of a pair that a judged unit stands on; none if it is gone.
    std::optional<RowSide> side_of(size_t side, const UnitState* state) {
        if (state == nullptr) return std::nullopt;
        const ScannedFile& file = *files_[side].at(state->file);
        if (state->kind == UnitKind::File) {
            RowSide out = side_of(file, nullptr, state->id);
            out.name = "whole file";
            return out;
        }
        return side_of(file, cuts_[side][by_id_[side].at(state->id)].piece.unit, state->id);
    }

    static std::vector<CodeLine> only(const std::vector<std::vector<CodeLine>>& lines) {
        return lines.empty() ? std::vector<CodeLine>() : lines.front();
    }

    void add_pairs() {
        std::map<std::pair<std::string, std::string>, std::vector<const Finding*>> findings;
        for (const Finding& finding : facts_.judgement.findings)
            findings[{finding.map_source, finding.map_target}].push_back(&finding);
        for (const JudgedPair& pair : facts_.judgement.pairs) {
            RowReport row;
            row.key = pair.map_source + "=" + pair.map_target;
            row.sides = {side_of(kSource, pair.source), side_of(kTarget, pair.target)};
            row.state = state_of(findings[{pair.map_source, pair.map_target}]);
            if (!row.sides[kSource] && !row.sides[kTarget]) continue;  // only the ledger knows it
            if (row.sides[kSource] && row.sides[kTarget]) measure_pair(row);
            out_.rows.push_back(std::move(row));
        }
    }

    /// Of texts too short for winnowing: how little of the one must be edited to become the other.
    double short_likeness(const Passage& a, const Passage& b) const {
        SymbolTable table(dialect_);
        const auto left = table.place(a), right = table.place(b);
        const std::vector<uint32_t> x = table.sequence(left, Vocabulary::Dialect, 0).symbols,
                                    y = table.sequence(right, Vocabulary::Dialect, 1).symbols;
        return x.empty() && y.empty() ? 1 : metrics::edit_similarity(x, y);
    }

    void measure_pair(RowReport& row) const {
        RowSide &left = *row.sides[kSource], &right = *row.sides[kTarget];
        const Passage a = {{left.place.file, left.place.unit}}, b = {{right.place.file, right.place.unit}};
        const Similarity found = measure_shares(a, b, dialect_);
        row.measures = {found.a, found.b};
        if (found.a.moss_percent && found.b.moss_percent)
            row.likeness = std::min(*found.a.moss_percent, *found.b.moss_percent);
        else
            row.likeness = short_likeness(a, b) * kPercent;
        row.share = row.likeness.value_or(0) >= kTwinBound ? Share::Twin : Share::Rewritten;
        const auto shared = [](const std::vector<CodeLine>& lines) {
            std::vector<uint32_t> out;
            for (const CodeLine& line : lines)
                if (line.shared) out.push_back(line.line);
            return spans_of(out);
        };
        left.shared = shared(only(found.a_lines));
        right.shared = shared(only(found.b_lines));
    }

    /// Gives each line to one row: a unit in several pairs to the one that it is most alike in, and to a pair of whole
    /// files what no other pair took.
    void claim(size_t side) {
        for (size_t r = 0; r < out_.rows.size(); ++r) {
            const auto& row_side = out_.rows[r].sides[side];
            if (!row_side || row_side->place.unit == nullptr) continue;
            Cut& one = cuts_[side][by_id_[side].at(row_side->id)];
            if (one.row < 0 || out_.rows[one.row].share > out_.rows[r].share) one.row = static_cast<int>(r);
        }
        for (size_t r = 0; r < out_.rows.size(); ++r) {
            const auto& row_side = out_.rows[r].sides[side];
            if (!row_side || row_side->place.unit != nullptr) continue;
            for (Cut& one : cuts_[side])
                if (one.row < 0 && one.piece.file == row_side->place.file &&
                    !excuses_.find(one.id, side == kSource).has_value())
                    one.row = static_cast<int>(r);
        }
    }

    void add_singles(size_t side) {
        claim(side);
        for (Cut& one : cuts_[side]) {
            if (one.row >= 0) continue;
            RowReport row;
            const auto excuse = excuses_.find(one.id, side == kSource);
            row.share = excuse ? Share::OneSided : Share::Unmatched;
            row.reason = excuse.value_or("");
            row.key = one.id;
            row.sides[side] = side_of(*one.piece.file, one.piece.unit, one.id);
            one.row = static_cast<int>(out_.rows.size());
            out_.rows.push_back(std::move(row));
        }
    }

    static bool holds(const Passage& passage, const UnitPlace& place) {
        return std::any_of(passage.begin(), passage.end(), [&](const Excerpt& excerpt) {
            return excerpt.file == place.file && (excerpt.unit == nullptr || excerpt.unit == place.unit);
        });
    }

    std::vector<int> blocks_of(size_t side, const UnitPlace& place) const {
        std::vector<int> blocks;
        for (size_t i = 0; i < facts_.blocks.blocks.size(); ++i) {
            const BlockText& block = facts_.blocks.blocks[i];
            if (holds(side == kSource ? block.source : block.target, place)) blocks.push_back(static_cast<int>(i));
        }
        return blocks;
    }

    int smallest(const std::vector<int>& blocks) const {
        const auto size = [&](int block) {
            return out_.blocks[block].measures[kSource].lines + out_.blocks[block].measures[kTarget].lines;
        };
        const auto found =
            std::min_element(blocks.begin(), blocks.end(), [&](int a, int b) { return size(a) < size(b); });
        return found == blocks.end() ? -1 : *found;
    }

    void name_blocks() {
        for (RowReport& row : out_.rows) {
            for (const size_t side : {kSource, kTarget}) {
                if (!row.sides[side]) continue;
                row.sides[side]->blocks = blocks_of(side, row.sides[side]->place);
                row.sides[side]->block = smallest(row.sides[side]->blocks);
            }
        }
    }

    /// Counts the lines of a piece where it belongs.
    void count_piece(size_t side, const Cut& one) {
        RowReport& row = out_.rows[one.row];
        const size_t count = one.piece.lines.size();
        const std::vector<int> blocks = blocks_of(side, {one.piece.file, one.piece.unit});
        row.sides[side]->lines += count;
        out_.totals.parts[side].add(row.share, count);
        for (const int block : blocks) out_.blocks[block].parts[side].add(row.share, count);
        const int alone = smallest(blocks);
        auto& [lines, shared] = alone < 0 ? out_.in_no_block[side] : out_.blocks[alone].alone[side];
        const std::set<uint32_t>& of_file =
            shared_lines(side, alone < 0 ? out_.totals : out_.blocks[alone], one.piece.file->path);
        lines += count;
        shared += static_cast<size_t>(std::count_if(one.piece.lines.begin(), one.piece.lines.end(),
                                                    [&](uint32_t line) { return of_file.contains(line); }));
    }

    const std::set<uint32_t>& shared_lines(size_t side, const BlockReport& block, const std::string& file) {
        const auto [found, is_new] = shared_[side].emplace(std::pair(&block, file), std::set<uint32_t>());
        if (!is_new) return found->second;
        for (const FileLines& lines : block.lines[side])
            if (lines.file == file)
                for (const LineSpan& span : lines.shared)
                    for (uint32_t line = span.first; line <= span.last; ++line) found->second.insert(line);
        return found->second;
    }

    void give_lines_to_rows() {
        name_blocks();
        for (const size_t side : {kSource, kTarget}) {
            std::vector<std::vector<uint32_t>> lines(out_.rows.size());
            for (const Cut& one : cuts_[side]) {
                count_piece(side, one);
                lines[one.row].insert(lines[one.row].end(), one.piece.lines.begin(), one.piece.lines.end());
            }
            for (size_t r = 0; r < lines.size(); ++r) {
                std::sort(lines[r].begin(), lines[r].end());
                if (out_.rows[r].sides[side]) out_.rows[r].sides[side]->code = spans_of(lines[r]);
            }
        }
    }

    /// What must hold: every line of code is accounted for, once.
    void count() const {
        for (const size_t side : {kSource, kTarget}) {
            const size_t parts = out_.totals.parts[side].total(), lines = out_.totals.measures[side].lines;
            if (parts != lines)
                throw std::logic_error("the lines of the " + std::string(side == kSource ? "source" : "target") +
                                       " do not add up: " + std::to_string(parts) + " accounted for, " +
                                       std::to_string(lines) + " there");
        }
    }

    const PortabilityCase& facts_;
    Dialect dialect_;
    Excuses excuses_;
    std::array<std::vector<Cut>, 2> cuts_;
    std::array<std::map<std::string, size_t>, 2> by_id_;
    std::array<std::map<std::string, const ScannedFile*>, 2> files_;
    std::array<std::map<std::pair<const BlockReport*, std::string>, std::set<uint32_t>>, 2> shared_;
    PortabilityReport out_;
};

}  // namespace

bool is_too_short(const BlockReport& block) {
    return block.measures[kSource].lines > 0 && block.measures[kTarget].lines > 0 &&
           !block.measures[kTarget].moss_percent;
}

PortabilityReport portability_report(const PortabilityCase& facts) { return Builder(facts).run(); }

}  // namespace porttool
