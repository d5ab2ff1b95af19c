// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/assign.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "porttool/match/decide.h"
#include "porttool/match/inlined_kernels.h"
#include "porttool/match/words.h"

namespace porttool {
namespace {

constexpr uint32_t kNobody = kNoUnit;

struct Choice {
    float score;
    uint32_t source;
    uint32_t candidate;  ///< index into the source's list
};

class Assigner {
public:
    Assigner(const std::vector<UnitFeatures>& source, const std::vector<UnitFeatures>& target, const TermNumbers& terms,
             const std::vector<FixedPair>& fixed, std::vector<std::vector<Candidate>> candidates)
        : source_(source),
          target_(target),
          terms_(terms),
          candidates_(std::move(candidates)),
          fixed_(source.size(), false) {
        for (const UnitFeatures& unit : source_) ++source_names_[unit.folded_name];
        for (const UnitFeatures& unit : target_) ++target_names_[unit.folded_name];
        for (const UnitFeatures& unit : target_) ++target_cores_[unit.core];
        read_launchers();
        read_workers();
        read_homes();
        for (const auto& list : candidates_) {
            scores_.emplace_back();
            for (const Candidate& candidate : list)
                scores_.back().push_back(candidate.resemblance.score +
                                         (is_namesake(candidate) ? kNamesakeBonus : 0.0f) + role_bonus(candidate));
        }
        for (uint32_t s = 0; s < source_.size(); ++s) prefer_alike_bodies(s);
        constexpr float kFixed = 10;  // ahead of all that is only alike
        for (const FixedPair& pair : fixed) {
            fixed_[pair.source] = true;
            for (float& score : scores_[pair.source]) score = kFixed;
        }
    }

    std::vector<Assignment> run() {
        choose();
        add_affinity();
        add_callee_affinity();
        alike_ = scores_;
        constexpr int kRounds = 2;  // a third changes next to nothing
        for (int round = 0; round < kRounds; ++round) {
            weigh_names(learn_names());
            choose();
        }
        take_stock(learn_names());
        settle();
        share_targets();
        share_sources();
        add_handing_on();
        add_inlined();
        return std::move(settled_);
    }

private:
    static constexpr float kNamesakeBonus = 0.08f;

    /// One name that stands once on either side.
    bool is_namesake(const Candidate& candidate) const {
        const std::string& name = source_[candidate.source].folded_name;
        return name == target_[candidate.target].folded_name && source_names_.at(name) == 1 &&
               target_names_.at(name) == 1;
    }

    /// One name for several units of a file, and the two share it. In several files they are copies.
    static bool is_overloaded(const UnitFeatures& a, const UnitFeatures& b) {
        if (a.whole_file_main || b.whole_file_main) return false;  // what they take stands outside
        return a.folded_leaf == b.folded_leaf && (a.overloaded || b.overloaded);
    }

    /// Of several functions about a kernel's subject, as one that hands on, one that checks and one that works it out,
    /// the port is the one that is written most alike, however long its name is.
    void prefer_alike_bodies(uint32_t s) {
        constexpr float kPerShare = 0.6f;
        const auto about_it = [&](const Candidate& candidate) {
            return candidate.resemblance.core >= 1 && source_[s].kernel && !target_[candidate.target].kernel;
        };
        float most = 0;
        for (const Candidate& candidate : candidates_[s])
            if (about_it(candidate)) most = std::max(most, body_likeness(candidate.resemblance));
        for (uint32_t c = 0; c < candidates_[s].size(); ++c) {
            const Candidate& candidate = candidates_[s][c];
            if (about_it(candidate) && candidate.resemblance.same_name < 1)
                scores_[s][c] -= kPerShare * (most - body_likeness(candidate.resemblance));
        }
    }

    /// Which shaders' mains have a candidate that works in the other side's file of their own file's name.
    void read_homes() {
        has_home_.assign(source_.size(), false);
        for (uint32_t s = 0; s < source_.size(); ++s)
            has_home_[s] = source_[s].whole_file_main &&
                           std::any_of(candidates_[s].begin(), candidates_[s].end(), [&](const Candidate& candidate) {
                               const UnitFeatures& unit = target_[candidate.target];
                               return unit.stem == source_[s].stem && unit.works && !prepares(source_[s], unit);
                           });
    }

