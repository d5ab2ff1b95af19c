// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/measure/blocks.h"

#include <algorithm>
#include <span>
#include <utility>

#include "porttool/read/glob.h"
#include "porttool/text/sink/terminal.h"
#include "porttool/text/suggest.h"

namespace porttool {
namespace {

/// Most patterns times files and units that are tried: some seconds, and far above the blocks of a large map. One that
/// fits is kept, which takes as long as so many tries, and a hundred bytes.
constexpr size_t kMostTries = 50'000'000, kTriesToKeep = 64;

bool takes_whole(const Selection& selection, const std::string& path) {
    const auto there = selection.find(path);
    return there != selection.end() && there->second.empty();
}

/// Sorted texts; finds those that a pattern may match without trying all where its beginning is plain.
class Matcher {
public:
    explicit Matcher(size_t& tried) : tried_(tried) {}

    void add(std::string text, size_t number) { texts_.emplace_back(std::move(text), number); }
    void sort() { std::sort(texts_.begin(), texts_.end()); }

    /// The numbers of the texts that a pattern matches. One without wildcards is looked up. Beyond kMostTries nothing
    /// is tried any more.
    std::vector<size_t> matches(const Glob& glob) const {
        std::set<size_t> out;
        for (const auto& [text, number] : beginning_with(glob.text()))
            if (text == glob.text()) out.insert(number);
        const auto candidates = beginning_with(glob.start());
        tried_ += candidates.size();
        if (tried_ > kMostTries) return {};
        for (const auto& [text, number] : candidates)
            if (glob.matches(text)) out.insert(number);
        tried_ += kTriesToKeep * out.size();
        return {out.begin(), out.end()};
    }

private:
    using Numbered = std::pair<std::string, size_t>;

    std::span<const Numbered> beginning_with(const std::string& start) const {
        const auto first = std::lower_bound(texts_.begin(), texts_.end(), Numbered(start, 0));
        const auto end = std::partition_point(first, texts_.end(),
                                              [&](const Numbered& one) { return one.first.starts_with(start); });
        return {first, end};
    }

    std::vector<Numbered> texts_;
    size_t& tried_;
};

/// What patterns of one side may name: files and, once a pattern asks for them, units.
class SidePlaces {
public:
    SidePlaces(const SideFiles& files, size_t& tried) : files_(files), paths_(tried), ids_(tried) {
        for (size_t i = 0; i < files.paths.size(); ++i) {
            paths_.add(files.paths[i], i);
            paths_.add(files.paths[i] + ":@file", i);
        }
        paths_.sort();
    }

    bool add_files(Selection& selection, const Glob& glob) const {
        bool any = false;
        for (const size_t i : paths_.matches(glob)) {
            const std::string& path = files_.paths[i];
            if (!glob.matches(path) && glob.text() != path + ":@file") continue;
            selection[path].clear();
            any = true;
        }
        return any;
    }

    bool add_units(Selection& selection, const Glob& glob) {
        read_units();
        const std::vector<size_t> found = ids_.matches(glob);
        for (const size_t i : found) {
            const auto& [path, name] = units_[i];
            if (!takes_whole(selection, *path)) selection[*path].insert(name);
        }
        return !found.empty();
    }

private:
    void read_units() {
        if (std::exchange(has_units_, true)) return;
        for (const std::string& path : files_.paths)
            for (std::string& name : files_.units(path)) {
                ids_.add(path + ":" + name, units_.size());
                units_.emplace_back(&path, std::move(name));
            }
        ids_.sort();
    }

    const SideFiles& files_;
    Matcher paths_, ids_;
    std::vector<std::pair<const std::string*, std::string>> units_;
    bool has_units_ = false;
};

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
void select(const std::vector<std::string>& patterns, Side side, SidePlaces& places, Block& block, Blocks& out) {
    for (const std::string& pattern : patterns) {
        const Glob glob(pattern);
        if (places.add_files(block.takes[side], glob)) continue;
        out.name_units = true;
        if (!places.add_units(block.takes[side], glob) && !out.unmatched) out.unmatched = {block.name, pattern, side};
    }
}

Blocks named_blocks(const MapFile& map, const BySide<SideFiles>& files) {
    Blocks out;
    std::set<std::string> names;
    size_t tried = 0;
    SidePlaces source(files.source, tried), target(files.target, tried);
    for (const MapBlock& named : map.blocks) {
        const std::string start = "portmap.toml: block '" + terminal_text(named.name) + "': ";
        if (!names.insert(named.name).second) out.error = start + "there are two of this name; rename one";
        if (named.source.empty() && named.target.empty())
            out.error = start + "it names neither a source nor a target; add them, or remove the block";
        Block block{named.name, {}};
        select(named.source, Side::Source, source, block, out);
        select(named.target, Side::Target, target, block, out);
        out.blocks.push_back(std::move(block));
    }
    if (tried > kMostTries)
        out.error =
            "portmap.toml: the patterns of its blocks fit, or would be tried on, too many files and units; write fewer "
            "wildcards, begin patterns with folders, and let each block take code of its own";
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

const Unit* UnitsByName::find(const ScannedFile& file, const std::string& name) {
    const auto [units, is_new] = files_.try_emplace(&file);
    if (is_new)
        for (const Unit& unit : file.units) units->second.emplace(unit.name, &unit);
    const auto found = units->second.find(name);
    return found == units->second.end() ? nullptr : found->second;
}

Passage passage_of(const Selection& takes, const std::function<const ScannedFile&(const std::string& path)>& file_at,
                   UnitsByName& units) {
    Passage passage;
    for (const auto& [path, names] : takes) {
        const ScannedFile& file = file_at(path);
        if (names.empty()) passage.push_back({&file, nullptr});
        std::vector<const Unit*> taken;  // in one file they stand in the order of their places
        for (const std::string& name : names)
            if (const Unit* unit = units.find(file, name)) taken.push_back(unit);
        std::sort(taken.begin(), taken.end());
        for (const Unit* unit : taken) passage.push_back({&file, unit});
    }
    return passage;
}

}  // namespace porttool
