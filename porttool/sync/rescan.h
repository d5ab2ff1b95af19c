// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "porttool/scan/unit.h"
#include "porttool/sync/rewrite.h"

namespace porttool {

/// Makes edits of one unit in a scanned file, and scans that unit alone: the file becomes what scan_text() makes of the
/// edited text, which must be that of the file on the disk. False, with the file as it was, where only the whole can
/// tell: a unit that shares lines with others, has or gets directives, or is read otherwise by itself, and a file with
/// branches that exclude each other.
bool rescan_unit(ScannedFile& file, std::string_view unit_name, const std::vector<TextEdit>& edits);

}  // namespace porttool
