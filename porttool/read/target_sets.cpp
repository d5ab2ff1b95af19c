// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/target_sets.h"

#include <algorithm>

namespace porttool {
namespace {

constexpr const char* kField = "targets";  ///< of a line of the baseline: the sets, apart by commas; none: all

std::vector<std::string> sets_of_line(const std::string& text) {
    std::vector<std::string> out;
    for (size_t first = 0; first <= text.size();) {
        const size_t comma = std::min(text.find(',', first), text.size());
        out.push_back(text.substr(first, comma - first));
        first = comma + 1;
    }
    return out;
}

void note_sets(LockedUnit& line, const std::vector<std::string>& missing, const std::vector<std::string>& all) {
    line.more.erase(kField);
    if (missing.size() == all.size()) return;
    std::string text;
    for (const std::string& set : missing) text += (text.empty() ? "" : ",") + set;
    line.more[kField] = text;
}

}  // namespace

TargetSets::TargetSets(const MapFile& map) {
    for (const TargetSet& set : map.target_sets) {
        names_.push_back(set.name);
        sets_.emplace_back(set.name, std::vector<Glob>(set.globs.begin(), set.globs.end()));
    }
    if (names_.empty()) names_.emplace_back();
}

const std::string& TargetSets::of_path(const std::string& path) const {
    const auto [known, fresh] = known_.try_emplace(path);
    if (!fresh) return known->second;
    for (const auto& [name, globs] : sets_)
        if (std::any_of(globs.begin(), globs.end(), [&](const Glob& glob) { return glob.matches(path); })) {
            known->second = name;
            break;
        }
    return known->second;
}

const std::string& TargetSets::of_id(const std::string& id) const {
    if (sets_.empty()) return names_.front();
    return of_path(id.substr(0, id.find(':')));
}

bool lacks(const LockedUnit& line, const std::string& set) {
    const auto field = line.more.find(kField);
    if (field == line.more.end() || set.empty()) return true;
    const std::vector<std::string> sets = sets_of_line(field->second);
    return std::find(sets.begin(), sets.end(), set) != sets.end();
}

LockedUnit baseline_line(const std::string& id, const Fingerprints& prints, Side side,
                         const std::vector<std::string>& missing, const std::vector<std::string>& all) {
    LockedUnit line{id, prints, "", side_word(side)};
    note_sets(line, missing, all);
    return line;
}

bool take_out(LockedUnit& line, const std::string& set, const std::vector<std::string>& all) {
    std::vector<std::string> left;
    for (const std::string& one : all)
        if (one != set && lacks(line, one)) left.push_back(one);
    if (left.empty()) return false;
    note_sets(line, left, all);
    return true;
}

}  // namespace porttool
