// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "porttool/compare/alignment.h"
#include "porttool/sync/transplant.h"
#include "porttool/sync/unit_words.h"

namespace porttool {

/// The line that each word stands on.
std::vector<uint32_t> line_of_each(const ScannedFile& file, const UnitWords& words);

/// Where in the texts of a pair the statements stand that a sentence quotes, as `x = 1`.
struct ToldPlaces {
    std::pair<std::vector<uint32_t>, std::vector<uint32_t>> lines;  ///< of the words of now, of the target
    const AlignedText &before, &now, &target;
    const Alignment& edit;    ///< before -> now
    const Alignment& across;  ///< before -> target

    /// The line of the source, and of the target; where it quotes nothing that is found, those of the first edit.
    std::pair<uint32_t, uint32_t> of(const std::string& sentence, const Transplant& found) const;
    std::pair<uint32_t, uint32_t> first_edit(const Transplant& found) const;

private:
    size_t now_beside(size_t was) const;
    size_t target_beside(size_t was) const;
    std::optional<std::pair<uint32_t, uint32_t>> made_of(size_t is, const Transplant& found) const;
    std::pair<uint32_t, uint32_t> at_clauses(size_t now_clause, size_t target_clause) const;
    std::pair<uint32_t, uint32_t> at(size_t now_word, size_t target_word) const;
};

}  // namespace porttool
