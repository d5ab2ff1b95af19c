// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "porttool/judge/judge.h"
#include "porttool/read/glob.h"
#include "porttool/scan/side.h"

namespace porttool {

/// What a person said about units without counterpart: in the map, in the baseline, or as a verdict.
class Excuses {
public:
    Excuses(const MapFile& map, const LockFile& lock, const Judgement& judgement);

    /// Why the unit needs no counterpart; none if it does.
    std::optional<std::string> find(const std::string& id, Side side) const;

private:
    std::vector<std::pair<Glob, std::string>> globs_;
    std::map<std::string, std::string> of_source_;  ///< by id
};

}  // namespace porttool
