// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/name_cores.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "porttool/match/words.h"

namespace porttool {
namespace {

using NameWords = std::vector<uint32_t>;  ///< in the order of the name

bool is_digits(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// What one side's names have in common.
class SideWords {
public:
    explicit SideWords(const std::vector<UnitFeatures>& units) {
        for (const UnitFeatures& unit : units) {
            if (unit.group != Group::Code) continue;
            ++names_;
            NameWords words = unit.ordered_words.copy();
            std::sort(words.begin(), words.end());
            words.erase(std::unique(words.begin(), words.end()), words.end());
            for (const uint32_t word : words) ++counts_[word];
        }
    }

    float count(uint32_t word) const {
        const auto found = counts_.find(word);
        return found == counts_.end() ? 0 : static_cast<float>(found->second);
    }

    /// In more than a fifth of the names.
    bool is_everywhere(uint32_t word) const {
        constexpr float kShare = 0.2f;
        constexpr size_t kFewest = 20;
        return names_ >= kFewest && share(word) > kShare;
    }

    /// Next to nowhere.
    bool is_rare(uint32_t word) const { return share(word) < 0.02f; }

private:
    float share(uint32_t word) const { return names_ == 0 ? 0 : count(word) / static_cast<float>(names_); }

    std::unordered_map<uint32_t, uint32_t> counts_;
    size_t names_ = 0;
};

/// Words such as a project's prefix tell nothing apart. One that the other side has in some of its names does.
bool tells_nothing(uint32_t word, const SideWords& own, const SideWords& other) {
    return own.is_everywhere(word) && (other.is_everywhere(word) || other.is_rare(word));
}

/// The words of a name that tell what it is about; all of them if none is left.
NameWords without_how(const UnitFeatures& unit, const SideWords& side, const SideWords& other,
                      const TermNumbers& terms) {
    const TermIds& all = unit.ordered_words;
    NameWords core;
    bool type_before = false;
    for (size_t i = 0; i < all.size(); ++i) {
        const std::string_view text = terms.text(all[i]);
        const bool how = tells_how(text);
        const bool width = type_before && is_digits(text);  // f32_4
        const bool letter = text.size() == 1 && text[0] >= 'a' && text[0] <= 'z' && (i == 0 || i + 1 == all.size());
        type_before = how;
        if (!how && !width && !letter && !tells_nothing(all[i], side, other)) core.push_back(all[i]);
    }
    return core.empty() ? all.copy() : core;
}

std::string joined(const NameWords& words, const TermNumbers& terms) {
    std::string text;
    for (const uint32_t word : words) text += terms.text(word);
    return text;
}

std::string joined_without(const NameWords& words, uint32_t left_out, const TermNumbers& terms) {
    std::string text;
    for (const uint32_t word : words)
        if (word != left_out) text += terms.text(word);
    return text;
}

/// NameWords that `own` has before or after names that the other side has without them.
std::unordered_set<uint32_t> words_of_one_side(const std::vector<NameWords>& own, const SideWords& own_words,
                                               const SideWords& other_words,
                                               const std::unordered_set<std::string>& other_names,
                                               const TermNumbers& terms) {
    struct Count {
        float names = 0, found = 0;
    };
    constexpr float kFewest = 4, kMostThere = 0.2f, kShare = 0.3f;
    std::unordered_map<uint32_t, Count> counts;
    for (const NameWords& words : own) {
        if (words.size() < 2) continue;
        for (const uint32_t word : words) {
            if (own_words.count(word) < kFewest || other_words.count(word) > kMostThere * own_words.count(word))
                continue;
            Count& count = counts[word];
            count.names += 1;
            if (other_names.contains(joined_without(words, word, terms))) count.found += 1;
        }
    }
    std::unordered_set<uint32_t> out;
    for (const auto& [word, count] : counts)
        if (count.names >= kFewest && count.found >= kShare * count.names) out.insert(word);
    return out;
}

constexpr size_t kShortestHead = 2, kLongestHead = 3;

/// How many names begin with the same words, and how many of these the other side has without them.
struct Head {
    float names = 0, found = 0;
};

using Heads = std::unordered_map<std::string, Head>;

/// The first words of a name, and what follows them.
std::string head_of(const NameWords& name, size_t length, const TermNumbers& terms) {
    std::string text;
    for (size_t i = 0; i < length; ++i) (text += terms.text(name[i])) += ' ';
    return text;
}

NameWords without_head(const NameWords& name, size_t length) {
    return {name.begin() + static_cast<std::ptrdiff_t>(length), name.end()};
}

/// A member's first words are its class, which is no head.
bool may_have_head(const UnitFeatures& unit) {
    return unit.group == Group::Code && unit.folded_name == unit.folded_leaf;
}

Heads count_heads(const std::vector<NameWords>& own, const std::vector<UnitFeatures>& units,
                  const std::unordered_set<std::string>& other_names, const TermNumbers& terms) {
    Heads heads;
    for (size_t i = 0; i < own.size(); ++i) {
        if (!may_have_head(units[i])) continue;
        for (size_t length = kShortestHead; length <= kLongestHead && length < own[i].size(); ++length) {
            Head& head = heads[head_of(own[i], length, terms)];
            head.names += 1;
            if (other_names.contains(joined(without_head(own[i], length), terms))) head.found += 1;
        }
    }
    return heads;
}

/// Leaves out the several words that one side has in front of names which the other side has without them
/// (`api_forward_roll` where there is `roll`): no one of the words alone stands before a name.
void leave_heads_out(std::vector<NameWords>& names, const std::vector<UnitFeatures>& units, const Heads& own,
                     const Heads& other, const TermNumbers& terms) {
    constexpr float kFewest = 4, kMostThere = 0.2f, kShare = 0.3f;
    const auto of_one_side = [&](const std::string& text) {
        const Head& head = own.at(text);
        const auto there = other.find(text);
        const float others = there == other.end() ? 0 : there->second.names;
        return head.names >= kFewest && head.found >= kShare * head.names && others <= kMostThere * head.names;
    };
    for (size_t i = 0; i < names.size(); ++i) {
        if (!may_have_head(units[i])) continue;
        for (size_t length = kLongestHead; length >= kShortestHead; --length)
            if (length < names[i].size() && of_one_side(head_of(names[i], length, terms))) {
                names[i] = without_head(names[i], length);
                break;
            }
    }
}

void leave_out(std::vector<NameWords>& names, const std::unordered_set<uint32_t>& words) {
    if (words.empty()) return;
    for (NameWords& name : names) {
        NameWords kept;
        for (const uint32_t word : name)
            if (!words.contains(word)) kept.push_back(word);
        if (!kept.empty()) name = std::move(kept);
    }
}

/// The names of a side's functions.
std::unordered_set<std::string> texts_of(const std::vector<NameWords>& names, const std::vector<UnitFeatures>& units,
                                         const TermNumbers& terms) {
    std::unordered_set<std::string> out;
    for (size_t i = 0; i < names.size(); ++i)
        if (units[i].group == Group::Code && units[i].lifecycle == Lifecycle::Neither)
            out.insert(joined(names[i], terms));
    return out;
}

/// Leaves words that tell nothing apart out of UnitFeatures::name_words, unless there are no others.
void drop_common_words(std::vector<UnitFeatures>& units, const SideWords& own, const SideWords& other) {
    for (UnitFeatures& unit : units) {
        NameWords kept;
        for (const uint32_t word : unit.name_words)
            if (!tells_nothing(word, own, other)) kept.push_back(word);
        if (!kept.empty()) unit.name_words = kept;
    }
}

void store(const std::vector<NameWords>& names, const TermNumbers& terms, std::vector<UnitFeatures>& units) {
    for (size_t i = 0; i < units.size(); ++i) {
        units[i].core = joined(names[i], terms);
        units[i].core_words = names[i];
        for (const uint32_t word : units[i].ordered_words)
            if (const auto type = type_of_word(terms.text(word)); !type.empty()) units[i].name_types.emplace_back(type);
        std::sort(units[i].core_words.begin(), units[i].core_words.end());
    }
}

}  // namespace

void read_cores(std::vector<UnitFeatures>& source, std::vector<UnitFeatures>& target, const TermNumbers& terms) {
    const SideWords source_words(source), target_words(target);
    std::vector<NameWords> left, right;
    for (const UnitFeatures& unit : source) left.push_back(without_how(unit, source_words, target_words, terms));
    for (const UnitFeatures& unit : target) right.push_back(without_how(unit, target_words, source_words, terms));
    // Both at once: what is left out of one side's names is no reason to leave a word out of the other's.
    const auto of_left = words_of_one_side(left, source_words, target_words, texts_of(right, target, terms), terms);
    const auto of_right = words_of_one_side(right, target_words, source_words, texts_of(left, source, terms), terms);
    leave_out(left, of_left);
    leave_out(right, of_right);
    const Heads left_heads = count_heads(left, source, texts_of(right, target, terms), terms);
    const Heads right_heads = count_heads(right, target, texts_of(left, source, terms), terms);
    leave_heads_out(left, source, left_heads, right_heads, terms);
    leave_heads_out(right, target, right_heads, left_heads, terms);
    store(left, terms, source);
    store(right, terms, target);
    drop_common_words(source, source_words, target_words);
    drop_common_words(target, target_words, source_words);
}

}  // namespace porttool
