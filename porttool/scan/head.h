// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/scan/head_items.h"

namespace porttool {

/// What the tokens before a `{` announce.
enum class HeadKind { Unknown, Namespace, Linkage, Enum, Struct, Block, Function };

struct Head {
    HeadKind kind = HeadKind::Unknown;
    std::string name;                ///< as written, without template arguments; empty if anonymous
    uint32_t name_at = kNoMatch;     ///< position in Structure::tokens
    uint32_t parameters = kNoMatch;  ///< position of the opening parenthesis
    uint32_t first = 0;              ///< where the signature starts: an unrelated macro line before it is left out
    bool kernel = false;
};

/// Reads the head [first, end) of a block; positions in Structure::tokens.
Head read_head(const HeadContext& context, uint32_t first, uint32_t end);

}  // namespace porttool
