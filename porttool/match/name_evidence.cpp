// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/name_evidence.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "porttool/match/words.h"

namespace porttool {
namespace {

using WordList = std::vector<uint32_t>;  ///< sorted

uint64_t mix(uint32_t word) {
    uint64_t hash = (word + 1) * 0x9E3779B97F4A7C15ull;
    hash = (hash ^ hash >> 29) * 0xBF58476D1CE4E5B9ull;
    return hash ^ hash >> 32;
}

/// A hash of a name's words whatever their order, from which a word can be taken by subtraction.
template <class Words>
uint64_t sum(const Words& words) {
    uint64_t total = 0;
    for (const uint32_t word : words) total += mix(word);
    return total;
}

/// The words of `from` that the other unit's name lacks; one that the other file is named after is not missing, nor
/// one that is spelled together there (`soft_max`, `softmax`).
WordList missing(const UnitFeatures& from, const UnitFeatures& in, const TermNumbers& terms) {
    constexpr size_t kLongEnough = 4;
    WordList words;
    std::set_difference(from.all_words.begin(), from.all_words.end(), in.all_words.begin(), in.all_words.end(),
                        std::back_inserter(words));
    std::erase_if(words, [&](uint32_t word) {
        if (std::binary_search(in.path_words->begin(), in.path_words->end(), word)) return true;
        const std::string_view text = terms.text(word);
        return text.size() >= kLongEnough && in.folded_name.find(text) != std::string::npos;
    });
    words.erase(std::unique(words.begin(), words.end()), words.end());
    return words;
}

/// How often the certain pairs keep the words of one side's names on the other side.
class Keeping {
public:
    Keeping(const std::vector<UnitFeatures>& own_side, const std::vector<UnitFeatures>& other_side) {
        for (const UnitFeatures& unit : own_side)
            for (const uint32_t word : unit.all_words) uses_[word].own += 1;
        for (const UnitFeatures& unit : other_side)
            for (const uint32_t word : unit.all_words) uses_[word].other += 1;
    }

    void learn(WordList words, const WordList& lost) {
        words.erase(std::unique(words.begin(), words.end()), words.end());
        for (const uint32_t word : words) pairs_of_[word].push_back(static_cast<uint32_t>(pairs_.size()));
        pairs_.push_back({std::move(words), lost});
    }

    /// How likely a port would have kept any of these words. Without examples a word is expected to stay if the other
    /// side uses it as often, unless the same words go in pair after pair (`habit`, in [0, 1]).
    float kept(const WordList& words, float habit) const {
        if (words.empty()) return 0;
        const auto [found, is_new] = counted_.try_emplace(sum(words));
        if (is_new) found->second = count(words);
        const Count& count = found->second;
        float expected = 0;
        for (const uint32_t word : words) expected = std::max(expected, expected_to_stay(word));
        return (count.kept + expected * (1 - habit)) / (count.all + 1);
    }

private:
    /// A word that one side has throughout, such as its prefix, cannot have been kept more often than the other side
    /// has it.
    float expected_to_stay(uint32_t word) const {
        constexpr float kKnown = 0.6f, kUnknown = 0.15f, kThroughout = 8;
        const auto found = uses_.find(word);
        if (found == uses_.end()) return kUnknown;
        const Uses& uses = found->second;
        if (uses.other > 0) return kKnown * std::min(1.0f, (uses.other + 1) / (uses.own + 1));
        return kUnknown * std::min(1.0f, kThroughout / uses.own);
    }

    /// How many names of either side have a word.
    struct Uses {
        float own = 0, other = 0;
    };

    struct Example {
        WordList words, lost;
    };

    struct Count {
        float all = 0, kept = 0;
    };

    Count count(const WordList& words) const {
        const auto rarest = std::min_element(words.begin(), words.end(), [&](uint32_t a, uint32_t b) {
            return examples(a).size() < examples(b).size();
        });
        Count count;
        for (const uint32_t index : examples(*rarest)) {
            const Example& pair = pairs_[index];
            if (!std::includes(pair.words.begin(), pair.words.end(), words.begin(), words.end())) continue;
            count.all += 1;
            if (!std::includes(pair.lost.begin(), pair.lost.end(), words.begin(), words.end())) count.kept += 1;
        }
        return count;
    }

    const WordList& examples(uint32_t word) const {
        static const WordList kNone;
        const auto found = pairs_of_.find(word);
        return found == pairs_of_.end() ? kNone : found->second;
    }

    std::unordered_map<uint32_t, Uses> uses_;
    std::unordered_map<uint32_t, WordList> pairs_of_;
    std::vector<Example> pairs_;
    mutable std::unordered_map<uint64_t, Count> counted_;  ///< by the words' sum, as asked for
};

/// WordList that mark variants which one side alone has.
class Variants {
public:
    Variants(const std::vector<UnitFeatures>& units, const std::vector<bool>& certain) {
        std::unordered_set<uint64_t> names;
        for (size_t i = 0; i < units.size(); ++i)
            if (certain[i]) names.insert(sum(units[i].all_words));
        for (size_t i = 0; i < units.size(); ++i) {
            if (certain[i]) continue;
            const uint64_t name = sum(units[i].all_words);
            for (const uint32_t word : units[i].all_words)
                if (names.contains(name - mix(word))) counts_[word].left_out += 1;
        }
    }

