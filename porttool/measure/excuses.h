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

/// What a person said about units without counterpart: in the map, in the baseline, or as a verdict; the latter two as
/// the judgement has them.
class Excuses {
public:
    Excuses(const MapFile& map, const Judgement& judgement);

    /// Why the unit needs no counterpart; none if it does.
    std::optional<std::string> find(const std::string& id, Side side) const;

private:
    std::vector<std::pair<Glob, std::string>> globs_;
    BySide<std::map<std::string, std::string>> of_units_;  ///< by id
};

}  // namespace porttool
