// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/places.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>

#include "porttool/scan/side.h"

namespace porttool {
namespace {

/// The folders that hold a unit, from the outermost on: `a/`, `a/b/` of `a/b/c.cu:f`.
std::vector<std::string_view> folders_of(std::string_view id) {
    const std::string_view path = id.substr(0, id.find(':'));
    std::vector<std::string_view> out;
    for (size_t slash = path.find('/'); slash != std::string_view::npos; slash = path.find('/', slash + 1))
        out.push_back(path.substr(0, slash + 1));
    return out;
}

/// How many pairs folders of one depth have with each other.
class Ties {
public:
    void add(std::string_view source, std::string_view target) {
        ++count_.source[source][target];
        ++count_.target[target][source];
    }

    /// True if both have their pairs with others.
    bool parted(std::string_view source, std::string_view target) const {
        constexpr size_t kLeast = 4, kTimes = 4;
        const auto most_of = [](const Counts& counts, std::string_view here, std::string_view apart_from) {
            size_t most = 0;
            if (const auto found = counts.find(here); found != counts.end())
                for (const auto& [there, count] : found->second)
                    if (there != apart_from) most = std::max(most, count);
            return most;
        };
        const size_t elsewhere =
            std::min(most_of(count_.source, source, target), most_of(count_.target, target, source));
        if (elsewhere < kLeast) return false;
        const auto& of_source = count_.source.at(source);
        const auto found = of_source.find(target);
        return found == of_source.end() || kTimes * found->second <= elsewhere;
    }

private:
    using Counts = std::unordered_map<std::string_view, std::unordered_map<std::string_view, size_t>>;
    BySide<Counts> count_;
};

}  // namespace

void doubt_other_places(std::vector<MatchedPair>& pairs) {
    constexpr float kSure = 0.9f, kMost = 0.85f;
    std::unordered_map<std::string_view, size_t> sources_of;
    for (const MatchedPair& pair : pairs) ++sources_of[pair.target];
    std::vector<std::vector<std::string_view>> source, target;
    std::vector<Ties> ties;
    for (const MatchedPair& pair : pairs) {
        source.push_back(folders_of(pair.source));
        target.push_back(folders_of(pair.target));
        const size_t depths = std::min(source.back().size(), target.back().size());
        if (pair.score < kSure || sources_of[pair.target] > 1) continue;
        ties.resize(std::max(ties.size(), depths));
        for (size_t depth = 0; depth < depths; ++depth) ties[depth].add(source.back()[depth], target.back()[depth]);
    }
    const auto parted = [&](size_t i) {
        const size_t depths = std::min({source[i].size(), target[i].size(), ties.size()});
        for (size_t depth = 0; depth < depths; ++depth)
            if (ties[depth].parted(source[i][depth], target[i][depth])) return true;
        return false;
    };
    std::vector<MatchedPair> kept;
    std::vector<bool> doubted(pairs.size());
    std::unordered_map<std::string_view, size_t> at_home;
    for (size_t i = 0; i < pairs.size(); ++i) {
        doubted[i] = pairs[i].state == PairState::Suggested && parted(i);
        if (!doubted[i]) ++at_home[pairs[i].target];
    }
    for (size_t i = 0; i < pairs.size(); ++i) {
        if (doubted[i] && at_home.contains(pairs[i].target)) continue;
        kept.push_back(pairs[i]);
        if (doubted[i]) kept.back().score = std::min(kept.back().score, kMost);
    }
    pairs = std::move(kept);
}

}  // namespace porttool
