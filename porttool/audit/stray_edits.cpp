// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/stray_edits.h"

#include <algorithm>
#include <functional>
#include <map>
#include <unordered_map>
#include <unordered_set>

#include "porttool/audit/aside.h"
#include "porttool/audit/essence.h"
#include "porttool/audit/same_value.h"
#include "porttool/language/words.h"
#include "porttool/normal/statements.h"

namespace porttool {
namespace {

constexpr float kTelling = 0.8f;  ///< strength of a place, before what its words matter there

/// What a statement says, as a number: equal for equal essences.
using Saying = size_t;

/// A statement of today.
struct Place {
    const UnitLineage* unit = nullptr;
    const std::string* id = nullptr;
    size_t index = 0;
};

class StrayReader {
public:
    StrayReader(const Snapshot& snapshot, const Lineages& lineages, const BySide<UsesOnSide>& uses,
                const std::set<std::pair<std::string, std::string>>& paired, const Dialect& dialect)
        : lineages_(lineages), uses_(uses), paired_(paired), dialect_(dialect) {
        for (const Side side : kBothSides)
            for (const auto& [id, unit] : snapshot.states[side])
                if (const auto known = lineages.find(id); known != lineages.end()) add(side, id, known->second);
    }

    std::vector<StrayEdit> run() {
        std::vector<StrayEdit> out;
        for (const Side side : kBothSides)
            for (const std::string* id : units_[side]) read_unit(side, *id, out);
        return out;
    }

private:
    std::vector<std::string> essence(const WrittenStatement& statement) const {
        std::vector<std::string> words;
        for (const std::string& word : words_of_statement(statement))
            if (std::string common = common_word(word, dialect_); !common.empty()) words.push_back(std::move(common));
        return essence_of(words, dialect_);
    }

    static Saying saying(const std::vector<std::string>& words) {
        std::string text;
        for (const std::string& word : words)
            if (word != "(" && word != ")") (text += word) += ' ';
        return std::hash<std::string>()(text);
    }

    void add(Side side, const std::string& id, const UnitLineage& unit) {
        std::vector<Saying>& said = said_[side][id];
        for (size_t i = 0; i < unit.today().size(); ++i) {
            said.push_back(saying(essence(unit.today()[i])));
            index_[side][said.back()].push_back({&unit, &id, i});
        }
        units_[side].push_back(&id);
    }

    void read_unit(Side side, const std::string& id, std::vector<StrayEdit>& out) const {
        std::map<std::pair<std::string, uint32_t>, StrayEdit> found;  // by the other unit and the commit
        const UnitLineage& unit = lineages_.at(id);
        for (const StatementLineage& line : unit.statements())
            if (line.index > 0) read_line(side, id, unit, line, found);
        for (auto& [key, edit] : found) out.push_back(std::move(edit));
    }

    void read_line(Side side, const std::string& id, const UnitLineage& unit, const StatementLineage& line,
                   std::map<std::pair<std::string, uint32_t>, StrayEdit>& found) const {
        const WrittenStatement& now = unit.today()[line.index];
        const std::vector<Saying>& own = said_[side].at(id);
        if (index_[other(side)].contains(own[line.index]) || speaks_to_people(now)) return;
        for (const LineageStep& step : line.steps) {
            if (step.before.empty() || !step.counts) continue;
            const std::vector<std::string> before = essence(step.before);
            const Saying was = saying(before);
            const auto there = index_[other(side)].find(was);
            if (there == index_[other(side)].end() || !is_rare(before, there->second)) continue;
            if (index_[side].contains(was)) return;  // it stands on this side, too: that is its counterpart
            for (const Place& place : there->second) {
                const std::string& source = side == Side::Source ? id : *place.id;
                const std::string& target = side == Side::Source ? *place.id : id;
                if (source == target || paired_.contains({source, target}) || !has_neighbour(side, own, line, place))
                    continue;
                note(side, unit, line, step, before, place, {source, target}, found);
            }
            return;
        }
    }

