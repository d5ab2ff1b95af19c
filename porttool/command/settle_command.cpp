// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// accept, defer and ignore: what a person does with a finding.
#include <fmt/format.h>

#include <algorithm>

#include "porttool/command/commands.h"
#include "porttool/command/named.h"
#include "porttool/judge/lock_index.h"
#include "porttool/judge/settle.h"
#include "porttool/read/clock.h"
#include "porttool/snapshot/lock_store.h"
#include "porttool/text/date.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

/// The source unit of a finding outside pairs; findings of other rules than those on it cannot be settled.
const UnitState& unported_unit(const CheckedProject& checked, const Finding& finding) {
    const auto unit = checked.states.source.find(finding.map_source);
    const bool unported = finding.rule == Rule::Unported || finding.rule == Rule::DeferralExpired;
    if (!unported || unit == checked.states.source.end())
        throw CannotDo(fmt::format("{}: a finding of '{}' cannot be settled; {}", finding.fingerprint,
                                   rule_name(finding.rule), terminal_text(finding.remedy)));
    return unit->second;
}

/// Writes the lock without what holds for nothing any more.
void store(CheckedProject& checked, Disk& disk) {
    drop_idle_lines(checked.lock, checked.project.map, checked.states.source, checked.states.target,
                    checked.project.skipped);
    const bool clears = checked.lock.version == 1;  // its texts have other names
    store_lock(checked.project, {checked.lock, checked.states, checked.texts, nullptr, clears}, disk);
}

Outcome settle(const Options& options, Workplace& place, Verdict verdict) {
    require_format(options.format, {"text"});
    const auto guard = guard_lock(options, place);
    CheckedProject checked = check_project(options, place);
    LedgerEntry said;
    said.verdict = verdict;
    said.owner = options.owner;
    said.until = options.until;
    said.reason = options.reason;
    const char* done = verdict == Verdict::Defer ? "deferred" : "ignored";
    std::string out;
    for (const std::string& id : options.paths) {
        const Named named = require_named(checked.judgement, id);
        if (named.pairs.empty()) {
            const UnitState& unit = unported_unit(checked, *named.lone.front());
            settle_unported(checked.lock, unit, said);
            out += fmt::format("{} {}\n", done, terminal_text(unit.id));
        }
        for (const JudgedPair* pair : named.pairs) {
            settle_pair(checked.lock, *pair, said);
            out += fmt::format("{} {} = {}\n", done, terminal_text(pair->id.source), terminal_text(pair->id.target));
        }
    }
    store(checked, place.disk);
    return {out, 0};
}

/// The pairs that the ids name, each once.
std::vector<const JudgedPair*> pairs_to_accept(const CheckedProject& checked, const std::vector<std::string>& ids) {
    std::vector<const JudgedPair*> out;
    for (const std::string& id : ids) {
        const Named named = require_named(checked.judgement, id);
        if (named.pairs.empty())
            throw CannotDo(terminal_text(id) + ": there is no pair to accept; " +
                           terminal_text(named.lone.front()->remedy));
        out.insert(out.end(), named.pairs.begin(), named.pairs.end());
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

}  // namespace

void declare_accept(Declare& declare, Options& options) {
    declare.texts("id", options.paths, "ID", "Ids, SOURCE=TARGET, or fingerprints of findings");
    declare.flag("--all", options.all, "Every pair whose two edits are equivalent");
    declare.flag("--force", options.force, "With --all: every pair");
    declare.text("--reason", options.reason, "TEXT", "Why");
}

Outcome run_accept(const Options& options, Workplace& place) {
    require_format(options.format, {"text"});
    if (options.all == !options.paths.empty())
        throw CannotDo("accept needs ids, or --all for every pair whose two edits are equivalent");
    const auto guard = guard_lock(options, place);
    CheckedProject checked = check_project(options, place);
    std::vector<const JudgedPair*> accepted = pairs_to_accept(checked, options.paths), left;
    if (options.all) {
        ChangedPairs changed = changed_pairs(checked.judgement);
        accepted = std::move(changed.alike);
        left = std::move(changed.different);
        if (options.force) {
            accepted.insert(accepted.end(), left.begin(), left.end());
            left.clear();
            accept_unported(checked.lock, checked.judgement, checked.states.source, options.reason);
        }
    }
    accept_pairs(checked.lock, accepted, options.reason, today());
    store(checked, place.disk);
    std::string out = fmt::format("{} pairs recorded as in step\n", accepted.size());
    if (checked.lock.version == 1)
        out += "portmap.lock is rewritten as version 2: this once, all of its lines change\n";
    if (!left.empty())
        out += fmt::format(
            "{} changed pairs left: new to the lock, or their edits are not equivalent; name them, or "
            "add --force:\n",
            left.size());
    for (const JudgedPair* pair : left) out += "  " + terminal_line(pair->id.source) + "\n";
    return {out, left.empty() ? 0 : 1};
}

void declare_defer(Declare& declare, Options& options) {
    declare.texts("id", options.paths, "ID", "Id, SOURCE=TARGET, or fingerprint").required();
    declare.text("--owner", options.owner, "NAME", "Who will port it").required();
    declare.text("--until", options.until, "DATE", "YYYY-MM-DD").required();
    declare.text("--reason", options.reason, "TEXT", "Why not now").required();
}

Outcome run_defer(const Options& options, Workplace& place) {
    if (!is_date(options.until))
        throw CannotDo("--until " + terminal_text(options.until) + ": expected a date as YYYY-MM-DD");
    if (options.until < today())
        throw CannotDo("--until " + terminal_text(options.until) + " is past: today is " + today() +
                       "; give the last day to wait");
    return settle(options, place, Verdict::Defer);
}

void declare_ignore(Declare& declare, Options& options) {
    declare.texts("id", options.paths, "ID", "Id, SOURCE=TARGET, or fingerprint").required();
    declare.text("--reason", options.reason, "TEXT", "Why").required();
}

Outcome run_ignore(const Options& options, Workplace& place) { return settle(options, place, Verdict::Ignore); }

}  // namespace porttool
