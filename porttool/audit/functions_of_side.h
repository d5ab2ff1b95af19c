// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/audit/substance.h"
#include "porttool/language/dialect.h"
#include "porttool/normal/units_by_id.h"

namespace porttool {

/// The functions of a side by what they are called.
class FunctionsOfSide {
public:
    /// What it is given has to stay.
    FunctionsOfSide(const UnitsById& units, const Dialect& dialect);

    /// The words of each function that a unit calls, as plain_word() has them. A name of many functions is left out.
    std::vector<WordsOfSide> called_by(const UnitState& unit) const;

private:
    const Dialect& dialect_;
    std::map<std::string_view, std::vector<const UnitState*>> by_name_;  ///< without namespaces and classes
};

}  // namespace porttool
