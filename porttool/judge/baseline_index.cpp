// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/baseline_index.h"

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "porttool/judge/resolve.h"
#include "porttool/read/target_sets.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

/// Lines that excuse no unit yet, by some key; of equal ones those with a reason come first.
class FreeLines {
public:
    using Key = std::function<std::string(const LockedUnit&)>;

    FreeLines(const std::vector<const LockedUnit*>& lines, const Key& key) {
        for (const bool with_reason : {false, true})
            for (const LockedUnit* line : lines)
                if (line->reason.empty() != with_reason) by_key_[key(*line)].push_back(line);
    }
    const LockedUnit* take(const std::string& key) {
        const auto found = by_key_.find(key);
        if (found == by_key_.end() || found->second.empty()) return nullptr;
        const LockedUnit* line = found->second.back();
        found->second.pop_back();
        return line;
    }

private:
    std::unordered_map<std::string, std::vector<const LockedUnit*>> by_key_;
};

/// With --base the base's own baseline stands beside that of the lock: what both say is one line, with its reason.
std::vector<const LockedUnit*> distinct(const std::vector<LockedUnit>& lines, std::string_view side,
                                        const std::string& set) {
    std::map<std::pair<std::string, Print>, const LockedUnit*> known;
    for (const LockedUnit& line : lines) {
        if (line.side != side || !lacks(line, set)) continue;
        const LockedUnit*& best = known[{line.id, line.prints.written}];
        if (best == nullptr || best->reason.empty()) best = &line;
    }
    std::vector<const LockedUnit*> out;
    for (const auto& [key, line] : known) out.push_back(line);
    return out;
}

}  // namespace

BaselineIndex::BaselineIndex(const std::vector<LockedUnit>& lines, Side side, const std::string& set,
                             const std::vector<const UnitState*>& units, const std::map<std::string, UnitState>& all) {
    std::vector<const LockedUnit*> free_lines = distinct(lines, side_word(side), set);
    std::vector<const UnitState*> open = units;
    const auto match = [&](const FreeLines::Key& of_line, const std::function<std::string(const UnitState&)>& of_unit) {
        if (open.empty() || free_lines.empty()) return;
        FreeLines free(free_lines, of_line);
        std::unordered_set<const LockedUnit*> used;
        std::erase_if(open, [&](const UnitState* unit) {
            const std::string key = of_unit(*unit);
            const LockedUnit* line = key.empty() ? nullptr : free.take(key);
            if (line == nullptr) return false;
            found_[unit] = line;
            used.insert(line);
            return true;
        });
        std::erase_if(free_lines, [&](const LockedUnit* line) { return used.contains(line); });
    };
    match([](const LockedUnit& l) { return l.id + " " + l.prints.written.text(); },
          [](const UnitState& u) { return u.id + " " + u.prints.written.text(); });
    match([](const LockedUnit& l) { return l.prints.written.text(); },
          [](const UnitState& u) { return u.prints.written.text(); });
    match([](const LockedUnit& l) { return l.id; }, [](const UnitState& u) { return u.id; });
    std::erase_if(free_lines, [&](const LockedUnit* line) { return all.contains(line->id); });  // left: what is gone
    match(
        [](const LockedUnit& l) { return l.prints.renamed.text(); },
        [](const UnitState& u) { return u.text.size() < kTokensOfOwnText ? std::string() : u.prints.renamed.text(); });
    match([](const LockedUnit& l) { return split_id(l.id).first + ":" + std::string(leaf_of(split_id(l.id).second)); },
          [](const UnitState& u) { return u.file + ":" + std::string(leaf_of(u.name)); });
    match([](const LockedUnit& l) { return split_id(l.id).second; }, [](const UnitState& u) { return u.name; });
}

const LockedUnit* BaselineIndex::find(const UnitState& unit) const {
    const auto found = found_.find(&unit);
    return found == found_.end() ? nullptr : found->second;
}

}  // namespace porttool
