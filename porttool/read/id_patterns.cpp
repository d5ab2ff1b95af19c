// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/id_patterns.h"

#include <algorithm>

namespace porttool {
namespace {

constexpr size_t kMostTries = 50'000'000, kMostTogether = 200'000, kLongestStart = 64;

}  // namespace

IdPatterns::IdPatterns(const std::vector<std::string>& patterns) {
    size_t together = 0;
    for (size_t i = 0; i < patterns.size(); ++i) {
        globs_.emplace_back(patterns[i]);
        together += globs_.back().size();
        if (together > kMostTogether)
            throw GlobTooLarge("portmap.toml: its [[ignore]]s stand for more than " + std::to_string(kMostTogether) +
                               " patterns with their braces written out; write fewer braces");
        const std::string start = globs_.back().start().substr(0, kLongestStart);
        by_start_[start].push_back(i);
        lengths_.insert(start.size());
    }
}

std::vector<size_t> IdPatterns::matching(const std::string& id) const {
    std::vector<size_t> out;
    for (const size_t length : lengths_) {
        if (length > id.size()) break;
        const auto found = by_start_.find(id.substr(0, length));
        if (found == by_start_.end()) continue;
        for (const size_t i : found->second) {
            tried_ += globs_[i].size();
            if (tried_ > kMostTries)
                throw GlobTooLarge("portmap.toml: its [[ignore]]s have to be tried more than " +
                                   std::to_string(kMostTries) +
                                   " times; begin each with the path of its file, or write fewer");
            if (globs_[i].text() == id || globs_[i].matches(id)) out.push_back(i);
        }
    }
    std::sort(out.begin(), out.end());
    return out;
}

}  // namespace porttool
