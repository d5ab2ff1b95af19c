// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/folded.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "porttool/judge/edit_shapes.h"
#include "porttool/judge/sweeps.h"
#include "porttool/judge/use_graph.h"
#include "porttool/scan/scan.h"
#include "porttool/text/shortened.h"

namespace porttool {
namespace {

/// The id that a finding is about: of the side that changed or lacks something.
const std::string& subject_of(const Finding& finding) {
    const bool of_target = finding.rule == Rule::TargetChanged || finding.rule == Rule::DeadLink ||
                           (finding.map_target.empty() && finding.side == Side::Target);
    if (!finding.map_target.empty()) return of_target ? finding.map_target : finding.map_source;
    return finding.map_source;
}

bool is_edit_of_a_side(const Finding& finding) {
    return (finding.rule == Rule::SourceChanged || finding.rule == Rule::TargetChanged) && finding.change &&
           (*finding.change == ChangeKind::Semantic || *finding.change == ChangeKind::Constant);
}

/// A unit that is gone, while its counterpart is still named.
bool is_of_gone_unit(const Finding& finding) {
    return (finding.rule == Rule::Orphaned || finding.rule == Rule::DeadLink) && finding.change &&
           *finding.change == ChangeKind::Removed;
}

/// The name of the counterpart of what is gone: `GetKind` of each class of a family.
std::string family_of(const Finding& finding) {
    const std::string& id = finding.rule == Rule::Orphaned ? finding.map_target : finding.map_source;
    return std::string(rule_name(finding.rule)) + "\n" + finding.target_set + "\nall " +
           std::string(leaf_of(split_id(id).second));
}

/// The statements that two edits differ in, without the functions' heads, where there are several; else "".
std::string difference_of(const Finding& finding) {
    constexpr size_t kSeveral = 4;
    std::string out;
    size_t many = 0;
    for (const std::string& line : finding.details) {
        if (line.find("@(") != std::string::npos || line.starts_with("also: ")) continue;
        out += "\n" + line;
        ++many;
    }
    return many >= kSeveral ? out : std::string();
}

/// What findings of one cause have in common; "" for one that stands for itself.
std::string cause_of(const Finding& finding) {
    const std::string rule = std::string(rule_name(finding.rule)) + "\n" + finding.target_set + "\n";
    if (is_edit_of_a_side(finding)) {
        std::string edit;
        for (const std::string& line : finding.details) edit += "\n" + line;
        if (edit.empty()) return {};
        if (is_of_branches(finding.details)) return rule + "# ifdef";
        if (const std::string types = types_exchanged(finding.details); !types.empty()) return rule + types;
        if (const std::string name = handed_on(finding.details); !name.empty()) return rule + "takes " + name;
        return rule + (is_long_edit(finding.details) ? "" : subject_of(finding)) + edit;
    }
    if (finding.rule == Rule::PortDiffers)
        if (const std::string difference = difference_of(finding); !difference.empty()) return rule + difference;
    return finding.rule == Rule::Unpaired || is_of_gone_unit(finding) ? rule + split_id(subject_of(finding)).first
                                                                      : std::string();
}

/// A finding on what macros made of an unedited text; each of its details is one of them.
bool is_of_macros(const Finding& finding) {
    return (finding.rule == Rule::SourceChanged || finding.rule == Rule::TargetChanged) && !finding.change &&
           !finding.details.empty() &&
           std::all_of(finding.details.begin(), finding.details.end(), [](const auto& line) {
               return line.size() > 2 && std::string_view(line).substr(2).starts_with("#define ");
           });
}

/// Findings that have some of their causes in common, directly or through others: macros of one header, to all
/// appearance; names that gave way to others.
class CauseGroups {
public:
    void add(Finding& finding, const std::vector<std::string>& causes) {
        const std::string start = std::string(rule_name(finding.rule)) + "\n" + finding.target_set + "\n";
        size_t group = groups_.size();
        for (const std::string& cause : causes)
            if (const auto known = by_cause_.find(start + cause); known != by_cause_.end())
                group = group == groups_.size() ? known->second : joined(group, known->second);
        if (group == groups_.size()) groups_.emplace_back();
        groups_[group].findings.push_back(&finding);
        for (const std::string& cause : causes)
            if (by_cause_.emplace(start + cause, group).second) groups_[group].causes.push_back(start + cause);
    }