    /// A shader's main is the subject of its file: a helper of another file is not it, even under the very name.
    bool is_elsewhere(uint32_t s, uint32_t t) const { return has_home_[s] && target_[t].stem != source_[s].stem; }

    /// What of the source leads to a kernel without launching it, and what of the target works, itself or in a function
    /// of its file that it calls.
    void read_workers() {
        leads_on_ = units_that_call(source_, [](const UnitFeatures& unit) { return unit.launches && !unit.kernel; });
        delegates_ = units_that_call(
            target_, [](const UnitFeatures& unit) { return unit.works || unit.launches || unit.kernel; });
    }

    /// Who calls a function of its own file that is such a one.
    template <class Is>
    static std::vector<bool> units_that_call(const std::vector<UnitFeatures>& units, const Is& is) {
        std::unordered_set<uint64_t> such;
        for (const UnitFeatures& unit : units)
            if (unit.group == Group::Code && is(unit)) such.insert(file_pair(unit.file, unit.called_as));
        std::vector<bool> out(units.size());
        for (size_t i = 0; i < units.size(); ++i)
            out[i] = !such.empty() && std::any_of(units[i].callees.begin(), units[i].callees.end(), [&](uint32_t name) {
                return such.contains(file_pair(units[i].file, name));
            });
        return out;
    }

    /// What leads to a kernel is not ported by what neither works nor calls what does, as what only notes what to do.
    bool is_idle_for(uint32_t s, uint32_t t) const {
        const UnitFeatures& unit = target_[t];
        return leads_on_[s] && !source_[s].works && !unit.works && !unit.launches && !delegates_[t];
    }

    /// What each target does with the kernels of the source: launches them, calls what does, or neither.
    void read_launchers() {
        std::unordered_set<uint32_t> kernels, launchers;
        for (const UnitFeatures& unit : target_)
            if (unit.group == Group::Code) own_.insert(unit.called_as);
        for (const UnitFeatures& unit : source_)
            if (unit.kernel && !own_.contains(unit.called_as)) kernels.insert(unit.called_as);
        launches_.assign(target_.size(), false);
        const auto calls_any = [](const UnitFeatures& unit, const std::unordered_set<uint32_t>& names) {
            return std::any_of(unit.callees.begin(), unit.callees.end(),
                               [&](uint32_t name) { return names.contains(name); });
        };
        for (uint32_t t = 0; t < target_.size(); ++t) {
            const UnitFeatures& unit = target_[t];
            // Who sets arguments where there are no kernels sets those of the source's, whatever he stores for that.
            const bool for_others = unit.sets_arguments && !unit.beside_kernels;
            launches_[t] = !unit.kernel && unit.launches && (unit.launcher || for_others || calls_any(unit, kernels));
            if (launches_[t]) launchers.insert(target_[t].called_as);
        }
        for (uint32_t t = 0; t < target_.size(); ++t)
            if (!target_[t].works && calls_any(target_[t], launchers)) launches_[t] = true;
        read_callers();
    }

    /// What of the target calls launchers that stand beside the source's kernels: the host that both sides have in
    /// common, or the part of it that is in the target's folders.
    void read_callers() {
        std::unordered_multimap<uint32_t, uint32_t> launchers;  // by the name that they are called by, their files
        const auto is_one = [&](const UnitFeatures& unit) {
            return unit.group == Group::Code && !unit.kernel && unit.says_kernels && !own_.contains(unit.called_as);
        };
        for (const UnitFeatures& unit : source_)
            if (is_one(unit) && unit.launches) launchers.emplace(unit.called_as, unit.file);
        std::unordered_multimap<uint32_t, uint32_t> handing_on;
        for (const UnitFeatures& unit : source_)
            if (is_one(unit) && !unit.launches)
                for (const uint32_t name : unit.callees)
                    if (launchers.contains(name)) handing_on.emplace(unit.called_as, unit.file);
        launchers.insert(handing_on.begin(), handing_on.end());
        calls_into_.assign(target_.size(), {});
        for (uint32_t t = 0; t < target_.size(); ++t)
            if (!target_[t].works && !launchers.empty())
                for (const uint32_t name : target_[t].callees) {
                    const auto [first, last] = launchers.equal_range(name);
                    for (auto found = first; found != last; ++found) calls_into_[t].insert(found->second);
                }
    }

