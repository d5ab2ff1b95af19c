// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/told_once.h"

#include <fmt/format.h>

namespace porttool {

bool ToldOnce::has_told(const std::string& what) {
    const auto known = by_what_.find(what);
    if (known == by_what_.end()) return false;
    ++told_.at(known->second).more;
    return true;
}

void ToldOnce::tell(const std::string& what, const Finding& finding) {
    by_what_.emplace(what, finding.fingerprint);
    told_.emplace(finding.fingerprint, Told{what});
}

void ToldOnce::tell_how_many(FindingList& findings,
                             const std::function<std::string(const std::string&, size_t)>& more) const {
    for (Finding& finding : findings.from(0))
        if (const auto told = told_.find(finding.fingerprint); told != told_.end() && told->second.more > 0)
            finding.message += more(told->second.what, told->second.more);
}

std::string more_pairs(size_t count) { return fmt::format("{} more pair{}", count, count == 1 ? "" : "s"); }

}  // namespace porttool