    void learn(const WordList& added) {
        for (const uint32_t word : added) counts_[word].added += 1;
    }

    /// How often a name without the word was taken where one with it stood beside it; the most of the words.
    float left_out(const WordList& words) const {
        float most = 0;
        for (const uint32_t word : words) {
            const auto found = counts_.find(word);
            if (found == counts_.end()) continue;
            const Count& count = found->second;
            most = std::max(most, count.left_out / (count.left_out + count.added + 1));
        }
        return most;
    }

private:
    struct Count {
        float left_out = 0, added = 0;
    };
    std::unordered_map<uint32_t, Count> counts_;
};

/// What two names differ in, as one number.
uint64_t key_of(const WordList& lost, const WordList& gained) { return sum(lost) * 31 + sum(gained); }

/// Each of the two names speaks of types, and none of them is the same.
bool speak_of_other_types(const UnitFeatures& a, const UnitFeatures& b) {
    return !a.name_types.empty() && !b.name_types.empty() &&
           std::find_first_of(a.name_types.begin(), a.name_types.end(), b.name_types.begin(), b.name_types.end()) ==
               a.name_types.end();
}

NameDifference mixed(const NameDifference& a, const NameDifference& b, float share) {
    const auto mix_of = [share](float one, float other) { return share * one + (1 - share) * other; };
    return {mix_of(a.lost, b.lost), mix_of(a.gained, b.gained), mix_of(a.lost_variant, b.lost_variant),
            mix_of(a.gained_variant, b.gained_variant)};
}

std::vector<bool> certain_ones(size_t count, const std::vector<LearnedPair>& pairs, uint32_t LearnedPair::*side) {
    std::vector<bool> certain(count, false);
    for (const LearnedPair& pair : pairs)
        if (pair.certain) certain[pair.*side] = true;
    return certain;
}

}  // namespace

struct NameEvidence::Learned {
    const TermNumbers& terms;
    Keeping there, back;
    Variants source_variants, target_variants;
    std::unordered_map<uint64_t, int> differences;  ///< how many pairs differ in the same words

    float habit(uint64_t key) const {
        constexpr float kSeveral = 4;
        const auto found = differences.find(key);
        return found == differences.end() ? 0 : std::min(1.0f, static_cast<float>(found->second - 1) / kSeveral);
    }
};

NameEvidence::NameEvidence(const std::vector<UnitFeatures>& source, const std::vector<UnitFeatures>& target,
                           const TermNumbers& terms, const std::vector<LearnedPair>& pairs) {
    auto learned =
        std::make_unique<Learned>(Learned{terms,
                                          Keeping(source, target),
                                          Keeping(target, source),
                                          Variants(source, certain_ones(source.size(), pairs, &LearnedPair::source)),
                                          Variants(target, certain_ones(target.size(), pairs, &LearnedPair::target)),
                                          {}});
    for (const LearnedPair& pair : pairs) {
        const UnitFeatures &from = source[pair.source], &to = target[pair.target];
        const WordList lost = missing(from, to, terms), gained = missing(to, from, terms);
        const bool related = lost.size() < from.all_words.size();
        if (!pair.certain) continue;
        if (related) ++learned->differences[key_of(lost, gained)];
        learned->there.learn(from.all_words.copy(), lost);
        learned->back.learn(to.all_words.copy(), gained);
        learned->source_variants.learn(lost);
        learned->target_variants.learn(gained);
    }
    learned_ = std::move(learned);
}

NameEvidence::~NameEvidence() = default;

NameDifference NameEvidence::weigh(const WordList& lost, const WordList& gained) const {
    const float habit = learned_->habit(key_of(lost, gained));
    NameDifference out;
    out.lost = learned_->there.kept(lost, habit);
    out.gained = learned_->back.kept(gained, habit) * (1 - habit);
    out.lost_variant = learned_->source_variants.left_out(lost);
    out.gained_variant = learned_->target_variants.left_out(gained);
    return out;
}

NameDifference NameEvidence::difference(const UnitFeatures& from, const UnitFeatures& to) const {
    WordList lost = missing(from, to, learned_->terms), gained = missing(to, from, learned_->terms);
    const NameDifference all = weigh(lost, gained);
    if (from.core != to.core || speak_of_other_types(from, to)) return all;
    const auto how = [&](uint32_t word) {
        const std::string_view text = learned_->terms.text(word);
        return text.size() == 1 || tells_how(text);
    };
    if (std::erase_if(lost, how) + std::erase_if(gained, how) == 0) return all;
    constexpr float kHow = 0.25f;
    return mixed(all, weigh(lost, gained), kHow);
}

float doubt(const NameDifference& difference) {
    return 2.1f * difference.lost + 0.6f * difference.gained + 2.0f * difference.lost_variant +
           3.9f * difference.gained_variant;
}

}  // namespace porttool
