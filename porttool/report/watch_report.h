// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "porttool/judge/judgement.h"
#include "porttool/live/finding_changes.h"

namespace porttool {

/// One look of `watch`: what changed since the one before, and when it was told.
struct WatchStep {
    const FindingChanges& changes;
    const Judgement& now;
    std::set<std::string> files;  ///< that were saved, as far as known
    int64_t t_ms = 0;             ///< since the start
    double look_ms = 0;           ///< how long the look took
};

/// New findings as `check` prints them, those that are gone, and how the project stands; "" where nothing changed.
std::string watch_text(const WatchStep& step, bool color);

/// The same as JSON lines, the last of which is `judged`, whatever changed.
std::string watch_json(const WatchStep& step);

/// That the project could not be judged, as one of them.
std::string watch_error_json(const std::string& message, int64_t t_ms);

}  // namespace porttool
