// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What a commit did to the units of a file, statement by statement.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/language/dialect.h"
#include "porttool/normal/normal_text.h"
#include "porttool/scan/unit.h"

namespace porttool {

/// A statement as its side wrote it: words with \x1f between them; "" for none.
using WrittenStatement = std::string;
std::vector<std::string> words_of_statement(const WrittenStatement& statement);

/// True for `for (int i = 0; i < n; ++i)` with another name for `i`, as words.
bool renames_what_it_declares(const std::vector<std::string>& before, const std::vector<std::string>& now);

/// What an edit did in one place of a unit: a statement came, went, or became another one.
struct EditedPlace {
    WrittenStatement before, now;
    bool idle = false;  ///< no value changed: another spelling, or other names of locals
};

struct UnitEdit {
    std::string before_name, now_name;
    std::vector<EditedPlace> places;

    bool counts() const {
        return std::any_of(places.begin(), places.end(), [](const EditedPlace& place) { return !place.idle; });
    }
};

/// A unit that only one of two versions of a file has.
struct LoneVersion {
    std::string name;
    UnitKind kind = UnitKind::Function;
    NormalText text;
    std::vector<uint64_t> words;  ///< of the text, as numbers, in their order: to be held against many others
};

/// The share of their words that two versions have in common, 0 to 1; 0 for those too short to tell.
float text_likeness(const LoneVersion& a, const LoneVersion& b);

struct FileEdit {
    std::vector<UnitEdit> edits;
    std::vector<LoneVersion> came, went;
};

/// The statements of a unit's text, in order, without closing braces.
std::vector<WrittenStatement> written_statements(const Words& text);

/// Holds two versions of a file against each other. Either may be nothing.
FileEdit file_edit(const ScannedFile* before, const ScannedFile* now, const Dialect& dialect);

/// The edit that made one text of the other.
UnitEdit unit_edit(const NormalText& before, const NormalText& now, UnitKind kind, Language language,
                   const Dialect& dialect);

}  // namespace porttool
