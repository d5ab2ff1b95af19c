// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/scan/unit.h"

namespace porttool {

/// What a file says outside of units, up to a `;`: a variable, a function that is defined elsewhere.
struct FileStatement {
    std::string name;   ///< that it declares; "" if nothing tells
    std::string words;  ///< its tokens with blanks between them
    TokenRange tokens;
    uint32_t name_token = 0;
    size_t head_length = 0;  ///< of `words`, what stands before the name
    bool is_function = false;
};

/// All that stand in no branch of the preprocessor and in no braces but those of `extern "C"` and namespaces.
std::vector<FileStatement> file_statements(const ScannedFile& file);

}  // namespace porttool
