// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "porttool/scan/unit.h"

namespace porttool {

struct TextEdit;

/// Whole lines of a text, and how many bytes they have become.
struct RescannedLines {
    size_t first = 0, end = 0;  ///< bytes
    size_t now = 0;             ///< bytes from `first` on
};

/// Makes edits of one unit in a scanned file, and scans that unit alone: the file becomes what scan_text() makes of the
/// edited text, which must be that of the file on the disk. None, with the file as it was, where only the whole can
/// tell: a unit that shares lines with others, has or gets directives, or is read otherwise by itself, and a file with
/// branches that exclude each other, unless the edits change numbers in one line alone. `unit`: which of the file's;
/// the cost is that of the unit where the edits change no number of bytes, lines or words.
std::optional<RescannedLines> rescan_unit(ScannedFile& file, size_t unit, const std::vector<TextEdit>& edits);

}  // namespace porttool
