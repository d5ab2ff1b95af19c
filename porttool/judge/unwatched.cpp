// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/unwatched.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>

#include "porttool/compare/compare_pair.h"
#include "porttool/judge/baseline_index.h"
#include "porttool/judge/counterparts.h"
#include "porttool/judge/new_users.h"
#include "porttool/judge/rules.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

constexpr float kCertain = 0.9f;  ///< of a candidate, from which on it is an error to leave it

/// What is counted of a unit that some port lacks.
struct Unwatched {
    bool unpaired = false;  ///< nobody said why
    bool changed = false;   ///< new, or edited since it was recorded
};

/// A line of the baseline may know the written print alone.
bool is_edited(const LockedUnit& line, const UnitState& unit) {
    if (line.prints.written == unit.prints.written) return false;
    return !line.prints.blanked.is_known() || is_edit(classify(line.prints, unit.prints));
}

/// A side that is the contract, held against one port.
class UnwatchedSide {
public:
    UnwatchedSide(const Case& facts, const TargetSets& sets, Side side, std::string set, SharedFiles& shared_files,
                  FindingList& findings, Verdicts& verdicts)
        : facts_(facts),
          sets_(sets),
          side_(side),
          set_(std::move(set)),
          findings_(findings),
          verdicts_(verdicts),
          shared_files_(shared_files) {}

    /// Adds to `lone`, and to `changed` those that are new or edited.
    void run(Judgement& out, std::unordered_map<const UnitState*, Unwatched>& units) {
        find_units(out.pairs);
        const BaselineIndex baseline(facts_.lock.baseline, side_, set_, units_, facts_.units(side_));
        std::vector<const UnitState*> fresh;
        for (const UnitState* unit : units_)
            if (baseline.find(*unit) == nullptr && !verdicts_.is_ignored(*unit)) fresh.push_back(unit);
        const Counterparts counterparts = find_counterparts(facts_, out.pairs, side_, sets_, set_, fresh);
        find_told(fresh, counterparts);
        if (out.lone.empty()) out.lone.reserve(units_.size());
        const auto of_baseline = std::make_shared<const std::string>("had no port when the baseline was taken");
        for (const UnitState* unit : units_) {
            const LockedUnit* line = baseline.find(*unit);
            const std::optional<std::string> said = judge_unit(*unit, line, counterparts);
            Unwatched& counted = units[unit];
            if (!said && !verdicts_.is_ignored(*unit)) {
                counted.unpaired = true;
                counted.changed = counted.changed || line == nullptr || is_edited(*line, *unit);
            }
            LoneUnit lone{side_, unit, nullptr, std::nullopt};
            if (said) lone.excuse = std::make_shared<const std::string>(*said);
            if (!said && line != nullptr) lone.excuse = of_baseline;
            if (line != nullptr) lone.line = static_cast<size_t>(line - facts_.lock.baseline.data());
            out.lone.push_back(std::move(lone));
        }
    }

private:
    /// The units that no pair with this port leads to.
    void find_units(const std::vector<JudgedPair>& pairs) {
        std::set<const UnitState*> paired;
        for (const JudgedPair& pair : pairs)
            if (side_ == Side::Target || sets_.of_id(pair.id.target) == set_) {
                paired.insert(pair.unit[side_]);
                pairs_of_.emplace(pair.unit[side_], &pair);
            }
        for (const auto& [id, unit] : facts_.units(side_)) {
            const bool of_set = side_ == Side::Source || sets_.of_path(unit.file) == set_;
            if (unit.kind != UnitKind::File && of_set && !paired.contains(&unit)) units_.push_back(&unit);
        }
    }