    void note(Side side, const UnitLineage& unit, const StatementLineage& line, const LineageStep& step,
              const std::vector<std::string>& before, const Place& there, const BySide<std::string>& id,
              std::map<std::pair<std::string, uint32_t>, StrayEdit>& found) const {
        WordsOfSide words;
        for (const WrittenStatement& one : there.unit->today())
            for (std::string& word : essence(one)) words.insert(std::move(word));
        const std::set<std::string> none;
        const KnownThere known{&words, &words, &uses_[other(side)], &uses_[side], &none, &none, nullptr};
        const std::vector<std::string> now = essence(unit.today()[line.index]);
        if (give_the_same_value(before, now, has_real_number(words_of_statement(unit.today()[line.index])))) return;
        const float substance = substance_of(before, now, known);
        constexpr float kSlight = 0.3f;
        if (substance < kSlight) return;
        MissingPlace place;
        place.before = step.before;
        place.now = unit.today()[line.index];
        place.there = there.unit->today()[there.index];
        place.strength = kTelling * substance;
        StrayEdit& edit = found[{*there.id, step.commit}];
        edit.id = id;
        edit.edit.side = side;
        edit.edit.commit = step.commit;
        edit.edit.both = there.unit->edited_in(step.commit);
        edit.edit.since = there.unit->edited_since(step.commit);
        edit.edit.size = unit.places_edited(step.commit);
        edit.alike = shared(side, id);
        edit.edit.places.push_back(std::move(place));
    }

    /// True for words that stand in so few places that this is no chance.
    static bool is_rare(const std::vector<std::string>& words, const std::vector<Place>& there) {
        constexpr size_t kMostPlaces = 2, kFewestNames = 4;
        if (there.size() > kMostPlaces) return false;
        const std::set<std::string> different(words.begin(), words.end());
        return static_cast<size_t>(std::count_if(different.begin(), different.end(), [](const std::string& word) {
                   return is_word_token(word) || is_number_token(word);
               })) >= kFewestNames;
    }

    static bool speaks_to_people(const WrittenStatement& statement) {
        const std::vector<std::string> words = words_of_statement(statement);
        return is_aside(words) || is_bare_declaration(words);
    }

    /// True if a statement beside the edited one stands beside the one there.
    bool has_neighbour(Side side, const std::vector<Saying>& own, const StatementLineage& line,
                       const Place& there) const {
        constexpr size_t kNear = 2, kNearThere = 3;
        const std::vector<Saying>& said = said_[other(side)].at(*there.id);
        const size_t first = there.index - std::min(there.index, kNearThere);
        const size_t end = std::min(said.size(), there.index + kNearThere + 1);
        for (size_t i = line.index - std::min(line.index, kNear); i < std::min(own.size(), line.index + kNear + 1); ++i)
            if (i != line.index && i > 0 &&
                std::find(said.begin() + static_cast<ptrdiff_t>(first), said.begin() + static_cast<ptrdiff_t>(end),
                          own[i]) != said.begin() + static_cast<ptrdiff_t>(end))
                return true;
        return false;
    }

    float shared(Side side, const BySide<std::string>& id) const {
        const std::vector<Saying>&here = said_[side].at(id[side]), &there = said_[other(side)].at(id[other(side)]);
        const std::unordered_set<Saying> left(here.begin(), here.end());
        const std::unordered_set<Saying> right(there.begin(), there.end());
        const auto common = std::count_if(left.begin(), left.end(), [&](Saying one) { return right.contains(one); });
        return static_cast<float>(common) /
               static_cast<float>(std::max<size_t>(1, std::min(left.size(), right.size())));
    }

    const Lineages& lineages_;
    const BySide<UsesOnSide>& uses_;
    const std::set<std::pair<std::string, std::string>>& paired_;
    const Dialect& dialect_;
    BySide<std::vector<const std::string*>> units_;
    BySide<std::unordered_map<std::string, std::vector<Saying>>> said_;  ///< by unit
    BySide<std::unordered_map<Saying, std::vector<Place>>> index_;
};

}  // namespace

std::vector<StrayEdit> stray_edits(const Snapshot& snapshot, const Lineages& lineages, const BySide<UsesOnSide>& uses,
                                   const std::set<std::pair<std::string, std::string>>& paired,
                                   const Dialect& dialect) {
    return StrayReader(snapshot, lineages, uses, paired, dialect).run();
}

}  // namespace porttool
