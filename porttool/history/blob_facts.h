// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/language/dialect.h"
#include "porttool/normal/unit_state.h"

namespace porttool {

/// What history keeps of a unit.
struct UnitFacts {
    std::string name;
    UnitKind kind = UnitKind::Function;
    uint32_t lines = 0;  ///< of code
    Fingerprints prints;
};

/// What history keeps of one version of a file: its units in order of appearance, then the file as a whole, `@file`.
struct BlobFacts {
    uint32_t lines = 0;  ///< of code
    std::vector<UnitFacts> units;

    const UnitFacts* find(std::string_view name) const;
};

BlobFacts blob_facts(const ScannedFile& file);

/// What the edits of the two sides of a pair are worth, to tell whether the port followed.
struct EditFacts {
    bool equivalent = false;
    double similarity = 0;                      ///< of the tokens that changed, 0 to 1; 0 where one side changed none
    uint32_t source_size = 0, target_size = 0;  ///< lines gained and lost, one statement a line
};

/// Compares texts as portmap.base/ keeps them. `by_value`: for constants and structs, whose values count.
enum class ByValue : uint8_t { No, Constant, Struct };
struct EditTexts {
    std::string source_before, source_now, target_before, target_now;
};
EditFacts edit_facts(const EditTexts& texts, ByValue by_value, const Dialect& dialect);

/// One line of text for a cache, and back; nothing if the text has not that form.
std::string facts_line(const BlobFacts& facts);
std::optional<BlobFacts> read_blob_facts(const std::string& line);
std::string facts_line(const EditFacts& facts);
std::optional<EditFacts> read_edit_facts(const std::string& line);

}  // namespace porttool
