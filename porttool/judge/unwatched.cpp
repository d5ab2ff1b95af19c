// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/unwatched.h"

#include <fmt/format.h>

#include "porttool/compare/compare_pair.h"
#include "porttool/judge/baseline_index.h"
#include "porttool/judge/counterparts.h"
#include "porttool/judge/rules.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

constexpr float kCertain = 0.9f;  ///< of a candidate, from which on it is an error to leave it

const std::map<std::string, UnitState>& units_of(const Case& facts, Side side) {
    return side == Side::Source ? facts.source : facts.target;
}

/// A line of the baseline may know the written print alone.
bool is_edited(const LockedUnit& line, const UnitState& unit) {
    if (line.prints.written == unit.prints.written) return false;
    return line.prints.blanked == "-" || is_edit(classify(line.prints, unit.prints));
}

class UnwatchedSide {
public:
    UnwatchedSide(const Case& facts, Side side, const Resolver& resolver, FindingList& findings, Verdicts& verdicts)
        : facts_(facts), side_(side), findings_(findings), verdicts_(verdicts) {
        for (const auto& [id, unit] : units_of(facts, side)) {
            if (unit.kind == UnitKind::File) continue;
            ++all_;
            if (!resolver.taken(unit)) units_.push_back(&unit);
        }
    }

    void run(Judgement& out) {
        const BaselineIndex baseline(facts_.lock.baseline, side_, units_, units_of(facts_, side_));
        std::vector<const UnitState*> fresh;
        for (const UnitState* unit : units_)
            if (baseline.find(*unit) == nullptr && !verdicts_.is_ignored(*unit)) fresh.push_back(unit);
        const Counterparts counterparts = find_counterparts(facts_, out.pairs, side_, fresh);
        Summary& summary = out.summary;
        summary.units += all_;
        summary.unported += units_.size();
        for (const UnitState* unit : units_) {
            const LockedUnit* line = baseline.find(*unit);
            const std::optional<std::string> said = judge_unit(*unit, line, counterparts);
            const bool is_new = line == nullptr && !verdicts_.is_ignored(*unit);
            if (!said && !verdicts_.is_ignored(*unit)) {
                ++summary.unpaired;
                if (is_new || is_edited(*line, *unit)) ++summary.unpaired_changed;
            }
            std::optional<std::string> excuse = said;
            if (!excuse && line != nullptr) excuse = "had no port when the baseline was taken";
            const auto number = [&] { return static_cast<size_t>(line - facts_.lock.baseline.data()); };
            out.lone.push_back(
                {side_, unit, std::move(excuse), line == nullptr ? std::nullopt : std::optional(number())});
        }
    }

private:
    /// What a person said of the unit, if anybody said something.
    std::optional<std::string> judge_unit(const UnitState& unit, const LockedUnit* line,
                                          const Counterparts& counterparts) {
        const size_t first = findings_.size();
        const auto candidate = counterparts.find(&unit);
        if (candidate == counterparts.end()) {
            Finding& finding = findings_.add(Rule::Unported, unit, side_);
            finding.message = fmt::format("{} {} has no {}", unit_kind_name(unit.kind), unit.name,
                                          side_ == Side::Source ? "port" : "counterpart in the source");
            if (side_ == Side::Target) finding.remedy = "Give it a counterpart: " + finding.remedy;
        } else {
            add_unpaired(unit, candidate->second);
        }
        findings_.from(first).front().change = ChangeKind::Added;
        verdicts_.settle_lone(unit, side_, line);
        if (line != nullptr && !line->reason.empty()) return line->reason;
        for (const Finding& finding : findings_.from(first))
            if (finding.verdict) return finding.verdict_reason;
        return std::nullopt;
    }

    void add_unpaired(const UnitState& unit, const Counterpart& candidate) {
        Finding& finding = findings_.add(Rule::Unpaired, unit, side_);
        const Side there = other(side_);
        (there == Side::Source ? finding.source : finding.target) = findings_.place_of(*candidate.unit, there);
        const std::string pair =
            side_ == Side::Source ? unit.id + "=" + candidate.unit->id : candidate.unit->id + "=" + unit.id;
        const bool by_itself = facts_.map.rules.contains(Rule::Unpaired);
        if (!by_itself && candidate.score >= kCertain) finding.level = Level::Error;
        finding.message = fmt::format("new {} {} looks like {} ({:.2f}){}: porttool accept {}",
                                      unit_kind_name(unit.kind), unit.name, candidate.unit->id, candidate.score,
                                      candidate.partner.empty() ? "" : ", which is paired with " + candidate.partner,
                                      argument(pair, finding));
        finding.remedy = "Compare the two once, then run the accept; if they are no pair, run: porttool ignore " +
                         argument(unit.id, finding) + " --reason TEXT";
    }

    const Case& facts_;
    Side side_;
    FindingList& findings_;
    Verdicts& verdicts_;
    size_t all_ = 0;
    std::vector<const UnitState*> units_;  ///< that no pair leads to
};

}  // namespace

void find_unwatched(const Case& facts, const BySide<const Resolver*>& resolvers, FindingList& findings,
                    Verdicts& verdicts, Judgement& out) {
    for (const Side side : kBothSides)
        if (is_contract(facts.map.reference, side))
            UnwatchedSide(facts, side, *resolvers[side], findings, verdicts).run(out);
}

}  // namespace porttool
