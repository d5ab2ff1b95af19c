// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "porttool/command/commands.h"
#include "porttool/snapshot/facts_store.h"

namespace porttool {

/// Answers from the cache what `work` answered when all that it asked of the disk was as it is now; else lets it work,
/// and keeps its answer, and what it said on stderr, where reading took long enough to be worth it. `request` is
/// everything that the answer rests on beside the disk: options, the day, the program. Errors are never kept, and a
/// cache that lies in `repository` is none.
Outcome through_cache(const std::string& request, const std::string& repository, Workplace& place,
                      const std::function<Outcome(Workplace&)>& work);

/// The facts of a project's files that earlier checks kept, or none where `options` do without: with --no-cache, and
/// with --evidence, which asks for the texts of all that a unit uses.
std::unique_ptr<FactsStore> kept_facts(const Options& options, const std::string& repository);

/// The farthest folder upwards that is a repository or has a map: nothing in it is trusted.
std::string outermost_repository(const Disk& disk, const std::string& directory);

/// The request of a `check`, or "" where its answer rests on more than the disk's: on git, on other programs.
std::string check_request(const Options& options, bool color);

}  // namespace porttool
