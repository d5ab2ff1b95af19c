// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/finding_list.h"

#include <algorithm>
#include <tuple>
#include <unordered_map>

#include "porttool/judge/rules.h"
#include "porttool/text/sink/shell.h"

namespace porttool {
namespace {

/// Views of the finding's own texts: a sort asks for keys far more often than there are findings.
std::tuple<std::string_view, uint32_t, std::string_view, std::string_view, std::string_view> sort_key(
    const Finding& f) {
    const std::optional<Place>& place = f.source ? f.source : f.target;
    return {place ? place->file : std::string_view(), place ? place->line : 0, rule_name(f.rule), f.target_set,
            f.fingerprint};
}

std::string print_of(const std::vector<std::string>& parts) {
    Fingerprinter print;
    for (const std::string& part : parts) print.add(part);
    return print.digits();
}

}  // namespace

std::string argument(const std::string& id, const Finding& finding) {
    const bool is_list = id.starts_with('[') && id.ends_with(']');  // to the reader of the command line
    return can_be_pasted(id) && !is_list ? shell_quoted(id) : finding.fingerprint;
}

FindingList::FindingList(const MapFile& map) : map_(map), sets_(map) {
    size_t pairs = 0;
    for (const MapPair& pair : map.pairs) {
        ports_of_[pair.source] += pair.targets.size();
        pairs += pair.targets.size();
    }
    // To be moved while they grow takes as much again. Room that nothing is written to takes no memory.
    findings_.reserve(2 * pairs);
}

Level FindingList::level_of(Rule rule) const { return level_in(rule, map_); }

Finding& FindingList::begin(Rule rule, const std::string& source, const std::string& target,
                            const std::string& subject) {
    Finding finding;
    finding.rule = rule;
    finding.level = level_of(rule);
    finding.map_source = source;
    finding.map_target = target;
    std::vector<std::string> parts = {std::string(rule_name(rule)), source, target};
    if (!subject.empty()) parts.push_back(subject);
    finding.fingerprint = print_of(parts);
    finding.remedy = rule_row(rule).remedy;
    const size_t id = finding.remedy.find("ID");
    const auto ports = ports_of_.find(source);
    const bool one_of_several = !target.empty() && ports != ports_of_.end() && ports->second > 1;
    if (id != std::string::npos && !source.empty())
        finding.remedy.replace(id, 2, argument(one_of_several ? source + "=" + target : source, finding));
    findings_.push_back(std::move(finding));
    return findings_.back();
}

Finding& FindingList::add(Rule rule, const std::string& id) { return begin(rule, id, "", ""); }

Finding& FindingList::add(Rule rule, const UnitState& unit, Side side, const std::string& set) {
    Finding& finding = begin(rule, unit.id, "", side == Side::Source ? set : "target " + set);
    finding.target_set = set;
    finding.side = side;
    (side == Side::Source ? finding.source : finding.target) = place_of(unit, side);
    return finding;
}

Finding& FindingList::add(Rule rule, const JudgedPair& pair, std::optional<ChangeKind> change,
                          const std::string& message, const std::string& subject) {
    Finding& finding = begin(rule, pair.id.source, pair.id.target, subject);
    if (pair.unit.source != nullptr) finding.source = place_of(*pair.unit.source, Side::Source);
    if (pair.unit.target != nullptr) finding.target = place_of(*pair.unit.target, Side::Target);
    finding.map_line = pair.map_line;
    finding.target_set = sets_.of_id(pair.id.target);
    finding.change = change;
    finding.message = message;
    return finding;
}

Place FindingList::place_of(const UnitState& unit, Side side) const {
    return {unit.id, side == Side::Source ? unit.file : target_path(map_, unit.file), unit.start_line, unit.end_line};
}

std::vector<Finding> FindingList::finish() {
    std::sort(findings_.begin(), findings_.end(),
              [](const Finding& a, const Finding& b) { return sort_key(a) < sort_key(b); });
    std::unordered_map<std::string_view, int> seen;  // views of those that come first, which stay as they are
    for (Finding& finding : findings_) {
        const int number = ++seen[finding.fingerprint];
        if (number > 1) finding.fingerprint = print_of({finding.fingerprint, std::to_string(number)});
    }
    return std::move(findings_);
}

}  // namespace porttool
