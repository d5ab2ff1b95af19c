// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/left_over.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "porttool/match/inlined_kernels.h"
#include "porttool/match/unit_roles.h"
#include "porttool/match/words.h"

namespace porttool {
namespace {

/// The best of several, and how good the next one is.
struct BestOf {
    uint32_t unit = kNoUnit;
    float most = 0, next = 0;

    void add(uint32_t candidate, float amount) {
        if (amount > most) {
            next = most;
            most = amount;
            unit = candidate;
        } else {
            next = std::max(next, amount);
        }
    }

    bool is_clear() const { return unit != kNoUnit && most >= 2 * next; }
};

/// A number that says something: three digits that count.
bool is_telling_number(std::string_view text) {
    constexpr std::ptrdiff_t kDigits = 3;
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    const size_t first = text.find_first_of("123456789");
    if (first == std::string_view::npos || text.front() == '"') return false;
    const std::string_view rest = text.substr(first, text.find_last_of("123456789") + 1 - first);
    return std::count_if(rest.begin(), rest.end(), is_digit) >= kDigits;
}

class LeftOverFinder {
public:
    LeftOverFinder(const std::vector<UnitFeatures>& source, const std::vector<UnitFeatures>& target,
                   const TermNumbers& terms, const std::vector<std::vector<Candidate>>& candidates,
                   const std::vector<uint32_t>& ports, const std::vector<uint32_t>& owners)
        : source_(source), target_(target), terms_(terms), candidates_(candidates), ports_(ports), owners_(owners) {}

    std::vector<UnitPair> run() {
        find_twins();
        find_families();
        find_parts();
        return std::move(found_);
    }

private:
    static bool is_worker(const UnitFeatures& unit) { return unit.group == Group::Code && unit.works; }

    bool is_open_source(uint32_t s) const { return ports_[s] == kNoUnit && is_worker(source_[s]); }

    void find_twins() {
        std::vector<BestOf> best(source_.size());
        std::unordered_map<uint32_t, BestOf> best_there;
        for (uint32_t s = 0; s < source_.size(); ++s) {
            if (!is_open_source(s)) continue;
            for (const Candidate& candidate : candidates_[s])
                best[s].add(candidate.target, plain_likeness(source_[s], target_[candidate.target]));
            const uint32_t t = best[s].unit;
            if (best[s].is_clear() && owners_[t] == kNoUnit && is_worker(target_[t])) best_there.try_emplace(t);
        }
        if (best_there.empty()) return;
        for (uint32_t s = 0; s < source_.size(); ++s)
            for (const Candidate& candidate : candidates_[s])
                if (const auto found = best_there.find(candidate.target); found != best_there.end())
                    found->second.add(s, plain_likeness(source_[s], target_[candidate.target]));
        for (const auto& [t, back] : best_there) {
            if (!back.is_clear() || !is_open_source(back.unit) || best[back.unit].unit != t) continue;
            const auto& list = candidates_[back.unit];
            const auto pair = std::find_if(list.begin(), list.end(),
                                           [&](const Candidate& candidate) { return candidate.target == t; });
            if (is_twin(*pair, back.most)) add(back.unit, t, kByBody + kPerShare * back.most);
        }
    }

    bool is_twin(const Candidate& candidate, float alike) const {
        constexpr float kAlike = 0.3f, kAlikeInKernels = 0.15f, kSure = 0.5f, kCalledAlike = 0.5f, kWords = 0.6f;
        const UnitFeatures &a = source_[candidate.source], &b = target_[candidate.target];
        const bool words = candidate.resemblance.core >= kWords;
        if (candidate.resemblance.reversed || candidate.resemblance.kind <= 0) return false;
        if (a.holds_kernel != b.holds_kernel && (a.kernel || b.kernel)) return words && alike >= kAlikeInKernels;
        if (UnitRoles::other_role(a, b) || alike < kAlike) return false;
        return words || alike >= kSure || candidate.resemblance.families[Family::kCalls] >= kCalledAlike ||
               share_numbers(a, b);
    }

