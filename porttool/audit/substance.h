// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace porttool {

/// Words as plain_word() has them.
using WordsOfSide = std::unordered_set<std::string>;

/// The same with the number of files that use each.
using UsesOnSide = std::unordered_map<std::string, uint32_t>;

/// How well a name fits into the unit that an edit may have to go to, 0 to 1. One that its side does not have may be
/// new there, as the edit is, or a manner of the side that was edited: that one is used in many files.
struct KnownThere {
    const WordsOfSide *unit, *file;
    const UsesOnSide *side, *other;           ///< of the side that the unit is on, and of the one that was edited
    const std::set<std::string>* own;         ///< parameters and locals of the unit that was edited
    const std::set<std::string>* new_locals;  ///< of these the locals whose names the other unit does not use
    const std::set<std::string>* types;       ///< names of types that both units use in what they declare; may be null

    bool is_type(const std::string& word) const { return types != nullptr && types->contains(word); }

    float degree(const std::string& word) const {
        constexpr float kInFile = 0.9f, kOnSide = 0.5f, kNew = 0.45f;
        constexpr uint32_t kFewFiles = 4, kTimes = 8;
        if (unit->contains(word)) return 1;
        if (file->contains(word)) return kInFile;
        const auto known = side->find(word), uses = other->find(word);
        const uint32_t there = known == side->end() ? 0 : known->second, here = uses == other->end() ? 0 : uses->second;
        if (here > kFewFiles && here > kTimes * there) return 0;
        return there > 0 ? kOnSide : kNew;
    }
};

/// What a statement gives: the right side of an assignment to a plain name, or what it returns; else all of it.
std::vector<std::string> value_of(const std::vector<std::string>& words);

/// What a change from one statement to another may matter there, 0 to 1: numbers, operators
/// and names that are known there count, and are held against names that nobody there knows; types, brackets, another
/// variable for the same value, and another way to it do not.
float substance_of(const std::vector<std::string>& before, const std::vector<std::string>& now,
                   const KnownThere& there);

/// True where a condition became its own opposite: what left the function, or went on, now stands in a block.
bool is_turned_round(const std::vector<std::string>& before, const std::vector<std::string>& now);

}  // namespace porttool
