// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/live/live_project.h"

#include <sstream>

namespace porttool {

const CheckedProject& LiveProject::look() {
    constexpr int kMostRounds = 4;  // folders may come without an end
    for (int round = 0; round < kMostRounds; ++round) {
        std::ostringstream said;
        Workplace place{disk_, said};
        try {
            project_ = check_project(choice_, place, {}, &project_);
        } catch (...) {
            project_ = {};
            said_ = said.str();
            watch_.follow(disk_.take_looked_at());
            throw;
        }
        said_ = said.str();
        if (!watch_.follow(disk_.take_looked_at())) break;
    }
    return project_;
}

}  // namespace porttool
