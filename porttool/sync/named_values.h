// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "porttool/compare/alignment.h"

namespace porttool {

/// Locals that an edit brings for what the source wrote out before:
///
///     copy ( a , sizeof ( T ) * n ) ;        size_t bytes = sizeof ( T ) * n ;
///                                            copy ( a , bytes ) ;
///
/// None of the names in such a value may be written behind the declaration.
class NamedValues {
public:
    NamedValues() = default;
    /// `is_new`: of each clause of the text.
    NamedValues(const AlignedText& now, const std::vector<bool>& is_new);

    bool empty() const { return values_.empty(); }
    /// True if words of the text, with these names written out, are just those of the text before.
    bool only_name(const AlignedText& now, const Clause& is, const AlignedText& before, const Clause& was) const;

private:
    std::map<std::string, std::vector<std::string>, std::less<>> values_;
};

}  // namespace porttool
