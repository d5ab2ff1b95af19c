// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/normal/statements.h"

namespace porttool {

/// A statement of a function with the statements of its block.
struct Step {
    std::vector<std::string> words;  ///< without the braces and semicolon at its end; none of a block by itself
    std::vector<Step> block;
    bool has_block = false;
    bool leaves = false;  ///< it, or one in its block, may leave the block that it stands in: return, break, continue
};

/// The statements of a text as a tree, by what closing braces they have; the words are those in the common vocabulary.
///
///     if ( a )    b = c    }    return b          if ( a ) has a block of one statement, and return b stands beside it
///
/// Empty where that is not sure: with blocks that have no head of their own, unbalanced braces, or nested too deeply.
std::vector<Step> as_tree(const std::vector<Statement>& statements);

}  // namespace porttool
