// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/compare/meaning.h"
#include "porttool/compare/statement_edit.h"

namespace porttool {

/// The texts of a pair of which one side was edited part by part, each part alike, without the edits of all parts but
/// the first: what the other side's edit says of all parts can be held against that.
struct EditOfOnePart {
    std::vector<std::string> source_before, source_now, target_before, target_now;
};

/// Edits of a pair of which one side says for a whole vector, or in a loop over its parts, what the other says part by
/// part. What the parts are called the unedited text tells: statements of a side are of one family if they are the same
/// but for some names, one each for one other, or for what is in their subscripts, and if the other side has none like
/// its own; where it has, the names have to differ by one part as `qx` and `qy` do.
///
///     source      q = q * k;                                     now    q = q * k * 2;
///     port        red = red * k;  green = green * k;             now    red = red * k * 2;  green = green * k;    half
class EditsByParts {
public:
    explicit EditsByParts(const PairTexts& texts);

    /// A sentence where the edit of one side reached some of the parts alone; else "".
    std::string half_of_a_port() const;

    /// The edit of the first part, as it is written and, second, in the words of the whole; nothing if the sides do not
    /// say it so, or the parts are not edited alike.
    std::vector<EditOfOnePart> of_one_part() const;

private:
    const PairTexts& texts_;
    StatementEdit source_, target_;
    bool is_short_ = false;  ///< enough to be looked through
};

}  // namespace porttool
