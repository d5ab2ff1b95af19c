// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/snapshot/map_merge.h"

#include <algorithm>
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

MergedMap with_pairs_of(const std::string& name, const std::string& text, const std::string& other) {
    MergedMap out{text, read_side(name, text).map, {}};
    std::set<std::pair<std::string, std::string>> known;
    for (const MapPair& pair : out.map.pairs)
        for (const std::string& target : pair.targets) known.emplace(pair.source, target);
    for (const MapPair& pair : read_side(name, other).map.pairs)
        for (const std::string& target : pair.targets)
            if (known.emplace(pair.source, target).second) out.added.push_back({pair.source, target});
    if (out.added.empty()) return out;
    out.text = map_with_pairs(text, out.map, out.added);
    out.map = read_side(name, out.text).map;
    return out;
}

}  // namespace porttool
