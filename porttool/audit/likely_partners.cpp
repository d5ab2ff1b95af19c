// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/likely_partners.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "porttool/audit/todays_pairs.h"
#include "porttool/language/words.h"
#include "porttool/text/letters.h"

namespace porttool {
namespace {

constexpr size_t kFewestWords = 8;  ///< that a function has to share; fewer are chance
constexpr size_t kRare = 8;         ///< functions of the other side that have a word
constexpr float kShare = 0.5f;      ///< of what its rare words weigh

struct FunctionWords {
    const std::string* id = nullptr;
    const UnitState* unit = nullptr;
    std::set<std::string> words;
};

std::set<std::string> names_of(const UnitState& unit) {
    constexpr size_t kTelling = 4;  // letters
    std::set<std::string> out;
    for (const std::string_view word : unit.text.words())
        if (word.size() >= kTelling && is_word_token(word) && !word_is(word, kKeyword) && !is_type_word(word))
            out.insert(folded(word));
    return out;
}

class PartnerFinder {
public:
    explicit PartnerFinder(const States& states) {
        for (const Side side : kBothSides)
            for (const auto& [id, unit] : states[side]) {
                if (unit.kind != UnitKind::Function && unit.kind != UnitKind::Kernel) continue;
                functions_[side].push_back({&id, &unit, names_of(unit)});
                for (const std::string& word : functions_[side].back().words)
                    users_[side][word].push_back(functions_[side].size() - 1);
            }
    }

    std::vector<BySide<std::string>> run(const BySide<std::set<std::string>>& paired) const {
        std::set<std::pair<std::string, std::string>> found;
        for (const Side side : kBothSides)
            for (const FunctionWords& one : functions_[side]) {
                if (paired[side].contains(*one.id)) continue;
                const FunctionWords* partner = partner_of(one, side);
                if (partner == nullptr || one_calls_the_other(*one.unit, *partner->unit)) continue;
                const bool source = side == Side::Source;
                found.emplace(*(source ? one : *partner).id, *(source ? *partner : one).id);
            }
        std::vector<BySide<std::string>> out;
        for (const auto& [source, target] : found) out.push_back({source, target});
        return out;
    }

private:
    const FunctionWords* partner_of(const FunctionWords& one, Side side) const {
        const std::vector<FunctionWords>& others = functions_[other(side)];
        std::unordered_map<size_t, std::pair<float, size_t>> shared;  // by place: weight and number of words
        float all = 0;
        for (const std::string& word : one.words) {
            const auto known = users_[other(side)].find(word);
            if (known == users_[other(side)].end() || known->second.size() > kRare) continue;
            const float weight =
                std::log(static_cast<float>(others.size() + 1) / static_cast<float>(known->second.size()));
            all += weight;
            for (const size_t at : known->second) {
                auto& [sum, count] = shared[at];
                sum += weight;
                ++count;
            }
        }
        const FunctionWords* best = nullptr;
        float most = 0;
        for (size_t at = 0; at < others.size(); ++at) {
            const auto found = shared.find(at);
            if (found == shared.end() || found->second.first <= most || found->second.second < kFewestWords) continue;
            most = found->second.first;
            best = &others[at];
        }
        return most >= kShare * all ? best : nullptr;
    }

    BySide<std::vector<FunctionWords>> functions_;
    BySide<std::unordered_map<std::string, std::vector<size_t>>> users_;
};

}  // namespace

std::vector<BySide<std::string>> likely_partners(const States& states, const BySide<std::set<std::string>>& paired) {
    return PartnerFinder(states).run(paired);
}

}  // namespace porttool
