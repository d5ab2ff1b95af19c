// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/snapshot/map_edit.h"

#include <fmt/format.h>

#include "porttool/text/sink/terminal.h"
#include "porttool/text/toml_string.h"

namespace porttool {

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

}  // namespace porttool
