// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "porttool/command/commands.h"

namespace porttool {

/// Answers from the cache what `work` answered when all that it asked of the disk was as it is now; else lets it work,
/// and keeps its answer, and what it said on stderr, where reading took long enough to be worth it. `request` is
/// everything that the answer rests on beside the disk: options, the day, the program. Errors are never kept, and a
/// cache that lies in a repository around `directory` is none.
Outcome through_cache(const std::string& request, const std::string& directory, Workplace& place,
                      const std::function<Outcome(Workplace&)>& work);

/// The request of a `check`, or "" where its answer rests on more than the disk's: on git, on other programs.
std::string check_request(const Options& options, bool color);

}  // namespace porttool