    /// A kernel, and what launches it there or hands on to what does.
    bool is_launched_there(uint32_t s, uint32_t t) const {
        return is_used_there(s, t) || (source_[s].kernel && (launches_[t] || calls_by_name(s, t)));
    }

    /// A call of a name that the target itself does not have is one of the source's.
    bool calls_by_name(uint32_t s, uint32_t t) const {
        const uint32_t name = source_[s].called_as;
        const std::vector<uint32_t>& callees = target_[t].callees;
        return !own_.contains(name) && std::binary_search(callees.begin(), callees.end(), name);
    }

    /// A kernel or launcher of a file whose launchers are called there.
    bool is_used_there(uint32_t s, uint32_t t) const {
        return calls_into_[t].contains(source_[s].file) && (source_[s].kernel || source_[s].launches);
    }

    /// One of the two launches kernels. Where they share the last part of their names, or differ there in the platform
    /// that each names, the other can hold the launcher and its kernel in one, but is no kernel.
    static bool other_role(const UnitFeatures& a, const UnitFeatures& b) {
        const bool one_name =
            a.called_as == b.called_as || (a.folded_leaf == b.folded_leaf && a.names_platform && b.names_platform);
        return a.launcher != b.launcher && (a.kernel || b.kernel || !one_name);
    }

    /// One is a kernel, and the other's name says that it makes ready for what a kernel does.
    bool prepares(const UnitFeatures& a, const UnitFeatures& b) const {
        if (a.kernel == b.kernel || a.group != Group::Code) return false;
        const UnitFeatures &kernel = a.kernel ? a : b, &other = a.kernel ? b : a;
        return std::any_of(other.all_words.begin(), other.all_words.end(), [&](uint32_t word) {
            return marks_preparation(terms_.text(word)) &&
                   !std::binary_search(kernel.all_words.begin(), kernel.all_words.end(), word);
        });
    }

    /// How far a candidate's body is ahead of those of all others.
    float body_margin(uint32_t s, uint32_t chosen) const {
        float rival = 0;
        for (uint32_t c = 0; c < candidates_[s].size(); ++c)
            if (c != chosen) rival = std::max(rival, body_likeness(candidates_[s][c].resemblance));
        return body_likeness(candidates_[s][chosen].resemblance) - rival;
    }

    /// What the two do: a launcher is no kernel's port, and what computes is ported by what computes.
    float role_bonus(const Candidate& candidate) const {
        constexpr float kCore = 0.05f, kNoKernel = -0.4f, kLauncher = -0.2f, kSameName = -0.05f, kIdle = -0.06f,
                        kOperands = 0.15f, kPrepares = -0.15f, kElsewhere = -0.4f, kBranch = 0.02f;
        const UnitFeatures &a = source_[candidate.source], &b = target_[candidate.target];
        float bonus = kCore * candidate.resemblance.core;
        if (is_launched_there(candidate.source, candidate.target))
            bonus += kNoKernel;
        else if (a.launcher != b.launcher)
            bonus += a.kernel || b.kernel ? kNoKernel : other_role(a, b) ? kLauncher : kSameName;
        else if ((a.works && !b.computes) || (a.kernel && a.acts && !b.acts) || (b.works && !a.computes))
            bonus += a.kernel && !b.computes ? 2 * kIdle : kIdle;
        if (prepares(a, b) || is_idle_for(candidate.source, candidate.target)) bonus += kPrepares;
        if (is_elsewhere(candidate.source, candidate.target)) bonus += kElsewhere;
        if (a.folded_name == b.folded_name && a.branch == b.branch && !is_overloaded(a, b)) bonus += kBranch;
        if (is_overloaded(a, b)) bonus -= kOperands * (1 - candidate.resemblance.operands);
        return bonus;
    }

