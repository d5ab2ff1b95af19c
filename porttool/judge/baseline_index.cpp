// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/baseline_index.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "porttool/judge/resolve.h"
#include "porttool/read/target_sets.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

/// Lines by some key; of equal ones those with a reason are taken first.
template <class Key>
class FreeLines {
public:
    template <class KeyOf>
    FreeLines(const std::vector<const LockedUnit*>& lines, const KeyOf& key_of) {
        by_key_.reserve(lines.size());
        for (const bool with_reason : {false, true})
            for (uint32_t i = 0; i < lines.size(); ++i)
                if (lines[i]->reason.empty() != with_reason) by_key_.push_back({key_of(*lines[i]), i, 0});
        std::stable_sort(by_key_.begin(), by_key_.end(), [](const Line& a, const Line& b) { return a.key < b.key; });
        for (size_t first = 0, i = 0; i < by_key_.size(); ++i) {
            if (by_key_[i].key != by_key_[first].key) first = i;
            ++by_key_[first].left;
        }
    }

    /// The number of a line of that key, taken out.
    std::optional<uint32_t> take(const Key& key) {
        const auto first = std::lower_bound(by_key_.begin(), by_key_.end(), key,
                                            [](const Line& line, const Key& wanted) { return line.key < wanted; });
        if (first == by_key_.end() || first->key != key || first->left == 0) return std::nullopt;
        return first[--first->left].number;
    }

private:
    struct Line {
        Key key;
        uint32_t number = 0;
        uint32_t left = 0;  ///< of the first of a key: how many of it were not taken
    };
    std::vector<Line> by_key_;  ///< sorted
};

using IdAndPrint = std::pair<std::string_view, Print>;

/// With --base the base's own baseline stands beside that of the lock: what both say is one line, with its reason.
std::vector<const LockedUnit*> distinct(const std::vector<LockedUnit>& lines, std::string_view side,
                                        const std::string& set) {
    std::vector<const LockedUnit*> all, out;
    for (const LockedUnit& line : lines)
        if (line.side == side && lacks(line, set)) all.push_back(&line);
    const auto key_of = [](const LockedUnit* line) { return IdAndPrint(line->id, line->prints.written); };
    std::stable_sort(all.begin(), all.end(),
                     [&](const LockedUnit* a, const LockedUnit* b) { return key_of(a) < key_of(b); });
    for (const LockedUnit* line : all)
        if (out.empty() || key_of(out.back()) != key_of(line))
            out.push_back(line);
        else if (out.back()->reason.empty())
            out.back() = line;
    return out;
}

/// Hands out lines to the units that they excuse, key after key.
class Handout {
public:
    Handout(std::vector<const LockedUnit*> lines, std::vector<const UnitState*> units)
        : lines_(std::move(lines)), open_(std::move(units)) {}

    /// A unit whose key is none, as of a text that says too little, gets no line.
    template <class Key, class OfLine, class OfUnit, class Found>
    void match(const OfLine& of_line, const OfUnit& of_unit, Found& found) {
        if (open_.empty() || lines_.empty()) return;
        FreeLines<Key> free(lines_, of_line);
        std::vector<char> used(lines_.size());
        std::erase_if(open_, [&](const UnitState* unit) {
            const std::optional<Key> key = of_unit(*unit);
            const std::optional<uint32_t> line = key ? free.take(*key) : std::nullopt;
            if (!line) return false;
            found[unit] = lines_[*line];
            used[*line] = 1;
            return true;
        });
        erase([&](size_t i) { return used[i] != 0; });
    }

    /// Leaves lines out, by their place.
    template <class Is>
    void erase(const Is& is_left_out) {
        size_t kept = 0;
        for (size_t i = 0; i < lines_.size(); ++i)
            if (!is_left_out(i)) lines_[kept++] = lines_[i];
        lines_.resize(kept);
    }
    const LockedUnit& line(size_t i) const { return *lines_[i]; }

private:
    std::vector<const LockedUnit*> lines_;
    std::vector<const UnitState*> open_;
};

}  // namespace

BaselineIndex::BaselineIndex(const std::vector<LockedUnit>& lines, Side side, const std::string& set,
                             const std::vector<const UnitState*>& units, const UnitsById& all) {
    Handout handout(distinct(lines, side_word(side), set), units);
    using std::optional, std::string, std::string_view;
    handout.match<IdAndPrint>([](const LockedUnit& l) { return IdAndPrint(l.id, l.prints.written); },
                              [](const UnitState& u) { return optional(IdAndPrint(u.id, u.prints.written)); }, found_);
    handout.match<Print>([](const LockedUnit& l) { return l.prints.written; },
                         [](const UnitState& u) { return optional(u.prints.written); }, found_);
    handout.match<string_view>([](const LockedUnit& l) { return string_view(l.id); },
                               [](const UnitState& u) { return optional<string_view>(u.id); }, found_);
    handout.erase([&](size_t i) { return all.contains(handout.line(i).id); });  // left: what is gone
    handout.match<Print>(
        [](const LockedUnit& l) { return l.prints.renamed; },
        [](const UnitState& u) { return u.text.size() < kTokensOfOwnText ? std::nullopt : optional(u.prints.renamed); },
        found_);
    handout.match<string>(
        [](const LockedUnit& l) {
            const auto [file, name] = split_id(l.id);
            return file + ":" + string(leaf_of(name));
        },
        [](const UnitState& u) { return optional(u.file + ":" + string(leaf_of(u.name))); }, found_);
    handout.match<string>([](const LockedUnit& l) { return split_id(l.id).second; },
                          [](const UnitState& u) { return optional(u.name); }, found_);
}

const LockedUnit* BaselineIndex::find(const UnitState& unit) const {
    const auto found = found_.find(&unit);
    return found == found_.end() ? nullptr : found->second;
}

}  // namespace porttool
