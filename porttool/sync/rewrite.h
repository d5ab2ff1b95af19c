// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "porttool/sync/block_braces.h"
#include "porttool/sync/indent_steps.h"
#include "porttool/sync/transplant.h"

namespace porttool {

/// Bytes [first, end) of a text that become `text`.
struct TextEdit {
    size_t first = 0, end = 0;
    std::string text;
};

/// The edits of the target's file that make its unit what the transplant says, in the manner of the lines around:
/// their indentation, braces where a block is no single statement any more. White space within what is new, and its
/// line breaks, are the source's. `indent`: indent_unit() of the target's file. Sorted, without overlap.
std::vector<TextEdit> rewrite_unit(const Transplant& transplant, const PlacedUnit& source, const PlacedUnit& target,
                                   const std::string& indent);

/// The text with all edits.
std::string with_edits(std::string_view text, const std::vector<TextEdit>& edits);

}  // namespace porttool
