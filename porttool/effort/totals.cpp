// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/effort/totals.h"

namespace porttool {

void Totals::add_pair(const std::string& source, const std::string& target, const ComparedEdits& compared) {
    const PortedEdit& edit = compared.edit;
    OfSource& of_source = sources_[source];
    of_source.edit = edit.source;
    of_source.ported += edit.ported;
    ++of_source.targets;
    OfTarget& of_target = targets_[target];
    of_target.edit = edit.target;
    take_strictest(of_target.carried, compared.carried);
    tokens_.source_tokens += edit.source_tokens;
    tokens_.target_tokens += edit.target_tokens;
    tokens_.common_tokens += edit.common_tokens;
}

PortedEdit Totals::sum() const {
    PortedEdit out = tokens_;
    for (const auto& [id, one] : sources_) {
        out.source += one.edit;
        out.ported += one.ported / one.targets;
    }
    for (const auto& [id, one] : targets_) {
        out.target += one.edit;
        count_into(one.carried, out.carried);
    }
    return out;
}

}  // namespace porttool
