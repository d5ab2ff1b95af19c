// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/directive_regions.h"

#include <algorithm>
#include <map>
#include <string>

#include "porttool/normal/normal_text.h"

namespace porttool {
namespace {

/// What stands behind a condition of the preprocessor, up to its `#endif`.
struct Region {
    std::vector<std::string> asks;  ///< `ifdef FAST`, and of an expression how it begins
    size_t first = 0, end = 0;      ///< words
};

std::vector<Region> regions_of(const std::vector<std::string>& words) {
    std::vector<Region> out;
    std::vector<size_t> open;
    for (size_t i = 0; i + 1 < words.size(); ++i) {
        if (words[i] != "#") continue;
        const std::string& kind = words[i + 1];
        const bool begins = kind.starts_with("if");
        if ((begins || kind.starts_with("elif")) && i + 2 < words.size()) {
            const size_t end = std::min(words.size(), i + (kind.ends_with("def") ? 3 : 5));
            if (!begins && !open.empty()) out[open.back()].end = i, open.pop_back();
            open.push_back(out.size());
            out.push_back(
                {{words.begin() + static_cast<std::ptrdiff_t>(i + 1), words.begin() + static_cast<std::ptrdiff_t>(end)},
                 i,
                 words.size()});
        }
        if (kind == "endif" && !open.empty()) out[open.back()].end = i, open.pop_back();
    }
    return out;
}

/// True if both ask the same, but for names that stand for each other wherever either is asked for.
bool ask_alike(const std::vector<Region>& here, const std::vector<Region>& there) {
    if (here.size() != there.size()) return false;
    std::map<std::string, std::string> names, back;
    for (size_t r = 0; r < here.size(); ++r) {
        const std::vector<std::string>&mine = here[r].asks, &others = there[r].asks;
        if (mine.size() != others.size() || mine.front() != others.front()) return false;
        for (size_t i = 1; i < mine.size(); ++i) {
            if (!is_word_token(mine[i]) || !is_word_token(others[i]) || mine[i] == "defined") {
                if (mine[i] != others[i]) return false;
                continue;
            }
            if (names.try_emplace(mine[i], others[i]).first->second != others[i] ||
                back.try_emplace(others[i], mine[i]).first->second != mine[i])
                return false;
        }
    }
    return true;
}

bool holds(const Region& region, const Clause& clause) {
    return clause.first >= region.first && clause.first < region.end;
}

/// True if most of what stands in a region has its counterpart in the other.
bool stands_for(const Region& here, const AlignedText& text, const Region& there, const AlignedText& target,
                const Alignment& across) {
    size_t all = 0, found = 0;
    for (size_t c = 0; c < text.clauses.size(); ++c) {
        const Clause& clause = text.clauses[c];
        if (!holds(here, clause) || clause.closes || text.words[clause.first] == "#") continue;
        ++all;
        found += across.clause_of[c] != Alignment::kNone && holds(there, target.clauses[across.clause_of[c]]);
    }
    return all > 0 && 2 * found > all;
}

/// The region that asks the same, where both sides have as many that do and as many around it; nullptr for none.
const Region* region_like(size_t r, const std::vector<Region>& here, const std::vector<Region>& there) {
    const Region& region = here[r];
    const auto asks_so = [&](const Region& one) { return one.asks == region.asks; };
    const auto around = [](const Region& inner, const std::vector<Region>& regions) {
        return std::count_if(regions.begin(), regions.end(),
                             [&](const Region& outer) { return outer.first < inner.first && inner.end <= outer.end; });
    };
    if (std::count_if(here.begin(), here.end(), asks_so) != std::count_if(there.begin(), there.end(), asks_so))
        return nullptr;
    auto other_place = there.begin();
    auto before = std::count_if(here.begin(), here.begin() + static_cast<std::ptrdiff_t>(r), asks_so);
    while (!asks_so(*other_place) || before-- > 0) ++other_place;
    const Region& other = *other_place;
    return around(region, here) == around(other, there) ? &other : nullptr;
}

}  // namespace

std::vector<bool> under_other_directives(const AlignedText& text, const AlignedText& target, const Alignment& across) {
    std::vector<bool> out(text.clauses.size(), false);
    const std::vector<Region> here = regions_of(text.words), there = regions_of(target.words);
    if (there.empty()) return out;
    const bool alike = ask_alike(here, there);
    for (size_t r = 0; r < here.size(); ++r) {
        if (alike && (here[r].asks == there[r].asks || stands_for(here[r], text, there[r], target, across))) continue;
        const Region* like = alike ? nullptr : region_like(r, here, there);
        if (like != nullptr && stands_for(here[r], text, *like, target, across)) continue;
        for (size_t c = 0; c < out.size(); ++c)
            if (holds(here[r], text.clauses[c])) out[c] = true;
    }
    return out;
}

}  // namespace porttool
