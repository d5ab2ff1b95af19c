// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/compare/compare_pair.h"
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

    std::vector<uint32_t> by_name;  ///< the places of the units, sorted by their names

    const UnitFacts* find(std::string_view name) const;
};

BlobFacts blob_facts(const ScannedFile& file);

/// What the edits of the two sides of a pair are worth, to tell whether the port followed.
struct EditFacts {
    bool in_step = false;
    double similarity = 0;                      ///< of the tokens that changed, 0 to 1; 0 where one side changed none
    uint32_t source_size = 0, target_size = 0;  ///< lines gained and lost, one statement a line
    CompareSize size;                           ///< of the texts that were compared
    bool refused = false;                       ///< the budget left them uncompared, and they count as out of step
};

/// Judges a pair as compare_pair() does, and measures its edits; what `check` weakens is not weakened here. The texts
/// before are needed of both sides.
EditFacts edit_facts(const BySide<PairedUnit>& pair, const Dialect& dialect, CompareBudget& budget);

/// One line of text for a cache, and back; nothing if the text has not that form.
std::string facts_line(const BlobFacts& facts);
std::optional<BlobFacts> read_blob_facts(const std::string& line);
std::string facts_line(const EditFacts& facts);
std::optional<EditFacts> read_edit_facts(const std::string& line);

}  // namespace porttool
