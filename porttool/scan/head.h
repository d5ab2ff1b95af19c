// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "porttool/scan/brackets.h"
#include "porttool/scan/macros.h"
#include "porttool/scan/unit.h"

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
    bool is_typedef = false;
};

/// Where the angle brackets of a file that stand for template arguments would close: made at one go when it is first
/// asked for, since each search on its own can run to the end of the file.
class AngleTable {
public:
    /// Position of the `>` that closes the `<` at `open`, kNoMatch if none does.
    uint32_t close(const LexedText& lexed, const Structure& structure, uint32_t open);

private:
    void fill(const LexedText& lexed, const Structure& structure);
    std::vector<uint32_t> close_;
};

/// What a head is read with.
struct HeadContext {
    const LexedText& lexed;
    const Structure& structure;
    Language language;
    const MacroTable& macros;
    AngleTable& angles;
    bool in_class = false;
};

/// Reads the head [first, end) of a block; positions in Structure::tokens.
Head read_head(const HeadContext& context, uint32_t first, uint32_t end);

/// Position behind the `>` that closes the `<` at `open`, or kNoMatch if there is none before `end`.
uint32_t skip_angles(const HeadContext& context, uint32_t open, uint32_t end);

/// True for names before a parenthesis that are attributes, not functions: `__launch_bounds__`, `layout`, `alignas`.
bool takes_attribute_arguments(std::string_view word);

}  // namespace porttool
