// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/effort/port_effort.h"

#include <algorithm>

#include "porttool/effort/totals.h"

namespace porttool {

PortEffort port_effort(const std::vector<MapPair>& pairs, const std::vector<MapPair>& suggested,
                       const ChangedSides& sides, const Dialect& dialect) {
    LineReader reader(dialect);
    ChangedSide source(sides.source_before, sides.source_now, reader),
        target(sides.target_before, sides.target_now, reader);
    PortEffort out;
    Totals totals;
    const auto add = [&](const MapPair& pair, bool is_suggested) {
        const EditedUnit left = source.edit_of_pair(pair.source);
        for (const std::string& id : pair.targets) {
            const EditedUnit right = target.edit_of_pair(id);
            if (left.lines.edit.changed() + right.lines.edit.changed() == 0) continue;
            const ComparedEdits compared = compare_ported(left, right, reader, dialect);
            totals.add_pair(pair.source, id, compared);
            out.pairs.push_back({pair.source, id, compared.edit, is_suggested});
        }
    };
    for (const MapPair& pair : pairs) add(pair, false);
    for (const MapPair& pair : suggested) add(pair, true);
    std::sort(out.pairs.begin(), out.pairs.end(), [](const PairEffort& a, const PairEffort& b) {
        return a.source != b.source ? a.source < b.source : a.target < b.target;
    });
    out.totals = totals.sum();
    out.source_outside = source.outside(out.totals.source_tokens);
    out.target_outside = target.outside(out.totals.target_tokens);
    for (const FileEffort& file : out.source_outside) out.totals.source += file.edit;
    for (const FileEffort& file : out.target_outside) out.totals.target += file.edit;
    out.totals.carried.lines = static_cast<double>(out.totals.target.added);
    return out;
}

}  // namespace porttool
