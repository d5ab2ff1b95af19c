// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/judge/judge.h"
#include "porttool/measure/code_lines.h"
#include "porttool/read/map_file.h"

namespace porttool {

/// The text of a functional block.
struct BlockText {
    std::string name;
    Passage source, target;
};

struct BlockTexts {
    std::vector<BlockText> blocks;
    bool are_file_pairs = false;
    std::string error;  ///< which pattern matches nothing, and what to do
};

/// The blocks that the map names: each pattern takes the files that it matches, or, where it matches none, the units
/// whose ids it matches. A map without blocks gives one block for each pair of files with a pair of units, named
/// SOURCE=TARGET.
BlockTexts find_blocks(const MapFile& map, const std::vector<ScannedFile>& source,
                       const std::vector<ScannedFile>& target, const Judgement& judgement);

}  // namespace porttool
