// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "porttool/measure/code_lines.h"

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
struct UnitCode {
    Excerpt excerpt;  ///< without a unit: what lies outside of all
    std::vector<uint32_t> lines;
};

/// Splits the lines of code of a file among its units: a line belongs to the unit that its first token belongs to.
/// Every line of code belongs to one; those outside units come last, and are left out where there are none.
std::vector<UnitCode> code_by_unit(const ScannedFile& file);

/// Ascending lines as spans.
std::vector<LineSpan> spans_of(const std::vector<uint32_t>& lines);

}  // namespace porttool
