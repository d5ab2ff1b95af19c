// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/scan/brackets.h"

namespace porttool {

/// Where the angle brackets of a file that stand for template arguments close. Near ones are looked for; where all of
/// them would close is worked out at one go when a far one is first asked for, since each search on its own can run to
/// the end of the file.
class AngleTable {
public:
    AngleTable(const LexedText& lexed, const Structure& structure) : lexed_(lexed), structure_(structure) {}

    /// Position after the `>` that closes the `<` at `open`, or kNoMatch if there is none before `end`; positions in
    /// Structure::tokens.
    uint32_t skip(uint32_t open, uint32_t end);

private:
    uint32_t skip_far(uint32_t open, uint32_t end);
    void fill();

    const LexedText& lexed_;
    const Structure& structure_;
    std::vector<uint32_t> close_;
};

}  // namespace porttool
