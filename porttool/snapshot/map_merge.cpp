// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/snapshot/map_merge.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>
#include <utility>

#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

ReadMap read_side(const std::string& name, const std::string& text) {
    ReadMap read = read_map(name, text);
    if (!read.error.empty())
        throw CannotDo("one side of the merge cannot be read: " + read.error + "\nMerge " + terminal_text(name) +
                       " by hand");
    return read;
}

using PairNames = std::set<std::pair<std::string, std::string>>;

PairNames names_of(const MapFile& map) {
    PairNames out;
    for (const MapPair& pair : map.pairs)
        for (const std::string& target : pair.targets) out.emplace(pair.source, target);
    return out;
}

PairNames names_of(const std::vector<NewPair>& pairs) {
    PairNames out;
    for (const NewPair& pair : pairs) out.emplace(pair.source, pair.target);
    return out;
}

}  // namespace

MapSides map_sides(const std::string& name, const std::string& text) {
    enum class In : uint8_t { Both, Ours, Base, Theirs };
    In in = In::Both;
    MapSides out;
    bool any = false;
    for (size_t at = 0; at < text.size();) {
        const size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
        const std::string_view line = std::string_view(text).substr(at, end - at);
        at = end;
        if (in == In::Both && line.starts_with("<<<<<<< ")) {
            in = In::Ours;
        } else if (in == In::Ours && line.starts_with("||||||| ")) {
            in = In::Base;
        } else if ((in == In::Ours || in == In::Base) && (line == "=======\n" || line == "=======\r\n")) {
            in = In::Theirs;
        } else if (in == In::Theirs && line.starts_with(">>>>>>> ")) {
            in = In::Both;
            any = true;
        } else {
            if (in == In::Both || in == In::Ours) out.ours += line;
            if (in == In::Both || in == In::Theirs) out.theirs += line;
        }
    }
    if (!any || in != In::Both)
        throw CannotDo(terminal_text(name) +
                       " holds no marks of a merge (<<<<<<<, =======, >>>>>>>), or not all of "
                       "them; there is nothing to merge");
    return out;
}

std::string map_behind_links(const Project& project) {
    std::error_code error;
    const auto file = std::filesystem::weakly_canonical(project.map_path, error);
    const std::string below =
        file.lexically_relative(std::filesystem::weakly_canonical(project.root, error)).generic_string();
    return below.empty() || below.starts_with("..") ? file.generic_string() : below;
}

MergedMap merged_map(const Project& project, const std::string& text, const std::string& other,
                     const std::vector<NewPair>& before) {
    const std::string& name = project.map_name;
    const PairNames old = names_of(before), here = names_of(read_side(name, text).map),
                    there = names_of(read_side(name, other).map);
    Project merged = project;
    use_map(merged, name, text);
    MergedMap out;
    for (const auto& [source, target] : here)
        if (old.contains({source, target}) && !there.contains({source, target}))
            out.removed.push_back({source, target});
    for (const NewPair& pair : out.removed) remove_pair(merged, pair);
    for (const auto& pair : there) {
        if (here.contains(pair)) continue;
        (old.contains(pair) ? out.removed : out.added).push_back({pair.first, pair.second});
    }
    out.text = out.added.empty() ? merged.map_text : map_with_pairs(merged.map_text, merged.map, out.added);
    out.map = read_side(name, out.text).map;
    return out;
}

}  // namespace porttool
