// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/unported.h"

#include "porttool/judge/baseline_index.h"
#include "porttool/scan/scan.h"

namespace porttool {

size_t find_unported(const Case& facts, const Resolver& source, FindingList& findings, Verdicts& verdicts) {
    std::vector<const UnitState*> units;
    for (const auto& [id, unit] : facts.source)
        if (!source.taken(unit) && unit.kind != UnitKind::File) units.push_back(&unit);
    const BaselineIndex baseline(facts.lock.baseline, units);
    for (const UnitState* unit : units) {
        Finding& finding = findings.add(Rule::Unported, *unit);
        finding.change = ChangeKind::Added;
        finding.message = std::string(unit_kind_name(unit->kind)) + " " + unit->name + " has no port";
        verdicts.settle_unported(*unit, baseline.find(*unit));
    }
    return units.size();
}

}  // namespace porttool
