// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/read/map_file.h"
#include "porttool/scan/unit.h"

namespace porttool {

/// The ports that lie side by side in a flat list of globs, as [sides.targets] names them: each with the globs of the
/// list that are its own, or with one of the list that is narrowed to its folder. Empty where there is but one port,
/// and where the globs cannot tell them apart: where they have files in common, or a folder holds several.
std::vector<TargetSet> port_sets(const std::vector<ScannedFile>& source, const std::vector<ScannedFile>& target,
                                 const std::vector<std::string>& globs);

}  // namespace porttool
