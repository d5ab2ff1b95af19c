// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "porttool/measure/code_lines.h"
#include "porttool/read/map_file.h"
#include "porttool/scan/side.h"

namespace porttool {

/// What a block takes of a side: files by path, each by the names of some of its units, or whole (no names).
using Selection = std::map<std::string, std::set<std::string>>;

/// A functional block.
struct Block {
    std::string name;
    BySide<Selection> takes;
};

struct Blocks {
    std::vector<Block> blocks;
    bool are_file_pairs = false;
    bool name_units = false;  ///< a pattern looked for units: which ones it takes depends on the contents of files
    std::string error;        ///< of a block that is named badly, and what to do
    struct Unmatched {
        std::string block, pattern;
        Side side = Side::Source;
    };
    std::optional<Unmatched> unmatched;  ///< the first pattern that names nothing
};

/// The files of a side, ascending, and the names of the units in one of them.
struct SideFiles {
    std::vector<std::string> paths;
    std::function<std::vector<std::string>(const std::string& path)> units;
};

/// Pairs of files that hold at least one pair of units.
using FilePairs = std::set<std::pair<std::string, std::string>>;

/// The blocks that the map names: each pattern takes the files that it matches, or, where it matches none, the units
/// whose ids it matches. A map without blocks gives one block for each of `pairs`, named SOURCE=TARGET.
Blocks find_blocks(const MapFile& map, const BySide<SideFiles>& files, const FilePairs& pairs);

/// What is wrong with the blocks of the map, and what to do; "" if nothing is.
std::string error_of(const Blocks& blocks, const BySide<SideFiles>& files);

/// The names of a file's units.
std::vector<std::string> unit_names(const ScannedFile& file);

/// Units of files by their names, each file looked through once.
class UnitsByName {
public:
    const Unit* find(const ScannedFile& file, const std::string& name);

private:
    std::unordered_map<const ScannedFile*, std::unordered_map<std::string_view, const Unit*>> files_;
};

/// A selection as a passage: by path, then by place. `file_at` gives a file that the selection names.
Passage passage_of(const Selection& takes, const std::function<const ScannedFile&(const std::string& path)>& file_at,
                   UnitsByName& units);

}  // namespace porttool