    /// Three telling numbers, and hardly another.
    bool share_numbers(const UnitFeatures& a, const UnitFeatures& b) const {
        constexpr size_t kLeast = 3;
        const auto numbers = [&](const UnitFeatures& unit) {
            std::vector<uint32_t> out;
            for (const Term& term : unit.bags[kLiterals])
                if (is_telling_number(terms_.text(term.id))) out.push_back(term.id);
            return out;
        };
        const std::vector<uint32_t> left = numbers(a), right = numbers(b);
        const auto shared = static_cast<size_t>(std::count_if(
            left.begin(), left.end(), [&](uint32_t id) { return std::binary_search(right.begin(), right.end(), id); }));
        return shared >= kLeast && 4 * shared >= 3 * std::max(left.size(), right.size());
    }

    /// Sources of one file by the function that holds them.
    void find_families() {
        constexpr size_t kLeast = 3;
        std::map<std::pair<uint32_t, uint32_t>, std::vector<uint32_t>> families;
        for (uint32_t s = 0; s < source_.size(); ++s) {
            if (!is_open_source(s) || taken_.contains(s) || is_reference(source_[s])) continue;
            const uint32_t t = holder_of(s);
            if (t != kNoUnit) families[{source_[s].file, t}].push_back(s);
        }
        for (auto& [place, family] : families) {
            const auto [file, t] = place;
            const uint32_t owner = owners_[t];
            const bool owned = owner != kNoUnit;
            if (owned && (source_[owner].file != file || holder_of(owner) != t)) continue;
            std::vector<uint32_t> all = family;
            if (owned) all.push_back(owner);
            if (all.size() < kLeast || !are_named_in(all, t)) continue;
            for (const uint32_t s : family) add(s, t, kHeld);
        }
    }

    /// Kernels that are one step each of what the other side does in one function, which is at home where they are:
    /// `softmax_reduce_max.comp`, `softmax_div_sum.comp` and `softmax.cpp`.
    void find_parts() {
        for (uint32_t s = 0; s < source_.size(); ++s) {
            if (!source_[s].kernel || !is_open_source(s) || taken_.contains(s) || is_reference(source_[s])) continue;
            const uint32_t t = holder_at_home(s);
            if (t != kNoUnit) add(s, t, kHeld);
        }
    }

    /// Of the functions at home with a source the one that holds a part of it, and more than that and what it ports.
    uint32_t holder_at_home(uint32_t s) const {
        constexpr float kLeast = 0.2f;
        BestOf best;
        for (const Candidate& candidate : candidates_[s]) {
            const uint32_t t = candidate.target;
            const uint32_t ported = owners_[t] == kNoUnit ? 0 : source_[owners_[t]].size;
            const bool room = target_[t].size >= ported + source_[s].size;
            if (room && target_[t].folded_leaf != "main" && is_at_home(s, t) && can_hold(t, s))
                best.add(t, contained_in(source_[s], target_[t]));
        }
        return best.most >= kLeast ? best.unit : kNoUnit;
    }

    /// The two's paths differ in one word and their files have another in common, `ADD-Cuda.cpp` and `ADD-Seq.cpp`, or
    /// the name of a shader's file begins with the name of the other's.
    bool is_at_home(uint32_t s, uint32_t t) const {
        const std::vector<uint32_t>&here = *source_[s].path_words, &there = *target_[t].path_words;
        const std::string_view file = terms_.text(source_[s].stem), other = terms_.text(target_[t].stem);
        if (source_[s].whole_file_main && file.size() > other.size() && file.starts_with(other)) return true;
        std::vector<uint32_t> both;
        std::set_intersection(here.begin(), here.end(), there.begin(), there.end(), std::back_inserter(both));
        if (here.size() > both.size() + 1 || there.size() > both.size() + 1) return false;
        return std::any_of(both.begin(), both.end(), [&](uint32_t word) {
            return file.find(terms_.text(word)) != file.npos && other.find(terms_.text(word)) != other.npos;
        });
    }

