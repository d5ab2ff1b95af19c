// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/compare/meaning.h"

namespace porttool {

/// A sentence where one side says for a whole vector, or in a loop over its parts, what the other says part by part,
/// and the edits of both reached some of these parts alone; else "".
///
///     source      q = q * 2;                                     now    q = q * 4;
///     port        qx = qx * 2;  qy = qy * 2;                     now    qx = qx * 4;  qy = qy * 2;     half a port
///
/// Statements are of one family if they differ in what is in their subscripts, and in names that differ by one part, as
/// `qx` and `qy` or `.r` and `.g`, all by the same.
std::string half_of_a_port(const PairTexts& texts);

/// The texts now of a pair of which one side was edited part by part, each part alike, with the edit of the first part
/// alone: what the other side's edit says of all parts can be held against that.
struct EditOfOnePart {
    std::vector<std::string> source_now, target_now;
    bool any = false;  ///< some edit was taken back; else the texts are not to be used
};

EditOfOnePart edit_of_one_part(const PairTexts& texts);

}  // namespace porttool
