// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/assign.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "porttool/match/decide.h"
#include "porttool/match/inlined_kernels.h"
#include "porttool/match/left_over.h"
#include "porttool/match/unit_forms.h"
#include "porttool/match/unit_roles.h"

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
          roles_(source, target, terms, candidates_),
          forms_(terms),
          fixed_(source.size(), false) {
        for (const UnitFeatures& unit : source_) ++source_names_[unit.folded_name];
        for (const UnitFeatures& unit : target_) ++target_names_[unit.folded_name];
        for (const UnitFeatures& unit : target_) ++target_cores_[unit.core];
        for (const auto& list : candidates_) {
            scores_.emplace_back();
            for (const Candidate& candidate : list)
                scores_.back().push_back(candidate.resemblance.score +
                                         (is_namesake(candidate) ? kNamesakeBonus : 0.0f) + role_bonus(candidate));
        }
        for (uint32_t s = 0; s < source_.size(); ++s) prefer_alike_bodies(s);
        constexpr float kScoreOfFixed = 10;  // ahead of all that is only alike
        for (const FixedPair& pair : fixed) {
            fixed_[pair.source] = true;
            for (float& score : scores_[pair.source]) score = kScoreOfFixed;
        }
    }

    std::vector<Assignment> run(bool all) {
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
        if (all) add_left_over();
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
        if (roles_.is_launched_there(candidate.source, candidate.target))
            bonus += kNoKernel;
        else if (a.launcher != b.launcher)
            bonus += a.kernel || b.kernel ? kNoKernel : UnitRoles::other_role(a, b) ? kLauncher : kSameName;
        else if ((a.works && !b.computes) || (a.kernel && a.acts && !b.acts) || (b.works && !a.computes))
            bonus += a.kernel && !b.computes ? 2 * kIdle : kIdle;
        if (roles_.prepares(a, b) || roles_.is_idle_for(candidate.source, candidate.target)) bonus += kPrepares;
        if (roles_.is_elsewhere(candidate.source, candidate.target)) bonus += kElsewhere;
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
            const TermIds& there = target_[candidates_[s][choice_[s]].target].callees;
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

    void lift(uint32_t s, const TermIds& there, std::vector<bool>& lifted) const {
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
        out.other_role =
            UnitRoles::other_role(source_[s], target_[chosen.target]) || roles_.is_launched_there(s, chosen.target);
        out.unfit = roles_.prepares(source_[s], target_[chosen.target]) || roles_.is_idle_for(s, chosen.target) ||
                    roles_.is_elsewhere(s, chosen.target);
        out.body_margin = body_margin(s, c);
        constexpr float kOperands = 0.67f;
        out.wrong_operands =
            is_overloaded(source_[s], target_[chosen.target]) && chosen.resemblance.operands < kOperands;
        out.only_one =
            source_names_.at(source_[s].folded_name) == 1 && target_names_.at(target_[chosen.target].folded_name) == 1;
        constexpr int kFew = 3;
        out.same_subject = chosen.resemblance.core >= 1 && target_cores_.at(target_[chosen.target].core) <= kFew;
        out.shared = shared;
        out.confidence =
            roles_.is_used_there(s, chosen.target) ? 0.0f : confidence(source_[s], target_[chosen.target], out);
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
            if (!forms_.may_share(source_[s], target_[candidate.target], source_[claimed_[candidate.target]],
                                  candidate))
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
        for (const Assignment& pair : settled_) origins_[target_[pair.target].file].insert(source_[pair.source].folder);
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
            const bool alone =
                !is_known_copy(s, candidates_[s][best[t].candidate]) && forms.at(form_of(t, s)) < kFamily;
            if (!alone && add_shared(s, best[t].candidate, target_[t], target_[own])) claimed_[t] = s;
        }
    }

    /// True if a target may be one more port of a source that has one.
    bool may_port_too(uint32_t s, const Candidate& candidate) const {
        const UnitFeatures &unit = target_[candidate.target], &own = target_[own_number(s)];
        if (&unit == &own || !forms_.may_share(unit, source_[s], own, candidate)) return false;
        // Branches of an `#if` on both sides are one each.
        const bool branch = unit.file == own.file && unit.folded_name == own.folded_name;
        if (branch && source_names_.at(source_[s].folded_name) > 1) return false;
        if (branch && source_[s].whole_file_main && unit.overloaded) return false;  // overloads are no copies
        return UnitForms::is_second_form(unit, own) || is_known_copy(s, candidate);
    }

    /// The port that a source has.
    uint32_t own_number(uint32_t s) const { return candidates_[s][choice_[s]].target; }

    /// A second port in a file of its own: under the name of the first, and written like the source, as that is. Not
    /// where that file ports what stands elsewhere, as the same helper of another program.
    bool is_twin_elsewhere(uint32_t s, const Candidate& candidate) const {
        constexpr float kAlike = 0.4f;
        constexpr uint32_t kLeast = 20;  // what is shorter is like much
        const UnitFeatures &source = source_[s], &unit = target_[candidate.target], &own = target_[own_number(s)];
        if (unit.folded_leaf != own.folded_leaf || candidate.resemblance.core < 1 || unit.file == own.file)
            return false;
        if (std::min({source.size, unit.size, own.size}) < kLeast) return false;
        const auto origins = origins_.find(unit.file);
        if (origins != origins_.end() && !origins->second.contains(source.folder)) return false;
        return plain_likeness(source, unit) >= kAlike && plain_likeness(source, own) >= kAlike;
    }

    bool is_known_copy(uint32_t s, const Candidate& candidate) const {
        const UnitFeatures &unit = target_[candidate.target], &own = target_[own_number(s)];
        const bool kernels = unit.kernel && own.kernel && !source_[s].kernel;
        return kernels || forms_.is_copy(unit, own) || is_twin_elsewhere(s, candidate);
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

    /// `unit` is new to the pair, `owner` of the same side has it.
    bool add_shared(uint32_t s, uint32_t c, const UnitFeatures& unit, const UnitFeatures& owner) {
        Assignment pair = describe(s, c, true);
        pair.confidence = std::max(pair.confidence, forms_.as_variant(unit, owner));
        if (pair.confidence < kLeastConfidence) return false;
        settled_.push_back(pair);
        return true;
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

    /// The target of each source that has one.
    std::vector<uint32_t> ports() const {
        std::vector<uint32_t> out(source_.size(), kNoUnit);
        for (const Assignment& pair : settled_)
            if (out[pair.source] == kNoUnit) out[pair.source] = pair.target;
        return out;
    }

    /// Kernels that are left stand in a function that ports what launches them.
    void add_inlined() {
        for (const InlinedKernel& kernel : find_inlined_kernels(source_, target_, ports(), claimed_))
            add_by_body({kernel.source, kernel.target, kernel.confidence});
    }

    void add_left_over() {
        std::vector<uint32_t> owners = claimed_;
        for (const Assignment& pair : settled_)
            if (owners[pair.target] == kNoUnit) owners[pair.target] = pair.source;
        for (const UnitPair& pair : find_left_over(source_, target_, terms_, candidates_, ports(), owners))
            add_by_body(pair);
    }

    void add_by_body(const UnitPair& found) {
        Assignment pair;
        pair.source = found.source;
        pair.target = found.target;
        pair.shared = true;
        pair.confidence = found.confidence;
        settled_.push_back(pair);
    }

    const std::vector<UnitFeatures>& source_;
    const std::vector<UnitFeatures>& target_;
    const TermNumbers& terms_;
    std::vector<std::vector<Candidate>> candidates_;
    UnitRoles roles_;
    UnitForms forms_;
    std::vector<bool> fixed_;  ///< sources that a person has paired
    std::vector<std::vector<float>> scores_;
    std::vector<std::vector<float>> alike_;  ///< the scores before names are weighed
    std::unordered_map<std::string, int> source_names_, target_names_, target_cores_;
    std::vector<uint32_t> choice_;                          ///< of each source, an index into its candidates
    std::vector<uint32_t> claimed_;                         ///< of each target, the source
    std::vector<std::vector<NameDifference>> differences_;  ///< of the names, as scores_
    std::unordered_map<uint32_t, std::unordered_set<uint32_t>> origins_;  ///< by target file, folders of its sources
    std::vector<Assignment> settled_;
};

}  // namespace

std::vector<Assignment> assign(const std::vector<UnitFeatures>& source, const std::vector<UnitFeatures>& target,
                               const TermNumbers& terms, const std::vector<FixedPair>& fixed,
                               std::vector<std::vector<Candidate>> candidates, bool all) {
    return Assigner(source, target, terms, fixed, std::move(candidates)).run(all);
}

}  // namespace porttool