    /// True for a function that works, is larger than a source and has no other role.
    bool can_hold(uint32_t t, uint32_t s) const {
        const UnitFeatures& holder = target_[t];
        const bool larger = 2 * holder.size >= 3 * source_[s].size;
        const bool program = holder.folded_leaf == "main" && !holder.kernel;  // it holds a little of everything
        return larger && !program && is_worker(holder) && !UnitRoles::other_role(source_[s], holder);
    }

    /// What a project computes to compare its kernels with.
    bool is_reference(const UnitFeatures& unit) const {
        return std::any_of(unit.all_words.begin(), unit.all_words.end(),
                           [&](uint32_t word) { return marks_reference(terms_.text(word)); });
    }

    /// The one function that holds most of a source, and more than that; a part of it does where that names it.
    uint32_t holder_of(uint32_t s) const {
        constexpr float kMost = 0.45f, kNamed = 0.2f;
        BestOf best;
        for (const Candidate& candidate : candidates_[s])
            best.add(candidate.target, contained_in(source_[s], target_[candidate.target]));
        if (!best.is_clear() || best.most < kNamed) return kNoUnit;
        const bool named = has_a_word_of(target_[best.unit], source_[s].core_words);
        return can_hold(best.unit, s) && (best.most >= kMost || named) ? best.unit : kNoUnit;
    }

    /// True if one of these words stands in the holder's body.
    bool has_a_word_of(const UnitFeatures& holder, const TermIds& words) const {
        return std::any_of(words.begin(), words.end(), [&](uint32_t word) {
            return std::any_of(holder.bags[kBody].begin(), holder.bags[kBody].end(),
                               [&](const Term& term) { return terms_.text(term.id) == terms_.text(word); });
        });
    }

    /// The function's name is what theirs begin with, or most have a word in it that sets them apart.
    bool are_named_in(const std::vector<uint32_t>& family, uint32_t t) const {
        const UnitFeatures& holder = target_[t];
        std::vector<uint32_t> common = source_[family.front()].core_words.copy();
        for (const uint32_t s : family)
            std::erase_if(common, [&](uint32_t word) {
                return !std::binary_search(source_[s].core_words.begin(), source_[s].core_words.end(), word);
            });
        size_t by_word = 0;
        for (const uint32_t s : family) {
            std::vector<uint32_t> own = source_[s].core_words.copy();
            std::erase_if(own, [&](uint32_t word) { return std::binary_search(common.begin(), common.end(), word); });
            if (has_a_word_of(holder, own)) ++by_word;
        }
        const bool by_name =
            !holder.core_words.empty() &&
            std::includes(common.begin(), common.end(), holder.core_words.begin(), holder.core_words.end());
        return by_name || 3 * by_word >= 2 * family.size();
    }

    void add(uint32_t s, uint32_t t, float confidence) {
        found_.push_back({s, t, confidence});
        taken_.insert(s);
    }

    static constexpr float kByBody = 0.55f, kPerShare = 0.3f, kHeld = 0.6f;
    const std::vector<UnitFeatures>&source_, &target_;
    const TermNumbers& terms_;
    const std::vector<std::vector<Candidate>>& candidates_;
    const std::vector<uint32_t>&ports_, &owners_;
    std::unordered_set<uint32_t> taken_;
    std::vector<UnitPair> found_;
};

}  // namespace

std::vector<UnitPair> find_left_over(const std::vector<UnitFeatures>& source, const std::vector<UnitFeatures>& target,
                                     const TermNumbers& terms, const std::vector<std::vector<Candidate>>& candidates,
                                     const std::vector<uint32_t>& ports, const std::vector<uint32_t>& owners) {
    return LeftOverFinder(source, target, terms, candidates, ports, owners).run();
}

}  // namespace porttool
