// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/assign.h"

#include <algorithm>
#include <unordered_map>

namespace porttool {
namespace {

constexpr uint32_t kNobody = 0xFFFFFFFFu;

struct Choice {
    float score;
    uint32_t source;
    uint32_t candidate;  ///< index into the source's list
};

class Assigner {
public:
    Assigner(const std::vector<UnitFeatures>& source, const std::vector<UnitFeatures>& target, const TermNumbers& terms,
             std::vector<std::vector<Candidate>> candidates)
        : source_(source), target_(target), terms_(terms), candidates_(std::move(candidates)) {
        for (const UnitFeatures& unit : source_) ++source_names_[unit.folded_name];
        for (const UnitFeatures& unit : target_) ++target_names_[unit.folded_name];
        for (const auto& list : candidates_) {
            scores_.emplace_back();
            for (const Candidate& candidate : list)
                scores_.back().push_back(candidate.resemblance.score +
                                         (is_namesake(candidate) ? kNamesakeBonus : 0.0f));
        }
    }

    std::vector<Assignment> run() {
        choose();
        add_affinity();
        alike_ = scores_;
        constexpr int kRounds = 2;  // a third changes next to nothing
        for (int round = 0; round < kRounds; ++round) {
            weigh_names(learn_names());
            choose();
        }
        return describe();
    }

private:
    static constexpr float kNamesakeBonus = 0.08f;

    /// One name that stands once on either side.
    bool is_namesake(const Candidate& candidate) const {
        const std::string& name = source_[candidate.source].folded_name;
        return name == target_[candidate.target].folded_name && source_names_.at(name) == 1 &&
               target_names_.at(name) == 1;
    }

    void choose() {
        std::vector<Choice> choices;
        for (uint32_t s = 0; s < candidates_.size(); ++s)
            for (uint32_t c = 0; c < candidates_[s].size(); ++c) choices.push_back({scores_[s][c], s, c});
        std::sort(choices.begin(), choices.end(), [&](const Choice& a, const Choice& b) {
            if (a.score != b.score) return a.score > b.score;
            if (a.source != b.source) return a.source < b.source;
            return a.candidate < b.candidate;
        });
        choice_.assign(source_.size(), kNobody);
        claimed_.assign(target_.size(), kNobody);
        for (const Choice& choice : choices) {
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
        return scores_[s][choice_[s]] >= kScore && margin(s) >= kMargin;
    }

    /// How far a source's choice is ahead of its best score elsewhere. Other variants of the chosen name are no rivals.
    float margin(uint32_t s) const {
        const uint32_t chosen = choice_[s];
        const std::string& name = target_[candidates_[s][chosen].target].folded_name;
        float rival = 0;
        for (uint32_t c = 0; c < candidates_[s].size(); ++c)
            if (c != chosen && target_[candidates_[s][c].target].folded_name != name)
                rival = std::max(rival, scores_[s][c]);
        return scores_[s][chosen] - rival;
    }

    std::vector<Assignment> describe() const {
        const NameEvidence names = learn_names();
        std::vector<Assignment> all;
        for (uint32_t s = 0; s < source_.size(); ++s) {
            if (choice_[s] == kNobody) continue;
            const Candidate& chosen = candidates_[s][choice_[s]];
            Assignment out;
            out.source = s;
            out.target = chosen.target;
            out.resemblance = chosen.resemblance;
            out.score = scores_[s][choice_[s]];
            out.margin = margin(s);
            out.names = names.difference(source_[s], target_[chosen.target]);
            out.only_one = source_names_.at(source_[s].folded_name) == 1 &&
                           target_names_.at(target_[chosen.target].folded_name) == 1;
            all.push_back(out);
        }
        return all;
    }

    const std::vector<UnitFeatures>& source_;
    const std::vector<UnitFeatures>& target_;
    const TermNumbers& terms_;
    std::vector<std::vector<Candidate>> candidates_;
    std::vector<std::vector<float>> scores_;
    std::vector<std::vector<float>> alike_;  ///< the scores before names are weighed
    std::unordered_map<std::string, int> source_names_, target_names_;
    std::vector<uint32_t> choice_;   ///< of each source, an index into its candidates
    std::vector<uint32_t> claimed_;  ///< of each target, the source
};

}  // namespace

std::vector<Assignment> assign(const std::vector<UnitFeatures>& source, const std::vector<UnitFeatures>& target,
                               const TermNumbers& terms, std::vector<std::vector<Candidate>> candidates) {
    return Assigner(source, target, terms, std::move(candidates)).run();
}

}  // namespace porttool
