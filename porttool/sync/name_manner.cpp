// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/name_manner.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "porttool/text/letters.h"
#include "porttool/text/name_words.h"

namespace porttool {
namespace {

/// `sheenWeight`, `SheenWeight`, `sheen_weight`, `SHEEN_WEIGHT`. One word in small letters may be the first or the
/// third.
enum class Manner : char { Camel = 'c', Pascal = 'p', Snake = 's', Capitals = 'C', Small = 'w', Other = '?' };

std::string written_as(const std::vector<std::string>& parts, Manner manner) {
    std::string out;
    for (size_t i = 0; i < parts.size(); ++i) {
        if (i > 0 && (manner == Manner::Snake || manner == Manner::Capitals)) out += '_';
        for (size_t k = 0; k < parts[i].size(); ++k) {
            const bool head = k == 0 && (manner == Manner::Pascal || (manner == Manner::Camel && i > 0));
            out += head || manner == Manner::Capitals ? capital_letter(parts[i][k]) : parts[i][k];
        }
    }
    return out;
}

Manner manner_of(const std::string& name) {
    const std::vector<std::string> parts = words_of_name(name);
    if (parts.size() == 1 && written_as(parts, Manner::Snake) == name) return Manner::Small;
    for (const Manner manner : {Manner::Pascal, Manner::Camel, Manner::Snake, Manner::Capitals})
        if (written_as(parts, manner) == name) return manner;
    return Manner::Other;
}

/// What comes before the words of a name there, or goes, and how it is written.
struct NameRule {
    std::vector<std::string> lost, gained;
    Manner manner = Manner::Other;
    bool operator<(const NameRule& other) const {
        return std::tie(lost, gained, manner) < std::tie(other.lost, other.gained, other.manner);
    }
};

/// True if both end with the same words, of which there are some; then the rule is filled in.
bool read_rule(const std::string& source, const std::string& target, NameRule& rule) {
    const std::vector<std::string> here = words_of_name(source), there = words_of_name(target);
    size_t same = 0;
    while (same < std::min(here.size(), there.size()) && here[here.size() - 1 - same] == there[there.size() - 1 - same])
        ++same;
    if (same == 0) return false;
    rule.lost.assign(here.begin(), here.end() - static_cast<std::ptrdiff_t>(same));
    rule.gained.assign(there.begin(), there.end() - static_cast<std::ptrdiff_t>(same));
    rule.manner = manner_of(target);
    return true;
}

std::string by_rule(const std::string& name, const NameRule& rule, Manner manner) {
    std::vector<std::string> parts = words_of_name(name);
    if (parts.size() <= rule.lost.size() || !std::equal(rule.lost.begin(), rule.lost.end(), parts.begin())) return name;
    parts.erase(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(rule.lost.size()));
    parts.insert(parts.begin(), rule.gained.begin(), rule.gained.end());
    return written_as(parts, manner);
}

}  // namespace

std::string name_in_manner(const std::string& name, const std::vector<std::pair<std::string, std::string>>& examples) {
    size_t same = 0;
    std::map<NameRule, size_t> rules;
    std::map<Manner, size_t> manners;
    for (const auto& [source, target] : examples) {
        same += source == target;
        NameRule rule;
        if (!read_rule(source, target, rule)) continue;
        if (rule.manner != Manner::Small) ++manners[rule.manner];
        ++rules[rule];
    }
    if (rules.empty() || 2 * same >= examples.size() || name.front() == '_') return name;
    const auto most =
        std::max_element(rules.begin(), rules.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    Manner manner = most->first.manner;
    // One word tells nothing of how two are written.
    if (manner == Manner::Small && !manners.empty())
        manner = std::max_element(manners.begin(), manners.end(), [](const auto& a, const auto& b) {
                     return a.second < b.second;
                 })->first;
    if (manner == Manner::Small) manner = manner_of(name) == Manner::Camel ? Manner::Camel : Manner::Snake;
    return manner == Manner::Other ? name : by_rule(name, most->first, manner);
}

}  // namespace porttool
