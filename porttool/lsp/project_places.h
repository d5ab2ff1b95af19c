// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "porttool/judge/check_project.h"
#include "porttool/lsp/positions.h"

namespace porttool::lsp {

/// A unit of a side in the file that holds it.
struct PlacedUnit {
    Side side = Side::Source;
    std::string path;  ///< of the file, absolute
    const ScannedFile* file = nullptr;
    const Unit* unit = nullptr;  ///< nullptr for the file as a whole
    std::string id() const;
};

/// Where the units of a project stand, by the paths of their files. The project outlives it.
class ProjectPlaces {
public:
    explicit ProjectPlaces(const CheckedProject& project);

    /// The units of a file that hold a line (from 1), the innermost first, and last the file itself. A file of both
    /// sides gives those of both.
    std::vector<PlacedUnit> at(const std::string& path, uint32_t line) const;

    /// Where a place of a finding, or a unit, is shown: the name of its unit, or, where that has none, its first line.
    Range range_of(const std::string& path, const std::string& id, uint32_t line) const;

    /// The pairs with that unit on its side.
    std::vector<const JudgedPair*> pairs_of(const PlacedUnit& unit) const;

    /// The absolute path of a file of a side, as its units name it.
    std::string path_of(Side side, const std::string& file) const;

private:
    struct PlacedFile {
        Side side;
        const ScannedFile* file;
    };
    /// What is asked of a file once for each finding there.
    struct KnownFile {
        std::unordered_map<std::string, const Token*> names;  ///< of units, by their ids
        Utf16Counts counts;
    };
    const KnownFile& known(const ScannedFile& file) const;

    const CheckedProject& project_;
    std::unordered_map<std::string, std::vector<PlacedFile>> files_;   ///< by absolute path
    mutable std::unordered_map<const ScannedFile*, KnownFile> known_;  ///< those that were asked about
};

/// True where a position stands in the head of a unit, before its body, or there on no name of the code.
bool is_about_unit(const PlacedUnit& unit, Position at);

}  // namespace porttool::lsp