    std::vector<Choice> sorted_choices() const {
        std::vector<Choice> choices;
        for (uint32_t s = 0; s < candidates_.size(); ++s)
            for (uint32_t c = 0; c < candidates_[s].size(); ++c) choices.push_back({scores_[s][c], s, c});
        std::sort(choices.begin(), choices.end(), [&](const Choice& a, const Choice& b) {
            if (a.score != b.score) return a.score > b.score;
            if (a.source != b.source) return a.source < b.source;
            return a.candidate < b.candidate;
        });
        return choices;
    }

    void choose() {
        choice_.assign(source_.size(), kNobody);
        claimed_.assign(target_.size(), kNobody);
        for (const Choice& choice : sorted_choices()) {
            const uint32_t t = candidates_[choice.source][choice.candidate].target;
            if (choice_[choice.source] != kNobody || claimed_[t] != kNobody) continue;
            choice_[choice.source] = choice.candidate;
            claimed_[t] = choice.source;
        }
    }

    static uint64_t file_pair(uint32_t a, uint32_t b) { return static_cast<uint64_t>(a) << 32 | b; }

    /// Files that share certain pairs lift the scores between their other units.
    void add_affinity() {
        constexpr float kMostBonus = 0.05f;
        std::unordered_map<uint64_t, float> shared;
        std::unordered_map<uint32_t, float> most;
        for (uint32_t s = 0; s < source_.size(); ++s) {
            if (choice_[s] == kNobody || !is_certain(s)) continue;
            const Candidate& chosen = candidates_[s][choice_[s]];
            const float count = ++shared[file_pair(source_[s].file, target_[chosen.target].file)];
            most[source_[s].file] = std::max(most[source_[s].file], count);
        }
        for (uint32_t s = 0; s < source_.size(); ++s) {
            for (uint32_t c = 0; c < candidates_[s].size(); ++c) {
                const auto found = shared.find(file_pair(source_[s].file, target_[candidates_[s][c].target].file));
                if (found != shared.end())
                    scores_[s][c] += kMostBonus * found->second / std::max(2.0f, most[source_[s].file]);
            }
        }
    }

    /// What two units of a certain pair call is lifted between each other.
    void add_callee_affinity() {
        constexpr size_t kMostNamesakes = 8;
        std::unordered_map<uint32_t, std::vector<uint32_t>> called;  // source units by the name that they are called by
        for (uint32_t s = 0; s < source_.size(); ++s)
            if (source_[s].group == Group::Code) called[source_[s].called_as].push_back(s);
        std::vector<std::vector<bool>> lifted(candidates_.size());
        for (uint32_t s = 0; s < source_.size(); ++s) {
            if (choice_[s] == kNobody || !is_certain(s)) continue;
            const std::vector<uint32_t>& there = target_[candidates_[s][choice_[s]].target].callees;
            for (const uint32_t name : source_[s].callees) {
                const auto found = called.find(name);
                if (found == called.end() || found->second.size() > kMostNamesakes) continue;
                for (const uint32_t callee : found->second) lift(callee, there, lifted[callee]);
            }
        }
        constexpr float kBonus = 0.04f;
        for (uint32_t s = 0; s < lifted.size(); ++s)
            for (uint32_t c = 0; c < lifted[s].size(); ++c)
                if (lifted[s][c]) scores_[s][c] += kBonus;
    }

    void lift(uint32_t s, const std::vector<uint32_t>& there, std::vector<bool>& lifted) const {
        lifted.resize(candidates_[s].size());
        for (uint32_t c = 0; c < lifted.size(); ++c)
            lifted[c] = lifted[c] ||
                        std::binary_search(there.begin(), there.end(), target_[candidates_[s][c].target].called_as);
    }

    NameEvidence learn_names() const {
        std::vector<LearnedPair> pairs;
        for (uint32_t s = 0; s < source_.size(); ++s)
            if (choice_[s] != kNobody) pairs.push_back({s, candidates_[s][choice_[s]].target, is_certain(s)});
        return {source_, target_, terms_, pairs};
    }

