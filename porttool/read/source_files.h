// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "porttool/read/disk.h"
#include "porttool/read/glob.h"

namespace porttool {

struct SkippedFile {
    std::string file;
    std::string reason;
};

struct SourceText {
    std::string path;  ///< relative to the root
    std::string text;
};

/// Files that were read, sorted by path, and those that could not be.
struct SourceSet {
    std::vector<SourceText> files;
    std::vector<SkippedFile> skipped;
};

/// Most bytes that are read of one file: a map, a lock.
inline constexpr uint64_t kLargestFile = 64ull * 1024 * 1024;

/// Most bytes of one source: far above what people write, and what a machine with 1 GiB can still scan.
inline constexpr uint64_t kLargestSource = 16ull * 1024 * 1024;

/// Reads files and folders (recursive, known suffixes, .gitignore respected, symbolic links to folders not followed). A
/// path that is not there is reported in `missing`. Paths come out relative to `root` where they lie below it.
SourceSet read_paths(const Disk& disk, const std::string& root, const std::vector<std::string>& paths,
                     std::vector<std::string>& missing);

/// Most files and folders that are looked through for a map's globs, and most bytes of sources that are read for them:
/// far more than a checkout has, and little against a whole disk, which `target_root` could name.
inline constexpr size_t kMostEntries = 1'000'000;
inline constexpr uint64_t kMostSourceBytes = 1ull << 30;

/// Where globs may lead: those of a map beneath the root, those that the user gave on the command line anywhere.
enum class Reach : uint8_t { Beneath, Anywhere };

/// Files that git tracks, or why that cannot be told.
struct TrackedFiles {
    std::set<std::string> files = {};
    std::map<std::string, std::string> modules = {};  ///< submodules among these, and the commit of each
    std::string error = {};
    bool is_known = true;  ///< false outside of git as well, and where nothing was ever added
};

/// What globs stand for.
struct GlobScope {
    Reach reach = Reach::Beneath;
    bool sources_only = false;  ///< no file without a suffix of a source, even where a glob names its suffix
    /// Files that are read where a glob matches them, whatever .gitignore says, which hides only what git does not
    /// track: those that the map names, and those that git tracks, which is asked for where something was ignored. Git
    /// is asked, too, where a map's glob takes what is by its name no source: that is read only where it is tracked.
    std::set<std::string> named = {};
    std::function<TrackedFiles()> tracked = {};
    /// Beyond these is an error; where globs may lead anywhere, the user has chosen.
    size_t most_entries = kMostEntries;
    uint64_t most_bytes = kMostSourceBytes;
};

/// Reads what matches the globs under `root`; a glob that matches nothing is reported in `unmatched`. What lies out of
/// the root is skipped and named. Throws CannotDo beyond the scope's bounds.
SourceSet read_globs(const Disk& disk, const std::string& root, const std::vector<std::string>& globs,
                     std::vector<std::string>& unmatched, const GlobScope& scope = {});

/// True for a glob that names files elsewhere than beneath the root.
bool leads_out_of(const std::string& root, const std::string& glob);

/// Why a text cannot be scanned as source (too large, binary, UTF-16), or "".
std::string unreadable_reason(const std::string& bytes);

/// Why a file of this name is not read, or "": a name that is not UTF-8 can stand neither in a map nor in JSON.
std::string unreadable_name(const std::string& path);

}  // namespace porttool
