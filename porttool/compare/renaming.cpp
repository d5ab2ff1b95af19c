// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/renaming.h"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_set>

#include "porttool/normal/diff.h"
#include "porttool/normal/locals.h"
#include "porttool/normal/statements.h"

namespace porttool {
namespace {

using Names = std::map<std::string_view, std::string_view>;

/// A function's text, the locals in it, and the words that it uses, in the common vocabulary.
struct Function {
    Function(const Words& text, const Dialect& dialect) : words(text), locals(local_numbers(text)) {
        for (size_t i = 0; i < words.size(); ++i)
            if (!is_member(i)) used.insert(common_word(words[i], dialect));
    }

    bool is_member(size_t i) const { return i > 0 && (words[i - 1] == "." || words[i - 1] == "->"); }

    /// The names that stand for a local wherever they stand, in order of appearance, without those that `other` uses.
    Words own_names(const Function& other, const Dialect& dialect) const {
        Words names;
        std::set<std::string_view> seen;
        for (size_t i = 0; i < locals.size(); ++i) {
            if (is_member(i)) continue;
            if (locals[i] == 0)
                seen.insert(words[i]);
            else if (seen.insert(words[i]).second && !other.used.contains(common_word(words[i], dialect)))
                names.push_back(words[i]);
        }
        // A name that elsewhere in the text is a global's keeps its spelling.
        std::set<std::string_view> unbound;
        for (size_t i = 0; i < locals.size(); ++i)
            if (locals[i] == 0 && !is_member(i)) unbound.insert(words[i]);
        std::erase_if(names, [&](std::string_view name) { return unbound.contains(name); });
        return names;
    }

    Words renamed(const Names& names) const {
        Words out = words;
        for (size_t i = 0; i < locals.size(); ++i)
            if (const auto found = names.find(words[i]); locals[i] > 0 && found != names.end()) out[i] = found->second;
        return out;
    }

    const Words& words;
    std::vector<size_t> locals;
    std::set<std::string> used;
};

/// The text with all of `names` made one word, so that two texts can be laid side by side without them.
Words blanked(const Words& words, const Words& names) {
    const std::unordered_set<std::string_view> blank(names.begin(), names.end());
    Words out = words;
    for (std::string_view& word : out)
        if (blank.contains(word)) word = "%";
    return out;
}

/// Which of `fresh` stands where one of `gone` stood, the most frequent first; each name once.
Names pair_names(const Words& before, const Words& gone, const Words& now, const Words& fresh, const Dialect& dialect) {
    const Words left = blanked(before, gone), right = blanked(now, fresh);
    std::map<std::pair<std::string_view, std::string_view>, size_t> votes;
    for (const DiffStep& step : diff(left, right))
        if (step.kind == DiffStep::Keep && left[step.before] == "%") ++votes[{now[step.now], before[step.before]}];
    std::vector<std::pair<size_t, std::pair<std::string_view, std::string_view>>> ranked;
    for (const auto& [names, count] : votes) ranked.emplace_back(count, names);
    std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    Names out;
    std::set<std::string> taken;
    for (const auto& [count, names] : ranked) {
        const auto& [from, to] = names;
        if (from == "%" || to == "%" || out.contains(from)) continue;
        if (taken.insert(common_word(to, dialect)).second) out[from] = to;
    }
    return out;
}

}  // namespace

Words with_old_names(const Words& before, const Words& now, const Dialect& dialect) {
    const Function old_text(before, dialect), new_text(now, dialect);
    const Words gone = old_text.own_names(new_text, dialect), fresh = new_text.own_names(old_text, dialect);
    if (gone.empty() || fresh.empty()) return now;
    return new_text.renamed(pair_names(before, gone, now, fresh, dialect));
}

Words with_new_names_of_source(const Words& source_before, const Words& source_now, const Words& target_before,
                               const Words& target_now, const Dialect& dialect) {
    const Function source(source_now, dialect), target(target_now, dialect);
    Words there = source.own_names(Function(source_before, dialect), dialect);
    Words here = target.own_names(Function(target_before, dialect), dialect);
    const auto has_its_like = [&](const Function& other) {
        return [&](std::string_view name) { return other.used.contains(common_word(name, dialect)); };
    };
    std::erase_if(there, has_its_like(target));
    std::erase_if(here, has_its_like(source));
    Names names;
    std::set<std::string> taken;
    for (size_t i = 0; i < std::min(here.size(), there.size()); ++i)
        if (taken.insert(common_word(there[i], dialect)).second) names[here[i]] = there[i];
    return target.renamed(names);
}

}  // namespace porttool