    /// The groups, each in the order of the findings.
    std::vector<std::vector<Finding*>> run() {
        std::vector<std::vector<Finding*>> out;
        for (Group& group : groups_) {
            if (group.findings.empty()) continue;
            std::sort(group.findings.begin(), group.findings.end(), std::less<>());  // they lie in one list
            out.push_back(std::move(group.findings));
        }
        return out;
    }

private:
    struct Group {
        std::vector<Finding*> findings;
        std::vector<std::string> causes;
    };

    /// The larger of two groups, with all of the other.
    size_t joined(size_t a, size_t b) {
        if (a == b) return a;
        if (groups_[a].causes.size() < groups_[b].causes.size()) std::swap(a, b);
        const Group gone = std::exchange(groups_[b], {});
        for (const std::string& cause : gone.causes) by_cause_[cause] = a;
        groups_[a].causes.insert(groups_[a].causes.end(), gone.causes.begin(), gone.causes.end());
        groups_[a].findings.insert(groups_[a].findings.end(), gone.findings.begin(), gone.findings.end());
        return a;
    }

    std::vector<Group> groups_;
    std::map<std::string, size_t> by_cause_;  ///< the group that a cause belongs to
};

/// An id as it stands in the message of another finding: one that is longer than a reader takes in has its middle left
/// out, and its finding's fingerprint beside it.
std::string named_briefly(const std::string& id, const Finding& finding) {
    constexpr size_t kMost = 120;
    return id.size() <= kMost ? id : shortened(id, kMost) + " (" + finding.fingerprint + ")";
}

/// What the others are, seen from the first.
std::string what_others_are(const Finding& first) {
    switch (first.rule) {
        case Rule::Unpaired:
            return "more new units look like one of the other side";
        case Rule::Unported:
            return "of its methods have none";
        case Rule::Orphaned:
        case Rule::DeadLink:
            return "more units are gone with it";
        default:
            if (is_of_macros(first)) return "more findings are about such macros";
            if (is_of_branches(first.details)) return "more pairs have parts in other branches for the compiler";
            if (!types_exchanged(first.details).empty()) return "more pairs take other types, too";
            if (is_in_doubt(first))
                return first.rule == Rule::PortDiffers
                           ? "more pairs were edited on both sides, each in its own way"
                           : "more pairs have edits that have little to do with their other side";
            if (!first.causes.empty() && first.causes.front().starts_with(kBuiltWith))
                return "more pairs only add what is built with it";
            if (!first.causes.empty())
                return first.causes.front().starts_with('+') ? "more pairs bring the same new names"
                                                             : "more pairs give things the same new names";
            return handed_on(first.details).empty() ? "more pairs have the same edit" : "more pairs hand on the same";
    }
}

/// How many findings of one cause are told once.
size_t least_told_once(const std::vector<Finding*>& group) {
    constexpr size_t kTwo = 2, kSeveral = 3, kMany = 5;  // a slip that was made alike is hardly made so often
    if (group.size() < kTwo || is_of_macros(*group.front())) return kTwo;
    const std::vector<std::string>& edit = group.front()->details;
    if (!types_exchanged(edit).empty()) return kMany;
    const bool all_alike =
        std::all_of(group.begin(), group.end(), [&](const Finding* finding) { return finding->details == edit; });
    return all_alike || handed_on(edit).empty() ? kTwo : kSeveral;
}

/// What new units without a counterpart have in common with their class, which is one, too.
std::map<std::string, std::vector<Finding*>> by_new_class(const std::vector<Finding*>& loud) {
    std::map<std::string, std::vector<Finding*>> out;
    const auto is_new = [](const Finding& finding, UnitKind kind) {
        return finding.rule == Rule::Unported && finding.message.starts_with(unit_kind_name(kind));
    };
    for (Finding* finding : loud)
        if (is_new(*finding, UnitKind::Struct)) out[finding->target_set + "\n" + subject_of(*finding)] = {finding};
    for (Finding* finding : loud) {
        const std::string& id = subject_of(*finding);
        const size_t scope = id.rfind("::");
        if (scope == std::string::npos || !is_new(*finding, UnitKind::Function)) continue;
        const auto its_class = out.find(finding->target_set + "\n" + id.substr(0, scope));
        if (its_class != out.end()) its_class->second.push_back(finding);
    }
    return out;
}

/// Edits of several units that do nothing but what others of them do as well: a function that has got another name, a
/// branch for the compiler that is gone everywhere. What is told with another shows there, spot by spot.
class CommonEdits {
public:
    explicit CommonEdits(const std::vector<Finding*>& loud) {
        for (Finding* finding : loud) {
            if (finding->level <= Level::Note || !is_edit_of_a_side(*finding)) continue;
            std::set<EditSpot> spots = spots_of(finding->details);
            if (spots.empty()) continue;
            for (const EditSpot& spot : spots) {
                units_[place_of(*finding) + spot.text].insert(subject_of(*finding));
                if (spot.of_call) units_[place_of(*finding) + callee_of(spot)].insert(subject_of(*finding));
            }
            edits_.push_back({finding, std::move(spots)});
        }
        for (Edit& edit : edits_) name_by_callee(edit);
    }

