// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "porttool/command/commands.h"
#include "porttool/command/named.h"
#include "porttool/compare/edits.h"
#include "porttool/judge/check_project.h"
#include "porttool/judge/rules.h"
#include "porttool/read/lock_lines.h"
#include "porttool/report/sync_report.h"
#include "porttool/text/shortened.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

void explain_finding(const Finding& finding, std::string& out) {
    out += fmt::format("{} [{}]: {}\n", level_name(finding.level), rule_name(finding.rule),
                       terminal_text(finding.message));
    if (finding.verdict)
        out += fmt::format("  settled by '{}': {}\n", verdict_name(*finding.verdict),
                           terminal_text(finding.verdict_reason));
    for (const std::string& detail : finding.details) out += "  " + terminal_line(detail) + "\n";
    out += "  " + terminal_line(finding.remedy) + "\n";
}

/// Who ports a deferred pair, and until when it may wait. What was deferred for other texts says nothing.
void explain_deferral(const CheckedProject& checked, const JudgedPair& pair, std::string& out) {
    const auto prints = [](const UnitState* unit) { return unit == nullptr ? nullptr : &unit->prints; };
    for (const LedgerEntry& entry : checked.lock.ledger)
        if (entry.verdict == Verdict::Defer && entry.source == pair.id.source && entry.target == pair.id.target &&
            entry.is_of(prints(pair.unit.source), prints(pair.unit.target)))
            out += fmt::format("deferred until {}, to be ported by {}\n", terminal_text(entry.until),
                               terminal_text(entry.owner));
}

void explain_pair(const CheckedProject& checked, const JudgedPair& pair, std::string& out) {
    out += fmt::format("source  {}\nport    {}\n", terminal_text(pair.id.source), terminal_text(pair.id.target));
    bool any = false;
    for (const Finding& finding : checked.judgement.findings) {
        if (!is_of(finding, pair)) continue;
        any = true;
        explain_finding(finding, out);
    }
    if (!any) out += "in step\n";
    explain_deferral(checked, pair, out);
    for (const LedgerEntry& entry : checked.lock.ledger)
        if (entry.verdict == Verdict::Accept && entry.source == pair.id.source && entry.target == pair.id.target)
            out += fmt::format("last accepted on {}: {}\n", terminal_text(entry.until), terminal_text(entry.reason));
}

/// Both edits, side by side: what each side lost and gained since the two were in step.
void explain_edits(const CheckedProject& checked, const JudgedPair& pair, std::string& out) {
    const LockedPair* lock = LinesByPair(checked.lock).find(pair.id.source, pair.id.target);
    if (lock == nullptr || pair.unit.source == nullptr || pair.unit.target == nullptr) return;
    auto rows = [&](const UnitState& unit, Print print) {
        std::vector<std::string> lines;
        const NormalText before = text_behind(checked, print);
        const Edit edit = edit_of(before.words(), unit.text.words());
        const auto add = [&](const char* sign, const std::vector<std::string>& statements) {
            for (const std::string& statement : statements)
                lines.push_back(sign + terminal_text(shortened(statement, kLongestStatement)));
        };
        add("- ", edit.lost);
        add("+ ", edit.gained);
        return lines;
    };
    const auto left = rows(*pair.unit.source, lock->source_prints.written),
               right = rows(*pair.unit.target, lock->target_prints.written);
    if (left.empty() && right.empty()) return;
    constexpr size_t kWidth = 58;
    out += fmt::format("{:<{}} | {}\n",
                       fmt::format("source {}:{}", terminal_text(pair.unit.source->file), pair.unit.source->start_line),
                       kWidth,
                       fmt::format("port {}:{}", terminal_text(pair.unit.target->file), pair.unit.target->start_line));
    for (size_t i = 0; i < std::max(left.size(), right.size()); ++i)
        out += fmt::format("{:<{}} | {}\n", i < left.size() ? left[i] : "", kWidth, i < right.size() ? right[i] : "");
}

/// What `sync` would propose for a pair that is out of step.
void explain_proposal(const CheckedProject& checked, const JudgedPair& pair, const Disk& disk, std::string& out) {
    if (!pair.changed || pair.equivalent) return;
    const auto place = static_cast<size_t>(&pair - checked.judgement.pairs.data());
    const SyncResult result = propose(checked, {place}, WriteSide::Other, disk);
    if (result.proposals.front().state != ProposalState::Already)
        out += "porttool sync:\n" + sync_table(result, std::nullopt);
}

}  // namespace

void declare_explain(Declare& declare, Options& options) {
    declare.texts("id", options.paths, "ID|RULE", "Id, SOURCE=TARGET, fingerprint or rule").required();
}

Outcome run_explain(const Options& options, Workplace& place) {
    require_format(options.format, {"text"});
    std::string out;
    for (const std::string& id : options.paths) {
        if (const auto rule = rule_named(id)) {
            out += id + "\n" + rule_help(*rule) + "\n";
            continue;
        }
        const CheckedProject checked = check_project(options, place);
        const Named named = require_named(checked.judgement, id);
        for (const Finding* finding : named.lone) {
            const Place at = finding->source.value_or(Place{"", "portmap.toml", finding->map_line, 0});
            out += fmt::format("{}:{}\n", terminal_line(at.file), at.line);
            explain_finding(*finding, out);
        }
        for (const JudgedPair* pair : named.pairs) {
            explain_pair(checked, *pair, out);
            explain_edits(checked, *pair, out);
            explain_proposal(checked, *pair, place.disk, out);
        }
    }
    return {out, 0};
}

}  // namespace porttool