    /// Names that differ as this project's ports do not lower the scores.
    void weigh_names(const NameEvidence& names) {
        constexpr float kPerLogOdds = 0.05f;
        for (uint32_t s = 0; s < source_.size(); ++s)
            for (uint32_t c = 0; c < candidates_[s].size(); ++c) {
                const NameDifference difference = names.difference(source_[s], target_[candidates_[s][c].target]);
                scores_[s][c] = alike_[s][c] - kPerLogOdds * doubt(difference);
            }
    }

    bool is_certain(uint32_t s) const {
        constexpr float kScore = 0.55f, kMargin = 0.1f;
        return scores_[s][choice_[s]] >= kScore && margin(s, choice_[s]) >= kMargin;
    }

    /// How far a source's choice is ahead of its best score elsewhere. Other variants of the chosen name are no rivals.
    float margin(uint32_t s, uint32_t chosen) const {
        const UnitFeatures& unit = target_[candidates_[s][chosen].target];
        const bool by_core = candidates_[s][chosen].resemblance.core >= 1;
        float rival = 0;
        for (uint32_t c = 0; c < candidates_[s].size(); ++c) {
            const UnitFeatures& other = target_[candidates_[s][c].target];
            if (c == chosen || other.folded_name == unit.folded_name || (by_core && other.core == unit.core)) continue;
            rival = std::max(rival, scores_[s][c]);
        }
        return scores_[s][chosen] - rival;
    }

    /// All candidates with what speaks for them, once the rounds are over.
    void take_stock(const NameEvidence& names) {
        choice_.assign(source_.size(), kNobody);
        claimed_.assign(target_.size(), kNobody);
        differences_.resize(candidates_.size());
        for (uint32_t s = 0; s < candidates_.size(); ++s)
            for (const Candidate& candidate : candidates_[s])
                differences_[s].push_back(names.difference(source_[s], target_[candidate.target]));
    }

    Assignment describe(uint32_t s, uint32_t c, bool shared = false) const {
        const Candidate& chosen = candidates_[s][c];
        Assignment out;
        out.source = s;
        out.target = chosen.target;
        out.resemblance = chosen.resemblance;
        out.margin = margin(s, c);
        out.names = differences_[s][c];
        out.other_role = other_role(source_[s], target_[chosen.target]) || is_launched_there(s, chosen.target);
        out.unfit = prepares(source_[s], target_[chosen.target]) || is_idle_for(s, chosen.target) ||
                    is_elsewhere(s, chosen.target);
        out.body_margin = body_margin(s, c);
        constexpr float kOperands = 0.67f;
        out.wrong_operands =
            is_overloaded(source_[s], target_[chosen.target]) && chosen.resemblance.operands < kOperands;
        out.only_one =
            source_names_.at(source_[s].folded_name) == 1 && target_names_.at(target_[chosen.target].folded_name) == 1;
        constexpr int kFew = 3;
        out.same_subject = chosen.resemblance.core >= 1 && target_cores_.at(target_[chosen.target].core) <= kFew;
        out.shared = shared;
        out.confidence = is_used_there(s, chosen.target) ? 0.0f : confidence(source_[s], target_[chosen.target], out);
        return out;
    }

    /// Chooses as choose() does, but a claim that is too doubtful leaves its target to others.
    void settle() {
        for (const Choice& choice : sorted_choices()) {
            const uint32_t t = candidates_[choice.source][choice.candidate].target;
            if (choice_[choice.source] != kNobody || claimed_[t] != kNobody) continue;
            Assignment pair = describe(choice.source, choice.candidate);
            pair.fixed = fixed_[choice.source];
            if (!pair.fixed && pair.confidence < kLeastConfidence) continue;
            choice_[choice.source] = choice.candidate;
            claimed_[t] = choice.source;
            settled_.push_back(pair);
        }
        for (uint32_t s = 0; s < source_.size(); ++s)
            for (const Candidate& candidate : candidates_[s])
                if (fixed_[s]) claimed_[candidate.target] = s;
    }

