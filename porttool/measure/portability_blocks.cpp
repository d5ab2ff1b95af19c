// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/measure/portability_blocks.h"

#include <algorithm>
#include <set>

#include "porttool/read/glob.h"
#include "porttool/scan/scan.h"
#include "porttool/text/sink/terminal.h"
#include "porttool/text/suggest.h"

namespace porttool {
namespace {

using Files = std::vector<ScannedFile>;

bool contains(const Passage& passage, const Excerpt& excerpt) {
    return std::any_of(passage.begin(), passage.end(), [&](const Excerpt& one) {
        return one.file == excerpt.file && (one.unit == nullptr || one.unit == excerpt.unit);
    });
}

/// Adds what a pattern names; false if it names nothing. An excerpt that is there already, alone or within its file, is
/// not added twice.
bool add_matches(Passage& passage, const std::string& pattern, const Files& files) {
    const Glob glob(pattern);
    bool any = false;
    for (const ScannedFile& file : files) {
        if (!glob.matches(file.path) && pattern != file.path + ":@file") continue;
        any = true;
        if (contains(passage, {&file, nullptr})) continue;
        std::erase_if(passage, [&](const Excerpt& one) { return one.file == &file; });
        passage.push_back({&file, nullptr});
    }
    if (any) return true;
    for (const ScannedFile& file : files) {
        for (const Unit& unit : file.units) {
            const std::string id = unit_id(file, unit);
            if (id != pattern && !glob.matches(id)) continue;
            any = true;
            if (!contains(passage, {&file, &unit})) passage.push_back({&file, &unit});
        }
    }
    return any;
}

void sort_by_place(Passage& passage) {
    std::sort(passage.begin(), passage.end(), [](const Excerpt& a, const Excerpt& b) {
        if (a.file != b.file) return a.file->path < b.file->path;
        return a.unit != nullptr && b.unit != nullptr && a.unit->tokens.first < b.unit->tokens.first;
    });
}

std::string nearest_to(const std::string& pattern, const Files& files) {
    std::vector<std::string> names;
    for (const ScannedFile& file : files) {
        names.push_back(file.path);
        for (const Unit& unit : file.units) names.push_back(unit_id(file, unit));
    }
    const std::string near = nearest(pattern, names);
    return near.empty() ? std::string("patterns are relative to the root, and what they name must lie in [sides]")
                        : "did you mean '" + terminal_text(near) + "'?";
}

BlockTexts named_blocks(const MapFile& map, const Files& source, const Files& target) {
    BlockTexts out;
    std::set<std::string> names;
    for (const MapBlock& block : map.blocks) {
        const std::string start = "portmap.toml: block '" + terminal_text(block.name) + "': ";
        if (!names.insert(block.name).second) out.error = start + "there are two of this name; rename one";
        if (block.source.empty() && block.target.empty())
            out.error = start + "it names neither a source nor a target; add them, or remove the block";
        BlockText text{block.name, {}, {}};
        const auto take = [&](const char* side, const std::vector<std::string>& patterns, const Files& files,
                              Passage& passage) {
            for (const std::string& pattern : patterns)
                if (!add_matches(passage, pattern, files) && out.error.empty())
                    out.error = start + side + " '" + terminal_text(pattern) + "' matches no file and no unit; " +
                                nearest_to(pattern, files);
            sort_by_place(passage);
        };
        take("source", block.source, source, text.source);
        take("target", block.target, target, text.target);
        out.blocks.push_back(std::move(text));
    }
    return out;
}

const ScannedFile* find_file(const Files& files, const std::string& path) {
    const auto found =
        std::find_if(files.begin(), files.end(), [&](const ScannedFile& file) { return file.path == path; });
    return found == files.end() ? nullptr : &*found;
}

BlockTexts file_pairs(const Files& source, const Files& target, const Judgement& judgement) {
    std::set<std::pair<std::string, std::string>> paths;
    for (const JudgedPair& pair : judgement.pairs)
        if (pair.source != nullptr && pair.target != nullptr) paths.emplace(pair.source->file, pair.target->file);
    BlockTexts out;
    out.are_file_pairs = true;
    for (const auto& [left, right] : paths)
        out.blocks.push_back(
            {left + "=" + right, {{find_file(source, left), nullptr}}, {{find_file(target, right), nullptr}}});
    return out;
}

}  // namespace

BlockTexts find_blocks(const MapFile& map, const Files& source, const Files& target, const Judgement& judgement) {
    return map.blocks.empty() ? file_pairs(source, target, judgement) : named_blocks(map, source, target);
}

}  // namespace porttool
