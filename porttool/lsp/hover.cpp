// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/lsp/hover.h"

#include <fmt/format.h>

#include "porttool/judge/settle.h"
#include "porttool/measure/measure.h"
#include "porttool/read/lock_lines.h"
#include "porttool/text/sink/markdown.h"

namespace porttool::lsp {
namespace {

/// The texts of a pair where both are there.
std::optional<PlacedUnit> placed(const ProjectPlaces& places, Side side, const UnitState& state) {
    for (PlacedUnit& unit : places.at(places.path_of(side, state.file), state.start_line))
        if (unit.side == side && unit.id() == state.id) return std::move(unit);
    return std::nullopt;
}

std::string state_text(const CheckedProject& project, const JudgedPair& pair) {
    std::string out(pair_standing_name(pair.standing));
    std::replace(out.begin(), out.end(), '_', ' ');
    const LockedPair* line = LinesByPair(project.lock).find(pair.id.source, pair.id.target);
    if (line == nullptr) return out + ", never recorded";
    if (line->state != kVerified) return out + ", recorded, not verified";
    return out + ", verified" + (line->by.empty() ? "" : ": " + markdown_text(line->by));
}

std::string similarity_text(const CheckedProject& project, const PlacedUnit& source, const PlacedUnit& target) {
    const Similarity found =
        measure({{source.file, source.unit}}, {{target.file, target.unit}}, Dialect(project.project.map.dialect));
    constexpr double kPercent = 100;
    if (found.a.moss_percent && found.b.moss_percent)
        return fmt::format("{:.0f} % of the source's words stand in the port, {:.0f} % of the port's in the source",
                           *found.a.moss_percent, *found.b.moss_percent);
    if (found.tiling) return fmt::format("{:.0f} % (greedy string tiling)", *found.tiling * kPercent);
    if (found.token_edit) return fmt::format("{:.0f} % (token edits)", *found.token_edit * kPercent);
    return "too short to measure";
}

std::string findings_text(const CheckedProject& project, const JudgedPair& pair) {
    std::string out;
    for (const Finding& finding : project.judgement.findings) {
        if (!is_of(finding, pair) || finding.level == Level::Off) continue;
        out += fmt::format("- {} `{}`: {}", level_name(finding.level), rule_name(finding.rule),
                           markdown_sentence(finding.message));
        if (finding.verdict)
            out += fmt::format(" ({}: {})", verdict_name(*finding.verdict), markdown_text(finding.verdict_reason));
        out += "\n";
    }
    return out.empty() ? out : "\n" + out;
}

}  // namespace

Counterparts counterparts_at(const ProjectPlaces& places, const std::string& path, uint32_t line) {
    for (PlacedUnit& unit : places.at(path, line)) {
        std::vector<const JudgedPair*> pairs = places.pairs_of(unit);
        if (!pairs.empty()) return {std::move(unit), std::move(pairs)};
    }
    return {};
}

std::string hover_text(const CheckedProject& project, const ProjectPlaces& places, const Counterparts& found,
                       const UriOf& uri_of) {
    std::string out;
    for (const JudgedPair* pair : found.pairs) {
        const Side here = found.unit->side, there = other(here);
        if (!out.empty()) out += "\n---\n\n";
        const UnitState* counterpart = pair->unit[there];
        out += there == Side::Target ? "**Port** " : "**Source** ";
        if (counterpart == nullptr) {
            out += fmt::format("{} is gone\n\n", markdown_code(pair->id[there]));
        } else {
            const std::string path = places.path_of(there, counterpart->file);
            out += fmt::format("[{}:{}]({}#L{})\n\n", markdown_code(counterpart->file + ":" + counterpart->name),
                               counterpart->start_line, uri_of(path), counterpart->start_line);
        }
        out += "State: " + state_text(project, *pair) + "\n";
        if (counterpart != nullptr)
            if (const auto unit = placed(places, there, *counterpart))
                out += "\nSimilarity: " +
                       similarity_text(project, here == Side::Source ? *found.unit : *unit,
                                       here == Side::Source ? *unit : *found.unit) +
                       "\n";
        out += findings_text(project, *pair);
    }
    return out;
}

}  // namespace porttool::lsp