    /// Which of the new units without a counterpart are told with the units that use them.
    void find_told(const std::vector<const UnitState*>& fresh, const Counterparts& counterparts) {
        std::vector<const UnitState*> unported;
        for (const UnitState* unit : fresh)
            if (!counterparts.contains(unit)) unported.push_back(unit);
        const std::set<const UnitState*> lone(units_.begin(), units_.end()), is_fresh(fresh.begin(), fresh.end());
        const auto tells_of = [&](const UnitState& user, std::string_view word) { return this->tells_of(user, word); };
        const FilesOfSide* files = facts_.files ? &(*facts_.files)[side_] : nullptr;
        std::set<std::string> differ;  // the pairs of this side of which both edits are told
        for (const Finding& finding : findings_.from(0))
            if (finding.rule == Rule::PortDiffers && is_open(finding) && finding.level > Level::Note)
                differ.insert(side_ == Side::Source ? finding.map_source : finding.map_target);
        const auto answers = [&](const UnitState& user) -> std::string {
            const auto counterpart = counterparts.find(&user);
            if (counterpart != counterparts.end())
                return counterpart->second.score >= kCertain ? "which looks like " + counterpart->second.unit->id : "";
            const auto [first, last] = pairs_of_.equal_range(&user);
            const bool is_told = first != last && std::all_of(first, last, [&](const auto& one) {
                                     return differ.contains(one.second->id[side_]);
                                 });
            return is_told ? "whose port changed as well" : "";
        };
        told_ = told_with_others({facts_.units(side_), lone, is_fresh, unported, files, tells_of, answers});
    }

    /// False for a watched unit whose edit is only a note, but for one of what the other side has nothing like, or that
    /// said the word at the merge base already.
    bool tells_of(const UnitState& user, std::string_view word) const {
        const auto [first, last] = pairs_of_.equal_range(&user);
        const bool is_note = std::any_of(first, last, [](const auto& one) {
            const JudgedPair& pair = *one.second;
            return pair.changed && !pair.equivalent && !pair.is_of_own_part && pair.standing == PairStanding::InStep;
        });
        if (is_note || facts_.at_base[side_] == nullptr) return !is_note;
        const auto then = facts_.at_base[side_]->find(user.id);
        if (then == facts_.at_base[side_]->end()) return true;
        const Words words = then->second.text.words();
        return std::find(words.begin(), words.end(), word) == words.end();
    }

    /// What a person said of the unit, if anybody said something.
    std::optional<std::string> judge_unit(const UnitState& unit, const LockedUnit* line,
                                          const Counterparts& counterparts) {
        const bool is_excused = (line != nullptr && line->reason.empty()) || verdicts_.is_ignored(unit);
        if (is_excused && facts_.suppressions.empty()) return std::nullopt;  // no comment could be used up
        const size_t first = findings_.size();
        const auto candidate = counterparts.find(&unit);
        if (candidate == counterparts.end()) {
            Finding& finding = findings_.add(Rule::Unported, unit, side_, set_);
            finding.message = fmt::format("{} {} has no {}", unit_kind_name(unit.kind), unit.name,
                                          side_ == Side::Target ? "counterpart in the source"
                                          : set_.empty()        ? "port"
                                                                : "port in " + set_);
            if (const auto told = told_.find(&unit); told != told_.end()) {
                if (!facts_.map.rules.contains(Rule::Unported)) finding.level = std::min(finding.level, Level::Note);
                finding.message += "; " + told->second;
            }
            if (side_ == Side::Target)
                finding.remedy.replace(0, std::string_view("Port it").size(), "Give it a counterpart");
        } else if (is_told(unit, *candidate->second.unit)) {
            return std::nullopt;
        } else {
            add_unpaired(unit, candidate->second);
        }
        if (const std::string user = line == nullptr ? file_that_includes(unit.file) : std::string(); !user.empty()) {
            Finding& finding = findings_.from(first).front();
            finding.level = std::min(finding.level, Level::Note);
            finding.message += "; " + user + " includes that file";
        }
        findings_.from(first).front().change = ChangeKind::Added;
        verdicts_.settle_lone(unit, side_, line);
        if (line != nullptr && !line->reason.empty()) return line->reason;
        for (const Finding& finding : findings_.from(first))
            if (finding.verdict) return finding.verdict_reason;
        return std::nullopt;
    }

