// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/places.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "porttool/scan/side.h"

namespace porttool {
namespace {

/// The folders that units lie in, as numbers: a path is read once, not anew for each folder that it leads through.
class FolderNumbers {
public:
    /// Those that hold a unit, from the outermost on: of `a/` and `a/b/` for `a/b/c.cu:f`.
    std::vector<uint32_t> of(std::string_view id) {
        const std::string_view path = id.substr(0, id.find(':'));
        std::vector<uint32_t> out;
        uint32_t above = 0;
        for (size_t first = 0, slash; (slash = path.find('/', first)) != std::string_view::npos; first = slash + 1) {
            const auto next = static_cast<uint32_t>(numbers_.size() + 1);
            above = numbers_.try_emplace({above, path.substr(first, slash - first)}, next).first->second;
            out.push_back(above);
        }
        return out;
    }

private:
    using Folder = std::pair<uint32_t, std::string_view>;  ///< the one that it lies in, and its name
    struct Hash {
        size_t operator()(const Folder& folder) const {
            return std::hash<std::string_view>()(folder.second) + 0x9E3779B97F4A7C15ull * folder.first;
        }
    };
    std::unordered_map<Folder, uint32_t, Hash> numbers_;
};

/// How many pairs folders of one depth have with each other.
class Ties {
public:
    void add(uint32_t source, uint32_t target) {
        ++count_.source[source].with[target];
        ++count_.target[target].with[source];
    }

    /// Once all are added.
    void find_most() {
        for (const Side side : kBothSides)
            for (auto& [here, partners] : count_[side]) partners.find_most();
    }

    /// True if both have their pairs with others.
    bool parted(uint32_t source, uint32_t target) const {
        constexpr size_t kLeast = 4, kTimes = 4;
        const auto of_source = count_.source.find(source), of_target = count_.target.find(target);
        if (of_source == count_.source.end() || of_target == count_.target.end()) return false;
        const size_t elsewhere =
            std::min(of_source->second.most_apart_from(target), of_target->second.most_apart_from(source));
        if (elsewhere < kLeast) return false;
        const auto found = of_source->second.with.find(target);
        return found == of_source->second.with.end() || kTimes * found->second <= elsewhere;
    }

private:
    /// The folders of the other side that one has pairs with; asked for each pair, so the two that matter are kept.
    struct Partners {
        std::unordered_map<uint32_t, size_t> with;
        uint32_t first = 0;  ///< that it has most with
        size_t most = 0, next = 0;

        void find_most() {
            for (const auto& [there, count] : with) {
                if (count <= most) {
                    next = std::max(next, count);
                    continue;
                }
                next = std::exchange(most, count);
                first = there;
            }
        }
        size_t most_apart_from(uint32_t there) const { return there == first ? next : most; }
    };
    BySide<std::unordered_map<uint32_t, Partners>> count_;
};

}  // namespace

void doubt_other_places(std::vector<MatchedPair>& pairs) {
    constexpr float kSure = 0.9f, kMost = 0.85f;
    std::unordered_map<std::string_view, size_t> sources_of;
    for (const MatchedPair& pair : pairs) ++sources_of[pair.target];
    BySide<FolderNumbers> numbers;
    std::vector<std::vector<uint32_t>> source, target;
    Ties ties;
    for (const MatchedPair& pair : pairs) {
        source.push_back(numbers.source.of(pair.source));
        target.push_back(numbers.target.of(pair.target));
        const size_t depths = std::min(source.back().size(), target.back().size());
        if (pair.score < kSure || sources_of[pair.target] > 1) continue;
        for (size_t depth = 0; depth < depths; ++depth) ties.add(source.back()[depth], target.back()[depth]);
    }
    ties.find_most();
    const auto parted = [&](size_t i) {
        const size_t depths = std::min(source[i].size(), target[i].size());
        for (size_t depth = 0; depth < depths; ++depth)
            if (ties.parted(source[i][depth], target[i][depth])) return true;
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
