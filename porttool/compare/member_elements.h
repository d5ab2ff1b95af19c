// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "porttool/compare/meaning.h"

namespace porttool {

/// Members of one side that are elements on the other. When the pair was in step, both texts named them in one order,
/// each member always for the same element:
///
///     source   s = r . lo * a ;  t = r . hi ;          port   s = r [ 0 ] * a ;  t = r [ 1 ] ;
class MemberElements {
public:
    explicit MemberElements(const PairTexts& texts);

    /// A text with members in the place of such elements.
    std::vector<std::string> written(const Words& text) const;

private:
    std::map<std::pair<std::string_view, std::string_view>, std::string_view> members_;  ///< by name and number
};

}  // namespace porttool
