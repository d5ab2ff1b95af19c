// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/snapshot/map_edit.h"

#include <fmt/format.h>

#include <algorithm>

#include "porttool/text/sink/terminal.h"
#include "porttool/text/toml_string.h"

namespace porttool {
namespace {

constexpr std::string_view kPairHead = "[[pair]]";

}  // namespace

std::string pair_text(const NewPair& pair) {
    constexpr double kPercent = 100;
    return fmt::format("\n[[pair]]{}\nsource = {}\ntarget = {}\n",
                       pair.score < 0 ? "" : fmt::format("  # {:.0f} % sure", kPercent * pair.score),
                       toml_string(pair.source), toml_string(pair.target));
}

std::string add_pairs(Project& project, const std::vector<NewPair>& pairs) {
    std::string text = project.map_text;
    if (!text.empty() && text.back() != '\n') text += '\n';
    for (const NewPair& pair : pairs) text += pair_text(pair);
    const ReadMap read = read_map(project.map_name, text);
    if (!read.error.empty())
        throw CannotDo(terminal_text(project.map_name) +
                       ": a [[pair]] cannot be added at its end; write it there by hand:" + pair_text(pairs.front()) +
                       read.error);
    use_map(project, project.map_name, text);
    return text;
}

std::string remove_pair(Project& project, const NewPair& pair) {
    const auto is_it = [&](const MapPair& one) {
        return one.source == pair.source && one.targets == std::vector<std::string>{pair.target};
    };
    const std::vector<MapPair> before = project.map.pairs;
    const auto found = std::find_if(before.begin(), before.end(), is_it);
    const std::string& text = project.map_text;
    size_t first = 0;
    for (int line = 1; found != before.end() && line < found->line; ++line) first = text.find('\n', first) + 1;
    const bool stands_alone = found != before.end() && text.compare(first, kPairHead.size(), kPairHead) == 0;
    size_t end = std::min(text.find("\n[", first), text.size() - 1) + 1;
    if (first > 0 && text.compare(first - 1, 1, "\n") == 0 && first > 1 && text[first - 2] == '\n') --first;
    const std::string left = stands_alone ? text.substr(0, first) + text.substr(end) : text;
    const ReadMap read = read_map(project.map_name, left);
    if (!stands_alone || !read.error.empty() || read.map.pairs.size() + 1 != before.size())
        throw CannotDo(terminal_text(project.map_name) + ": the pair " + terminal_text(pair.source) + " = " +
                       terminal_text(pair.target) + " stands in no [[pair]] of its own; take it out by hand");
    use_map(project, project.map_name, left);
    return left;
}

}  // namespace porttool
