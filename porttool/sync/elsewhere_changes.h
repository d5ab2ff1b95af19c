// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/sync/edit_reading.h"
#include "porttool/sync/inserted_uses.h"
#include "porttool/sync/word_changes.h"

namespace porttool {

/// Carries what changed in a clause for which no clause of the target stands to where the target has what it says all
/// the same: the statement at another place, its value in a statement of another kind, the declaration of its name.
class ElsewhereChanger : EditReading {
public:
    ElsewhereChanger(const EditReading& reading, const InsertedUses& uses, Transplant& out)
        : EditReading(reading), uses_(uses), out_(out) {}

    /// The port may have the statement at another place.
    bool change_elsewhere(const std::vector<Hunk>& hunks, size_t was);
    /// What both sides give back is the same, however they come to it: `return f ( a ) ;` that became
    /// `return 0.5 * f ( a ) ;` makes `return 0.5f * sum ;` of the port's `return sum ;`.
    bool change_result(size_t was, size_t is);
    /// The port may have the value of a clause in one of another kind, `out [ k ] = E ;` for `return E ;`: there each
    /// word stands for its like. Once on both sides, or it may be another.
    bool change_value(const std::vector<Hunk>& hunks, size_t was);
    /// `int i = get_id ( 0 ) ;` that became `long i = ...` makes a `long` of the port's `int i`, whatever that is.
    bool change_type(const std::vector<Hunk>& hunks, size_t was);

private:
    /// What stands from `at` on in the target stands for what stands from `first` on: each word for its like.
    bool change_there(const std::vector<Hunk>& hunks, size_t first, size_t at);
    /// The value with the name that it is given to, `most = 0` of `float most = 0 ;`, which the port may have in a
    /// declaration of several, `float e , most = 0 ;`; else the value alone.
    Clause with_name(Clause value, const Clause& clause) const;
    /// True if `size` words of the target are a whole name with its whole value.
    bool ends_there(size_t at, size_t size) const;

    const InsertedUses& uses_;
    Transplant& out_;
};

}  // namespace porttool
