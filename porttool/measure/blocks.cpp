// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/measure/blocks.h"

#include <algorithm>

#include "porttool/read/glob.h"
#include "porttool/text/sink/terminal.h"
#include "porttool/text/suggest.h"

namespace porttool {
namespace {

bool takes_whole(const Selection& selection, const std::string& path) {
    const auto there = selection.find(path);
    return there != selection.end() && there->second.empty();
}

bool add_files(Selection& selection, const Glob& glob, const SideFiles& files) {
    bool any = false;
    for (const std::string& path : files.paths) {
        if (!glob.matches(path) && glob.text() != path + ":@file") continue;
        selection[path].clear();
        any = true;
    }
    return any;
}

bool add_units(Selection& selection, const Glob& glob, const SideFiles& files) {
    bool any = false;
    for (const std::string& path : files.paths)
        for (const std::string& name : files.units(path)) {
            const std::string id = path + ":" + name;
            if (id != glob.text() && !glob.matches(id)) continue;
            any = true;
            if (!takes_whole(selection, path)) selection[path].insert(name);
        }
    return any;
}

std::string nearest_to(const std::string& pattern, const SideFiles& files) {
    std::vector<std::string> names;
    for (const std::string& path : files.paths) {
        names.push_back(path);
        for (const std::string& name : files.units(path)) names.push_back(path + ":" + name);
    }
    const std::string near = nearest(pattern, names);
    return near.empty() ? std::string("patterns are relative to the root, and what they name must lie in [sides]")
                        : "did you mean '" + terminal_text(near) + "'?";
}

/// Adds what the patterns of one side of a block name.
void select(const std::vector<std::string>& patterns, Side side, const SideFiles& files, Block& block, Blocks& out) {
    for (const std::string& pattern : patterns) {
        const Glob glob(pattern);
        if (add_files(block.takes[side], glob, files)) continue;
        out.name_units = true;
        if (!add_units(block.takes[side], glob, files) && !out.unmatched) out.unmatched = {block.name, pattern, side};
    }
}

Blocks named_blocks(const MapFile& map, const BySide<SideFiles>& files) {
    Blocks out;
    std::set<std::string> names;
    for (const MapBlock& named : map.blocks) {
        const std::string start = "portmap.toml: block '" + terminal_text(named.name) + "': ";
        if (!names.insert(named.name).second) out.error = start + "there are two of this name; rename one";
        if (named.source.empty() && named.target.empty())
            out.error = start + "it names neither a source nor a target; add them, or remove the block";
        Block block{named.name, {}};
        select(named.source, Side::Source, files.source, block, out);
        select(named.target, Side::Target, files.target, block, out);
        out.blocks.push_back(std::move(block));
    }
    return out;
}

}  // namespace

Blocks find_blocks(const MapFile& map, const BySide<SideFiles>& files, const FilePairs& pairs) {
    if (!map.blocks.empty()) return named_blocks(map, files);
    Blocks out;
    out.are_file_pairs = true;
    for (const auto& [source, target] : pairs)
        out.blocks.push_back({source + "=" + target, {Selection{{source, {}}}, Selection{{target, {}}}}});
    return out;
}

std::string error_of(const Blocks& blocks, const BySide<SideFiles>& files) {
    if (!blocks.error.empty() || !blocks.unmatched) return blocks.error;
    const auto& [block, pattern, side] = *blocks.unmatched;
    return "portmap.toml: block '" + terminal_text(block) + "': " + (side == Side::Source ? "source '" : "target '") +
           terminal_text(pattern) + "' matches no file and no unit; " + nearest_to(pattern, files[side]);
}

std::vector<std::string> unit_names(const ScannedFile& file) {
    std::vector<std::string> names;
    for (const Unit& unit : file.units) names.push_back(unit.name);
    return names;
}

Passage passage_of(const Selection& takes, const std::function<const ScannedFile&(const std::string& path)>& file_at) {
    Passage passage;
    for (const auto& [path, names] : takes) {
        const ScannedFile& file = file_at(path);
        if (names.empty()) passage.push_back({&file, nullptr});
        for (const Unit& unit : file.units)
            if (names.contains(unit.name)) passage.push_back({&file, &unit});
    }
    return passage;
}

}  // namespace porttool
