// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/read/glob.h"

namespace porttool {

/// A glob of a side, seen from a root, and which of the files that it matches are read: of `src/*.inc` those of that
/// suffix, of `src/*` what is known to be source, and a file by its own path whatever its suffix.
class SourceGlob {
public:
    /// One that ends in a slash names a folder. `sources_only`: nothing without a suffix of a source. Throws
    /// GlobTooLarge.
    explicit SourceGlob(const std::string& text, const std::string& root = ".", bool sources_only = false);

    /// True for a file, by its path below the root, that is read.
    bool takes(const std::string& path) const;
    const Glob& glob() const { return glob_; }
    /// The one path that a glob without wildcards is; "" for others.
    const std::string& own_path() const { return own_path_; }

private:
    Glob glob_;
    std::string own_path_;
    bool names_suffix_, sources_only_;
};

/// The globs of one side, asked for all paths of a commit.
class SideGlobs {
public:
    SideGlobs() = default;
    explicit SideGlobs(const std::vector<std::string>& globs) { add(globs); }
    void add(const std::vector<std::string>& globs);
    bool takes(const std::string& path) const;
    /// The folders that hold all of it.
    std::vector<std::string> folders() const;

private:
    std::vector<SourceGlob> globs_;
};

}  // namespace porttool
