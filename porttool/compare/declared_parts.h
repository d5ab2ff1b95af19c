// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string_view>

#include "porttool/normal/normal_text.h"

namespace porttool {

/// What a text, which must outlive it, declares as real numbers, and as vectors with how many parts.
struct DeclaredParts {
    std::set<std::string_view> reals;
    std::map<std::string_view, size_t> vectors;  ///< 0 for what is declared as something else, too

    explicit DeclaredParts(const Words& text);
};

}  // namespace porttool
