// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/weaken.h"

#include <algorithm>

namespace porttool {

void weaken(const JudgedPair& pair, Finding& finding, Level level, const std::string& why) {
    finding.level = std::min(finding.level, level);
    finding.message += "; but " + why;
    finding.remedy =
        "Compare the two once; if nothing is left to port, run: porttool accept " + argument(pair.id.source, finding);
}

void doubt(const JudgedPair& pair, Finding& finding, const std::string& why) {
    weaken(pair, finding, Level::Warning, why);
    finding.causes = {std::string(kInDoubt)};
}

}  // namespace porttool
