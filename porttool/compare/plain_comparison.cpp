// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/plain_comparison.h"

#include <utility>

namespace porttool {

std::vector<std::string> PlainComparison::written() const {
    std::vector<std::string> out = left;
    out.push_back(sign);
    out.insert(out.end(), right.begin(), right.end());
    return out;
}

void PlainComparison::write_plain(bool turned, bool has_both) {
    if (sign == ">" || sign == ">=") {
        std::swap(left, right);
        sign = sign == ">" ? "<" : "<=";
    }
    const auto negate = [&] {
        if (sign == "==" || sign == "!=") {
            sign = sign == "==" ? "!=" : "==";
        } else {
            std::swap(left, right);
            sign = sign == "<" ? "<=" : "<";
        }
    };
    if (turned) negate();
    if (has_both && (sign == "<=" || sign == "!=")) {
        negate();
        is_opposite = true;
    }
    if ((sign == "==" || sign == "!=") && right < left) std::swap(left, right);
}

}  // namespace porttool