    /// A file of the other side that includes one of this side, which has no port then; "" for none. It is the
    /// counterpart of a file in the same folder, since others may have a file of that name as well.
    std::string file_that_includes(const std::string& file) {
        const auto [known, is_new] = users_of_.try_emplace(file);
        const auto folder_of = [](std::string_view path) { return path.substr(0, path.rfind('/') + 1); };
        if (is_new)
            for (const auto& [unit, pair] : pairs_of_) {
                const UnitState* there = pair->unit[other(side_)];
                if (unit == nullptr || there == nullptr || folder_of(unit->file) != folder_of(file)) continue;
                if (!shared_files_.surely_includes(other(side_), there->file, file)) continue;
                known->second = there->file;
                break;
            }
        return known->second;
    }

    /// With `reference = "both"` two new units that look alike are one finding.
    bool is_told(const UnitState& unit, const UnitState& candidate) const {
        if (side_ == Side::Source) return false;
        const auto all = findings_.from(0);
        return std::any_of(all.begin(), all.end(), [&](const Finding& finding) {
            return finding.rule == Rule::Unpaired && finding.side == Side::Source && finding.source && finding.target &&
                   finding.source->id == candidate.id && finding.target->id == unit.id;
        });
    }

    void add_unpaired(const UnitState& unit, const Counterpart& candidate) {
        Finding& finding = findings_.add(Rule::Unpaired, unit, side_, set_);
        const Side there = other(side_);
        (there == Side::Source ? finding.source : finding.target) = findings_.place_of(*candidate.unit, there);
        const std::string pair =
            side_ == Side::Source ? unit.id + "=" + candidate.unit->id : candidate.unit->id + "=" + unit.id;
        const bool by_itself = facts_.map.rules.contains(Rule::Unpaired);
        if (!by_itself && candidate.score >= kCertain) finding.level = Level::Error;
        finding.message = fmt::format(
            "new {} {} looks like {} ({:.2f}){}: porttool accept {}", unit_kind_name(unit.kind),
            side_ == Side::Source ? unit.name : unit.id, candidate.unit->id, candidate.score,
            candidate.partner.empty() ? "" : ", which is paired with " + candidate.partner, argument(pair, finding));
        finding.remedy = "Compare the two once, then run the accept; if they are no pair, run: porttool ignore " +
                         argument(unit.id, finding) + " --reason TEXT";
    }

    const Case& facts_;
    const TargetSets& sets_;
    Side side_;
    std::string set_;
    FindingList& findings_;
    Verdicts& verdicts_;
    std::multimap<const UnitState*, const JudgedPair*> pairs_of_;
    SharedFiles& shared_files_;
    std::map<std::string, std::string> users_of_;   ///< by file: that of the other side which includes it, or ""
    std::vector<const UnitState*> units_;           ///< that no pair leads to
    std::map<const UnitState*, std::string> told_;  ///< new ones whose lack is told with others, and how
};

}  // namespace

void find_unwatched(const Case& facts, SharedFiles& shared_files, FindingList& findings, Verdicts& verdicts,
                    Judgement& out) {
    const TargetSets sets(facts.map);
    std::unordered_map<const UnitState*, Unwatched> units;  // each once, whatever ports lack it
    for (const Side side : kBothSides) {
        if (!is_contract(facts.map.reference, side)) continue;
        for (const auto& [id, unit] : facts.units(side)) out.summary.units += unit.kind != UnitKind::File ? 1 : 0;
        for (const std::string& set : sets.names())
            UnwatchedSide(facts, sets, side, set, shared_files, findings, verdicts).run(out, units);
    }
    out.summary.unported = units.size();
    for (const auto& [unit, counted] : units) {
        out.summary.unpaired += counted.unpaired ? 1 : 0;
        out.summary.unpaired_changed += counted.changed ? 1 : 0;
    }
}

}  // namespace porttool