    /// Source units that are left get a target that another has: several sources are ported by one function.
    void share_targets() {
        for (uint32_t s = 0; s < source_.size(); ++s) {
            if (choice_[s] != kNobody || source_[s].group != Group::Code) continue;
            uint32_t best = kNobody;
            for (uint32_t c = 0; c < candidates_[s].size(); ++c)
                if (best == kNobody || scores_[s][c] > scores_[s][best]) best = c;
            if (best == kNobody || claimed_[candidates_[s][best].target] == kNobody) continue;
            const Candidate& candidate = candidates_[s][best];
            if (!may_share(source_[s], target_[candidate.target], source_[claimed_[candidate.target]], candidate))
                continue;
            if (add_shared(s, best, source_[s], source_[claimed_[candidate.target]])) choice_[s] = best;
        }
    }

    /// The same for targets that are left: one function is ported by several kernels, by copies in several files, or
    /// for several instruction sets.
    void share_sources() {
        std::vector<Choice> best(target_.size(), Choice{0, kNobody, 0});
        for (uint32_t s = 0; s < source_.size(); ++s)
            for (uint32_t c = 0; c < candidates_[s].size(); ++c) {
                const uint32_t t = candidates_[s][c].target;
                if (claimed_[t] == kNobody && target_[t].group == Group::Code && scores_[s][c] > best[t].score)
                    best[t] = {scores_[s][c], s, c};
            }
        for (Choice& choice : best) {
            const uint32_t s = choice.source;
            const bool has_port = s != kNobody && choice_[s] != kNobody && !fixed_[s];
            if (!has_port || !may_port_too(s, candidates_[s][choice.candidate])) choice.source = kNobody;
        }
        std::map<SecondForm, uint32_t> forms;
        for (uint32_t t = 0; t < target_.size(); ++t)
            if (best[t].source != kNobody) ++forms[form_of(t, best[t].source)];
        for (uint32_t t = 0; t < target_.size(); ++t) {
            const uint32_t s = best[t].source;
            if (s == kNobody) continue;
            const uint32_t own = candidates_[s][choice_[s]].target;
            constexpr uint32_t kFamily = 4;
            const bool alone = !is_known_copy(s, t, own) && forms.at(form_of(t, s)) < kFamily;
            if (!alone && add_shared(s, best[t].candidate, target_[t], target_[own])) claimed_[t] = s;
        }
    }

    /// True if a target may be one more port of a source that has one.
    bool may_port_too(uint32_t s, const Candidate& candidate) const {
        const UnitFeatures &unit = target_[candidate.target], &own = target_[candidates_[s][choice_[s]].target];
        if (&unit == &own || !may_share(unit, source_[s], own, candidate)) return false;
        // Branches of an `#if` on both sides are one each.
        const bool branch = unit.file == own.file && unit.folded_name == own.folded_name;
        if (branch && source_names_.at(source_[s].folded_name) > 1) return false;
        if (branch && source_[s].whole_file_main && unit.overloaded) return false;  // overloads are no copies
        return is_second_form(unit, own) || is_known_copy(s, candidate.target, candidates_[s][choice_[s]].target);
    }

    bool is_known_copy(uint32_t s, uint32_t t, uint32_t own) const {
        const bool kernels = target_[t].kernel && target_[own].kernel && !source_[s].kernel;
        return kernels || is_copy(target_[t], target_[own]);
    }

    /// Of one subject in another file, under a longer name: of a project that has its functions in two forms, where a
    /// whole family of a file has the same words more.
    static bool is_second_form(const UnitFeatures& a, const UnitFeatures& b) {
        return a.file != b.file && a.core == b.core && !a.core.empty() && a.all_words.size() > b.all_words.size() &&
               std::includes(a.all_words.begin(), a.all_words.end(), b.all_words.begin(), b.all_words.end());
    }

    /// A file, and the words that a name there has more than that of the port that its source has already.
    using SecondForm = std::pair<uint32_t, std::vector<uint32_t>>;

    SecondForm form_of(uint32_t t, uint32_t s) const {
        const auto& longer = target_[t].all_words;
        const auto& shorter = target_[candidates_[s][choice_[s]].target].all_words;
        SecondForm form{target_[t].file, {}};
        std::set_difference(longer.begin(), longer.end(), shorter.begin(), shorter.end(),
                            std::back_inserter(form.second));
        return form;
    }

