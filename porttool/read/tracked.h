// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace porttool {

/// Why a file of a git work tree is not read, or "". What no commit holds was put there by somebody else, as a file
/// with a token that CI leaves beside the sources; whoever proposes a change may name it, by a link or in the map. So
/// it is read only where its name is that of a source, as a new one's that nobody has added yet. Says nothing outside
/// of git, and where git cannot say what it tracks.
std::string untracked_reason(const std::string& root, const std::string& path);

/// The same of a file that is known to be none that git tracks, and no source by its name. What an ignore rule hides is
/// added by force alone.
std::string untracked_text(const std::string& path);

}  // namespace porttool
