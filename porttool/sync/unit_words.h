// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "porttool/compare/call_forms.h"
#include "porttool/normal/normal_text.h"
#include "porttool/scan/unit.h"

namespace porttool {

/// A unit's words in normal form, without its prelude, each with the token of the file that it was made from.
struct UnitWords {
    static constexpr uint32_t kNoToken = 0xFFFFFFFFu;

    std::vector<std::string> words;
    /// kNoToken for a brace that the normal form adds, and for what in_forms_of() makes. Empty where the text was
    /// recorded and its file is not known.
    std::vector<uint32_t> tokens;

    size_t size() const { return words.size(); }
    bool is_added(size_t i) const { return !tokens.empty() && tokens[i] == kNoToken; }
};

/// True for a kernel, and for a function that is marked as the device's.
bool runs_on_device(const ScannedFile& file, const Unit& unit);

UnitWords words_of_unit(const ScannedFile& file, const Unit& unit);
UnitWords words_of_record(const NormalText& text);

/// Adds what a language has as functions of vectors, and a library of C++ as methods, where the port has no function of
/// its own for that: `length ( z )`.
void add_functions_of_vectors(Language language, CalledForms& forms);

/// The words with calls in the forms that the other side has for them: `length ( z )` for `z . Length ( )`, and the
/// other way round.
UnitWords in_forms_of(const CalledForms& there, UnitWords words);

/// The words of a unit that an empty line stands before.
std::set<size_t> paragraphs_of(const ScannedFile& file, const UnitWords& words);
/// The line of a word, or of the first after it that has one; 0 for none.
uint32_t line_at(const ScannedFile& file, const UnitWords& words, size_t word);

}  // namespace porttool