    /// The same function once more, or for another instruction set: but for such a word the names are equal, and the
    /// bodies at least as alike as two ports are.
    bool is_copy(const UnitFeatures& a, const UnitFeatures& b) const {
        constexpr float kAlike = 0.4f;
        if (a.folded_name != b.folded_name && without_instruction_set(a) != without_instruction_set(b)) return false;
        return a.folded_name != b.folded_name || body_likeness(compare_units(a, b)) >= kAlike;
    }

    std::vector<uint32_t> without_instruction_set(const UnitFeatures& unit) const {
        std::vector<uint32_t> words = unit.ordered_words;
        std::erase_if(words, [&](uint32_t word) { return names_instruction_set(terms_.text(word)); });
        return words;
    }

    /// `unit` is new to the pair, `owner` of the same side has it.
    bool add_shared(uint32_t s, uint32_t c, const UnitFeatures& unit, const UnitFeatures& owner) {
        Assignment pair = describe(s, c, true);
        pair.confidence = std::max(pair.confidence, as_variant(unit, owner));
        if (pair.confidence < kLeastConfidence) return false;
        settled_.push_back(pair);
        return true;
    }

    /// How likely one is ported by what ports the other, as they are the same but for words that tell how, or for the
    /// number of a version.
    float as_variant(const UnitFeatures& unit, const UnitFeatures& owner) const {
        constexpr float kAlike = 0.5f, kMost = 0.85f;
        const bool one = unit.core == owner.core || is_version_of(unit.core_words, owner.core_words);
        const float alike = one ? body_likeness(compare_units(unit, owner)) : 0.0f;
        return alike < kAlike ? 0.0f : std::min(kMost, 0.2f + 0.7f * alike);
    }

    /// `solver_2` of `solver`: the same words, and numbers.
    bool is_version_of(const std::vector<uint32_t>& longer, const std::vector<uint32_t>& shorter) const {
        if (!std::includes(longer.begin(), longer.end(), shorter.begin(), shorter.end())) return false;
        std::vector<uint32_t> more;
        std::set_difference(longer.begin(), longer.end(), shorter.begin(), shorter.end(), std::back_inserter(more));
        return std::all_of(more.begin(), more.end(),
                           [&](uint32_t word) { return numbers_a_version(terms_.text(word)); });
    }

    /// What a project computes on the host to compare its kernels with is not what ports them.
    bool is_reference_of(const UnitFeatures& unit, const UnitFeatures& target) const {
        return std::any_of(unit.all_words.begin(), unit.all_words.end(), [&](uint32_t word) {
            return marks_reference(terms_.text(word)) &&
                   !std::binary_search(target.all_words.begin(), target.all_words.end(), word);
        });
    }

    /// A kernel that is left and does no more than call one function is ported by what ports that.
    void add_handing_on() {
        constexpr float kMost = 0.85f, kPerStep = 0.95f;
        std::unordered_map<uint32_t, const Assignment*> best;  // by source
        std::unordered_multimap<uint32_t, uint32_t> ported;    // sources by the name that they are called by
        for (const Assignment& pair : settled_) {
            const auto [found, is_new] = best.try_emplace(pair.source, &pair);
            if (is_new) ported.emplace(source_[pair.source].called_as, pair.source);
            if (pair.confidence > found->second->confidence) found->second = &pair;
        }
        std::vector<Assignment> handed_on;
        for (uint32_t s = 0; s < source_.size(); ++s) {
            const uint32_t callee = only_callee(s, ported);
            if (callee == kNobody || source_[callee].size < source_[s].size) continue;
            handed_on.push_back(*best.at(callee));
            handed_on.back().source = s;
            handed_on.back().fixed = false;
            handed_on.back().shared = true;
            handed_on.back().confidence = std::min(kMost, kPerStep * best.at(callee)->confidence);
        }
        settled_.insert(settled_.end(), handed_on.begin(), handed_on.end());
    }

