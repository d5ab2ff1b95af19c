// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "porttool/scan/unit.h"
#include "porttool/sync/rewrite.h"

namespace porttool {

/// An `#include`.
struct IncludeLine {
    std::string what;            ///< as written, `<cmath>` or `"a/b.h"`
    size_t first = 0, next = 0;  ///< where its line starts, and the one after it
    bool in_branch = false;      ///< of the preprocessor
};
std::vector<IncludeLine> include_lines(const ScannedFile& file);

/// How the port includes what the source includes so; "" for what it need not, or of which nothing is known.
using IncludeThere = std::function<std::string(const std::string& what)>;

/// What the C and C++ standards have under that name, in the words of the language; "" for any other file.
std::string standard_include(const std::string& what, Language there);

/// The edits of the port's file that bring the includes which came to the source's: after the one that it stands
/// after there, or before the one that it stands before. One without such a neighbour has no place.
std::vector<TextEdit> port_includes(const ScannedFile& before, const ScannedFile& now, const ScannedFile& port,
                                    const IncludeThere& there);

}  // namespace porttool
