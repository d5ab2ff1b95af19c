// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/scan/angles.h"

namespace porttool {

uint32_t AngleTable::skip(uint32_t open, uint32_t end) {
    constexpr uint32_t kNear = 256;
    int depth = 0;
    for (uint32_t at = open; at < end; ++at) {
        if (at - open > kNear) return skip_far(open, end);
        const std::string_view text = lexed_.view(structure_.tokens[at]);
        const uint32_t close = structure_.match[at];
        if ((text == "(" || text == "[" || text == "{") && close != kNoMatch && close < end)
            at = close;
        else if (text == "<")
            ++depth;
        else if (text == ">" && --depth == 0)
            return at + 1;
        else if (text == ";")
            return kNoMatch;
    }
    return kNoMatch;
}

uint32_t AngleTable::skip_far(uint32_t open, uint32_t end) {
    if (close_.empty()) fill();
    return close_[open] < end ? close_[open] + 1 : kNoMatch;
}

void AngleTable::fill() {
    const auto count = static_cast<uint32_t>(structure_.tokens.size());
    close_.assign(count, kNoMatch);
    std::vector<uint32_t> open;  // angle brackets, those of outer groups below those of inner ones
    std::vector<size_t> outer;   // how many belong to the groups around
    for (uint32_t at = 0; at < count; ++at) {
        const std::string_view text = lexed_.view(structure_.tokens[at]);
        const uint32_t match = structure_.match[at];
        const size_t floor = outer.empty() ? 0 : outer.back();
        if (match != kNoMatch && match > at) {
            outer.push_back(open.size());
        } else if (match != kNoMatch) {
            open.resize(floor);
            if (!outer.empty()) outer.pop_back();
        } else if (text == "<") {
            open.push_back(at);
        } else if (text == ">" && open.size() > floor) {
            close_[open.back()] = at;
            open.pop_back();
        } else if (text == ";") {
            open.resize(floor);
        }
    }
}

}  // namespace porttool
