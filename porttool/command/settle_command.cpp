// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// accept, defer, ignore and explain: what a person does with a finding.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "porttool/command/commands.h"
#include "porttool/judge/lock_index.h"
#include "porttool/judge/rules.h"
#include "porttool/read/clock.h"
#include "porttool/read/lock_lines.h"
#include "porttool/snapshot/lock_store.h"
#include "porttool/text/date.h"
#include "porttool/text/sink/terminal.h"
#include "porttool/text/suggest.h"

namespace porttool {
namespace {

bool is_of(const Finding& finding, const JudgedPair& pair) {
    return finding.map_source == pair.map_source && finding.map_target == pair.map_target;
}

/// The pairs that an id means: either side's id, SOURCE=TARGET, or a finding's fingerprint.
std::vector<const JudgedPair*> pairs_of(const CheckedProject& checked, const std::string& id) {
    std::vector<const JudgedPair*> out;
    for (const Finding& finding : checked.judgement.findings)
        if (finding.fingerprint == id)
            for (const JudgedPair& pair : checked.judgement.pairs)
                if (is_of(finding, pair)) out.push_back(&pair);
    for (const JudgedPair& pair : checked.judgement.pairs) {
        const bool today =
            (pair.source != nullptr && pair.source->id == id) || (pair.target != nullptr && pair.target->id == id);
        if (today || pair.map_source == id || pair.map_target == id || pair.map_source + "=" + pair.map_target == id)
            out.push_back(&pair);
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

[[noreturn]] void unknown_id(const CheckedProject& checked, const std::string& id) {
    std::vector<std::string> names;
    for (const JudgedPair& pair : checked.judgement.pairs) {
        names.push_back(pair.map_source);
        names.push_back(pair.map_target);
    }
    for (const Finding& finding : checked.judgement.findings) {
        names.push_back(finding.fingerprint);
        if (finding.rule == Rule::Unported) names.push_back(finding.map_source);
    }
    names.insert(names.end(), kRuleNames.begin(), kRuleNames.end());
    std::string near = nearest(id, names);
    if (near.empty())
        for (const std::string& name : names)
            if (name.ends_with(":" + id) || name.ends_with("::" + id)) near = name;
    throw CannotDo(terminal_text(id) + ": no such pair or finding" +
                   (near.empty() ? std::string("; porttool map lists the pairs")
                                 : "; did you mean '" + terminal_text(near) + "'?"));
}

/// The lock's lines for pairs are made to match today's units; a reason is kept beside each, with its day.
void record(LockFile& lock, const std::vector<const JudgedPair*>& pairs, const std::string& reason) {
    std::map<std::pair<std::string, std::string>, MoreFields> recorded;
    std::set<std::string> sources;
    for (const JudgedPair* pair : pairs) {
        recorded.try_emplace({pair->map_source, pair->map_target});
        sources.insert(pair->map_source);
    }
    std::erase_if(lock.pairs, [&](LockedPair& p) {
        const auto pair = recorded.find({p.source, p.target});
        if (pair != recorded.end()) pair->second = std::move(p.more);
        return pair != recorded.end();
    });
    std::erase_if(lock.ledger, [&](const LedgerEntry& e) {
        return e.target.empty() ? sources.contains(e.source) : recorded.contains({e.source, e.target});
    });
    std::erase_if(lock.baseline, [&](const LockedUnit& u) { return u.side == "source" && sources.contains(u.id); });
    for (const JudgedPair* pair : pairs) {
        const UnitState *source = pair->source, *target = pair->target;
        if (source != nullptr && target != nullptr)
            lock.pairs.push_back({pair->map_source, pair->map_target, source->prints, target->prints, "recorded", "",
                                  std::move(recorded.at({pair->map_source, pair->map_target}))});
        if (!reason.empty())
            lock.ledger.push_back({Verdict::Accept, pair->map_source, pair->map_target,
                                   source != nullptr ? source->prints.written : "-",
                                   target != nullptr ? target->prints.written : "-", "", today(), reason});
    }
}

/// The findings outside pairs that an id means: their fingerprint, or the id of their unit.
std::vector<const Finding*> lone_findings_of(const CheckedProject& checked, const std::string& id) {
    std::vector<const Finding*> out;
    for (const Finding& finding : checked.judgement.findings) {
        if (!finding.map_target.empty()) continue;
        if (finding.fingerprint == id || finding.map_source == id) out.push_back(&finding);
    }
    return out;
}

/// Forgets what was said of a pair, or of a source unit without one (`target` empty).
void forget(LockFile& lock, const std::string& source, const std::string& target) {
    std::erase_if(lock.ledger, [&](const LedgerEntry& e) { return e.source == source && e.target == target; });
}

/// Settles a unit without a port: to ignore it makes it part of the baseline, with the reason.
std::string settle_unported(const Options& options, CheckedProject& checked, const Finding& finding, Verdict verdict) {
    const std::string& id = finding.map_source;
    const auto unit = checked.states.source.find(id);
    const bool unported = finding.rule == Rule::Unported || finding.rule == Rule::DeferralExpired;
    if (!unported || unit == checked.states.source.end())
        throw CannotDo(finding.fingerprint + ": a finding of '" + std::string(rule_name(finding.rule)) +
                       "' cannot be settled; " + terminal_text(finding.remedy));
    forget(checked.lock, id, "");
    if (verdict == Verdict::Ignore)
        checked.lock.baseline.push_back({id, unit->second.prints, options.reason});
    else
        checked.lock.ledger.push_back(
            {verdict, id, "", unit->second.prints.written, "-", options.owner, options.until, options.reason});
    return fmt::format("{} {}\n", verdict == Verdict::Defer ? "deferred" : "ignored", terminal_text(id));
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
    std::string out;
    for (const std::string& id : options.paths) {
        const auto pairs = pairs_of(checked, id);
        const auto lone = lone_findings_of(checked, id);
        if (pairs.empty() && lone.empty()) unknown_id(checked, id);
        if (pairs.empty()) out += settle_unported(options, checked, *lone.front(), verdict);
        for (const JudgedPair* pair : pairs) {
            forget(checked.lock, pair->map_source, pair->map_target);
            checked.lock.ledger.push_back({verdict, pair->map_source, pair->map_target,
                                           pair->source != nullptr ? pair->source->prints.written : "-",
                                           pair->target != nullptr ? pair->target->prints.written : "-", options.owner,
                                           options.until, options.reason});
            out += fmt::format("{} {} = {}\n", verdict == Verdict::Defer ? "deferred" : "ignored",
                               terminal_text(pair->map_source), terminal_text(pair->map_target));
        }
    }
    store(checked, place.disk);
    return {out, 0};
}

void explain_finding(const Finding& finding, std::string& out) {
    out += fmt::format("{} [{}]: {}\n", level_name(finding.level), rule_name(finding.rule),
                       terminal_text(finding.message));
    if (finding.verdict)
        out += fmt::format("  settled by '{}': {}\n", verdict_name(*finding.verdict),
                           terminal_text(finding.verdict_reason));
    for (const std::string& detail : finding.details) out += "  " + terminal_line(detail) + "\n";
    out += "  " + terminal_line(finding.remedy) + "\n";
}

void explain_pair(const CheckedProject& checked, const JudgedPair& pair, std::string& out) {
    out += fmt::format("source  {}\nport    {}\n", terminal_text(pair.map_source), terminal_text(pair.map_target));
    bool any = false;
    for (const Finding& finding : checked.judgement.findings) {
        if (!is_of(finding, pair)) continue;
        any = true;
        explain_finding(finding, out);
    }
    if (!any) out += "in step\n";
    for (const LedgerEntry& entry : checked.lock.ledger)
        if (entry.verdict == Verdict::Accept && entry.source == pair.map_source && entry.target == pair.map_target)
            out += fmt::format("last accepted on {}: {}\n", terminal_text(entry.until), terminal_text(entry.reason));
}

/// Both edits, side by side: what each side lost and gained since the two were in step.
void explain_edits(const CheckedProject& checked, const JudgedPair& pair, std::string& out) {
    const LockedPair* lock = LinesByPair(checked.lock).find(pair.map_source, pair.map_target);
    if (lock == nullptr || pair.source == nullptr || pair.target == nullptr) return;
    auto rows = [&](const UnitState& unit, const std::string& print) {
        std::vector<std::string> lines;
        const Edit edit = edit_of(read_state_text(text_behind(checked, print)), read_state_text(unit.text));
        for (const std::string& statement : edit.lost) lines.push_back("- " + terminal_text(statement));
        for (const std::string& statement : edit.gained) lines.push_back("+ " + terminal_text(statement));
        return lines;
    };
    const auto left = rows(*pair.source, lock->source_prints.written),
               right = rows(*pair.target, lock->target_prints.written);
    if (left.empty() && right.empty()) return;
    constexpr size_t kWidth = 58;
    out += fmt::format("{:<{}} | {}\n",
                       fmt::format("source {}:{}", terminal_text(pair.source->file), pair.source->start_line), kWidth,
                       fmt::format("port {}:{}", terminal_text(pair.target->file), pair.target->start_line));
    for (size_t i = 0; i < std::max(left.size(), right.size()); ++i)
        out += fmt::format("{:<{}} | {}\n", i < left.size() ? left[i] : "", kWidth, i < right.size() ? right[i] : "");
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
    std::vector<const JudgedPair*> accepted;
    std::vector<std::string> left;
    if (options.all) {
        for (const JudgedPair& pair : checked.judgement.pairs) {
            if (!pair.changed) continue;
            if (!pair.equivalent && !options.force) {
                left.push_back(terminal_line(pair.map_source));
                continue;
            }
            accepted.push_back(&pair);
        }
        if (options.force)
            for (const Finding& finding : checked.judgement.findings)
                if (finding.rule == Rule::Unported)
                    checked.lock.baseline.push_back(
                        {finding.source->id, checked.states.source.at(finding.source->id).prints, options.reason});
    }
    for (const std::string& id : options.paths) {
        const auto pairs = pairs_of(checked, id);
        if (pairs.empty() && !lone_findings_of(checked, id).empty())
            throw CannotDo(terminal_text(id) + ": there is no pair to accept; " +
                           terminal_text(lone_findings_of(checked, id).front()->remedy));
        if (pairs.empty()) unknown_id(checked, id);
        accepted.insert(accepted.end(), pairs.begin(), pairs.end());
    }
    std::sort(accepted.begin(), accepted.end());  // two ids may name one pair
    accepted.erase(std::unique(accepted.begin(), accepted.end()), accepted.end());
    record(checked.lock, accepted, options.reason);
    store(checked, place.disk);
    std::string out = fmt::format("{} pairs recorded as in step\n", accepted.size());
    if (checked.lock.version == 1)
        out += "portmap.lock is rewritten as version 2: this once, all of its lines change\n";
    if (!left.empty())
        out += fmt::format(
            "{} changed pairs left: new to the lock, or their edits are not equivalent; name them, or add --force:\n  "
            "{}\n",
            left.size(), fmt::join(left, "\n  "));
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
        const auto pairs = pairs_of(checked, id);
        const auto lone = lone_findings_of(checked, id);
        if (pairs.empty() && lone.empty()) unknown_id(checked, id);
        for (const Finding* finding : lone) {
            const Place at = finding->source.value_or(Place{"", "portmap.toml", finding->map_line, 0});
            out += fmt::format("{}:{}\n", terminal_line(at.file), at.line);
            explain_finding(*finding, out);
        }
        for (const JudgedPair* pair : pairs) {
            explain_pair(checked, *pair, out);
            explain_edits(checked, *pair, out);
        }
    }
    return {out, 0};
}

}  // namespace porttool
