// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace porttool {

/// Of a line with code, the tokens that have a counterpart in the common vocabulary, and those of them in matches.
struct LineShare {
    uint32_t tokens = 0, covered = 0;
};

/// Which lines of an excerpt are shared: at least half of the tokens are covered. One whose tokens all have no
/// counterpart (`inline` alone) goes with the line after it; at the end of the excerpt it is not shared.
inline std::vector<bool> shared_lines(const std::vector<LineShare>& lines) {
    std::vector<bool> shared(lines.size());
    bool next = false;
    for (size_t i = lines.size(); i-- > 0;) {
        if (lines[i].tokens > 0) next = 2 * lines[i].covered >= lines[i].tokens;
        shared[i] = next;
    }
    return shared;
}

}  // namespace porttool
