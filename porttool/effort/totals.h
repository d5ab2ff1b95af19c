// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "porttool/effort/ported_edit.h"

namespace porttool {

/// Sums over the pairs that do not depend on their order: a unit's lines count once, wherever it stands, its tokens in
/// each pair.
class Totals {
public:
    void add_pair(const std::string& source, const std::string& target, const ComparedEdits& compared);
    PortedEdit sum() const;

private:
    struct OfSource {
        LineEdit edit;
        double ported = 0, targets = 0;
    };
    struct OfTarget {
        LineEdit edit;
        CarriedLines carried;
    };
    PortedEdit tokens_;  ///< of them alone
    std::map<std::string, OfSource> sources_;
    std::map<std::string, OfTarget> targets_;
};

}  // namespace porttool
