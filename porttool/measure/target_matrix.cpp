// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/measure/target_matrix.h"

#include <algorithm>
#include <map>
#include <set>

#include "porttool/compare/paired_names.h"
#include "porttool/judge/assess.h"
#include "porttool/read/id_patterns.h"
#include "porttool/read/lock_lines.h"
#include "porttool/read/target_sets.h"

namespace porttool {
namespace {

using PairIds = std::pair<std::string, std::string>;

/// The edits that a finding lists: a statement that was replaced is one.
size_t edits_of(const Finding& finding) {
    size_t lost = 0, gained = 0, other = 0;
    for (const std::string& detail : finding.details)
        ++(detail.starts_with("- ") ? lost : detail.starts_with("+ ") ? gained : other);
    return std::max<size_t>(1, std::max(lost, gained) + other);
}

class MatrixBuilder {
public:
    explicit MatrixBuilder(const CheckedProject& checked)
        : checked_(checked),
          sets_(checked.project.map),
          lines_(checked.lock),
          dialect_(dialect_of_edits(checked.project.map)) {
        for (const Finding& finding : checked.judgement.findings)
            if (finding.level >= Level::Warning && !finding.verdict)
                edits_[{finding.map_source, finding.map_target}] += edits_of(finding);
    }

    TargetMatrix run() {
        TargetMatrix out;
        out.targets = sets_.names();
        std::vector<std::string> ignored;
        for (const MapIgnore& ignore : checked_.project.map.ignores) ignored.push_back(ignore.id);
        const IdPatterns patterns(ignored);
        for (const auto& [id, unit] : checked_.states.source)
            if (unit.kind != UnitKind::File && !patterns.match(id))
                rows_.emplace(id, std::vector<MatrixCell>(out.targets.size()));
        for (const LoneUnit& one : checked_.judgement.lone) leave_out(one);
        for (const JudgedPair& pair : checked_.judgement.pairs) place(pair);
        for (auto& [id, cells] : rows_) out.rows.push_back({id, std::move(cells)});
        return out;
    }

private:
    void leave_out(const LoneUnit& one) {
        const bool said = one.excuse && (!one.line || !checked_.lock.baseline[*one.line].reason.empty());
        const auto row = rows_.find(one.unit->id);
        if (!said || one.side != Side::Source || row == rows_.end()) return;
        for (MatrixCell& cell : row->second) cell.state = InPort::LeftOut;
    }

    void place(const JudgedPair& pair) {
        const std::string& id = pair.unit.source == nullptr ? pair.id.source : pair.unit.source->id;
        const auto name = std::find(sets_.names().begin(), sets_.names().end(), sets_.of_id(pair.id.target));
        if (name == sets_.names().end() || pair.unit.target == nullptr) return;
        auto& cells = rows_.try_emplace(id, std::vector<MatrixCell>(sets_.names().size())).first->second;
        MatrixCell& cell = cells[static_cast<size_t>(name - sets_.names().begin())];
        MatrixCell now{state_of_pair(pair), pair.unit.target->id, 0};
        if (now.state == InPort::Behind) now.edits = edits_[{pair.id.source, pair.id.target}];
        const bool fresh = cell.target.empty();
        if (fresh || now.state > cell.state || (now.state == cell.state && now.edits > cell.edits)) cell = now;
    }

    InPort state_of_pair(const JudgedPair& pair) {
        if (pair.standing == PairStanding::Drifted || pair.standing == PairStanding::Review ||
            pair.standing == PairStanding::Deferred || pair.unit.source == nullptr)
            return InPort::Behind;
        const Assessment assessment = assess(*pair.unit.source, *pair.unit.target, dialect_, budget_);
        if (assessment == Assessment::Twin) return InPort::Twin;
        const LockedPair* line = lines_.find(pair.id.source, pair.id.target);
        const bool verified = line != nullptr && line->state == kVerified;
        return assessment == Assessment::Equivalent || verified ? InPort::Equivalent : InPort::Recorded;
    }

    const CheckedProject& checked_;
    TargetSets sets_;
    LinesByPair lines_;
    Dialect dialect_;
    CompareBudget budget_;
    std::map<PairIds, size_t> edits_;
    std::map<std::string, std::vector<MatrixCell>> rows_;
};

}  // namespace

TargetMatrix target_matrix(const CheckedProject& checked) {
    if (checked.project.map.target_sets.empty()) return {};
    return MatrixBuilder(checked).run();
}

}  // namespace porttool
