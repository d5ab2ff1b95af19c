// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/measure/accounting.h"

namespace porttool {

std::string_view share_name(Share share) {
    switch (share) {
        case Share::Twin:
            return "twin";
        case Share::Rewritten:
            return "rewritten";
        case Share::OneSided:
            return "one_sided";
        case Share::Unmatched:
            break;
    }
    return "unmatched";
}

void LineParts::add(Share share, size_t lines) {
    size_t& part = share == Share::Twin        ? twin
                   : share == Share::Rewritten ? rewritten
                   : share == Share::OneSided  ? one_sided
                                               : unmatched;
    part += lines;
}

std::vector<UnitCode> code_by_unit(const ScannedFile& file) {
    std::vector<UnitCode> code;
    for (const Unit& unit : file.units) code.push_back({{&file, &unit}, {}});
    code.push_back({{&file, nullptr}, {}});
    const size_t outside = code.size() - 1;
    std::vector<size_t> open;  // units nest; those that hold the token in hand
    size_t next = 0;
    uint32_t last_line = 0;
    for (const TokenRange& stretch : code_stretches({&file, nullptr})) {
        for (uint32_t token = stretch.first; token < stretch.end; ++token) {
            for (; next < file.units.size() && file.units[next].tokens.first <= token; ++next) open.push_back(next);
            while (!open.empty() && file.units[open.back()].tokens.end <= token) open.pop_back();
            const uint32_t line = file.lexed.tokens[token].line;
            if (line == last_line) continue;
            last_line = line;
            code[open.empty() ? outside : open.back()].lines.push_back(line);
        }
    }
    if (code.back().lines.empty()) code.pop_back();
    return code;
}

std::vector<LineSpan> spans_of(const std::vector<uint32_t>& lines) {
    std::vector<LineSpan> spans;
    for (const uint32_t line : lines) {
        if (!spans.empty() && spans.back().last + 1 == line)
            spans.back().last = line;
        else
            spans.push_back({line, line});
    }
    return spans;
}

}  // namespace porttool