    /// The findings that are told with one, by that one.
    std::map<Finding*, std::vector<Finding*>> run() {
        std::erase_if(edits_, [&](const Edit& edit) { return !is_common(edit); });
        std::stable_sort(edits_.begin(), edits_.end(), [](const Edit& a, const Edit& b) {
            return std::pair(a.finding->level, a.spots.size()) > std::pair(b.finding->level, b.spots.size());
        });
        std::map<Finding*, std::vector<Finding*>> out;
        std::map<std::string, std::vector<const Edit*>> told;  // those that tell, by each of their spots
        for (const Edit& edit : edits_) {
            const std::string place = place_of(*edit.finding);
            std::vector<const Edit*>& candidates = told[place + edit.spots.begin()->text];
            const auto tells = [&](const Edit* other) {
                return std::includes(other->spots.begin(), other->spots.end(), edit.spots.begin(), edit.spots.end());
            };
            if (const auto found = std::find_if(candidates.begin(), candidates.end(), tells);
                found != candidates.end()) {
                out[(*found)->finding].push_back(edit.finding);
                continue;
            }
            for (const EditSpot& spot : edit.spots) told[place + spot.text].push_back(&edit);
        }
        return out;
    }

private:
    struct Edit {
        Finding* finding;
        std::set<EditSpot> spots;
    };

    static std::string place_of(const Finding& finding) {
        return std::string(rule_name(finding.rule)) + "\n" + finding.target_set + "\n";
    }

    /// The spot of a call as the function says it that is called now, in the place of whatever other.
    static std::string callee_of(const EditSpot& spot) { return "call" + spot.text.substr(spot.text.find('>')); }

    /// Calls of several functions that go to one now are one edit, in many units: of edits that do more than that.
    void name_by_callee(Edit& edit) const {
        if (edit.spots.size() < 2) return;
        std::set<EditSpot> spots;
        for (EditSpot spot : edit.spots) {
            const std::string place = place_of(*edit.finding);
            if (spot.of_call && units_.at(place + spot.text).size() < kMany)
                if (std::string callee = callee_of(spot); units_.at(place + callee).size() >= kMany)
                    spot.text = std::move(callee);
            spots.insert(std::move(spot));
        }
        edit.spots = std::move(spots);
    }

    /// True if each of its spots is one of several units: of more than a few words, a call that goes to another
    /// function in more of them than a slip would, or in so many that it was meant.
    bool is_common(const Edit& edit) const {
        constexpr size_t kLong = 4, kSeveral = 3, kSweep = 8;
        const bool is_slight = edit.spots.size() == 1 && edit.spots.begin()->text != "> &";
        return std::all_of(edit.spots.begin(), edit.spots.end(), [&](const EditSpot& spot) {
            const size_t units = units_.at(place_of(*edit.finding) + spot.text).size();
            if (spot.words >= kLong) return units >= kSeveral;
            return (spot.of_call && units >= kMany) || (!is_slight && units >= kSweep);
        });
    }

    static constexpr size_t kMany = 5;

    std::vector<Edit> edits_;
    std::map<std::string, std::set<std::string>> units_;  ///< that have a spot in their edit
};

/// Long edits that are one but for what tells their units apart by name: what was done to `left` was done to `right`.
class EditsOfSiblings {
public:
    explicit EditsOfSiblings(const std::vector<Finding*>& loud) {
        std::map<std::string, std::vector<std::pair<Finding*, EditShape>>> by_shape;
        for (Finding* finding : loud) {
            const bool is_edit = is_edit_of_a_side(*finding) || finding->rule == Rule::PortDiffers;
            if (finding->level <= Level::Note || !is_edit) continue;
            EditShape shape = shape_of_edit(finding->details);
            if (shape.text.empty()) continue;
            auto& alike =
                by_shape[std::string(rule_name(finding->rule)) + "\n" + finding->target_set + "\n" + shape.text];
            alike.emplace_back(finding, std::move(shape));
        }
        for (const auto& [text, alike] : by_shape) add_groups(alike);
    }

