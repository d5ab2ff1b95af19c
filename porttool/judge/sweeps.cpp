// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/sweeps.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <string_view>

#include "porttool/judge/edit_shapes.h"
#include "porttool/judge/rules.h"
#include "porttool/language/words.h"
#include "porttool/normal/normal_text.h"

namespace porttool {
namespace {

constexpr size_t kSweptUnits = 5;  // so many units are hardly edited alike by mistake
constexpr size_t kShared = 2;      // units that have a name, of those of a sweep
constexpr size_t kSameValue = 3;   // units that have a number or a sign
constexpr size_t kLeastNames = 3;  // of an edit that may be a sweep's

bool names_something(std::string_view word) {
    return is_word_token(word) && !is_type_word(word) && !word_is(word, kKeyword);
}

bool is_sign(std::string_view word) {
    static constexpr std::string_view kSigns = "+-/%<>=!|^~?";
    return word.size() == 1 && kSigns.find(word[0]) != std::string_view::npos;
}

/// The words of an edit that came or went for good, each behind `+` or `-`.
struct SweptEdit {
    Finding* finding;
    std::vector<std::string> names, values;  ///< numbers and signs of operations are values
};

SweptEdit swept_edit(Finding& finding) {
    constexpr size_t kMostLines = 2'000;
    std::set<std::string_view> came, went;
    SweptEdit out{&finding, {}, {}};
    if (finding.details.size() > kMostLines) return out;
    for (const std::string& line : finding.details) {
        if (line.size() < 2 || (line[0] != '-' && line[0] != '+')) return out;
        std::set<std::string_view>& words = line[0] == '-' ? went : came;
        std::vector<std::string_view> shown = shown_words(std::string_view(line).substr(1));
        for (size_t i = 0; i < shown.size(); ++i) {
            if (shown[i] == "-" && i + 1 < shown.size() && shown[i + 1] == ">")
                ++i;  // a member
            else
                words.insert(shown[i]);
        }
    }
    const auto add = [&](const std::set<std::string_view>& words, const std::set<std::string_view>& others, char mark) {
        for (const std::string_view word : words) {
            if (others.contains(word)) continue;
            if (names_something(word))
                out.names.push_back(mark + std::string(word));
            else if (is_number_token(word) || is_sign(word))
                out.values.push_back(mark + std::string(word));
        }
    };
    add(came, went, '+');
    add(went, came, '-');
    return out;
}

/// The edits of one rule and one port.
class Sweep {
public:
    void add(SweptEdit edit) { edits_.push_back(std::move(edit)); }

    /// Adds the groups of those that have most of their words from several units, joined by the names they share.
    void add_groups(std::vector<std::vector<Finding*>>& out) {
        keep_common();
        std::vector<size_t> group(edits_.size());
        std::iota(group.begin(), group.end(), size_t{0});
        const auto first_of = [&](size_t i) {
            while (group[i] != i) i = group[i] = group[group[i]];
            return i;
        };
        std::map<std::string_view, size_t> by_name;
        for (size_t i = 0; i < edits_.size(); ++i)
            for (const std::string& name : edits_[i].names)
                if (units_[name] >= kShared)
                    if (const auto [known, is_new] = by_name.try_emplace(name, i); !is_new)
                        group[first_of(i)] = first_of(known->second);
        std::map<size_t, std::vector<const SweptEdit*>> groups;
        for (size_t i = 0; i < edits_.size(); ++i) groups[first_of(i)].push_back(&edits_[i]);
        for (auto& [first, members] : groups) {
            if (members.size() < kSweptUnits) continue;
            std::stable_sort(members.begin(), members.end(), [](const SweptEdit* a, const SweptEdit* b) {
                return std::pair(a->finding->level, a->names.size()) > std::pair(b->finding->level, b->names.size());
            });
            std::vector<Finding*>& told = out.emplace_back();
            for (const SweptEdit* one : members) told.push_back(one->finding);
        }
    }

private:
    /// Until nothing changes: those that stay count for each other.
    void keep_common() {
        for (size_t before = edits_.size() + 1; before != edits_.size();) {
            before = edits_.size();
            units_.clear();
            for (const SweptEdit& edit : edits_)
                for (const auto* words : {&edit.names, &edit.values})
                    for (const std::string& word : *words) ++units_[word];
            std::erase_if(edits_, [&](const SweptEdit& edit) { return !is_common(edit); });
        }
    }

    /// What went may be the unit's own more often than what came: parameters that are handed over in another way.
    bool is_common(const SweptEdit& edit) const {
        size_t came = 0, own_came = 0, own_went = 0;
        for (const std::string& name : edit.names) {
            const bool is_own = units_.at(name) < kShared;
            if (name[0] == '-') own_went += is_own ? 1 : 0;
            if (name[0] == '+') ++(is_own ? own_came : came);
        }
        return came >= kLeastNames && 3 * own_came <= came && own_went <= came &&
               std::all_of(edit.values.begin(), edit.values.end(),
                           [&](const std::string& value) { return units_.at(value) >= kSameValue; });
    }

    std::vector<SweptEdit> edits_;
    std::map<std::string, size_t> units_;  ///< that have a word
};

}  // namespace

std::vector<std::vector<Finding*>> sweeps(const std::vector<Finding*>& edits) {
    std::map<std::string, Sweep> by_rule;
    for (Finding* finding : edits)
        if (finding->level > Level::Note)
            by_rule[std::string(rule_name(finding->rule)) + "\n" + finding->target_set].add(swept_edit(*finding));
    std::vector<std::vector<Finding*>> out;
    for (auto& [rule, sweep] : by_rule) sweep.add_groups(out);
    return out;
}

}  // namespace porttool
