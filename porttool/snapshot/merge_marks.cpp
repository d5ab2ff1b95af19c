// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/snapshot/merge_marks.h"

#include <algorithm>

#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

/// Where a line that begins with `mark` starts, at `from` or after it.
size_t find_line(std::string_view text, std::string_view mark, size_t from) {
    for (size_t at = text.find(mark, from); at != std::string_view::npos; at = text.find(mark, at + 1))
        if (at == 0 || text[at - 1] == '\n') return at;
    return std::string_view::npos;
}

}  // namespace

std::optional<uint32_t> unfinished_merge(std::string_view text) {
    const size_t ours = find_line(text, "<<<<<<< ", 0);
    if (ours == std::string_view::npos) return std::nullopt;
    const size_t between = find_line(text, "=======\n", ours);
    if (between == std::string_view::npos || find_line(text, ">>>>>>> ", between) == std::string_view::npos)
        return std::nullopt;
    return 1 + static_cast<uint32_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(ours), '\n'));
}

void require_finished_merges(const BySide<FilesOfSide>& files, const BySide<std::set<std::string>>& asked) {
    for (const Side side : kBothSides)
        for (size_t i = 0; i < files[side].size(); ++i) {
            const std::string& path = files[side].path(i);
            const auto line = asked[side].contains(path) ? files[side].unfinished_merge(i) : std::nullopt;
            if (line)
                throw CannotDo(terminal_text(path) + ":" + std::to_string(*line) +
                               ": holds the marks of a merge that is not finished (<<<<<<<, =======, >>>>>>>)\n"
                               "Keep what the merge should give, take the marks out, and run this again");
        }
}

void require_finished_merges(const MapFile& map, const BySide<FilesOfSide>& files) {
    require_finished_merges(files, {named_files(map, Side::Source), named_files(map, Side::Target)});
}

}  // namespace porttool
