// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/scan/suppressions.h"

#include <algorithm>

#include "porttool/scan/scan.h"

namespace porttool {
namespace {

TokenRange tokens_on(const LexedText& lexed, uint32_t line) {
    const auto first = std::lower_bound(lexed.tokens.begin(), lexed.tokens.end(), line,
                                        [](const Token& token, uint32_t at) { return token.line < at; });
    const auto end = std::upper_bound(first, lexed.tokens.end(), line,
                                      [](uint32_t at, const Token& token) { return at < token.line; });
    return {static_cast<uint32_t>(first - lexed.tokens.begin()), static_cast<uint32_t>(end - lexed.tokens.begin())};
}

bool owns_one_of(const Unit& unit, const TokenRange& tokens) {
    for (uint32_t at = std::max(unit.tokens.first, tokens.first); at < std::min(unit.tokens.end, tokens.end); ++at)
        if (std::none_of(unit.holes.begin(), unit.holes.end(),
                         [&](const TokenRange& hole) { return hole.first <= at && at < hole.end; }))
            return true;
    return false;
}

/// The first line behind `line` that is no comment.
uint32_t line_behind_comments(const ScannedFile& file, uint32_t line) {
    while (line < file.lines.size() && tokens_on(file.lexed, line + 1).empty()) {
        const auto around = [&](const LineSpan& c) { return c.first <= line + 1 && line + 1 <= c.last; };
        if (std::none_of(file.lexed.comments.begin(), file.lexed.comments.end(), around)) break;
        ++line;
    }
    return line + 1;
}

std::vector<const Unit*> owners(const ScannedFile& file, uint32_t line) {
    std::vector<const Unit*> out;
    if (const TokenRange beside = tokens_on(file.lexed, line); !beside.empty()) {
        for (const Unit& unit : file.units)
            if (owns_one_of(unit, beside)) out.push_back(&unit);
        return out;
    }
    const uint32_t next = line_behind_comments(file, line);
    for (const Unit& unit : file.units)
        if (unit.start_line == next) out.push_back(&unit);
    if (!out.empty()) return out;
    const Unit* innermost = nullptr;
    for (const Unit& unit : file.units)
        if (unit.start_line <= line && line <= unit.end_line &&
            (innermost == nullptr || unit.start_line >= innermost->start_line))
            innermost = &unit;
    if (innermost != nullptr) out.push_back(innermost);
    return out;
}

}  // namespace

void attach_suppressions(ScannedFile& file) {
    for (Suppression& comment : file.lexed.suppressions) {
        for (const Unit* unit : owners(file, comment.line)) comment.units.push_back(unit_id(file, *unit));
        if (file.units.empty()) comment.units.push_back(unit_id(file, whole_file_unit(file)));
    }
}

}  // namespace porttool