    /// The one function that a kernel without a port calls, of those that have one; else kNobody.
    uint32_t only_callee(uint32_t s, const std::unordered_multimap<uint32_t, uint32_t>& ported) const {
        const UnitFeatures& kernel = source_[s];
        uint32_t only = kNobody;
        if (!kernel.kernel || kernel.acts || choice_[s] != kNobody) return kNobody;
        for (const uint32_t name : kernel.callees) {
            const auto [first, last] = ported.equal_range(name);
            for (auto callee = first; callee != last; ++callee) {
                const bool known = std::next(first) == last || source_[callee->second].file == kernel.file;
                if (!known || callee->second == s) continue;
                if (only != kNobody) return kNobody;
                only = callee->second;
            }
        }
        return only;
    }

    /// Kernels that are left stand in a function that ports what launches them.
    void add_inlined() {
        std::vector<uint32_t> ports(source_.size(), kNoUnit);
        for (const Assignment& pair : settled_)
            if (ports[pair.source] == kNoUnit) ports[pair.source] = pair.target;
        for (const InlinedKernel& kernel : find_inlined_kernels(source_, target_, ports, claimed_)) {
            Assignment pair;
            pair.source = kernel.source;
            pair.target = kernel.target;
            pair.shared = true;
            pair.confidence = kernel.confidence;
            settled_.push_back(pair);
        }
    }

    /// Variants of one unit, or of one name, share a counterpart; what else resembles one that is taken is a sibling of
    /// its owner. `unit` and `owner` are of one side.
    bool may_share(const UnitFeatures& unit, const UnitFeatures& other, const UnitFeatures& owner,
                   const Candidate& candidate) const {
        constexpr float kOperands = 0.75f, kAlike = 0.4f;
        const Resemblance& resemblance = candidate.resemblance;
        const auto within = [](const std::vector<uint32_t>& few, const std::vector<uint32_t>& many) {
            return std::includes(many.begin(), many.end(), few.begin(), few.end());
        };
        const bool one_subject = unit.core == owner.core || resemblance.core >= 1;
        const bool more_of_it = within(other.core_words, unit.core_words) && body_likeness(resemblance) >= kAlike;
        if (!one_subject && !more_of_it) return false;
        if (unit.entry && unit.called_as != other.called_as) return false;
        const bool its_kernel = unit.kernel && owner.launcher && resemblance.core >= 1;
        if (owner.folded_name == other.folded_name && !its_kernel && !within(other.all_words, unit.all_words))
            return false;
        if (is_reference_of(unit, other) || resemblance.kind <= 0) return false;
        return !is_overloaded(unit, other) || resemblance.operands >= kOperands;
    }

    const std::vector<UnitFeatures>& source_;
    const std::vector<UnitFeatures>& target_;
    const TermNumbers& terms_;
    std::vector<std::vector<Candidate>> candidates_;
    std::vector<bool> fixed_;  ///< sources that a person has paired
    std::vector<std::vector<float>> scores_;
    std::vector<std::vector<float>> alike_;  ///< the scores before names are weighed
    std::unordered_map<std::string, int> source_names_, target_names_, target_cores_;
    std::unordered_set<uint32_t> own_;                      ///< the names that the target's functions are called by
    std::vector<bool> launches_;                            ///< of each target
    std::vector<bool> has_home_;                            ///< of each source, see read_homes()
    std::vector<bool> leads_on_;                            ///< of each source: it calls what launches
    std::vector<bool> delegates_;                           ///< of each target: it calls what works, or launches
    std::vector<std::set<uint32_t>> calls_into_;            ///< of each target, files whose launchers it calls
    std::vector<uint32_t> choice_;                          ///< of each source, an index into its candidates
    std::vector<uint32_t> claimed_;                         ///< of each target, the source
    std::vector<std::vector<NameDifference>> differences_;  ///< of the names, as scores_
    std::vector<Assignment> settled_;
};

}  // namespace

std::vector<Assignment> assign(const std::vector<UnitFeatures>& source, const std::vector<UnitFeatures>& target,
                               const TermNumbers& terms, const std::vector<FixedPair>& fixed,
                               std::vector<std::vector<Candidate>> candidates) {
    return Assigner(source, target, terms, fixed, std::move(candidates)).run();
}

}  // namespace porttool
