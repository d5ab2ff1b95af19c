// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "porttool/scan/side.h"
#include "porttool/snapshot/project.h"
#include "porttool/snapshot/side_files.h"

namespace porttool {

/// The line, from 1, of the first mark that git leaves where a merge needs a person: `<<<<<<< `, with a line `=======`
/// and one that begins with `>>>>>>> ` after it.
std::optional<uint32_t> unfinished_merge(std::string_view text);

/// Nothing can be said of a pair whose text is two texts. Throws CannotDo for the first such file with a pair in the
/// map.
void require_finished_merges(const MapFile& map, const BySide<FilesOfSide>& files);

/// The same for any files, by their paths.
void require_finished_merges(const BySide<FilesOfSide>& files, const BySide<std::set<std::string>>& asked);

}  // namespace porttool