    const std::vector<std::vector<Finding*>>& groups() const { return groups_; }

private:
    void add_groups(const std::vector<std::pair<Finding*, EditShape>>& alike) {
        constexpr size_t kMostFirst = 16;
        std::vector<size_t> first;  // of each group
        const size_t begin = groups_.size();
        for (size_t i = 0; i < alike.size(); ++i) {
            const auto& [finding, shape] = alike[i];
            const auto group =
                std::find_if(first.begin(), first.end(), [&, &finding = finding, &shape = shape](size_t k) {
                    return names_tell_apart(alike[k].second.names,
                                            leaf_of(split_id(subject_of(*alike[k].first)).second), shape.names,
                                            leaf_of(split_id(subject_of(*finding)).second));
                });
            if (group != first.end()) {
                groups_[begin + static_cast<size_t>(group - first.begin())].push_back(finding);
            } else if (first.size() < kMostFirst) {
                first.push_back(i);
                groups_.push_back({finding});
            }
        }
    }

    std::vector<std::vector<Finding*>> groups_;
};

/// True for a line that names another finding which is told with this one.
bool is_of_another(const std::string& line) { return line.starts_with("also: "); }

/// The first says what the others are and lists them; they become notes that name it.
void tell_with(Finding& first, std::span<Finding* const> others, const std::string& what_they_are) {
    first.message += fmt::format("; {} {}:", others.size(), what_they_are);
    constexpr size_t kShown = 3;
    for (size_t i = 0; i < others.size(); ++i) {
        Finding& other = *others[i];
        const bool other_port = subject_of(other) == subject_of(first) && !other.map_target.empty();
        const std::string& id = other_port ? other.map_target : subject_of(other);
        if (i < kShown) first.message += (i > 0 ? ", " : " ") + named_briefly(id, other);
        first.details.push_back("also: " + named_briefly(id, other));
        std::copy_if(other.details.begin(), other.details.end(), std::back_inserter(first.details), is_of_another);
        other.level = Level::Note;
        other.message += "; told with " + named_briefly(subject_of(first), first);
    }
    if (others.size() > kShown) first.message += " ...";
}

/// The first of the worst findings of one cause tells the others.
void tell_with_worst(std::vector<Finding*>& group) {
    std::stable_sort(group.begin(), group.end(),
                     [](const Finding* a, const Finding* b) { return a->level > b->level; });
    tell_with(*group.front(), std::span(group).subspan(1), what_others_are(*group.front()));
}

/// The folder of a port of which a warning tells a long edit, where the port is not what counts; "" of all others.
std::string work_on_port(const Finding& finding, const MapFile& map) {
    if (finding.rule != Rule::TargetChanged || finding.level != Level::Warning || !is_edit_of_a_side(finding) ||
        is_contract(map.reference, Side::Target) || !is_work(finding.details))
        return {};
    const std::string file(split_id(subject_of(finding)).first);
    return finding.target_set + "\n" + file.substr(0, file.rfind('/') + 1);
}

/// Tells long edits of the ports of one folder, whose originals nobody touched, once: they are one piece of work on the
/// port, which one look at it answers.
void tell_work_once(const std::vector<Finding*>& loud, const MapFile& map) {
    std::map<std::string, std::vector<Finding*>> by_folder;
    for (Finding* finding : loud)
        if (const std::string folder = work_on_port(*finding, map); !folder.empty())
            by_folder[folder].push_back(finding);
    for (const auto& [folder, group] : by_folder)
        if (group.size() > 1)
            tell_with(*group.front(), std::span(group).subspan(1), "more ports were worked on without their sources");
}

/// True if others are told with it already.
bool has_others(const Finding& finding) {
    return std::any_of(finding.details.begin(), finding.details.end(), is_of_another);
}

}  // namespace

void fold_findings(FindingList& findings, const MapFile& map) {
    std::vector<Finding*> loud;
    for (Finding& finding : findings.from(0))
        if (is_open(finding) && finding.level > Level::Note && !map.rules.contains(finding.rule))
            loud.push_back(&finding);
    std::map<std::string, std::vector<Finding*>> causes = by_new_class(loud);
    constexpr size_t kFamily = 3;  // units that are gone, whose counterparts have one name
    constexpr size_t kMove = 3;    // files with new units: one piece of work, and one walk through the map
    std::map<std::string, size_t> gone;
    std::map<std::string, std::set<std::string>> new_in;  // files, by target set
    for (const Finding* finding : loud) {
        if (is_of_gone_unit(*finding)) ++gone[family_of(*finding)];
        if (finding->rule == Rule::Unpaired) new_in[finding->target_set].insert(split_id(subject_of(*finding)).first);
    }
    for (Finding* finding : loud) {
        const bool of_family = is_of_gone_unit(*finding) && gone[family_of(*finding)] >= kFamily;
        const bool of_move = finding->rule == Rule::Unpaired && new_in[finding->target_set].size() >= kMove;
        const std::string cause = of_family ? family_of(*finding)
                                  : of_move ? "new units\n" + finding->target_set
                                            : cause_of(*finding);
        if (!cause.empty()) causes[cause].push_back(finding);
    }
    CauseGroups macros;
    for (Finding* finding : loud)
        if (is_of_macros(*finding)) macros.add(*finding, finding->details);
    for (std::vector<Finding*>& group : macros.run())
        causes[fmt::format("macros {}", causes.size())] = std::move(group);
    for (auto& [cause, group] : causes)
        if (group.size() >= least_told_once(group)) tell_with_worst(group);
    for (const auto& [first, others] : CommonEdits(loud).run())
        tell_with(*first, others, "more pairs have nothing but parts of the same edit");
    const EditsOfSiblings siblings(loud);
    for (const std::vector<Finding*>& group : siblings.groups())
        if (group.size() > 1)
            tell_with(*group.front(), std::span(group).subspan(1), "more pairs have the same edit in their own names");
    CauseGroups known;
    for (Finding* finding : loud)
        if (finding->level > Level::Note && !finding->causes.empty()) known.add(*finding, finding->causes);
    for (std::vector<Finding*>& group : known.run())
        if (group.size() > 1) tell_with_worst(group);
    std::vector<Finding*> edits;
    std::copy_if(loud.begin(), loud.end(), std::back_inserter(edits),
                 [](const Finding* finding) { return is_edit_of_a_side(*finding) && !has_others(*finding); });
    for (const std::vector<Finding*>& group : sweeps(edits))
        tell_with(*group.front(), std::span(group).subspan(1), "more pairs have edits of the same words");
    tell_work_once(loud, map);
}

void ease_orphans(FindingList& findings, const std::vector<JudgedPair>& pairs, const UnitsById& ports) {
    std::map<std::string, std::string> heirs;  // ports that something else is the source of
    const auto all = findings.from(0);
    if (std::none_of(all.begin(), all.end(), [](const Finding& finding) { return finding.rule == Rule::Orphaned; }))
        return;
    for (const Finding& finding : all)
        if (finding.rule == Rule::Unpaired && finding.side == Side::Source && finding.target)
            heirs.emplace(finding.target->id, finding.map_source + " is new and looks like it");
    std::vector<UseGraph::Marked> users;  // ports with a source, by their pairs
    for (size_t i = 0; i < pairs.size(); ++i) {
        const JudgedPair& pair = pairs[i];
        if (pair.unit.source == nullptr || pair.unit.target == nullptr) continue;
        heirs.emplace(pair.id.target, pair.id.source + " is its source as well");
        users.push_back({pair.unit.target, i});
    }
    const auto used = UseGraph(ports).reached(users, UseGraph::Along::Uses);
    for (Finding& finding : all) {
        if (finding.rule != Rule::Orphaned || finding.source || !finding.target) continue;
        auto heir = heirs.find(finding.map_target);
        if (heir == heirs.end()) heir = heirs.find(finding.target->id);
        const auto port = ports.find(finding.target->id);
        const auto user = port == ports.end() ? used.end() : used.find(&port->second);
        if (heir == heirs.end() && user == used.end()) continue;
        finding.level = std::min(finding.level, Level::Note);
        finding.message +=
            "; " +
            (heir != heirs.end() ? heir->second : pairs[user->second].id.target + " uses it, whose source is there");
        finding.remedy = "Remove this [[pair]] from portmap.toml";
    }
}

}  // namespace porttool
