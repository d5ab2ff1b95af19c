// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "porttool/scan/unit.h"

namespace porttool {

/// What a line of code is, seen from the port.
enum class Share : uint8_t {
    Twin,       ///< of a pair whose texts agree
    Rewritten,  ///< of a pair whose texts do not
    OneSided,   ///< meant to have no counterpart
    Unmatched   ///< without counterpart, or outside units
};

/// "twin", "rewritten", "one_sided", "unmatched".
std::string_view share_name(Share share);

/// Lines of code by what they are; each line counts once.
struct LineParts {
    size_t twin = 0, rewritten = 0, one_sided = 0, unmatched = 0;

    size_t total() const { return twin + rewritten + one_sided + unmatched; }
    void add(Share share, size_t lines);
};

/// The code of a file that belongs together: a unit without what lies in its holes, or what lies outside all units.
struct Piece {
    const ScannedFile* file = nullptr;
    const Unit* unit = nullptr;  ///< nullptr: outside units
    std::vector<uint32_t> lines;
};

/// Splits the lines of code of a file among its units: a line belongs to the unit that its first token belongs to.
/// Every line of code is in exactly one piece; the piece outside units comes last, and is left out where it is empty.
std::vector<Piece> pieces_of(const ScannedFile& file);

/// Ascending lines as spans.
std::vector<LineSpan> spans_of(const std::vector<uint32_t>& lines);

}  // namespace porttool
