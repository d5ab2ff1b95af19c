// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/scan/head.h"
#include "porttool/scan/unit.h"

namespace porttool {

/// One declarator of a constant; positions in Structure::tokens.
struct ConstantDeclaration {
    std::string name;
    uint32_t name_at = 0;
    uint32_t first = 0;
    uint32_t end = 0;
};

/// The initialised constants that the statement [first, end) declares: `const float A = 1, B = 2`. Empty for anything
/// else.
std::vector<ConstantDeclaration> read_constants(const HeadContext& context, uint32_t first, uint32_t end);

/// The macros of a file that carry a value (`#define PI 3.14f`) or code (`#define SQR(x) ((x) * (x))`), as units.
/// Include guards and words that stand for a qualifier are none.
std::vector<Unit> find_macro_units(const LexedText& lexed);

}  // namespace porttool
