// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/settle.h"

#include <algorithm>
#include <set>

#include "porttool/judge/first_record.h"
#include "porttool/text/suggest.h"

namespace porttool {
namespace {

Print written_print(const UnitState* unit) { return unit != nullptr ? unit->prints.written : Print(); }

bool is_named(const JudgedPair& pair, const std::string& id) {
    for (const Side side : kBothSides)
        if (pair.id[side] == id || (pair.unit[side] != nullptr && pair.unit[side]->id == id)) return true;
    return pair.id.source + "=" + pair.id.target == id;
}

/// Forgets what was said of a pair, or of a unit without one (the other side empty).
void forget(LockFile& lock, const std::string& source, const std::string& target) {
    std::erase_if(lock.ledger, [&](const LedgerEntry& e) { return e.source == source && e.target == target; });
}

/// A unit that has become part of a pair is watched, in the port that the pair is with.
void take_out_of_baseline(LockFile& lock, const std::vector<const JudgedPair*>& pairs, const TargetSets& sets) {
    BySide<std::map<std::string, std::set<std::string>>> paired;
    for (const JudgedPair* pair : pairs) {
        paired.source[pair->id.source].insert(sets.of_id(pair->id.target));
        paired.target[pair->id.target];
    }
    std::erase_if(lock.baseline, [&](LockedUnit& line) {
        const Side side = line.side == side_word(Side::Source) ? Side::Source : Side::Target;
        const auto found = paired[side].find(line.id);
        if (found == paired[side].end()) return false;
        bool is_left = side == Side::Source;
        for (const std::string& set : found->second) is_left = is_left && take_out(line, set, sets.names());
        return !is_left;
    });
}

/// Writes a line of the baseline in the place of any other on that unit.
void put_line(LockFile& lock, LockedUnit line) {
    std::erase_if(lock.baseline, [&](const LockedUnit& u) { return u.side == line.side && u.id == line.id; });
    lock.baseline.push_back(std::move(line));
}

}  // namespace

bool is_of(const Finding& finding, const JudgedPair& pair) {
    return finding.map_source == pair.id.source && finding.map_target == pair.id.target;
}

Named named_by(const Judgement& judgement, const std::string& id) {
    Named out;
    std::vector<const Finding*> of_pairs;
    for (const Finding& finding : judgement.findings) {
        const bool is_fingerprint = finding.fingerprint == id;
        if (is_fingerprint) of_pairs.push_back(&finding);
        if (finding.map_target.empty() && (is_fingerprint || finding.map_source == id)) out.lone.push_back(&finding);
    }
    for (const JudgedPair& pair : judgement.pairs)
        if (is_named(pair, id) || std::any_of(of_pairs.begin(), of_pairs.end(),
                                              [&](const Finding* finding) { return is_of(*finding, pair); }))
            out.pairs.push_back(&pair);
    return out;
}

const LoneUnit* find_lone(const Judgement& judgement, const std::string& id) {
    const auto found = std::find_if(judgement.lone.begin(), judgement.lone.end(),
                                    [&](const LoneUnit& one) { return one.unit->id == id; });
    return found == judgement.lone.end() ? nullptr : &*found;
}

std::string nearest_named(const Judgement& judgement, const std::string& id) {
    std::vector<std::string> names;
    for (const JudgedPair& pair : judgement.pairs) names.insert(names.end(), {pair.id.source, pair.id.target});
    for (const Finding& finding : judgement.findings) {
        names.push_back(finding.fingerprint);
        if (is_of_new_unit(finding)) names.push_back(finding.map_source);
    }
    names.insert(names.end(), kRuleNames.begin(), kRuleNames.end());
    std::string near = nearest(id, names);
    if (near.empty())
        for (const std::string& name : names)
            if (name.ends_with(":" + id) || name.ends_with("::" + id)) near = name;
    return near;
}

ChangedPairs changed_pairs(const Judgement& judgement) {
    ChangedPairs out;
    for (const JudgedPair& pair : judgement.pairs)
        if (pair.changed)
            (!pair.equivalent          ? out.different
             : pair.macro_edit.empty() ? out.alike
                                       : out.under_macros)
                .push_back(&pair);
    return out;
}

void accept_pairs(LockFile& lock, const std::vector<const JudgedPair*>& pairs, const TargetSets& sets, Looked looked,
                  const std::string& reason, const std::string& today) {
    std::map<std::pair<std::string, std::string>, LockedPair> recorded;
    std::set<std::string> sources, targets;
    for (const JudgedPair* pair : pairs) {
        recorded.try_emplace({pair->id.source, pair->id.target});
        sources.insert(pair->id.source);
        targets.insert(pair->id.target);
    }
    std::erase_if(lock.pairs, [&](LockedPair& p) {
        const auto pair = recorded.find({p.source, p.target});
        if (pair != recorded.end()) pair->second = std::move(p);
        return pair != recorded.end();
    });
    std::erase_if(lock.ledger, [&](const LedgerEntry& e) {
        if (e.target.empty()) return sources.contains(e.source);
        return e.source.empty() ? targets.contains(e.target) : recorded.contains({e.source, e.target});
    });
    take_out_of_baseline(lock, pairs, sets);
    for (const JudgedPair* pair : pairs) {
        const auto& [source, target] = pair->unit;
        LockedPair line = std::move(recorded.at({pair->id.source, pair->id.target}));
        line.source = pair->id.source;
        line.target = pair->id.target;
        if (looked == Looked::AtEach) {
            line.state = kVerified;
            line.by = kAcceptedBy + today;
        } else if (!pair->equivalent) {
            line.state = LockedPair().state;
            line.by.clear();
        }
        if (source != nullptr && target != nullptr) {
            line.macros = {};
            line.source_prints = source->prints;
            line.target_prints = target->prints;
            lock.pairs.push_back(std::move(line));
        }
        if (!reason.empty())
            lock.ledger.push_back({Verdict::Accept, pair->id.source, pair->id.target, written_print(source),
                                   written_print(target), "", today, reason});
    }
}

size_t verify_pairs(LockFile& lock, const Judgement& judgement,
                    const std::set<std::pair<std::string, std::string>>& pairs, const std::string& by) {
    std::map<std::pair<std::string, std::string>, const JudgedPair*> in_step;
    for (const JudgedPair& pair : judgement.pairs)
        if (pair.standing == PairStanding::InStep && pairs.contains({pair.id.source, pair.id.target}))
            in_step.emplace(std::pair(pair.id.source, pair.id.target), &pair);
    size_t count = 0;
    for (LockedPair& line : lock.pairs) {
        const auto found = in_step.find({line.source, line.target});
        if (found == in_step.end() || line.state == kVerified) continue;
        const auto& [source, target] = found->second->unit;
        if (source == nullptr || target == nullptr || source->prints != line.source_prints ||
            target->prints != line.target_prints)
            continue;
        line.state = kVerified;
        line.by = by;
        ++count;
    }
    return count;
}

void follow_baseline(LockFile& lock, const Judgement& judgement) {
    std::set<size_t> followed;
    std::set<std::pair<std::string, std::string>> taken;
    for (const LoneUnit& one : judgement.lone) {
        if (!one.line) continue;
        followed.insert(*one.line);
        lock.baseline[*one.line].id = one.unit->id;
        taken.insert({side_word(one.side), one.unit->id});
    }
    std::vector<LockedUnit> lines;  // a line of what is gone makes room for what took its id
    for (size_t i = 0; i < lock.baseline.size(); ++i)
        if (followed.contains(i) || !taken.contains({lock.baseline[i].side, lock.baseline[i].id}))
            lines.push_back(std::move(lock.baseline[i]));
    lock.baseline = std::move(lines);
}

bool is_of_new_unit(const Finding& finding) { return finding.rule == Rule::Unported || finding.rule == Rule::Unpaired; }

void accept_unwatched(LockFile& lock, const Judgement& judgement, const BySide<UnitsById>& units,
                      const std::string& reason) {
    for (LockedUnit& line : lock.baseline) {
        const auto& side = units[line.side == side_word(Side::Source) ? Side::Source : Side::Target];
        if (const auto unit = side.find(line.id); unit != side.end()) line.prints = unit->second.prints;
    }
    for (const Finding& finding : judgement.findings)
        if (is_of_new_unit(finding))
            put_line(lock, {finding.map_source, units[finding.side].at(finding.map_source).prints, reason,
                            side_word(finding.side)});
}

void reject_pair(LockFile& lock, const JudgedPair& pair, const MapFile& map) {
    std::erase_if(lock.pairs,
                  [&](const LockedPair& p) { return p.source == pair.id.source && p.target == pair.id.target; });
    forget(lock, pair.id.source, pair.id.target);
    const TargetSets sets(map);
    const std::string& set = sets.of_id(pair.id.target);
    const auto paired = paired_units(map, sets);
    for (const Side side : kBothSides) {
        const auto others = paired[side].find(pair.id[side]);
        const bool is_paired = others != paired[side].end() && (side == Side::Target || others->second.contains(set));
        if (!is_contract(map.reference, side) || pair.unit[side] == nullptr || is_paired) continue;
        const auto line = std::find_if(lock.baseline.begin(), lock.baseline.end(), [&](const LockedUnit& u) {
            return u.side == side_word(side) && u.id == pair.id[side];
        });
        std::vector<std::string> missing;
        for (const std::string& one : sets.names())
            if (one == set || side == Side::Target || (line != lock.baseline.end() && lacks(*line, one)))
                missing.push_back(one);
        put_line(lock, baseline_line(pair.id[side], pair.unit[side]->prints, side, missing, sets.names()));
    }
}

void settle_pair(LockFile& lock, const JudgedPair& pair, LedgerEntry said) {
    said.source = pair.id.source;
    said.target = pair.id.target;
    said.source_print = written_print(pair.unit.source);
    said.target_print = written_print(pair.unit.target);
    forget(lock, said.source, said.target);
    lock.ledger.push_back(std::move(said));
}

void settle_lone(LockFile& lock, const UnitState& unit, Side side, LedgerEntry said) {
    const bool of_source = side == Side::Source;
    said.source = of_source ? unit.id : "";
    said.target = of_source ? "" : unit.id;
    forget(lock, said.source, said.target);
    if (said.verdict == Verdict::Ignore) {
        put_line(lock, {unit.id, unit.prints, said.reason, side_word(side)});
        return;
    }
    said.source_print = of_source ? unit.prints.written : Print();
    said.target_print = of_source ? Print() : unit.prints.written;
    lock.ledger.push_back(std::move(said));
}

}  // namespace porttool
